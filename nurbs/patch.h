/* A rational Bézier patch about its own origin, with what decides most rays at sight: the leaf of `method certain`.
 *
 * Parameters here are local: s, t in [0, 1] over the patch; u = u0 + s (u1 - u0), v likewise. Points are homogeneous
 * {w(x - ox), w(y - oy), w(z - oz), w} about origin = S(1/2, 1/2), so that nothing cancels later when the patch lies far
 * from the origin of the scene. */
#ifndef TRIMRAY_PATCH_H
#define TRIMRAY_PATCH_H

#include "nurbs/trim_tree.h"
#include "render/arena.h"
#include "render/vec.h"

#include <stdbool.h>

/* How far beyond [0, 1] the frame's bounds still hold: a root that Newton finds just outside the patch proves that there is
 * none inside, if the map is one-to-one on the larger square. */
#define PATCH_MARGIN 0.0625

typedef struct {
    int k_u, k_v;                 /* orders */
    Vec3 origin;
    const Vec4 *p;                /* k_u * k_v points, u fastest */
    bool is_polynomial;           /* every w is 1 */
    double u0, u1, v0, v1;        /* its interval of the surface's parameters */
    double rounding;              /* how far its points may be from where exact arithmetic has them */
    double radius;                /* |S(s, t) - origin| <= radius, with the margin */
    double w_max, w_middle;       /* largest weight, and the weight at the middle (1 where is_polynomial) */

    /* The frame: S(s, t) = origin + (2s-1) half_u e_u + (2t-1) half_v e_v + r, |r| <= deviation on the patch. */
    bool has_frame;               /* both derivatives at the middle are not zero */
    Vec3 e_u, e_v;                /* unit */
    double half_u, half_v;        /* |S_s| / 2, |S_t| / 2 at the middle */
    double deviation;
    /* The derivatives of the homogeneous numerator w (S - x), for any x within `radius` of the origin, stay within
     * variation * |the one at the middle|, both columns together (root of the sum of squares), with the margin. */
    double variation;
} Patch;

/* Fills *out from k_u * k_v homogeneous points {wx, wy, wz, w} of positive weight, u fastest; the points are copied.
 * `rounding` is their error: patches that share a border agree within theirs, and no ray passes between. */
void patch_make(Arena *a, int k_u, int k_v, const Vec4 *points, double rounding, TrimRect interval, Patch *out);

/* Before it is worth a frame: about how much `variation` would be, and the shares of it that halving along u, along v would
 * halve. For k_u * k_v homogeneous points, as patch_make takes them. */
typedef struct { double variation, along_u, along_v; } PatchBend;
PatchBend patch_bend(int k_u, int k_v, const Vec4 *points);

/* Bernstein polynomials of order k and their derivatives at x (any real number): b and d have room for k. */
void bernstein(int k, double x, double b[], double d[]);

/* The homogeneous numerator and its derivatives by s and t: about the patch's origin. */
void patch_evaluate(const Patch *p, double s, double t, Vec4 *value, Vec4 *by_s, Vec4 *by_t);

/* The unit normal S_s x S_t at (s, t); where it vanishes, its limit from the side of the middle; where all of the patch is a
 * curve or a point, what is perpendicular to it and nearest to `towards`. */
Vec3 patch_normal(const Patch *p, double s, double t, Vec3 towards);

#endif
