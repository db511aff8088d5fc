/* See truth.h. On the ray f is a polynomial g(s). A point with |f| <= |grad f| band + |Hessian| band^2 / 2 is about as
 * near to the surface as the band, or nearer (the second term matters at cusps and apices, where grad f vanishes). A
 * root's interval is where the ray is that near; roots in one interval count together: an odd number stays, an even one
 * may not. */
#include "tests/stress/truth.h"

/* How far along the line events may be, in the form's reach: bands are far narrower than the quarter. */
#define REACH 1.25

#define ALONG 3              /* places where a plane may be near the line without a root or a critical point */

typedef struct {
    const FormInWorld *f;
    Quad3 at, dir;           /* local: at + s dir, |dir| = 1 */
    Quad centre, unit;       /* of t: t = (centre + s) / unit */
    Poly g, slope;
    Quad reach, hessian, band;
    Quad roots[POLY_MAX], near[2 * POLY_MAX + ALONG];   /* near: where the line may be near the surface without a root */
    int n_roots, n_critical, n_near;                    /* the first of `near` are places where a tangent is no guide */
} Line;

static Quad3 line_at(const Line *l, Quad s) { return quad3_add(l->at, quad3_scale(l->dir, s)); }

/* The length in the world of a normal given in local coordinates. It is a factor, for which few digits will do. */
static long double normal_length(const Line *l, Quad3 n)
{
    const QuadMap *m = &l->f->to_local;
    const Quad3 *columns[3] = { &m->x, &m->y, &m->z };
    long double x = (long double)n.x, y = (long double)n.y, z = (long double)n.z, sum = 0;
    for (int i = 0; i < 3; i++) {
        const Quad3 *c = columns[i];
        long double a = (long double)c->x * x + (long double)c->y * y + (long double)c->z * z;
        sum += a * a;
    }
    return sqrtl(sum);
}

static Quad gradient_length(const Line *l, Quad s)
{
    return normal_length(l, l->f->form.gradient(&l->f->form, line_at(l, s)));
}

static bool is_in_band(const Line *l, Quad s)
{
    return quad_abs(poly_at(&l->g, s)) <= l->band * gradient_length(l, s) + l->hessian * l->band * l->band / 2;
}

/* From s outwards to where the line has left the band: at most some 3 % too far. */
static Quad leave_band(const Line *l, Quad s, Quad step)
{
    Quad inside = 0, outside = step;
    while (is_in_band(l, s + outside)) {
        inside = outside;
        outside *= (Quad)1.5;
        if (quad_abs(s + outside) > l->reach) return step < 0 ? -l->reach : l->reach;
    }
    for (int i = 0; i < 5; i++) {
        Quad middle = (inside + outside) / 2;
        if (is_in_band(l, s + middle)) inside = middle;
        else outside = middle;
    }
    return s + outside;
}

long double truth_length(const FormInWorld *f, const Ray *r)
{
    return (long double)((f->extent + vec_length(r->origin)) / quad3_length(quad3_of(r->dir)));
}

double truth_band(const FormInWorld *f, const Ray *r)
{
    return BAND_SHARE * (4 * f->k_sum + 23) * 0x1p-53 * (f->extent + vec_length(r->origin) + f->diagonal);
}

double truth_input_band(const FormInWorld *f) { return INPUT_ROUNDINGS * 0x1p-53 * f->extent; }

/* The least distance in the world from s0 .. s1 to the border, and the greatest: negative is beyond it. */
static void border_distance(const Line *l, Quad s0, Quad s1, Quad *least, Quad *most)
{
    const Form *f = &l->f->form;
    *least = *most = HUGE_VALL;
    Quad3 p0 = line_at(l, s0), p1 = line_at(l, s1);
    for (int i = 0; i < f->n_sides; i++) {
        Quad unit = normal_length(l, f->side[i].normal);
        Quad a = (quad3_dot(f->side[i].normal, p0) + f->side[i].at) / unit;
        Quad b = (quad3_dot(f->side[i].normal, p1) + f->side[i].at) / unit;
        *least = quad_min(*least, quad_min(a, b)), *most = quad_min(*most, quad_max(a, b));
    }
}

typedef struct { Quad s, lo, hi; } Event;

/* The distance that a trim tells of may be that to an edge which is but nearly the nearest: it changes by at most so much in
 * the length of a step. */
#define KEPT_SLOPE 4

/* Is sign times what the trim says anywhere from s0 to s1 more than -least? Slivers may lie between any two places, so these
 * are halved until what is known at the ends decides, or they are as near as a fraction of `least`. */
static bool trim_reaches(const Line *l, int sign, Quad s0, Quad at_s0, Quad s1, Quad at_s1, Quad least)
{
    if (at_s0 >= -least || at_s1 >= -least) return true;
    Quad length = KEPT_SLOPE * (s1 - s0);
    if ((at_s0 + at_s1 + length) / 2 < -least) return false;
    if (length < least / 8) return true;
    Quad middle = (s0 + s1) / 2, at_middle = sign * l->f->kept(l->f->kept_context, line_at(l, middle));
    return trim_reaches(l, sign, s0, at_s0, middle, at_middle, least)
        || trim_reaches(l, sign, middle, at_middle, s1, at_s1, least);
}

/* The distance to a trim's edge is known in local coordinates only: the band there is what the map makes of it at most. */
static void find_trims(const Line *l, const Event *e, bool *is_kept, bool *is_clear)
{
    const QuadMap *m = &l->f->to_local;
    Quad stretch = quad_max(quad3_length(m->x), quad_max(quad3_length(m->y), quad3_length(m->z))) * 2;
    Quad a = l->f->kept(l->f->kept_context, line_at(l, e->lo)), b = l->f->kept(l->f->kept_context, line_at(l, e->hi));
    *is_kept = trim_reaches(l, 1, e->lo, a, e->hi, b, l->band * stretch);
    *is_clear = !trim_reaches(l, -1, e->lo, -a, e->hi, -b, l->band * stretch);
}

static Event root_event(const Line *l, Quad s)
{
    Quad slope = quad_abs(poly_at(&l->slope, s)), slack = slope > 0 ? l->band * gradient_length(l, s) / slope : l->reach;
    Quad nearest = l->reach;
    for (int i = 0; i < l->n_critical; i++) nearest = quad_min(nearest, quad_abs(l->near[i] - s));
    if (slack * 32 < nearest) return (Event){ s, s - slack * (Quad)1.25, s + slack * (Quad)1.25 };
    Quad step = quad_max(quad_min(slack, nearest) / 4, (Quad)1e-30L);
    return (Event){ s, leave_band(l, s, -step), leave_band(l, s, step) };
}

static long double t_of(const Line *l, Quad s) { return (long double)((l->centre + s) / l->unit); }

static void add_event(const Line *l, const Event *e, Truth *out)
{
    Quad least, most;
    bool is_kept = true, is_clear = true;
    border_distance(l, e->lo, e->hi, &least, &most);
    if (l->f->kept) find_trims(l, e, &is_kept, &is_clear);
    if (most < -l->band || !is_kept) return;
    bool is_odd = (poly_at(&l->g, e->lo) < 0) != (poly_at(&l->g, e->hi) < 0);
    truth_add(out, (TruthRoot){ t_of(l, e->s), t_of(l, e->lo), t_of(l, e->hi), is_odd, is_clear && least > l->band,
                               false });
}

/* Joins e with those that it overlaps; returns how many there are then. */
static int join_event(Event *list, int n, Event e)
{
    for (int i = 0; i < n; i++) {
        if (list[i].hi < e.lo || e.hi < list[i].lo) continue;
        e.lo = quad_min(e.lo, list[i].lo), e.hi = quad_max(e.hi, list[i].hi);
        list[i] = list[--n];
        i = -1;
    }
    list[n++] = e;
    return n;
}

/* The roots, and the other places to look at: the zeros of the slope and those of its own derivative, for near a root that
 * is as good as triple the slope has a least value that need not be zero. */
static void find_places(Line *l)
{
    Poly bend = poly_derivative(l->slope);
    Quad *bends = l->near, *flats;
    int n_bends = poly_roots(&bend, -l->reach, l->reach, bends);
    flats = l->near + n_bends;
    int n_flats = poly_roots_between(&l->slope, -l->reach, l->reach, bends, n_bends, flats);
    l->n_roots = poly_roots_between(&l->g, -l->reach, l->reach, flats, n_flats, l->roots);
    l->n_near = l->n_critical = n_bends + n_flats;
    for (int i = 0; i < ALONG; i++) l->near[l->n_near++] = (i - 1) * l->reach / 2;
}

static void find_events(Line *l, double band, Truth *out)
{
    Event events[3 * POLY_MAX + ALONG];
    int n = 0;
    l->band = band;
    for (int i = 0; i < l->n_roots; i++) n = join_event(events, n, root_event(l, l->roots[i]));
    for (int i = 0; i < l->n_near; i++) {
        Quad s = l->near[i];
        if (!is_in_band(l, s)) continue;
        bool is_seen = false;
        for (int j = 0; j < n; j++) is_seen |= events[j].lo <= s && s <= events[j].hi;
        if (is_seen) continue;
        n = join_event(events, n, (Event){ s, leave_band(l, s, -(Quad)1e-24L), leave_band(l, s, (Quad)1e-24L) });
    }
    out->n = 0;
    for (int i = 0; i < n; i++) add_event(l, &events[i], out);
}

void truth_of_form(const FormInWorld *f, const Ray *r, Truth *out)
{
    Quad3 o = quad_map_point(&f->to_local, quad3_of(r->origin)), d = quad_map_vector(&f->to_local, quad3_of(r->dir));
    Line l = { .f = f, .reach = REACH * f->form.reach, .unit = quad3_length(d) };
    l.dir = quad3_scale(d, 1 / l.unit);
    l.centre = -quad3_dot(o, l.dir);
    l.at = quad3_add(o, quad3_scale(l.dir, l.centre));
    out->n = 0;
    out->length = truth_length(f, r);
    if (quad3_length(l.at) > l.reach) return;
    l.g = f->form.along(&f->form, poly_line(l.at.x, l.dir.x), poly_line(l.at.y, l.dir.y), poly_line(l.at.z, l.dir.z));
    l.slope = poly_derivative(l.g);
    Quad stretch = quad3_length(f->to_local.x) + quad3_length(f->to_local.y) + quad3_length(f->to_local.z);
    l.hessian = f->form.hessian * stretch * stretch;
    find_places(&l);
    find_events(&l, truth_band(f, r), out);
    Truth by_input;
    bool is_in_doubt = truth_is_in_doubt(out);
    if (is_in_doubt) find_events(&l, truth_input_band(f), &by_input);
    truth_note_musts(out, is_in_doubt ? &by_input : NULL);
}

void truth_add(Truth *t, TruthRoot root)
{
    if (t->n == TRUTH_MAX) return;
    int at = t->n++;
    for (; at > 0 && t->root[at - 1].t > root.t; at--) t->root[at] = t->root[at - 1];
    t->root[at] = root;
}

bool truth_is_in_doubt(const Truth *t)
{
    bool is_sure = true;
    for (int i = 0; i < t->n; i++) is_sure = is_sure && truth_is_sure(&t->root[i]);
    return !is_sure;
}

void truth_note_musts(Truth *t, const Truth *by_input)
{
    for (int i = 0; i < t->n; i++) {
        TruthRoot *root = &t->root[i];
        root->is_must = truth_is_sure(root);
        for (int j = 0; by_input && j < by_input->n; j++) {
            const TruthRoot *x = &by_input->root[j];
            root->is_must = root->is_must || (truth_is_sure(x) && root->lo <= x->t && x->t <= root->hi);
        }
    }
}
