#include "tests/box_scenes.h"

#include "render/bvh_bunch.h"

#include <string.h>

typedef struct {
    RayBunch b;
    BunchLane state[BUNCH_WIDTH];
    Lanes lanes;                      /* that are asked for */
    double t_max[BUNCH_WIDTH];
} BunchQuery;

static Query beside(TestRandom *r, const Scene *s, Query q, double by)
{
    q.ray.dir = vec_add(q.ray.dir, vec_scale(any_vector(r, vec_max_abs(q.ray.dir)), by));
    if (test_int(r, 0, 1)) q.ray.origin = vec_add(q.ray.origin, vec_scale(any_vector(r, s->size), by));
    return q;
}

/* Neighbours from near to far, or rays that have nothing in common; some lanes left out, with numbers in them or none. */
static void any_bunch(TestRandom *r, const Scene *s, BunchQuery *out)
{
    bool is_coherent = test_int(r, 0, 2);
    double by = exp2(test_range(r, -30, 0));
    Query first = any_query(r, s);
    memset(out, 0, sizeof *out);
    out->b.n = test_int(r, 0, 3) ? BUNCH_WIDTH : test_int(r, 1, BUNCH_WIDTH);
    out->b.lane = out->state;
    for (int i = 0; i < out->b.n; i++) {
        Query q = is_coherent ? beside(r, s, first, by) : any_query(r, s);
        if (test_int(r, 0, 7) == 0) q.ray.dir.x = test_int(r, 0, 1) ? 0 : -0.;
        out->b.ray[i] = q.ray, out->t_max[i] = q.t_max;
    }
    out->lanes = bunch_all(&out->b);
    if (test_int(r, 0, 1)) out->lanes &= (Lanes)test_int(r, 1, 255);
    if (test_int(r, 0, 3) == 0) out->b.ray[test_int(r, 0, out->b.n - 1)].dir.z = NAN;
    bunch_set_lanes(&out->b);
}

/* ---- all that is met ---- */

typedef struct {
    Lanes seen[MOST], going;          /* going: have not ended */
    TestRandom *random;               /* ends rays by chance; NULL: none */
    int n_wrong;                      /* visits of rays that were not to come */
    int n_apart;                      /* visits where each ray had its own item */
} Visits;

static Lanes note(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    Visits *v = context;
    (void)b, (void)t_max, (void)t;
    v->n_wrong += !lanes || (lanes & ~v->going);
    v->n_apart += !items->is_one;
    for (Lanes left = lanes; left; ) {
        int k = lanes_next(&left);
        uint32_t i = bunch_item(items, k);
        v->n_wrong += v->seen[i] >> k & 1;
        v->seen[i] |= 1u << k;
    }
    Lanes ends = v->random && test_int(v->random, 0, 9) == 0 ? lanes & (Lanes)test_int(v->random, 0, 255) : 0;
    v->going &= ~ends;
    return ends;
}

static Lanes visit(const Scene *s, BunchQuery *q, bool any, Trace *t, Visits *v)
{
    memset(v->seen, 0, sizeof v->seen);
    v->going = q->lanes, v->n_wrong = v->n_apart = 0;
    Lanes ended = any ? bvh_any_bunch(s->tree, &q->b, q->lanes, q->t_max, note, v, t)
                      : bvh_traverse_bunch(s->tree, &q->b, q->lanes, q->t_max, note, v, t);
    return ended;
}

static void check_bunch(const Scene *s, BunchQuery *q, const Visits *v, bool is_whole, unsigned seed, int k)
{
    CHECK(v->n_wrong == 0, "seed %u, bunch %d: %d wrong visits", seed, k, v->n_wrong);
    for (Lanes left = v->going; left; ) {
        int i = lanes_next(&left);
        const Ray *r = &q->b.ray[i];
        if (!vec_is_finite(r->dir)) continue;
        for (uint32_t j = 0; j < s->n; j++) {
            double t;
            if (meets(&s->boxes[j], r, q->t_max[i], !is_whole, &t))
                CHECK(v->seen[j] >> i & 1, "seed %u, bunch %d, ray %d: box %u", seed, k, i, j);
        }
    }
}

/* How many bunches have gone apart. */
static int check_bunches(unsigned seed, bool is_whole)
{
    TestRandom r = test_random(seed);
    Scene s = any_scene(&r, is_whole);
    Trace trace = { .scratch = s.arena };
    int n_apart = 0;
    for (int k = 0; k < 60; k++) {
        static BunchQuery q;
        static Visits v;
        any_bunch(&r, &s, &q);
        trace.fetches_ahead = k % 4 == 0;     /* as in large trees */
        v.random = k % 3 == 0 ? &r : NULL;
        Lanes ended = visit(&s, &q, k % 2, &trace, &v);
        n_apart += v.n_apart > 0;
        CHECK(ended == (q.lanes & ~v.going), "seed %u, bunch %d: %x, not %x", seed, k, ended, q.lanes & ~v.going);
        check_bunch(&s, &q, &v, is_whole, seed, k);
    }
    free_scene(&s);
    return n_apart;
}

static void each_ray_of_a_bunch_visits_all_boxes_that_it_meets_until_it_ends(void **state)
{
    (void)state;
    int n_apart = 0;
    for (unsigned seed = 0; seed < 40; seed++) n_apart += check_bunches(seed, false);
    assert_true(n_apart > 600 && n_apart < 1800);
}

static void a_ray_of_a_bunch_that_touches_a_box_meets_it(void **state)
{
    (void)state;
    int n_apart = 0;
    for (unsigned seed = 0; seed < 30; seed++) n_apart += check_bunches(seed, true);
    assert_true(n_apart > 450 && n_apart < 1350);
}

/* ---- the nearest ---- */

static Lanes meet(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    const Scene *s = context;
    (void)t;
    while (lanes) {
        int k = lanes_next(&lanes);
        double at;
        if (meets(&s->boxes[bunch_item(items, k)], &b->ray[k], t_max[k], false, &at) && at < t_max[k]) t_max[k] = at;
    }
    return 0;
}

static bool meet_alone(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    const Scene *s = context;
    double at;
    (void)t;
    if (meets(&s->boxes[i], r, *t_max, false, &at) && at < *t_max) *t_max = at;
    return false;
}

static void the_nearest_boxes_are_those_of_the_rays_alone(void **state)
{
    (void)state;
    for (unsigned seed = 1000; seed < 1030; seed++) {
        TestRandom r = test_random(seed);
        Scene s = any_scene(&r, false);
        Trace alone = { 0 }, together = { .scratch = s.arena };
        for (int k = 0; k < 60; k++) {
            static BunchQuery q;
            any_bunch(&r, &s, &q);
            double expected[BUNCH_WIDTH];
            memcpy(expected, q.t_max, sizeof expected);
            for (Lanes left = q.lanes; left; ) {
                int i = lanes_next(&left);
                bvh_traverse(s.tree, &q.b.ray[i], &expected[i], meet_alone, &s, &alone);
            }
            bvh_traverse_bunch(s.tree, &q.b, q.lanes, q.t_max, meet, &s, &together);
            for (int i = 0; i < q.b.n; i++)
                CHECK(q.t_max[i] == expected[i] || !vec_is_finite(q.b.ray[i].dir), "seed %u, bunch %d, ray %d: %.17g, not "
                      "%.17g", seed, k, i, q.t_max[i], expected[i]);
        }
        free_scene(&s);
    }
}

/* ---- what is counted ---- */

static bool pass(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    (void)context, (void)i, (void)r, (void)t_max, (void)t;
    return false;
}

/* A box in a thousand may be touched by rounding in one way and not in the other. */
static void boxes_are_counted_as_for_the_rays_alone(void **state)
{
    (void)state;
    uint64_t n_together = 0, n_alone = 0;
    for (unsigned seed = 2000; seed < 2030; seed++) {
        TestRandom r = test_random(seed);
        Scene s = any_scene(&r, false);
        Trace alone = { 0 }, together = { .scratch = s.arena, .is_shadow_ray = true };
        for (int k = 0; k < 60; k++) {
            static BunchQuery q;
            static Visits v;
            any_bunch(&r, &s, &q);
            visit(&s, &q, true, &together, &v);
            for (Lanes left = q.lanes; left; ) {
                int i = lanes_next(&left);
                bvh_any(s.tree, &q.b.ray[i], q.t_max[i], pass, NULL, &alone);
            }
        }
        assert_int_equal(together.counters.bv_intersections, 0);
        n_together += together.counters.light_bv_intersections, n_alone += alone.counters.bv_intersections;
        free_scene(&s);
    }
    CHECK_WITHIN(fabs((double)n_together - (double)n_alone), .001 * (double)n_alone, "%lu and %lu boxes",
                 (unsigned long)n_together, (unsigned long)n_alone);
}

/* ---- trees of other kinds ---- */

static void small_and_binary_trees_lose_no_box(void **state)
{
    (void)state;
    for (unsigned seed = 3000; seed < 3024; seed++) {
        TestRandom r = test_random(seed);
        Scene s = any_scene(&r, seed % 3 == 0);
        s.n = (uint32_t)(seed % 2 ? seed % 10 : MOST / 3);
        if (s.n == 0 || s.n > MOST) s.n = 1;
        s.tree = bvh_build(s.arena, s.boxes, s.n, seed % 2 ? BVH_SAH : BVH_MEDIAN);
        Trace trace = { .scratch = s.arena };
        for (int k = 0; k < 60; k++) {
            static BunchQuery q;
            static Visits v;
            any_bunch(&r, &s, &q);
            v.random = k % 3 == 0 ? &r : NULL;
            Lanes ended = visit(&s, &q, k % 2, &trace, &v);
            CHECK(ended == (q.lanes & ~v.going), "seed %u, bunch %d", seed, k);
            check_bunch(&s, &q, &v, false, seed, k);
        }
        free_scene(&s);
    }
}

/* Two trees in turn, each within the other's space: what was made of the rays for one is not taken for the other. */
static void rays_are_made_anew_for_a_tree_that_is_not_within_the_last(void **state)
{
    (void)state;
    for (unsigned seed = 4000; seed < 4016; seed++) {
        TestRandom r = test_random(seed);
        Scene a = any_scene(&r, false), b = any_scene(&r, false);
        Trace trace = { .scratch = a.arena };
        for (int k = 0; k < 40; k++) {
            static BunchQuery q;
            static Visits v;
            any_bunch(&r, k % 4 ? &a : &b, &q);
            visit(k % 2 ? &a : &b, &q, false, &trace, &v);
            visit(k % 2 ? &b : &a, &q, true, &trace, &v);
            check_bunch(k % 2 ? &b : &a, &q, &v, false, seed, k);
        }
        free_scene(&a);
        free_scene(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_ray_of_a_bunch_visits_all_boxes_that_it_meets_until_it_ends),
        cmocka_unit_test(a_ray_of_a_bunch_that_touches_a_box_meets_it),
        cmocka_unit_test(the_nearest_boxes_are_those_of_the_rays_alone),
        cmocka_unit_test(boxes_are_counted_as_for_the_rays_alone),
        cmocka_unit_test(small_and_binary_trees_lose_no_box),
        cmocka_unit_test(rays_are_made_anew_for_a_tree_that_is_not_within_the_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
