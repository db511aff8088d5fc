/* malloc and its family, counting what is held: every library of the process comes through here. What they map themselves
 * they must tell (Embree does). glibc only; elsewhere, and under sanitizers, everything counts as nothing. */
#include "tests/bench/bench.h"

#include <errno.h>
#include <malloc.h>
#include <stdatomic.h>

static _Atomic size_t now, peak;

size_t memory_now(void) { return now; }
size_t memory_peak(void) { return peak; }
void memory_reset_peak(void) { peak = now; }

#if defined(__has_feature)
#define IS_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#else
#define IS_SANITIZED 0
#endif

#if defined(__GLIBC__) && !IS_SANITIZED
void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
void __libc_free(void *);

static void *counted(void *p)
{
    now += p ? malloc_usable_size(p) : 0;
    if (now > peak) peak = now;
    return p;
}

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
    now -= p ? malloc_usable_size(p) : 0;
    __libc_free(p);
}
#endif
