/* B-spline curves in the parameter plane: their spans as Bézier segments. See trim_curve.h. */
#include "nurbs/trim_curve.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"

/* Weights below this part of the segment's greatest are raised to it: so far apart they act alike, and their quotients must
 * stay finite. */
#define LEAST_WEIGHT 0x1p-500

Vec2 trim_to_unit(const TrimRect *d, Vec2 p)
{
    return vec2((p.x - d->u0) / (d->u1 - d->u0), (p.y - d->v0) / (d->v1 - d->v0));
}

Vec2 trim_from_unit(const TrimRect *d, Vec2 p)
{
    return vec2((1 - p.x) * d->u0 + p.x * d->u1, (1 - p.y) * d->v0 + p.y * d->v1);
}

static Wide to_unit(double from, double to, double x)
{
    Wide q = wide_div(wide_sum(x, -from), wide_sum(to, -from));
    return isfinite(q.lo) ? q : wide((x - from) / (to - from));     /* a domain as wide as all doubles */
}

WidePoint trim_to_unit_wide(const TrimRect *d, Vec2 p)
{
    return (WidePoint){ to_unit(d->u0, d->u1, p.x), to_unit(d->v0, d->v1, p.y) };
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

void trim_curve_segment(const TrimCurveDesc *c, const TrimRect *domain, int s, WideControl out[])
{
    int k = c->order, exponent;
    const Vec3 *given = c->points + (s - k + 1);
    double w_max = 0;
    for (int i = 0; i < k; i++) w_max = fmax(w_max, given[i].z);
    (void)frexp(w_max, &exponent);
    for (int i = 0; i < k; i++) {
        WidePoint q = trim_to_unit_wide(domain, vec2(given[i].x, given[i].y));
        Wide w = wide(fmax(ldexp(given[i].z, -exponent), LEAST_WEIGHT));
        out[i] = (WideControl){ wide_mul(w, q.x), wide_mul(w, q.y), w };
    }
    bezier_from_span_wide(k, c->knots, s, sizeof *out / sizeof(Wide), &out->x);
}
