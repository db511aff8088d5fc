/* The scene: lists that the parser fills, and on them the searches of camera, secondary and shadow rays. */
#include "render/scene.h"

#include "render/bunch.h"
#include "render/hit.h"
#include "render/hit_list.h"
#include "render/shape_tree.h"

/* What hides an object of the scene from a kind of ray. */
enum {
    NO_IMAGE = 1,
    NO_REFLECTION = 2,
    NOT_SURELY_OPAQUE = 4,     /* not for the any-hit search of shadow rays */
    MAY_FILTER = 8             /* among their transparent blockers: neither opaque nor without shadow */
};

struct SceneTree {
    ShapeTree *shapes;
    ShapeTree *filters;        /* of the objects that may filter light alone; NULL: there are none */
};

static const Texture *black_texture(Arena *a)
{
    Pigment *pigment = ARENA_NEW(a, Pigment);
    Layer *layer = ARENA_NEW(a, Layer);
    Texture *texture = ARENA_NEW(a, Texture);
    *pigment = pigment_solid((Color){ 0, 0, 0, 0, 0 });
    *layer = (Layer){ .pigment = pigment, .finish = finish_default() };
    *texture = (Texture){ .layers = layer, .n_layers = 1 };
    return texture;
}

Scene *scene_new(Arena *a)
{
    Scene *s = ARENA_NEW(a, Scene);
    CameraDesc camera = camera_desc_default();
    s->arena = a;
    camera_make(&camera, &s->camera);
    s->background = (Color){ .transmit = 1 };
    s->ambient_light = rgb(1, 1, 1);
    s->max_trace_level = 5;
    s->adc_bailout = 1. / 255;
    s->gamma = GAMMA_POWER;
    s->gamma_power = 1;
    s->version = 3.7;
    s->default_texture = black_texture(a);
    return s;
}

void scene_add_light(Scene *s, const Light *l) { ARENA_PUSH(s->arena, s->lights, s->n_lights, s->lights_capacity) = *l; }

/* The lights among the parts of a shape. Objects without any are entered once, however often they are shared. */
static void add_lights(Scene *s, Shape *shape, const Xform *outer)
{
    const Light *light = shape_light(shape);
    Object *o = shape_is_object(shape) ? (Object *)shape : NULL;
    Shape *const *parts;
    size_t n_before = s->n_lights;
    if (light) {
        Light moved = *light;
        light_transform(&moved, outer);
        scene_add_light(s, &moved);
    }
    if (!shape->type->parts || (o && o->has_no_lights)) return;
    Xform x = o ? xform_then(o->placement, *outer) : *outer;
    uint32_t n = shape->type->parts(shape, &parts);
    for (uint32_t i = 0; i < n; i++) add_lights(s, parts[i], &x);
    if (o) o->has_no_lights = s->n_lights == n_before;
}

void scene_add_object(Scene *s, Object *o)
{
    Xform here = xform_identity();
    ARENA_PUSH(s->arena, s->objects, s->n_objects, s->objects_capacity) = o;
    add_lights(s, &o->shape, &here);
}

static unsigned looks_in_scene(const Scene *s, Object *o)
{
    unsigned looks = object_looks(o);
    if (!(looks & LOOKS_UNTEXTURED)) return looks;
    if (!texture_is_opaque(s->default_texture)) looks |= LOOKS_CLEAR;
    if (texture_reflects(s->default_texture)) looks |= LOOKS_REFLECTING;
    return looks;
}

static unsigned char flags_of(const Object *o, unsigned looks)
{
    unsigned flags = (o->no_image ? NO_IMAGE : 0u) | (o->no_reflection ? NO_REFLECTION : 0u);
    bool is_mixed = !o->no_shadow && (looks & (LOOKS_CLEAR | LOOKS_NO_SHADOW));
    if (is_mixed || o->no_shadow) flags |= NOT_SURELY_OPAQUE;
    if (is_mixed) flags |= MAY_FILTER;
    return (unsigned char)flags;
}

static bool lights_cast_shadows(const Scene *s)
{
    for (size_t i = 0; i < s->n_lights; i++)
        if (!s->lights[i].is_shadowless) return true;
    return false;
}

/* POV-Ray tests unbounded objects first once it sorts the others into a tree: from three objects on, lights included. The
 * order shows where surfaces coincide. */
static const size_t SORTED_FROM = 3;

static ShapeTree *tree_of_filters(Arena *a, Shape *const shapes[], const unsigned char *flags, uint32_t n,
                                  bool unbounded_first)
{
    Shape **filters = ARENA_ARRAY(a, Shape *, n);
    uint32_t n_filters = 0;
    for (uint32_t i = 0; i < n; i++)
        if (flags[i] & MAY_FILTER) filters[n_filters++] = shapes[i];
    return n_filters > 0 ? shape_tree_build(a, filters, NULL, n_filters, unbounded_first) : NULL;
}

void scene_prepare(Scene *s)
{
    uint32_t n = (uint32_t)s->n_objects;
    Shape **shapes = ARENA_ARRAY(s->arena, Shape *, n);
    unsigned char *flags = ARENA_ARRAY(s->arena, unsigned char, n);
    unsigned all_looks = 0;
    s->tree = ARENA_NEW(s->arena, struct SceneTree);
    for (uint32_t i = 0; i < n; i++) {
        unsigned looks = looks_in_scene(s, s->objects[i]);
        shapes[i] = &s->objects[i]->shape;
        flags[i] = flags_of(s->objects[i], looks);
        all_looks |= looks;
    }
    bool unbounded_first = s->n_objects + s->n_lights >= SORTED_FROM;
    s->tree->shapes = shape_tree_build(s->arena, shapes, flags, n, unbounded_first);
    s->tree->filters = tree_of_filters(s->arena, shapes, flags, n, unbounded_first);
    for (size_t i = 0; i < s->n_lights; i++) s->lights[i].is_plain = light_is_plain(&s->lights[i]);
    s->needs_shadow_rays = lights_cast_shadows(s);
    s->needs_secondary_rays = (all_looks & (LOOKS_CLEAR | LOOKS_REFLECTING)) != 0;
}

/* Objects that are shared are released once: their looks are forgotten on the way. */
static void release_below(Shape *s)
{
    if (shape_is_object(s)) {
        Object *o = (Object *)s;
        if (!(o->looks & LOOKS_KNOWN)) return;
        o->looks = 0;
    }
    Shape *const *parts;
    uint32_t n = s->type->parts ? s->type->parts(s, &parts) : 0;
    for (uint32_t i = 0; i < n; i++) release_below(parts[i]);
    shape_release(s);
}

void scene_release(Scene *s)
{
    for (size_t i = 0; i < s->n_objects; i++) release_below(&s->objects[i]->shape);
    s->tree = NULL;
}

static unsigned hidden_from(RayKind kind) { return kind == RAY_REFLECTED ? NO_REFLECTION : NO_IMAGE; }

bool scene_hit(const Scene *s, const Ray *r, RayKind kind, Hit *best, Trace *t)
{
    best->t = INFINITY;
    return shape_tree_hit(s->tree->shapes, r, hidden_from(kind), best, t);
}

static bool hit_is_opaque(const Scene *s, const Hit *h)
{
    const Object *o = hit_textured_object(h);
    if (!o) return texture_is_opaque(s->default_texture);
    return texture_is_opaque(o->texture) && (!o->interior_texture || texture_is_opaque(o->interior_texture));
}

ShadowKind scene_shadow_at(const Scene *s, const Hit *h)
{
    if (hit_has_flag_no_shadow(h)) return SHADOW_NOTHING;
    return hit_is_opaque(s, h) ? SHADOW_BLOCKER : SHADOW_FILTER;
}

bool scene_blocks(const Scene *s, const Ray *r, double t_max, bool *may_be_filtered, Trace *t)
{
    t->left_out = 0;
    bool is_blocked = shape_tree_blocks(s->tree->shapes, r, NOT_SURELY_OPAQUE, t_max, t);
    *may_be_filtered = t->left_out & MAY_FILTER;
    return is_blocked;
}

static Lanes hit_one_by_one(const Scene *s, const RayBunch *b, Lanes lanes, RayKind kind, Hit best[], Trace *t)
{
    Lanes hit = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        bunch_begin(b, i, t);
        if (scene_hit(s, &b->ray[i], kind, &best[i], t)) hit |= 1u << i;
        bunch_end(b, i, t);
    }
    return hit;
}

Lanes scene_hit_bunch(const Scene *s, RayBunch *b, Lanes lanes, RayKind kind, Hit best[], Trace *t)
{
    if (lanes_are_few(lanes)) return hit_one_by_one(s, b, lanes, kind, best, t);
    for (Lanes left = lanes; left; ) best[lanes_next(&left)].t = INFINITY;
    return shape_tree_hit_bunch(s->tree->shapes, b, lanes, hidden_from(kind), best, t);
}

Lanes scene_blocks_bunch(const Scene *s, RayBunch *b, Lanes lanes, const double t_max[], Lanes *may_be_filtered, Trace *t)
{
    for (Lanes left = lanes; left; ) b->lane[lanes_next(&left)].left_out = 0;
    Lanes blocked = shape_tree_blocks_bunch(s->tree->shapes, b, lanes, NOT_SURELY_OPAQUE, t_max, t);
    *may_be_filtered = 0;
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        if (b->lane[i].left_out & MAY_FILTER) *may_be_filtered |= 1u << i;
    }
    return blocked;
}

void scene_filters(const Scene *s, const Ray *r, HitList *out, Trace *t)
{
    if (s->tree->filters) shape_tree_all_hits(s->tree->filters, r, out, t);
}
