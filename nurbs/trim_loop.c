/* Reading a trim: see trim_loop.h. The steps, each on a list of points: the strands (maximal runs without a joint) one after
 * the other; the joints between them; the domain's border; points that say nothing. */
#include "nurbs/trim_loop.h"

#include "nurbs/trim_chain.h"

/* Places along a bridge where its length in space is looked at: a straight piece across a closed surface has ends that fall
 * together and a middle that does not. */
#define BRIDGE_SAMPLES 8

typedef struct { size_t first; int curve; } Strand;    /* where in the points, and the curve that it begins with */

typedef struct {
    Arena *arena;
    const TrimInput *in;
    const TrimLoopDesc *desc;
    TrimPoints points;
    Strand *strands;
    size_t n_strands, strands_capacity;
    TrimLoop *out;
    NurbsError *error;
} Reader;

static bool refuse(Reader *r, NurbsCode code, int other, Vec2 at, double value)
{
    NurbsError *e = r->error;
    at = trim_from_unit(&r->in->domain, at);
    e->code = code, e->index = r->out->index, e->other = other, e->u = at.x, e->v = at.y, e->value = value;
    return false;
}

static void note(TrimFault *f, double value, Vec2 at)
{
    if (value > TRIM_SILENT && value > f->value) *f = (TrimFault){ value, at };
}

static double max_norm(Vec2 p) { return fmax(fabs(p.x), fabs(p.y)); }

/* ---- strands ---- */

static bool read_polyline(Reader *r)
{
    const TrimCurveDesc *c = r->desc->curves;
    if (r->desc->n_curves < 1 || c->n < 3) return refuse(r, NURBS_TRIM_TOO_SHORT, 3, vec2(0, 0), c ? c->n : 0);
    for (int i = 0; i < c->n; i++) {
        Vec2 p = vec2(c->points[i].x, c->points[i].y);
        if (!isfinite(p.x) || !isfinite(p.y)) {
            r->error->curve = 0;
            refuse(r, NURBS_POINT_NOT_FINITE, isfinite(p.x), vec2(0, 0), isfinite(p.x) ? p.y : p.x);
            r->error->index = i;
            return false;
        }
        trim_points_add(r->arena, &r->points, trim_to_unit(&r->in->domain, p));
    }
    return true;
}

static void begin_strand(Reader *r, int curve, Vec2 start)
{
    ARENA_PUSH(r->arena, r->strands, r->n_strands, r->strands_capacity) = (Strand){ r->points.n, curve };
    trim_points_add(r->arena, &r->points, start);
}

static bool read_curve(Reader *r, int curve)
{
    const TrimCurveDesc *c = &r->desc->curves[curve];
    r->error->curve = curve;
    if (!trim_curve_is_valid(c, r->error)) return false;
    for (int s = trim_curve_span(c, 0); s >= 0; s = trim_curve_span(c, s + 1)) {
        Vec4 segment[NURBS_MAX_ORDER];
        trim_curve_segment(c, &r->in->domain, s, segment);
        if (trim_curve_starts_at(c, s)) begin_strand(r, curve, trim_segment_start(segment));
        trim_segment_flatten(r->arena, c->order, segment, &r->points);
    }
    return true;
}

static bool read_curves(Reader *r)
{
    if (r->desc->n_curves < 1) return refuse(r, NURBS_TRIM_TOO_SHORT, 1, vec2(0, 0), 0);
    for (int i = 0; i < r->desc->n_curves; i++) {
        if (!read_curve(r, i)) return false;
    }
    r->error->curve = -1;
    return true;
}

/* ---- joints ---- */

/* How long the straight piece from a to b is in space, relative to the surface. */
static double length_in_space(const TrimInput *in, Vec2 a, Vec2 b)
{
    if (!in->distance) return INFINITY;
    Vec2 from = trim_from_unit(&in->domain, a);
    double worst = 0;
    for (int i = 1; i <= BRIDGE_SAMPLES; i++) {
        double s = (double)i / BRIDGE_SAMPLES;
        Vec2 at = vec2_add(vec2_scale(a, 1 - s), vec2_scale(b, s));
        worst = fmax(worst, in->distance(in->surface, from, trim_from_unit(&in->domain, at)));
    }
    return worst;
}

/* The joint before strand i. A bridge needs no point of its own: the ends are neighbours in the list. */
static bool close_joint(Reader *r, size_t i)
{
    size_t last = i > 0 ? r->strands[i].first - 1 : r->points.n - 1;
    Vec2 *from = &r->points.p[last], *to = &r->points.p[r->strands[i].first];
    double gap = max_norm(vec2_sub(*to, *from));
    if (gap <= TRIM_SILENT) {
        *from = *to = vec2((from->x + to->x) / 2, (from->y + to->y) / 2);
        return true;
    }
    note(&r->out->bridged, gap, *to);
    if (gap <= TRIM_BRIDGE || length_in_space(r->in, *from, *to) <= TRIM_BRIDGE_SPACE) return true;
    r->error->curve = r->strands[i].curve;
    return refuse(r, NURBS_TRIM_OPEN, r->strands[i].curve, *to, gap);
}

static bool close_joints(Reader *r)
{
    for (size_t i = 0; i < r->n_strands; i++) {
        if (!close_joint(r, i)) return false;
    }
    return true;
}

/* ---- the border ---- */

static double distance_outside(Vec2 p)
{
    if (!isfinite(p.x) || !isfinite(p.y)) return INFINITY;   /* overflowed on the way to the unit square */
    return fmax(fmax(fmax(-p.x, p.x - 1), fmax(-p.y, p.y - 1)), 0);
}

static bool check_inside(Reader *r)
{
    double worst = 0;
    Vec2 at = vec2(0, 0);
    for (size_t i = 0; i < r->points.n; i++) {
        double d = distance_outside(r->points.p[i]);
        if (d > worst) worst = d, at = r->points.p[i];
    }
    note(&r->out->clamped, worst, at);
    return worst <= TRIM_OUTSIDE || refuse(r, NURBS_TRIM_OUTSIDE, -1, at, worst);
}

static double to_border(double x)
{
    return x <= TRIM_SILENT ? 0 : x >= 1 - TRIM_SILENT ? 1 : x;
}

static void add_clamped(Reader *r, TrimPoints *list, Vec2 p)
{
    p = vec2(to_border(p.x), to_border(p.y));
    if (list->n > 0 && list->p[list->n - 1].x == p.x && list->p[list->n - 1].y == p.y) return;
    trim_points_add(r->arena, list, p);
}

/* Where in (0, 1) the way from x to y passes 0 and 1: up to two places, appended to s. */
static int passes(double x, double y, double s[], int n)
{
    for (int border = 0; border <= 1; border++) {
        if ((x < border && y > border) || (x > border && y < border)) s[n++] = (border - x) / (y - x);
    }
    return n;
}

/* Clamping bends a piece where it passes the border: there it gets points. */
static void add_piece_clamped(Reader *r, TrimPoints *list, Vec2 a, Vec2 b)
{
    double s[4];
    int n = passes(a.y, b.y, s, passes(a.x, b.x, s, 0));
    for (int i = 1; i < n; i++) {
        for (int j = i; j > 0 && s[j] < s[j - 1]; j--) {
            double swap = s[j];
            s[j] = s[j - 1], s[j - 1] = swap;
        }
    }
    for (int i = 0; i < n; i++) {
        add_clamped(r, list, vec2_add(vec2_scale(a, 1 - s[i]), vec2_scale(b, s[i])));
    }
    add_clamped(r, list, b);
}

static void clamp_to_domain(Reader *r)
{
    TrimPoints list = { 0 };
    const TrimPoints *all = &r->points;
    for (size_t i = 0; i < all->n; i++) add_piece_clamped(r, &list, all->p[(i ? i : all->n) - 1], all->p[i]);
    while (list.n > 1 && list.p[0].x == list.p[list.n - 1].x && list.p[0].y == list.p[list.n - 1].y) list.n--;
    r->points = list;
}

/* ---- the whole ---- */

/* Summed relative to the first point, so that the error is relative to the loop and not to its place. */
double trim_signed_area(const Vec2 *p, int n)
{
    double twice = 0;
    for (int i = 0; i < n; i++) twice += vec2_cross(vec2_sub(p[i], p[0]), vec2_sub(p[i + 1], p[0]));
    return twice / 2;
}

static double length_of(const Vec2 *p, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += vec2_length(vec2_sub(p[i + 1], p[i]));
    return sum;
}

static void finish(Reader *r)
{
    TrimLoop *out = r->out;
    int n = (int)r->points.n;
    if (n < 3) return;
    trim_points_add(r->arena, &r->points, r->points.p[0]);
    out->area = trim_signed_area(r->points.p, n);
    if (2 * fabs(out->area) <= TRIM_THIN * length_of(r->points.p, n)) return;
    out->p = r->points.p, out->n = n;
}

bool trim_loop_read(Arena *a, const TrimInput *in, int index, TrimLoop *out, NurbsError *error)
{
    Reader r = { .arena = a, .in = in, .desc = &in->loops[index], .out = out, .error = error };
    *out = (TrimLoop){ .index = index };
    *error = (NurbsError){ .where = NURBS_IN_TRIM, .trim = index, .curve = -1, .index = index, .other = -1 };
    if (!(r.desc->is_polyline ? read_polyline(&r) : read_curves(&r))) return false;
    if (!close_joints(&r) || !check_inside(&r)) return false;
    clamp_to_domain(&r);
    finish(&r);
    return true;
}

bool trim_loop_is_border(const TrimLoop *l)
{
    for (int i = 0; i < l->n; i++) {
        Vec2 a = l->p[i], b = l->p[i + 1];
        bool on_u = a.x == b.x && (a.x == 0 || a.x == 1), on_v = a.y == b.y && (a.y == 0 || a.y == 1);
        if (!on_u && !on_v) return false;
    }
    return true;
}
