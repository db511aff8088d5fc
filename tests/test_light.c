/* Lights and shadows against POV-Ray 3.7, measured. */
#include "tests/shade_scene.h"

static void each_kind_of_light_shines_as_povrays_does(void **state)
{
    (void)state;
    enum { FADING, SPOT, TIGHT_SPOT, CYLINDER, PARALLEL, N };
    static const Rgb expected[N] = {
        { .1538, .0769, .0384 }, { .1324, .0662, .0331 }, { .1111, .0555, .0278 }, { .0932, .0466, .0233 },
        { .2560, .1280, .0640 },
    };
    for (int i = 0; i < N; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        Light *l = add_light(s, i == SPOT || i == TIGHT_SPOT ? LIGHT_SPOT : i == CYLINDER ? LIGHT_CYLINDER : LIGHT_POINT);
        if (i == FADING) l->fade_distance = 4, l->fade_power = 2;
        if (i == SPOT || i == TIGHT_SPOT) l->radius = 1, l->falloff = 8, l->tightness = i == TIGHT_SPOT ? 50 : 0;
        if (i == CYLINDER) l->radius = .3, l->falloff = 1.5, l->tightness = 2;
        if (i == PARALLEL) l->is_parallel = true;
        add_sphere(s, brown, finish_default());
        char name[16];
        snprintf(name, sizeof name, "light %d", i);
        check_rgb(name, pixel_of(s, 9, NULL), expected[i]);
        arena_free(a);
    }
}

/* plane{z,0 pigment{rgb 1}} seen from -z: ambient .1, diffuse .6 of what arrives at the origin. */
static void parallel_lights_fade_along_their_axis_and_have_no_cone(void **state)
{
    (void)state;
    static const struct {
        const char *name; LightKind kind; Vec3 position, point_at; bool is_parallel; double fade, expected;
    } cases[] = {
        { "a point light fades with distance", LIGHT_POINT, { 3, 4, -5 }, { 0, 0, 0 }, false, 2, .1629 },
        { "a parallel one along its axis", LIGHT_POINT, { 3, 4, -5 }, { 3, 4, 0 }, true, 2, .2655 },
        { "so does a cylinder", LIGHT_CYLINDER, { 3, 4, -5 }, { 3, 4, 0 }, false, 2, .2655 },
        { "a parallel spot has no cone", LIGHT_SPOT, { 0, 40, -5 }, { 0, 40, 0 }, true, 0, .7 },
        { "but a back", LIGHT_SPOT, { 0, 4, 5 }, { 0, 4, 10 }, true, 0, .1 },
        { "a parallel light has none", LIGHT_POINT, { 0, 4, 5 }, { 0, 4, 10 }, true, 0, .7 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        Light *l = add_light(s, cases[i].kind);
        l->position = cases[i].position, l->point_at = cases[i].point_at, l->is_parallel = cases[i].is_parallel;
        l->fade_distance = cases[i].fade, l->fade_power = cases[i].fade > 0 ? 2 : 0;
        if (l->kind == LIGHT_CYLINDER) l->radius = 5, l->falloff = 15;
        add_shape(s, plane_new(a, vec(0, 0, 1), 0), white, finish_default());
        check_measured(cases[i].name, s, cases[i].expected, cases[i].expected, cases[i].expected);
        arena_free(a);
    }
}

static void a_shadowless_light_makes_no_highlight(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_light(s, LIGHT_POINT)->is_shadowless = true;
    add_sphere(s, brown, FINISH(phong = .7, f_.phong_size = 5));
    Counters c;
    check_rgb("shadowless", pixel_of(s, 9, &c), rgb(.2446, .1223, .0611));
    CHECK(c.shadow_rays == 0, "%d shadow rays", (int)c.shadow_rays);
    arena_free(a);
}

static void light_on_the_back_is_for_those_who_ask(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {   /* the light is behind: default, double_illuminate, diffuse .6,.3 */
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_light(s, LIGHT_POINT)->position = vec(0, 0, 5);
        Finish f = FINISH(diffuse_back = i == 2 ? .3 : 0, f_.phong = 1);
        Object *o = add_shape(s, disc_new(a, vec(0, 0, 0), vec(0, 0, 1), 1, 0), white, f);
        o->double_illuminate = i == 1;
        double expected = i == 0 ? .1 : i == 1 ? .7 : .4;
        check_measured("back", s, expected, expected, expected);
        arena_free(a);
    }
}

/* ---- blockers ---- */

static Object *add_blocker(Scene *s, Vec3 centre, Color c)
{
    Object *o = add_shape(s, sphere_new(s->arena, centre, .5), c, finish_default());
    o->no_image = true;
    return o;
}

static void what_stands_in_the_light_takes_it_away(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_light(s, LIGHT_POINT);
    add_sphere(s, brown, finish_default());
    Object *blocker = add_blocker(s, vec(1.65, 2.1, -3), brown);
    check_measured("opaque", s, .04, .02, .01);
    blocker->no_shadow = true;
    check_measured("no_shadow", s, .2446, .1223, .0611);
    blocker->no_shadow = false;
    s->lights[0].position = vec(1.65, 2.1, -3);
    blocker->child = sphere_new(a, vec(1.65, 2.1, -4), 1e-9);
    Pixel p = pixel_of(s, 9, NULL);
    CHECK(p.r > .1, "a blocker beyond the light takes nothing: %g", p.r);
    arena_free(a);
}

static void a_transparent_blocker_filters_the_light(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_light(s, LIGHT_POINT);
    add_sphere(s, brown, finish_default());
    Object *o = add_blocker(s, vec(1.65, 2.1, -3), (Color){ 1, .2f, .1f, .8f, 0 });
    check_measured("filtered", s, .1709, .0226, .0103);
    o->texture = plain_texture(a, (Color){ 1, .8f, .6f, .8f, 0 }, finish_default());
    Interior *in = fading_interior(s, 1.5, .4, 1, (Color){ .9f, .5f, .2f, 0, 0 });
    in->caustics = .5f;
    o->interior = in;
    check_measured("with caustics, and fading", s, .3616, .0914, .0235);
    arena_free(a);
}

static void area_lights_make_povrays_soft_shadows(void **state)
{
    (void)state;
    static const struct { const char *name; int n_u, n_v, adaptive; bool circular; Rgb expected; } cases[] = {
        { "5 x 5", 5, 5, 100, false, { .1423, .0711, .0356 } },
        { "adaptive 1", 5, 5, 1, false, { .1423, .0711, .0356 } },
        { "9 x 3 adaptive 0", 9, 3, 0, false, { .1487, .0743, .0372 } },
        { "circular orient", 5, 5, 100, true, { .1519, .0759, .0380 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        Light *l = add_light(s, LIGHT_POINT);
        l->is_area = true, l->area_u = vec(2, 0, 0), l->area_v = vec(0, 2, 0);
        l->area_n_u = cases[i].n_u, l->area_n_v = cases[i].n_v, l->area_adaptive = cases[i].adaptive;
        l->area_circular = l->area_orient = cases[i].circular;
        add_sphere(s, brown, finish_default());
        add_blocker(s, vec(2, 2, -3), (Color){ 0 });
        check_rgb(cases[i].name, pixel_of(s, 9, NULL), cases[i].expected);
        arena_free(a);
    }
}

static void area_illumination_shines_from_every_sample(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    Light *l = add_light(s, LIGHT_POINT);
    l->color = rgb(1, .9, .8), l->fade_distance = 4, l->fade_power = 2;
    l->is_area = l->area_illumination = true;
    l->area_u = vec(2, 0, 0), l->area_v = vec(0, 2, 0), l->area_n_u = 5, l->area_n_v = 3;
    add_sphere(s, brown, finish_default());
    add_blocker(s, vec(2, 2, -3), (Color){ 0 });
    check_measured("area_illumination", s, .0968, .0456, .0214);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_of_light_shines_as_povrays_does),
        cmocka_unit_test(parallel_lights_fade_along_their_axis_and_have_no_cone),
        cmocka_unit_test(a_shadowless_light_makes_no_highlight),
        cmocka_unit_test(light_on_the_back_is_for_those_who_ask),
        cmocka_unit_test(what_stands_in_the_light_takes_it_away),
        cmocka_unit_test(a_transparent_blocker_filters_the_light),
        cmocka_unit_test(area_lights_make_povrays_soft_shadows),
        cmocka_unit_test(area_illumination_shines_from_every_sample),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
