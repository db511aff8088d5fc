/* Strands and joints. See trim_strand.h. */
#include "nurbs/trim_strand.h"

/* Places along a bridge where its length in space is looked at: a straight piece across a closed surface has ends that fall
 * together and a middle that does not. */
#define BRIDGE_SAMPLES 8

typedef struct { size_t first; int curve; } Strand;    /* its first step, and the curve that it begins with */

typedef struct {
    Arena *arena;
    const TrimInput *in;
    const TrimLoopDesc *desc;
    TrimSteps *steps;
    Strand *strands;
    size_t n_strands, strands_capacity;
    TrimFault *bridged;
    NurbsError *error;
} Reader;

static bool refuse(Reader *r, NurbsCode code, int other, Vec2 at, double value)
{
    NurbsError *e = r->error;
    at = trim_from_unit(&r->in->domain, at);
    e->code = code, e->other = other, e->u = at.x, e->v = at.y, e->value = value;
    return false;
}

static void add_step(Reader *r, WidePoint p)
{
    TrimSteps *s = r->steps;
    ARENA_PUSH(r->arena, s->step, s->n, s->capacity) = (TrimStep){ .p = p };
}

/* ---- strands ---- */

static bool read_polyline(Reader *r)
{
    const TrimCurveDesc *c = r->desc->curves;
    if (r->desc->n_curves < 1 || c->n < 3) return refuse(r, NURBS_TRIM_TOO_SHORT, 3, vec2(0, 0), c ? c->n : 0);
    for (int i = 0; i < c->n; i++) {
        Vec2 p = vec2(c->points[i].x, c->points[i].y);
        if (!isfinite(p.x) || !isfinite(p.y)) {
            r->error->curve = 0, r->error->index = i;
            return refuse(r, NURBS_POINT_NOT_FINITE, isfinite(p.x), vec2(0, 0), isfinite(p.x) ? p.y : p.x);
        }
        add_step(r, wide_point(trim_to_unit(&r->in->domain, p)));
    }
    return true;
}

static WidePoint project(WideControl c) { return (WidePoint){ wide_div(c.x, c.w), wide_div(c.y, c.w) }; }
static WidePoint rounded(WidePoint p) { return wide_point(wide_point_round(p)); }

static void read_span(Reader *r, int curve, int s)
{
    const TrimCurveDesc *c = &r->desc->curves[curve];
    int k = c->order;
    WideControl control[NURBS_MAX_ORDER];
    trim_curve_segment(c, &r->in->domain, s, control);
    if (trim_curve_starts_at(c, s)) {
        ARENA_PUSH(r->arena, r->strands, r->n_strands, r->strands_capacity) = (Strand){ r->steps->n, curve };
        add_step(r, k > 2 ? project(control[0]) : rounded(project(control[0])));
    }
    if (k > 2) {
        TrimStep *last = &r->steps->step[r->steps->n - 1];
        last->k = k, last->control = arena_copy(r->arena, control, (size_t)k, sizeof *control);
    }
    add_step(r, k > 2 ? project(control[k - 1]) : rounded(project(control[k - 1])));
}

static bool read_curves(Reader *r)
{
    if (r->desc->n_curves < 1) return refuse(r, NURBS_TRIM_TOO_SHORT, 1, vec2(0, 0), 0);
    for (int i = 0; i < r->desc->n_curves; i++) {
        const TrimCurveDesc *c = &r->desc->curves[i];
        r->error->curve = i;
        if (!trim_curve_is_valid(c, r->error)) return false;
        for (int s = trim_curve_span(c, 0); s >= 0; s = trim_curve_span(c, s + 1)) read_span(r, i, s);
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

static double on_border(double x) { return fabs(x) <= TRIM_SILENT ? 0 : fabs(x - 1) <= TRIM_SILENT ? 1 : x; }

/* Moves the end of a strand, and the curve that ends or begins there. */
static void move_end(TrimSteps *s, TrimStep *at, TrimStep *curve, bool is_last, Vec2 p)
{
    p = vec2(on_border(p.x), on_border(p.y));
    s->moved = fmax(s->moved, fmax(fabs(at->p.x.hi - p.x), fabs(at->p.y.hi - p.y)));
    at->p = wide_point(p);
    if (!curve->control) return;
    WideControl *c = &curve->control[is_last ? curve->k - 1 : 0];
    c->x = wide_mul(wide(p.x), c->w), c->y = wide_mul(wide(p.y), c->w);
}

/* Exact already, between curves, and not beside a border: neither needs to be moved. */
static bool is_closed(const TrimStep *last, const TrimStep *first)
{
    Vec2 p = wide_point_round(first->p);
    return last[-1].control && first->control && on_border(p.x) == p.x && on_border(p.y) == p.y
        && last->p.x.hi == p.x && last->p.x.lo == first->p.x.lo && last->p.y.hi == p.y && last->p.y.lo == first->p.y.lo;
}

/* The joint before strand i. A bridge needs no step of its own: the ends follow each other. */
static bool close_joint(Reader *r, size_t i)
{
    TrimStep *steps = r->steps->step;
    size_t last = i > 0 ? r->strands[i].first - 1 : r->steps->n - 1, first = r->strands[i].first;
    if (is_closed(&steps[last], &steps[first])) return true;
    Vec2 from = wide_point_round(steps[last].p), to = wide_point_round(steps[first].p);
    double gap = fmax(fabs(to.x - from.x), fabs(to.y - from.y));
    if (gap <= TRIM_SILENT) from = to = vec2((from.x + to.x) / 2, (from.y + to.y) / 2);
    else if (gap > r->bridged->value) *r->bridged = (TrimFault){ gap, to };
    move_end(r->steps, &steps[last], &steps[last - 1], true, from);
    move_end(r->steps, &steps[first], &steps[first], false, to);
    if (gap <= TRIM_BRIDGE || length_in_space(r->in, from, to) <= TRIM_BRIDGE_SPACE) return true;
    r->error->curve = r->strands[i].curve;
    return refuse(r, NURBS_TRIM_OPEN, r->strands[i].curve, to, gap);
}

static bool close_joints(Reader *r)
{
    for (size_t i = 0; i < r->n_strands; i++) {
        if (!close_joint(r, i)) return false;
    }
    return true;
}

bool trim_steps_read(Arena *a, const TrimInput *in, int index, TrimSteps *out, TrimFault *bridged, NurbsError *error)
{
    Reader r = { .arena = a, .in = in, .desc = &in->loops[index], .steps = out, .bridged = bridged, .error = error };
    return r.desc->is_polyline ? read_polyline(&r) : read_curves(&r) && close_joints(&r);
}
