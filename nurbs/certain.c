/* Preparation and search of `method certain`. See certain.h, and certify.h for what happens within a patch. */
#include "nurbs/certain.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "nurbs/prepare.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Halving divides the variation of the derivatives by about two. What bends forever (a pole, a cusp) is left to clip.c,
 * which refines along the ray alone. */
#define MAX_HALVINGS 8

/* ---- preparation ---- */

/* The tree of boxes is the tree of halvings itself, below a halving of the grid of spans: neighbours in the parameters are
 * neighbours in space, and nothing has to be sorted. */
typedef struct {
    const Surface *s;                /* its points about the tree's base */
    double rounding;                 /* of the patches' points */
    Vec3 to_bvh;                     /* from the tree's base to that of its boxes */
    double variation;                /* that patches may have */
    Arena *own, *lists;
    Tile *tiles;
    const TrimCell **cells;
    BvhNode *nodes;
    size_t n_tiles, n_cells, n_nodes, tiles_capacity, cells_capacity, nodes_capacity;
    uint32_t n_cut, n_untested;
    const int *spans_u, *spans_v;    /* indices of the non-empty spans */
} Preparation;

/* Room for two nodes side by side; the index of the first. */
static uint32_t new_pair(Preparation *k)
{
    for (int i = 0; i < 2; i++)
        ARENA_PUSH(k->lists, k->nodes, k->n_nodes, k->nodes_capacity) = (BvhNode){ .box = box_empty() };
    return (uint32_t)k->n_nodes - 2;
}

/* Makes node `at` of the pair's trees, whichever are there. */
static bool join_pair(Preparation *k, uint32_t at, uint32_t pair, bool has_first, bool has_second)
{
    BvhNode *n = k->nodes;
    if (has_first && has_second) n[at] = (BvhNode){ box_union(n[pair].box, n[pair + 1].box), pair, 0 };
    else if (has_first || has_second) n[at] = n[has_first ? pair : pair + 1];
    return has_first || has_second;
}

/* What is cut: where it lies, and which interval of the surface's parameters that is. */
typedef struct { const Patch *patch; TilePlace place; TrimRect rect; } Part;

/* false: on a closer look it is wholly trimmed away. */
static bool keep_tile(Preparation *k, uint32_t at, const Vec4 *net, const Part *part)
{
    const Surface *s = k->s;
    const TrimCell *cell = NULL;
    if (s->trims && trim_cell_new(k->own, k->lists, s->trims, part->rect, &cell) == TRIM_CUT) {
        k->n_cut++;
        return false;
    }
    k->n_untested += s->trims && !cell;
    Box hull = box_moved(bezier_hull(s->k_u * s->k_v, net), vec_add(part->patch->origin, k->to_bvh));
    k->nodes[at] = (BvhNode){ box_expand(hull, 2 * k->rounding), (uint32_t)k->n_tiles, 1 };
    tile_make(part->patch, net, part->place, &ARENA_PUSH(k->lists, k->tiles, k->n_tiles, k->tiles_capacity));
    if (s->trims) ARENA_PUSH(k->lists, k->cells, k->n_cells, k->cells_capacity) = cell;
    return true;
}

typedef struct { int u, v; } Halvings;

/* Which direction to halve along; false: neither is worth it. Where one is used up, what it would take away stays (a side
 * that collapses to a pole bends by all of itself, however near one looks), and the other is halved for its own share. */
static bool choose_halving(const Preparation *k, TileBend bend, Halvings left, bool *along_u)
{
    if (!(bend.variation > k->variation)) return false;
    *along_u = bend.along_u >= bend.along_v;
    if (*along_u ? left.u > 0 : left.v > 0) return true;
    *along_u = !*along_u;
    return (*along_u ? left.u : left.v) > 0 && 0.5 * (*along_u ? bend.along_u : bend.along_v) > k->variation;
}

/* Cuts the net of a part until each piece is worth a frame, below node `at`; `net` is used up. Returns whether anything of
 * it is kept. */
static bool grow_tiles(Preparation *k, uint32_t at, Vec4 *net, Part part, Halvings left)
{
    const Surface *s = k->s;
    part.rect = tile_rect(part.patch, part.place);
    TrimClass class = s->trims ? trim_class(s->trims, part.rect) : TRIM_KEPT;
    k->n_cut += class == TRIM_CUT;
    if (class == TRIM_CUT) return false;
    bool along_u;
    if (!choose_halving(k, tile_bend(s->k_u, s->k_v, net), left, &along_u)) return keep_tile(k, at, net, &part);
    Vec4 first[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    Part a = part, b = part;
    if (along_u) {
        a.place.ds = b.place.ds = 0.5 * part.place.ds, b.place.s0 += a.place.ds, left.u--;
        for (int j = 0; j < s->k_v; j++) bezier_cut(s->k_u, 1, 0.5, net + j * s->k_u, first + j * s->k_u);
    } else {
        a.place.dt = b.place.dt = 0.5 * part.place.dt, b.place.t0 += a.place.dt, left.v--;
        bezier_cut(s->k_v, s->k_u, 0.5, net, first);
    }
    uint32_t pair = new_pair(k);
    bool has_a = grow_tiles(k, pair, first, a, left), has_b = grow_tiles(k, pair + 1, net, b, left);
    return join_pair(k, at, pair, has_a, has_b);
}

/* One span: its patch, unless the trims leave nothing of it. */
static bool grow_span(Preparation *k, uint32_t at, int mu_u, int mu_v)
{
    const Surface *s = k->s;
    TrimRect rect = { s->tau_u[mu_u], s->tau_u[mu_u + 1], s->tau_v[mu_v], s->tau_v[mu_v + 1] };
    if (s->trims && trim_class(s->trims, rect) == TRIM_CUT) {
        k->n_cut++;
        return false;
    }
    Vec4 net[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    Patch *patch = ARENA_NEW(k->own, Patch);
    prepare_close_span(s, mu_u, mu_v, net);
    patch_make(k->own, s->k_u, s->k_v, net, k->rounding, rect, patch);
    patch->arena = k->own;
    memcpy(net, patch->p, (size_t)(s->k_u * s->k_v) * sizeof *net);
    return grow_tiles(k, at, net, (Part){ patch, { 0, 0, 1, 1 }, rect }, (Halvings){ MAX_HALVINGS, MAX_HALVINGS });
}

typedef struct { int u0, u1, v0, v1; } SpanRange;    /* of spans_u, spans_v */

static bool grow_spans(Preparation *k, uint32_t at, SpanRange r)
{
    if (r.u1 - r.u0 == 1 && r.v1 - r.v0 == 1) return grow_span(k, at, k->spans_u[r.u0], k->spans_v[r.v0]);
    SpanRange a = r, b = r;
    if (r.u1 - r.u0 >= r.v1 - r.v0) a.u1 = b.u0 = r.u0 + (r.u1 - r.u0) / 2;
    else a.v1 = b.v0 = r.v0 + (r.v1 - r.v0) / 2;
    uint32_t pair = new_pair(k);
    bool has_a = grow_spans(k, pair, a), has_b = grow_spans(k, pair + 1, b);
    return join_pair(k, at, pair, has_a, has_b);
}

static int *list_spans(Arena *a, int k, int n, const double *tau, int *n_spans)
{
    int *list = ARENA_ARRAY(a, int, n);
    *n_spans = 0;
    for (int i = k - 1; i < n; i++)
        if (knots_is_span(tau, i)) list[(*n_spans)++] = i;
    return list;
}

/* The control points about their middle: one rounding relative to the surface's own size, fma(-w, base, wx). */
static Vec4 *points_about(Arena *a, const Surface *s, Vec3 base)
{
    size_t n = (size_t)s->n_u * (size_t)s->n_v;
    Vec4 *p = arena_copy(a, s->p, n, sizeof *p);
    for (size_t i = 0; i < n; i++) {
        p[i].x = fma(-p[i].w, base.x, p[i].x);
        p[i].y = fma(-p[i].w, base.y, p[i].y);
        p[i].z = fma(-p[i].w, base.z, p[i].z);
    }
    return p;
}

/* How far the points of a patch may be from where exact arithmetic has them, in space: u = 2^-53 of the surface's size for
 * each rounding. Closing a span takes 2 (k-1) combinations in each direction (bezier.h), moving the points about the base
 * one more. Not the worst case of these, which is 8 k a direction: roundings of either sign are averaged by every
 * combination, and neighbours close their border with the same numbers; tests hold it against exact arithmetic. Weights have
 * been multiplied with coordinates before (surface.c), which rounds by u of these, however far off they are: of three by
 * sqrt 3. */
static double rounding_of_patches(const Surface *s)
{
    double u = 0.5 * DBL_EPSILON, farthest = 0;
    Vec3 lo = vec(s->box.lo[0], s->box.lo[1], s->box.lo[2]), hi = vec(s->box.hi[0], s->box.hi[1], s->box.hi[2]);
    if (!s->is_polynomial) farthest = double_max(vec_max_abs(lo), vec_max_abs(hi));
    return u * (s->k_u + s->k_v + 8) * s->size + sqrt(3) * u * farthest;
}

/* A patch of high order is dear to keep, k_u k_v points: up to order 4 nothing changes, beyond it patches may vary more, so
 * that their number falls about as fast as their points grow. */
static double coarseness(const Surface *s)
{
    double points = s->k_u * s->k_v;
    return points > 16 ? pow(points / 16, 0.25) : 1;
}

/* Boxes are in single precision: those of a surface that lies farther from the origin than this, in its own diagonals, are
 * about its middle. All others share their space with the trees around them, whose work on a ray is then not done again. */
#define FAR_OFF 16

void certain_prepare(Arena *a, const Surface *surface, double variation, TileTree *out)
{
    Preparation k = { .own = a, .lists = arena_new(), .rounding = rounding_of_patches(surface) };
    k.variation = (variation > 0 ? variation : CERTAIN_VARIATION) * coarseness(surface);
    size_t used = arena_used(a);
    Vec3 base = box_centre(surface->box), nowhere = { 0, 0, 0 };
    bool is_far = vec_max_abs(base) > FAR_OFF * box_diagonal(surface->box);
    k.to_bvh = is_far ? nowhere : base;
    Surface about_base = *surface, *s = &about_base;
    about_base.p = points_about(k.lists, surface, base);
    k.s = s;
    SpanRange all = { 0 };
    k.spans_u = list_spans(k.lists, s->k_u, s->n_u, s->tau_u, &all.u1);
    k.spans_v = list_spans(k.lists, s->k_v, s->n_v, s->tau_v, &all.v1);
    uint32_t root = new_pair(&k);
    bool has_any = grow_spans(&k, root, all);
    *out = (TileTree){ .base = base, .bvh_base = is_far ? base : nowhere,
                        .tiles = arena_copy(a, k.tiles, k.n_tiles, sizeof *k.tiles),
                        .cells = s->trims ? arena_copy(a, k.cells, k.n_cells, sizeof *k.cells) : NULL,
                        .n_tiles = (uint32_t)k.n_tiles,
                        .bvh = bvh_from_tree(a, k.nodes, has_any ? (uint32_t)k.n_nodes : 0),
                        .n_cut = k.n_cut, .n_untested = k.n_untested };
    out->bytes = arena_used(a) - used;
    arena_free(k.lists);
}

/* ---- search ---- */

typedef struct Search Search;
typedef bool TakeRoot(Search *k, const Root *root, const CertainHit *hit);    /* no trim cuts it away; true: enough */
struct Search {
    const Surface *s;
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

static Vec3 from_floats(const float x[3]) { return vec(x[0], x[1], x[2]); }

/* How far S moves in the patch's parameters for a unit step along d, at the middle of the tile: the tangent part of d. */
static Vec2 step_along(const Tile *f, Vec3 d)
{
    Vec3 a = from_floats(f->half_s), b = from_floats(f->half_t);
    double aa = vec_dot(a, a), ab = vec_dot(a, b), bb = vec_dot(b, b), ad = vec_dot(a, d), bd = vec_dot(b, d);
    double det = 2 * (aa * bb - ab * ab);
    return vec2(f->ds * (bb * ad - ab * bd) / det, f->dt * (aa * bd - ab * ad) / det);
}

/* Of a parameter that patch_u or patch_v computes: three roundings, none of a larger number than the ends. */
static double last_bits(double x0, double x1) { return 3 * 0.5 * DBL_EPSILON * double_max(fabs(x0), fabs(x1)); }

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
 * root is uncertain: in space by its distance to all sides, and along the ray by the error of its depth, which is more where
 * it grazes; in u and v by their last bits. */
static bool is_near_trim(const TrimTree *trims, const Tile *f, Vec3 d, const Root *root, double u, double v)
{
    double w_u = f->patch->u1 - f->patch->u0, w_v = f->patch->v1 - f->patch->v0;
    double du = root->distance * f->ds * w_u / (2.0 * f->length_s) + last_bits(f->patch->u0, f->patch->u1);
    double dv = root->distance * f->dt * w_v / (2.0 * f->length_t) + last_bits(f->patch->v0, f->patch->v1);
    Vec2 along = vec2_scale(step_along(f, d), root->depth_error);
    return keeps_along(trims, vec2(u, v), vec2(along.x * w_u, along.y * w_v), vec2(du, dv), MAX_CUTS_ALONG);
}

static bool accept_root(void *context, const Tile *f, PatchRay *ray, const Root *root)
{
    Search *k = context;
    Counters *count = &k->trace->counters;
    count->nurbs_hits++;
    double u = patch_u(f->patch, root->s), v = patch_v(f->patch, root->t);
    const TrimCell *cell = k->tree->cells ? k->tree->cells[k->tile] : NULL;
    if (cell) {
        count->trim_tests++;
        if (!trim_cell_keeps(cell, u, v) && !is_near_trim(k->s->trims, f, ray->d, root, u, v)) return false;
    }
    count->reported_hits++;
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
    t->root.leaf = hit->part, t->root.s = root->s, t->root.t = root->t, t->root.seed = t->seed;
    return false;
}

static bool visit_tile(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *k = context;
    (void)r;
    k->t_max = t_max, k->tile = i, k->trace = t;
    t->counters.leaf_tests++;
    double begin = t->measures_time ? stats_now() : 0;
    bool ended = tile_roots(&k->tree->tiles[i], &k->ray, accept_root, k, t);
    if (t->measures_time) t->counters.nurbs_seconds += stats_now() - begin;
    return ended;
}

/* Sets t->frame for the ray's direction, unless it is there from the surface before; the direction's length. */
static double use_frame(const Ray *r, Trace *t)
{
    Vec3 a = r->dir, b = t->frame.dir;
    if (a.x == b.x && a.y == b.y && a.z == b.z) return t->frame.length;
    PatchRay p = patch_ray(r->origin, vec_normalize(a), 0, 0);
    t->frame.dir = a, t->frame.length = vec_length(a);
    t->frame.d = p.d, t->frame.n1 = p.n1, t->frame.n2 = p.n2;
    return t->frame.length;
}

/* The fields that a search for one hit needs: not all are set to zero for each tile. */
static inline void begin(Search *k, const Surface *s, const TileTree *tree, TakeRoot *take)
{
    k->s = s, k->tree = tree, k->take = take, k->found = false;
}

/* false: it is no ray. */
static inline bool set_ray(Search *k, const Ray *r, double t_max, Trace *t)
{
    if (!vec_is_finite(r->origin) || !vec_is_finite(r->dir)) return false;
    k->length = use_frame(r, t);
    k->ray = (PatchRay){ .origin = vec_sub(r->origin, k->tree->base), .d = t->frame.d, .n1 = t->frame.n1, .n2 = t->frame.n2,
                         .t_min = r->t_min * k->length, .t_max = t_max * k->length,
                         .guess = t->root.seed == t->seed ? t->root.leaf : NULL, .guess_s = t->root.s, .guess_t = t->root.t };
    return true;
}

static bool search_tiles(Search *k, const Ray *r, double t_max, Trace *t)
{
    if (!set_ray(k, r, t_max, t)) return false;
    Ray in_bvh = { vec_sub(r->origin, k->tree->bvh_base), r->dir, r->t_min };
    bvh_traverse(k->tree->bvh, &in_bvh, &t_max, visit_tile, k, t);
    return k->found;
}

bool certain_nearest(const Surface *s, const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainHit *out)
{
    Search k;
    begin(&k, s, tree, take_nearest);
    if (!search_tiles(&k, r, t_max, t)) return false;
    *out = k.nearest;
    return true;
}

bool certain_nearest_on(const Surface *s, const TileTree *tree, uint32_t tile, const Ray *r, double t_max, Trace *t,
                        CertainHit *out)
{
    Search k;
    begin(&k, s, tree, take_nearest);
    if (!set_ray(&k, r, t_max, t)) return false;
    visit_tile(&k, tile, r, &t_max, t);
    if (k.found) *out = k.nearest;
    return k.found;
}

static bool is_still_blocked(Search *k, const Ray *r, double t_max, Trace *t)
{
    uint32_t tile = blocker_recall(&t->blockers, k->tree);
    if (tile >= k->tree->n_tiles) return false;
    if (set_ray(k, r, t_max, t) && visit_tile(k, tile, r, &t_max, t)) return true;
    blocker_forget(&t->blockers, k->tree);
    return false;
}

bool certain_any(const Surface *s, const TileTree *tree, const Ray *r, double t_max, Trace *t)
{
    Search k;
    begin(&k, s, tree, take_any);
    if (is_still_blocked(&k, r, t_max, t)) return true;
    if (!search_tiles(&k, r, t_max, t)) return false;
    blocker_note(&t->blockers, tree, k.tile);
    return true;
}

bool certain_any_on(const Surface *s, const TileTree *tree, uint32_t tile, const Ray *r, double t_max, Trace *t)
{
    Search k;
    begin(&k, s, tree, take_any);
    return set_ray(&k, r, t_max, t) && visit_tile(&k, tile, r, &t_max, t);
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

static int compare_hits(const void *a, const void *b)
{
    double x = ((const CertainHit *)a)->t, y = ((const CertainHit *)b)->t;
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

/* The number of hits, of n in order, that overlap with the first or with one that does. */
static size_t count_together(const CertainHit *hits, size_t n)
{
    double reach = hits->t + hits->depth_error;
    size_t i = 1;
    for (; i < n && hits[i].t - hits[i].depth_error <= reach; i++)
        reach = double_max(reach, hits[i].t + hits[i].depth_error);
    return i;
}

void certain_all(const Surface *s, const TileTree *tree, const Ray *r, double t_max, Trace *t, CertainList *out)
{
    *out = (CertainList){ ARENA_ARRAY(t->scratch, CertainHit, FIRST_ROOM), 0, FIRST_ROOM };
    Search k = { .s = s, .tree = tree, .take = take_all, .all = out };
    search_tiles(&k, r, t_max, t);
    if (k.overflow) out->hits = arena_copy(t->scratch, out->hits, out->n, sizeof *out->hits);
    arena_free(k.overflow);
    if (out->n > 1) qsort(out->hits, out->n, sizeof *out->hits, compare_hits);
    size_t n = 0;
    for (size_t i = 0, together; i < out->n; i += together) {
        together = count_together(out->hits + i, out->n - i);
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
