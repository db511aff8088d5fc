/* Where in a box its roots can be. See view_narrow in view.h.
 *
 * Bernstein coefficients bound what they belong to: over the interval of one parameter, by the convex hull of the points
 * (i / (k-1), coefficient i), whatever the other parameter is. So a combination g of the two plane equations has no zero
 * outside the interval where that hull meets zero. Which combination is good depends on the box: the rows of the inverse of
 * its mean Jacobian, if it has one, else the two along and across the needle that its image is. */
#include "nurbs/view.h"

#include "nurbs/nurbs.h"

#include <float.h>
#include <math.h>

/* Where the convex hull of the points (i / (k-1), lo_i) and (i / (k-1), hi_i) meets zero, as an interval of [0, 1]; empty:
 * lo > hi. Its ends lie on segments from a point above to one below; the ones that start at the lower of two points above,
 * or end at the upper of two below, reach furthest. */
static Range hull_meets_zero(const double *lo, const double *hi, int k)
{
    Range x = { INFINITY, -INFINITY };
    for (int i = 0; i < k; i++) {
        double x_i = (double)i / (k - 1);
        if (lo[i] <= 0 && hi[i] >= 0) x.lo = double_min(x.lo, x_i), x.hi = double_max(x.hi, x_i);
        if (!(hi[i] > 0)) continue;
        double above = lo[i] > 0 ? lo[i] : hi[i];
        for (int j = 0; j < k; j++) {
            if (!(lo[j] < 0)) continue;
            double below = hi[j] < 0 ? hi[j] : lo[j], step = (double)(j - i) / (k - 1);
            double ends[4] = { above / (above - below), above / (above - lo[j]), hi[i] / (hi[i] - below),
                               hi[i] / (hi[i] - lo[j]) };
            for (int m = 0; m < 4; m++) {
                double at = x_i + step * ends[m];
                x.lo = double_min(x.lo, at), x.hi = double_max(x.hi, at);
            }
        }
    }
    return x;
}

/* Roundings of an end of such an interval, of numbers up to 1: of i and of a step over k - 1, a difference, a quotient, a
 * product and a sum are six of these eight. */
#define END_ERROR (4 * DBL_EPSILON)

/* The part of [0, 1] along s (or t) outside which g has no zero, if it is within `error` of what it should be. */
static Range zeros_along(const View *v, const double *g, double error, bool along_s)
{
    int k_u = v->k_u, k_v = v->k_v, n = along_s ? k_u : k_v;
    double lo[NURBS_MAX_ORDER], hi[NURBS_MAX_ORDER];
    for (int i = 0; i < n; i++) lo[i] = INFINITY, hi[i] = -INFINITY;
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i < k_u; i++) {
            int at = along_s ? i : j;
            double x = g[j * k_u + i];
            lo[at] = double_min(lo[at], x), hi[at] = double_max(hi[at], x);
        }
    for (int i = 0; i < n; i++) lo[i] -= error, hi[i] += error;
    Range r = hull_meets_zero(lo, hi, n);
    return (Range){ double_max(0, r.lo - END_ERROR), double_min(1, r.hi + END_ERROR) };
}

/* Largest distance of the derivative coefficients of g from (by_s, by_t), the sum of both. */
static double derivative_spread(const View *v, const double *g, double by_s, double by_t)
{
    int k_u = v->k_u, k_v = v->k_v;
    double spread_s = 0, spread_t = 0;
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i + 1 < k_u; i++)
            spread_s = double_max(spread_s, fabs((k_u - 1) * (g[j * k_u + i + 1] - g[j * k_u + i]) - by_s));
    for (int j = 0; j + 1 < k_v; j++)
        for (int i = 0; i < k_u; i++)
            spread_t = double_max(spread_t, fabs((k_v - 1) * (g[(j + 1) * k_u + i] - g[j * k_u + i]) - by_t));
    return spread_s + spread_t;
}

/* g = m1 x + m2 y. The error of (x, y) is that of a point in space, seen along two perpendicular directions: its length is
 * within `error`, so that of g is within error * hypot(m1, m2). (Its own three roundings of (x, y) are in it: patch_rounding
 * has those of evaluating a patch, which no coefficient of a box needs.) */
typedef struct { double *value, error; } Combination;

static Combination combine(const View *v, double m1, double m2, double error, Arena *scratch)
{
    Combination g = { ARENA_ARRAY(scratch, double, v->k_u * v->k_v), error * hypot(m1, m2) };
    for (int i = 0; i < v->k_u * v->k_v; i++) g.value[i] = m1 * v->p[i].x + m2 * v->p[i].y;
    return g;
}

/* The mean Jacobian over the box: the difference quotients of its sides. */
typedef struct {
    double x_s, x_t, y_s, y_t, det;
    double longer;           /* of its columns */
    double share;            /* the determinant in shares of |column| |column| */
} Mean;

static Mean mean_jacobian(const View *v)
{
    int k_u = v->k_u, k_v = v->k_v;
    Mean m = { .det = 0 };
    for (int j = 0; j < k_v; j++) {
        const Vec4 *row = v->p + j * k_u;
        m.x_s += row[k_u - 1].x - row[0].x, m.y_s += row[k_u - 1].y - row[0].y;
    }
    for (int i = 0; i < k_u; i++) {
        const Vec4 *column = v->p + i, *end = column + (k_v - 1) * k_u;
        m.x_t += end->x - column->x, m.y_t += end->y - column->y;
    }
    m.x_s /= k_v, m.y_s /= k_v, m.x_t /= k_u, m.y_t /= k_u;
    double along_s = hypot(m.x_s, m.y_s), along_t = hypot(m.x_t, m.y_t);
    m.det = m.x_s * m.y_t - m.x_t * m.y_s;
    m.longer = double_max(along_s, along_t), m.share = fabs(m.det) / (along_s * along_t);
    return m;
}

/* What the error of coefficients makes of that of a difference quotient of them, both directions together. */
static double error_of_slopes(const View *v) { return 2 * (v->k_u + v->k_v - 2); }

/* |I - A J| < 1 in the maximum norm proves that there is one root at most, A the inverse of the mean Jacobian: it holds if
 * it holds for the coefficients of A J. */
static bool is_contraction(const View *v, Combination g1, Combination g2)
{
    double slopes = error_of_slopes(v);
    return derivative_spread(v, g1.value, 1, 0) + slopes * g1.error < CONTRACTION
        && derivative_spread(v, g2.value, 0, 1) + slopes * g2.error < CONTRACTION;
}

/* A slanted box has its columns at an angle whose sine is less than this. The rounding of its plane equations then is much
 * more along its sides, and boxes as small as that prove nothing: it is not narrowed so far, but kept so wide that errors
 * take a quarter of what the contraction may have. (A box that is not slanted is soon too small to be told from the ray.) */
#define SLANTED 0x1p-4
#define SHARE_OF_ERROR 0.25

static double least_width(const View *v, double error) { return error_of_slopes(v) * error / SHARE_OF_ERROR; }

static Range widen(Range r, double width)
{
    double by = 0.5 * (width - (r.hi - r.lo));
    return r.lo > r.hi || by <= 0 ? r : (Range){ double_max(0, r.lo - by), double_min(1, r.hi + by) };
}

static ViewPart narrow_by_inverse(const View *v, const Mean *m, double error, Arena *scratch, bool *is_certified)
{
    Combination g1 = combine(v, m->y_t / m->det, -m->x_t / m->det, error, scratch);
    Combination g2 = combine(v, -m->y_s / m->det, m->x_s / m->det, error, scratch);
    *is_certified = *is_certified || is_contraction(v, g1, g2);
    ViewPart part = { zeros_along(v, g1.value, g1.error, true), zeros_along(v, g2.value, g2.error, false) };
    if (*is_certified || m->share > SLANTED) return part;
    return (ViewPart){ widen(part.s, least_width(v, g1.error)), widen(part.t, least_width(v, g2.error)) };
}

static Range meet(Range a, Range b) { return (Range){ double_max(a.lo, b.lo), double_min(a.hi, b.hi) }; }

static ViewPart meet_parts(ViewPart a, ViewPart b) { return (ViewPart){ meet(a.s, b.s), meet(a.t, b.t) }; }

static ViewPart narrow_by(const View *v, Combination g)
{
    return (ViewPart){ zeros_along(v, g.value, g.error, true), zeros_along(v, g.value, g.error, false) };
}

static double largest(const View *v, Combination g)
{
    double most = 0;
    for (int i = 0; i < v->k_u * v->k_v; i++) most = double_max(most, fabs(g.value[i]));
    return most;
}

/* Differences of neighbours, k - 1 of them in a line: do all grow, or all fall, or are all together within the error? */
static bool is_one_way(Range by, int k, double error)
{
    return by.lo > 0 || by.hi < 0 || (k - 1) * double_max(by.hi, -by.lo) <= error;
}

/* Is g zero on one curve at most, that does not leave the box and come back? So it is if it grows or falls all over the box
 * both with s and with t. */
static bool is_monotone(const View *v, Combination g)
{
    Range by_s = { INFINITY, -INFINITY }, by_t = { INFINITY, -INFINITY };
    for (int j = 0; j < v->k_v; j++)
        for (int i = 0; i < v->k_u; i++) {
            const double *at = g.value + j * v->k_u + i;
            if (i + 1 < v->k_u) by_s.lo = double_min(by_s.lo, at[1] - at[0]), by_s.hi = double_max(by_s.hi, at[1] - at[0]);
            if (j + 1 == v->k_v) continue;
            double t = at[v->k_u] - at[0];
            by_t.lo = double_min(by_t.lo, t), by_t.hi = double_max(by_t.hi, t);
        }
    return is_one_way(by_s, v->k_u, g.error) && is_one_way(by_t, v->k_v, g.error);
}

/* Where the Jacobian has no inverse to speak of, the box's image is a needle: (x, y) is turned so that one component runs
 * along it and the other across, which shows at once whether the needle passes zero. A turn does not enlarge the error. */
static ViewPart narrow_by_turning(const View *v, const Mean *m, double error, Arena *scratch, double *across)
{
    double xx = m->x_s * m->x_s + m->x_t * m->x_t, yy = m->y_s * m->y_s + m->y_t * m->y_t;
    Vec2 axis = vec2_longer_axis(xx, m->x_s * m->y_s + m->x_t * m->y_t, yy);
    Combination along = combine(v, axis.x, axis.y, error, scratch), beside = combine(v, -axis.y, axis.x, error, scratch);
    if (is_monotone(v, along)) *across = largest(v, beside);
    return meet_parts(narrow_by(v, along), narrow_by(v, beside));
}

/* Below this share the determinant is mostly rounding, and there is no inverse: it is computed with some 2^-50, which
 * leaves four bits. */
#define NO_INVERSE 0x1p-46

/* Below this share, or if it is so thin that errors keep it from being certified, a box is a needle: it is turned, too. That
 * costs twice as much as the inverse, and rarely takes anything off other boxes. */
#define NEEDLE 0x1p-16

static bool is_needle(const View *v, const Mean *m, double error)
{
    return !(m->share > NEEDLE) || fabs(m->det) <= m->longer * least_width(v, error);
}

ViewPart view_narrow(const View *v, double error, Arena *scratch, bool *is_certified, double *across)
{
    Mean m = mean_jacobian(v);
    ViewPart part = { { 0, 1 }, { 0, 1 } };
    ArenaMark mark = arena_mark(scratch);
    *across = INFINITY;
    if (m.share > NO_INVERSE && isfinite(1 / m.det)) part = narrow_by_inverse(v, &m, error, scratch, is_certified);
    if (!*is_certified && is_needle(v, &m, error))
        part = meet_parts(part, narrow_by_turning(v, &m, error, scratch, across));
    arena_reset(scratch, mark);
    return part;
}
