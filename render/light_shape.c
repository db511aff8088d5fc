/* A light as a shape: no ray meets it, but it stands in unions and objects, and moves with them. The scene finds the lights
 * in what is added to it. */
#include "render/light.h"

typedef struct {
    Shape shape;
    Light light;
} LightShape;

static Box light_bounds(const Shape *s) { (void)s; return box_empty(); }

static bool light_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    (void)s, (void)r, (void)best, (void)t;
    return false;
}

static bool light_tessellate(const Shape *s, double chord_error, MeshSink *out)
{
    (void)s, (void)chord_error, (void)out;
    return true;
}

static unsigned light_looks(const Shape *s) { (void)s; return 0; }

static const ShapeType light_type = {
    .name = "light_source", .bounds = light_bounds, .hit = light_hit, .tessellate = light_tessellate, .looks = light_looks,
};

Shape *light_shape_new(Arena *a, const Light *l)
{
    LightShape *s = ARENA_NEW(a, LightShape);
    shape_init(&s->shape, &light_type);
    s->shape.n_primitives = 0;
    s->light = *l;
    return &s->shape;
}

const Light *shape_light(const Shape *s) { return s->type == &light_type ? &((const LightShape *)s)->light : NULL; }

void light_transform(Light *l, const Xform *x)
{
    l->position = xform_point(x, l->position);
    l->point_at = xform_point(x, l->point_at);
    l->area_u = xform_vector(x, l->area_u);
    l->area_v = xform_vector(x, l->area_v);
}
