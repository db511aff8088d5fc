/* `method certain`: a surface as a tree of tiles of its Bézier patches, searched without a miss. */
#ifndef TRIMRAY_CERTAIN_H
#define TRIMRAY_CERTAIN_H

#include "nurbs/certify.h"
#include "nurbs/tile_tree.h"

typedef struct {
    double u, v;                     /* parameters of the surface */
    double t, t_error;               /* in units of the ray's direction; as Hit has them */
    double depth_error;              /* |t - true t| is at most this */
    uint32_t tile;                   /* of the tree's, */
    const Tile *part;                /* and which part of it */
    signed char before, after;       /* as Root has them */
} CertainHit;

/* The nearest hit in the open interval (r->t_min, t_max) that no trim cuts away; counts into t. */
bool certain_nearest(const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainHit *out);

/* The same of one tile of a tree, number i, and of what it was halved into. Of the tree nothing is read unless there is a
 * root and trims: in a scene of many surfaces it is not in the cache. */
bool certain_nearest_on(const Tile *tile, uint32_t i, const Ray *r, double t_max, Trace *t, CertainHit *out);
bool certain_any_on(const Tile *tile, uint32_t i, const Ray *r, double t_max, Trace *t);

/* Do the trims keep a root of a ray in the unit direction d, at (u, v) of a part of tile i? Counts into t. */
bool certain_keeps(const TileTree *tree, uint32_t i, const Tile *part, Vec3 d, const Root *root, double u, double v,
                   Trace *t);

/* Is there any hit in (r->t_min, t_max)? */
bool certain_any(const TileTree *tree, const Ray *r, double t_max, Trace *t);

/* All hits in (r->t_min, t_max), ascending, each once, in t->scratch. */
typedef struct { CertainHit *hits; size_t n, capacity; } CertainList;
void certain_all(const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainList *out);

/* The unit normal S_u x S_v at (u, v) of tile i; where it vanishes (a pole, a collapsed side), its limit from within. Where
 * the patch is but a curve, the one that faces the ray. */
Vec3 certain_normal(const TileTree *tree, uint32_t i, double u, double v, const Ray *r);

#endif
