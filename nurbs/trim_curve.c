/* B-spline curves in the parameter plane, made points: spans become Bézier segments, and these are halved until their
 * control points lie on the chord. See trim_curve.h. */
#include "nurbs/trim_curve.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "nurbs/trim_chain.h"

/* Weights below this part of the segment's greatest are raised to it: so far apart they act alike, and their quotients must
 * stay finite. */
#define LEAST_WEIGHT 0x1p-500

/* Halving a parameter more often than a double has bits yields nothing new. */
#define MAX_HALVINGS 52

Vec2 trim_to_unit(const TrimRect *d, Vec2 p)
{
    return vec2((p.x - d->u0) / (d->u1 - d->u0), (p.y - d->v0) / (d->v1 - d->v0));
}

Vec2 trim_from_unit(const TrimRect *d, Vec2 p)
{
    return vec2((1 - p.x) * d->u0 + p.x * d->u1, (1 - p.y) * d->v0 + p.y * d->v1);
}

void trim_points_add(Arena *a, TrimPoints *list, Vec2 p)
{
    ARENA_PUSH(a, list->p, list->n, list->capacity) = p;
}

static bool refuse(NurbsError *error, NurbsCode code, int index, int other, double value)
{
    error->code = code, error->index = index, error->other = other, error->value = value;
    return false;
}

bool trim_curve_is_valid(const TrimCurveDesc *c, NurbsError *error)
{
    if (c->order < NURBS_MIN_ORDER || c->order > NURBS_MAX_ORDER) {
        return refuse(error, NURBS_BAD_ORDER, error->curve, c->order, c->order);
    }
    if (c->n < c->order) return refuse(error, NURBS_TOO_FEW_POINTS, error->curve, c->order, c->n);
    for (int i = 0; i < c->n; i++) {
        Vec3 p = c->points[i];
        if (!isfinite(p.x)) return refuse(error, NURBS_POINT_NOT_FINITE, i, 0, p.x);
        if (!isfinite(p.y)) return refuse(error, NURBS_POINT_NOT_FINITE, i, 1, p.y);
        if (!(p.z > 0 && isfinite(p.z))) return refuse(error, NURBS_BAD_WEIGHT, i, 0, p.z);
    }
    return knots_are_valid(c->order, c->n, c->knots, error);
}

int trim_curve_span(const TrimCurveDesc *c, int from)
{
    for (int s = from < c->order - 1 ? c->order - 1 : from; s < c->n; s++) {
        if (knots_is_span(c->knots, s)) return s;
    }
    return -1;
}

bool trim_curve_starts_at(const TrimCurveDesc *c, int s)
{
    return s == trim_curve_span(c, 0) || c->knots[s - c->order + 1] == c->knots[s];
}

void trim_curve_segment(const TrimCurveDesc *c, const TrimRect *domain, int s, Vec4 out[])
{
    int k = c->order;
    const Vec3 *given = c->points + (s - k + 1);
    double w_max = 0;
    for (int i = 0; i < k; i++) w_max = fmax(w_max, given[i].z);
    for (int i = 0; i < k; i++) {
        Vec2 q = trim_to_unit(domain, vec2(given[i].x, given[i].y));
        out[i] = vec4_weighted(vec4(q.x, q.y, 0, fmax(given[i].z / w_max, LEAST_WEIGHT)));
    }
    bezier_from_span(k, c->knots, s, 1, out);
}

static Vec2 project(Vec4 p) { return vec2(p.x / p.w, p.y / p.w); }

Vec2 trim_segment_start(const Vec4 segment[]) { return project(segment[0]); }

/* Is the hull on the chord, or so far on one side of the domain that the trim is an error anyway? */
static bool is_flat(int k, const Vec4 p[])
{
    const double far = 2 * TRIM_OUTSIDE;
    Vec2 a = project(p[0]), b = project(p[k - 1]), lo = a, hi = a;
    double worst = 0;
    for (int i = 1; i < k; i++) {
        Vec2 q = project(p[i]);
        worst = fmax(worst, vec2_length(vec2_sub(q, trim_piece_nearest(a, b, q))));
        lo = vec2(fmin(lo.x, q.x), fmin(lo.y, q.y)), hi = vec2(fmax(hi.x, q.x), fmax(hi.y, q.y));
    }
    return worst <= TRIM_CHORD || hi.x < -far || hi.y < -far || lo.x > 1 + far || lo.y > 1 + far;
}

static void flatten(Arena *a, int k, Vec4 p[], int halvings, TrimPoints *out)
{
    if (halvings < MAX_HALVINGS && !is_flat(k, p)) {
        Vec4 left[NURBS_MAX_ORDER];
        bezier_cut(k, 1, .5, p, left);
        flatten(a, k, left, halvings + 1, out);
        flatten(a, k, p, halvings + 1, out);
    } else {
        trim_points_add(a, out, project(p[k - 1]));
    }
}

void trim_segment_flatten(Arena *a, int k, Vec4 segment[], TrimPoints *out) { flatten(a, k, segment, 0, out); }
