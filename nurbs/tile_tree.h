/* A surface as a tree of tiles of its Bézier patches: what `method certain` searches. */
#ifndef TRIMRAY_TILE_TREE_H
#define TRIMRAY_TILE_TREE_H

#include "nurbs/surface.h"
#include "nurbs/tile.h"
#include "nurbs/trim_cell.h"
#include "render/bvh.h"

typedef struct {
    PatchGroup group;                /* first: see tile_tree_of */
    const Tile *tiles;
    Vec3 base;                       /* they are about this point: far from the origin nothing is lost */
    const TrimCell *const *cells;    /* what the trims say in each tile; NULL: it is wholly kept. NULL: all tiles are */
    const TrimTree *trims;           /* the surface's */
    uint32_t n_tiles;
    const Bvh *bvh;                  /* item i is tiles[i] */
    Vec3 bvh_base;                   /* its boxes are about this point: 0, or the base of a surface that is far off */
    size_t bytes;                    /* of all this, as it was prepared */
    uint32_t n_cut, n_untested;      /* dropped because trimmed away; kept without a trim test on a trimmed surface */
} TileTree;

/* The tree of one of its tiles, or of what that was halved into. */
static inline const TileTree *tile_tree_of(const Tile *tile) { return (const TileTree *)tile->patch->group; }

/* The certificate then holds for all rays but those within some asin(0.25) of the tile's tangent planes. */
#define TILE_VARIATION 0.25

/* Cuts the surface into tiles whose frames settle most rays, drops those that are trimmed away, and builds the tree. A
 * tile is halved until its derivatives vary by at most `variation` of themselves; 0: TILE_VARIATION. Hits depend on it
 * in their last bits only, time and memory do. The result lies in `a`, and so will what rays ask for later. Linear in the
 * number of spans. */
void tile_tree_make(Arena *a, const Surface *surface, double variation, TileTree *out);

#endif
