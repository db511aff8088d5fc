/* malloc and its family, counting what is held: every library of the process comes through here. What they map themselves they must
 * tell (Embree does). glibc only; elsewhere everything counts as nothing. */
#include "tests/bench/bench.h"

#include <errno.h>
#include <malloc.h>
#include <stdatomic.h>

static _Atomic size_t now, peak;

size_t memory_now(void) { return now; }
size_t memory_peak(void) { return peak; }
void memory_reset_peak(void) { peak = now; }

#if defined(__GLIBC__)
void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
void __libc_free(void *);

static void *counted(void *p)
{
    size_t held = now += p ? malloc_usable_size(p) : 0;
    if (held > peak) peak = held;
    return p;
}

static void uncount(void *p) { now -= p ? malloc_usable_size(p) : 0; }

void *malloc(size_t n) { return counted(__libc_malloc(n)); }
void *calloc(size_t n, size_t size) { return counted(__libc_calloc(n, size)); }
void *memalign(size_t alignment, size_t n) { return counted(__libc_memalign(alignment, n)); }
void *aligned_alloc(size_t alignment, size_t n) { return counted(__libc_memalign(alignment, n)); }

int posix_memalign(void **out, size_t alignment, size_t n)
{
    void *p = memalign(alignment, n);
    if (!p) return ENOMEM;
    *out = p;
    return 0;
}

void *realloc(void *p, size_t n)
{
    size_t before = p ? malloc_usable_size(p) : 0;
    void *q = __libc_realloc(p, n);
    if (!q && n > 0) return NULL;
    now -= before;
    return counted(q);
}

void free(void *p)
{
    uncount(p);
    __libc_free(p);
}
#endif
