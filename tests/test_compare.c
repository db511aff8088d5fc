/* How two pictures differ. Truths: pictures whose numbers are known by closed forms. */
#include "tests/test.h"

#include "render/compare.h"

static Image *picture(Arena *a, int width, int height, uint16_t value)
{
    Image *p = ARENA_NEW(a, Image);
    *p = (Image){ .width = width, .height = height, .bits = 16 };
    p->rgba = ARENA_ARRAY(a, uint16_t, 4 * width * height);
    for (int i = 0; i < 4 * width * height; i++) p->rgba[i] = i % 4 == 3 ? 65535 : value;
    return p;
}

static void set_channel(Image *p, int x, int y, int channel, uint16_t value)
{
    p->rgba[4 * (y * p->width + x) + channel] = value;
}

static void a_picture_is_like_itself(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Image *p = picture(a, 37, 23, 0);
    TestRandom r = test_random(1);
    for (int i = 0; i < 4 * 37 * 23; i++) p->rgba[i] = (uint16_t)test_int(&r, 0, 65535);
    Comparison c = compare_images(a, p, p, 0);
    assert_true(c.rmse == 0 && isinf(c.psnr) && c.largest == 0);
    assert_true(c.n_over == 0 && c.n_beyond == 0 && c.n_pixels == 37 * 23);
    CHECK_WITHIN(fabs(c.ssim - 1), 1e-12, "ssim");
    arena_free(a);
}

/* Two constants: RMSE is their difference, SSIM (2ab + C1) / (a^2 + b^2 + C1) with C1 = 0.01^2. */
static void constant_pictures_have_their_closed_form(void **state)
{
    (void)state;
    Arena *a = arena_new();
    double x = 13107 / 65535., y = 39321 / 65535.;   /* .2 and .6 */
    Comparison c = compare_images(a, picture(a, 20, 20, 13107), picture(a, 20, 20, 39321), 1);
    CHECK_WITHIN(fabs(c.rmse - .4), 1e-12, "rmse");
    CHECK_WITHIN(fabs(c.psnr + 20 * log10(.4)), 1e-9, "psnr");
    CHECK_WITHIN(fabs(c.largest - .4), 1e-12, "largest");
    CHECK_WITHIN(fabs(c.ssim - (2 * x * y + 1e-4) / (x * x + y * y + 1e-4)), 1e-9, "ssim %.12g", c.ssim);
    assert_int_equal(c.n_over, 400);
    arena_free(a);
}

/* 257 of 65535 is 1/255, and not over it. */
static void the_limit_itself_is_within(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Image *p = picture(a, 8, 4, 1000), *q = picture(a, 8, 4, 1000);
    set_channel(q, 1, 0, 0, 1257);
    set_channel(q, 2, 1, 1, 1258);
    set_channel(q, 7, 3, 2, 2028);   /* 4 steps */
    Comparison c = compare_images(a, p, q, 4), strict = compare_images(a, p, q, 3.99), none = compare_images(a, p, q, 0);
    assert_int_equal(c.n_over, 2);
    assert_int_equal(c.n_beyond, 0);
    assert_int_equal(strict.n_beyond, 1);
    assert_int_equal(none.n_beyond, 3);
    assert_true(c.largest_x == 7 && c.largest_y == 3);
    CHECK_WITHIN(fabs(c.largest * 255 - 4), 1e-12, "largest");
    CHECK_WITHIN(fabs(c.rmse * 65535 - sqrt((257. * 257 + 258 * 258 + 1028 * 1028) / (8 * 4 * 3))), 1e-9, "rmse");
    arena_free(a);
}

static void alpha_counts_where_there_is_one(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Image *p = picture(a, 4, 4, 500), *q = picture(a, 4, 4, 500);
    set_channel(q, 0, 0, 3, 0);
    assert_int_equal(compare_images(a, p, q, 1).n_over, 0);
    q->has_alpha = true;
    assert_int_equal(compare_images(a, p, q, 1).n_over, 1);
    arena_free(a);
}

/* Noise of the same size hurts a flat picture's structure more than a lively one's. */
static void similarity_sees_structure(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Image *flat = picture(a, 64, 64, 30000), *flat_noise = picture(a, 64, 64, 30000);
    Image *lively = picture(a, 64, 64, 0), *lively_noise = picture(a, 64, 64, 0);
    TestRandom r = test_random(2);
    for (int i = 0; i < 4 * 64 * 64; i += 4) {
        int wave = (int)(30000 + 20000 * sin(i / 4 % 64 * .7) * cos(i / 256 * .5)), noise = test_int(&r, -2000, 2000);
        for (int c = 0; c < 3; c++) {
            flat_noise->rgba[i + c] = (uint16_t)(30000 + noise);
            lively->rgba[i + c] = (uint16_t)wave, lively_noise->rgba[i + c] = (uint16_t)(wave + noise);
        }
    }
    Comparison on_flat = compare_images(a, flat, flat_noise, 1), on_lively = compare_images(a, lively, lively_noise, 1);
    CHECK_WITHIN(fabs(on_flat.rmse - on_lively.rmse), 1e-12, "rmse");
    CHECK(on_flat.ssim < .8 && on_lively.ssim > .97, "%g %g", on_flat.ssim, on_lively.ssim);
    arena_free(a);
}

/* Grey where nothing differs, blue within the limit, yellow to red to white beyond. */
static void the_picture_of_differences_can_be_read(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Image *p = picture(a, 4, 1, 20000), *q = picture(a, 4, 1, 20000);
    set_channel(q, 1, 0, 0, 20000 + 200);
    set_channel(q, 2, 0, 0, 20000 + 2 * 257);
    set_channel(q, 3, 0, 0, 20000 + 170 * 257);
    Film *f = compare_picture(p, q, 1);
    const FilmPixel *x = f->pixels;
    assert_true(x[0].r == x[0].g && x[0].g == x[0].b && x[0].r < .3);
    assert_true(x[1].b > x[1].r && x[1].b > x[1].g);
    assert_true(x[2].r > .9 && x[2].g > .4 && x[2].b < .1);
    assert_true(x[3].r > .9 && x[3].g > .9 && x[3].b > .9);
    film_free(f);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_is_like_itself),
        cmocka_unit_test(constant_pictures_have_their_closed_form),
        cmocka_unit_test(the_limit_itself_is_within),
        cmocka_unit_test(alpha_counts_where_there_is_one),
        cmocka_unit_test(similarity_sees_structure),
        cmocka_unit_test(the_picture_of_differences_can_be_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
