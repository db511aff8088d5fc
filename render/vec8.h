/* Vectors of eight neighbouring rays or surfaces, component by component: vec.h's operations in the lanes of V8d. */
#ifndef TRIMRAY_VEC8_H
#define TRIMRAY_VEC8_H

#include "render/simd.h"

#include <stddef.h>

typedef struct { V8d x, y, z; } Vec3x8;

ALWAYS_INLINE Vec3x8 vec8_splat(Vec3 a) { return (Vec3x8){ v8d_splat(a.x), v8d_splat(a.y), v8d_splat(a.z) }; }
ALWAYS_INLINE Vec3x8 vec8_add(Vec3x8 a, Vec3x8 b) { return (Vec3x8){ a.x + b.x, a.y + b.y, a.z + b.z }; }
ALWAYS_INLINE Vec3x8 vec8_sub(Vec3x8 a, Vec3x8 b) { return (Vec3x8){ a.x - b.x, a.y - b.y, a.z - b.z }; }
ALWAYS_INLINE Vec3x8 vec8_scale(Vec3x8 a, V8d s) { return (Vec3x8){ a.x * s, a.y * s, a.z * s }; }
ALWAYS_INLINE V8d vec8_dot(Vec3x8 a, Vec3x8 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

ALWAYS_INLINE Vec3x8 vec8_cross(Vec3x8 a, Vec3x8 b)
{
    return (Vec3x8){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

ALWAYS_INLINE V8d vec8_max_abs(Vec3x8 a)          /* components that are NaN count for nothing */
{
    return v8d_max(v8d_abs(a.x), v8d_max(v8d_abs(a.y), v8d_max(v8d_abs(a.z), v8d_splat(0))));
}

static inline Vec3 vec8_get(const Vec3x8 *a, int i) { return vec(a->x[i], a->y[i], a->z[i]); }
static inline void vec8_set(Vec3x8 *a, int i, Vec3 v) { a->x[i] = v.x, a->y[i] = v.y, a->z[i] = v.z; }

/* The numbers, the vectors, so many bytes behind each of eight places. (They do not go through memory again: eight numbers
 * that were just stored one by one cannot be loaded as one vector before they have reached the cache.) */
ALWAYS_INLINE V8d v8d_gather(const void *const from[8], size_t offset)
{
    const char *const *p = (const char *const *)from;
#define AT(i) *(const double *)(p[i] + offset)
    return (V8d){ AT(0), AT(1), AT(2), AT(3), AT(4), AT(5), AT(6), AT(7) };
#undef AT
}

ALWAYS_INLINE Vec3x8 vec8_gather(const void *const from[8], size_t offset)
{
    return (Vec3x8){ v8d_gather(from, offset + offsetof(Vec3, x)), v8d_gather(from, offset + offsetof(Vec3, y)),
                     v8d_gather(from, offset + offsetof(Vec3, z)) };
}

/* As vec_normalize. */
ALWAYS_INLINE Vec3x8 vec8_normalize(Vec3x8 a)
{
    V8d length2 = vec8_dot(a, a);
    V8l is_plain = v8d_less(v8d_splat(0x1p-960), length2) & v8d_less(length2, v8d_splat(0x1p960));
    Vec3x8 unit = vec8_scale(a, 1 / v8d_sqrt(length2));
    if (__builtin_expect(v8l_mask(is_plain) != 0xFF, 0))
        for (int i = 0; i < 8; i++) vec8_set(&unit, i, vec_normalize(vec8_get(&a, i)));
    return unit;
}

#endif
