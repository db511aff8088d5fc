/* union: all surfaces of its parts. Its tree is built when the first ray comes near; the box is known from the start, so
 * that asking for bounds never walks a deep scene again. */
#include "render/shape_tree.h"
#include "render/shapes.h"

typedef struct {
    Shape shape;
    Shape *const *parts;
    uint32_t n;
    Box bounds;
    ShapeTree *tree;           /* made by prepare */
} Union;

static Box union_bounds(const Shape *shape) { return ((const Union *)shape)->bounds; }

static void union_prepare(Shape *shape, Arena *own, Trace *t)
{
    Union *u = (Union *)shape;
    u->tree = shape_tree_build(own, u->parts, NULL, u->n, false);
    shape_tree_join(u->tree, shape, own, t);
}

static bool union_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    return shape_tree_hit(((const Union *)shape)->tree, r, 0, best, t);
}

static void union_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    shape_tree_all_hits(((const Union *)shape)->tree, r, out, t);
}

static bool union_blocks(const Shape *shape, const Ray *r, double t_max, Trace *t)
{
    return shape_tree_blocks(((const Union *)shape)->tree, r, 0, t_max, t);
}

static Lanes union_hit_bunch(const Shape *shape, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    return shape_tree_hit_bunch(((const Union *)shape)->tree, b, lanes, 0, best, t);
}

static Lanes union_blocks_bunch(const Shape *shape, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    return shape_tree_blocks_bunch(((const Union *)shape)->tree, b, lanes, 0, t_max, t);
}

static bool union_inside(const Shape *shape, Vec3 p)
{
    const Union *u = (const Union *)shape;
    for (uint32_t i = 0; i < u->n; i++)
        if (shape_inside(u->parts[i], p)) return true;
    return false;
}

static Box union_inside_bounds(const Shape *shape)
{
    const Union *u = (const Union *)shape;
    Box b = box_empty();
    for (uint32_t i = 0; i < u->n; i++) b = box_union(b, shape_inside_bounds(u->parts[i]));
    return b;
}

static uint32_t union_parts(const Shape *shape, Shape *const **list)
{
    *list = ((const Union *)shape)->parts;
    return ((const Union *)shape)->n;
}

static Shape *union_with_parts(const Shape *shape, Arena *a, Shape *const parts[], bool is_inverse, const Xform *moved)
{
    uint32_t n = ((const Union *)shape)->n;
    (void)moved;
    return is_inverse ? intersection_new(a, parts, n) : union_new(a, parts, n);
}

static void union_release(Shape *shape) { ((Union *)shape)->tree = NULL; }

static const ShapeType union_type = {
    .name = "union", .bounds = union_bounds, .prepare = union_prepare, .hit = union_hit, .blocks = union_blocks,
    .hit_bunch = union_hit_bunch, .blocks_bunch = union_blocks_bunch, .all_hits = union_all_hits, .inside = union_inside,
    .inside_bounds = union_inside_bounds, .parts = union_parts, .with_parts = union_with_parts, .release = union_release,
};

Shape *union_new(Arena *a, Shape *const parts[], uint32_t n)
{
    Union *u = ARENA_NEW(a, Union);
    shape_init(&u->shape, &union_type);
    u->parts = arena_copy(a, parts, n, sizeof *parts);
    u->n = n;
    u->bounds = box_empty();
    u->shape.n_primitives = 0;
    for (uint32_t i = 0; i < n; i++) {
        u->bounds = box_union(u->bounds, shape_bounds(parts[i]));
        u->shape.n_primitives += parts[i]->n_primitives;
        if (parts[i]->depth > u->shape.depth) u->shape.depth = parts[i]->depth;
    }
    for (uint32_t i = 0; i < n; i++)
        if (parts[i]->type->be_among) parts[i]->type->be_among(parts[i], u->shape.n_primitives);
    return &u->shape;
}
