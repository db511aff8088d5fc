#include "tests/test.h"

#include "render/shape.h"

#include <pthread.h>
#include <time.h>

/* A shape that prepares itself slowly and says how often. */
typedef struct Slow {
    Shape shape;
    struct Slow *within;         /* prepared by our prepare() */
    atomic_int n_prepared;
    int *in_arena;
    double seconds;
} Slow;

static void wait_seconds(double seconds)
{
    struct timespec t = { 0, (long)(seconds * 1e9) };
    nanosleep(&t, NULL);
}

static void slow_prepare(Shape *s, Arena *own, Trace *t)
{
    Slow *slow = (Slow *)s;
    wait_seconds(slow->seconds);
    if (slow->within) shape_prepare(&slow->within->shape, t);
    slow->in_arena = ARENA_NEW(own, int);
    *slow->in_arena = 7;
    atomic_fetch_add(&slow->n_prepared, 1);
}

/* A wall at t = 3. */
static bool slow_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    (void)t;
    if (*((const Slow *)s)->in_arena != 7 || !(3 > r->t_min && 3 < best->t)) return false;
    hit_set(best, 3, 0, 0, 0, s, 0);
    return true;
}

static Box slow_bounds(const Shape *s)
{
    (void)s;
    return box_from(vec(0, 0, 0), vec(1, 1, 1));
}

static const ShapeType slow_type = { .name = "slow", .bounds = slow_bounds, .prepare = slow_prepare, .hit = slow_hit };

static void slow_init(Slow *s, Slow *within, double seconds)
{
    *s = (Slow){ .within = within, .seconds = seconds };
    shape_init(&s->shape, &slow_type);
}

static void a_shape_is_prepared_by_its_first_ray_and_not_before(void **state)
{
    (void)state;
    Slow s;
    slow_init(&s, NULL, 0);
    (void)shape_bounds(&s.shape);
    CHECK(!shape_was_prepared(&s.shape) && s.n_prepared == 0, "by asking for its bounds");
    Trace t = { 0 };
    Ray r = { vec(0, 0, 0), vec(0, 0, 1), 0 };
    for (int i = 0; i < 3; i++) {
        Hit h = { .t = INFINITY };
        assert_true(shape_hit(&s.shape, &r, &h, &t));
        assert_true(h.t == 3 && h.shape == &s.shape);
    }
    CHECK(shape_was_prepared(&s.shape) && s.n_prepared == 1, "%d times", s.n_prepared);
    shape_release(&s.shape);
    CHECK(!shape_was_prepared(&s.shape) && !s.shape.own, "still there");
    Hit h = { .t = INFINITY };
    CHECK(shape_hit(&s.shape, &r, &h, &t) && s.n_prepared == 2, "not prepared again");
    shape_release(&s.shape);
}

static void without_blocks_hit_answers(void **state)
{
    (void)state;
    Slow s;
    slow_init(&s, NULL, 0);
    Trace t = { 0 };
    Ray r = { vec(0, 0, 0), vec(0, 0, 1), 0 };
    CHECK(shape_blocks(&s.shape, &r, 3.5, &t) && shape_blocks(&s.shape, &r, INFINITY, &t), "before t_max");
    CHECK(!shape_blocks(&s.shape, &r, 3, &t) && !shape_blocks(&s.shape, &r, 2, &t), "the interval is open");
    r.t_min = 3;
    CHECK(!shape_blocks(&s.shape, &r, 5, &t), "the interval is open");
    shape_release(&s.shape);
}

static void a_shape_that_needs_nothing_is_ready(void **state)
{
    (void)state;
    static const ShapeType type = { .name = "ready", .bounds = slow_bounds, .hit = slow_hit };
    int seven = 7;
    Slow s = { .in_arena = &seven };
    shape_init(&s.shape, &type);
    CHECK(shape_was_prepared(&s.shape) && s.shape.n_primitives == 1, "at once");
    Trace t = { 0 };
    Ray r = { vec(0, 0, 0), vec(0, 0, 1), 0 };
    assert_true(shape_blocks(&s.shape, &r, 4, &t));
    assert_null(s.shape.own);
}

typedef struct { Slow *shapes; int n; pthread_barrier_t *start; bool all_hit; } Job;

static void *ask_all(void *context)
{
    Job *j = context;
    Trace t = { 0 };
    Ray r = { vec(0, 0, 0), vec(0, 0, 1), 0 };
    pthread_barrier_wait(j->start);
    j->all_hit = true;
    for (int i = 0; i < j->n; i++) {
        Hit h = { .t = INFINITY };
        j->all_hit &= shape_hit(&j->shapes[i].shape, &r, &h, &t);
    }
    return NULL;
}

static void many_threads_prepare_a_shape_once(void **state)
{
    (void)state;
    enum { THREADS = 8, SHAPES = 50 };
    static Slow shapes[SHAPES];
    for (int i = 0; i < SHAPES; i++) slow_init(&shapes[i], i > 0 && i % 3 == 0 ? &shapes[i - 1] : NULL, .0005);
    pthread_t threads[THREADS];
    pthread_barrier_t start;
    pthread_barrier_init(&start, NULL, THREADS);
    Job jobs[THREADS];
    for (int i = 0; i < THREADS; i++) {
        jobs[i] = (Job){ shapes, SHAPES, &start, false };
        assert_int_equal(pthread_create(&threads[i], NULL, ask_all, &jobs[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
    for (int i = 0; i < THREADS; i++) CHECK(jobs[i].all_hit, "thread %d saw a shape that was not ready", i);
    for (int i = 0; i < SHAPES; i++) CHECK(shapes[i].n_prepared == 1, "shape %d: %d times", i, shapes[i].n_prepared);
    for (int i = 0; i < SHAPES; i++) shape_release(&shapes[i].shape);
    pthread_barrier_destroy(&start);
}

/* A shape that is prepared in pieces; the first one waits for another thread to take one of the others. */
enum { PIECES = 100 };
typedef struct {
    Shape shape;
    atomic_int n_done[PIECES], n_others;
    int *in_arena[PIECES];
    pthread_t first;
} Shared;

static void do_piece(void *context, uint32_t i, Arena *own, Trace *t)
{
    Shared *s = context;
    (void)t;
    atomic_fetch_add(&s->n_done[i], 1);
    s->in_arena[i] = ARENA_NEW(own, int);
    *s->in_arena[i] = (int)i;
    if (!pthread_equal(pthread_self(), s->first)) atomic_fetch_add(&s->n_others, 1);
    for (int k = 0; i == 0 && k < 10000 && atomic_load(&s->n_others) == 0; k++) wait_seconds(.001);
}

static void shared_prepare(Shape *shape, Arena *own, Trace *t)
{
    Shared *s = (Shared *)shape;
    s->first = pthread_self();
    shape_share_work(shape, own, PIECES, do_piece, s, t);
}

static bool shared_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Shared *s = (const Shared *)shape;
    (void)r, (void)best, (void)t;
    for (int i = 0; i < PIECES; i++)
        if (atomic_load(&s->n_done[i]) != 1 || *s->in_arena[i] != i) return false;
    return true;
}

static void *ask_shared(void *context)
{
    Trace t = { 0 };
    Ray r = { vec(0, 0, 0), vec(0, 0, 1), 0 };
    Hit h = { .t = INFINITY };
    return shape_hit(context, &r, &h, &t) ? context : NULL;
}

static void threads_that_wait_for_a_shape_help_with_it(void **state)
{
    (void)state;
    static const ShapeType type = { .name = "shared", .bounds = slow_bounds, .prepare = shared_prepare, .hit = shared_hit };
    enum { THREADS = 4 };
    static Shared s;
    shape_init(&s.shape, &type);
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_create(&threads[i], NULL, ask_shared, &s), 0);
    for (int i = 0; i < THREADS; i++) {
        void *answer;
        pthread_join(threads[i], &answer);
        CHECK(answer, "thread %d saw a shape that was not ready", i);
    }
    CHECK(atomic_load(&s.n_others) > 0, "one thread did it all");
    CHECK(arena_used(s.shape.own) >= PIECES * sizeof(int), "%zu bytes are the shape's", arena_used(s.shape.own));
    shape_release(&s.shape);
}

static void time_is_counted_once_where_preparations_nest(void **state)
{
    (void)state;
    Slow inner, outer;
    slow_init(&inner, NULL, .03);
    slow_init(&outer, &inner, .02);
    Trace t = { 0 };
    double begun = stats_now();
    shape_prepare(&outer.shape, &t);
    double elapsed = stats_now() - begun;
    CHECK(t.counters.prep_seconds >= .05, "%g of %g", t.counters.prep_seconds, elapsed);
    CHECK(t.counters.prep_seconds <= elapsed, "%g of %g", t.counters.prep_seconds, elapsed);
    shape_prepare(&outer.shape, &t);
    CHECK(t.counters.prep_seconds <= elapsed, "counted again: %g", t.counters.prep_seconds);
    shape_release(&outer.shape);
    shape_release(&inner.shape);
}

/* Every field is there: the struct is nothing but 8-byte numbers. */
static void counters_are_added_without_exception(void **state)
{
    (void)state;
    enum { FIELDS = sizeof(Counters) / 8 };
    Counters a = { 0 }, b = { 0 };
    uint64_t *from = (uint64_t *)(void *)&b;
    for (int i = 0; i < FIELDS; i++) from[i] = (uint64_t)i + 1;
    b.nurbs_seconds = 3.5, b.prep_seconds = 4.5;
    counters_add(&a, &b);
    counters_add(&a, &b);
    const uint64_t *to = (const uint64_t *)(const void *)&a;
    for (int i = 0; i < FIELDS; i++)
        if (&from[i] != (uint64_t *)(void *)&b.nurbs_seconds && &from[i] != (uint64_t *)(void *)&b.prep_seconds)
            CHECK(to[i] == 2 * from[i], "counter %d", i);
    CHECK(a.nurbs_seconds == 7 && a.prep_seconds == 9, "seconds");
}

static void clocks_and_memory_make_sense(void **state)
{
    (void)state;
    double begun = stats_now();
    wait_seconds(.01);
    double passed = stats_now() - begun;
    CHECK(passed >= .01 && passed < 10, "%g s", passed);
    CHECK(stats_peak_mb() > .5 && stats_peak_mb() < 1e6, "%g MB", stats_peak_mb());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_is_prepared_by_its_first_ray_and_not_before),
        cmocka_unit_test(without_blocks_hit_answers),
        cmocka_unit_test(a_shape_that_needs_nothing_is_ready),
        cmocka_unit_test(many_threads_prepare_a_shape_once),
        cmocka_unit_test(threads_that_wait_for_a_shape_help_with_it),
        cmocka_unit_test(time_is_counted_once_where_preparations_nest),
        cmocka_unit_test(counters_are_added_without_exception),
        cmocka_unit_test(clocks_and_memory_make_sense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
