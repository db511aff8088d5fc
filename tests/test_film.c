/* The transfer to a file against POV-Ray 3.7's integers, measured, and against the curves' own laws. */
#include "render/film.h"
#include "tests/test.h"

#include <math.h>

static void linear_colors_become_the_integers_of_povray(void **state)
{
    (void)state;
    static const struct { float value; int small, large; } measured[] = {
        { .001f, 3, 847 }, { .01f, 25, 6544 }, { .05f, 63, 16240 },
        { .2f, 124, 31754 }, { .5f, 188, 48192 }, { .8f, 231, 59396 },
    };
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        int small = film_sample(measured[i].value, GAMMA_POWER, 1, 255);
        int large = film_sample(measured[i].value, GAMMA_POWER, 1, 65535);
        CHECK(small == measured[i].small && large == measured[i].large, "%g: %d, %d", measured[i].value, small, large);
    }
}

static void without_gamma_values_are_only_scaled(void **state)
{
    (void)state;
    for (int i = 0; i <= 255; i++) {
        CHECK(film_sample(i / 255., GAMMA_NONE, 1, 255) == i, "%d", i);
        CHECK(film_sample(i / 255., GAMMA_SRGB, 1, 255) == i, "%d: a working space like the file's", i);
    }
    assert_int_equal(film_sample(16.5 / 255, GAMMA_SRGB, 1, 255), 17);   /* measured */
}

static void what_is_outside_is_clipped(void **state)
{
    (void)state;
    static const double outside[] = { -1e30, -1, -0., NAN, 1, 1.0001, 1e30, INFINITY };
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
        int expected = outside[i] >= 1 ? 65535 : 0;
        for (GammaKind gamma = GAMMA_NONE; gamma <= GAMMA_SRGB; gamma++)
            CHECK(film_sample(outside[i], gamma, 2.2, 65535) == expected, "%g, gamma kind %d", outside[i], (int)gamma);
    }
}

static void the_curve_rises_and_the_working_space_is_undone(void **state)
{
    (void)state;
    static const double powers[] = { 1, 1.8, 2.2 };
    for (size_t p = 0; p < 3; p++) {
        int before = 0;
        for (int i = 0; i <= 4000; i++) {
            double linear = i / 4000., working = film_working(linear, GAMMA_POWER, powers[p]);
            CHECK_WITHIN(fabs(film_linear(working, GAMMA_POWER, powers[p]) - linear), 1e-6, "%g", linear);   /* floats */
            int now = film_sample(linear, GAMMA_POWER, powers[p], 65535);
            CHECK(now >= before, "at %g", linear);
            before = now;
        }
        assert_int_equal(before, 65535);
    }
}

static void the_srgb_curve_is_its_definition(void **state)
{
    (void)state;
    for (int i = 0; i <= 255; i++) {
        double v = i / 255., truth = v <= .04045 ? v / 12.92 : pow((v + .055) / 1.055, 2.4);
        CHECK_WITHIN(fabs(film_srgb_decode(v) - truth), 2e-7, "%d", i);
        CHECK(film_sample(film_srgb_decode(v), GAMMA_POWER, 1, 255) == i, "%d comes back", i);
    }
}

static void check_curve(const FilmCurve *c, double working)
{
    int truth = film_sample(working, c->gamma, c->gamma_power, c->max), found = film_curve_sample(c, working);
    CHECK(found == truth, "gamma kind %d, %g, of %d: at %a %d, not %d", (int)c->gamma, c->gamma_power, c->max, working,
          found, truth);
}

/* At every step, some hundred floats before and behind it, at random between them, and outside. */
static void a_curve_of_steps_is_the_curve(void **state)
{
    (void)state;
    static const struct { GammaKind gamma; double power; } kinds[] = {
        { GAMMA_POWER, 1 }, { GAMMA_POWER, 2.2 }, { GAMMA_POWER, .3 }, { GAMMA_POWER, 5 },
        { GAMMA_SRGB, 0 }, { GAMMA_NONE, 0 },
    };
    TestRandom r = test_random(1);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        FilmCurve c = film_curve(kinds[k].gamma, kinds[k].power, 255);
        FilmCurve deep = film_curve(kinds[k].gamma, kinds[k].power, 65535);
        for (int i = 1; i < 256; i++) {
            float up = c.step[i], down = up;
            for (int n = 0; n < 100; n++, up = nextafterf(up, 2), down = nextafterf(down, -1))
                check_curve(&c, up), check_curve(&c, down);
        }
        for (int i = 0; i < 100000; i++) check_curve(&c, pow(2, test_range(&r, -40, 2))), check_curve(&deep, test_unit(&r));
        static const double outside[] = { -1, -0., 0, NAN, 1, 1.5, INFINITY, -INFINITY, 0x1p-149, 0x1p-1074 };
        for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) check_curve(&c, outside[i]);
    }
}

/* One pixel through film_row with alpha. */
static void check_rgba(Pixel p, int max, const uint16_t expected[4])
{
    Film *f = film_new(1, 1);
    uint16_t got[4];
    FilmCurve curve = film_curve(GAMMA_POWER, 1, max);
    f->pixels[0] = film_pixel(p);
    assert_int_equal(film_row(f, 0, &curve, true, got), 4);
    for (int i = 0; i < 4; i++)
        CHECK(got[i] == expected[i], "transmit %g, channel %d: %d, not %d", p.transmit, i, got[i], expected[i]);
    film_free(f);
}

/* Measured with +UA: a plane with ambient 1 and the pigments rgbt <.5,.3,.1,.6>, rgbf <.5,.3,.1,.6>, rgbt <2,.3,.1,.9>. */
static void alpha_is_povrays(void **state)
{
    (void)state;
    check_rgba((Pixel){ .2, .12, .04, .6 }, 255, (uint16_t[]){ 188, 149, 89, 102 });
    check_rgba((Pixel){ .2, .12, .04, .6 }, 65535, (uint16_t[]){ 48192, 38261, 22884, 26214 });
    check_rgba((Pixel){ .2, .12, .04, .20196 }, 255, (uint16_t[]){ 137, 108, 63, 204 });
    check_rgba((Pixel){ .2, .03, .01, .9 }, 255, (uint16_t[]){ 255, 149, 89, 26 });
    check_rgba((Pixel){ 0, 0, 0, 1 }, 65535, (uint16_t[]){ 0, 0, 0, 0 });
}

static void a_highlight_on_nothing_is_opaque_as_far_as_it_is_bright(void **state)
{
    (void)state;
    check_rgba((Pixel){ .5, .5, .5, 1 }, 255, (uint16_t[]){ 255, 255, 255, 128 });
    check_rgba((Pixel){ 3, 3, 3, 1 }, 255, (uint16_t[]){ 255, 255, 255, 255 });
}

static void a_new_film_is_black_and_opaque(void **state)
{
    (void)state;
    Film *f = film_new(3, 2);
    FilmCurve curve = film_curve(GAMMA_POWER, 1, 255);
    uint16_t row[12];
    assert_int_equal(film_row(f, 1, &curve, false, row), 9);
    assert_int_equal(film_row(f, 1, &curve, true, row), 12);
    for (int i = 0; i < 12; i++) CHECK(row[i] == (i % 4 == 3 ? 255 : 0), "sample %d", i);
    film_free(f);
    film_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_colors_become_the_integers_of_povray),
        cmocka_unit_test(without_gamma_values_are_only_scaled),
        cmocka_unit_test(what_is_outside_is_clipped),
        cmocka_unit_test(the_curve_rises_and_the_working_space_is_undone),
        cmocka_unit_test(the_srgb_curve_is_its_definition),
        cmocka_unit_test(a_curve_of_steps_is_the_curve),
        cmocka_unit_test(alpha_is_povrays),
        cmocka_unit_test(a_highlight_on_nothing_is_opaque_as_far_as_it_is_bright),
        cmocka_unit_test(a_new_film_is_black_and_opaque),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
