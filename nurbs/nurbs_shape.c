/* The adapter: a Surface as a Shape (render/shape.h), one ShapeType for each method. Its constructor is in nurbs.h. */
#include "nurbs/certain.h"
#include "nurbs/certain_bunch.h"
#include "nurbs/intersect.h"
#include "nurbs/prepare.h"
#include "nurbs/tessellate.h"
#include "render/hit_list.h"

typedef struct {
    Shape shape;
    TileTree tiles;              /* after preparation by `method certain`: beside the head, where rays look first */
    const Surface *surface;
    LeafTree leaves;             /* by `method paper` */
    NurbsOptions options;
    uint32_t n_together;         /* surfaces that are searched together with it, itself included */
    double prep_seconds;
} NurbsShape;

static Box nurbs_bounds(const Shape *s) { return ((const NurbsShape *)s)->surface->box; }

static void attributes_at(const NurbsShape *n, const Hit *h, Vec3 normal, Attributes *out)
{
    const Surface *s = n->surface;
    out->normal = out->shading_normal = normal;
    out->uv = vec2((h->u - s->u0) / (s->u1 - s->u0), (h->v - s->v0) / (s->v1 - s->v0));
}

static bool nurbs_tessellate(const Shape *s, double chord_error, MeshSink *out)
{
    tessellate_surface(((const NurbsShape *)s)->surface, chord_error, out);
    return true;
}

/* ---- method certain ---- */

static void certain_shape_prepare(Shape *s, Arena *own, Trace *t)
{
    NurbsShape *n = (NurbsShape *)s;
    double begin = stats_now();
    (void)t;
    double asked = n->options.leaf_variation;
    tile_tree_make(own, n->surface, asked > 0 ? asked : tile_tree_variation(n->surface, n->n_together), &n->tiles);
    n->prep_seconds = stats_now() - begin;
}

static void certain_shape_be_among(Shape *s, uint32_t n_primitives)
{
    NurbsShape *n = (NurbsShape *)s;
    if (n_primitives > n->n_together) n->n_together = n_primitives;
}

static bool certain_shape_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    CertainHit hit;
    if (!certain_nearest(&n->tiles, r, best->t, t, &hit)) return false;
    hit_set(best, hit.t, hit.t_error, hit.u, hit.v, s, hit.tile);
    return true;
}

static bool certain_shape_blocks(const Shape *s, const Ray *r, double t_max, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    return certain_any(&n->tiles, r, t_max, t);
}

/* Boxes about a base of their own belong into no other tree. */
static const Bvh *certain_shape_lend(Shape *s, Arena *own, Trace *t, const ShapeType **lender)
{
    const NurbsShape *n = (const NurbsShape *)s;
    *lender = s->type;
    shape_prepare_in(s, own, t);
    return vec_max_abs(n->tiles.bvh_base) == 0 ? n->tiles.bvh : NULL;
}

static const Shape *shape_of_tile(const Tile *tile)
{
    return (const Shape *)((const char *)tile_tree_of(tile) - offsetof(NurbsShape, tiles));
}

static bool certain_shape_hit_item(const void *at, uint32_t item, const Ray *r, Hit *best, Trace *t)
{
    CertainHit hit;
    if (!certain_nearest_on(at, item, r, best->t, t, &hit)) return false;
    hit_set(best, hit.t, hit.t_error, hit.u, hit.v, shape_of_tile(at), hit.tile);
    return true;
}

static bool certain_shape_item_blocks(const void *at, uint32_t item, const Ray *r, double t_max, Trace *t)
{
    return certain_any_on(at, item, r, t_max, t);
}

/* ---- the same for bunches ---- */

_Static_assert(sizeof(Hit) % sizeof(double) == 0, "hits lie a whole number of their t apart");

static BunchLimits limits_of(Hit best[]) { return (BunchLimits){ &best->t, sizeof *best / sizeof(double) }; }

static void set_hits(const CertainHits *hits, Lanes hit, const Shape *s, Hit best[])
{
    while (hit) {
        int i = lanes_next(&hit);
        hit_set(&best[i], hits->t[i], hits->t_error[i], hits->u[i], hits->v[i], s, hits->tile[i]);
    }
}

static Lanes certain_shape_hit_bunch(const Shape *s, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    CertainHits hits;
    double t_max[BUNCH_WIDTH] = { 0 };
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        t_max[i] = best[i].t;
    }
    Lanes hit = certain_nearest_bunch(&((const NurbsShape *)s)->tiles, b, lanes, t_max, t, &hits);
    set_hits(&hits, hit, s, best);
    return hit;
}

static Lanes certain_shape_blocks_bunch(const Shape *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    return certain_any_bunch(&((const NurbsShape *)s)->tiles, b, lanes, t_max, t);
}

static Lanes certain_shape_hit_items_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    CertainHits hits;
    Lanes hit = certain_nearest_on_bunch(items, b, lanes, limits_of(best), t, &hits);
    if (hit && items->is_one) set_hits(&hits, hit, shape_of_tile(items->at[0]), best);
    for (Lanes left = items->is_one ? 0 : hit; left; ) {
        int i = lanes_next(&left);
        set_hits(&hits, 1u << i, shape_of_tile(items->at[i]), best);
    }
    return hit;
}

static Lanes certain_shape_items_block_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, const double t_max[],
                                             Trace *t)
{
    return certain_any_on_bunch(items, b, lanes, t_max, t);
}

static void certain_shape_all_hits(const Shape *s, const Ray *r, HitList *out, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    CertainList list;
    certain_all(&n->tiles, r, out->t_max, t, &list);
    for (size_t i = 0; i < list.n; i++) {
        const CertainHit *h = &list.hits[i];
        hit_set(hit_list_add(out), h->t, h->t_error, h->u, h->v, s, h->tile);
    }
}

static void certain_shape_attributes(const Shape *s, const Ray *r, const Hit *h, Attributes *out)
{
    const NurbsShape *n = (const NurbsShape *)s;
    attributes_at(n, h, certain_normal(&n->tiles, h->leaf, h->u, h->v, r), out);
}

static const ShapeType certain_type = {
    .name = "trimmed_nurbs", .bounds = nurbs_bounds, .prepare = certain_shape_prepare, .hit = certain_shape_hit,
    .blocks = certain_shape_blocks, .lend = certain_shape_lend, .be_among = certain_shape_be_among,
    .hit_item = certain_shape_hit_item, .item_blocks = certain_shape_item_blocks, .hit_bunch = certain_shape_hit_bunch,
    .blocks_bunch = certain_shape_blocks_bunch, .hit_items_bunch = certain_shape_hit_items_bunch,
    .items_block_bunch = certain_shape_items_block_bunch, .all_hits = certain_shape_all_hits,
    .attributes = certain_shape_attributes, .tessellate = nurbs_tessellate,
};

/* ---- method paper ---- */

static void paper_prepare(Shape *s, Arena *own, Trace *t)
{
    NurbsShape *n = (NurbsShape *)s;
    double begin = stats_now();
    prepare_leaves(own, t->scratch, n->surface, &n->options, &n->leaves);
    n->prep_seconds = stats_now() - begin;
}

static bool paper_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    SurfaceHit hit;
    if (!intersect_nearest(n->surface, &n->leaves, n->options.max_iterations, r, best->t, t, &hit)) return false;
    hit_set(best, hit.root.t, hit.root.t_error, hit.root.u, hit.root.v, s, hit.leaf);
    return true;
}

static bool paper_blocks(const Shape *s, const Ray *r, double t_max, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    return intersect_any(n->surface, &n->leaves, n->options.max_iterations, r, t_max, t);
}

static void paper_attributes(const Shape *s, const Ray *r, const Hit *h, Attributes *out)
{
    const NurbsShape *n = (const NurbsShape *)s;
    attributes_at(n, h, intersect_normal(n->surface, &n->leaves.leaves[h->leaf], h->u, h->v, r), out);
}

static const ShapeType paper_type = {
    .name = "trimmed_nurbs", .bounds = nurbs_bounds, .prepare = paper_prepare, .hit = paper_hit, .blocks = paper_blocks,
    .attributes = paper_attributes, .tessellate = nurbs_tessellate,
};

static bool is_nurbs(const Shape *s) { return s->type == &certain_type || s->type == &paper_type; }

Shape *nurbs_shape_new(Arena *a, const SurfaceDesc *desc, const NurbsOptions *options, NurbsError *error,
                       NurbsWarning *warnings, int max_warnings, int *n_warnings)
{
    const Surface *s = surface_new(a, desc, error, warnings, max_warnings, n_warnings);
    if (!s) return NULL;
    NurbsShape *n = ARENA_NEW(a, NurbsShape);
    shape_init(&n->shape, options->method == NURBS_METHOD_PAPER ? &paper_type : &certain_type);
    n->surface = s;
    n->options = *options;
    n->n_together = 1;
    return &n->shape;
}

const Surface *surface_of_shape(const Shape *s) { return is_nurbs(s) ? ((const NurbsShape *)s)->surface : NULL; }

bool nurbs_shape_info(const Shape *shape, NurbsInfo *out)
{
    if (!is_nurbs(shape)) return false;
    const NurbsShape *n = (const NurbsShape *)shape;
    const Surface *s = n->surface;
    *out = (NurbsInfo){ .is_polynomial = s->is_polynomial, .has_trims = s->trims != NULL };
    if (s->trims) out->n_trims = trim_loop_count(s->trims), out->n_trim_pieces = trim_piece_count(s->trims);
    out->was_prepared = shape_was_prepared(shape);
    if (!out->was_prepared) return true;
    bool is_paper = shape->type == &paper_type;
    out->n_leaves = (int)(is_paper ? n->leaves.n_leaves : n->tiles.n_tiles);
    out->n_leaves_trimmed_away = (int)(is_paper ? n->leaves.n_cut : n->tiles.n_cut);
    out->n_leaves_untested = (int)(is_paper ? n->leaves.n_untested : n->tiles.n_untested);
    out->prep_seconds = n->prep_seconds;
    out->bytes = shape->own ? arena_bytes(shape->own) : n->tiles.bytes;
    return true;
}

bool nurbs_shape_point(const Shape *shape, double u, double v, Vec3 *point, Vec3 *s_u, Vec3 *s_v)
{
    if (!is_nurbs(shape)) return false;
    surface_point(((const NurbsShape *)shape)->surface, u, v, point, s_u, s_v);
    return true;
}
