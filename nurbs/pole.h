/* Rays through a pole: a side of the patch that is one point. The Jacobian vanishes there, and every box about the side is a
 * fan round the ray; but what the fan leaves of the plane equations when its apex is divided out is far from zero. */
#ifndef TRIMRAY_POLE_H
#define TRIMRAY_POLE_H

#include "nurbs/view.h"

typedef struct { bool is_t, is_end; } PoleSide;      /* s or t is 0 or 1 all along it */

/* The point that a collapsed side of the patch is, about the patch's origin. */
Vec3 pole_of(const Patch *p, PoleSide side);

/* How many collapsed sides of the patch a place has on it; sets *side to the last one. */
int pole_sides(const Patch *p, TilePlace place, PoleSide *side);

/* Does a collapsed side of the patch, on the tile, lie on the ray, as far as rounding can tell? */
bool pole_is_met(const Tile *tile, const PatchRay *r, PoleSide *side);

/* Narrows the view of a box whose side is on the ray to where all its roots are: so near to the side that none can be told
 * from the pole. `error` is over the weight. false: it may have others, and is as it was. */
bool pole_has_all(View *v, PoleSide side, double error);

#endif
