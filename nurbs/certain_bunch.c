/* Eight rays at a tile, and then at its halves, those that it leaves in doubt; or each at a tile of its own. They go on
 * alone where that leads nowhere, and where the machine has no registers for eight. What a ray finds at a tile does not
 * depend on those beside it, but by rounding, where they ask for other tiles. */
#include "nurbs/certain_bunch.h"

#include "nurbs/certain.h"
#include "nurbs/doubt.h"
#include "render/bvh_bunch.h"

/* A tile is halved so often for lanes in doubt before they go on alone. */
enum { MAX_LEVEL = 6 };

typedef struct {
    RayBunch *b;
    const BunchItems *items;     /* tiles, by their numbers in their trees */
    BunchLimits limits;
    Trace *trace;
    CertainHits *nearest;        /* NULL: any hit will do, and ends the lane's search */
    Lanes hit;
} Search;

typedef struct { const Tile *part; Lanes lanes; int level; } Doubt;

static const Tile *tile_at(const Search *k, int i) { return bunch_at(k->items, i); }
static uint32_t tile_number(const Search *k, int i) { return bunch_item(k->items, i); }

/* ---- one by one ---- */

static void keep_hit(CertainHits *out, int i, const CertainHit *hit)
{
    out->t[i] = hit->t, out->t_error[i] = hit->t_error, out->u[i] = hit->u, out->v[i] = hit->v, out->tile[i] = hit->tile;
}

static void go_alone(Search *k, const Tile *part, int i)
{
    const Ray *r = &k->b->ray[i];
    double *limit = bunch_limit(k->limits, i);
    CertainHit hit;
    bunch_begin(k->b, i, k->trace);
    bool is_hit = k->nearest ? certain_nearest_on(part, tile_number(k, i), r, *limit, k->trace, &hit)
                             : certain_any_on(part, tile_number(k, i), r, *limit, k->trace);
    bunch_end(k->b, i, k->trace);
    if (!is_hit) return;
    k->hit |= 1u << i;
    if (k->nearest) *limit = hit.t, keep_hit(k->nearest, i, &hit);
}

/* ---- together ---- */

/* Roots as hits. */
typedef struct { V8d t, t_error, u, v; } Found;

/* patch_u, patch_v. */
ALWAYS_INLINE V8d parameter(V8d s, double u0, double u1)
{
    return v8d_select(v8d_less(s, v8d_splat(1)), u0 + s * (u1 - u0), v8d_splat(u1));
}

ALWAYS_INLINE void find(const Search *k, const Patch *p, const Roots *roots, Found *out)
{
    V8d length = k->b->frames.length;
    out->t = roots->depth / length, out->t_error = roots->distance / length;
    out->u = parameter(roots->s, p->u0, p->u1), out->v = parameter(roots->t, p->v0, p->v1);
}

static Lanes keep_roots(const Search *k, const Tile *part, const Roots *roots, const Found *found, Lanes rooted)
{
    const BunchFrames *f = &k->b->frames;
    Lanes kept = 0;
    for (Lanes left = rooted; left; ) {
        int i = lanes_next(&left);
        Root root = roots_get(roots, i);
        Vec3 d = vec8_get(&f->d, i);
        bool is_kept = certain_keeps(tile_tree_of(part), tile_number(k, i), part, d, &root, found->u[i], found->v[i],
                                     k->trace);
        kept |= (Lanes)is_kept << i;
    }
    return kept;
}

static void take_nearest(Search *k, const Tile *part, const Roots *roots, const Found *found, Lanes kept)
{
    CertainHits *out = k->nearest;
    while (kept) {
        int i = lanes_next(&kept);
        BunchLane *lane = &k->b->lane[i];
        *bunch_limit(k->limits, i) = out->t[i] = found->t[i], out->t_error[i] = found->t_error[i];
        out->u[i] = found->u[i], out->v[i] = found->v[i], out->tile[i] = tile_number(k, i);
        lane->root = (RayRoot){ part->patch, roots->s[i], roots->t[i], lane->seed };
    }
}

ALWAYS_INLINE void take_roots(Search *k, const Tile *part, const Roots *roots, Lanes rooted)
{
    Found found;
    find(k, part->patch, roots, &found);
    if (part->patch->is_trimmed) {
        rooted = keep_roots(k, part, roots, &found, rooted);
    } else {
        uint64_t n = (uint64_t)__builtin_popcount(rooted);
        k->trace->counters.nurbs_hits += n, k->trace->counters.reported_hits += n;
    }
    k->hit |= rooted;
    if (k->nearest) take_nearest(k, part, roots, &found, rooted);
}

/* The lanes that a tile or a part of it leaves in doubt; those that its halves cannot help go on alone. */
ALWAYS_INLINE Lanes solve_part(Search *k, const Tile *part, Lanes lanes)
{
    Roots roots;
    LanesLeft left;
    Lanes rooted = tile_roots_bunch(part, k->b, lanes, k->limits, &roots, &left, k->trace);
    if (rooted) take_roots(k, part, &roots, rooted);
    while (left.alone) go_alone(k, part, lanes_next(&left.alone));
    return left.in_doubt;
}

/* A side that is one point has proofs of its own for single rays. */
static const Halves *halves_for(const Doubt *d)
{
    return d->level == MAX_LEVEL || d->part->patch->collapsed ? NULL : tile_halves(d->part);
}

EVERY_X86
static void search_parts(Search *k, const Tile *tile, Lanes lanes)
{
    bunch_use_frames(k->b);
    Doubt stack[MAX_LEVEL + 1] = { { tile, lanes & k->b->frames.finite, 0 } };
    for (int top = 1; top > 0; ) {
        Doubt d = stack[--top];
        if (!k->nearest && !(d.lanes &= ~k->hit)) continue;
        Lanes left = solve_part(k, d.part, d.lanes);
        const Halves *halves = left ? halves_for(&d) : NULL;
        for (int i = 0; i < 2 && halves; i++) stack[top++] = (Doubt){ &halves->tiles[i], left, d.level + 1 };
        while (left && !halves) go_alone(k, d.part, lanes_next(&left));
    }
}

/* ---- each at a tile of its own ---- */

static void take_root(Search *k, int i, const Root *root)
{
    const Tile *tile = tile_at(k, i);
    const Patch *p = tile->patch;
    const BunchFrames *f = &k->b->frames;
    double u = patch_u(p, root->s), v = patch_v(p, root->t), length = f->length[i];
    if (!certain_keeps(tile_tree_of(tile), tile_number(k, i), tile, vec8_get(&f->d, i), root, u, v, k->trace)) return;
    k->hit |= 1u << i;
    if (!k->nearest) return;
    CertainHit hit = { .t = root->depth / length, .t_error = root->distance / length, .u = u, .v = v,
                       .tile = tile_number(k, i) };
    keep_hit(k->nearest, i, &hit);
    *bunch_limit(k->limits, i) = hit.t;
    k->b->lane[i].root = (RayRoot){ p, root->s, root->t, k->b->lane[i].seed };
}

/* Rays at tiles with poles, which have proofs of their own (pole_cone.h), go alone; the others. */
static Lanes leave_poles(Search *k, Lanes lanes)
{
    Lanes others = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        if (tile_at(k, i)->cone) go_alone(k, tile_at(k, i), i);
        else others |= 1u << i;
    }
    return others;
}

EVERY_X86
static void search_each(Search *k, Lanes lanes)
{
    bunch_use_frames(k->b);
    lanes = leave_poles(k, lanes & k->b->frames.finite);
    if (!lanes) return;
    const Tile *tiles[BUNCH_WIDTH], *any = tile_at(k, __builtin_ctz(lanes));
    for (int i = 0; i < BUNCH_WIDTH; i++) tiles[i] = lanes >> i & 1 ? tile_at(k, i) : any;
    Roots roots;
    LanesLeft left;
    Lanes rooted = tiles_roots_bunch(tiles, k->b, lanes, k->limits, &roots, &left, k->trace);
    while (rooted) {
        int i = lanes_next(&rooted);
        Root root = roots_get(&roots, i);
        take_root(k, i, &root);
    }
    for (Lanes alone = left.alone | left.in_doubt; alone; ) {
        int i = lanes_next(&alone);
        go_alone(k, tiles[i], i);
    }
}

/* ---- counted ---- */

/* Each lane counts once. */
static Lanes search(Search *k, Lanes lanes)
{
    Counters *count = &k->trace->counters;
    uint64_t n_tests = count->leaf_tests + (uint64_t)__builtin_popcount(lanes);
    double begin = k->trace->measures_time ? stats_now() : 0, counted = count->nurbs_seconds;
    if (!v8d_is_one_register()) {
        while (lanes) {
            int i = lanes_next(&lanes);
            go_alone(k, tile_at(k, i), i);
        }
    } else if (k->items->is_one) {
        search_parts(k, tile_at(k, 0), lanes);
    } else {
        search_each(k, lanes);
    }
    count->leaf_tests = n_tests;
    if (k->trace->measures_time) count->nurbs_seconds = counted + stats_now() - begin;
    return k->hit;
}

Lanes certain_nearest_on_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, BunchLimits limits, Trace *t,
                               CertainHits *out)
{
    return search(&(Search){ .b = b, .items = items, .limits = limits, .trace = t, .nearest = out }, lanes);
}

Lanes certain_any_on_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    return search(&(Search){ .b = b, .items = items, .limits = { (double *)t_max, 1 }, .trace = t }, lanes);
}

/* ---- a whole tree ---- */

/* Boxes about a base of their own: the bunch's rays are not about it. */
static bool has_own_base(const TileTree *tree) { return vec_max_abs(tree->bvh_base) != 0; }

typedef struct {
    const TileTree *tree;
    CertainHits *out;
    Lanes hit;
} Walk;

static Lanes nearest_alone(const Walk *w, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    Lanes hit = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        CertainHit h;
        bunch_begin(b, i, t);
        if (certain_nearest(w->tree, &b->ray[i], t_max[i], t, &h)) keep_hit(w->out, i, &h), hit |= 1u << i;
        bunch_end(b, i, t);
    }
    return hit;
}

/* Where the tiles lie. */
static BunchItems found_in(const TileTree *tree, const BunchItems *items, Lanes lanes)
{
    BunchItems out;
    out.is_one = items->is_one;
    for (Lanes left = items->is_one ? 1 : lanes; left; ) {
        int i = lanes_next(&left);
        out.item[i] = items->item[i], out.at[i] = &tree->tiles[items->item[i]];
    }
    return out;
}

static Lanes visit_nearest(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    Walk *w = context;
    BunchItems tiles = found_in(w->tree, items, lanes);
    w->hit |= certain_nearest_on_bunch(&tiles, b, lanes, (BunchLimits){ t_max, 1 }, t, w->out);
    return 0;
}

Lanes certain_nearest_bunch(const TileTree *tree, RayBunch *b, Lanes lanes, double t_max[], Trace *t, CertainHits *out)
{
    Walk w = { tree, out, 0 };
    if (has_own_base(tree)) return nearest_alone(&w, b, lanes, t_max, t);
    bvh_traverse_bunch(tree->bvh, b, lanes, t_max, visit_nearest, &w, t);
    return w.hit;
}

static Lanes any_alone(const TileTree *tree, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    Lanes blocked = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        bunch_begin(b, i, t);
        if (certain_any(tree, &b->ray[i], t_max[i], t)) blocked |= 1u << i;
        bunch_end(b, i, t);
    }
    return blocked;
}

static Lanes visit_any(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    const TileTree *tree = context;
    BunchItems tiles = found_in(tree, items, lanes);
    Lanes blocked = certain_any_on_bunch(&tiles, b, lanes, t_max, t);
    if (blocked) blocker_note(&t->blockers, tree, bunch_item(&tiles, __builtin_ctz(blocked)));
    return blocked;
}

static Lanes still_blocked(const TileTree *tree, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    uint32_t i = blocker_recall(&t->blockers, tree);
    if (i >= tree->n_tiles) return 0;
    BunchItems tile = { .is_one = true, .item = { i }, .at = { &tree->tiles[i] } };
    Lanes blocked = certain_any_on_bunch(&tile, b, lanes, t_max, t);
    if (!blocked) blocker_forget(&t->blockers, tree);
    return blocked;
}

Lanes certain_any_bunch(const TileTree *tree, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    if (has_own_base(tree)) return any_alone(tree, b, lanes, t_max, t);
    Lanes blocked = still_blocked(tree, b, lanes, t_max, t);
    if (lanes & ~blocked) blocked |= bvh_any_bunch(tree->bvh, b, lanes & ~blocked, t_max, visit_any, (void *)tree, t);
    return blocked;
}
