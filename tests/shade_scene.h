/* Scenes for the tests of shading: camera{location <0,0,-5> look_at 0 right x up y angle 40}, one pixel, linear values. */
#ifndef TRIMRAY_TESTS_SHADE_SCENE_H
#define TRIMRAY_TESTS_SHADE_SCENE_H

#include "render/shade.h"
#include "tests/test.h"

/* What POV-Ray 3.7 gave, to four decimals: half a unit of the last one, and the 16 bits of the file it was read from. */
#define MEASURED 6e-5

static const Color brown = { .4f, .2f, .1f, 0, 0 }, white = { 1, 1, 1, 0, 0 };

/* FINISH(phong = .7, f_.phong_size = 5): the default with some fields changed. */
#define FINISH(...) __extension__({ Finish f_ = finish_default(); f_.__VA_ARGS__; f_; })

static inline void set_camera(Scene *s, Vec3 location, Vec3 look_at)
{
    CameraDesc desc = camera_desc_default();
    desc.location = location, desc.look_at = look_at, desc.has_look_at = true;
    desc.right = vec(1, 0, 0);
    desc.angle = 40, desc.has_angle = true;
    camera_make(&desc, &s->camera);
}

static inline Scene *new_scene(Arena *a)
{
    Scene *s = scene_new(a);
    set_camera(s, vec(0, 0, -5), vec(0, 0, 0));
    return s;
}

static inline void add_background(Scene *s) { s->background = (Color){ .2f, .4f, .6f, 0, 0 }; }

static inline Light *add_light(Scene *s, LightKind kind)
{
    Light l = light_default(kind);
    l.position = vec(3, 4, -5), l.point_at = vec(0, 0, 0), l.color = rgb(1, 1, 1);
    scene_add_light(s, &l);
    return &s->lights[s->n_lights - 1];
}

static inline Pigment *new_pigment(Arena *a, const char *pattern, Color first, Color second)
{
    Pigment *p = ARENA_NEW(a, Pigment), *ends = ARENA_ARRAY(a, Pigment, 2);
    PigmentEntry *entries = ARENA_ARRAY(a, PigmentEntry, 2);
    ends[0] = pigment_solid(first), ends[1] = pigment_solid(second);
    entries[0] = (PigmentEntry){ 0, &ends[0] }, entries[1] = (PigmentEntry){ 1, &ends[1] };
    *p = pigment_solid(first);
    p->pattern = pattern_make(pattern_type(pattern));
    p->kind = p->pattern.type->n_blocks > 0 ? PIGMENT_BLOCKS : PIGMENT_MAP;
    p->entries = entries, p->n_entries = 2;
    return p;
}

static inline Texture *new_texture(Arena *a, const Pigment *p, Finish f)
{
    Layer *layer = ARENA_NEW(a, Layer);
    Texture *t = ARENA_NEW(a, Texture);
    *layer = (Layer){ p, f };
    *t = (Texture){ .layers = layer, .n_layers = 1 };
    return t;
}

static inline Texture *plain_texture(Arena *a, Color c, Finish f)
{
    Pigment *p = ARENA_NEW(a, Pigment);
    *p = pigment_solid(c);
    return new_texture(a, p, f);
}

static inline Object *add_shape(Scene *s, Shape *shape, Color c, Finish f)
{
    Object *o = object_new(s->arena, shape);
    o->texture = plain_texture(s->arena, c, f);
    scene_add_object(s, o);
    return o;
}

static inline Object *add_sphere(Scene *s, Color c, Finish f)
{
    return add_shape(s, sphere_new(s->arena, vec(-.3, -.2, 0), 1), c, f);
}

/* plane{z,4 pigment{checker rgb 1 rgb <.3,.1,0> scale .3}} */
static inline void add_checkered_wall(Scene *s)
{
    Object *o = add_shape(s, plane_new(s->arena, vec(0, 0, 1), 4), white, finish_default());
    Pigment *p = new_pigment(s->arena, "checker", white, (Color){ .3f, .1f, 0, 0, 0 });
    Xform scale = xform_scale(vec(.3, .3, .3));
    pigment_transform(p, &scale);
    o->texture = new_texture(s->arena, p, finish_default());
}

static inline Interior *new_interior(Scene *s, double ior)
{
    Interior *i = ARENA_NEW(s->arena, Interior);
    i->ior = (float)ior;
    return i;
}

static inline Interior *fading_interior(Scene *s, double ior, double distance, double power, Color c)
{
    Interior *i = new_interior(s, ior);
    i->fade_distance = (float)distance, i->fade_power = (float)power, i->fade_color = c;
    return i;
}

static inline Finish glowing(double ambient) { return FINISH(ambient = rgb(ambient, ambient, ambient), f_.diffuse = 0); }

static inline Finish mirror(double min, double max)
{
    return FINISH(has_reflection = true, f_.reflection_min = rgb(min, min, min), f_.reflection_max = rgb(max, max, max));
}

/* Pixel (x, y) of n by n. The scene must have been prepared. */
static inline Pixel pixel_at(const Scene *s, int x, int y, int n, int quality, Counters *counters)
{
    Trace t = { .scratch = arena_new() };
    Vec2 at = vec2(x, y);
    BunchLane lane = { 0 };
    RayBunch rays;
    Pixel p;
    camera_rays(&s->camera, &at, 1, n, n, &rays);
    rays.lane = &lane;
    shade_camera_rays(s, &rays, quality, &t, &p);
    arena_free(t.scratch);
    if (counters) *counters = t.counters;
    return p;
}

static inline Pixel pixel_of(Scene *s, int quality, Counters *counters)
{
    scene_prepare(s);
    Pixel p = pixel_at(s, 0, 0, 1, quality, counters);
    scene_release(s);
    return p;
}

static inline void check_rgb(const char *what, Pixel p, Rgb expected)
{
    CHECK(fabs(p.r - expected.r) <= MEASURED && fabs(p.g - expected.g) <= MEASURED && fabs(p.b - expected.b) <= MEASURED,
          "%s: %.5f %.5f %.5f, not %.4f %.4f %.4f", what, p.r, p.g, p.b, expected.r, expected.g, expected.b);
}

static inline void check_measured(const char *what, Scene *s, double r, double g, double b)
{
    check_rgb(what, pixel_of(s, 9, NULL), rgb(r, g, b));
}

#endif
