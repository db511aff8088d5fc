/* Reading a trim: see trim_loop.h. Each step of trim_strand.h becomes pieces: curves are cut where they turn and where
 * they pass the domain's border; what is outside or along the border becomes straight. */
#include "nurbs/trim_loop.h"

#include <stdlib.h>

/* A vertex of the path, and the arc to the next one. */
typedef struct { WidePoint p; TrimArc arc; } Side;

typedef struct {
    Arena *arena;
    Side *sides;
    size_t n, capacity;
    double outside;                /* the farthest */
    Vec2 outside_at;
    double moved;                  /* the farthest that something within the domain was put on its border from */
    bool has_arcs, has_low;
} Outline;

/* ---- vertices ---- */

static bool are_equal(WidePoint a, WidePoint b)
{
    return a.x.hi == b.x.hi && a.y.hi == b.y.hi && a.x.lo == b.x.lo && a.y.lo == b.y.lo;
}

/* Is b on the straight way from a to c along a border? */
static bool is_between(Wide across_a, Wide across_b, Wide across_c, Wide a, Wide b, Wide c)
{
    bool is_border = across_b.lo == 0 && (across_b.hi == 0 || across_b.hi == 1);
    return is_border && across_a.hi == across_b.hi && across_c.hi == across_b.hi && wide_less(a, b) == wide_less(b, c);
}

/* Curves along a border come in many parts, each with a little noise: one piece is enough. */
static bool is_on_the_way(const Outline *o, WidePoint c)
{
    if (o->n < 2 || o->sides[o->n - 2].arc.segment) return false;
    WidePoint a = o->sides[o->n - 2].p, b = o->sides[o->n - 1].p;
    return is_between(a.x, b.x, c.x, a.y, b.y, c.y) || is_between(a.y, b.y, c.y, a.x, b.x, c.x);
}

static void add_vertex(Outline *o, WidePoint p)
{
    if (o->n > 0 && are_equal(o->sides[o->n - 1].p, p)) return;
    if (is_on_the_way(o, p)) o->n--;
    ARENA_PUSH(o->arena, o->sides, o->n, o->capacity) = (Side){ .p = p };
    o->has_low = o->has_low || p.x.lo != 0 || p.y.lo != 0;
}

static void add_arc(Outline *o, const TrimSegment *s, double t0, double t1, WidePoint a, WidePoint b)
{
    add_vertex(o, a);
    if (are_equal(a, b)) return;
    o->sides[o->n - 1].arc = trim_arc_make(s, t0, t1);
    o->has_arcs = true;
    add_vertex(o, b);
}

static double distance_outside(Vec2 p)
{
    if (!isfinite(p.x) || !isfinite(p.y)) return INFINITY;   /* overflowed on the way to the unit square */
    return fmax(fmax(fmax(-p.x, p.x - 1), fmax(-p.y, p.y - 1)), 0);
}

/* Notes how far outside; false: too far to go on with this point. */
static bool note_outside(Outline *o, Vec2 p)
{
    double d = distance_outside(p);
    if (d > o->outside) o->outside = d, o->outside_at = p;
    return d <= TRIM_OUTSIDE;
}

static Wide to_border(Outline *o, Wide x)
{
    if (x.hi > TRIM_SILENT && x.hi < 1 - TRIM_SILENT) return x;
    double border = x.hi > .5;
    if (x.hi > 0 && x.hi < 1) o->moved = fmax(o->moved, fabs(x.hi - border));
    return wide(border);
}

static void add_clamped(Outline *o, WidePoint p) { add_vertex(o, (WidePoint){ to_border(o, p.x), to_border(o, p.y) }); }

/* ---- straight pieces ---- */

static bool is_passed(double x, double y, int border) { return (x < border && y > border) || (x > border && y < border); }

/* Where in (0, 1) the way from x to y passes 0 and 1: up to two places, appended to s. */
static int passes(double x, double y, double s[], int n)
{
    for (int border = 0; border <= 1; border++) {
        if (is_passed(x, y, border)) s[n++] = (border - x) / (y - x);
    }
    return n;
}

static void sort(double s[], int n)
{
    for (int i = 1; i < n; i++) {
        for (int j = i; j > 0 && s[j] < s[j - 1]; j--) {
            double swap = s[j];
            s[j] = s[j - 1], s[j - 1] = swap;
        }
    }
}

/* Clamping bends a piece where it passes the border: there it gets points. */
static void add_straight(Outline *o, Vec2 a, Vec2 b)
{
    bool is_near = note_outside(o, a);
    if (!note_outside(o, b) || !is_near) return;
    double s[4];
    int n = passes(a.y, b.y, s, passes(a.x, b.x, s, 0));
    sort(s, n);
    add_clamped(o, wide_point(a));
    for (int i = 0; i < n; i++) add_clamped(o, wide_point(vec2_add(vec2_scale(a, 1 - s[i]), vec2_scale(b, s[i]))));
    add_clamped(o, wide_point(b));
}

/* ---- arcs ---- */

static bool are_along(double x, double y)
{
    return (x <= TRIM_SILENT && y <= TRIM_SILENT) || (x >= 1 - TRIM_SILENT && y >= 1 - TRIM_SILENT);
}

/* Monotone, and nowhere on both sides of a border. */
static void add_part(Outline *o, const TrimSegment *s, double t0, double t1, WidePoint a, WidePoint b)
{
    Vec2 p = wide_point_round(a), q = wide_point_round(b);
    if (are_along(p.x, q.x) || are_along(p.y, q.y)) {
        add_clamped(o, a);
        add_clamped(o, b);
    } else {
        add_arc(o, s, t0, t1, a, b);
    }
}

/* Where a curve passes a border: its place is known to the last bit, and the coordinate to all of them. */
typedef struct { double t; int coordinate, border; } Pass;

static int add_pass(const TrimArc *arc, int coordinate, int border, Pass pass[], int n)
{
    Pass found = { trim_arc_find(arc, coordinate, border), coordinate, border };
    int at = n;
    for (; at > 0 && pass[at - 1].t > found.t; at--) pass[at] = pass[at - 1];
    pass[at] = found;
    return n + 1;
}

/* Up to four, in order. */
static int border_passes(const TrimSegment *s, double t0, double t1, Vec2 a, Vec2 b, Pass pass[])
{
    int n = 0;
    const TrimArc arc = { .segment = s, .t0 = t0, .t1 = t1 };
    for (int border = 0; border <= 1; border++) {
        if (is_passed(a.x, b.x, border)) n = add_pass(&arc, 0, border, pass, n);
        if (is_passed(a.y, b.y, border)) n = add_pass(&arc, 1, border, pass, n);
    }
    return n;
}

static void put_on_border(WidePoint *p, const Pass *pass) { *(pass->coordinate ? &p->y : &p->x) = wide(pass->border); }

/* The monotone part of a curve between two turns. */
static void add_monotone(Outline *o, const TrimSegment *s, double t0, double t1, WidePoint a, WidePoint b)
{
    Pass pass[4];
    Vec2 from = wide_point_round(a), to = wide_point_round(b);
    bool is_near = note_outside(o, from);
    if (!note_outside(o, to) || !is_near) return;
    bool is_inside = distance_outside(from) == 0 && distance_outside(to) == 0;
    int n = is_inside ? 0 : border_passes(s, t0, t1, from, to, pass);
    for (int i = 0; i < n; i++) {
        double t = pass[i].t;
        if (!(t > t0 && t < t1)) continue;
        WidePoint middle = trim_segment_at(s, t);
        put_on_border(&middle, &pass[i]);
        if (i + 1 < n && pass[i + 1].t == t) put_on_border(&middle, &pass[++i]);    /* through a corner */
        add_part(o, s, t0, t, a, middle);
        t0 = t, a = middle;
    }
    add_part(o, s, t0, t1, a, b);
}

static void add_curve(Outline *o, const TrimStep *step, WidePoint end)
{
    TrimSegment *s = ARENA_NEW(o->arena, TrimSegment);
    *s = trim_segment_make(step->k, step->control);
    double t[TRIM_MAX_TURNS];
    int n = trim_segment_turns(s, t);
    double t0 = 0;
    WidePoint a = step->p;
    for (int i = 0; i < n; i++) {
        WidePoint b = trim_segment_at(s, t[i]);
        add_monotone(o, s, t0, t[i], a, b);
        t0 = t[i], a = b;
    }
    add_monotone(o, s, t0, 1, a, end);
}

static Outline outline_of(Arena *a, const TrimSteps *steps)
{
    Outline o = { .arena = a, .moved = steps->moved };
    for (size_t i = 0; i < steps->n; i++) {
        const TrimStep *s = &steps->step[i];
        WidePoint end = steps->step[i + 1 < steps->n ? i + 1 : 0].p;
        if (s->control) add_curve(&o, s, end);
        else if (!are_equal(s->p, end)) add_straight(&o, wide_point_round(s->p), wide_point_round(end));
    }
    while (o.n > 1 && !o.sides[o.n - 1].arc.segment && are_equal(o.sides[0].p, o.sides[o.n - 1].p)) o.n--;
    return o;
}

/* ---- the whole ---- */

/* Relative to the first point, so that the error is relative to the loop and not to its place; and by pieces, so that it is
 * relative to their lengths: 6 roundings of |a| |b|, those of the differences, the products and their difference. What a
 * million terms add up to is not rounded again. */
double trim_signed_area(const Vec2 *p, int n)
{
    Wide twice = wide(0);
    for (int i = 0; i < n; i++) {
        Vec2 a = vec2_sub(p[i], p[0]), b = vec2_sub(p[i + 1], p[i]);
        twice = wide_add(twice, wide(vec2_cross(a, b)));
    }
    return twice.hi / 2;
}

static TrimPath path_of(const Outline *o)
{
    size_t n = o->n;
    Vec2 *p = ARENA_ARRAY(o->arena, Vec2, n + 1), *low = o->has_low ? ARENA_ARRAY(o->arena, Vec2, n + 1) : NULL;
    TrimArc *arc = o->has_arcs ? ARENA_ARRAY(o->arena, TrimArc, n) : NULL;
    for (size_t i = 0; i <= n; i++) {
        const Side *s = &o->sides[i < n ? i : 0];
        p[i] = wide_point_round(s->p);
        if (low) low[i] = vec2(s->p.x.lo, s->p.y.lo);
        if (arc && i < n) arc[i] = s->arc;
    }
    return (TrimPath){ (int)n, p, low, arc };
}

static void measure(TrimLoop *l, double moved)
{
    const TrimPath *path = &l->path;
    double length = 0;
    l->area = trim_signed_area(path->p, path->n);
    for (int i = 0; i < path->n; i++) {
        length += vec2_length(vec2_sub(path->p[i + 1], path->p[i]));
        if (!trim_is_straight(path, i)) l->area += trim_arc_area(&path->arc[i]);
    }
    l->is_thin = 2 * fabs(l->area) <= fmax(TRIM_THIN, moved) * length;
}

static bool refuse_outside(const TrimInput *in, const Outline *o, NurbsError *error)
{
    Vec2 at = trim_from_unit(&in->domain, o->outside_at);
    error->code = NURBS_TRIM_OUTSIDE, error->other = -1, error->u = at.x, error->v = at.y, error->value = o->outside;
    return false;
}

bool trim_loop_read(Arena *a, const TrimInput *in, int index, TrimLoop *out, NurbsError *error)
{
    TrimSteps steps = { 0 };
    *out = (TrimLoop){ .index = index };
    *error = (NurbsError){ .where = NURBS_IN_TRIM, .trim = index, .curve = -1, .index = index, .other = -1 };
    if (!trim_steps_read(a, in, index, &steps, &out->bridged, error)) return false;
    Outline o = outline_of(a, &steps);
    if (o.outside > TRIM_OUTSIDE) return refuse_outside(in, &o, error);
    if (o.outside > TRIM_SILENT) out->clamped = (TrimFault){ o.outside, o.outside_at };
    if (o.n < 2) return true;
    out->path = path_of(&o);
    measure(out, o.moved);
    return true;
}

bool trim_loop_is_border(const TrimLoop *l)
{
    for (int i = 0; i < l->path.n; i++) {
        Vec2 a = l->path.p[i], b = l->path.p[i + 1];
        bool on_u = a.x == b.x && (a.x == 0 || a.x == 1), on_v = a.y == b.y && (a.y == 0 || a.y == 1);
        if (!on_u && !on_v) return false;
    }
    return true;
}
