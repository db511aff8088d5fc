/* Objects: the nodes that carry placement and appearance. A ray is taken into the space of the child by the inverse of the
 * placement, its direction not normalized, so that t means the same on both sides; on the way out of a hit each object adds
 * itself to the hit's chain. */
#include "render/object.h"

#include "render/bunch.h"
#include "render/hit_list.h"
#include "render/shapes.h"

#include <assert.h>

/* ---- the object as a shape ---- */

static Box object_bounds(const Shape *shape)
{
    const Object *o = (const Object *)shape;
    Box b = shape_bounds(o->child);
    return o->is_placed ? xform_box(&o->placement, b) : b;
}

/* At most by how much a map stretches a vector: the square root of the largest row sum times the largest column sum
 * bounds the Euclidean norm; it is exact for a scaling along the axes, and within sqrt(3) for a rotation. */
static double stretch(const Affine *a)
{
    double row = 0, column = 0;
    for (int i = 0; i < 3; i++) {
        row = fmax(row, fabs(a->m[i][0]) + fabs(a->m[i][1]) + fabs(a->m[i][2]));
        column = fmax(column, fabs(a->m[0][i]) + fabs(a->m[1][i]) + fabs(a->m[2][i]));
    }
    return sqrt(row * column);
}

/* The distance from the surface as it is outside: that of the child's hit, and what rounding the ray on its way in may
 * have moved it (four terms a coordinate: 4u of their magnitudes, a matrix that is itself rounded included: 8u), both
 * stretched. */
static double error_outside(const Object *o, const Ray *r, const Ray *within, const Hit *h)
{
    static const double ROUNDING = 8 * 0x1p-53;
    double length = vec_length(r->dir);
    double moved = ROUNDING * (o->stretch_in * (vec_length(r->origin) + h->t * length) + o->shift_in);
    return o->stretch_out * (h->t_error * vec_length(within->dir) + moved) / length;
}

static void measure_placement(Object *o)
{
    const Affine *in = &o->placement.backward;
    o->stretch_in = stretch(in);
    o->stretch_out = stretch(&o->placement.forward);
    o->shift_in = vec_length(vec(in->m[3][0], in->m[3][1], in->m[3][2]));
}

static void pass(const Object *o, const Ray *r, const Ray *within, Hit *h)
{
    if (o->is_placed) h->t_error = error_outside(o, r, within, h);
    assert(h->n_objects < HIT_MAX_OBJECTS);
    h->objects[h->n_objects++] = o;
}

static bool object_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Object *o = (const Object *)shape;
    Ray room;
    const Ray *within = ray_within(o, r, &room);
    bool is_hit = shape_hit(o->child, within, best, t);
    if (is_hit) pass(o, r, within, best);
    return is_hit;
}

static void object_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    const Object *o = (const Object *)shape;
    Ray room;
    const Ray *within = ray_within(o, r, &room);
    size_t first = out->n;
    shape_all_hits(o->child, within, out, t);
    for (size_t i = first; i < out->n; i++) pass(o, r, within, &out->hits[i]);
}

static bool object_blocks(const Shape *shape, const Ray *r, double t_max, Trace *t)
{
    const Object *o = (const Object *)shape;
    Ray room;
    return shape_blocks(o->child, ray_within(o, r, &room), t_max, t);
}

/* ---- bunches ---- */

/* As affine_vector, to the last bit. */
ALWAYS_INLINE void vectors_within(const Affine *a, const Vec3x8 *v, Vec3x8 *out)
{
    out->x = v->x * a->m[0][0] + v->y * a->m[1][0] + v->z * a->m[2][0];
    out->y = v->x * a->m[0][1] + v->y * a->m[1][1] + v->z * a->m[2][1];
    out->z = v->x * a->m[0][2] + v->y * a->m[1][2] + v->z * a->m[2][2];
}

EVERY_X86
static void rays_within(const Affine *a, const RayBunch *b, RayBunch *out)
{
    out->n = b->n, out->lane = b->lane, out->t_min = b->t_min;
    vectors_within(a, &b->origin, &out->origin);
    out->origin.x += a->m[3][0], out->origin.y += a->m[3][1], out->origin.z += a->m[3][2];
    vectors_within(a, &b->dir, &out->dir);
    bunch_set_rays(out);
}

/* b itself, or what it is within o, in `room`. */
static RayBunch *bunch_within(const Object *o, RayBunch *b, RayBunch *room)
{
    if (!o->is_placed) return b;
    rays_within(&o->placement.backward, b, room);
    return room;
}

static Lanes object_hit_bunch(const Shape *shape, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    const Object *o = (const Object *)shape;
    RayBunch room, *within = bunch_within(o, b, &room);
    Lanes hit = shape_hit_bunch(o->child, within, lanes, best, t);
    for (Lanes left = hit; left; ) {
        int i = lanes_next(&left);
        pass(o, &b->ray[i], &within->ray[i], &best[i]);
    }
    return hit;
}

static Lanes object_blocks_bunch(const Shape *shape, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    const Object *o = (const Object *)shape;
    RayBunch room;
    return shape_blocks_bunch(o->child, bunch_within(o, b, &room), lanes, t_max, t);
}

static const Shape *object_bare(const Shape *shape)
{
    const Object *o = (const Object *)shape;
    return o->is_placed ? shape : shape_bare(o->child);
}

/* ---- the tree of what is within an object that does not move it ---- */

static const Bvh *object_lend(Shape *shape, Arena *own, Trace *t, const ShapeType **lender)
{
    const Object *o = (const Object *)shape;
    return o->is_placed || !o->child->type->lend ? NULL : o->child->type->lend(o->child, own, t, lender);
}

static void object_be_among(Shape *shape, uint32_t n)
{
    const Object *o = (const Object *)shape;
    if (!o->is_placed && o->child->type->be_among) o->child->type->be_among(o->child, n);
}

static void object_took(const Shape *shape, const Ray *r, Hit *best)
{
    const Object *o = (const Object *)shape;
    if (o->child->type->took) o->child->type->took(o->child, r, best);
    pass(o, r, r, best);
}

static bool object_inside(const Shape *shape, Vec3 p)
{
    const Object *o = (const Object *)shape;
    if (!o->child->type->inside) return false;
    return o->child->type->inside(o->child, o->is_placed ? xform_unpoint(&o->placement, p) : p) != o->is_inverse;
}

static Box object_inside_bounds(const Shape *shape)
{
    const Object *o = (const Object *)shape;
    if (o->is_inverse) return box_infinite();
    Box b = shape_inside_bounds(o->child);
    return o->is_placed ? xform_box(&o->placement, b) : b;
}

static uint32_t object_parts(const Shape *shape, Shape *const **list)
{
    *list = &((const Object *)shape)->child;
    return 1;
}

static const ShapeType object_type = {
    .name = "object", .bounds = object_bounds, .hit = object_hit, .blocks = object_blocks,
    .hit_bunch = object_hit_bunch, .blocks_bunch = object_blocks_bunch, .lend = object_lend,
    .be_among = object_be_among, .took = object_took, .bare = object_bare, .all_hits = object_all_hits,
    .inside = object_inside, .inside_bounds = object_inside_bounds, .parts = object_parts,
};

bool shape_is_object(const Shape *s) { return s->type == &object_type; }

/* ---- building ---- */

static Object *wrap(Arena *a, Shape *child)
{
    Object *o = ARENA_NEW(a, Object);
    shape_init(&o->shape, &object_type);
    o->shape.n_primitives = child->n_primitives;
    o->shape.depth = child->depth + 1;
    o->child = child;
    o->placement = o->texture_space = xform_identity();
    return o;
}

static Object *copy(Arena *a, const Object *o)
{
    Object *c = wrap(a, o->child);
    c->placement = o->placement;
    c->is_placed = o->is_placed;
    c->stretch_in = o->stretch_in, c->stretch_out = o->stretch_out, c->shift_in = o->shift_in;
    c->texture = o->texture;
    c->texture_space = o->texture_space;
    c->interior_texture = o->interior_texture;
    c->interior = o->interior;
    c->has_uv_mapping = o->has_uv_mapping;
    c->no_shadow = o->no_shadow, c->no_image = o->no_image, c->no_reflection = o->no_reflection;
    c->is_inverse = o->is_inverse, c->is_hollow = o->is_hollow, c->double_illuminate = o->double_illuminate;
    return c;
}

void object_transform(Object *o, const Xform *x)
{
    o->placement = xform_then(o->placement, *x);
    o->texture_space = xform_then(o->texture_space, *x);
    o->is_placed = !xform_is_identity(&o->placement);
    measure_placement(o);
}

/* One object in place of two, `inner` within `outer`: it looks as a hit through both would look. */
static Object *merge(Arena *a, const Object *outer, const Object *inner)
{
    Object *o = copy(a, inner);
    object_transform(o, &outer->placement);
    if (!inner->texture) {
        o->texture = outer->texture;
        o->texture_space = outer->texture_space;
        o->interior_texture = outer->interior_texture;
        o->has_uv_mapping = outer->has_uv_mapping;
    }
    if (!inner->interior) o->interior = outer->interior;
    o->no_shadow |= outer->no_shadow, o->no_image |= outer->no_image, o->no_reflection |= outer->no_reflection;
    o->is_inverse ^= outer->is_inverse, o->is_hollow |= outer->is_hollow, o->double_illuminate |= outer->double_illuminate;
    return o;
}

/* s as it is within o, without o: its properties go down through compounds and are merged into the objects there. */
static Shape *distribute(Arena *a, const Object *o, Shape *s)
{
    if (shape_is_object(s)) return &merge(a, o, (const Object *)s)->shape;
    if (!s->type->parts) return &merge(a, o, wrap(a, s))->shape;
    Shape *const *parts;
    uint32_t n = s->type->parts(s, &parts);
    Shape **merged = ARENA_ARRAY(a, Shape *, n);
    for (uint32_t i = 0; i < n; i++) merged[i] = distribute(a, o, parts[i]);
    return s->type->with_parts(s, a, merged, false, &o->placement);
}

/* An equal of s with one level less; s has at least two. */
static Shape *shallower(Arena *a, Shape *s)
{
    if (shape_is_object(s)) return distribute(a, (const Object *)s, ((const Object *)s)->child);
    Shape *const *parts;
    uint32_t n = s->type->parts(s, &parts);
    Shape **changed = ARENA_ARRAY(a, Shape *, n);
    for (uint32_t i = 0; i < n; i++) changed[i] = parts[i]->depth == s->depth ? shallower(a, parts[i]) : parts[i];
    return s->type->with_parts(s, a, changed, false, NULL);
}

Object *object_new(Arena *a, Shape *child)
{
    return wrap(a, child->depth >= HIT_MAX_OBJECTS ? shallower(a, child) : child);
}

Object *object_copy(Arena *a, const Object *o) { return copy(a, o); }

/* ---- inside out ---- */

/* The flag is set on primitives alone, so that each compound above follows POV-Ray's rule for its inverse. */
void object_invert(Arena *a, Object *o)
{
    if (!o->child->type->parts) {
        o->is_inverse = !o->is_inverse;
        return;
    }
    o->child = shape_inverse(a, o->child);
    if (o->child->depth >= HIT_MAX_OBJECTS) o->child = shallower(a, o->child);
    o->shape.depth = o->child->depth + 1;
}

Shape *shape_inverse(Arena *a, Shape *s)
{
    Shape *const *parts;
    if (!s->type->with_parts) {
        Object *o = shape_is_object(s) ? copy(a, (const Object *)s) : wrap(a, s);
        object_invert(a, o);
        return &o->shape;
    }
    uint32_t n = s->type->parts(s, &parts);
    Shape **inverted = ARENA_ARRAY(a, Shape *, n);
    for (uint32_t i = 0; i < n; i++) inverted[i] = shape_inverse(a, parts[i]);
    return s->type->with_parts(s, a, inverted, true, NULL);
}

/* The clips in the space of the child, and an inversion so far below the clipping: an inverse is clipped, never its clips
 * inverted. */
void object_clip(Arena *a, Object *o, Shape *const clips[], uint32_t n)
{
    Shape **within = ARENA_ARRAY(a, Shape *, n);
    Xform back = xform_inverse(o->placement);
    for (uint32_t i = 0; i < n; i++) {
        Object *clip = object_new(a, clips[i]);
        object_transform(clip, &back);
        within[i] = &clip->shape;
    }
    Shape *child = o->is_inverse ? shape_inverse(a, o->child) : o->child;
    o->is_inverse = false;
    o->child = clipped_new(a, child, within, n);
    o->shape.depth = child->depth + 1;
}

/* ---- what there is below ---- */

static unsigned texture_looks(const Texture *t)
{
    return (texture_is_opaque(t) ? 0u : LOOKS_CLEAR) | (texture_reflects(t) ? LOOKS_REFLECTING : 0u);
}

static unsigned shape_looks(Shape *s)
{
    if (shape_is_object(s)) return object_looks((Object *)s);
    if (!s->type->parts) return s->type->looks ? s->type->looks(s) : LOOKS_UNTEXTURED;
    Shape *const *parts;
    uint32_t n = s->type->parts(s, &parts);
    unsigned looks = 0;
    for (uint32_t i = 0; i < n; i++) looks |= shape_looks(parts[i]);
    return looks;
}

unsigned object_looks(Object *o)
{
    if (o->looks & LOOKS_KNOWN) return o->looks;
    unsigned looks = shape_looks(o->child);
    if (o->texture && (looks & LOOKS_UNTEXTURED)) looks = (looks & ~(unsigned)LOOKS_UNTEXTURED) | texture_looks(o->texture);
    if (o->interior_texture) looks |= texture_looks(o->interior_texture);
    if (o->no_shadow) looks |= LOOKS_NO_SHADOW;
    o->is_even = o->texture && texture_is_even(o->texture) && (!o->interior_texture || texture_is_even(o->interior_texture));
    return o->looks = looks | LOOKS_KNOWN;
}
