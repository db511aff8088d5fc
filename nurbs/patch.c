/* See patch.h. */
#include "nurbs/patch.h"

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
}

static Vec3 xyz(Vec4 p) { return vec(p.x, p.y, p.z); }

/* S_s x S_t from the homogeneous derivatives, and whether its direction means something: half of the bits are asked for. */
static bool normal_at(const Patch *p, double s, double t, Vec3 *normal)
{
    Vec4 value, by_s, by_t;
    patch_evaluate(p, s, t, &value, &by_s, &by_t);
    Vec3 at = vec4_project(value);
    Vec3 s_s = vec_sub(xyz(by_s), vec_scale(at, by_s.w)), s_t = vec_sub(xyz(by_t), vec_scale(at, by_t.w));
    *normal = vec_cross(s_s, s_t);
    double along_s = vec_length(s_s), along_t = vec_length(s_t), lost = 0x1p-26 * p->radius * value.w;
    return along_s > lost && along_t > lost && vec_length(*normal) > 0x1p-26 * along_s * along_t;
}

Vec3 patch_normal(const Patch *p, double s, double t)
{
    Vec3 normal = { 0, 0, 0 };
    for (double inwards = 0; inwards <= 1; inwards = inwards > 0 ? inwards * 16 : 0x1p-20)
        if (normal_at(p, s + inwards * (0.5 - s), t + inwards * (0.5 - t), &normal)) break;
    return vec_normalize(normal);
}
