/* The fallback of `method certain`: roots of two bivariate Bernstein polynomials by clipping and splitting, with proof.
 *
 * [NSK90] Bézier clipping, preconditioned by the inverse Jacobian at the middle of the box, which makes it
 * converge quadratically at simple roots ([MP09]); where a clip takes less than a fifth, the box is halved. A
 * box is given up only when its hull excludes zero by more than the rounding error, and reported as a root when all of it
 * lies on the ray within that error, or it cannot be halved any more: a tangent hit is a hit. */
#ifndef TRIMRAY_CLIP_H
#define TRIMRAY_CLIP_H

#include "nurbs/certify.h"

bool clip_roots(const Tile *tile, PatchRay *ray, RootVisit visit, void *context, Trace *t);

#endif
