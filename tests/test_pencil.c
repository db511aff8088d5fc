#include "tests/test.h"

#include "render/pencil.h"

#include <pthread.h>
#include <string.h>

/* Truth: slabs in quadruple precision, which lose 2^-110 or so of what counts here. */
typedef __float128 Quad;

typedef struct { Quad near, far; } Interval;

static void cut(Interval *i, Quad lo, Quad hi, Quad o, Quad d)
{
    if (d == 0) {
        if (o < lo || o > hi) i->far = i->near - 1;
        return;
    }
    Quad a = (lo - o) / d, b = (hi - o) / d;
    if (a > b) {
        Quad c = a;
        a = b, b = c;
    }
    if (a > i->near) i->near = a;
    if (b < i->far) i->far = b;
}

/* sure: by more than the truth may be off. */
static bool meets(const Box *b, const Ray *r, double t_max, bool sure, double *t)
{
    const double o[3] = { r->origin.x, r->origin.y, r->origin.z }, d[3] = { r->dir.x, r->dir.y, r->dir.z };
    Interval i = { r->t_min, t_max };
    for (int k = 0; k < 3; k++) cut(&i, b->lo[k], b->hi[k], o[k], d[k]);
    *t = (double)i.near;
    Quad size = (i.near < 0 ? -i.near : i.near) + (i.far < 0 ? -i.far : i.far);
    return i.near <= i.far - (sure ? size * (Quad)0x1p-100 : 0);
}

/* ---- scenes ---- */

enum { MOST = 900 };

typedef struct {
    Arena *arena;
    uint32_t n;
    Box boxes[MOST];
    Bvh *tree;
    Vec3 apex;
    Pencils *pencils;
    double size;                 /* about that of the tree */
} Scene;

static Vec3 any_vector(TestRandom *r, double size)
{
    double x = test_range(r, -size, size), y = test_range(r, -size, size);
    return vec(x, y, test_range(r, -size, size));
}

static Vec3 whole_vector(TestRandom *r, int size)
{
    int x = test_int(r, -size, size), y = test_int(r, -size, size);
    return vec(x, y, test_int(r, -size, size));
}

/* A point within, on a side, on an edge or a corner. */
static Vec3 point_of(TestRandom *r, const Box *b)
{
    double c[3];
    for (int k = 0; k < 3; k++) {
        int where = test_int(r, 0, 3);
        c[k] = where == 0 ? b->lo[k] : where == 1 ? b->hi[k] : b->lo[k] + test_unit(r) * ((double)b->hi[k] - b->lo[k]);
        if (c[k] > b->hi[k]) c[k] = b->hi[k];
    }
    return vec(c[0], c[1], c[2]);
}

/* Among the boxes, on one of them, about them, far off. */
static Vec3 any_apex(TestRandom *r, const Scene *s, Vec3 middle)
{
    switch (test_int(r, 0, 4)) {
    case 0: return vec_add(middle, any_vector(r, s->size));
    case 1: return point_of(r, &s->boxes[test_int(r, 0, (int)s->n - 1)]);
    case 2: return vec_add(middle, any_vector(r, 4 * s->size));
    case 3: return vec_add(middle, vec_scale(any_vector(r, s->size), exp2(test_range(r, 0, 40))));
    default: return vec_add(middle, vec(0, 0, -3 * s->size));
    }
}

/* Boxes of whole numbers, many of them flat, stand side by side: rays touch their sides. */
static Scene any_scene(TestRandom *r, bool is_whole)
{
    Scene s = { .arena = arena_new(), .n = (uint32_t)test_int(r, 30, MOST) };
    s.size = is_whole ? 16 : exp2(test_range(r, -30, 30));
    double off = is_whole || test_int(r, 0, 1) ? 0 : exp2(test_range(r, 0, 12));
    Vec3 middle = vec_scale(any_vector(r, s.size), off);
    double share = exp2(test_range(r, -6, -1));
    for (uint32_t i = 0; i < s.n; i++) {
        Vec3 c = is_whole ? whole_vector(r, 16) : vec_add(middle, any_vector(r, s.size));
        Vec3 to = is_whole ? vec_add(c, whole_vector(r, 2)) : vec_add(c, any_vector(r, share * s.size));
        s.boxes[i] = box_from(c, to);
    }
    s.tree = bvh_build(s.arena, s.boxes, s.n, BVH_SAH);
    s.apex = is_whole ? whole_vector(r, 40) : any_apex(r, &s, middle);
    s.pencils = pencils_new((Viewpoint){ vec_add(middle, any_vector(r, 8 * s.size)), exp2(test_range(r, 4, 24)) });
    return s;
}

static void free_scene(Scene *s)
{
    pencils_free(s->pencils);
    arena_free(s->arena);
}

/* Along an axis, an edge or a diagonal of the cube of faces; to a box; anywhere. */
static Vec3 any_way(TestRandom *r, const Scene *s)
{
    Vec3 way = whole_vector(r, 1);
    switch (test_int(r, 0, 3)) {
    case 0: return vec_max_abs(way) > 0 ? way : vec(0, -0., 1);
    case 1: return any_vector(r, 1);
    default: break;
    }
    way = vec_sub(point_of(r, &s->boxes[test_int(r, 0, (int)s->n - 1)]), s->apex);
    return vec_max_abs(way) > 0 ? way : vec(1, 0, 0);
}

typedef struct { Ray ray; double t_max; } Query;

static Query from_apex(TestRandom *r, const Scene *s)
{
    Vec3 way = any_way(r, s);
    if (test_int(r, 0, 1)) way = vec_normalize(way);
    double t_min = test_int(r, 0, 3) ? 0 : s->size * test_unit(r) / vec_length(way);
    return (Query){ { s->apex, way, t_min }, INFINITY };
}

/* Ends just before the apex, as shadow rays do (surface.h), and begins as far off as it may. */
static Query to_apex(TestRandom *r, const Scene *s)
{
    Vec3 way = any_way(r, s), origin = vec_add(s->apex, vec_scale(way, exp2(test_range(r, -4, 6))));
    Vec3 back = vec_sub(s->apex, origin), dir = vec_normalize(back);
    double reach = vec_dot(back, dir), size = vec_max_abs(origin) + vec_max_abs(s->apex);
    return (Query){ { origin, dir, 0 }, reach - 24 * 0x1p-53 * size };
}

/* Near the apex, but not through it; or through it and beyond. */
static Query astray(TestRandom *r, const Scene *s)
{
    Query q = test_int(r, 0, 1) ? from_apex(r, s) : to_apex(r, s);
    if (test_int(r, 0, 2) == 0) q.t_max = INFINITY;
    else q.ray.origin = vec_add(q.ray.origin, vec_scale(any_vector(r, s->size), exp2(test_range(r, -50, 0))));
    if (test_int(r, 0, 3) == 0) q.ray.t_min = -s->size;
    return q;
}

static Query any_query(TestRandom *r, const Scene *s)
{
    int kind = test_int(r, 0, 4);
    return kind == 0 ? astray(r, s) : kind % 2 ? from_apex(r, s) : to_apex(r, s);
}

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
