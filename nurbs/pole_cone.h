/* Where a tile lies as its pole sees it: a cone. All tiles round a pole have that one root of a ray through it; the first of
 * them finds it (pole.h), and of the others the cone tells that they have no other. */
#ifndef TRIMRAY_POLE_CONE_H
#define TRIMRAY_POLE_CONE_H

#include "nurbs/certify.h"

struct PoleCone {
    Vec3 pole;               /* about the patch's origin */
    float axis[3], cosine;   /* a chord x from the pole to the tile has axis.x >= cosine |x|: but for errors (pole_cone.c) */
};

/* The cone of a tile one of whose sides is a pole, from its net about the patch's origin; false: there is no such side, or
 * more than one, or the tile is not on one side of its pole. */
bool pole_cone_make(const Patch *p, TilePlace place, const Vec4 *net, PoleCone *out);

/* That of a tile that has one. */
static inline const PoleCone *pole_cone_of(const Tile *f) { return &f->patch->group->cones[f->cone - 1]; }

/* Does the ray meet the pole out of its reach, as far as rounding can tell, and certainly no more of the tile within it? */
bool pole_cone_is_out_of_reach(const PoleCone *cone, const Patch *p, const PatchRay *r);

#endif
