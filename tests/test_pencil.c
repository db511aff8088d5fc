#include "tests/box_scenes.h"

#include <pthread.h>
#include <string.h>

/* ---- what is visited ---- */

typedef struct { unsigned char seen[MOST]; uint64_t n_boxes; } Visits;

static bool note(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    (void)r, (void)t_max, (void)t;
    ((Visits *)context)->seen[i]++;
    return false;
}

static void visit(const Scene *s, const Query *q, bool any, Trace *t, Visits *out)
{
    double t_max = q->t_max;
    Apex apex = apex_make(s->apex);
    memset(out, 0, sizeof *out);
    t->apex = t->pencils ? &apex : NULL;
    uint64_t before = t->counters.bv_intersections;
    if (any) bvh_any(s->tree, &q->ray, t_max, note, out, t);
    else bvh_traverse(s->tree, &q->ray, &t_max, note, out, t);
    out->n_boxes = t->counters.bv_intersections - before;
    t->apex = NULL;
}

static void check_rays(unsigned seed, bool is_whole, int n_rays)
{
    TestRandom r = test_random(seed);
    Scene s = any_scene(&r, is_whole);
    PencilMemory memory = { .all = s.pencils };
    Trace trace = { .pencils = &memory };
    for (int k = 0; k < n_rays; k++) {
        Query q = any_query(&r, &s);
        Visits v;
        visit(&s, &q, k % 2, &trace, &v);
        for (uint32_t i = 0; i < s.n; i++) {
            double t;
            CHECK(v.seen[i] <= 1, "seed %u, ray %d: box %u twice", seed, k, i);
            if (meets(&s.boxes[i], &q.ray, q.t_max, !is_whole, &t)) CHECK(v.seen[i], "seed %u, ray %d: box %u", seed, k, i);
        }
    }
    free_scene(&s);
}

static void a_ray_of_a_pencil_visits_all_boxes_that_it_meets(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 80; seed++) check_rays(seed, false, 300);
}

/* Whole numbers are exact: those from the apex touch sides, edges and corners. */
static void a_ray_that_touches_a_box_meets_it(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) check_rays(seed, true, 300);
}

/* ---- the nearest ---- */

typedef struct { const Scene *s; double t; } Nearest;

static bool meet(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Nearest *n = context;
    double at;
    (void)t;
    if (meets(&n->s->boxes[i], r, *t_max, false, &at) && at < *t_max) *t_max = n->t = at;
    return false;
}

static double nearest(const Scene *s, const Query *q, Trace *t)
{
    Nearest n = { s, INFINITY };
    double t_max = q->t_max;
    Apex apex = apex_make(s->apex);
    t->apex = t->pencils ? &apex : NULL;
    bvh_traverse(s->tree, &q->ray, &t_max, meet, &n, t);
    t->apex = NULL;
    return n.t;
}

static void the_nearest_box_is_that_of_a_search_from_the_root(void **state)
{
    (void)state;
    for (unsigned seed = 1000; seed < 1060; seed++) {
        TestRandom r = test_random(seed);
        Scene s = any_scene(&r, false);
        PencilMemory memory = { .all = s.pencils };
        Trace with = { .pencils = &memory }, without = { 0 };
        for (int k = 0; k < 150; k++) {
            Query q = any_query(&r, &s);
            double a = nearest(&s, &q, &with), b = nearest(&s, &q, &without);
            CHECK(a == b, "seed %u, ray %d: %.17g, not %.17g", seed, k, a, b);
        }
        free_scene(&s);
    }
}

/* ---- threads ---- */

enum { N_THREADS = 4, N_SHARED = 2000 };

typedef struct { const Scene *s; const Query *queries; uint64_t counts[N_SHARED]; pthread_t thread; } Worker;

static void *work(void *context)
{
    Worker *w = context;
    PencilMemory memory = { .all = w->s->pencils };
    Trace trace = { .pencils = &memory };
    for (int k = 0; k < N_SHARED; k++) {
        Visits v;
        visit(w->s, &w->queries[k], k % 2, &trace, &v);
        w->counts[k] = v.n_boxes;
    }
    return NULL;
}

static void what_a_ray_counts_does_not_depend_on_threads(void **state)
{
    (void)state;
    static Worker workers[N_THREADS];
    static Query queries[N_SHARED];
    for (unsigned seed = 2000; seed < 2010; seed++) {
        TestRandom r = test_random(seed);
        Scene s = any_scene(&r, false);
        for (int k = 0; k < N_SHARED; k++) queries[k] = any_query(&r, &s);
        for (int i = 0; i < N_THREADS; i++) {
            workers[i].s = &s, workers[i].queries = queries;
            assert_int_equal(pthread_create(&workers[i].thread, NULL, work, &workers[i]), 0);
        }
        for (int i = 0; i < N_THREADS; i++) pthread_join(workers[i].thread, NULL);
        for (int i = 1; i < N_THREADS; i++)
            CHECK(memcmp(workers[i].counts, workers[0].counts, sizeof workers[0].counts) == 0, "seed %u", seed);
        free_scene(&s);
    }
}

/* ---- what it is for ---- */

static void a_pencil_looks_at_fewer_boxes(void **state)
{
    (void)state;
    uint64_t with_pencils = 0, without = 0;
    for (unsigned seed = 3000; seed < 3030; seed++) {
        TestRandom r = test_random(seed);
        Scene s = any_scene(&r, false);
        PencilMemory memory = { .all = s.pencils };
        Trace with = { .pencils = &memory }, plain = { 0 };
        for (int k = 0; k < 500; k++) {
            Query q = k % 2 ? from_apex(&r, &s) : to_apex(&r, &s);
            Visits v;
            visit(&s, &q, false, &with, &v);
            visit(&s, &q, false, &plain, &v);
        }
        with_pencils += with.counters.bv_intersections, without += plain.counters.bv_intersections;
        free_scene(&s);
    }
    CHECK(with_pencils < without * 3 / 4, "%lu, without %lu", (unsigned long)with_pencils, (unsigned long)without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_of_a_pencil_visits_all_boxes_that_it_meets),
        cmocka_unit_test(a_ray_that_touches_a_box_meets_it),
        cmocka_unit_test(the_nearest_box_is_that_of_a_search_from_the_root),
        cmocka_unit_test(what_a_ray_counts_does_not_depend_on_threads),
        cmocka_unit_test(a_pencil_looks_at_fewer_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
