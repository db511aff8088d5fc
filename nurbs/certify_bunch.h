/* `method certain` for the rays of a bunch at one tile: what certify.c proves of one ray, of eight at once. What is not
 * decided here is left to it. */
#ifndef TRIMRAY_CERTIFY_BUNCH_H
#define TRIMRAY_CERTIFY_BUNCH_H

#include "nurbs/certify.h"
#include "render/bunch.h"

/* As far as each ray is followed, in units of its direction: number i is at[i * step]; BUNCH_WIDTH numbers, of which those
 * of rays that are not asked for do not matter. */
typedef struct { double *at; size_t step; } BunchLimits;

static inline double *bunch_limit(BunchLimits limits, int i) { return limits.at + (size_t)i * limits.step; }

/* Roots, as Root has them; `beside` is half the distance. */
typedef struct { V8d s, t, depth, depth_error, distance; } Roots;

/* Makes the frames, unless they are there. */
void bunch_use_frames(RayBunch *b);

/* Lanes that are left to others: those that the tile's halves may decide, and those that only tile_roots does. */
typedef struct { Lanes in_doubt, alone; } LanesLeft;

/* The lanes that have a root between t_min and their limits on the closed tile, of which they have one at most; those that
 * are left are others. Lanes must be finite, and frames there. Counts into t what it decides. */
Lanes tile_roots_bunch(const Tile *tile, const RayBunch *b, Lanes lanes, BunchLimits limits, Roots *out, LanesLeft *left,
                       Trace *t);

/* The same where each lane has its own tile; those of other lanes are tiles, too. */
Lanes tiles_roots_bunch(const Tile *const tiles[], const RayBunch *b, Lanes lanes, BunchLimits limits, Roots *out,
                        LanesLeft *left, Trace *t);

Root roots_get(const Roots *roots, int i);

#endif
