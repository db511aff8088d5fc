/* Cutting a surface into tiles, and their tree. See tile_tree.h. */
#include "nurbs/tile_tree.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "nurbs/pole_cone.h"

#include <float.h>

/* The tree of boxes is the tree of halvings itself, below a halving of the grid of spans: neighbours in the parameters are
 * neighbours in space, and nothing has to be sorted. */
typedef struct {
    const Surface *s;
    WideSurface wide;                /* its points about the tree's base */
    double error;                    /* of these, and of the patches' before they are rounded */
    Vec3 base, to_bvh;               /* the tree's, and the way from there to that of its boxes */
    double variation;                /* that patches may have */
    const PatchGroup *group;
    Arena *own, *lists;
    Tile *tiles;
    const TrimCell **cells;
    PoleCone *cones;
    BvhNode *nodes;
    size_t n_tiles, n_cells, n_cones, n_nodes, tiles_capacity, cells_capacity, cones_capacity, nodes_capacity;
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

/* A box round all that the tile may be: its net and its patch may be off, and the way to the net's corners is rounded. */
static Box box_of_tile(const Preparation *k, const Vec4 *net, const Patch *p)
{
    Vec3 to = vec_add(p->origin, k->to_bvh);
    Box hull = box_moved(bezier_hull(p->k_u * p->k_v, net), to);
    return box_expand(hull, p->rounding + tile_net_error(p) + DBL_EPSILON * (vec_max_abs(to) + p->radius));
}

/* More cones than an index has room for no ray would wait for; those beyond have none. */
#define MAX_CONES ((1u << 24) - 1)

static void add_cone(Preparation *k, const Vec4 *net, const Part *part, Tile *tile)
{
    PoleCone cone;
    if (!part->patch->collapsed || k->n_cones == MAX_CONES || !pole_cone_make(part->patch, part->place, net, &cone)) return;
    ARENA_PUSH(k->lists, k->cones, k->n_cones, k->cones_capacity) = cone;
    tile->cone = (uint32_t)k->n_cones;
}

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
    k->nodes[at] = (BvhNode){ box_of_tile(k, net, part->patch), (uint32_t)k->n_tiles, 1 };
    Tile *tile = &ARENA_PUSH(k->lists, k->tiles, k->n_tiles, k->tiles_capacity);
    tile_make(part->patch, net, part->place, tile);
    add_cone(k, net, part, tile);
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

static bool is_cut(Preparation *k, TrimRect rect)
{
    bool is = k->s->trims && trim_class(k->s->trims, rect) == TRIM_CUT;
    k->n_cut += is;
    return is;
}

static Part part_at(Part whole, TilePlace place)
{
    return (Part){ whole.patch, place, tile_rect(whole.patch, place) };
}

/* Cuts the net of a part until each piece is worth a frame, below node `at`; `net` is used up. Returns whether anything of
 * it is kept. */
static bool grow_tiles(Preparation *k, uint32_t at, Vec4 *net, Part part, Halvings left)
{
    const Surface *s = k->s;
    bool along_u;
    if (!choose_halving(k, tile_bend(s->k_u, s->k_v, net), left, &along_u)) return keep_tile(k, at, net, &part);
    Vec4 first[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    *(along_u ? &left.u : &left.v) -= 1;
    TilePlaces halves = tile_cut(part.patch, part.place, along_u, net, first);
    Part a = part_at(part, halves.first), b = part_at(part, halves.second);
    uint32_t pair = new_pair(k);
    bool has_a = !is_cut(k, a.rect) && grow_tiles(k, pair, first, a, left);
    bool has_b = !is_cut(k, b.rect) && grow_tiles(k, pair + 1, net, b, left);
    return join_pair(k, at, pair, has_a, has_b);
}

/* What the origin of a ray about the base is rounded by (certain.c), beyond u of its distance from the patch: as good as an
 * error of the patch. */
static double rounding_about_base(Vec3 origin) { return 0.5 * DBL_EPSILON * vec_length(origin); }

/* One span: its patch, unless the trims leave nothing of it. */
static bool grow_span(Preparation *k, uint32_t at, int mu_u, int mu_v)
{
    const Surface *s = k->s;
    TrimRect rect = { s->tau_u[mu_u], s->tau_u[mu_u + 1], s->tau_v[mu_v], s->tau_v[mu_v + 1] };
    if (is_cut(k, rect)) return false;
    Vec4 net[NURBS_MAX_ORDER * NURBS_MAX_ORDER], low[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    Patch *patch = ARENA_NEW(k->own, Patch);
    wide_surface_close(&k->wide, mu_u, mu_v, (WideNet){ net, low });
    patch_make(k->own, s->k_u, s->k_v, (WideNet){ net, low }, k->error, rect, patch);
    patch->rounding += rounding_about_base(patch->origin);
    patch->base = k->base, patch->group = k->group, patch->is_trimmed = s->trims != NULL;
    Halvings all = { TILE_FIRST_HALVINGS, TILE_FIRST_HALVINGS };
    return grow_tiles(k, at, net, (Part){ patch, { 0, 0, 1, 1 }, rect }, all);
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

/* As many points of a patch, beside it, as a bicubic one has come from memory together. */
static void set_items(Bvh *bvh, const Tile *tiles, const Preparation *k)
{
    int n_points = k->s->k_u * k->s->k_v;
    const void **patches = ARENA_ARRAY(k->lists, const void *, k->n_tiles);
    for (size_t i = 0; i < k->n_tiles; i++) patches[i] = tiles[i].patch;
    bvh_set_items(bvh, &(BvhItems){ tiles, sizeof *tiles, patches,
                                    sizeof(Patch) + (size_t)(n_points < 16 ? n_points : 16) * sizeof(Vec4) });
}

/* How far the surface may be from where exact arithmetic has it, in space, before the patches' points are rounded (patch.c).
 * Where weights differ they have been multiplied with coordinates (surface.c), which rounds each by u = 2^-53 of itself,
 * however far off it is; a point, by u of its distance from the origin, and no point of the surface by more than the
 * farthest control point. */
static double error_of_surface(const Surface *s)
{
    return WIDE_NET_ERROR * s->size + (s->is_polynomial ? 0 : 0.5 * DBL_EPSILON * s->farthest);
}

/* A patch of high order is dear to keep, k_u k_v points: up to order 4 nothing changes, beyond it patches may vary more, so
 * that their number falls about as fast as their points grow. */
static double coarseness(const Surface *s)
{
    double points = s->k_u * s->k_v;
    return points > 16 ? pow(points / 16, 0.25) : 1;
}

static int span_count(int k, int n, const double *tau)
{
    int n_spans = 0;
    for (int i = k - 1; i < n; i++) n_spans += knots_is_span(tau, i);
    return n_spans;
}

double tile_tree_variation(const Surface *s, uint32_t n_surfaces)
{
    double patches = (double)n_surfaces * span_count(s->k_u, s->n_u, s->tau_u) * span_count(s->k_v, s->n_v, s->tau_v);
    return TILE_VARIATION * double_min(double_max(cbrt(patches / CACHED_PATCHES), 1), 2);
}

/* Boxes are in single precision: those of a surface that lies farther from the origin than this, in its own diagonals, are
 * about its middle. All others share their space with the trees around them, whose work on a ray is then not done again;
 * they swell by 2^-21 of that distance at most (bvh_wide.c), 2^-11 diagonals, which is little beside a tile. */
#define FAR_OFF 1024

void tile_tree_make(Arena *a, const Surface *surface, double variation, TileTree *out)
{
    Preparation k = { .group = &out->group, .own = a, .lists = arena_new(), .error = error_of_surface(surface) };
    k.variation = variation * coarseness(surface);
    size_t used = arena_used(a);
    Vec3 base = box_centre(surface->box), nowhere = { 0, 0, 0 };
    bool is_far = vec_max_abs(base) > FAR_OFF * box_diagonal(surface->box);
    k.base = base, k.to_bvh = is_far ? nowhere : base;
    const Surface *s = k.s = surface;
    k.wide = wide_surface_make(k.lists, s, base);
    SpanRange all = { 0 };
    k.spans_u = list_spans(k.lists, s->k_u, s->n_u, s->tau_u, &all.u1);
    k.spans_v = list_spans(k.lists, s->k_v, s->n_v, s->tau_v, &all.v1);
    uint32_t root = new_pair(&k);
    bool has_any = grow_spans(&k, root, all);
    const Tile *tiles = arena_copy(a, k.tiles, k.n_tiles, sizeof *k.tiles);
    Bvh *bvh = bvh_from_tree(a, k.nodes, has_any ? (uint32_t)k.n_nodes : 0);
    set_items(bvh, tiles, &k);
    const PoleCone *cones = arena_copy(a, k.cones, k.n_cones, sizeof *k.cones);
    *out = (TileTree){ .group = { a, cones }, .base = base, .bvh_base = is_far ? base : nowhere, .tiles = tiles, .bvh = bvh,
                        .cells = s->trims ? arena_copy(a, k.cells, k.n_cells, sizeof *k.cells) : NULL, .trims = s->trims,
                        .n_tiles = (uint32_t)k.n_tiles, .n_cut = k.n_cut, .n_untested = k.n_untested };
    out->bytes = arena_used(a) - used;
    arena_free(k.lists);
}
