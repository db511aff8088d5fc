/* The search of `method certain`. See certain.h, and certify.h for what happens within a tile. */
#include "nurbs/certain.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

typedef struct Search Search;
typedef bool TakeRoot(Search *k, const Root *root, const CertainHit *hit);    /* no trim cuts it away; true: enough */
struct Search {
    const TileTree *tree;
    PatchRay ray;
    double *t_max;            /* the traversal's, in units of the ray's direction */
    double length;            /* of that direction */
    uint32_t tile;            /* being solved */
    Trace *trace;
    TakeRoot *take;
    bool found;
    CertainHit nearest;
    CertainList *all;         /* filled while the solver resets the scratch arena: */
    Arena *overflow;          /* what its first room does not hold */
};

/* How far S moves in the patch's parameters for a unit step along d, at the middle of the tile: the tangent part of d. */
static Vec2 step_along(const Tile *f, Vec3 d)
{
    Vec3 a = tile_vec(f->half_s), b = tile_vec(f->half_t);
    double aa = vec_dot(a, a), ab = vec_dot(a, b), bb = vec_dot(b, b), ad = vec_dot(a, d), bd = vec_dot(b, d);
    double det = 2 * (aa * bb - ab * ab);
    TilePlace at = tile_place(f);
    return vec2(at.ds * (bb * ad - ab * bd) / det, at.dt * (aa * bd - ab * ad) / det);
}

/* Roundings of a parameter that patch_u or patch_v computes, of its interval's larger end: two of the place in the patch,
 * one of the interval's length and one of their product, all four relative to a length of twice that end at most, and one of
 * the sum. */
#define ROUNDINGS_OF_PARAMETER 9
static double last_bits(double x0, double x1)
{
    return ROUNDINGS_OF_PARAMETER * 0.5 * DBL_EPSILON * double_max(fabs(x0), fabs(x1));
}

/* So often a line is halved where a trim runs beside it: it is then looked at in pieces of 2^-16. */
enum { MAX_CUTS_ALONG = 16 };

/* Do the trims keep anything of the line at +- half, as wide as `wide` to all sides? Slivers may lie anywhere on it, so what
 * is not wholly cut away is halved until it is no longer than wide. (A collapsed side makes it infinite: kept.) */
static bool keeps_along(const TrimTree *trims, Vec2 at, Vec2 half, Vec2 wide, int cuts)
{
    Vec2 reach = vec2(fabs(half.x) + wide.x, fabs(half.y) + wide.y), h = vec2_scale(half, 0.5);
    TrimRect box = { at.x - reach.x, at.x + reach.x, at.y - reach.y, at.y + reach.y };
    if (trim_class(trims, box) == TRIM_CUT) return false;
    bool is_long = fabs(half.x) > wide.x || fabs(half.y) > wide.y;
    if (!is_long || cuts == 0 || !isfinite(reach.x + reach.y)) return true;
    return keeps_along(trims, vec2_sub(at, h), h, wide, cuts - 1) || keeps_along(trims, vec2_add(at, h), h, wide, cuts - 1);
}

/* Faces that share an edge have trims that lie along the same curve in space, but not in the same parameters: where each
 * says that the other has the point, a ray would pass between them. So a root counts as kept if a trim passes as near as the
 * root is uncertain: in space to all sides by as much as it may be beside the ray, and along the ray by the error of its
 * depth, which is more where it grazes; in u and v by their last bits. */
static bool is_near_trim(const TrimTree *trims, const Tile *f, Vec3 d, const Root *root, double u, double v)
{
    double w_u = f->patch->u1 - f->patch->u0, w_v = f->patch->v1 - f->patch->v0;
    TilePlace at = tile_place(f);
    double du = root->beside * at.ds * w_u / (2.0 * f->length_s) + last_bits(f->patch->u0, f->patch->u1);
    double dv = root->beside * at.dt * w_v / (2.0 * f->length_t) + last_bits(f->patch->v0, f->patch->v1);
    Vec2 along = vec2_scale(step_along(f, d), root->depth_error);
    return keeps_along(trims, vec2(u, v), vec2(along.x * w_u, along.y * w_v), vec2(du, dv), MAX_CUTS_ALONG);
}

bool certain_keeps(const TileTree *tree, uint32_t i, const Tile *part, Vec3 d, const Root *root, double u, double v,
                   Trace *t)
{
    const TrimCell *cell = part->patch->is_trimmed ? tree->cells[i] : NULL;
    t->counters.nurbs_hits++;
    if (cell) {
        t->counters.trim_tests++;
        if (!trim_cell_keeps(cell, u, v) && !is_near_trim(tree->trims, part, d, root, u, v)) return false;
    }
    t->counters.reported_hits++;
    return true;
}

static bool accept_root(void *context, const Tile *f, PatchRay *ray, const Root *root)
{
    Search *k = context;
    double u = patch_u(f->patch, root->s), v = patch_v(f->patch, root->t);
    if (!certain_keeps(k->tree, k->tile, f, ray->d, root, u, v, k->trace)) return false;
    k->found = true;
    CertainHit hit = { .u = u, .v = v, .t = root->depth / k->length, .t_error = root->distance / k->length,
                       .depth_error = root->depth_error / k->length, .tile = k->tile, .part = f,
                       .before = root->before, .after = root->after };
    return k->take(k, root, &hit);
}

static bool take_any(Search *k, const Root *root, const CertainHit *hit)
{
    (void)k, (void)root, (void)hit;
    return true;
}

static bool take_nearest(Search *k, const Root *root, const CertainHit *hit)
{
    Trace *t = k->trace;
    k->nearest = *hit;
    k->ray.t_max = root->depth;
    *k->t_max = hit->t;
    t->root.patch = hit->part->patch, t->root.s = root->s, t->root.t = root->t, t->root.seed = t->seed;
    return false;
}

static bool solve_tile(Search *k, uint32_t i, const Tile *tile, double *t_max, Trace *t)
{
    k->t_max = t_max, k->tile = i, k->trace = t;
    t->counters.leaf_tests++;
    double begin = t->measures_time ? stats_now() : 0;
    bool ended = tile_roots(tile, &k->ray, accept_root, k, t);
    if (t->measures_time) t->counters.nurbs_seconds += stats_now() - begin;
    return ended;
}

static bool visit_tile(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *k = context;
    (void)r;
    return solve_tile(k, i, &k->tree->tiles[i], t_max, t);
}

/* Sets t->frame for the ray's direction, unless it is there from the surface before; the direction's length. */
static double use_frame(const Ray *r, Trace *t)
{
    if (vec_is_same(r->dir, t->frame.dir)) return t->frame.length;
    t->frame.dir = r->dir, t->frame.length = vec_length(r->dir), t->frame.d = vec_normalize(r->dir);
    frame_of_direction(t->frame.d, &t->frame.n1, &t->frame.n2);
    return t->frame.length;
}

/* The fields that a search for one hit needs: not all are set to zero for each tile. */
static inline void begin(Search *k, const TileTree *tree, TakeRoot *take)
{
    k->tree = tree, k->take = take, k->found = false;
}

/* base: of the surface. false: it is no ray. */
static inline bool set_ray(Search *k, Vec3 base, const Ray *r, double t_max, Trace *t)
{
    if (!vec_is_finite(r->origin) || !vec_is_finite(r->dir)) return false;
    k->length = use_frame(r, t);
    k->ray = (PatchRay){ .origin = vec_sub(r->origin, base), .d = t->frame.d, .n1 = t->frame.n1, .n2 = t->frame.n2,
                         .t_min = r->t_min * k->length, .t_max = t_max * k->length,
                         .from = t->root.seed == t->seed ? t->root.patch : NULL, .from_s = t->root.s, .from_t = t->root.t };
    return true;
}

/* Tiles that the ray comes near: the nearest first, or in any order, until one ends the search if one does. */
typedef enum { SEARCH_NEAREST, SEARCH_ANY_ORDER } SearchFor;

static bool search_tiles(Search *k, const Ray *r, double t_max, SearchFor what, Trace *t)
{
    if (!set_ray(k, k->tree->base, r, t_max, t)) return false;
    Ray in_bvh = { vec_sub(r->origin, k->tree->bvh_base), r->dir, r->t_min };
    if (what == SEARCH_ANY_ORDER) return bvh_any(k->tree->bvh, &in_bvh, t_max, visit_tile, k, t);
    bvh_traverse(k->tree->bvh, &in_bvh, &t_max, visit_tile, k, t);
    return k->found;
}

bool certain_nearest(const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainHit *out)
{
    Search k;
    begin(&k, tree, take_nearest);
    if (!search_tiles(&k, r, t_max, SEARCH_NEAREST, t)) return false;
    *out = k.nearest;
    return true;
}

bool certain_nearest_on(const Tile *tile, uint32_t i, const Ray *r, double t_max, Trace *t, CertainHit *out)
{
    Search k;
    begin(&k, tile_tree_of(tile), take_nearest);
    if (!set_ray(&k, tile->patch->base, r, t_max, t)) return false;
    solve_tile(&k, i, tile, &t_max, t);
    if (k.found) *out = k.nearest;
    return k.found;
}

static bool is_still_blocked(Search *k, const Ray *r, double t_max, Trace *t)
{
    uint32_t tile = blocker_recall(&t->blockers, k->tree);
    if (tile >= k->tree->n_tiles) return false;
    if (set_ray(k, k->tree->base, r, t_max, t) && visit_tile(k, tile, r, &t_max, t)) return true;
    blocker_forget(&t->blockers, k->tree);
    return false;
}

bool certain_any(const TileTree *tree, const Ray *r, double t_max, Trace *t)
{
    Search k;
    begin(&k, tree, take_any);
    if (is_still_blocked(&k, r, t_max, t)) return true;
    if (!search_tiles(&k, r, t_max, SEARCH_ANY_ORDER, t)) return false;
    blocker_note(&t->blockers, tree, k.tile);
    return true;
}

bool certain_any_on(const Tile *tile, uint32_t i, const Ray *r, double t_max, Trace *t)
{
    Search k;
    begin(&k, tile_tree_of(tile), take_any);
    return set_ray(&k, tile->patch->base, r, t_max, t) && solve_tile(&k, i, tile, &t_max, t);
}

/* ---- all hits ---- */

enum { FIRST_ROOM = 64 };     /* hits of a ray and a surface: more is rare */

static bool take_all(Search *k, const Root *root, const CertainHit *hit)
{
    (void)root;
    CertainList *l = k->all;
    if (l->n == l->capacity && !k->overflow) k->overflow = arena_new();
    ARENA_PUSH(k->overflow, l->hits, l->n, l->capacity) = *hit;    /* the arena is needed only where the list is full */
    return false;
}

static int compare_depths(const void *a, const void *b)
{
    double x = ((const CertainHit *)a)->t, y = ((const CertainHit *)b)->t;
    return (x > y) - (x < y);
}

/* By where they may begin: one whose error is large may overlap with what lies before others that do not. */
static int compare_starts(const void *a, const void *b)
{
    const CertainHit *h = a, *k = b;
    double x = h->t - h->depth_error, y = k->t - k->depth_error;
    return (x > y) - (x < y);
}

/* The sign of the normal times the ray's direction where the ray comes to the hit, or where it leaves it. */
static bool is_facing(const TileTree *tree, const Ray *r, const CertainHit *h, int side)
{
    return (side ? side : vec_dot(certain_normal(tree, h->tile, h->u, h->v, r), r->dir)) > 0;
}

/* Hits whose error bounds overlap cannot be told apart: one root that two neighbours found on their common border, or all
 * patches that meet at a pole; those that a tangency left in many boxes. The ray goes through the surface there, if it sees
 * the same side of it before and after; else it touches it, which counts twice, or not at all if there is but one hit.
 * Writes over hits[0 .. n); returns how many are left. */
static size_t join_hits(const TileTree *tree, const Ray *r, CertainHit *hits, size_t n)
{
    CertainHit *last = &hits[n - 1];
    if (n == 1 && hits->before == hits->after) return 1;
    if (is_facing(tree, r, hits, hits->before) == is_facing(tree, r, last, last->after)) return 1;
    if (n == 1) return 0;
    hits[1] = *last;
    return 2;
}

/* The number of hits, of n by their starts, that overlap with the first or with one that does. */
static size_t count_together(const CertainHit *hits, size_t n)
{
    double reach = hits->t + hits->depth_error;
    size_t i = 1;
    for (; i < n && hits[i].t - hits[i].depth_error <= reach; i++)
        reach = double_max(reach, hits[i].t + hits[i].depth_error);
    return i;
}

void certain_all(const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainList *out)
{
    *out = (CertainList){ ARENA_ARRAY(t->scratch, CertainHit, FIRST_ROOM), 0, FIRST_ROOM };
    Search k = { .tree = tree, .take = take_all, .all = out };
    search_tiles(&k, r, t_max, SEARCH_ANY_ORDER, t);
    if (k.overflow) out->hits = arena_copy(t->scratch, out->hits, out->n, sizeof *out->hits);
    arena_free(k.overflow);
    if (out->n > 1) qsort(out->hits, out->n, sizeof *out->hits, compare_starts);
    size_t n = 0;
    for (size_t i = 0, together; i < out->n; i += together) {
        together = count_together(out->hits + i, out->n - i);
        if (together > 1) qsort(out->hits + i, together, sizeof *out->hits, compare_depths);
        size_t left = join_hits(tree, r, out->hits + i, together);
        memmove(out->hits + n, out->hits + i, left * sizeof *out->hits);
        n += left;
    }
    out->n = n;
}

Vec3 certain_normal(const TileTree *tree, uint32_t i, double u, double v, const Ray *r)
{
    const Patch *p = tree->tiles[i].patch;
    return patch_normal(p, (u - p->u0) / (p->u1 - p->u0), (v - p->v0) / (p->v1 - p->v0), vec_neg(r->dir));
}
