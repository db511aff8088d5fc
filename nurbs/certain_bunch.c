/* The search of `method certain` for the rays of a bunch: eight at a tile, and then at its halves, those that it leaves in
 * doubt; alone, where they are few or that leads nowhere. */
#include "nurbs/certain.h"

#include "nurbs/certify_bunch.h"

/* So many lanes are better served one by one: eight cost about as much as that many. */
enum { FEW_LANES = 2 };

/* A tile is halved so often for lanes in doubt before they go on alone. */
enum { MAX_LEVEL = 4 };

typedef struct {
    RayBunch *b;
    uint32_t tile;               /* of its tree's */
    double t_max[BUNCH_WIDTH];   /* lowered by hits */
    Trace *trace;
    CertainHit *nearest;         /* of each lane; NULL: any hit will do, and ends the lane's search */
    Lanes hit;
} Search;

typedef struct { const Tile *part; Lanes lanes; int level; } Doubt;

static bool are_few(Lanes lanes) { return __builtin_popcount(lanes) <= FEW_LANES; }

static void take(Search *k, int i, const CertainHit *hit)
{
    k->hit |= 1u << i;
    if (k->nearest) k->nearest[i] = *hit, k->t_max[i] = hit->t;
}

static void take_root(Search *k, const Tile *part, const Roots *roots, int i)
{
    const BunchFrames *f = &k->b->frames;
    Root root = roots_get(roots, i);
    CertainHit hit;
    if (!certain_accepts(tile_tree_of(part), k->tile, part, vec(f->d.x[i], f->d.y[i], f->d.z[i]), f->length[i], &root, k->trace,
                         &hit)) return;
    take(k, i, &hit);
    if (k->nearest) k->b->lane[i].root = (RayRoot){ part->patch, root.s, root.t, k->b->lane[i].seed };
}

static void go_alone(Search *k, const Tile *part, int i)
{
    const Ray *r = &k->b->ray[i];
    CertainHit hit;
    bunch_begin(k->b, i, k->trace);
    bool is_hit = k->nearest ? certain_nearest_on(part, k->tile, r, k->t_max[i], k->trace, &hit)
                             : certain_any_on(part, k->tile, r, k->t_max[i], k->trace);
    bunch_end(k->b, i, k->trace);
    if (is_hit) take(k, i, &hit);
}

/* The lanes that a tile or a part of it leaves in doubt. */
static Lanes solve_part(Search *k, const Tile *part, Lanes lanes)
{
    PatchRays rays = { .b = k->b, .base = part->patch->base, .t_max = v8d_load_doubles(k->t_max) };
    Roots roots;
    Lanes undecided = 0, rooted = tile_roots_bunch(part, &rays, lanes, &roots, &undecided, k->trace);
    while (rooted) take_root(k, part, &roots, lanes_next(&rooted));
    return undecided;
}

/* A side that is one point has proofs of its own for single rays. */
static const Tile *halves_for(const Doubt *d, Lanes lanes)
{
    return d->level == MAX_LEVEL || are_few(lanes) || d->part->patch->collapsed ? NULL : tile_halves(d->part);
}

static void search_parts(Search *k, const Tile *tile, Lanes lanes)
{
    Doubt stack[MAX_LEVEL + 1] = { { tile, lanes, 0 } };
    for (int top = 1; top > 0; ) {
        Doubt d = stack[--top];
        if (!k->nearest) d.lanes &= ~k->hit;
        Lanes left = are_few(d.lanes) ? d.lanes : solve_part(k, d.part, d.lanes);
        const Tile *halves = halves_for(&d, left);
        for (int i = 0; i < 2 && halves; i++) stack[top++] = (Doubt){ &halves[i], left, d.level + 1 };
        while (left && !halves) go_alone(k, d.part, lanes_next(&left));
    }
}

/* Each lane counts once. */
static Lanes search_tile(Search *k, const Tile *tile, Lanes lanes)
{
    Trace *t = k->trace;
    uint64_t n_tests = t->counters.leaf_tests + (uint64_t)__builtin_popcount(lanes);
    bunch_use_frames(k->b);
    search_parts(k, tile, lanes & k->b->frames.finite);
    t->counters.leaf_tests = n_tests;
    return k->hit;
}

static void set_limits(Search *k, const double t_max[])
{
    for (int i = 0; i < BUNCH_WIDTH; i++) k->t_max[i] = t_max[i];
}

Lanes certain_nearest_on_bunch(const Tile *tile, uint32_t i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t,
                               CertainHit out[])
{
    Search k = { .b = b, .tile = i, .trace = t, .nearest = out };
    set_limits(&k, t_max);
    return search_tile(&k, tile, lanes);
}

Lanes certain_any_on_bunch(const Tile *tile, uint32_t i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    Search k = { .b = b, .tile = i, .trace = t };
    set_limits(&k, t_max);
    return search_tile(&k, tile, lanes);
}
