/* See patch.h. */
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

/* Of a Bernstein polynomial, relative to itself (1 - x is one; in kernel_bernstein 1, 3 and 5 at most for orders 2, 3 and 4;
 * else three for each order below); of its product with a point; and k - 1 of the sum. Fused, there are fewer. */
static int roundings_of_order(int k) { return (k <= 4 ? 2 * k - 3 : 3 * (k - 1)) + k; }

EVERY_X86
void patch_evaluate(const Patch *p, double s, double t, Vec4 *value, Vec4 *by_s, Vec4 *by_t)
{
    PatchPoint at = kernel_evaluate(p, s, t);
    v4_store(value, at.value), v4_store(by_s, at.by_s), v4_store(by_t, at.by_t);
}

EVERY_X86
static void move_points(Vec4 *p, int n, Vec3 to)
{
    for (int i = 0; i < n; i++) p[i] = patch_point_about(p[i], to);
}

void patch_move_origin(Patch *p, WideNet net)
{
    Vec4 value, by_s, by_t;
    int n = p->k_u * p->k_v;
    p->p = net.hi;
    patch_evaluate(p, 0.5, 0.5, &value, &by_s, &by_t);
    p->origin = vec4_project(value);
    if (net.lo) wide_net_move(net, (size_t)n, p->origin);
    else move_points(net.hi, n, p->origin);
}

/* That of the radius: 4 for a quotient and its square, 4 for the sum and its root. */
#define RADIUS_ROUNDINGS 8

/* Sets the radius, and what the rounding of the coordinates that are stored adds to the error. Each errs by u of itself, so
 * that of a point is u of its length, and that of all their convex combinations u of the radius; so is what they are divided
 * by, if it is not 1. */
static void measure(Patch *p)
{
    const double u = 0.5 * DBL_EPSILON;
    for (int i = 0; i < p->k_u * p->k_v; i++) p->radius = double_max(p->radius, vec_length(vec4_project(p->p[i])));
    p->radius *= 1 + 2 * RADIUS_ROUNDINGS * u;
    p->rounding += (p->is_polynomial ? 1 : 2) * u * p->radius;
}

/* Are the points of a side, n of them `step` apart, one point within the rounding of each? */
static bool is_collapsed(const Patch *p, const Vec4 *side, int n, int step)
{
    Vec3 first = vec4_project(side[0]);
    for (int i = 1; i < n; i++)
        if (vec_length(vec_sub(vec4_project(side[i * step]), first)) > 2 * p->rounding) return false;
    return true;
}

static unsigned char collapsed_sides(const Patch *p)
{
    int k_u = p->k_u, k_v = p->k_v;
    return (unsigned char)(is_collapsed(p, p->p, k_v, k_u) | is_collapsed(p, p->p + k_u - 1, k_v, k_u) << 1
        | is_collapsed(p, p->p, k_u, 1) << 2 | is_collapsed(p, p->p + (k_v - 1) * k_u, k_u, 1) << 3);
}

void patch_make(Arena *a, int k_u, int k_v, WideNet net, double error, TrimRect interval, Patch *out)
{
    *out = (Patch){ .k_u = k_u, .k_v = k_v, .u0 = interval.u0, .u1 = interval.u1, .v0 = interval.v0, .v1 = interval.v1,
                    .rounding = error, .roundings = (float)(roundings_of_order(k_u) + roundings_of_order(k_v)),
                    .is_polynomial = true };
    double w_max = 0;
    for (int i = 0; i < k_u * k_v; i++) {
        w_max = double_max(w_max, net.hi[i].w);
        out->is_polynomial = out->is_polynomial && net.hi[i].w == 1;
    }
    out->w_max = float_up(w_max);
    patch_move_origin(out, net);
    out->p = arena_copy(a, net.hi, (size_t)(k_u * k_v), sizeof *net.hi);
    measure(out);
    out->growth = float_up(pow(1 + 2 * PATCH_MARGIN, k_u + k_v - 2));
    out->collapsed = collapsed_sides(out);
}

static Vec3 xyz(Vec4 p) { return vec(p.x, p.y, p.z); }

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
