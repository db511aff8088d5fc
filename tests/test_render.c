/* Tiles and threads: the same bytes however many there are, parts, interruption, progress. */
#include "render/render.h"
#include "tests/shade_scene.h"

#include <string.h>

enum { WIDTH = 100, HEIGHT = 70 };   /* not multiples of a tile */

/* A swarm of balls in a space of its own, with a tree. */
static void add_swarm(Scene *s)
{
    enum { N = 90 };
    Shape *balls[N];
    TestRandom r = test_random(7);
    for (int i = 0; i < N; i++) {
        double x = test_range(&r, -6, 6), y = test_range(&r, -4, 4);
        balls[i] = sphere_new(s->arena, vec(x, y, test_range(&r, -2, 2)), .4);
    }
    Object *o = add_shape(s, union_new(s->arena, balls, N), brown, finish_default());
    Xform turn = xform_rotate(vec(20, -30, 40)), size = xform_scale(vec(.1, .2, .15));
    Xform by = xform_translate(vec(-.4, .3, -1.2));
    object_transform(o, &turn);
    object_transform(o, &size);
    object_transform(o, &by);
}

/* Light, shadow, a mirror and glass: something of every kind of ray. */
static Scene *varied_scene(Arena *a)
{
    Scene *s = new_scene(a);
    add_background(s);
    add_light(s, LIGHT_POINT);
    add_sphere(s, brown, mirror(.3, .3));
    Shape *ball = sphere_new(a, vec(.8, .2, -1), .5);
    add_shape(s, ball, (Color){ 1, 1, 1, .9f, 0 }, mirror(.1, .1))->interior = new_interior(s, 1.5);
    add_checkered_wall(s);
    add_swarm(s);
    return s;
}

static RenderResult render(Scene *s, const RenderOptions *o, Film **film)
{
    *film = film_new(o->width, o->height);
    return render_scene(s, o, *film);
}

static void any_number_of_threads_gives_the_same_bytes(void **state)
{
    (void)state;
    static const int threads[] = { 1, 2, 5 };
    Film *films[3];
    Counters counters[3];
    for (int i = 0; i < 3; i++) {
        Arena *a = arena_new();
        Scene *s = varied_scene(a);
        RenderOptions o = render_options_default(WIDTH, HEIGHT);
        o.n_threads = threads[i];
        RenderResult r = render(s, &o, &films[i]);
        counters[i] = r.counters;
        CHECK(r.n_threads == threads[i] && !r.interrupted, "%d threads", r.n_threads);
        scene_release(s);
        arena_free(a);
    }
    for (int i = 1; i < 3; i++) {
        CHECK(memcmp(films[0]->pixels, films[i]->pixels, WIDTH * HEIGHT * sizeof(FilmPixel)) == 0, "%d threads", threads[i]);
        CHECK(counters[i].shadow_rays == counters[0].shadow_rays && counters[i].reflected_rays == counters[0].reflected_rays
              && counters[i].transmitted_rays == counters[0].transmitted_rays, "the counters of %d threads", threads[i]);
    }
    CHECK(counters[0].camera_rays == WIDTH * HEIGHT, "camera rays");
    CHECK(counters[0].shadow_rays > 0 && counters[0].transmitted_rays > 0, "other rays");
    for (int i = 0; i < 3; i++) film_free(films[i]);
}

/* Of one scene: where its trees lie in memory says which of them share a place among the blockers (blocker.h). */
static void any_number_of_threads_counts_the_same_boxes(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = varied_scene(a);
    Counters first = { 0 };
    for (int n = 1; n <= 5; n++) {
        RenderOptions o = render_options_default(WIDTH, HEIGHT);
        Film *film;
        o.n_threads = n;
        Counters c = render(s, &o, &film).counters;
        if (n == 1) first = c;
        CHECK(c.bv_intersections == first.bv_intersections, "%d threads", n);
        CHECK(c.light_bv_intersections == first.light_bv_intersections, "of shadow rays, %d threads", n);
        film_free(film);
    }
    scene_release(s);
    arena_free(a);
}

static void every_pixel_is_what_its_ray_sees(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = varied_scene(a);
    RenderOptions o = render_options_default(WIDTH, WIDTH);
    Film *film;
    render(s, &o, &film);
    for (int i = 0; i < WIDTH * WIDTH; i += 7) {
        FilmPixel p = film_pixel(pixel_at(s, i % WIDTH, i / WIDTH, WIDTH, 9, NULL));
        CHECK(memcmp(&p, &film->pixels[i], sizeof p) == 0, "pixel %d", i);
    }
    film_free(film);
    scene_release(s);
    arena_free(a);
}

static void a_part_is_that_part_of_the_whole(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = varied_scene(a);
    RenderOptions o = render_options_default(WIDTH, HEIGHT);
    Film *whole, *part;
    render(s, &o, &whole);
    o.x0 = 13, o.x1 = 58, o.y0 = 20, o.y1 = 21;
    RenderResult r = render(s, &o, &part);
    static const FilmPixel untouched;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH, y = i / WIDTH;
        const FilmPixel *truth = x >= 13 && x < 58 && y == 20 ? &whole->pixels[i] : &untouched;
        CHECK(memcmp(&part->pixels[i], truth, sizeof *truth) == 0, "pixel %d, %d", x, y);
    }
    CHECK(r.counters.camera_rays == 45 && !r.interrupted, "%d rays", (int)r.counters.camera_rays);
    film_free(whole);
    film_free(part);
    scene_release(s);
    arena_free(a);
}

/* A pattern that calls for an end, as a signal would, the first time that it is looked at. */
static double interrupting_value(const Pattern *p, Vec3 q)
{
    (void)p, (void)q;
    render_interrupt();
    return 1;
}
static const PatternType interrupting = { .name = "interrupting", .value = interrupting_value };

static void an_interrupted_render_keeps_what_is_finished(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    Object *o = add_shape(s, plane_new(a, vec(0, 0, 1), 0), white, finish_default());
    Pigment p = pigment_solid(white);
    p.kind = PIGMENT_MAP, p.pattern = pattern_make(&interrupting);
    o->texture = new_texture(a, &p, glowing(1));
    RenderOptions options = render_options_default(WIDTH, HEIGHT);
    options.n_threads = 1;
    Film *film;
    RenderResult r = render(s, &options, &film);
    assert_true(r.interrupted);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double expected = i % WIDTH < 32 && i / WIDTH < 32;   /* one tile, whole */
        CHECK(film->pixels[i].r == expected, "pixel %d, %d", i % WIDTH, i / WIDTH);
    }
    film_free(film);
    scene_release(s);
    arena_free(a);
}

static void an_interrupt_before_the_start_counts_and_is_over_afterwards(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = varied_scene(a);
    RenderOptions o = render_options_default(WIDTH, HEIGHT);
    Film *first, *second;
    render_interrupt();
    RenderResult r = render(s, &o, &first);
    CHECK(r.interrupted && r.counters.camera_rays == 0, "nothing is begun");
    r = render(s, &o, &second);
    CHECK(!r.interrupted && r.counters.camera_rays == WIDTH * HEIGHT, "the next is whole");
    film_free(first);
    film_free(second);
    scene_release(s);
    arena_free(a);
}

static void progress_is_shown_on_one_line_up_to_the_end(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = varied_scene(a);
    RenderOptions o = render_options_default(WIDTH, HEIGHT);
    char *text;
    size_t n;
    o.progress = open_memstream(&text, &n);
    Film *film;
    RenderResult r = render(s, &o, &film);
    fclose(o.progress);
    int lines = 0;
    for (size_t i = 0; i < n; i++) lines += text[i] == '\r';
    CHECK(n > 5 && text[0] == '\r' && strcmp(text + n - 5, "100%\n") == 0 && strchr(text, '\n') == text + n - 1, "%s", text);
    CHECK(lines <= 3 + r.trace_seconds * 10, "%d times in %g s", lines, r.trace_seconds);
    free(text);
    film_free(film);
    scene_release(s);
    arena_free(a);
}

static void an_empty_scene_is_its_background(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Scene *s = new_scene(a);
    RenderOptions o = render_options_default(3, 2);
    Film *film;
    RenderResult r = render(s, &o, &film);
    CHECK(r.n_threads == 1, "no more threads than tiles: %d", r.n_threads);
    for (int i = 0; i < 6; i++) {
        CHECK(film->pixels[i].r == 0, "pixel %d", i);
        CHECK_WITHIN(fabs(film->pixels[i].transmit - 1), 1e-15, "pixel %d: the three weights of grey are rounded", i);
    }
    film_free(film);
    scene_release(s);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_gives_the_same_bytes),
        cmocka_unit_test(any_number_of_threads_counts_the_same_boxes),
        cmocka_unit_test(every_pixel_is_what_its_ray_sees),
        cmocka_unit_test(a_part_is_that_part_of_the_whole),
        cmocka_unit_test(an_interrupted_render_keeps_what_is_finished),
        cmocka_unit_test(an_interrupt_before_the_start_counts_and_is_over_afterwards),
        cmocka_unit_test(progress_is_shown_on_one_line_up_to_the_end),
        cmocka_unit_test(an_empty_scene_is_its_background),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
