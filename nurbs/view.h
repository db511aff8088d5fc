/* A patch, or a box of it, as a ray sees it: a rational patch again, in the ray's own frame. Its coefficients are
 *   x, y   the two plane equations times the weight: zero together exactly at a root;
 *   z, w   numerator and denominator of the depth, from the patch's origin on.
 * All that is asked of a box is computed from its own coefficients, in its own coordinates s, t in [0, 1]: where much of
 * space lies within little of the patch's parameters (weights of a large ratio), their last bits would be too coarse.
 *
 * Rounding. The first coefficients are as exact as `rounding` says (certify.h), times the weights. Restricting is a convex
 * combination, and errs by so many units of sum B |x| <= max |x/w| sum B w: over the weight, relative to the size of the box
 * in space. `lost` adds that up for the plane equations, and is soon added up since boxes shrink; `drift` for the depth, which
 * does not. */
#ifndef TRIMRAY_VIEW_H
#define TRIMRAY_VIEW_H

#include "nurbs/certify.h"

typedef struct {
    int k_u, k_v;
    bool is_polynomial;      /* every weight is 1, and stays it */
    Vec4 *p;                 /* k_u * k_v coefficients, s fastest */
    double s0, t0;           /* where the box begins in the patch */
    double w_s, w_t;         /* how wide it is there: apart from s0 and t0, whose last bits may be wider */
    double size;             /* largest |x/w| or |y/w| of the coefficients, or up to twice that: set by view_extent */
    double lost, drift;      /* by all restrictions so far: of x/w and y/w; of z/w, relative to the patch's radius */
} View;

typedef struct { double lo, hi; } Range;

/* The whole patch; a tile of it; and that with more roundings, for less time. The memory comes from `scratch`. */
View view_of(Arena *scratch, const Patch *p, const PatchRay *r);
View view_of_tile(Arena *scratch, const Tile *tile, const PatchRay *r);
View view_of_tile_in_haste(Arena *scratch, const Tile *tile, const PatchRay *r);
View view_copy(Arena *scratch, const View *v);

/* To the part [lo, hi] of the box, along s or along t; v->size must be set. Ends that stay keep their bits. */
void view_restrict(View *v, bool along_s, Range part);

/* Extremes of the plane equations' coefficients, and the largest weight. */
typedef struct { Range x, y; double w_max; } ViewExtent;
ViewExtent view_extent(View *v);

/* Is the box certainly beside the ray, on the side to which (x, y) points? `error` is over the weight. */
bool view_is_off(const View *v, double x, double y, double error);

/* Bounds of the depth. */
Range view_depth(const View *v);

/* The same of what the ray meets of the box. There x and y over the weight are within `error` of zero, so that the depth is
 * z - slant . (x, y), whatever the slant, but for slack = |slant| error. A slant that takes off what the depth gains along
 * the longer axis of the box's image leaves little of a needle across the ray, however long it is; (0, 0): none does. */
typedef struct { Range range; double slack; Vec2 slant; } DepthOnRay;
DepthOnRay view_depth_on_ray(const View *v, double error);

/* A number and its derivatives by s and t. */
typedef struct { double value, by_s, by_t; } Jet;
typedef struct { double s, t; Jet x, y, z; } ViewPoint;      /* over the weight */
ViewPoint view_point(const View *v, double s, double t);

/* The largest coefficients of the derivatives by s and t, of the plane equations; and of the depth on the ray, about. */
typedef struct { double by_s, by_t; } Lengths;
Lengths view_image(const View *v);
Lengths view_depths(const View *v, Vec2 slant);

/* The part of the box outside which no root lies, if the plane equations are within `error` of what they should be; empty:
 * lo > hi. [NSK90] Bézier clipping, preconditioned by the inverse of the mean Jacobian, which makes it converge
 * quadratically at simple roots ([MP09]). *is_certified is set if that proves that there is one root at most. Where the
 * box's image is a needle that does not turn back, *across is the greatest distance of its coefficients from the ray, seen
 * along it; else infinite. See narrow.c. */
typedef struct { Range s, t; } ViewPart;
ViewPart view_narrow(const View *v, double error, Arena *scratch, bool *is_certified, double *across);

#endif
