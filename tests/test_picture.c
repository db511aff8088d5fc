/* Pictures made of tiles: the same file in whatever order, size and threads they come. The truth is the film. */
#include "render/image.h"
#include "render/picture.h"
#include "tests/test.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 150, HEIGHT = 110 };     /* more than three bands, and no multiple of one */

static char path[64], whole[64];

static int name_files(void **state)
{
    (void)state;
    snprintf(path, sizeof path, "/tmp/trimray-picture-%d.png", (int)getpid());
    snprintf(whole, sizeof whole, "/tmp/trimray-picture-whole-%d.png", (int)getpid());
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    unlink(path);
    unlink(whole);
    return 0;
}

static Film *random_film(unsigned seed)
{
    TestRandom r = test_random(seed);
    Film *f = film_new(WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        f->pixels[i] = film_pixel((Pixel){ test_unit(&r), test_unit(&r), test_unit(&r), i % 5 == 0 ? .25 : 0 });
    return f;
}

static PictureFormat format_of(int bits, bool alpha)
{
    return (PictureFormat){ WIDTH, HEIGHT, 0, 0, WIDTH, HEIGHT, GAMMA_POWER, 1, bits, alpha };
}

static void add_part(Picture *p, const Film *f, int x0, int y0, int x1, int y1)
{
    FilmPixel pixels[WIDTH * HEIGHT];
    int n = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) pixels[n++] = f->pixels[y * WIDTH + x];
    picture_add(p, x0, y0, x1, y1, pixels);
}

typedef struct { int x0, y0, x1, y1; } Tile;

static int lesser(int a, int b) { return a < b ? a : b; }

/* The part `of`, cut into tiles of `size`. */
static int cut(Tile of, int size, Tile *out)
{
    int n = 0;
    for (int y = of.y0; y < of.y1; y += size)
        for (int x = of.x0; x < of.x1; x += size)
            out[n++] = (Tile){ x, y, lesser(x + size, of.x1), lesser(y + size, of.y1) };
    return n;
}

static void shuffle(TestRandom *r, Tile *tiles, int n)
{
    for (int i = n - 1; i > 0; i--) {
        int k = (int)(test_unit(r) * (i + 1));
        Tile t = tiles[i];
        tiles[i] = tiles[k], tiles[k] = t;
    }
}

static void check_same_file(const char *what)
{
    Arena *a = arena_new();
    const char *error = NULL;
    Image *x = image_read_png(a, path, &error), *y = image_read_png(a, whole, &error);
    CHECK(x && y, "%s: %s", what, error);
    CHECK(x->width == y->width && x->height == y->height && x->bits == y->bits && x->has_alpha == y->has_alpha, "%s", what);
    CHECK(memcmp(x->rgba, y->rgba, (size_t)WIDTH * HEIGHT * 4 * sizeof *x->rgba) == 0, "%s", what);
    arena_free(a);
}

static void tiles_in_any_order_make_the_same_picture(void **state)
{
    (void)state;
    static Tile tiles[WIDTH * HEIGHT];
    for (unsigned seed = 0; seed < 24; seed++) {
        TestRandom r = test_random(seed);
        bool alpha = seed & 1;
        int bits = seed & 2 ? 16 : 8;
        PictureFormat format = format_of(bits, alpha);
        Film *f = random_film(seed);
        Picture *p = picture_new(&format);
        int n = cut((Tile){ 0, 0, WIDTH, HEIGHT }, 4 + (int)(test_unit(&r) * 60), tiles);
        shuffle(&r, tiles, n);
        for (int i = 0; i < n; i++) add_part(p, f, tiles[i].x0, tiles[i].y0, tiles[i].x1, tiles[i].y1);
        assert_null(picture_write(p, path));
        assert_null(image_write_png(whole, f, GAMMA_POWER, 1, bits, alpha));
        check_same_file("a shuffled picture");
        picture_free(p);
        film_free(f);
    }
}

static void what_is_not_given_is_black_and_opaque(void **state)
{
    (void)state;
    static Tile tiles[WIDTH * HEIGHT];
    for (unsigned seed = 0; seed < 24; seed++) {
        TestRandom r = test_random(seed);
        Tile part = { (int)(test_unit(&r) * 70), (int)(test_unit(&r) * 50), 71 + (int)(test_unit(&r) * 79),
                      51 + (int)(test_unit(&r) * 59) };
        PictureFormat format = format_of(8, seed & 1);
        format.x0 = part.x0, format.y0 = part.y0, format.x1 = part.x1, format.y1 = part.y1;
        Film *f = random_film(seed), *truth = film_new(WIDTH, HEIGHT);
        Picture *p = picture_new(&format);
        int n = cut(part, 16, tiles), n_given = seed & 2 ? n : n / 2;   /* interrupted after some */
        shuffle(&r, tiles, n);
        for (int i = 0; i < n_given; i++) {
            Tile t = tiles[i];
            add_part(p, f, t.x0, t.y0, t.x1, t.y1);
            for (int y = t.y0; y < t.y1; y++)
                film_set(truth, t.x0, y, t.x1, y + 1, f->pixels + y * WIDTH + t.x0);
        }
        assert_null(picture_write(p, path));
        assert_null(image_write_png(whole, truth, GAMMA_POWER, 1, 8, seed & 1));
        check_same_file("a part of a picture");
        picture_free(p);
        film_free(f);
        film_free(truth);
    }
}

typedef struct { Picture *picture; const Film *film; const Tile *tiles; int n; atomic_int *next; } Share;

static void *add_tiles(void *context)
{
    const Share *s = context;
    for (int i; (i = atomic_fetch_add(s->next, 1)) < s->n;)
        add_part(s->picture, s->film, s->tiles[i].x0, s->tiles[i].y0, s->tiles[i].x1, s->tiles[i].y1);
    return NULL;
}

static void threads_may_share_the_work(void **state)
{
    (void)state;
    static Tile tiles[WIDTH * HEIGHT];
    enum { N_THREADS = 4 };
    for (unsigned seed = 0; seed < 10; seed++) {
        PictureFormat format = format_of(8, false);
        Film *f = random_film(seed);
        atomic_int next = 0;
        Share share = { picture_new(&format), f, tiles, cut((Tile){ 0, 0, WIDTH, HEIGHT }, 7, tiles), &next };
        pthread_t threads[N_THREADS];
        for (int i = 0; i < N_THREADS; i++) assert_int_equal(pthread_create(&threads[i], NULL, add_tiles, &share), 0);
        for (int i = 0; i < N_THREADS; i++) pthread_join(threads[i], NULL);
        assert_null(picture_write(share.picture, path));
        assert_null(image_write_png(whole, f, GAMMA_POWER, 1, 8, false));
        check_same_file("a picture of four threads");
        picture_free(share.picture);
        film_free(f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(tiles_in_any_order_make_the_same_picture, name_files, remove_files),
        cmocka_unit_test_setup_teardown(what_is_not_given_is_black_and_opaque, name_files, remove_files),
        cmocka_unit_test_setup_teardown(threads_may_share_the_work, name_files, remove_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
