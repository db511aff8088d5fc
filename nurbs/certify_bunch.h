/* `method certain` for the rays of a bunch at one tile: what certify.c proves of one ray, of eight at once. What is not
 * decided here is left to it. */
#ifndef TRIMRAY_CERTIFY_BUNCH_H
#define TRIMRAY_CERTIFY_BUNCH_H

#include "nurbs/certify.h"
#include "render/bunch.h"

/* Rays as a tile sees them. */
typedef struct {
    const RayBunch *b;       /* its frames are there */
    Vec3 base;               /* what the patch's origin is about */
    V8d t_max;               /* in units of the rays' directions */
} PatchRays;

/* Roots, as Root has them; `beside` is half the distance. */
typedef struct { V8d s, t, depth, depth_error, distance; } Roots;

/* Makes the frames, unless they are there. */
void bunch_use_frames(RayBunch *b);

/* The lanes that have a root in (t_min, t_max) of the closed tile, of which they have one at most. Lanes added to *undecided
 * have none here, and tile_roots must be asked. Lanes must be finite. Counts into t what it decides. */
Lanes tile_roots_bunch(const Tile *tile, const PatchRays *rays, Lanes lanes, Roots *out, Lanes *undecided, Trace *t);

Root roots_get(const Roots *roots, int i);

#endif
