/* A tile to the second order. Where a ray grazes the surface its frame, a parallelogram, leaves doubts as far as the surface
 * bends by as much as it is away from the ray; of the paraboloid that is a tile or two. */
#ifndef TRIMRAY_PARABOLOID_H
#define TRIMRAY_PARABOLOID_H

#include "nurbs/tile.h"

/* S(s, t) = middle + x half_s + y half_t + at + x^2 ss + xy st + y^2 tt + r, |r| <= deviation, x = 2s-1 and y = 2t-1, on the
 * tile; middle and half-vectors are the tile's. It has room for TILE_VIEW_ROUNDINGS, as the frame's deviation has, and for
 * the sums of a ray's test (paraboloid_kernel.h). */
typedef struct { _Alignas(64) float at[3]; float ss[3], st[3], tt[3], deviation; } Paraboloid;

/* From the net over the tile, about the patch's origin. */
void paraboloid_make(const Tile *tile, const Vec4 *net, Paraboloid *out);

#endif
