/* `method certain`: a surface as a tree of tiles of its Bézier patches, searched without a miss. */
#ifndef TRIMRAY_CERTAIN_H
#define TRIMRAY_CERTAIN_H

#include "nurbs/certify.h"
#include "nurbs/surface.h"
#include "nurbs/trim_cell.h"
#include "render/bvh.h"

typedef struct {
    const Tile *tiles;
    Vec3 base;                       /* they are about this point: far from the origin nothing is lost */
    const TrimCell *const *cells;    /* what the trims say in each tile; NULL: it is wholly kept. NULL: all tiles are */
    uint32_t n_tiles;
    const Bvh *bvh;                  /* item i is tiles[i] */
    Vec3 bvh_base;                   /* its boxes are about this point: 0, or the base of a surface that is far off */
    size_t bytes;                    /* of all this, as it was prepared */
    uint32_t n_cut, n_untested;      /* dropped because trimmed away; kept without a trim test on a trimmed surface */
} TileTree;

/* The certificate then holds for all rays but those within some asin(0.25) of the tile's tangent planes. */
#define CERTAIN_VARIATION 0.25

/* Cuts the surface into tiles whose frames settle most rays, drops those that are trimmed away, and builds the tree. A
 * tile is halved until its derivatives vary by at most `variation` of themselves; 0: CERTAIN_VARIATION. Hits depend on it
 * in their last bits only, time and memory do. The result lies in `a`, and so will what rays ask for later. Linear in the
 * number of spans. */
void certain_prepare(Arena *a, const Surface *surface, double variation, TileTree *out);

typedef struct {
    double u, v;                     /* parameters of the surface */
    double t, t_error;               /* in units of the ray's direction; as Hit has them */
    double depth_error;              /* |t - true t| is at most this */
    uint32_t tile;                   /* of the tree's, */
    const Tile *part;                /* and which part of it */
    signed char before, after;       /* as Root has them */
} CertainHit;

/* The nearest hit in the open interval (r->t_min, t_max) that no trim cuts away; counts into t. */
bool certain_nearest(const Surface *s, const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainHit *out);

/* The same of one tile, and of what it was halved into. */
bool certain_nearest_on(const Surface *s, const TileTree *tree, uint32_t tile, const Ray *r, double t_max, Trace *t,
                        CertainHit *out);
bool certain_any_on(const Surface *s, const TileTree *tree, uint32_t tile, const Ray *r, double t_max, Trace *t);

/* Is there any hit in (r->t_min, t_max)? */
bool certain_any(const Surface *s, const TileTree *tree, const Ray *r, double t_max, Trace *t);

/* All hits in (r->t_min, t_max), ascending, each once, in t->scratch. */
typedef struct { CertainHit *hits; size_t n, capacity; } CertainList;
void certain_all(const Surface *s, const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainList *out);

/* The unit normal S_u x S_v at (u, v) of tile i; where it vanishes (a pole, a collapsed side), its limit from within. Where
 * the patch is but a curve, the one that faces the ray. */
Vec3 certain_normal(const TileTree *tree, uint32_t i, double u, double v, const Ray *r);

#endif
