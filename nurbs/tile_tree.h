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

/* How much tiles should vary. With TILE_VARIATION the certificate holds for all rays but those within some asin(0.25) of the
 * tile's tangent planes. What is beyond CACHED_PATCHES comes from memory anew for most rays, and takes longer than what is
 * computed: coarser tiles then are fewer, up to twice TILE_VARIATION.
 *
 * Measured on random rays at fields of bicubic patches: of 64, .25 is best; of 256, .3 to .5; of 1024 and more, .5 to .7,
 * with 7 to 15 % more rays a second than with .25, and 45 % less memory. */
#define TILE_VARIATION 0.25
#define CACHED_PATCHES 128
double tile_tree_variation(const Surface *surface, uint32_t n_surfaces);    /* of the surfaces that are searched together */

/* Cuts the surface into tiles whose frames settle most rays, drops those that are trimmed away, and builds the tree. A
 * tile is halved until its derivatives vary by at most `variation` of themselves. Hits depend on it in their last bits
 * only, time and memory do. The result lies in `a`, and so will what rays ask for later. Linear in the number of spans. */
void tile_tree_make(Arena *a, const Surface *surface, double variation, TileTree *out);

#endif
