/* Memory that is freed together: a list of blocks, each twice as large as the one before, and from some size on a quarter
 * larger, so that little of the last one is there for nothing. An allocation is an advance in the newest block. Resetting to
 * a mark drops the blocks made since, but keeps the largest of them aside, so that a scratch arena that grows and shrinks
 * with every ray asks malloc only once. */
#include "render/arena.h"

#include "render/pages.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ALIGNMENT ((size_t)64)         /* a cache line; enough for any type, vector registers included */
#define FIRST_BLOCK ((size_t)4096)     /* bytes; a shape that is prepared late often needs no more */
#define STEADY_BLOCK ((size_t)256 << 10)
#define LARGE_BLOCK ((size_t)4 << 20)  /* from here on it will be filled for the most part: two large pages */

typedef struct Block {
    struct Block *older;
    size_t size, used;                 /* bytes of data, after the header */
} Block;

#define HEADER ((sizeof(Block) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT)

struct Arena {
    Block *newest, *spare;             /* spare: dropped by a reset, to be used again */
    size_t next_size;
    size_t bytes;                      /* held from malloc, headers included */
    Arena *adopted;
    ArenaExhausted on_exhausted;
    void *context;
    long fail_after;                   /* allocations until one fails; 0: this one does; negative: none */
};

static void exhausted_by_default(void *context, size_t bytes)
{
    (void)context;
    fprintf(stderr, "trimray: error: out of memory (%zu bytes were asked for)\n", bytes);
    exit(3);
}

_Noreturn static void exhausted(const Arena *a, size_t bytes)
{
    if (a->on_exhausted) a->on_exhausted(a->context, bytes);
    exhausted_by_default(NULL, bytes);
    abort();
}

Arena *arena_new(void)
{
    Arena *a = malloc(sizeof *a);
    if (!a) {
        exhausted_by_default(NULL, sizeof *a);
        abort();
    }
    *a = (Arena){ .next_size = FIRST_BLOCK, .bytes = sizeof *a, .fail_after = -1 };
    return a;
}

static void drop_block(Arena *a, Block *b)
{
    if (b) a->bytes -= HEADER + b->size;
    free(b);
}

void arena_free(Arena *a)
{
    if (!a) return;
    for (Block *b = a->newest, *older; b; b = older) {
        older = b->older;
        free(b);
    }
    free(a->spare);
    arena_free(a->adopted);
    free(a);
}

void arena_adopt(Arena *a, Arena *other)
{
    while (a->adopted) a = a->adopted;
    a->adopted = other;
}

void arena_on_exhausted(Arena *a, ArenaExhausted handler, void *context)
{
    a->on_exhausted = handler;
    a->context = context;
}

void arena_fail_after(Arena *a, long n) { a->fail_after = n < 0 ? -1 : n - 1; }

/* A block from malloc or the spare one, with room for at least `bytes`. */
static Block *block_new(Arena *a, size_t bytes)
{
    Block *b = a->spare;
    if (b && b->size >= bytes) {
        a->spare = NULL;
        return b;
    }
    size_t size = bytes > a->next_size ? bytes : a->next_size;
    b = aligned_alloc(ALIGNMENT, HEADER + size);
    if (!b) exhausted(a, bytes);
    if (size >= LARGE_BLOCK) pages_ask_large(b, HEADER + size);
    b->size = size;
    a->bytes += HEADER + size;
    size_t quarter = size / 4 / ALIGNMENT * ALIGNMENT;   /* sizes stay multiples of it, as aligned_alloc wants */
    a->next_size = size < STEADY_BLOCK ? 2 * size : size <= SIZE_MAX / 4 ? size + quarter : size;
    return b;
}

void *arena_alloc(Arena *a, size_t n, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(n, size, &bytes) || bytes > PTRDIFF_MAX - HEADER - ALIGNMENT) exhausted(a, SIZE_MAX);
    if (a->fail_after >= 0 && a->fail_after-- == 0) exhausted(a, bytes);
    bytes = bytes ? (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT : ALIGNMENT;
    if (!a->newest || a->newest->size - a->newest->used < bytes) {
        Block *b = block_new(a, bytes);
        b->older = a->newest;
        b->used = 0;
        a->newest = b;
    }
    void *p = (char *)a->newest + HEADER + a->newest->used;
    a->newest->used += bytes;
    return p;
}

void *arena_zalloc(Arena *a, size_t n, size_t size)
{
    void *p = arena_alloc(a, n, size);
    return memset(p, 0, n * size);
}

void *arena_copy(Arena *a, const void *data, size_t n, size_t size)
{
    void *p = arena_alloc(a, n, size);
    if (n * size > 0) memcpy(p, data, n * size);
    return p;
}

char *arena_strdup(Arena *a, const char *s) { return arena_copy(a, s, strlen(s) + 1, 1); }

char *arena_printf(Arena *a, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int n = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *s = arena_alloc(a, n < 0 ? 1 : (size_t)n + 1, 1);
    s[0] = '\0';
    if (n >= 0) vsnprintf(s, (size_t)n + 1, format, again);
    va_end(again);
    return s;
}

void *arena_grow(Arena *a, void *array, size_t n, size_t *capacity, size_t size)
{
    if (n < *capacity) return array;
    size_t larger = n < 4 ? 8 : n <= SIZE_MAX / 2 ? 2 * n : SIZE_MAX;
    void *p = arena_alloc(a, larger, size);
    if (n > 0) memcpy(p, array, n * size);
    *capacity = larger;
    return p;
}

ArenaMark arena_mark(const Arena *a)
{
    return (ArenaMark){ a->newest, a->newest ? a->newest->used : 0 };
}

void arena_reset(Arena *a, ArenaMark mark)
{
    while (a->newest != mark.block) {
        Block *b = a->newest;
        a->newest = b->older;
        bool is_larger = !a->spare || b->size > a->spare->size;
        drop_block(a, is_larger ? a->spare : b);
        if (is_larger) a->spare = b;
    }
    if (a->newest) a->newest->used = mark.used;
}

size_t arena_bytes(const Arena *a) { return a->bytes + (a->adopted ? arena_bytes(a->adopted) : 0); }

size_t arena_used(const Arena *a)
{
    size_t used = 0;
    for (const Block *b = a->newest; b; b = b->older) used += b->used;
    return used + (a->adopted ? arena_used(a->adopted) : 0);
}
