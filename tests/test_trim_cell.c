/* Cells against the whole tree: they must say the same everywhere in their rectangle. */
#include "tests/test.h"

#include "nurbs/trim_cell.h"
#include "tests/trims.h"

/* Discs, rings and rectangles on a lattice, with circles in circles: every kind of list. */
static TrimTree *random_tree(Arena *a, TestRandom *r, int n_side, bool is_clockwise)
{
    TrimLoopDesc *loops = ARENA_ARRAY(a, TrimLoopDesc, 3 * n_side * n_side);
    int n = 0;
    for (int i = 0; i < n_side * n_side; i++) {
        Vec2 centre = vec2((i % n_side + .5) / n_side, (i / n_side + .5) / n_side);
        double radius = test_range(r, .3, .49) / n_side, turn = test_range(r, 0, 7);
        if (test_int(r, 0, 3) == 0) {
            loops[n++] = rectangle(a, centre.x - radius, centre.x + radius, centre.y - radius, centre.y + radius,
                                   is_clockwise);
        } else {
            loops[n++] = turned_circle(a, centre, radius, turn, is_clockwise);
        }
        for (int depth = 1; depth < 3 && test_int(r, 0, 1); depth++) {
            radius *= test_range(r, .3, .7);
            loops[n++] = turned_circle(a, centre, radius, turn, is_clockwise != (depth % 2 == 1));
        }
    }
    Made m = make_of(a, loops, n);
    CHECK(m.tree, "code %d", m.error.code);
    return m.tree;
}

static void agree_in(Arena *a, const TrimTree *t, TrimRect rect, TestRandom *r, int count[3], unsigned seed)
{
    Arena *scratch = arena_new();
    const TrimCell *cell;
    TrimClass class = trim_cell_new(a, scratch, t, rect, &cell);
    count[class]++;
    CHECK((class == TRIM_MIXED) == (cell != NULL), "seed %u", seed);
    for (int i = 0; i < 40; i++) {
        double u = i % 8 ? test_range(r, rect.u0, rect.u1) : i % 16 ? rect.u0 : rect.u1;
        double v = i % 5 ? test_range(r, rect.v0, rect.v1) : i % 10 ? rect.v0 : rect.v1;
        bool keeps = cell ? trim_cell_keeps(cell, u, v) : class == TRIM_KEPT;
        CHECK(keeps == trim_keeps(t, u, v), "seed %u: (%.17g, %.17g) in [%.17g, %.17g] x [%.17g, %.17g]", seed, u, v,
              rect.u0, rect.u1, rect.v0, rect.v1);
    }
    arena_free(scratch);
}

static void a_cell_says_what_the_tree_says(void **state)
{
    (void)state;
    int count[3] = { 0 };
    for (unsigned seed = 0; seed < 60; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        const TrimTree *t = random_tree(a, &r, test_int(&r, 1, 5), seed % 2);
        for (int i = 0; i < 200; i++) {
            double w = pow(10, test_range(&r, -3, 0)), h = pow(10, test_range(&r, -3, 0));
            double u = test_range(&r, 0, 1 - w), v = test_range(&r, 0, 1 - h);
            if (i % 4 == 0) u = i % 8 ? 0 : 1 - w;                           /* leaves at the border */
            agree_in(a, t, (TrimRect){ u, fmin(u + w, 1), v, fmin(v + h, 1) }, &r, count, seed);
        }
        arena_free(a);
    }
    CHECK(count[TRIM_KEPT] > 500 && count[TRIM_CUT] > 500 && count[TRIM_MIXED] > 500,
          "%d kept, %d cut, %d mixed", count[TRIM_KEPT], count[TRIM_CUT], count[TRIM_MIXED]);
}

static double some_ulps_from(double x, int n)
{
    for (; n > 0; n--) x = nextafter(x, 2);
    for (; n < 0; n++) x = nextafter(x, -2);
    return x;
}

/* Where a circle turns an arc is as narrow as the last bit of its ends, and its other bits say where it is. */
static void a_cell_that_ends_beside_a_turn_says_what_the_tree_says(void **state)
{
    (void)state;
    int count[3] = { 0 };
    for (unsigned seed = 0; seed < 300; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        double radius = test_range(&r, .1, .4);
        Vec2 centre = vec2(test_range(&r, .45, .55), test_range(&r, .45, .55));
        TrimLoopDesc circle = turned_circle(a, centre, radius, test_int(&r, 0, 1) ? 0 : test_range(&r, 0, 7), seed % 2);
        Made m = make_of(a, &circle, 1);
        CHECK(m.tree, "seed %u: code %d", seed, m.error.code);
        for (int k = -30; k <= 30; k++) {
            double u = some_ulps_from(centre.x, k), v = some_ulps_from(centre.y, k), w = test_range(&r, .01, .1);
            agree_in(a, m.tree, (TrimRect){ 0, 1, v, v + w }, &r, count, seed);
            agree_in(a, m.tree, (TrimRect){ 0, 1, v - w, v }, &r, count, seed);
            agree_in(a, m.tree, (TrimRect){ u, u + w, 0, 1 }, &r, count, seed);
            agree_in(a, m.tree, (TrimRect){ u - w, u, 0, 1 }, &r, count, seed);
        }
        arena_free(a);
    }
    assert_true(count[TRIM_MIXED] > 10000);
}

/* Where the rectangle's sides run through vertices and along pieces, and rows of vertices through the rectangle. */
static void a_cell_of_a_lattice_says_what_the_tree_says(void **state)
{
    (void)state;
    int count[3] = { 0 };
    for (unsigned seed = 0; seed < 200; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        Vec2 p[200];
        int n = 0;
        for (int i = 0; i < 48; i++) {                                       /* a comb: teeth up from v = 1/8 */
            double u = (i + 8) / 64., top = test_int(&r, 3, 7) / 8.;
            p[n++] = vec2(u, i % 2 ? top : .25);
        }
        p[n++] = vec2(.875, .125), p[n++] = vec2(.125, .125);
        TrimLoopDesc loop = loop_of(a, p, n);
        Made m = make_of(a, &loop, 1);
        CHECK(m.tree, "seed %u: code %d", seed, m.error.code);
        for (int i = 0; i < 50; i++) {
            int u = test_int(&r, 0, 63), v = test_int(&r, 0, 15);
            TrimRect rect = { u / 64., test_int(&r, u + 1, 64) / 64., v / 16., test_int(&r, v + 1, 16) / 16. };
            agree_in(a, m.tree, rect, &r, count, seed);
        }
        arena_free(a);
    }
    CHECK(count[TRIM_MIXED] > 2000, "%d mixed", count[TRIM_MIXED]);
}

/* A wave of many pieces as a hole: a small rectangle on it has few of them, a large one leaves them to the tree. */
static void a_cell_of_a_long_loop_is_small(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const int n = 200000;
    Vec2 *p = ARENA_ARRAY(a, Vec2, n);
    for (int i = 0; i < n; i++) {
        double t = 2 * acos(-1) * i / n, radius = .4 + .01 * sin(1000 * t);
        p[i] = vec2(.5 + radius * cos(t), .5 + radius * sin(t));
    }
    TrimLoopDesc loop = loop_of(a, p, n);
    Made m = make_of(a, &loop, 1);
    CHECK(m.tree, "code %d", m.error.code);
    TestRandom r = test_random(1);
    int count[3] = { 0 };
    size_t bytes = arena_bytes(a);
    for (int i = 0; i < 3000; i++) {
        double w = i % 10 ? 2e-4 : .1;
        Vec2 q = p[test_int(&r, 0, n - 1)];
        agree_in(a, m.tree, (TrimRect){ q.x - test_unit(&r) * w, q.x + w, q.y - test_unit(&r) * w, q.y + w }, &r, count, 1);
    }
    CHECK(count[TRIM_MIXED] == 3000, "%d mixed", count[TRIM_MIXED]);
    CHECK(arena_bytes(a) - bytes < 8u << 20, "%zu bytes", arena_bytes(a) - bytes);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cell_says_what_the_tree_says),
        cmocka_unit_test(a_cell_that_ends_beside_a_turn_says_what_the_tree_says),
        cmocka_unit_test(a_cell_of_a_lattice_says_what_the_tree_says),
        cmocka_unit_test(a_cell_of_a_long_loop_is_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
