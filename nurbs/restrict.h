/* Bézier polygons restricted to a part of their interval, in place, by de Casteljau's algorithm ([PT97] A1.5). Inlined, to be
 * compiled for its callers' instruction set.
 *
 * Lines of k points, `stride` apart, `width` of them side by side. Error per coordinate: each of k - 1 combinations has three
 * roundings, relative to y |a| + x |b|; at the middle one. */
#ifndef TRIMRAY_RESTRICT_H
#define TRIMRAY_RESTRICT_H

#include "render/simd.h"

#include <stdbool.h>

/* y a + x b, where x + y = 1: from the nearer one, so that equal numbers stay equal, and that 1 - x is exact where it
 * counts. */
ALWAYS_INLINE V4 restrict_between(V4 a, V4 b, double x, double y)
{
    return x == y ? (a + b) * 0.5 : x < y ? a + (b - a) * x : b + (a - b) * y;
}

/* The part before x. */
ALWAYS_INLINE void restrict_before(Vec4 *p, int k, int stride, int width, double x, double y)
{
    for (int n = 1; n < k; n++)
        for (int i = k - 1; i >= n; i--)
            for (int c = 0; c < width; c++) {
                Vec4 *q = p + i * stride + c;
                v4_store(q, restrict_between(v4_load(q - stride), v4_load(q), x, y));
            }
}

/* The part after x. */
ALWAYS_INLINE void restrict_after(Vec4 *p, int k, int stride, int width, double x, double y)
{
    for (int n = 1; n < k; n++)
        for (int i = 0; i < k - n; i++)
            for (int c = 0; c < width; c++) {
                Vec4 *q = p + i * stride + c;
                v4_store(q, restrict_between(v4_load(q), v4_load(q + stride), x, y));
            }
}

/* [lo, hi], which may reach beyond [0, 1]. Ends that stay keep their bits. Where both move, the second is at a quotient. */
ALWAYS_INLINE void restrict_lines(Vec4 *p, int k, int stride, int width, double lo, double hi)
{
    if (hi != 1) restrict_before(p, k, stride, width, hi, 1 - hi);
    if (lo != 0) restrict_after(p, k, stride, width, lo / hi, (hi - lo) / hi);
}

/* A net of k_u by k_v points, u fastest, along u or along v. */
ALWAYS_INLINE void restrict_net(Vec4 *p, int k_u, int k_v, bool along_u, double lo, double hi)
{
    if (!along_u) restrict_lines(p, k_v, k_u, k_u, lo, hi);
    else for (int j = 0; j < k_v; j++) restrict_lines(p + j * k_u, k_u, 1, 1, lo, hi);
}

#endif
