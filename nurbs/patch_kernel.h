/* The inner loop of `method certain`: a patch and its derivatives at a point, inlined into its callers so that it is
 * compiled for their instruction set. Four lanes: x, y, z, w of a homogeneous point. */
#ifndef TRIMRAY_PATCH_KERNEL_H
#define TRIMRAY_PATCH_KERNEL_H

#include "nurbs/nurbs.h"
#include "nurbs/tile.h"
#include "render/simd.h"

typedef struct { V4 value, by_s, by_t; } PatchPoint;

/* Bernstein polynomials of order k and their derivatives. */
ALWAYS_INLINE void kernel_bernstein(int k, double x, double b[], double d[])
{
    double y = 1 - x;
    if (k == 4) {
        double xx = x * x, yy = y * y, xy = x * y;
        b[0] = yy * y, b[1] = 3 * x * yy, b[2] = 3 * xx * y, b[3] = xx * x;
        d[0] = -3 * yy, d[1] = 3 * (yy - 2 * xy), d[2] = 3 * (2 * xy - xx), d[3] = 3 * xx;
    } else if (k == 3) {
        b[0] = y * y, b[1] = 2 * x * y, b[2] = x * x;
        d[0] = -2 * y, d[1] = 2 * (y - x), d[2] = 2 * x;
    } else if (k == 2) {
        b[0] = y, b[1] = x;
        d[0] = -1, d[1] = 1;
    } else {
        bernstein(k, x, b, d);
    }
}

/* The tensor product, for constant orders unrolled. */
ALWAYS_INLINE PatchPoint kernel_blend(const Patch *p, int k_u, int k_v, double s, double t)
{
    double bu[NURBS_MAX_ORDER], du[NURBS_MAX_ORDER], bv[NURBS_MAX_ORDER], dv[NURBS_MAX_ORDER];
    kernel_bernstein(k_u, s, bu, du);
    kernel_bernstein(k_v, t, bv, dv);
    PatchPoint out = { v4_splat(0), v4_splat(0), v4_splat(0) };
    for (int j = 0; j < k_v; j++) {
        const Vec4 *row = p->p + j * k_u;
        V4 at = v4_load(&row[0]) * bu[0], along = v4_load(&row[0]) * du[0];
        for (int i = 1; i < k_u; i++) {
            V4 point = v4_load(&row[i]);
            at += point * bu[i];
            along += point * du[i];
        }
        out.value += at * bv[j];
        out.by_s += along * bv[j];
        out.by_t += at * dv[j];
    }
    return out;
}

/* The homogeneous numerator and its derivatives by s and t, about the patch's origin. */
ALWAYS_INLINE PatchPoint kernel_evaluate(const Patch *p, double s, double t)
{
    if (p->k_u == 4 && p->k_v == 4) return kernel_blend(p, 4, 4, s, t);
    if (p->k_u == 3 && p->k_v == 3) return kernel_blend(p, 3, 3, s, t);
    if (p->k_u == 2 && p->k_v == 2) return kernel_blend(p, 2, 2, s, t);
    if (p->k_u == 3 && p->k_v == 4) return kernel_blend(p, 3, 4, s, t);
    return kernel_blend(p, p->k_u, p->k_v, s, t);
}

/* A tile's place in its patch, and what its sides are powers of two below 1: exact. */
typedef struct { TilePlace at; double per_s, per_t; } KernelPart;

ALWAYS_INLINE KernelPart kernel_part(const Tile *f)
{
    TilePlace at = tile_place(f);
    return (KernelPart){ at, 1 / at.ds, 1 / at.dt };
}

/* The same at a place of a tile, by the tile's parameters. s and t become those that were evaluated: the patch's own may
 * have too few bits left for them. */
ALWAYS_INLINE PatchPoint kernel_tile(const Patch *p, const KernelPart *part, double *s, double *t)
{
    TilePlace in = part->at;
    double x = in.s0 + *s * in.ds, y = in.t0 + *t * in.dt;
    *s = (x - in.s0) * part->per_s, *t = (y - in.t0) * part->per_t;
    PatchPoint at = kernel_evaluate(p, x, y);
    return (PatchPoint){ at.value, at.by_s * in.ds, at.by_t * in.dt };
}

#endif
