/* Large pages, where the system has them: the first touch of each page of new memory is a trap into the system. */
#ifndef TRIMRAY_PAGES_H
#define TRIMRAY_PAGES_H

#include <stddef.h>
#include <stdint.h>
#include <sys/mman.h>

/* Asks for them in whatever whole pages lie in the memory; worth it from some megabytes on. May do nothing. */
static inline void pages_ask_large(void *memory, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    static const uintptr_t PAGE = 4096;
    uintptr_t from = ((uintptr_t)memory + PAGE - 1) / PAGE * PAGE, to = ((uintptr_t)memory + bytes) / PAGE * PAGE;
    if (to > from) (void)madvise((void *)from, to - from, MADV_HUGEPAGE);
#else
    (void)memory, (void)bytes;
#endif
}

#endif
