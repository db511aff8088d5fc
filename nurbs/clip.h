/* The fallback of `method certain`: roots of two bivariate Bernstein polynomials by clipping and splitting, with proof.
 *
 * Boxes are narrowed (view.h) as long as that takes a fifth, else halved. A box is given up only when its hull excludes zero
 * by more than the rounding error; it is a root when it is proved to have one at most and Newton's method finds it, or when
 * all of it, or a needle that is its image, lies on the ray within that error: a tangent hit is a hit. */
#ifndef TRIMRAY_CLIP_H
#define TRIMRAY_CLIP_H

#include "nurbs/certify.h"

bool clip_roots(const Tile *tile, PatchRay *ray, RootVisit visit, void *context, Trace *t);

#endif
