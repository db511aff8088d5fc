/* Vectors for the few loops that decide the speed: the compiler's own vector types, one source for every machine. */
#ifndef TRIMRAY_SIMD_H
#define TRIMRAY_SIMD_H

#include "render/vec.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

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

typedef long long V4l __attribute__((vector_size(32)));
ALWAYS_INLINE V4 v4_min(V4 a, V4 b)
{
    V4l less = a < b;
    return (V4)(((V4l)a & less) | ((V4l)b & ~less));
}
ALWAYS_INLINE V4 v4_max(V4 a, V4 b) { return -v4_min(-a, -b); }

/* Eight floats, eight doubles made of them, and what comparisons of them give. */
typedef float V8f __attribute__((vector_size(32)));
typedef int V8i __attribute__((vector_size(32)));
typedef float V8fUnaligned __attribute__((vector_size(32), aligned(4), may_alias));
typedef signed char V8c __attribute__((vector_size(8)));
typedef double V8d __attribute__((vector_size(64)));
typedef long long V8l __attribute__((vector_size(64)));

ALWAYS_INLINE V8f v8f_load(const float *p) { return *(const V8fUnaligned *)p; }
ALWAYS_INLINE V8d v8d_load(const float *p) { return __builtin_convertvector(v8f_load(p), V8d); }

/* As integers: of eight equal floats gcc 12 makes six instructions in a function that is compiled for several machines. */
ALWAYS_INLINE V8f v8f_splat(float x)
{
    int bits;
    memcpy(&bits, &x, sizeof bits);
    return (V8f)(V8i){ bits, bits, bits, bits, bits, bits, bits, bits };
}

/* Lane i as byte i, the least significant first. */
ALWAYS_INLINE uint64_t v8_bytes(V8c a)
{
    uint64_t all;
    memcpy(&all, &a, sizeof all);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    all = __builtin_bswap64(all);
#endif
    return all;
}

/* Bit i: is lane i of the comparison true? Byte i keeps its bit i alone, and the product sums the bytes into the highest. */
ALWAYS_INLINE unsigned v8_mask(V8c truth)
{
    return (unsigned)((v8_bytes(truth) & 0x8040201008040201u) * 0x0101010101010101u >> 56);
}

/* ---- eight doubles ----
 *
 * Comparisons and choices are written lane by lane: gcc 12 makes one instruction of each such loop, and eight of the
 * operators, whose results it has no register for with AVX-512. */
typedef double V8dUnaligned __attribute__((vector_size(64), aligned(8), may_alias));

ALWAYS_INLINE V8d v8d_load_doubles(const double *p) { return *(const V8dUnaligned *)p; }
ALWAYS_INLINE V8d v8d_splat(double x) { return (V8d){ x, x, x, x, x, x, x, x }; }

/* Are they one register where functions are compiled for every machine? Else they lie in memory, and eight lanes take longer
 * than one after the other. (With sanitizers they go the way that they go without.) */
static inline bool v8d_is_one_register(void)
{
#if defined(TRIMRAY_SANITIZED) || defined(__AVX512F__)
    return true;
#elif defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
    return __builtin_cpu_supports("x86-64-v4");
#else
    return false;
#endif
}

/* Lanes are all ones where it is true. */
ALWAYS_INLINE V8l v8d_less(V8d a, V8d b)
{
    V8l out;
    for (int i = 0; i < 8; i++) out[i] = a[i] < b[i] ? -1 : 0;
    return out;
}

ALWAYS_INLINE V8f v8f_select(V8i truth, V8f a, V8f b) { return (V8f)((truth & (V8i)a) | (~truth & (V8i)b)); }
ALWAYS_INLINE V8d v8d_select(V8l truth, V8d a, V8d b) { return (V8d)((truth & (V8l)a) | (~truth & (V8l)b)); }

/* If one is NaN, the result is b, as double_min and double_max have it. (Here a loop is not always made one instruction, and
 * the operator is.) */
ALWAYS_INLINE V8d v8d_min(V8d a, V8d b) { return v8d_select(a < b, a, b); }
ALWAYS_INLINE V8d v8d_max(V8d a, V8d b) { return v8d_select(a > b, a, b); }

ALWAYS_INLINE V8d v8d_sqrt(V8d a)
{
    V8d out;
    for (int i = 0; i < 8; i++) out[i] = sqrt(a[i]);
    return out;
}

ALWAYS_INLINE V8d v8d_abs(V8d a) { return (V8d)((V8l)a & INT64_MAX); }

/* Bit i: is lane i true? And the reverse. */
ALWAYS_INLINE unsigned v8l_mask(V8l truth) { return v8_mask(__builtin_convertvector(truth, V8c)); }
ALWAYS_INLINE V8l v8l_truth(unsigned mask)
{
    const V8l to_sign = { 63, 62, 61, 60, 59, 58, 57, 56 };
    long long all = mask;
    return (V8l){ all, all, all, all, all, all, all, all } << to_sign >> 63;
}

ALWAYS_INLINE V8l v8d_at_most(V8d a, V8d b)
{
    V8l out;
    for (int i = 0; i < 8; i++) out[i] = a[i] <= b[i] ? -1 : 0;
    return out;
}

#endif
