/* Vectors for the few loops that decide the speed: the compiler's own vector types, one source for every machine. */
#ifndef TRIMRAY_SIMD_H
#define TRIMRAY_SIMD_H

#include "render/vec.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(undefined_behavior_sanitizer)
#define TRIMRAY_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TRIMRAY_SANITIZED
#endif

/* A function compiled for plain x86-64, for AVX2 and for AVX-512, chosen when the program starts. Sanitizers are not ready
 * that early; clang 14 gives clones a name that no other file can link to. */
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(TRIMRAY_SANITIZED) && !defined(__clang__)
#define EVERY_X86 __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define EVERY_X86
#endif
#define ALWAYS_INLINE static inline __attribute__((always_inline))

/* Four doubles; loaded from and stored to Vec4 wherever that lies. */
typedef double V4 __attribute__((vector_size(32)));
typedef double V4Unaligned __attribute__((vector_size(32), aligned(8), may_alias));

ALWAYS_INLINE V4 v4_load(const Vec4 *p) { return *(const V4Unaligned *)p; }
ALWAYS_INLINE void v4_store(Vec4 *p, V4 x) { *(V4Unaligned *)p = x; }
ALWAYS_INLINE V4 v4_splat(double x) { return (V4){ x, x, x, x }; }

/* a b + c, rounded once whatever the compiler does with products and sums elsewhere. */
ALWAYS_INLINE V4 v4_fma(V4 a, double b, V4 c)
{
    return (V4){ __builtin_fma(a[0], b, c[0]), __builtin_fma(a[1], b, c[1]), __builtin_fma(a[2], b, c[2]),
                 __builtin_fma(a[3], b, c[3]) };
}

#endif
