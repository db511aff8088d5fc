#include "tests/test.h"

#include "render/hit.h"
#include "render/hit_list.h"
#include "render/scene.h"

static Arena *arena;

static int make_arena(void **state)
{
    (void)state;
    arena = arena_new();
    return 0;
}

static int free_arena(void **state)
{
    (void)state;
    arena_free(arena);
    return 0;
}

static const Texture *textured(Color color, double reflection)
{
    Pigment *pigment = ARENA_NEW(arena, Pigment);
    Layer *layer = ARENA_NEW(arena, Layer);
    Texture *texture = ARENA_NEW(arena, Texture);
    *pigment = pigment_solid(color);
    *layer = (Layer){ pigment, finish_default() };
    layer->finish.has_reflection = reflection > 0;
    layer->finish.reflection_min = layer->finish.reflection_max = rgb(reflection, reflection, reflection);
    *texture = (Texture){ .layers = layer, .n_layers = 1 };
    return texture;
}

static const Color RED = { 1, 0, 0, 0, 0 }, GLASS = { 1, 1, 1, 0, .5f };

static Object *ball(double z, const Texture *t)
{
    Object *o = object_new(arena, sphere_new(arena, vec(0, 0, z), 1));
    o->texture = t;
    return o;
}

static Object *joined(Object *a, Object *b)
{
    Shape *const parts[] = { &a->shape, &b->shape };
    return object_new(arena, union_new(arena, parts, 2));
}

static Scene *scene_of(Object *const objects[], int n, int n_lights)
{
    Scene *s = scene_new(arena);
    Light light = light_default(LIGHT_POINT);
    for (int i = 0; i < n; i++) scene_add_object(s, objects[i]);
    for (int i = 0; i < n_lights; i++) scene_add_light(s, &light);
    scene_prepare(s);
    return s;
}

static const Ray along_z = { { .1, .2, 0 }, { 0, 0, 1 }, 0 };

static const Object *seen(const Scene *s, RayKind kind)
{
    Trace t = { 0 };
    Hit h;
    return scene_hit(s, &along_z, kind, &h, &t) ? hit_innermost(&h) : NULL;
}

static void a_new_scene_is_povrays(void **state)
{
    (void)state;
    Scene *s = scene_new(arena);
    CHECK(s->max_trace_level == 5 && s->adc_bailout == 1. / 255 && s->version == 3.7, "settings");
    CHECK(s->gamma == GAMMA_POWER && s->gamma_power == 1, "gamma");
    CHECK(s->ambient_light.r == 1 && s->background.r == 0 && s->background.transmit == 1, "light");
    CHECK(texture_is_opaque(s->default_texture) && !texture_reflects(s->default_texture), "the default texture");
    CHECK(s->camera.right.x == 1.33 && s->camera.direction.z == 1, "the camera");
}

static void hidden_objects_are_seen_only_by_other_rays(void **state)
{
    (void)state;
    Object *o[] = { ball(10, NULL), ball(20, NULL), ball(30, NULL) };
    o[0]->no_image = true, o[1]->no_reflection = true;
    Scene *s = scene_of(o, 3, 0);
    assert_ptr_equal(seen(s, RAY_CAMERA), o[1]);
    assert_ptr_equal(seen(s, RAY_TRANSMITTED), o[1]);
    assert_ptr_equal(seen(s, RAY_REFLECTED), o[0]);
    o[0]->no_reflection = true;
    s = scene_of(o, 3, 0);
    assert_ptr_equal(seen(s, RAY_REFLECTED), o[2]);
    scene_release(s);
}

/* POV-Ray's order where surfaces coincide: that of the file, but planes first once there are three objects or lights. */
static void where_surfaces_coincide_povrays_order_decides(void **state)
{
    (void)state;
    Object *o[] = { object_new(arena, box_shape_new(arena, vec(-1, -1, 5), vec(1, 1, 9))),
                    object_new(arena, plane_new(arena, vec(0, 0, 1), 5)) };
    assert_ptr_equal(seen(scene_of(o, 2, 0), RAY_CAMERA), o[0]);
    assert_ptr_equal(seen(scene_of(o, 2, 1), RAY_CAMERA), o[1]);
    Object *swapped[] = { o[1], o[0] };
    assert_ptr_equal(seen(scene_of(swapped, 2, 0), RAY_CAMERA), o[1]);
}

static void hits_are_numbered_in_the_order_of_the_file(void **state)
{
    (void)state;
    Object *both = joined(ball(40, NULL), ball(20, NULL)), *o[] = { ball(50, NULL), both, ball(60, NULL), ball(30, NULL) };
    Scene *s = scene_of(o, 4, 1);
    Ray r = along_z;
    static const uint32_t expected[] = { 2, 4, 1, 0, 3 };       /* at 20, 30, 40, 50, 60 */
    for (int i = 0; i < 5; i++) {
        Trace t = { 0 };
        Hit h;
        assert_true(scene_hit(s, &r, RAY_CAMERA, &h, &t));
        CHECK(h.index == expected[i], "hit %d: number %u", i, h.index);
        r.t_min = h.t + 3;                                        /* past the far side */
    }
    scene_release(s);
    CHECK(!shape_was_prepared(both->child), "the union's tree is still there");
}

static void a_scene_knows_what_rays_it_needs(void **state)
{
    (void)state;
    Object *plain[] = { ball(10, NULL), ball(20, textured(RED, 0)) };
    Scene *s = scene_of(plain, 2, 0);
    CHECK(!s->needs_shadow_rays && !s->needs_secondary_rays, "nothing asks for any");
    s = scene_of(plain, 2, 1);
    CHECK(s->needs_shadow_rays && !s->needs_secondary_rays, "a light");
    s->lights[0].is_shadowless = true;
    scene_prepare(s);
    CHECK(!s->needs_shadow_rays, "a light without shadows");
    Object *mirror[] = { joined(ball(10, NULL), ball(20, textured(RED, .5))) };
    CHECK(scene_of(mirror, 1, 0)->needs_secondary_rays, "a mirror within a union");
    Object *glass[] = { joined(ball(10, NULL), ball(20, textured(RED, 0))) };
    glass[0]->texture = textured(GLASS, 0);
    CHECK(scene_of(glass, 1, 0)->needs_secondary_rays, "a texture inherited by one part");
    Object *hidden[] = { joined(ball(10, textured(RED, 0)), ball(20, textured(RED, 0))) };
    hidden[0]->texture = textured(GLASS, 0);
    CHECK(!scene_of(hidden, 1, 0)->needs_secondary_rays, "a texture that no part inherits");
    Object *inside[] = { ball(10, textured(RED, 0)) };
    inside[0]->interior_texture = textured(GLASS, 0);
    CHECK(scene_of(inside, 1, 0)->needs_secondary_rays, "an interior texture");
}

static const ShadowKind LIT = SHADOW_NOTHING, DARK = SHADOW_BLOCKER, FILTERED = SHADOW_FILTER;

/* What a shadow ray meets first; *h: where it is filtered. */
static ShadowKind shadow(const Scene *s, double t_min, double t_max, Hit *h)
{
    Trace t = { .is_shadow_ray = true, .scratch = arena };
    Ray r = along_z;
    r.t_min = t_min;
    HitList filters = hit_list_make(arena, t_max);
    bool may_be_filtered, is_blocked = scene_blocks(s, &r, t_max, &may_be_filtered, &t);
    scene_filters(s, &r, &filters, &t);
    CHECK(is_blocked || may_be_filtered || filters.n == 0, "%zu filters that nobody would ask for", filters.n);
    CHECK(t.counters.bv_intersections == 0, "counted as a camera ray");
    for (size_t i = 0; i < filters.n && !is_blocked; i++) {
        *h = filters.hits[i];
        if (scene_shadow_at(s, h) != LIT) return scene_shadow_at(s, h);
    }
    return is_blocked ? DARK : LIT;
}

static void opaque_objects_end_a_shadow_ray(void **state)
{
    (void)state;
    Object *o[] = { ball(10, textured(RED, 0)), ball(20, NULL) };
    Scene *s = scene_of(o, 2, 1);
    Hit h;
    assert_int_equal(shadow(s, 0, 100, &h), DARK);
    assert_int_equal(shadow(s, 0, 8, &h), LIT);
    assert_int_equal(shadow(s, 12, 18, &h), LIT);
    assert_int_equal(shadow(s, 12, 100, &h), DARK);
    Object *without[] = { ball(10, NULL), ball(20, NULL) };
    without[0]->no_shadow = without[1]->no_shadow = true;
    assert_int_equal(shadow(scene_of(without, 2, 1), 0, 100, &h), LIT);
}

static void transparent_objects_filter_from_near_to_far(void **state)
{
    (void)state;
    Object *near_glass = ball(10, textured(GLASS, 0)), *far_glass = ball(20, textured(GLASS, 0));
    Object *o[] = { far_glass, near_glass };
    Scene *s = scene_of(o, 2, 1);
    Hit h;
    double t = 0;
    Object *const expected[] = { near_glass, near_glass, far_glass, far_glass };
    for (int i = 0; i < 4; i++) {
        CHECK(shadow(s, t, 100, &h) == FILTERED, "blocker %d", i);
        CHECK(hit_innermost(&h) == expected[i] && h.t > t, "blocker %d at %g", i, h.t);
        t = h.t;
    }
    assert_int_equal(shadow(s, t, 100, &h), LIT);
    Object *wall[] = { near_glass, ball(30, NULL) };
    assert_int_equal(shadow(scene_of(wall, 2, 1), 0, 100, &h), DARK);     /* whatever stands before it */
}

static void parts_of_a_union_cast_their_own_shadows(void **state)
{
    (void)state;
    Object *glass = ball(10, textured(GLASS, 0)), *none = ball(20, NULL), *wall = ball(30, NULL);
    none->no_shadow = true;
    Object *o[] = { joined(joined(glass, none), wall) };
    Scene *s = scene_of(o, 1, 1);
    Hit h;
    assert_int_equal(shadow(s, 0, 25, &h), FILTERED);
    assert_ptr_equal(hit_innermost(&h), glass);
    assert_int_equal(shadow(s, 12, 25, &h), LIT);                         /* the one without shadow */
    assert_int_equal(shadow(s, 12, 100, &h), DARK);
    scene_release(s);
}

/* A union of 512 copies of a union of 512 copies of ... a sphere: nothing may walk all the ways through it. */
static void shared_parts_are_walked_once(void **state)
{
    (void)state;
    Object *o = object_new(arena, sphere_new(arena, vec(0, 0, 10), 1));
    for (int i = 0; i < 8; i++) {
        Object *parts[512];
        Shape *shapes[512];
        for (int k = 0; k < 512; k++) parts[k] = object_copy(arena, o), shapes[k] = &parts[k]->shape;
        o = object_new(arena, union_new(arena, shapes, 512));
        if (o->shape.depth == HIT_MAX_OBJECTS) break;
    }
    double begun = stats_now();
    Scene *s = scene_of(&o, 1, 1);
    Hit h;
    Trace t = { 0 };
    assert_false(scene_hit(s, &(Ray){ { 5, 5, 0 }, { 0, 0, 1 }, 0 }, RAY_CAMERA, &h, &t));
    scene_release(s);
    CHECK_WITHIN(stats_now() - begun, 5, "seconds for 2^63 spheres");
}

static void lights_move_with_what_they_stand_in(void **state)
{
    (void)state;
    Light light = light_default(LIGHT_SPOT);
    light.position = vec(1, 0, 0), light.point_at = vec(0, 0, 0), light.area_u = vec(0, 0, 1);
    Object *lamp = object_new(arena, light_shape_new(arena, &light)), *both = joined(lamp, ball(0, textured(RED, 0)));
    Xform up = xform_translate(vec(0, 5, 0)), twice = xform_scale(vec(2, 2, 2));
    object_transform(lamp, &up);
    object_transform(both, &twice);
    Object *all[] = { both, object_copy(arena, both) };
    object_transform(all[1], &up);
    Scene *s = scene_of(all, 2, 0);
    assert_int_equal(s->n_lights, 2);
    for (int i = 0; i < 2; i++) {
        const Light *l = &s->lights[i];
        CHECK(l->position.x == 2 && l->position.y == 10 + 5 * i && l->position.z == 0, "y %g", l->position.y);
        CHECK(l->point_at.x == 0 && l->point_at.y == 10 + 5 * i, "point_at y %g", l->point_at.y);
        assert_true(l->area_u.z == 2);
    }
    Hit h = { .t = INFINITY };
    Trace t = { 0 };
    assert_true(scene_hit(s, &(Ray){ { 0, 0, -9 }, { 0, 0, 1 }, 0 }, RAY_CAMERA, &h, &t));   /* the ball */
    h.t = INFINITY;
    assert_false(scene_hit(s, &(Ray){ { 2, 10, -9 }, { 0, 0, 1 }, 0 }, RAY_CAMERA, &h, &t));   /* not the lamp */
    scene_release(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_scene_is_povrays),
        cmocka_unit_test(hidden_objects_are_seen_only_by_other_rays),
        cmocka_unit_test(where_surfaces_coincide_povrays_order_decides),
        cmocka_unit_test(hits_are_numbered_in_the_order_of_the_file),
        cmocka_unit_test(a_scene_knows_what_rays_it_needs),
        cmocka_unit_test(opaque_objects_end_a_shadow_ray),
        cmocka_unit_test(transparent_objects_filter_from_near_to_far),
        cmocka_unit_test(parts_of_a_union_cast_their_own_shadows),
        cmocka_unit_test(shared_parts_are_walked_once),
        cmocka_unit_test(lights_move_with_what_they_stand_in),
    };
    return cmocka_run_group_tests(tests, make_arena, free_arena);
}
