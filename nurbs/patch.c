/* Bézier leaves and their frames: bounds that are computed once, so that a ray is decided by some forty operations.
 *
 * deviation   bounds the distance between the patch and the parallelogram of its derivatives at the middle. With L the
 *             parallelogram's map, w (S - L) is a polynomial of one degree more in s and in t; its Bernstein coefficients
 *             bound it ([Far02] convex hull property), the least weight bounds w.
 * variation   bounds how far the Jacobian of a ray's two plane equations moves from the one at the middle (see
 * certify.c). */
#include "nurbs/patch.h"

#include "nurbs/normal.h"
#include "nurbs/patch_kernel.h"

#include <float.h>
#include <math.h>

void bernstein(int k, double x, double b[], double d[])
{
    double y = 1 - x;
    b[0] = 1, d[0] = 0;
    for (int n = 1; n < k; n++) {   /* from order n to order n + 1 */
        if (n == k - 1)             /* the derivative comes from the order below */
            for (int i = 0; i < k; i++)
                d[i] = (k - 1) * ((i > 0 ? b[i - 1] : 0) - (i < k - 1 ? b[i] : 0));
        double carried = 0;
        for (int i = 0; i < n; i++) {
            double old = b[i];
            b[i] = carried + y * old;
            carried = x * old;
        }
        b[n] = carried;
    }
}

EVERY_X86
void patch_evaluate(const Patch *p, double s, double t, Vec4 *value, Vec4 *by_s, Vec4 *by_t)
{
    PatchPoint at = kernel_evaluate(p, s, t);
    v4_store(value, at.value), v4_store(by_s, at.by_s), v4_store(by_t, at.by_t);
}

static Vec3 xyz(Vec4 p) { return vec(p.x, p.y, p.z); }

/* One row of k points, `stride` apart, on the interval [x0, x1] of its own [0, 1] (which may reach beyond): de Casteljau at
 * x1, keeping the left part, then at x0/x1, keeping the right one. */
static void row_restrict(Vec4 *p, int k, int stride, double x0, double x1)
{
    for (int n = 1; n < k; n++)
        for (int i = k - 1; i >= n; i--)
            p[i * stride] = vec4_lerp(p[(i - 1) * stride], p[i * stride], x1);
    double x = x0 / x1;
    for (int n = 1; n < k; n++)
        for (int i = 0; i < k - n; i++)
            p[i * stride] = vec4_lerp(p[i * stride], p[(i + 1) * stride], x);
}

/* The net on [-margin, 1 + margin] squared. */
static void net_with_margin(const Patch *p, Vec4 *out)
{
    for (int i = 0; i < p->k_u * p->k_v; i++) out[i] = p->p[i];
    for (int j = 0; j < p->k_v; j++) row_restrict(out + j * p->k_u, p->k_u, 1, -PATCH_MARGIN, 1 + PATCH_MARGIN);
    for (int i = 0; i < p->k_u; i++) row_restrict(out + i, p->k_v, p->k_u, -PATCH_MARGIN, 1 + PATCH_MARGIN);
}

/* Largest distance of the Bernstein coefficients of a derivative of the net from `middle`, and of its weight from 0. step is
 * the distance of neighbours along the derivative's direction, scale the degree over the interval's length. */
static void derivative_spread(const Patch *p, const Vec4 *net, int step, double scale, Vec3 middle,
                              double *spread, double *w_spread)
{
    int n_i = step == 1 ? p->k_u - 1 : p->k_u, n_j = step == 1 ? p->k_v : p->k_v - 1;
    *spread = *w_spread = 0;
    for (int j = 0; j < n_j; j++)
        for (int i = 0; i < n_i; i++) {
            const Vec4 *q = net + j * p->k_u + i;
            Vec4 d = vec4_scale(vec4_sub(q[step], q[0]), scale);
            *spread = double_max(*spread, vec_length(vec_sub(xyz(d), middle)));
            *w_spread = double_max(*w_spread, fabs(d.w));
        }
}

/* Sets radius (with the margin) and variation. */
static void bound_variation(Arena *scratch, Patch *p, Vec3 by_s, Vec3 by_t)
{
    int n = p->k_u * p->k_v;
    Vec4 *net = ARENA_ARRAY(scratch, Vec4, n);
    net_with_margin(p, net);
    double radius = 0;
    bool is_positive = true;
    for (int i = 0; i < n; i++) {
        is_positive = is_positive && net[i].w > 0;   /* extrapolated weights may not be: then the margin proves nothing */
        radius = double_max(radius, double_max(vec_length(vec4_project(net[i])), vec_length(vec4_project(p->p[i]))));
    }
    if (!is_positive) {
        radius = 0;
        for (int i = 0; i < n; i++) radius = double_max(radius, vec_length(vec4_project(p->p[i])));
    }
    p->radius = radius * (1 + 16 * DBL_EPSILON);
    double length = 1 + 2 * PATCH_MARGIN, spread_s, spread_t, w_s, w_t;
    derivative_spread(p, net, 1, (p->k_u - 1) / length, by_s, &spread_s, &w_s);
    derivative_spread(p, net, p->k_u, (p->k_v - 1) / length, by_t, &spread_t, &w_t);
    double r_s = (spread_s + p->radius * w_s) / vec_length(by_s), r_t = (spread_t + p->radius * w_t) / vec_length(by_t);
    p->variation = is_positive ? hypot(r_s, r_t) * (1 + 1e-9) : INFINITY;
    if (!(p->variation >= 0)) p->variation = INFINITY;
}

/* Coefficient (i, j) of a tensor product polynomial times (u0 (1-s) + u1 s) (v0 (1-t) + v1 t), one order more in both: the
 * Bernstein product formula, [Far02]. Points have four components; those beyond the net count as zero. */
static Vec4 product_coefficient(const Patch *p, int i, int j, double u0, double u1, double v0, double v1)
{
    Vec4 sum = { 0 };
    for (int b = 0; b < 2; b++)
        for (int a = 0; a < 2; a++) {
            int ii = i - a, jj = j - b;
            if (ii < 0 || ii >= p->k_u || jj < 0 || jj >= p->k_v) continue;
            double f = a ? i * u1 : (p->k_u - i) * u0, g = b ? j * v1 : (p->k_v - j) * v0;
            sum = vec4_add(sum, vec4_scale(p->p[jj * p->k_u + ii], f * g));
        }
    return vec4_scale(sum, 1.0 / (p->k_u * p->k_v));
}

/* With equal weights S - L itself has the order of S: L's coefficients are its values at the Greville abscissae. */
static double polynomial_deviation(const Patch *p, Vec3 half_s, Vec3 half_t)
{
    double most2 = 0;
    for (int j = 0; j < p->k_v; j++) {
        Vec3 row = vec_scale(half_t, 2.0 * j / (p->k_v - 1) - 1);
        for (int i = 0; i < p->k_u; i++) {
            Vec3 at = vec_add(row, vec_scale(half_s, 2.0 * i / (p->k_u - 1) - 1));
            most2 = double_max(most2, vec_length2(vec_sub(xyz(p->p[j * p->k_u + i]), at)));
        }
    }
    return sqrt(most2);
}

/* The Bernstein coefficients of w (S - L), of order k_u + 1 by k_v + 1, over the least weight. */
static double rational_deviation(const Patch *p, Vec3 half_s, Vec3 half_t)
{
    double most = 0, w_min = INFINITY;
    for (int i = 0; i < p->k_u * p->k_v; i++) w_min = double_min(w_min, p->p[i].w);
    for (int j = 0; j <= p->k_v; j++)
        for (int i = 0; i <= p->k_u; i++) {
            Vec3 r = xyz(product_coefficient(p, i, j, 1, 1, 1, 1));
            r = vec_sub(r, vec_scale(half_s, product_coefficient(p, i, j, -1, 1, 1, 1).w));   /* w (2s - 1) half_s */
            r = vec_sub(r, vec_scale(half_t, product_coefficient(p, i, j, 1, 1, -1, 1).w));
            most = double_max(most, vec_length(r));
        }
    return most / w_min;
}

/* The frame from the derivatives at the middle. */
static void make_frame(Arena *scratch, Patch *p)
{
    Vec4 value, by_s, by_t;
    patch_evaluate(p, 0.5, 0.5, &value, &by_s, &by_t);
    Vec3 centre = vec4_project(value);   /* zero but for rounding */
    p->w_middle = value.w;
    Vec3 s_s = vec_scale(vec_sub(xyz(by_s), vec_scale(centre, by_s.w)), 1 / value.w);
    Vec3 s_t = vec_scale(vec_sub(xyz(by_t), vec_scale(centre, by_t.w)), 1 / value.w);
    bound_variation(scratch, p, xyz(by_s), xyz(by_t));
    p->half_u = vec_length(s_s) / 2, p->half_v = vec_length(s_t) / 2;
    p->e_u = vec_normalize(s_s), p->e_v = vec_normalize(s_t);
    p->has_frame = p->half_u > 0 && p->half_v > 0 && isfinite(p->variation);
    Vec3 half_s = vec_scale(s_s, 0.5), half_t = vec_scale(s_t, 0.5);
    p->deviation = p->is_polynomial ? polynomial_deviation(p, half_s, half_t) : rational_deviation(p, half_s, half_t);
    p->deviation *= 1 + 1e-9;   /* the rounding of the bound itself */
}

/* The points about the patch's own middle. One rounding a coordinate: fma(-w, o, wx). */
static void move_origin(Patch *p, Vec4 *points)
{
    Vec4 value, by_s, by_t;
    p->p = points;
    patch_evaluate(p, 0.5, 0.5, &value, &by_s, &by_t);
    Vec3 o = p->origin = vec4_project(value);
    for (int i = 0; i < p->k_u * p->k_v; i++) {
        Vec4 *q = &points[i];
        q->x = fma(-q->w, o.x, q->x), q->y = fma(-q->w, o.y, q->y), q->z = fma(-q->w, o.z, q->z);
    }
}

void patch_make(Arena *a, int k_u, int k_v, const Vec4 *points, double rounding, TrimRect interval, Patch *out)
{
    *out = (Patch){ .k_u = k_u, .k_v = k_v, .u0 = interval.u0, .u1 = interval.u1, .v0 = interval.v0, .v1 = interval.v1,
                    .rounding = rounding, .is_polynomial = true };
    for (int i = 0; i < k_u * k_v; i++) {
        out->w_max = double_max(out->w_max, points[i].w);
        out->is_polynomial = out->is_polynomial && points[i].w == 1;
    }
    move_origin(out, arena_copy(a, points, (size_t)(k_u * k_v), sizeof *points));
    ArenaMark mark = arena_mark(a);
    make_frame(a, out);
    arena_reset(a, mark);
}

/* ---- is it worth a frame? ---- */

/* The longest second difference of the net: steps of a and b points. */
static double longest_difference(const Patch *p, double radius, int a, int b, int n_i, int n_j)
{
    double most = 0;
    for (int j = 0; j < n_j; j++)
        for (int i = 0; i < n_i; i++) {
            const Vec4 *q = p->p + j * p->k_u + i;
            Vec4 d = vec4_sub(vec4_sub(q[a + b], q[a]), vec4_sub(q[b], q[0]));
            most = double_max(most, vec_length(xyz(d)) + radius * fabs(d.w));
        }
    return most;
}

/* The derivatives change by at most their own derivatives' coefficients, times half the interval. */
PatchBend patch_bend(int k_u, int k_v, const Vec4 *points)
{
    Vec4 own[NURBS_MAX_ORDER * NURBS_MAX_ORDER], value, by_s, by_t;
    Patch p = { .k_u = k_u, .k_v = k_v };
    for (int i = 0; i < k_u * k_v; i++) own[i] = points[i];
    move_origin(&p, own);
    patch_evaluate(&p, 0.5, 0.5, &value, &by_s, &by_t);
    double length_s = vec_length(xyz(by_s)), length_t = vec_length(xyz(by_t)), radius = length_s + length_t;
    int m = k_u - 1, n = k_v - 1;
    double ss = m * (m - 1) * longest_difference(&p, radius, 1, 1, k_u - 2, k_v);
    double tt = n * (n - 1) * longest_difference(&p, radius, k_u, k_u, k_u, k_v - 2);
    double st = m * n * longest_difference(&p, radius, 1, k_u, k_u - 1, k_v - 1);
    return (PatchBend){ .variation = 0.5 * hypot((ss + st) / length_s, (st + tt) / length_t),
                        .along_u = ss / length_s + st / length_t, .along_v = tt / length_t + st / length_s };
}

typedef struct { const Patch *p; double s, t; } Way;

/* From the homogeneous derivatives: w S_s = H_s - w_s S. */
static NormalTangents tangents_at(const void *context, double inwards)
{
    const Way *k = context;
    double s = k->s + inwards * (0.5 - k->s), t = k->t + inwards * (0.5 - k->t);
    Vec4 value, by_s, by_t;
    patch_evaluate(k->p, s, t, &value, &by_s, &by_t);
    Vec3 at = vec4_project(value);
    return (NormalTangents){ vec_scale(vec_sub(xyz(by_s), vec_scale(at, by_s.w)), 1 / value.w),
                             vec_scale(vec_sub(xyz(by_t), vec_scale(at, by_t.w)), 1 / value.w) };
}

Vec3 patch_normal(const Patch *p, double s, double t, Vec3 towards)
{
    return normal_limit(tangents_at, &(Way){ p, s, t }, p->radius, towards);
}
