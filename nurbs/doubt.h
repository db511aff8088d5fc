/* What becomes of a tile that leaves a ray in doubt: it is halved, once for all rays. Beside its frame, a half has a
 * paraboloid. */
#ifndef TRIMRAY_DOUBT_H
#define TRIMRAY_DOUBT_H

#include "nurbs/paraboloid.h"

struct Halves {
    Tile tiles[2];
    Paraboloid paraboloids[2];
};

/* Made by whichever thread asks first; NULL: the tile has been halved often enough, or is as good as flat. */
const Halves *tile_halves(const Tile *tile);

/* Five lines of the cache, far from all others: if they are there, they come from memory while the tile itself is looked at. */
static inline void halves_fetch_ahead(const Tile *tile)
{
    const char *at = (const char *)atomic_load_explicit(&((Tile *)tile)->halves, memory_order_relaxed);
    for (size_t i = 0; at && i < sizeof(Halves); i += 64) __builtin_prefetch(at + i);
}

#endif
