/* A patch and its derivatives at eight places, one for each ray of a bunch: patch_kernel.h for lanes. */
#ifndef TRIMRAY_PATCH_BUNCH_H
#define TRIMRAY_PATCH_BUNCH_H

#include "nurbs/patch_kernel.h"
#include "render/bunch.h"

typedef struct { V8d x, y, z, w; } Vec4x8;
typedef struct { Vec4x8 value, by_s, by_t; } PatchPoints;

/* Beyond this order lanes are evaluated one by one. */
enum { BUNCH_MAX_ORDER = 4 };
static inline bool is_in_lanes(const Patch *p) { return p->k_u <= BUNCH_MAX_ORDER && p->k_v <= BUNCH_MAX_ORDER; }

/* As kernel_bernstein has them. */
ALWAYS_INLINE void bunch_bernstein(int k, V8d x, V8d b[], V8d d[])
{
    V8d y = 1 - x;
    if (k == 4) {
        V8d xx = x * x, yy = y * y, xy = x * y;
        b[0] = yy * y, b[1] = 3 * x * yy, b[2] = 3 * xx * y, b[3] = xx * x;
        d[0] = -3 * yy, d[1] = 3 * (yy - 2 * xy), d[2] = 3 * (2 * xy - xx), d[3] = 3 * xx;
    } else if (k == 3) {
        b[0] = y * y, b[1] = 2 * x * y, b[2] = x * x;
        d[0] = -2 * y, d[1] = 2 * (y - x), d[2] = 2 * x;
    } else {
        b[0] = y, b[1] = x;
        d[0] = v8d_splat(-1), d[1] = v8d_splat(1);
    }
}

ALWAYS_INLINE Vec4x8 point_times(const Vec4 *p, V8d b, bool has_weight)
{
    return (Vec4x8){ p->x * b, p->y * b, p->z * b, has_weight ? p->w * b : v8d_splat(0) };
}

ALWAYS_INLINE void add_point(Vec4x8 *sum, const Vec4 *p, V8d b, bool has_weight)
{
    sum->x += p->x * b, sum->y += p->y * b, sum->z += p->z * b;
    if (has_weight) sum->w += p->w * b;
}

ALWAYS_INLINE void add_row(Vec4x8 *sum, const Vec4x8 *row, V8d b, bool has_weight)
{
    sum->x += row->x * b, sum->y += row->y * b, sum->z += row->z * b;
    if (has_weight) sum->w += row->w * b;
}

/* The tensor product, of orders up to BUNCH_MAX_ORDER; for constant ones unrolled. The weight of a polynomial is 1. */
ALWAYS_INLINE PatchPoints bunch_blend(const Patch *p, int k_u, int k_v, bool has_weight, V8d s, V8d t)
{
    const V8d zero = v8d_splat(0);
    V8d bu[BUNCH_MAX_ORDER], du[BUNCH_MAX_ORDER], bv[BUNCH_MAX_ORDER], dv[BUNCH_MAX_ORDER];
    bunch_bernstein(k_u, s, bu, du);
    bunch_bernstein(k_v, t, bv, dv);
    PatchPoints out = { { zero, zero, zero, has_weight ? zero : v8d_splat(1) }, { zero, zero, zero, zero },
                        { zero, zero, zero, zero } };
    for (int j = 0; j < k_v; j++) {
        const Vec4 *row = p->p + j * k_u;
        Vec4x8 at = point_times(row, bu[0], has_weight), along = point_times(row, du[0], has_weight);
        for (int i = 1; i < k_u; i++) {
            add_point(&at, &row[i], bu[i], has_weight);
            add_point(&along, &row[i], du[i], has_weight);
        }
        add_row(&out.value, &at, bv[j], has_weight);
        add_row(&out.by_s, &along, bv[j], has_weight);
        add_row(&out.by_t, &at, dv[j], has_weight);
    }
    return out;
}

/* Points of eight lanes by their coordinates. */
ALWAYS_INLINE Vec4x8 in_lanes(const V4 p[])
{
    V8d ab = __builtin_shufflevector(p[0], p[1], 0, 1, 2, 3, 4, 5, 6, 7);
    V8d cd = __builtin_shufflevector(p[2], p[3], 0, 1, 2, 3, 4, 5, 6, 7);
    V8d ef = __builtin_shufflevector(p[4], p[5], 0, 1, 2, 3, 4, 5, 6, 7);
    V8d gh = __builtin_shufflevector(p[6], p[7], 0, 1, 2, 3, 4, 5, 6, 7);
    V8d xy = __builtin_shufflevector(ab, cd, 0, 4, 8, 12, 1, 5, 9, 13);
    V8d zw = __builtin_shufflevector(ab, cd, 2, 6, 10, 14, 3, 7, 11, 15);
    V8d xy2 = __builtin_shufflevector(ef, gh, 0, 4, 8, 12, 1, 5, 9, 13);
    V8d zw2 = __builtin_shufflevector(ef, gh, 2, 6, 10, 14, 3, 7, 11, 15);
    return (Vec4x8){ __builtin_shufflevector(xy, xy2, 0, 1, 2, 3, 8, 9, 10, 11),
                     __builtin_shufflevector(xy, xy2, 4, 5, 6, 7, 12, 13, 14, 15),
                     __builtin_shufflevector(zw, zw2, 0, 1, 2, 3, 8, 9, 10, 11),
                     __builtin_shufflevector(zw, zw2, 4, 5, 6, 7, 12, 13, 14, 15) };
}

typedef struct { V4 value[BUNCH_WIDTH], by_s[BUNCH_WIDTH], by_t[BUNCH_WIDTH]; } LanePoints;

ALWAYS_INLINE void set_lane(LanePoints *all, int i, PatchPoint at)
{
    all->value[i] = at.value, all->by_s[i] = at.by_s, all->by_t[i] = at.by_t;
}

ALWAYS_INLINE PatchPoints points_in_lanes(const LanePoints *all)
{
    return (PatchPoints){ in_lanes(all->value), in_lanes(all->by_s), in_lanes(all->by_t) };
}

/* Of no patch, for lanes that are not asked for. */
ALWAYS_INLINE void set_no_points(Lanes lanes, LanePoints *all)
{
    const V4 zero = v4_splat(0);
    for (int i = 0; i < BUNCH_WIDTH; i++)
        if (!(lanes >> i & 1)) set_lane(all, i, (PatchPoint){ { 0, 0, 0, 1 }, zero, zero });
}

/* The homogeneous numerator and its derivatives by s and t, about the patch's origin, of orders up to BUNCH_MAX_ORDER. */
ALWAYS_INLINE PatchPoints bunch_evaluate(const Patch *p, V8d s, V8d t)
{
    if (p->k_u == 4 && p->k_v == 4 && p->is_polynomial) return bunch_blend(p, 4, 4, false, s, t);
    if (p->k_u == 3 && p->k_v == 3) return bunch_blend(p, 3, 3, true, s, t);
    if (p->k_u == 3 && p->k_v == 4) return bunch_blend(p, 3, 4, true, s, t);
    return bunch_blend(p, p->k_u, p->k_v, true, s, t);
}

#endif
