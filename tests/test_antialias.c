/* Antialiasing: the values that POV-Ray 3.7.0.10 gives to a pixel with an edge in it, the numbers of samples that its rules
 * ask for, and that a picture depends on nothing but the scene and the blocks. */
#include "tests/test.h"

#include "render/antialias.h"
#include "render/render.h"

static Arena *arena;

typedef struct { double edge_x, edge_y; size_t n_samples; double x[4096], y[4096]; } Picture;

/* White left of and above the edges, else black; remembers where it was asked. */
static void corner_of_white(void *context, const Vec2 at[], int n, Pixel out[])
{
    Picture *p = context;
    for (int i = 0; i < n; i++) {
        p->x[p->n_samples % 4096] = at[i].x, p->y[p->n_samples % 4096] = at[i].y;
        p->n_samples++;
        double c = at[i].x < p->edge_x && at[i].y < p->edge_y;
        out[i] = (Pixel){ c, c, c, 0 };
    }
}

static Antialias method(int m, int depth)
{
    Antialias a = antialias_default();
    a.method = m, a.depth = depth;
    return a;
}

/* An edge .2 right of the middle of the centre pixel of 3 x 3, measured with POV-Ray: +A0.3 -J. */
static void an_edge_in_a_pixel_gives_povrays_values(void **state)
{
    (void)state;
    static const struct { int method, depth; double value; } measured[] = {
        { 0, 3, 1 }, { 1, 2, .6 }, { 1, 3, .7 }, { 1, 4, 13. / 17 }, { 2, 1, .5 }, { 2, 2, .75 }, { 2, 3, .625 },
    };
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        Picture p = { .edge_x = 1.2, .edge_y = INFINITY };
        Pixel out[9];
        Antialias a = method(measured[i].method, measured[i].depth);
        antialias_block(&a, 0, 0, 3, 3, corner_of_white, &p, arena, out, 3);
        CHECK_WITHIN(fabs(out[4].r - measured[i].value), 1e-15, "method %d, depth %d", a.method, a.depth);
    }
}

/* Method 1 looks at a border above and on the left; method 2 at all corners. */
static void an_even_picture_costs_no_more_than_a_look(void **state)
{
    (void)state;
    static const size_t expected[3] = { 7 * 5, 7 + 5 + 7 * 5, 8 * 6 };
    for (int m = 0; m <= 2; m++) {
        Picture p = { .edge_x = INFINITY, .edge_y = INFINITY };
        Pixel out[7 * 5];
        Antialias a = method(m, 4);
        antialias_block(&a, 10, 20, 17, 25, corner_of_white, &p, arena, out, 7);
        CHECK(p.n_samples == expected[m], "method %d: %zu samples", m, p.n_samples);
        for (int i = 0; i < 7 * 5; i++) assert_true(out[i].r == 1 && out[i].transmit == 0);
    }
}

/* A vertical edge between the columns 3 and 4: method 1 refines both, 16 samples each. */
static void both_sides_of_an_edge_are_refined_once(void **state)
{
    (void)state;
    Picture p = { .edge_x = 3.5, .edge_y = INFINITY };
    Pixel out[8 * 8];
    Antialias a = method(1, 4);
    antialias_block(&a, 0, 0, 8, 8, corner_of_white, &p, arena, out, 8);
    assert_int_equal(p.n_samples, 8 + 8 + 64 + 2 * 8 * 16);
    for (int i = 0; i < 64; i++) assert_true(out[i].r == (i % 8 < 4));
}

/* Where the edge is the border of two blocks, only the block on the right refines: POV-Ray's pictures show it. */
static void the_border_of_a_block_is_not_refined(void **state)
{
    (void)state;
    Picture p = { .edge_x = 3.6, .edge_y = INFINITY };
    Pixel whole[64], halves[64];
    Antialias a = method(1, 3);
    antialias_block(&a, 0, 0, 8, 8, corner_of_white, &p, arena, whole, 8);
    antialias_block(&a, 0, 0, 4, 8, corner_of_white, &p, arena, halves, 8);
    antialias_block(&a, 4, 0, 8, 8, corner_of_white, &p, arena, halves + 4, 8);
    for (int i = 0; i < 64; i++) assert_true(whole[i].r == halves[i].r);
    p.edge_x = 3.3;                                     /* now a part of column 3 is black */
    antialias_block(&a, 0, 0, 8, 8, corner_of_white, &p, arena, whole, 8);
    antialias_block(&a, 0, 0, 4, 8, corner_of_white, &p, arena, halves, 8);
    antialias_block(&a, 4, 0, 8, 8, corner_of_white, &p, arena, halves + 4, 8);
    assert_true(fabs(whole[3].r - .7) < 1e-15 && halves[3].r == 1);
}

/* Of a step from black to g the eye sees g^(1/2.5): refined from the threshold of .3 on; with gamma 1 from .3 itself. */
typedef struct { double value; size_t n_samples; } Step;

static void step(void *context, const Vec2 at[], int n, Pixel out[])
{
    Step *s = context;
    for (int i = 0; i < n; i++) out[i] = (Pixel){ at[i].x < 0 ? 0 : s->value, 0, 0, 0 };
    s->n_samples += (size_t)n;
}

static void colours_are_compared_as_they_look(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        Antialias a = method(1, 2);
        a.gamma = i < 2 ? 2.5 : 1;
        Step s = { pow(.3, a.gamma) * (i % 2 ? 1.0001 : .9999), 0 };
        Pixel out[4];
        antialias_block(&a, -2, 0, 2, 1, step, &s, arena, out, 4);
        size_t expected = 4 + 1 + 4 + (i % 2 ? 2 * 4 : 0);
        CHECK(s.n_samples == expected, "gamma %g, step %g: %zu samples", a.gamma, s.value, s.n_samples);
    }
}

/* Each sample stays within half its distance from its neighbours, and is at the same place each time. */
static void jitter_stays_near_and_repeats(void **state)
{
    (void)state;
    static Picture p, again;
    Pixel out[16];
    Antialias a = method(1, 3);
    a.jitter = 1, a.threshold = 0;
    p = again = (Picture){ .edge_x = 1.2, .edge_y = 1.7 };
    antialias_block(&a, 0, 0, 4, 4, corner_of_white, &p, arena, out, 4);
    antialias_block(&a, 0, 0, 4, 4, corner_of_white, &again, arena, out, 4);
    assert_true(p.n_samples == again.n_samples && p.n_samples == 4 + 4 + 16 + 16 * 9);
    double farthest = 0;
    for (size_t i = 0; i < p.n_samples; i++) {
        assert_true(p.x[i] == again.x[i] && p.y[i] == again.y[i]);
        double x = p.x[i] * 3, y = p.y[i] * 3;         /* the grid of samples, middles of pixels included, is the integers */
        farthest = fmax(farthest, fmax(fabs(x - floor(x + .5)), fabs(y - floor(y + .5))));
    }
    CHECK(farthest > .4 && farthest <= .5, "%g", farthest);
}

/* ---- whole pictures ---- */

static Scene *sphere_scene(void)
{
    Scene *s = scene_new(arena);
    Texture *t = ARENA_NEW(arena, Texture);
    Layer *layer = ARENA_NEW(arena, Layer);
    Pigment *pigment = ARENA_NEW(arena, Pigment);
    *pigment = pigment_solid((Color){ 1, .5, .2, 0, 0 });
    *layer = (Layer){ .pigment = pigment, .finish = finish_default() };
    layer->finish.ambient = rgb(1, 1, 1);
    *t = (Texture){ .layers = layer, .n_layers = 1 };
    Object *o = object_new(arena, sphere_new(arena, vec(0, 0, 4), 1));
    o->texture = t;
    scene_add_object(s, o);
    return s;
}

static void threads_do_not_show(void **state)
{
    (void)state;
    Scene *s = sphere_scene();
    for (int m = 1; m <= 2; m++) {
        Film *one = film_new(70, 50), *four = film_new(70, 50);
        RenderOptions o = render_options_default(70, 50);
        o.antialias = method(m, 3);
        o.antialias.jitter = 1;
        o.block_size = 16;
        o.n_threads = 1;
        render_scene(s, &o, one);
        o.n_threads = 4;
        render_scene(s, &o, four);
        size_t n_between = 0;
        for (int i = 0; i < 70 * 50; i++) {
            assert_true(one->pixels[i].r == four->pixels[i].r);
            n_between += one->pixels[i].r > 0 && one->pixels[i].r < 1;
        }
        CHECK(n_between > 50, "method %d: %zu pixels of the outline are between the colours", m, n_between);
        film_free(one);
        film_free(four);
    }
    scene_release(s);
}

static int set_up(void **state)
{
    (void)state;
    arena = arena_new();
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    arena_free(arena);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_edge_in_a_pixel_gives_povrays_values),
        cmocka_unit_test(an_even_picture_costs_no_more_than_a_look),
        cmocka_unit_test(both_sides_of_an_edge_are_refined_once),
        cmocka_unit_test(the_border_of_a_block_is_not_refined),
        cmocka_unit_test(colours_are_compared_as_they_look),
        cmocka_unit_test(jitter_stays_near_and_repeats),
        cmocka_unit_test(threads_do_not_show),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
