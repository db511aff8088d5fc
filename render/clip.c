/* clipped_by: the surface of one shape inside others, left open where it is cut. What is inside the shape is so only inside
 * the clips, too. */
#include "render/hit_list.h"
#include "render/object.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct {
    Shape shape;
    Shape *child;              /* a compound's one part; the clips are never seen */
    Shape *const *clips;
    uint32_t n;
    Box bounds, inside_bounds;
} Clipped;

static Box clipped_bounds(const Shape *shape) { return ((const Clipped *)shape)->bounds; }
static Box clipped_inside_bounds(const Shape *shape) { return ((const Clipped *)shape)->inside_bounds; }

static bool is_kept(const Clipped *c, Vec3 p)
{
    for (uint32_t i = 0; i < c->n; i++)
        if (!shape_inside(c->clips[i], p)) return false;
    return true;
}

/* The nearest, and the nearest beyond it, until one is kept. */
static bool clipped_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Clipped *c = (const Clipped *)shape;
    Ray rest = *r;
    for (Hit h = { .t = best->t }; shape_hit(c->child, &rest, &h, t); h.t = best->t) {
        if (is_kept(c, ray_at(r, h.t))) return *best = h, true;
        rest.t_min = h.t + 2 * h.t_error;
    }
    return false;
}

static void clipped_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    const Clipped *c = (const Clipped *)shape;
    size_t first = out->n, n = first;
    shape_all_hits(c->child, r, out, t);
    for (size_t i = first; i < out->n; i++)
        if (is_kept(c, ray_at(r, out->hits[i].t))) out->hits[n++] = out->hits[i];
    out->n = n;
}

static bool clipped_inside(const Shape *shape, Vec3 p)
{
    const Clipped *c = (const Clipped *)shape;
    return shape_inside(c->child, p) && is_kept(c, p);
}

static uint32_t clipped_parts(const Shape *shape, Shape *const **list)
{
    *list = &((const Clipped *)shape)->child;
    return 1;
}

/* The inverse of a clipped object is clipped as it was: so POV-Ray has it. */
static Shape *clipped_with_parts(const Shape *shape, Arena *a, Shape *const parts[], bool is_inverse, const Xform *moved)
{
    const Clipped *c = (const Clipped *)shape;
    Shape **clips = ARENA_ARRAY(a, Shape *, c->n);
    (void)is_inverse;
    for (uint32_t i = 0; i < c->n; i++) {
        Object *o = object_new(a, c->clips[i]);
        if (moved) object_transform(o, moved);
        clips[i] = &o->shape;
    }
    return clipped_new(a, parts[0], clips, c->n);
}

static void clipped_write(const Shape *shape, Sdl *out)
{
    const Clipped *c = (const Clipped *)shape;
    sdl_text(out, "object { ");
    out->shape(out, c->child);
    sdl_text(out, " clipped_by {");
    for (uint32_t i = 0; i < c->n; i++) sdl_text(out, " "), out->shape(out, c->clips[i]);
    sdl_text(out, " }");
}

static void release_below(Shape *s)
{
    Shape *const *parts;
    uint32_t n = s->type->parts ? s->type->parts(s, &parts) : 0;
    for (uint32_t i = 0; i < n; i++) release_below(parts[i]);
    shape_release(s);
}

/* The clips are no parts: nobody else gives back what asking them for their inside has made them prepare. */
static void clipped_release(Shape *shape)
{
    const Clipped *c = (const Clipped *)shape;
    for (uint32_t i = 0; i < c->n; i++) release_below(c->clips[i]);
}

static const ShapeType clipped_type = {
    .name = "clipped_by", .bounds = clipped_bounds, .hit = clipped_hit, .all_hits = clipped_all_hits,
    .inside = clipped_inside, .inside_bounds = clipped_inside_bounds, .parts = clipped_parts,
    .with_parts = clipped_with_parts, .write = clipped_write, .release = clipped_release,
};

Shape *clipped_new(Arena *a, Shape *s, Shape *const clips[], uint32_t n)
{
    Clipped *c = ARENA_NEW(a, Clipped);
    shape_init(&c->shape, &clipped_type);
    c->shape.n_primitives = s->n_primitives;
    c->shape.depth = s->depth;
    c->child = s;
    c->clips = arena_copy(a, clips, n, sizeof *clips);
    c->n = n;
    c->bounds = shape_bounds(s);
    c->inside_bounds = shape_inside_bounds(s);
    for (uint32_t i = 0; i < n; i++) {
        Box clip = shape_inside_bounds(clips[i]);
        c->bounds = box_intersection(c->bounds, clip);
        c->inside_bounds = box_intersection(c->inside_bounds, clip);
    }
    return &c->shape;
}
