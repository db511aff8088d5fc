#include "tests/test.h"

#include "render/arena.h"

#include <setjmp.h>
#include <string.h>

static void memory_is_aligned_writable_and_apart(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TestRandom r = test_random(1);
    enum { N = 500 };
    unsigned char *p[N];
    size_t size[N];
    for (int i = 0; i < N; i++) {
        size[i] = (size_t)test_int(&r, 0, i % 50 == 0 ? 100000 : 300);
        p[i] = arena_alloc(a, size[i], 1);
        CHECK((uintptr_t)p[i] % 64 == 0, "allocation %d", i);
        memset(p[i], i & 255, size[i]);
    }
    for (int i = 0; i < N; i++)
        for (size_t k = 0; k < size[i]; k++) CHECK(p[i][k] == (i & 255), "allocation %d, byte %zu", i, k);
    arena_free(a);
}

static void cleared_memory_is_zero_even_where_it_was_used_before(void **state)
{
    (void)state;
    Arena *a = arena_new();
    ArenaMark start = arena_mark(a);
    memset(arena_alloc(a, 3000, 1), 0xAB, 3000);
    arena_reset(a, start);
    const unsigned char *p = arena_zalloc(a, 3000, 1);
    for (int i = 0; i < 3000; i++) CHECK(p[i] == 0, "byte %d", i);
    arena_free(a);
}

static void a_reset_gives_back_what_came_after_the_mark(void **state)
{
    (void)state;
    Arena *a = arena_new();
    char *kept = arena_strdup(a, "kept");
    ArenaMark mark = arena_mark(a);
    void *first = arena_alloc(a, 100, 1);
    for (int i = 0; i < 100; i++) arena_alloc(a, 1000, 1);
    arena_reset(a, mark);
    assert_string_equal(kept, "kept");
    assert_ptr_equal(arena_alloc(a, 100, 1), first);
    arena_free(a);
}

static void a_scratch_arena_comes_to_rest(void **state)
{
    (void)state;
    Arena *a = arena_new();
    size_t settled = 0;
    for (int round = 0; round < 100; round++) {
        ArenaMark mark = arena_mark(a);
        for (int i = 0; i < 20; i++) arena_alloc(a, 1, 3000);
        arena_reset(a, mark);
        if (round == 10) settled = arena_bytes(a);
        CHECK(round <= 10 || arena_bytes(a) == settled, "round %d: %zu bytes, then %zu", round, settled, arena_bytes(a));
    }
    arena_free(a);
}

static void a_growing_array_keeps_its_elements(void **state)
{
    (void)state;
    Arena *a = arena_new();
    int *list = NULL;
    size_t n = 0, capacity = 0;
    for (int i = 0; i < 10000; i++) ARENA_PUSH(a, list, n, capacity) = i * i;
    assert_int_equal(n, 10000);
    for (int i = 0; i < 10000; i++) CHECK(list[i] == i * i, "element %d", i);
    CHECK(arena_bytes(a) < 10 * n * sizeof *list, "%zu bytes for %zu", arena_bytes(a), n * sizeof *list);
    arena_free(a);
}

static void strings_are_copied_and_formatted(void **state)
{
    (void)state;
    Arena *a = arena_new();
    assert_string_equal(arena_strdup(a, ""), "");
    assert_string_equal(arena_printf(a, "%s:%d", "x", 42), "x:42");
    char *large = arena_printf(a, "%0*d", 5000, 7);
    assert_int_equal(strlen(large), 5000);
    assert_int_equal(large[4999], '7');
    int numbers[] = { 3, 1, 4 };
    assert_memory_equal(arena_copy(a, numbers, 3, sizeof *numbers), numbers, sizeof numbers);
    arena_free(a);
}

typedef struct { jmp_buf back; size_t bytes; } Escape;

static void escape(void *context, size_t bytes)
{
    Escape *e = context;
    e->bytes = bytes;
    longjmp(e->back, 1);
}

/* Ten allocations of every kind, so that each of them is the one that fails in turn. */
static void allocate_ten_times(Arena *a)
{
    size_t capacity = 0;
    for (int i = 0; i < 2; i++) {
        arena_alloc(a, 5000, 1);
        arena_zalloc(a, 1, 10);
        arena_strdup(a, "abc");
        arena_printf(a, "%d", i);
        arena_grow(a, NULL, 0, &capacity, 8);
        capacity = 0;
    }
}

static void every_allocation_may_fail_and_none_returns_null(void **state)
{
    (void)state;
    for (volatile int n = 1; n <= 10; n++) {
        Arena *a = arena_new();
        Escape e;
        arena_on_exhausted(a, escape, &e);
        arena_fail_after(a, n);
        if (setjmp(e.back) == 0) {
            allocate_ten_times(a);
            CHECK(false, "allocation %d did not fail", n);
        }
        arena_fail_after(a, -1);
        allocate_ten_times(a);            /* and the arena goes on */
        arena_free(a);
    }
    Arena *a = arena_new();
    Escape e;
    arena_on_exhausted(a, escape, &e);
    arena_fail_after(a, 11);
    if (setjmp(e.back) == 0) allocate_ten_times(a);
    else CHECK(false, "an allocation before the eleventh failed");
    arena_free(a);
}

static void a_size_that_overflows_is_refused(void **state)
{
    (void)state;
    static const size_t sizes[][2] = { { SIZE_MAX, 2 }, { SIZE_MAX / 8 + 1, 8 }, { SIZE_MAX, 1 }, { 1, SIZE_MAX - 63 } };
    for (volatile int i = 0; i < 4; i++) {
        Arena *a = arena_new();
        Escape e = { .bytes = 0 };
        arena_on_exhausted(a, escape, &e);
        if (setjmp(e.back) == 0) {
            arena_alloc(a, sizes[i][0], sizes[i][1]);
            CHECK(false, "size %d was accepted", i);
        }
        CHECK(e.bytes == SIZE_MAX, "size %d: %zu", i, e.bytes);
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_aligned_writable_and_apart),
        cmocka_unit_test(cleared_memory_is_zero_even_where_it_was_used_before),
        cmocka_unit_test(a_reset_gives_back_what_came_after_the_mark),
        cmocka_unit_test(a_scratch_arena_comes_to_rest),
        cmocka_unit_test(a_growing_array_keeps_its_elements),
        cmocka_unit_test(strings_are_copied_and_formatted),
        cmocka_unit_test(every_allocation_may_fail_and_none_returns_null),
        cmocka_unit_test(a_size_that_overflows_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
