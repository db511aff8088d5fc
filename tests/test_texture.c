/* Patterns, pigments, textures and image maps: POV-Ray's measured values at single points, and laws that they obey. */
#include "render/image_map.h"
#include "tests/test.h"

#include <string.h>

static const Color black = { 0 }, white = { 1, 1, 1, 0, 0 };
static const Vec2 no_uv = { 0, 0 };

static Vec3 random_vec(TestRandom *r, double size)
{
    return vec(test_range(r, -size, size), test_range(r, -size, size), test_range(r, -size, size));
}

/* Greys 0, .5, 1 for three blocks, 0 and 1 for two; for values the default map, which is the value itself. */
static Pigment grey_pigment(Arena *a, const char *pattern)
{
    const PatternType *type = pattern_type(pattern);
    Pigment p = pigment_solid(black);
    p.pattern = pattern_make(type);
    p.kind = PIGMENT_MAP;
    if (type->n_blocks == 0) return p;
    p.kind = PIGMENT_BLOCKS;
    p.n_entries = type->n_blocks;
    PigmentEntry *entries = ARENA_ARRAY(a, PigmentEntry, p.n_entries);
    for (int i = 0; i < p.n_entries; i++) {
        Pigment *block = ARENA_NEW(a, Pigment);
        *block = pigment_solid(color_lerp(black, white, (double)i / (p.n_entries - 1)));
        entries[i] = (PigmentEntry){ 0, block };
    }
    p.entries = entries;
    return p;
}

typedef struct { Vec3 at; double grey; } Measured;

static void check_measured(const char *what, const Pigment *p, const Measured *list, int n)
{
    for (int i = 0; i < n; i++) {
        double grey = p->pattern.type->n_blocks > 0 ? pigment_color(p, list[i].at, no_uv).r
                                                    : pattern_value(&p->pattern, list[i].at);
        CHECK_WITHIN(fabs(grey - list[i].grey), 6e-5, "%s, point %d: %g, not %g", what, i, grey, list[i].grey);
    }
}

static void patterns_are_povrays(void **state)
{
    (void)state;
    static const Measured hexagon[] = {
        { { -0.38, 0.48, 3.39 }, 1 }, { { -0.27, 0.06, 0.7 }, 0 }, { { -2.52, 0.1, 1.04 }, .5 },
        { { 2.34, -3.25, -1.57 }, 1 }, { { -3.27, 2.48, 1.55 }, .5 }, { { -3.66, 3.86, 3.72 }, 1 },
        { { 1.23, .92, -2.74 }, 0 }, { { -3.88, .23, -3.52 }, .5 },
    };
    static const Measured brick[] = {   /* brick_size <1.5,.7,.9> mortar .1 */
        { { -2.48, -2.06, -3.76 }, 1 }, { { -0.29, -0.48, 2.74 }, 1 }, { { 0.15, 1.12, 0 }, 1 },
        { { 1.3, -0.34, -1.77 }, 1 }, { { 3.98, 3.97, 2.72 }, 1 }, { { 1.66, -1.48, -2.16 }, 0 },
        { { -1.69, -3.44, 2.13 }, 1 }, { { -.8, 2.77, -.91 }, 0 },
    };
    static const Measured gradient[] = {   /* gradient <1,2,.5> triangle_wave frequency 1.7 */
        { { 3.66, 2.78, -4 }, 0.5136 }, { { -2.32, 3.28, -0.24 }, 0.7136 }, { { 3.84, -0.82, -3.42 }, 0.7271 },
        { { 1.04, 2.23, -1.84 }, 0.6038 }, { { -3.3, -1.34, 3.71 }, 0.121 }, { { 2.06, -3.06, -2.03 }, 0.4694 },
        { { -3.19, -3.52, 2.38 }, 0.5858 }, { { -2.58, 0.47, -0.42 }, 0.7452 },
    };
    static const Measured radial[] = {   /* radial frequency 5 phase .3 */
        { { -2.47, 1.86, -2.95 }, 0.1047 }, { { 1.15, -3.07, -0.63 }, 0.6988 }, { { -2.3, -1.84, 3.77 }, 0.6141 },
        { { 2.43, -1.57, 3.08 }, 0.5815 }, { { -2.31, -0.85, 2.84 }, 0.5066 }, { { 1.13, -3.2, 3.91 }, 0.2738 },
        { { -2.29, -1.93, 2.18 }, 0.4054 }, { { -1.37, -1.63, -3.41 }, 0.854 },
    };
    Arena *a = arena_new();
    Pigment p = grey_pigment(a, "hexagon");
    check_measured("hexagon", &p, hexagon, 8);
    p = grey_pigment(a, "brick");
    p.pattern.brick_size = vec(1.5, .7, .9), p.pattern.mortar = .1f;
    check_measured("brick", &p, brick, 8);
    p = grey_pigment(a, "gradient");
    p.pattern.direction = vec(1, 2, .5), p.pattern.wave = WAVE_TRIANGLE, p.pattern.frequency = 1.7;
    check_measured("gradient", &p, gradient, 8);
    p = grey_pigment(a, "radial");
    p.pattern.frequency = 5, p.pattern.phase = .3;
    check_measured("radial", &p, radial, 8);
    arena_free(a);
}

static void checkers_change_at_every_step(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Pigment p = grey_pigment(a, "checker");
    for (unsigned seed = 0; seed < 500; seed++) {
        TestRandom r = test_random(seed);
        Vec3 q = random_vec(&r, 1000);
        double here = pigment_color(&p, q, no_uv).r;
        CHECK(pigment_color(&p, vec_add(q, vec(1, 0, 0)), no_uv).r == 1 - here, "seed %u: x", seed);
        CHECK(pigment_color(&p, vec_sub(q, vec(0, 1, 0)), no_uv).r == 1 - here, "seed %u: y", seed);
        CHECK(pigment_color(&p, vec_add(q, vec(0, 1, 1)), no_uv).r == here, "seed %u: y and z", seed);
    }
    CHECK(pigment_color(&p, vec(.5, -1e-11, .5), no_uv).r == 0, "a floor at y = 0 is of one block in spite of rounding");
    CHECK(pigment_color(&p, vec(.5, 1e-11, .5), no_uv).r == 0, "from above as well");
    p.n_entries = 0;
    Color first = pigment_color(&p, vec(.5, .5, .5), no_uv), second = pigment_color(&p, vec(1.5, .5, .5), no_uv);
    CHECK(first.b == 1 && first.g == 0 && second.g == 1 && second.b == 0, "blue and green by default");
    arena_free(a);
}

static void waves_are_their_formulas(void **state)
{
    (void)state;
    for (int i = 1; i < 1000; i++) {
        double v = i / 1000.;
        const double truth[] = { v, v < .5 ? 2 * v : 2 - 2 * v, .5 + .5 * sin(2 * M_PI * v), fabs(sin(M_PI * v)),
                                 v * v * (3 - 2 * v), pow(v, 2.5) };
        Pattern p = pattern_make(pattern_type("gradient"));
        p.exponent = 2.5;
        for (Wave wave = WAVE_RAMP; wave <= WAVE_POLY; wave++) {
            p.wave = wave;
            CHECK_WITHIN(fabs(pattern_value(&p, vec(v, 7, 8)) - truth[wave]), 1e-14, "wave %d at %g", (int)wave, v);
        }
    }
}

static void distances_are_measured_by_their_patterns(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        Vec3 q = random_vec(&r, .5);   /* within all of the shapes */
        const struct { const char *name; double truth; } cases[] = {
            { "spherical", 1 - vec_length(q) }, { "cylindrical", 1 - sqrt(q.x * q.x + q.z * q.z) },
            { "planar", 1 - fabs(q.y) }, { "boxed", 1 - vec_max_abs(q) }, { "onion", vec_length(q) },
            { "leopard", pow((sin(q.x) + sin(q.y) + sin(q.z)) / 3, 2) },
        };
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            Pattern p = pattern_make(pattern_type(cases[i].name));
            CHECK_WITHIN(fabs(pattern_value(&p, q) - cases[i].truth), 1e-14, "%s, seed %u", cases[i].name, seed);
        }
    }
    Pattern p = pattern_make(pattern_type("spherical"));
    CHECK(pattern_value(&p, vec(3, 4, 5)) == 0, "nothing outside");
    assert_null(pattern_type("granite"));
}

static void a_map_has_steps_and_ends(void **state)
{
    (void)state;
    Pigment colors[4];
    for (int i = 0; i < 4; i++) colors[i] = pigment_solid((Color){ (float)i, (float)(i * i), 0, 0, (float)i / 4 });
    PigmentEntry entries[] = { { .2f, &colors[0] }, { .5f, &colors[1] }, { .5f, &colors[2] }, { .8f, &colors[3] } };
    Pigment p = pigment_solid(black);
    p.kind = PIGMENT_MAP, p.pattern = pattern_make(pattern_type("gradient")), p.entries = entries, p.n_entries = 4;
    static const struct { double x, r, g, transmit; } cases[] = {
        { 0, 0, 0, 0 }, { .1, 0, 0, 0 }, { .35, .5, .5, .125 }, { .499999999, 1, 1, .25 }, { .5, 1, 1, .25 },
        { .500000001, 2, 4, .5 }, { .65, 2.5, 6.5, .625 }, { .9, 3, 9, .75 }, { 1, 3, 9, .75 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Color c = pigment_color(&p, vec(cases[i].x, 0, 0), no_uv);
        CHECK(fabs(c.r - cases[i].r) < 1e-6 && fabs(c.g - cases[i].g) < 1e-6 && fabs(c.transmit - cases[i].transmit) < 1e-6,
              "at %g: %g %g %g", cases[i].x, c.r, c.g, c.transmit);
    }
    assert_false(pigment_is_opaque(&p));
    p.entries = &entries[0], p.n_entries = 1;
    assert_true(pigment_is_opaque(&p));
}

static void radial_runs_through_the_hues_without_a_map(void **state)
{
    (void)state;
    Pigment p = pigment_solid(black);
    p.kind = PIGMENT_MAP, p.pattern = pattern_make(pattern_type("radial"));
    for (int i = 0; i < 2; i++) {   /* measured, at values of .0418 and .8334 */
        double angle = 2 * M_PI * ((i ? 20 : 1) / 24. + 1e-4 - .25) - M_PI;
        Color c = pigment_color(&p, vec(sin(angle), 0, cos(angle)), no_uv);
        Color truth = i ? (Color){ .4987f, .5013f, 1, 0, 0 } : (Color){ .1254f, 1, .8746f, 0, 0 };
        CHECK(fabs(c.r - truth.r) < 2e-4 && fabs(c.g - truth.g) < 2e-4 && fabs(c.b - truth.b) < 2e-4, "%g %g %g",
              c.r, c.g, c.b);
    }
}

static void a_moved_pigment_moves(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (unsigned seed = 0; seed < 200; seed++) {
        TestRandom r = test_random(seed);
        Pigment p = grey_pigment(a, "leopard");
        Layer layer = { &p, finish_default() };
        Texture t = { .layers = &layer, .n_layers = 1 };
        Xform x = xform_then(xform_rotate(random_vec(&r, 180)), xform_translate(random_vec(&r, 10)));
        x = xform_then(x, xform_scale(vec(test_range(&r, .1, 3), test_range(&r, .1, 3), test_range(&r, .1, 3))));
        Texture *moved = texture_transformed(a, &t, &x), *twice = texture_transformed(a, moved, &x);
        Vec3 q = random_vec(&r, 3), once_there = xform_point(&x, q), twice_there = xform_point(&x, once_there);
        double truth = pigment_color(&p, q, no_uv).r;
        CHECK_WITHIN(fabs(pigment_color(moved->layers[0].pigment, once_there, no_uv).r - truth), 1e-6, "seed %u", seed);
        CHECK_WITHIN(fabs(pigment_color(twice->layers[0].pigment, twice_there, no_uv).r - truth), 1e-6, "seed %u", seed);
        CHECK(!p.is_moved, "the original stays");
    }
    arena_free(a);
}

static void uv_mapping_replaces_the_point(void **state)
{
    (void)state;
    Pigment p = pigment_solid(black);
    p.kind = PIGMENT_MAP, p.pattern = pattern_make(pattern_type("gradient")), p.uv_mapping = true;
    CHECK_WITHIN(fabs(pigment_color(&p, vec(9, 9, 9), vec2(.25, .7)).r - .25), 1e-7, "u");
    Xform x = xform_scale(vec(.5, 1, 1));
    pigment_transform(&p, &x);
    CHECK_WITHIN(fabs(pigment_color(&p, vec(9, 9, 9), vec2(.25, .7)).r - .5), 1e-7, "u / .5");
}

static void a_texture_is_opaque_if_all_of_it_is(void **state)
{
    (void)state;
    Pigment solid = pigment_solid(white), filter = pigment_solid((Color){ 1, 1, 1, .1f, 0 });
    Finish plain = finish_default(), shiny = finish_default();
    shiny.has_reflection = true;
    Layer layers[] = { { &filter, plain }, { &solid, shiny }, { &solid, plain } };
    assert_false(texture_is_opaque(&(Texture){ .layers = layers, .n_layers = 2 }));
    assert_true(texture_is_opaque(&(Texture){ .layers = layers + 1, .n_layers = 2 }));
    assert_true(texture_reflects(&(Texture){ .layers = layers, .n_layers = 2 }));
    assert_false(texture_reflects(&(Texture){ .layers = layers + 2, .n_layers = 1 }));
}

/* ---- image maps: a picture of 2 by 2 pixels ---- */

static ImageMap *map_of(Arena *a, const ImageMapOptions *o, const Image *like, GammaKind gamma, double power)
{
    static uint16_t rgba[] = {
        65535, 0, 0, 65535,   0, 65535, 0, 65535,          /* the top row: red, green */
        0, 0, 65535, 65535,   32639, 32639, 32639, 0,      /* the bottom row: blue, half grey (127) and clear */
    };
    Image image = *like;
    image.width = image.height = 2, image.rgba = rgba;
    return image_map_new(a, &image, o, gamma, power);
}

static void check_color(const char *what, Color c, double r, double g, double b, double transmit)
{
    CHECK(fabs(c.r - r) < 1e-5 && fabs(c.g - g) < 1e-5 && fabs(c.b - b) < 1e-5 && fabs(c.transmit - transmit) < 1e-5,
          "%s: %g %g %g, transmit %g", what, c.r, c.g, c.b, c.transmit);
}

static const Image eight_bits = { .bits = 8 };

static void a_picture_covers_the_unit_square_again_and_again(void **state)
{
    (void)state;
    Arena *a = arena_new();
    ImageMap *m = map_of(a, &(ImageMapOptions){ 0 }, &eight_bits, GAMMA_NONE, 1);
    for (int i = -3; i < 3; i++)
        for (int j = -3; j < 3; j++) {
            check_color("top left", image_map_color(m, i + .25, j + .75), 1, 0, 0, 0);
            check_color("top right", image_map_color(m, i + .75, j + .75), 0, 1, 0, 0);
            check_color("bottom left", image_map_color(m, i + .1, j + .1), 0, 0, 1, 0);
            check_color("bottom right", image_map_color(m, i + .9, j + .4), 127 / 255., 127 / 255., 127 / 255., 1);
        }
    assert_false(image_map_is_opaque(m));
    arena_free(a);
}

static void once_is_clear_outside(void **state)
{
    (void)state;
    Arena *a = arena_new();
    ImageMap *m = map_of(a, &(ImageMapOptions){ .once = true }, &eight_bits, GAMMA_NONE, 1);
    check_color("inside", image_map_color(m, .25, .75), 1, 0, 0, 0);
    check_color("beside", image_map_color(m, 1.25, .75), 0, 0, 0, 1);
    check_color("below", image_map_color(m, .25, -.1), 0, 0, 0, 1);
    check_color("the upper edge belongs to it", image_map_color(m, .25, 1), 1, 0, 0, 0);
    arena_free(a);
}

static void interpolation_is_linear_between_the_centres_of_pixels(void **state)
{
    (void)state;
    Arena *a = arena_new();
    ImageMap *m = map_of(a, &(ImageMapOptions){ .interpolates = true }, &eight_bits, GAMMA_NONE, 1);
    check_color("a centre", image_map_color(m, .25, .75), 1, 0, 0, 0);
    check_color("half way", image_map_color(m, .5, .75), .5, .5, 0, 0);
    check_color("a quarter", image_map_color(m, .375, .75), .75, .25, 0, 0);
    check_color("over the border", image_map_color(m, 0, .75), .5, .5, 0, 0);
    check_color("down", image_map_color(m, .25, .5), .5, 0, .5, 0);
    m = map_of(a, &(ImageMapOptions){ .interpolates = true, .once = true }, &eight_bits, GAMMA_NONE, 1);
    check_color("its own border, once", image_map_color(m, 0, .75), 1, 0, 0, 0);
    arena_free(a);
}

static void pictures_are_decoded_by_their_gamma(void **state)
{
    (void)state;
    Arena *a = arena_new();
    double v = 127 / 255., srgb = pow((v + .055) / 1.055, 2.4);
    Image with_gamma = { .bits = 8, .has_gamma = true, .file_gamma = .5 };
    const struct {
        const char *name; ImageMapOptions o; const Image *like; GammaKind gamma; double power, truth;
    } cases[] = {
        { "sRGB by default", { 0 }, &eight_bits, GAMMA_POWER, 1, srgb },
        { "the file's gAMA", { 0 }, &with_gamma, GAMMA_POWER, 1, v * v },
        { "the scene's word", { .has_gamma = true, .gamma = 1.7 }, &with_gamma, GAMMA_POWER, 1, pow(v, 1.7) },
        { "the scene's word: srgb", { .has_gamma = true, .gamma_is_srgb = true }, &with_gamma, GAMMA_POWER, 1, srgb },
        { "a working space", { 0 }, &with_gamma, GAMMA_POWER, 2.2, pow(v * v, 1 / 2.2) },
        { "no handling", { 0 }, &with_gamma, GAMMA_NONE, 1, v },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ImageMap *m = map_of(a, &cases[i].o, cases[i].like, cases[i].gamma, cases[i].power);
        check_color(cases[i].name, image_map_color(m, .75, .25), cases[i].truth, cases[i].truth, cases[i].truth, 1);
    }
    arena_free(a);
}

/* Points whose place on the picture follows from the way round: from +x towards +z is from left to right, from below to
 * above (on a torus from its inner side over the upper one) is from the bottom to the top. */
static void pictures_wrap_round_spheres_cylinders_and_tori(void **state)
{
    (void)state;
    static const double TURN = 2 * M_PI;
    Arena *a = arena_new();
    ImageMap *sphere = map_of(a, &(ImageMapOptions){ .type = MAP_SPHERICAL }, &eight_bits, GAMMA_NONE, 1);
    ImageMap *cylinder = map_of(a, &(ImageMapOptions){ .type = MAP_CYLINDRICAL }, &eight_bits, GAMMA_NONE, 1);
    ImageMap *torus = map_of(a, &(ImageMapOptions){ .type = MAP_TOROIDAL }, &eight_bits, GAMMA_NONE, 1);
    for (int i = 0; i < 16; i++)
        for (int j = 0; j < 16; j++) {
            double u = (i + .5) / 16, v = (j + .5) / 16, size = exp(i - j);
            Color truth = image_map_color(sphere, u, v);
            double up = (v - .5) * M_PI, r = cos(up), tube = .3, about = v * TURN;
            Vec3 on_sphere = vec(size * r * cos(u * TURN), size * sin(up), size * r * sin(u * TURN));
            Vec3 on_cylinder = vec(size * cos(u * TURN), v, size * sin(u * TURN));
            double out = 1 - tube * cos(about);
            Vec3 on_torus = vec(out * cos(u * TURN), -tube * sin(about), out * sin(u * TURN));
            check_color("sphere", image_map_at(sphere, on_sphere), truth.r, truth.g, truth.b, truth.transmit);
            check_color("cylinder", image_map_at(cylinder, on_cylinder), truth.r, truth.g, truth.b, truth.transmit);
            check_color("torus", image_map_at(torus, on_torus), truth.r, truth.g, truth.b, truth.transmit);
        }
    check_color("nowhere", image_map_at(sphere, vec(0, 0, 0)), 0, 0, 0, 1);
    arena_free(a);
}

/* ---- textures that choose ---- */

static TextureMap texture_map_of(const char *pattern, const TextureEntry *entries, int n)
{
    return (TextureMap){ .pattern = pattern_make(pattern_type(pattern)), .entries = entries, .n_entries = n,
                         .space = xform_scale(vec(2, 2, 2)) };
}

static void a_texture_map_blends_its_neighbours_in_its_own_space(void **state)
{
    (void)state;
    static const Texture low, high;
    const TextureEntry entries[] = { { .25f, &low }, { .75f, &high } };
    TextureMap map = texture_map_of("gradient", entries, 2);
    TextureChoice c[2];
    assert_int_equal(texture_choose(&map, vec(.2, 0, 0), c), 1);            /* twice as large: at .1 */
    assert_true(c[0].texture == &low && c[0].share == 1);
    assert_int_equal(texture_choose(&map, vec(1.9, 0, 0), c), 1);
    assert_true(c[0].texture == &high);
    assert_int_equal(texture_choose(&map, vec(.8, 6, 0), c), 2);            /* at .4: .3 of the way */
    for (int i = 0; i < 2; i++) {
        double truth = c[i].texture == &high ? .3 : .7;
        CHECK_WITHIN(c[i].share - truth, 1e-12, "share %g", c[i].share);
        CHECK_WITHIN(c[i].point.y - 3, 1e-12, "y %g", c[i].point.y);
    }
    assert_true(c[0].texture != c[1].texture);
}

static void blocks_of_textures_are_not_blended(void **state)
{
    (void)state;
    static const Texture first, second;
    const TextureEntry entries[] = { { 0, &first }, { 1, &second } };
    TextureMap map = texture_map_of("checker", entries, 2);
    TextureChoice c[2];
    for (int i = -5; i < 5; i++) {
        assert_int_equal(texture_choose(&map, vec(2 * i + 1, 1, 1), c), 1);
        assert_true(c[0].texture == (i % 2 ? &second : &first) && c[0].share == 1);
    }
}

static void a_texture_map_is_opaque_if_all_its_textures_are(void **state)
{
    (void)state;
    Pigment solid = pigment_solid((Color){ 1, 1, 1, 0, 0 }), clear = pigment_solid((Color){ 1, 1, 1, 0, .1f });
    Layer opaque = { &solid, finish_default() }, glassy = { &clear, finish_default() };
    glassy.finish.has_reflection = true;
    Texture a = { .layers = &opaque, .n_layers = 1 }, b = { .layers = &glassy, .n_layers = 1 };
    const TextureEntry same[] = { { 0, &a }, { 1, &a } }, mixed[] = { { 0, &a }, { 1, &b } };
    TextureMap maps[] = { texture_map_of("onion", same, 2), texture_map_of("onion", mixed, 2) };
    for (int i = 0; i < 2; i++) {
        Texture t = { .map = &maps[i] };
        assert_int_equal(texture_is_opaque(&t), i == 0);
        assert_int_equal(texture_reflects(&t), i == 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_are_povrays),
        cmocka_unit_test(checkers_change_at_every_step),
        cmocka_unit_test(waves_are_their_formulas),
        cmocka_unit_test(distances_are_measured_by_their_patterns),
        cmocka_unit_test(a_map_has_steps_and_ends),
        cmocka_unit_test(radial_runs_through_the_hues_without_a_map),
        cmocka_unit_test(a_moved_pigment_moves),
        cmocka_unit_test(uv_mapping_replaces_the_point),
        cmocka_unit_test(a_texture_is_opaque_if_all_of_it_is),
        cmocka_unit_test(a_picture_covers_the_unit_square_again_and_again),
        cmocka_unit_test(once_is_clear_outside),
        cmocka_unit_test(interpolation_is_linear_between_the_centres_of_pixels),
        cmocka_unit_test(pictures_are_decoded_by_their_gamma),
        cmocka_unit_test(pictures_wrap_round_spheres_cylinders_and_tori),
        cmocka_unit_test(a_texture_map_blends_its_neighbours_in_its_own_space),
        cmocka_unit_test(blocks_of_textures_are_not_blended),
        cmocka_unit_test(a_texture_map_is_opaque_if_all_its_textures_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
