#include "tests/test.h"

#include "render/bvh.h"

#include <string.h>

static Vec3 any_vector(TestRandom *r, double size)
{
    double x = test_range(r, -size, size), y = test_range(r, -size, size);
    return vec(x, y, test_range(r, -size, size));
}

typedef enum { SCATTERED, ON_A_LINE, ALL_THE_SAME, NESTED, FLAT, CLUSTERED, N_KINDS } Kind;

/* Boxes that make good trees, and boxes that make bad ones. */
static void make_boxes(TestRandom *r, Kind kind, Box *boxes, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        Vec3 c = any_vector(r, 1), half = vec(.1 * test_unit(r), .1 * test_unit(r), .1 * test_unit(r));
        if (kind == ON_A_LINE) c = vec((double)i / n, 0, 0);
        if (kind == ALL_THE_SAME) c = vec(.2, .3, .1), half = vec(.1, .1, .1);
        if (kind == NESTED) c = vec(0, 0, 0), half = vec(exp2(-(int)(i % 60)), exp2(-(int)(i % 50)), exp2(-(int)(i % 40)));
        if (kind == FLAT) c.z = 0, half.z = 0;
        if (kind == CLUSTERED) c = vec_scale(c, ldexp(1, -(int)(i % 100)));
        boxes[i] = box_around(c, half);
        if (kind == SCATTERED && i % 17 == 5) boxes[i] = box_empty();
    }
}

static Ray any_ray(TestRandom *r)
{
    Ray ray = { any_vector(r, 2), any_vector(r, 1), 0 };
    if (test_int(r, 0, 3) == 0) ray.dir.x = 0;
    if (test_int(r, 0, 3) == 0) ray.dir.y = -0.;
    if (vec_max_abs(ray.dir) == 0) ray.dir.z = 1;
    if (test_int(r, 0, 1)) ray.origin = vec_sub(any_vector(r, .5), vec_scale(ray.dir, 3));
    return ray;
}

typedef struct { unsigned char *seen; } Visits;

static bool note(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Visits *v = context;
    (void)r, (void)t_max, (void)t;
    v->seen[i]++;
    return false;
}

enum { N = 700 };

static void a_traversal_visits_the_boxes_that_the_ray_meets_and_no_other(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new();
        uint32_t n = seed < 12 ? seed : (uint32_t)test_int(&r, 10, N);
        Box boxes[N];
        make_boxes(&r, (Kind)(seed % N_KINDS), boxes, n);
        Bvh *b = bvh_build(a, boxes, n, seed / N_KINDS % 2 ? BVH_SAH : BVH_MEDIAN);
        for (int k = 0; k < 100; k++) {
            Ray ray = any_ray(&r);
            double t_max = test_int(&r, 0, 1) ? INFINITY : test_range(&r, 0, 5), t_enter;
            unsigned char seen[N] = { 0 };
            Visits v = { seen };
            Trace trace = { .fetches_ahead = k % 2 };     /* as in large trees */
            BoxRay box = box_ray(ray.origin, ray.dir);
            CHECK(!bvh_traverse(b, &ray, &t_max, note, &v, &trace), "seed %u", seed);
            for (uint32_t i = 0; i < n; i++)
                CHECK(seen[i] == box_hit(&boxes[i], &box, 0, t_max, &t_enter), "seed %u, ray %d, box %u", seed, k, i);
        }
        arena_free(a);
    }
}

typedef struct { const double *t; double nearest; uint32_t index; int n_visits; } Nearest;

static bool take_nearest(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Nearest *n = context;
    (void)r, (void)t;
    n->n_visits++;
    if (n->t[i] < *t_max) *t_max = n->nearest = n->t[i], n->index = i;
    return false;
}

/* Each box is hit at its entry: the nearest is found, as by asking all of them, and most of the tree is not visited. */
static void the_nearest_is_that_of_brute_force(void **state)
{
    (void)state;
    long n_visits = 0, n_boxes = 0;
    for (unsigned seed = 0; seed < 40; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new();
        Box boxes[N];
        make_boxes(&r, (Kind)(seed % N_KINDS), boxes, N);
        Bvh *b = bvh_build(a, boxes, N, seed / N_KINDS % 2 ? BVH_SAH : BVH_MEDIAN);
        for (int k = 0; k < 100; k++) {
            Ray ray = any_ray(&r);
            BoxRay box = box_ray(ray.origin, ray.dir);
            double t[N], expected = INFINITY, t_max = INFINITY;
            for (int i = 0; i < N; i++) {
                if (!box_hit(&boxes[i], &box, 0, INFINITY, &t[i])) t[i] = INFINITY;
                expected = fmin(expected, t[i]);
            }
            Nearest nearest = { t, INFINITY, 0, 0 };
            Trace trace = { .fetches_ahead = k % 2 };     /* as in large trees */
            bvh_traverse(b, &ray, &t_max, take_nearest, &nearest, &trace);
            CHECK(nearest.nearest == expected, "seed %u, ray %d: %g, not %g", seed, k, nearest.nearest, expected);
            if (seed % N_KINDS == SCATTERED) n_visits += nearest.n_visits, n_boxes += N;
        }
        arena_free(a);
    }
    CHECK(n_visits * 50 < n_boxes, "%ld visits to %ld boxes", n_visits, n_boxes);
}

static bool stop_at(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    (void)r, (void)t_max, (void)t;
    return i == *(uint32_t *)context;
}

static void a_visit_may_end_the_traversal(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TestRandom r = test_random(1);
    Box boxes[N];
    make_boxes(&r, ALL_THE_SAME, boxes, N);
    Bvh *b = bvh_build(a, boxes, N, BVH_SAH);
    Ray ray = { vec(.2, .3, -5), vec(0, 0, 1), 0 };
    for (uint32_t i = 0; i <= N; i += 50) {
        double t_max = INFINITY;
        Trace t = { 0 };
        CHECK(bvh_traverse(b, &ray, &t_max, stop_at, &i, &t) == (i < N), "box %u", i);
    }
    arena_free(a);
}

static void boxes_are_counted_by_the_kind_of_ray(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Box boxes[3];
    for (int i = 0; i < 3; i++) boxes[i] = box_from(vec(5 * i, 0, 0), vec(5 * i + 1, 1, 1));
    Bvh *b = bvh_build(a, boxes, 3, BVH_MEDIAN);
    assert_int_equal(bvh_node_count(b), 5);
    Visits v = { (unsigned char[3]){ 0 } };
    Ray through = { vec(-1, .5, .5), vec(1, 0, 0), 0 }, beside = { vec(-1, 2, .5), vec(1, 0, 0), 0 };
    Trace t = { 0 };
    double t_max = INFINITY;
    bvh_traverse(b, &through, &t_max, note, &v, &t);
    assert_int_equal(t.counters.bv_intersections, 5);
    bvh_traverse(b, &beside, &t_max, note, &v, &t);
    assert_int_equal(t.counters.bv_intersections, 6);
    t.is_shadow_ray = true;
    bvh_traverse(b, &beside, &t_max, note, &v, &t);
    assert_int_equal(t.counters.bv_intersections, 6);
    assert_int_equal(t.counters.light_bv_intersections, 1);
    arena_free(a);
}

static void a_tree_of_nothing_is_empty(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Box boxes[2] = { box_empty(), box_empty() };
    Bvh *none = bvh_build(a, boxes, 0, BVH_SAH), *empty = bvh_build(a, boxes, 2, BVH_MEDIAN);
    Ray ray = { vec(0, 0, 0), vec(0, 0, 1), 0 };
    double t_max = INFINITY;
    Trace t = { 0 };
    CHECK(box_is_empty(bvh_bounds(none)) && box_is_empty(bvh_bounds(empty)), "bounds");
    CHECK(!bvh_traverse(none, &ray, &t_max, note, NULL, &t), "none");
    CHECK(!bvh_traverse(empty, &ray, &t_max, note, NULL, &t), "empty");
    arena_free(a);
}

/* A ray that meets every box visits them in the order of their distance, up to overlaps: here there are none. */
static void boxes_in_a_row_are_visited_in_order(void **state)
{
    (void)state;
    Arena *a = arena_new();
    enum { ROW = 128 };                  /* a power of 2: the halves end in pairs of leaves */
    Box boxes[ROW];
    for (int i = 0; i < ROW; i++) boxes[i] = box_from(vec(2 * i, 0, 0), vec(2 * i + 1, 1, 1));
    for (int way = -1; way <= 1; way += 2) {
        Bvh *b = bvh_build(a, boxes, ROW, way < 0 ? BVH_SAH : BVH_MEDIAN);
        Ray ray = { vec(way < 0 ? 1000 : -1000, .5, .5), vec(way, 0, 0), 0 };
        double t[ROW], t_max = INFINITY;
        for (int i = 0; i < ROW; i++) t[i] = way > 0 ? 1000 + 2 * i : 1000 - 2 * i - 1;
        Nearest nearest = { t, INFINITY, 0, 0 };
        Trace trace = { 0 };
        bvh_traverse(b, &ray, &t_max, take_nearest, &nearest, &trace);
        CHECK(nearest.index == (way > 0 ? 0u : ROW - 1u), "found %u", nearest.index);
        CHECK(nearest.n_visits <= (way < 0 ? 4 : 1), "%d visits", nearest.n_visits);      /* the items of one leaf */
    }
    arena_free(a);
}

/* Some boxes alone, some as trees of their own. Items are numbered through. */
static void a_joined_tree_loses_no_item_of_its_parts(void **state)
{
    (void)state;
    enum { PARTS = 30 };
    for (unsigned seed = 0; seed < 60; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new();
        Box boxes[N], bounds[PARTS];
        const Bvh *parts[PARTS];
        uint32_t first[PARTS], n = 0, n_parts = seed < 4 ? seed : (uint32_t)test_int(&r, 2, PARTS);
        make_boxes(&r, (Kind)(seed % N_KINDS), boxes, N);
        for (uint32_t i = 0; i < n_parts; i++) {
            uint32_t size = (uint32_t)test_int(&r, 1, test_int(&r, 0, 1) ? 3 : N / PARTS);
            bool is_alone = test_int(&r, 0, 2) == 0;
            first[i] = n, n += is_alone ? 1 : size;
            parts[i] = is_alone ? NULL : bvh_build(a, boxes + first[i], size, BVH_SAH);
            bounds[i] = is_alone ? boxes[first[i]] : bvh_bounds(parts[i]);
        }
        Bvh *b = bvh_join(a, bounds, parts, first, n_parts);
        for (int k = 0; k < 100; k++) {
            Ray ray = any_ray(&r);
            double t_max = test_int(&r, 0, 1) ? INFINITY : test_range(&r, 0, 5), t_enter;
            unsigned char seen[N] = { 0 }, seen_by_any[N] = { 0 };
            Visits v = { seen }, w = { seen_by_any };
            Trace trace = { .fetches_ahead = k % 2 };
            BoxRay box = box_ray(ray.origin, ray.dir);
            CHECK(!bvh_traverse(b, &ray, &t_max, note, &v, &trace), "seed %u", seed);
            CHECK(!bvh_any(b, &ray, t_max, note, &w, &trace), "seed %u", seed);
            for (uint32_t i = 0; i < N; i++) {
                bool is_met = i < n && box_hit(&boxes[i], &box, 0, t_max, &t_enter);
                CHECK(seen[i] == is_met && seen_by_any[i] == is_met, "seed %u, ray %d, item %u of %u: %d, %d", seed, k, i, n,
                      seen[i], seen_by_any[i]);
            }
        }
        arena_free(a);
    }
}

/* 64 boxes in a cube of 4 x 4 x 4, and what a tree that opens as few nodes as possible has to test for a ray along a row: a
 * root of 16, four of them nodes, has room for all, and does with three nodes of 16 at most. */
static void nodes_are_full(void **state)
{
    (void)state;
    Box boxes[64];
    for (int i = 0; i < 64; i++) boxes[i] = box_around(vec(i % 4, i / 4 % 4, i / 16), vec(.4, .4, .4));
    Arena *a = arena_new();
    Bvh *b = bvh_build(a, boxes, 64, BVH_SAH);
    CHECK(bvh_node_count(b) == 5, "%u nodes", bvh_node_count(b));
    Ray ray = { vec(-3, 1, 2), vec(1, 0, 0), 0 };
    unsigned char seen[64] = { 0 };
    Visits v = { seen };
    Trace t = { 0 };
    bvh_any(b, &ray, INFINITY, note, &v, &t);
    CHECK(t.counters.bv_intersections <= 1 + 3 * 16, "%lu boxes", (unsigned long)t.counters.bv_intersections);
    arena_free(a);
}

static void items_are_where_they_were_said_to_be(void **state)
{
    (void)state;
    TestRandom r = test_random(3);
    Box boxes[N];
    int items[N];
    make_boxes(&r, CLUSTERED, boxes, N);
    Arena *a = arena_new();
    Bvh *b = bvh_build(a, boxes, N, BVH_SAH);
    assert_null(bvh_item(b, 5));
    bvh_set_items(b, &(BvhItems){ items, sizeof *items, NULL, 0 });
    assert_ptr_equal(bvh_item(b, 5), &items[5]);
    arena_free(a);
}

static void the_same_boxes_make_the_same_tree(void **state)
{
    (void)state;
    TestRandom r = test_random(9);
    Box boxes[N];
    for (int kind = 0; kind < N_KINDS; kind++) {
        make_boxes(&r, (Kind)kind, boxes, N);
        Arena *a = arena_new();
        Bvh *one = bvh_build(a, boxes, N, BVH_SAH), *two = bvh_build(a, boxes, N, BVH_SAH);
        CHECK(bvh_node_count(one) == bvh_node_count(two), "kind %d", kind);
        for (int k = 0; k < 50; k++) {
            Ray ray = any_ray(&r);
            double t_max = INFINITY;
            Trace first = { 0 }, second = { 0 };
            unsigned char seen[N] = { 0 };
            Visits v = { seen };
            bvh_traverse(one, &ray, &t_max, note, &v, &first);
            bvh_traverse(two, &ray, &t_max, note, &v, &second);
            CHECK(first.counters.bv_intersections == second.counters.bv_intersections, "kind %d, ray %d", kind, k);
        }
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_traversal_visits_the_boxes_that_the_ray_meets_and_no_other),
        cmocka_unit_test(the_nearest_is_that_of_brute_force),
        cmocka_unit_test(a_visit_may_end_the_traversal),
        cmocka_unit_test(boxes_are_counted_by_the_kind_of_ray),
        cmocka_unit_test(a_tree_of_nothing_is_empty),
        cmocka_unit_test(boxes_in_a_row_are_visited_in_order),
        cmocka_unit_test(a_joined_tree_loses_no_item_of_its_parts),
        cmocka_unit_test(nodes_are_full),
        cmocka_unit_test(items_are_where_they_were_said_to_be),
        cmocka_unit_test(the_same_boxes_make_the_same_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
