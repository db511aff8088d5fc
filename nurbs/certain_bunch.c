/* The search of `method certain` for the rays of a bunch: eight at a tile, and alone where one is in doubt. */
#include "nurbs/certain.h"

#include "nurbs/certify_bunch.h"

/* So many lanes are better served one by one: eight cost about as much as that many. */
enum { FEW_LANES = 1 };

static inline bool are_few(Lanes lanes) { return __builtin_popcount(lanes) <= FEW_LANES; }

/* The lanes with a root on tile i, and those that tile_roots must be asked for; counts the others' tests. */
static Lanes roots_on(const Tile *tile, RayBunch *b, Lanes lanes, const double t_max[], Roots *roots, Lanes *undecided, Trace *t)
{
    PatchRays rays = { .b = b, .base = tile->patch->base, .t_max = v8d_load_doubles(t_max) };
    double begin = t->measures_time ? stats_now() : 0;
    Lanes rooted = tile_roots_bunch(tile, &rays, lanes, roots, undecided, t);
    t->counters.leaf_tests += (uint64_t)__builtin_popcount(lanes & ~*undecided);
    if (t->measures_time) t->counters.nurbs_seconds += stats_now() - begin;
    return rooted;
}

static bool accept_lane(const Tile *tile, uint32_t i, RayBunch *b, int lane, const Root *root, Trace *t, CertainHit *out)
{
    const BunchFrames *f = &b->frames;
    Vec3 d = vec(f->d.x[lane], f->d.y[lane], f->d.z[lane]);
    return certain_accepts(tile_tree_of(tile), i, tile, d, f->length[lane], root, t, out);
}

static bool nearest_alone(const Tile *tile, uint32_t i, RayBunch *b, int lane, double t_max, Trace *t, CertainHit *out)
{
    bunch_begin(b, lane, t);
    bool is_hit = certain_nearest_on(tile, i, &b->ray[lane], t_max, t, out);
    bunch_end(b, lane, t);
    return is_hit;
}

Lanes certain_nearest_on_bunch(const Tile *tile, uint32_t i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t,
                               CertainHit out[])
{
    Lanes hit = 0, rooted = 0, alone = lanes;
    Roots roots;
    if (!are_few(lanes)) {
        bunch_use_frames(b);
        alone = 0;
        rooted = roots_on(tile, b, lanes & b->frames.finite, t_max, &roots, &alone, t);
    }
    while (rooted) {
        int lane = lanes_next(&rooted);
        Root root = roots_get(&roots, lane);
        if (!accept_lane(tile, i, b, lane, &root, t, &out[lane])) continue;
        hit |= 1u << lane;
        b->lane[lane].root = (RayRoot){ tile->patch, root.s, root.t, b->lane[lane].seed };
    }
    while (alone) {
        int lane = lanes_next(&alone);
        if (nearest_alone(tile, i, b, lane, t_max[lane], t, &out[lane])) hit |= 1u << lane;
    }
    return hit;
}

static bool any_alone(const Tile *tile, uint32_t i, RayBunch *b, int lane, double t_max, Trace *t)
{
    bunch_begin(b, lane, t);
    bool is_blocked = certain_any_on(tile, i, &b->ray[lane], t_max, t);
    bunch_end(b, lane, t);
    return is_blocked;
}

Lanes certain_any_on_bunch(const Tile *tile, uint32_t i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    Lanes blocked = 0, rooted = 0, alone = lanes;
    Roots roots;
    if (!are_few(lanes)) {
        bunch_use_frames(b);
        alone = 0;
        rooted = roots_on(tile, b, lanes & b->frames.finite, t_max, &roots, &alone, t);
    }
    while (rooted) {
        int lane = lanes_next(&rooted);
        Root root = roots_get(&roots, lane);
        CertainHit hit;
        if (accept_lane(tile, i, b, lane, &root, t, &hit)) blocked |= 1u << lane;
    }
    while (alone) {
        int lane = lanes_next(&alone);
        if (any_alone(tile, i, b, lane, t_max[lane], t)) blocked |= 1u << lane;
    }
    return blocked;
}
