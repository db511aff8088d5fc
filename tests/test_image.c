/* PNG: what is written comes back, every kind of file is read, and a failure leaves nothing behind. */
#include "render/image.h"
#include "tests/test.h"

#include <dirent.h>
#include <png.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];
static char path[128];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/trimray-image-XXXXXX");
    if (!mkdtemp(folder)) return -1;
    snprintf(path, sizeof path, "%s/picture.png", folder);
    return 0;
}

static int files_in_folder(void)
{
    int n = 0;
    DIR *d = opendir(folder);
    for (struct dirent *e; (e = readdir(d));) n += e->d_name[0] != '.';
    closedir(d);
    return n;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    rmdir(path);
    return rmdir(folder);
}

static Film *random_film(unsigned seed, int width, int height)
{
    TestRandom r = test_random(seed);
    Film *f = film_new(width, height);
    for (int i = 0; i < width * height; i++)
        f->pixels[i] = film_pixel((Pixel){ test_unit(&r), test_unit(&r), test_unit(&r), i % 5 == 0 ? .25 : 0 });
    return f;
}

static void check_equal(const Film *f, const Image *image, int bits, bool alpha)
{
    FilmCurve curve = film_curve(GAMMA_POWER, 1, bits == 16 ? 65535 : 255);
    for (int y = 0; y < f->height; y++) {
        uint16_t row[4 * 64];
        int n = film_row(f, y, &curve, alpha, row), per_pixel = n / f->width;
        for (int i = 0; i < n; i++) {
            size_t at = ((size_t)y * (size_t)f->width + (size_t)(i / per_pixel)) * 4 + (size_t)(i % per_pixel);
            int expected = bits == 16 ? row[i] : row[i] * 257;
            CHECK(image->rgba[at] == expected, "%d bits, row %d, sample %d: %d", bits, y, i, image->rgba[at]);
        }
    }
}

static void what_is_written_comes_back(void **state)
{
    (void)state;
    static const int sizes[][2] = { { 1, 1 }, { 3, 5 }, { 64, 2 }, { 33, 40 } };
    for (unsigned i = 0; i < 16; i++) {
        int bits = i % 2 ? 16 : 8;
        bool alpha = i / 2 % 2;
        Film *f = random_film(i, sizes[i / 4][0], sizes[i / 4][1]);
        Arena *a = arena_new();
        const char *error = image_write_png(path, f, GAMMA_POWER, 1, bits, alpha);
        CHECK(!error, "%s", error);
        Image *image = image_read_png(a, path, &error);
        CHECK(image, "%s", error);
        CHECK(image->width == f->width && image->height == f->height && image->bits == bits, "case %u", i);
        CHECK(image->has_alpha == alpha && image->has_gamma && image->file_gamma == -1, "case %u", i);
        check_equal(f, image, bits, alpha);
        assert_int_equal(files_in_folder(), 1);
        arena_free(a);
        film_free(f);
    }
}

/* libpng's own simplified reader, as a second opinion on the file. */
static void another_reader_sees_the_same(void **state)
{
    (void)state;
    Film *f = random_film(7, 20, 10);
    assert_null(image_write_png(path, f, GAMMA_POWER, 1, 8, false));
    png_image reader = { .version = PNG_IMAGE_VERSION };
    png_byte pixels[20 * 10 * 3];
    assert_true(png_image_begin_read_from_file(&reader, path));
    reader.format = PNG_FORMAT_RGB;
    assert_true(png_image_finish_read(&reader, NULL, pixels, 0, NULL));
    for (int i = 0; i < 200; i++)
        CHECK(pixels[3 * i] == film_sample(f->pixels[i].r, GAMMA_POWER, 1, 255), "pixel %d", i);
    film_free(f);
}

static void the_file_says_its_gamma_as_povray_does(void **state)
{
    (void)state;
    Film *f = random_film(1, 2, 2);
    assert_null(image_write_png(path, f, GAMMA_NONE, 1, 8, false));
    FILE *file = fopen(path, "rb");
    unsigned char bytes[1024];
    size_t n = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    static const unsigned char gamma[] = { 'g', 'A', 'M', 'A', 0, 0, 0xB1, 0x8F }, srgb[] = { 's', 'R', 'G', 'B', 0 };
    assert_non_null(memmem(bytes, n, gamma, sizeof gamma));   /* 45455 */
    assert_non_null(memmem(bytes, n, srgb, sizeof srgb));
    film_free(f);
}

/* Writes `rows` (one byte a pixel or less) as they are. */
static void write_raw(int width, int height, int bits, int color_type, int interlace, unsigned char *const rows[],
                      bool clear)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE *file = fopen(path, "wb");
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, color_type, interlace, 0, 0);
    png_color palette[2] = { { 10, 20, 30 }, { 40, 50, 60 } };
    png_byte transparency[2] = { 255, 128 };
    if (color_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 2);
    if (clear) png_set_tRNS(png, info, transparency, 2, NULL);
    if (!clear) png_set_gAMA(png, info, .5);
    png_set_rows(png, info, (png_bytepp)rows);
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

static void check_pixel(const Image *image, int i, int r, int g, int b, int a)
{
    const uint16_t *s = image->rgba + 4 * i;
    CHECK(s[0] == r * 257 && s[1] == g * 257 && s[2] == b * 257 && s[3] == a * 257, "pixel %d: %d %d %d %d", i, s[0], s[1],
          s[2], s[3]);
}

static void every_kind_of_png_is_read(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const char *error = NULL;
    unsigned char bits1[] = { 0x40 }, grey[] = { 0, 100, 200 };   /* 0x40: pixels 0, 1 */
    write_raw(2, 1, 1, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, (unsigned char *[]){ bits1 }, true);
    Image *image = image_read_png(a, path, &error);
    CHECK(image, "%s", error);
    check_pixel(image, 0, 10, 20, 30, 255);
    check_pixel(image, 1, 40, 50, 60, 128);
    assert_true(image->has_alpha && !image->has_gamma);
    write_raw(3, 1, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_ADAM7, (unsigned char *[]){ grey }, false);
    image = image_read_png(a, path, &error);
    CHECK(image, "%s", error);
    for (int i = 0; i < 3; i++) check_pixel(image, i, 100 * i, 100 * i, 100 * i, 255);
    CHECK_WITHIN(fabs(image->file_gamma - .5), 1e-5, "gAMA");
    write_raw(2, 1, 1, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, (unsigned char *[]){ bits1 }, false);
    image = image_read_png(a, path, &error);
    CHECK(image, "%s", error);
    check_pixel(image, 0, 0, 0, 0, 255);
    check_pixel(image, 1, 255, 255, 255, 255);
    arena_free(a);
}

static void a_file_cut_short_anywhere_is_an_error(void **state)
{
    (void)state;
    Film *f = random_film(3, 16, 16);
    assert_null(image_write_png(path, f, GAMMA_POWER, 1, 8, false));
    film_free(f);
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    for (long n = s.st_size - 13; n >= 0; n -= 7) {   /* less than the last chunk is still a whole picture */
        assert_int_equal(truncate(path, n), 0);
        Arena *a = arena_new();
        const char *error = NULL;
        CHECK(!image_read_png(a, path, &error) && error && *error, "cut to %ld bytes", n);
        arena_free(a);
    }
}

static void a_missing_file_is_said(void **state)
{
    (void)state;
    const char *error = NULL;
    assert_null(image_read_png(NULL, "/nonexistent/picture.png", &error));
    assert_string_equal(error, "No such file or directory");
}

static void a_folder_that_is_not_there_is_said(void **state)
{
    (void)state;
    Film *f = random_film(3, 4, 4);
    assert_string_equal(image_write_png("/nonexistent/x.png", f, GAMMA_POWER, 1, 8, false), "No such file or directory");
    film_free(f);
}

static void a_failed_rename_leaves_nothing_behind(void **state)
{
    (void)state;
    Film *f = random_film(3, 4, 4);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_non_null(image_write_png(path, f, GAMMA_POWER, 1, 8, false));
    assert_int_equal(files_in_folder(), 1);
    film_free(f);
}

/* A full disk is imitated by a limit on the size of files. */
static void a_full_disk_leaves_the_old_picture_alone(void **state)
{
    (void)state;
    Film *small = random_film(3, 4, 4), *large = random_film(4, 64, 200);
    assert_null(image_write_png(path, small, GAMMA_POWER, 1, 8, false));
    struct stat before, after;
    assert_int_equal(stat(path, &before), 0);
    struct rlimit old, limit;
    getrlimit(RLIMIT_FSIZE, &old);
    limit = old, limit.rlim_cur = 5000;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    const char *error = image_write_png(path, large, GAMMA_POWER, 1, 16, false);
    setrlimit(RLIMIT_FSIZE, &old);
    signal(SIGXFSZ, handler);
    assert_string_equal(error, "File too large");
    assert_int_equal(files_in_folder(), 1);
    assert_int_equal(stat(path, &after), 0);
    assert_true(before.st_ino == after.st_ino && before.st_size == after.st_size);
    film_free(small);
    film_free(large);
}

static void a_device_is_written_in_place(void **state)
{
    (void)state;
    Film *f = random_film(3, 4, 4);
    assert_null(image_write_png("/dev/null", f, GAMMA_POWER, 1, 8, false));
    assert_string_equal(image_write_png("/dev/full", f, GAMMA_POWER, 1, 8, false), "No space left on device");
    struct stat s;
    assert_int_equal(stat("/dev/null", &s), 0);
    assert_true(S_ISCHR(s.st_mode));
    film_free(f);
}

static void a_new_picture_has_the_usual_mode(void **state)
{
    (void)state;
    Film *f = random_film(3, 4, 4);
    mode_t old = umask(027);
    assert_null(image_write_png(path, f, GAMMA_POWER, 1, 8, false));
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    assert_int_equal(s.st_mode & 0777, 0640);
    umask(old);
    film_free(f);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(what_is_written_comes_back),
        IN_FOLDER(another_reader_sees_the_same),
        IN_FOLDER(the_file_says_its_gamma_as_povray_does),
        IN_FOLDER(every_kind_of_png_is_read),
        IN_FOLDER(a_file_cut_short_anywhere_is_an_error),
        cmocka_unit_test(a_missing_file_is_said),
        cmocka_unit_test(a_folder_that_is_not_there_is_said),
        IN_FOLDER(a_failed_rename_leaves_nothing_behind),
        IN_FOLDER(a_full_disk_leaves_the_old_picture_alone),
        IN_FOLDER(a_new_picture_has_the_usual_mode),
        cmocka_unit_test(a_device_is_written_in_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
