/* See doubt.h. */
#include "nurbs/doubt.h"

#include <pthread.h>

/* One lock for all tiles. Halves are made before it is taken: it is held for as long as it takes to put them in their place,
 * and where two threads made the same, one of them made them in vain. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* A tile whose derivatives vary by less than this is as good as flat, and its halves would tell no more. */
#define AS_GOOD_AS_FLAT 0x1p-12

static bool may_be_halved(const Tile *tile)
{
    return tile->patch->group && tile->n_halvings < TILE_MAX_HALVINGS && !(tile->turn + tile->stretch < AS_GOOD_AS_FLAT);
}

static void make_half(const Tile *whole, const Vec4 *net, TilePlace place, Tile *out, Paraboloid *paraboloid)
{
    tile_make(whole->patch, net, place, out);
    out->n_halvings = whole->n_halvings + 1;
    paraboloid_make(out, net, paraboloid);
}

static void make_halves(const Tile *tile, Halves *out)
{
    const Patch *p = tile->patch;
    Vec4 net[NURBS_MAX_ORDER * NURBS_MAX_ORDER], first[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    TilePlace place = tile_place(tile);
    tile_net(p, place, net);
    TileBend bend = tile_bend(p->k_u, p->k_v, net);
    TilePlaces halves = tile_cut(p, place, !(bend.along_u < bend.along_v), net, first);
    make_half(tile, first, halves.first, &out->tiles[0], &out->paraboloids[0]);
    make_half(tile, net, halves.second, &out->tiles[1], &out->paraboloids[1]);
}

const Halves *tile_halves(const Tile *tile)
{
    Tile *t = (Tile *)tile;     /* the one thing in a tile that changes, and under a lock */
    const Halves *halves = atomic_load_explicit(&t->halves, memory_order_acquire);
    if (halves || !may_be_halved(tile)) return halves;
    Halves made;
    make_halves(tile, &made);
    pthread_mutex_lock(&lock);
    halves = atomic_load_explicit(&t->halves, memory_order_relaxed);
    if (!halves) {
        halves = arena_copy(tile->patch->group->arena, &made, 1, sizeof made);
        atomic_store_explicit(&t->halves, halves, memory_order_release);
    }
    pthread_mutex_unlock(&lock);
    return halves;
}
