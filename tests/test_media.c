/* Transparency: Snell and Fresnel in closed form, total reflection, nested and fading interiors as POV-Ray has them; and
 * that rays do not meet what they have just left, at any scale. */
#include "render/finish.h"
#include "tests/shade_scene.h"

static const Color clear = { 1, 1, 1, 1, 0 };

static Finish invisible(void) { return FINISH(ambient = rgb(0, 0, 0), f_.diffuse = 0); }

/* ---- closed forms ---- */

static void reflectivity_is_fresnels(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        double n = exp(test_range(&r, -1, 1)), c = test_unit(&r), sine = sqrt(1 - c * c) / n, truth = 1;
        if (sine < 1) {
            double behind = sqrt(1 - sine * sine);
            double s = (c - n * behind) / (c + n * behind), p = (behind - n * c) / (behind + n * c);
            truth = (s * s + p * p) / 2;
        }
        CHECK_WITHIN(fabs(finish_fresnel(c, n) - truth), 1e-12, "seed %u: n %g, cosine %g", seed, n, c);
    }
}

/* A grey ramp along x on the plane z = 10: the colour is the place that a ray reached. */
static void add_ruler(Scene *s)
{
    Object *o = add_shape(s, plane_new(s->arena, vec(0, 0, 1), 10), white, glowing(1));
    Pigment *p = new_pigment(s->arena, "gradient", (Color){ 0 }, white);
    Xform place = xform_then(xform_scale(vec(40, 1, 1)), xform_translate(vec(-20, 0, 0)));
    pigment_transform(p, &place);
    o->texture = new_texture(s->arena, p, glowing(1));
}

/* Behind a slab of thickness 2 that is tilted by `tilt` the ray runs on parallel to itself, displaced by what Snell says. */
static void a_slab_displaces_rays_as_snell_says(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        double tilt = test_range(&r, -60, 60), n = test_range(&r, 1.05, 2.5);
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        Object *slab = add_shape(s, box_shape_new(a, vec(-50, -50, -1), vec(50, 50, 1)), clear, invisible());
        slab->interior = new_interior(s, n);
        n = slab->interior->ior;   /* in single precision */
        Xform turn = xform_rotate(vec(0, tilt, 0));
        object_transform(slab, &turn);
        add_ruler(s);
        Counters c;
        Pixel p = pixel_of(s, 9, &c);
        double i = tilt * (M_PI / 180), displaced = 2 * (sin(i) - sin(i) * cos(i) / sqrt(n * n - sin(i) * sin(i)));
        double x = p.r * 40 - 20;
        double error = fabs(fabs(x) - fabs(displaced));
        CHECK_WITHIN(error, 1e-5, "seed %u: tilt %g, n %g: x = %g", seed, tilt, n, x);   /* colours are floats */
        CHECK(c.transmitted_rays == 2 && c.reflected_rays == 0, "seed %u", seed);
        arena_free(a);
    }
}

/* A camera within glass, beside its border: three total reflections; what each way through the glass leaves of the light of
 * a white box, measured. */
static void total_reflection_keeps_light_in(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    set_camera(s, vec(.9, 0, 0), vec(.9, 0, 1));
    Object *ball = add_shape(s, sphere_new(a, vec(0, 0, 0), 1), clear, invisible());
    ball->interior = fading_interior(s, 1.5, .7, 2, (Color){ .9f, .2f, .1f, 0, 0 });
    add_shape(s, box_shape_new(a, vec(-9, -9, .25), vec(.85, 9, .3)), white, glowing(1));
    Counters c;
    Pixel p = pixel_of(s, 9, &c);
    check_rgb("after three reflections", p, rgb(.8575, .2048, .1535));
    CHECK(c.reflected_rays == 3 && c.transmitted_rays == 0 && p.transmit == 0, "%d reflected", (int)c.reflected_rays);
    arena_free(a);
}

/* ---- POV-Ray, measured ---- */

static void light_goes_through_as_in_povray(void **state)
{
    (void)state;
    const struct { const char *name; Color c; double ior, distance, power, version; Rgb expected; } cases[] = {
        { "transmit", { 1, .5f, .25f, 0, .6f }, 0, 0, 0, 3.7, { .3833, .2996, .2938 } },
        { "filter", { 1, .5f, .25f, .6f, 0 }, 0, 0, 0, 3.7, { .3833, .1696, .0768 } },
        { "both, refracted", { .8f, .5f, .25f, .4f, .3f }, 1.5, 0, 0, 3.7, { .2759, .2144, .1497 } },
        { "the same, #version 3.6", { .8f, .5f, .25f, .4f, .3f }, 1.5, 0, 0, 3.6, { .3290, .2449, .1640 } },
        { "fading", { 1, 1, 1, 1, 0 }, 1.3, .7, 2, 3.7, { .1823, .1175, .1233 } },
        { "fading by Beer's law", { 1, 1, 1, 1, 0 }, 1.3, .7, 1001, 3.7, { .1520, .0445, .0507 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_background(s);
        add_light(s, LIGHT_POINT);
        Object *o = add_sphere(s, cases[i].c, finish_default());
        Color amber = { .9f, .2f, .1f, 0, 0 };
        if (cases[i].ior != 0)
            o->interior = fading_interior(s, cases[i].ior, cases[i].distance, cases[i].power, amber);
        s->version = cases[i].version;
        check_rgb(cases[i].name, pixel_of(s, 9, NULL), cases[i].expected);
        arena_free(a);
    }
}

static void interiors_overlap_as_in_povray(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_background(s);
    add_light(s, LIGHT_POINT);
    add_sphere(s, (Color){ .9f, .8f, .7f, .8f, 0 }, finish_default())->interior = new_interior(s, 1.5);
    Shape *other = sphere_new(a, vec(.2, .3, .5), 1);
    add_shape(s, other, (Color){ .7f, .8f, .9f, .8f, 0 }, finish_default())->interior = new_interior(s, 1.2);
    add_checkered_wall(s);
    check_measured("two balls of glass", s, .2076, .2015, .1908);
    arena_free(a);
}

static void a_camera_in_glass_knows_it(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_background(s);
    add_light(s, LIGHT_POINT);
    Shape *ball = sphere_new(a, vec(0, 0, -4), 3);
    add_shape(s, ball, (Color){ .9f, .8f, .7f, .8f, 0 }, finish_default())->interior = new_interior(s, 1.5);
    add_shape(s, sphere_new(a, vec(.2, .3, 1.5), 1), white, finish_default());
    check_measured("from within", s, .3344, .2925, .2517);
    arena_free(a);
}

static void what_is_reflected_is_not_transmitted_if_energy_is_conserved(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    add_background(s);
    add_light(s, LIGHT_POINT);
    Finish f = mirror(.1, .9);
    f.reflection_fresnel = f.conserve_energy = true;
    add_sphere(s, (Color){ .9f, .8f, .7f, 0, .8f }, f)->interior = new_interior(s, 1.5);
    add_checkered_wall(s);
    check_measured("conserve_energy", s, .5018, .5193, .5371);
    arena_free(a);
}

/* Two solids that share one object (a union used twice) are two solids, each with an inside of its own. */
static void copies_of_a_solid_are_told_apart(void **state)
{
    (void)state;
    double seen[2];
    for (int shared = 0; shared < 2; shared++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        Shape *part[2], *whole[2];
        for (int i = 0; i < 2; i++) {
            Object *o = object_new(a, sphere_new(a, vec(.3, .2, 0), 1));
            o->texture = plain_texture(a, clear, invisible());
            o->interior = new_interior(s, 1.4);
            part[i] = &o->shape;
        }
        if (shared) part[1] = part[0];
        for (int i = 0; i < 2; i++) whole[i] = union_new(a, &part[i], 1);
        for (int i = 0; i < 2; i++) {
            Object *o = object_new(a, shared ? whole[0] : whole[i]);
            Xform move = xform_translate(vec(0, 0, i));
            object_transform(o, &move);
            scene_add_object(s, o);
        }
        add_ruler(s);
        seen[shared] = pixel_of(s, 9, NULL).r;
        arena_free(a);
    }
    CHECK(seen[0] > 0 && seen[0] == seen[1], "%g and %g", seen[0], seen[1]);
}

static void hidden_objects_are_hidden_as_in_povray(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        add_background(s);
        double z = i == 2 ? -9 : 0;   /* the third: behind the camera, seen in a mirror, through glass there too */
        if (i == 2) add_shape(s, plane_new(a, vec(0, 0, 1), 1), (Color){ 0 }, mirror(1, 1));
        add_shape(s, box_shape_new(a, vec(-1, -1, i == 2 ? -7 : -1), vec(1, 1, i == 2 ? -6.9 : -.9)), clear, invisible());
        Object *o = add_shape(s, box_shape_new(a, vec(-1, -1, z), vec(1, 1, z + 1)), white, glowing(1));
        o->no_image = i != 1, o->no_reflection = i == 1;
        Rgb expected = i == 0 ? rgb(.2, .4, .6) : rgb(1, 1, 1);
        check_rgb(i == 0 ? "no_image" : i == 1 ? "no_reflection" : "no_image, mirrored", pixel_of(s, 9, NULL), expected);
        arena_free(a);
    }
}

/* ---- leaving surfaces ---- */

/* A floor, a mirroring ball and one of glass; everything k times as large and moved. */
static Scene *still_life(Arena *a, double k, Vec3 by)
{
    Scene *s = new_scene(a);
    add_background(s);
    Light *l = add_light(s, LIGHT_POINT);
    l->position = vec_add(vec_scale(vec(3, 6, -5), k), by);
    set_camera(s, vec_add(vec_scale(vec(0, 1, -5), k), by), by);
    Finish f = mirror(.3, .3);
    add_shape(s, plane_new(a, vec(0, 1, 0), -k + by.y), white, finish_default());
    add_shape(s, sphere_new(a, vec_add(vec_scale(vec(-.7, -.3, .5), k), by), .7 * k), brown, f);
    add_shape(s, cylinder_new(a, vec_add(vec_scale(vec(.8, -1, .8), k), by), vec_add(vec_scale(vec(.8, .3, .8), k), by),
                              .5 * k, false), brown, f);
    Shape *ball = sphere_new(a, vec_add(vec_scale(vec(.5, -.5, -.8), k), by), .5 * k);
    add_shape(s, ball, (Color){ 1, 1, 1, .9f, 0 }, f)->interior = new_interior(s, 1.5);
    scene_prepare(s);
    return s;
}

enum { SIDE = 48 };

/* How many pixels differ by more than `by`. */
static int n_different(const Scene *a, const Scene *b, double by)
{
    int n = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            Pixel p = pixel_at(a, x, y, SIDE, 9, NULL), q = pixel_at(b, x, y, SIDE, 9, NULL);
            n += !(fabs(p.r - q.r) <= by && fabs(p.g - q.g) <= by && fabs(p.b - q.b) <= by);
        }
    return n;
}

static void the_picture_does_not_depend_on_scale(void **state)
{
    (void)state;
    static const double scales[] = { 1e-8, 1e-3, 1e8 };
    Arena *a = arena_new();
    Scene *s = still_life(a, 1, vec(0, 0, 0));
    for (size_t i = 0; i < 3; i++) {
        Scene *scaled = still_life(a, scales[i], vec(0, 0, 0));
        CHECK(n_different(s, scaled, 1e-9) == 0, "scale %g: %d pixels", scales[i], n_different(s, scaled, 1e-9));
        scene_release(scaled);
    }
    scene_release(s);
    arena_free(a);
}

/* Coordinates near 1e6 have an error of 1e-10: too little to be seen, but where an edge passes within that of a ray. Acne
 * would be hundreds of pixels. */
static void far_from_the_origin_nothing_shadows_itself(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = still_life(a, 1, vec(0, 0, 0)), *far = still_life(a, 1, vec(1e6, -2e6, 3e6));
    int n = n_different(s, far, 1e-4);
    CHECK(n == 0, "%d pixels differ", n);
    scene_release(s);
    scene_release(far);
    arena_free(a);
}

/* A convex thing lit from all around is nowhere in its own shadow: ambient 0, light at the camera. */
static void a_ball_does_not_shadow_itself(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 40; seed++) {
        TestRandom r = test_random(seed);
        double k = exp(test_range(&r, -12, 12)), off = exp(test_range(&r, -3, 9)) * k;
        Vec3 by = vec(test_range(&r, -off, off), test_range(&r, -off, off), test_range(&r, -off, off));
        Arena *a = arena_new();
        Scene *s = new_scene(a);
        set_camera(s, vec_add(by, vec(0, 0, -5 * k)), by);
        add_light(s, LIGHT_POINT)->position = vec_add(by, vec(0, 0, -5 * k));
        add_shape(s, sphere_new(a, by, k), white, FINISH(ambient = rgb(0, 0, 0), f_.diffuse = 1, f_.brilliance = 0));
        s->background = white;
        scene_prepare(s);
        for (int i = 0; i < SIDE * SIDE; i++) {
            Pixel p = pixel_at(s, i % SIDE, i / SIDE, SIDE, 9, NULL);
            CHECK_WITHIN(fabs(p.r - 1), 1e-6, "seed %u: size %g, offset %g, pixel %d", seed, k, off, i);
        }
        scene_release(s);
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reflectivity_is_fresnels),
        cmocka_unit_test(a_slab_displaces_rays_as_snell_says),
        cmocka_unit_test(total_reflection_keeps_light_in),
        cmocka_unit_test(light_goes_through_as_in_povray),
        cmocka_unit_test(interiors_overlap_as_in_povray),
        cmocka_unit_test(a_camera_in_glass_knows_it),
        cmocka_unit_test(what_is_reflected_is_not_transmitted_if_energy_is_conserved),
        cmocka_unit_test(copies_of_a_solid_are_told_apart),
        cmocka_unit_test(hidden_objects_are_hidden_as_in_povray),
        cmocka_unit_test(the_picture_does_not_depend_on_scale),
        cmocka_unit_test(far_from_the_origin_nothing_shadows_itself),
        cmocka_unit_test(a_ball_does_not_shadow_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
