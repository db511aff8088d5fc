/* Shading against POV-Ray 3.7, measured: finishes, mirrors, layers, surroundings, quality. */
#include "tests/shade_scene.h"

static void a_finish_answers_light_as_povrays_does(void **state)
{
    (void)state;
    const struct { const char *name; Finish f; Rgb expected; } cases[] = {
        { "default", finish_default(), { .2446, .1223, .0611 } },
        { "brilliance 3", FINISH(brilliance = 3), { .1886, .0943, .0472 } },
        { "diffuse albedo .6 brilliance 3", FINISH(diffuse_albedo = true, f_.brilliance = 3), { .3372, .1686, .0843 } },
        { "ambient + emission", FINISH(ambient = rgb(.1, .2, .3), f_.emission = rgb(.05, .05, .05)),
          { .2646, .1523, .0861 } },
        { "phong .7", FINISH(phong = .7), { .3757, .2534, .1923 } },
        { "phong .7 phong_size 5", FINISH(phong = .7, f_.phong_size = 5), { .8123, .6901, .6289 } },
        { "the same, metallic", FINISH(phong = .7, f_.phong_size = 5, f_.metallic = 1), { .4761, .2417, .1246 } },
        { "phong albedo", FINISH(phong = .2, f_.phong_albedo = true, f_.phong_size = 5), { .7312, .6090, .5478 } },
        { "specular .7", FINISH(specular = .7), { .7984, .6761, .6149 } },
        { "specular .7 roughness .2", FINISH(specular = .7, f_.roughness = .2), { .9047, .7825, .7213 } },
        { "specular albedo", FINISH(specular = .7, f_.specular_albedo = true, f_.roughness = .2), { .8782, .7559, .6948 } },
        { "specular metallic .5", FINISH(specular = .7, f_.roughness = .2, f_.metallic = .5), { .7093, .5218, .4281 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_light(s, LIGHT_POINT);
        add_sphere(s, brown, cases[i].f);
        check_rgb(cases[i].name, pixel_of(s, 9, NULL), cases[i].expected);
        arena_free(a);
    }
}

static void a_mirror_mirrors_as_povrays_does(void **state)
{
    (void)state;
    struct { const char *name; Finish f; Rgb expected; } cases[] = {
        { "reflection .4", mirror(.4, .4), { .3246, .2823, .3011 } },
        { "reflection{.1,.9}", mirror(.1, .9), { .2753, .1838, .1534 } },
        { "falloff 3", mirror(.1, .9), { .2646, .1624, .1213 } },
        { "metallic", mirror(.9, .9), { .3173, .1963, .1185 } },
        { "exponent 2", mirror(.9, .9), { .6471, .6915, .7583 } },
        { "fresnel", mirror(0, .9), { .2518, .1368, .0829 } },
    };
    cases[2].f.reflection_falloff = 3;
    cases[3].f.reflection_metallic = 1;
    cases[4].f.reflection_exponent = 2;
    cases[5].f.reflection_fresnel = true;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_background(s);
        add_light(s, LIGHT_POINT);
        add_sphere(s, brown, cases[i].f)->interior = new_interior(s, 1.5);
        check_rgb(cases[i].name, pixel_of(s, 9, NULL), cases[i].expected);
        arena_free(a);
    }
}

/* Panes that do not bend light are no levels, however many; but where the levels end at the first pane, nothing is seen
 * beyond it (measured with POV-Ray 3.7). */
static void straight_rays_are_no_levels_but_do_not_begin_at_the_last(void **state)
{
    (void)state;
    for (int level = 1; level <= 2; level++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        s->max_trace_level = level;
        for (int i = 0; i < 9; i++)
            add_shape(s, disc_new(a, vec(0, 0, i), vec(0, 0, 1), 2, 0), (Color){ 1, 1, 1, 0, 1 }, glowing(0));
        add_shape(s, plane_new(a, vec(0, 0, 1), 9), white, glowing(.5));
        Pixel p = pixel_of(s, 9, NULL);
        CHECK_WITHIN(fabs(p.g - (level == 2 ? .5 : 0)), 1e-12, "%d levels: %g", level, p.g);
        arena_free(a);
    }
}

/* Two mirrors face each other, each with a glow of .1: what is seen is .1 (1 + .5 + .5^2 + ...), as far as rays go. */
static void rays_end_at_max_trace_level_and_at_adc_bailout(void **state)
{
    (void)state;
    static const struct { int level; double bailout; int terms; } cases[] = {
        { 1, 0, 1 }, { 3, 1. / 255, 3 }, { 20, .1, 4 }, { 20, .124, 4 }, { 20, .126, 3 }, { 40, 1e-9, 30 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        s->max_trace_level = cases[i].level, s->adc_bailout = cases[i].bailout;
        Finish f = mirror(.5, .5);
        f.ambient = rgb(.1, .1, .1), f.diffuse = 0;
        add_shape(s, plane_new(a, vec(0, 0, 1), 1), white, f);
        add_shape(s, plane_new(a, vec(0, 0, -1), 6), white, f);
        Counters c;
        Pixel p = pixel_of(s, 9, &c);
        CHECK_WITHIN(fabs(p.r - .2 * (1 - pow(.5, cases[i].terms))), 1e-12, "case %zu", i);
        CHECK((int)c.reflected_rays == cases[i].terms - 1 && c.camera_rays == 1, "case %zu", i);
        arena_free(a);
    }
}

/* ---- layers ---- */

static Object *add_layered_plane(Scene *s, Layer below, Layer above)
{
    Object *o = add_shape(s, plane_new(s->arena, vec(0, 0, 1), 0), brown, finish_default());
    Texture *t = ARENA_NEW(s->arena, Texture);
    *t = (Texture){ .layers = arena_copy(s->arena, (Layer[]){ below, above }, 2, sizeof(Layer)), .n_layers = 2 };
    o->texture = t;
    return o;
}

static Layer layer(Arena *a, Color c, Finish f) { return plain_texture(a, c, f)->layers[0]; }

static void layers_are_seen_from_the_top_down(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    Layer red = layer(a, (Color){ 1, 0, 0, 0, 0 }, glowing(1));
    add_layered_plane(s, red, layer(a, (Color){ 0, 1, 0, 0, .75f }, glowing(1)));
    check_measured("two layers", s, .75, .25, 0);
    s->adc_bailout = .3;
    s->n_objects = 0;
    add_layered_plane(s, red, layer(a, (Color){ 0, 1, 0, 0, .29f }, glowing(1)));
    check_measured("the lower one counts for too little", s, 0, .71, 0);
    arena_free(a);
}

static void every_layer_reflects_in_full(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_background(s);
    Finish below = mirror(.4, .4), above = mirror(.1, .1);
    below.ambient = rgb(.5, .5, .5), above.ambient = rgb(1, 1, 1);
    add_layered_plane(s, layer(a, (Color){ 1, 0, 0, 0, 0 }, below), layer(a, (Color){ 0, 1, 0, 0, .75f }, above));
    check_measured("two mirrors", s, .475, .45, .3);
    arena_free(a);
}

static void an_interior_texture_is_seen_from_inside(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_light(s, LIGHT_POINT);
    Object *o = add_shape(s, sphere_new(a, vec(0, 0, -5), 3), (Color){ .r = 1 }, finish_default());
    o->interior_texture = plain_texture(a, (Color){ .g = 1 }, finish_default());
    check_measured("inside", s, 0, .1, 0);
    arena_free(a);
}

static void uv_mapping_takes_the_coordinates_of_the_surface(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    Object *o = add_sphere(s, white, finish_default());
    Texture *t = new_texture(a, new_pigment(a, "gradient", (Color){ 0 }, (Color){ 1, .5f, .2f, 0, 0 }), glowing(1));
    t->uv_mapping = true;
    o->texture = t;
    check_measured("uv", s, .7995, .3998, .1599);
    arena_free(a);
}

static void smooth_triangles_are_lit_by_their_normals(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_light(s, LIGHT_POINT);
    Vec3 p[3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 } }, n[3] = { { -1, 0, -1 }, { 1, 1, -2 }, { 0, 1, -1 } };
    add_shape(s, smooth_triangle_new(a, p, n), white, finish_default());
    check_measured("smooth triangle", s, .6155, .6155, .6155);
    arena_free(a);
}

/* ---- surroundings ---- */

static void the_sky_is_povrays(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    set_camera(s, vec(0, 0, 0), vec(0, 1, 2));
    Pigment *p = new_pigment(a, "gradient", white, (Color){ .1f, .2f, .6f, 0, 0 });
    p->pattern.direction = vec(0, 1, 0);
    const Pigment *pigments[] = { p };
    SkySphere sky = { pigments, 1, xform_identity() };
    s->sky = &sky;
    check_measured("sky", s, .5975, .6422, .8211);
    arena_free(a);
}

static void fog_is_povrays(void **state)
{
    (void)state;
    Fog constant = { .type = 1, .distance = 6, .color = { .5f, .6f, .7f, 0, 0 } };
    Fog filtering = { .type = 1, .distance = 6, .color = { .5f, .6f, .7f, .3f, .2f } };
    Fog dark = { .type = 1, .distance = 3, .color = { .1f, .2f, .3f, 0, 0 } };
    Fog ground = { .type = 2, .distance = 3, .offset = -.5, .altitude = .3, .up = { 0, 1, 0 }, .color = { .5f, .6f, .7f, 0, 0 } };
    const struct { const char *name; Fog fogs[2]; size_t n; bool has_sphere; Rgb expected; } cases[] = {
        { "constant", { constant }, 1, true, { .4492, .3969, .3954 } },
        { "two, one with filter and transmit", { filtering, dark }, 2, true, { .3649, .4669, .5792 } },
        { "ground", { ground }, 1, true, { .4302, .3206, .2809 } },
        { "ground, over the sky", { ground }, 1, false, { .5, .6, .7 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_background(s);
        s->fogs = cases[i].fogs, s->n_fogs = cases[i].n;
        if (cases[i].has_sphere) add_sphere(s, brown, glowing(1));
        check_rgb(cases[i].name, pixel_of(s, 9, NULL), cases[i].expected);
        arena_free(a);
    }
}

static void there_is_no_fog_within_solids_that_are_not_hollow(void **state)
{
    (void)state;
    for (int hollow = 0; hollow < 2; hollow++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        Fog fog = { .type = 1, .distance = 6, .color = { .5f, .6f, .7f, 0, 0 } };
        s->fogs = &fog, s->n_fogs = 1;
        add_shape(s, sphere_new(a, vec(0, 0, -5), 6), white, glowing(1))->is_hollow = hollow;
        double share = hollow ? exp(-1) : 1;
        check_measured("from within", s, share + (1 - share) * .5, share + (1 - share) * .6, share + (1 - share) * .7);
        arena_free(a);
    }
}

static void a_background_is_dimmed_by_its_transmit_and_shows_it(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    s->background = (Color){ .2f, .4f, .6f, 0, .3f };
    Pixel p = pixel_of(s, 9, NULL);
    check_rgb("background", p, rgb(.14, .28, .42));
    CHECK_WITHIN(fabs(p.transmit - .3), 1e-7, "alpha");
    arena_free(a);
}

/* ---- what is left out ---- */

static void a_matt_scene_asks_for_no_secondary_rays(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_sphere(s, brown, finish_default());
    Counters c;
    pixel_of(s, 9, &c);
    CHECK(c.camera_rays == 1 && c.shadow_rays + c.reflected_rays + c.transmitted_rays == 0, "without light");
    add_light(s, LIGHT_POINT);
    add_light(s, LIGHT_POINT)->position = vec(0, 0, 50);   /* behind */
    pixel_of(s, 9, &c);
    CHECK(c.shadow_rays == 1 && c.reflected_rays + c.transmitted_rays == 0, "with one light that can be seen");
    arena_free(a);
}

static void quality_leaves_out_what_povray_leaves_out(void **state)
{
    (void)state;
    static const Rgb expected[12] = {
        { .4, .2, .1 }, { .4, .2, .1 }, { .2649, .1793, .1365 }, { .2649, .1793, .1365 }, { .2649, .1793, .1365 },
        { .2649, .1793, .1365 }, { .2988, .2232, .1944 }, { .2988, .2232, .1944 }, { .409, .4119, .4637 },
        { .409, .4119, .4637 }, { .409, .4119, .4637 }, { .409, .4119, .4637 },
    };
    for (int quality = 0; quality < 12; quality++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_background(s);
        add_light(s, LIGHT_POINT);
        Finish f = mirror(.4, .4);
        f.phong = .5;
        add_sphere(s, (Color){ .4f, .2f, .1f, 0, .3f }, f);
        Object *floor = add_shape(s, plane_new(a, vec(0, 1, 0), -1.5), brown, finish_default());
        Pigment *checker = new_pigment(a, "checker", white, (Color){ .3f, .3f, .3f, 0, 0 });
        floor->texture = new_texture(a, checker, finish_default());
        char name[16];
        snprintf(name, sizeof name, "+Q%d", quality);
        check_rgb(name, pixel_of(s, quality, NULL), expected[quality]);
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_finish_answers_light_as_povrays_does),
        cmocka_unit_test(a_mirror_mirrors_as_povrays_does),
        cmocka_unit_test(rays_end_at_max_trace_level_and_at_adc_bailout),
        cmocka_unit_test(straight_rays_are_no_levels_but_do_not_begin_at_the_last),
        cmocka_unit_test(layers_are_seen_from_the_top_down),
        cmocka_unit_test(every_layer_reflects_in_full),
        cmocka_unit_test(an_interior_texture_is_seen_from_inside),
        cmocka_unit_test(uv_mapping_takes_the_coordinates_of_the_surface),
        cmocka_unit_test(smooth_triangles_are_lit_by_their_normals),
        cmocka_unit_test(the_sky_is_povrays),
        cmocka_unit_test(fog_is_povrays),
        cmocka_unit_test(there_is_no_fog_within_solids_that_are_not_hollow),
        cmocka_unit_test(a_background_is_dimmed_by_its_transmit_and_shows_it),
        cmocka_unit_test(a_matt_scene_asks_for_no_secondary_rays),
        cmocka_unit_test(quality_leaves_out_what_povray_leaves_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
