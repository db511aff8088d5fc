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

EVERY_X86
void patch_evaluate(const Patch *p, double s, double t, Vec4 *value, Vec4 *by_s, Vec4 *by_t)
{
    PatchPoint at = kernel_evaluate(p, s, t);
    v4_store(value, at.value), v4_store(by_s, at.by_s), v4_store(by_t, at.by_t);
}

/* The points about the patch's own middle. One rounding a coordinate: fma(-w, o, wx). */
EVERY_X86
void patch_move_origin(Patch *p, Vec4 *points)
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

/* Are the points of a side, n of them `step` apart, one point within the rounding? */
static bool is_collapsed(const Patch *p, const Vec4 *side, int n, int step)
{
    Vec3 first = vec4_project(side[0]);
    for (int i = 1; i < n; i++)
        if (vec_length(vec_sub(vec4_project(side[i * step]), first)) > p->rounding) return false;
    return true;
}

static unsigned collapsed_sides(const Patch *p)
{
    int k_u = p->k_u, k_v = p->k_v;
    return (unsigned)is_collapsed(p, p->p, k_v, k_u) | (unsigned)is_collapsed(p, p->p + k_u - 1, k_v, k_u) << 1
        | (unsigned)is_collapsed(p, p->p, k_u, 1) << 2 | (unsigned)is_collapsed(p, p->p + (k_v - 1) * k_u, k_u, 1) << 3;
}

void patch_make(Arena *a, int k_u, int k_v, const Vec4 *points, double rounding, TrimRect interval, Patch *out)
{
    *out = (Patch){ .k_u = k_u, .k_v = k_v, .u0 = interval.u0, .u1 = interval.u1, .v0 = interval.v0, .v1 = interval.v1,
                    .rounding = rounding, .is_polynomial = true };
    for (int i = 0; i < k_u * k_v; i++) {
        out->w_max = double_max(out->w_max, points[i].w);
        out->is_polynomial = out->is_polynomial && points[i].w == 1;
    }
    patch_move_origin(out, arena_copy(a, points, (size_t)(k_u * k_v), sizeof *points));
    for (int i = 0; i < k_u * k_v; i++) out->radius = double_max(out->radius, vec_length(vec4_project(out->p[i])));
    out->radius *= 1 + 16 * DBL_EPSILON;    /* the rounding of the bound itself */
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
