/* Memory that is freed together. A scene has one arena, a shape that is prepared late has its own, a thread has a scratch
 * arena with marks. An arena belongs to one thread at a time. Blocks come from malloc and double in size. */
#ifndef TRIMRAY_ARENA_H
#define TRIMRAY_ARENA_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Arena Arena;
typedef struct { void *block; size_t used; } ArenaMark;

/* Called when memory is exhausted or a size overflows; must not return (exit, longjmp). `bytes` is what was asked for. */
typedef void (*ArenaExhausted)(void *context, size_t bytes);

Arena *arena_new(void);                            /* never NULL: calls the default handler (message, exit 3) instead */
void arena_free(Arena *a);                         /* all of it; NULL is allowed */
void arena_on_exhausted(Arena *a, ArenaExhausted handler, void *context);   /* NULL: the default handler */
void arena_fail_after(Arena *a, long n);           /* tests: the n-th allocation from now fails; -1: none */

/* Memory aligned for any type (64 bytes), not cleared. Never NULL. n * size is checked for overflow. */
void *arena_alloc(Arena *a, size_t n, size_t size);
void *arena_zalloc(Arena *a, size_t n, size_t size);           /* the same, cleared */
void *arena_copy(Arena *a, const void *data, size_t n, size_t size);
char *arena_strdup(Arena *a, const char *s);
char *arena_printf(Arena *a, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Makes room for one more element in a growing array of *capacity elements of `size` bytes, n in use: returns the array,
 * moved if it had to grow (the old copy stays in the arena until the end: growth doubles, so that waste is bounded by
 * 1x). */
void *arena_grow(Arena *a, void *array, size_t n, size_t *capacity, size_t size);

ArenaMark arena_mark(const Arena *a);
void arena_reset(Arena *a, ArenaMark mark);        /* gives back everything allocated since the mark */
void arena_adopt(Arena *a, Arena *other);          /* which is freed with a, and part of it from now on; NULL: nothing */
size_t arena_bytes(const Arena *a);                /* bytes held from malloc */
size_t arena_used(const Arena *a);                 /* of these, allocated since */

#define ARENA_NEW(a, T) ((T *)arena_zalloc((a), 1, sizeof(T)))
#define ARENA_ARRAY(a, T, n) ((T *)arena_alloc((a), (size_t)(n), sizeof(T)))
/* ARENA_PUSH(a, list, n, capacity) = value; with T *list; size_t n, capacity. */
#define ARENA_PUSH(a, list, n, capacity) \
    (*((list) = arena_grow((a), (list), (n), &(capacity), sizeof *(list)), &(list)[(n)++]))

#endif
