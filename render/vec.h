/* Small vectors by value. Everything that has coordinates uses these; nothing else in the program defines a vector. */
#ifndef TRIMRAY_VEC_H
#define TRIMRAY_VEC_H

#include <math.h>
#include <stdbool.h>

/* The smaller, the larger: one instruction each, where fmin and fmax are calls. If one is NaN, the result is b. */
static inline double double_min(double a, double b) { return a < b ? a : b; }
static inline double double_max(double a, double b) { return a > b ? a : b; }
static inline int int_min(int a, int b) { return a < b ? a : b; }
static inline int int_max(int a, int b) { return a > b ? a : b; }

typedef struct { double x, y; } Vec2;
typedef struct { double x, y, z; } Vec3;
typedef struct { double x, y, z, w; } Vec4;   /* a point: {x, y, z, weight}; homogeneous: {wx, wy, wz, w} */

static inline Vec3 vec(double x, double y, double z) { return (Vec3){ x, y, z }; }
static inline Vec3 vec_add(Vec3 a, Vec3 b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec_sub(Vec3 a, Vec3 b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec_mul(Vec3 a, Vec3 b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline Vec3 vec_scale(Vec3 a, double s) { return vec(a.x * s, a.y * s, a.z * s); }
static inline Vec3 vec_neg(Vec3 a) { return vec(-a.x, -a.y, -a.z); }
static inline double vec_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec3 vec_cross(Vec3 a, Vec3 b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vec_length2(Vec3 a) { return vec_dot(a, a); }
static inline double vec_length(Vec3 a) { return sqrt(vec_length2(a)); }
static inline bool vec_is_same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }   /* to the last bit */
static inline double vec_max_abs(Vec3 a)          /* components that are NaN count for nothing */
{
    return double_max(fabs(a.x), double_max(fabs(a.y), double_max(fabs(a.z), 0)));
}
static inline int vec_is_finite(Vec3 a) { return a.x * 0 + a.y * 0 + a.z * 0 == 0; }   /* inf * 0 is not a number */

/* a / |a| for any finite a, however large or small (scaled first, so that nothing over- or underflows); 0 stays 0. */
static inline Vec3 vec_normalize(Vec3 a)
{
    double l2 = vec_length2(a), m;
    if (l2 > 0x1p-960 && l2 < 0x1p960) return vec_scale(a, 1 / sqrt(l2));
    m = vec_max_abs(a);
    if (!(m > 0) || isinf(m)) return a;
    int e;
    (void)frexp(m, &e);
    Vec3 s = vec(ldexp(a.x, -e), ldexp(a.y, -e), ldexp(a.z, -e));
    return vec_scale(s, 1 / vec_length(s));
}

static inline Vec2 vec2(double x, double y) { return (Vec2){ x, y }; }
static inline Vec2 vec2_add(Vec2 a, Vec2 b) { return vec2(a.x + b.x, a.y + b.y); }
static inline Vec2 vec2_sub(Vec2 a, Vec2 b) { return vec2(a.x - b.x, a.y - b.y); }
static inline Vec2 vec2_scale(Vec2 a, double s) { return vec2(a.x * s, a.y * s); }
static inline double vec2_dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
static inline double vec2_cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
static inline double vec2_length(Vec2 a) { return hypot(a.x, a.y); }
/* The longer axis, of length 1, of the symmetric matrix (xx, xy; xy, yy): its eigenvector of the greater eigenvalue. */
static inline Vec2 vec2_longer_axis(double xx, double xy, double yy)
{
    double angle = 0.5 * atan2(2 * xy, xx - yy);
    return vec2(cos(angle), sin(angle));
}

static inline Vec4 vec4(double x, double y, double z, double w) { return (Vec4){ x, y, z, w }; }
static inline Vec4 vec4_add(Vec4 a, Vec4 b) { return vec4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w); }
static inline Vec4 vec4_sub(Vec4 a, Vec4 b) { return vec4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w); }
static inline Vec4 vec4_scale(Vec4 a, double s) { return vec4(a.x * s, a.y * s, a.z * s, a.w * s); }
static inline Vec4 vec4_lerp(Vec4 a, Vec4 b, double s)   /* (1-s) a + s b: exact at s = 0 and s = 1 */
{
    return vec4_add(vec4_scale(a, 1 - s), vec4_scale(b, s));
}
static inline Vec3 vec4_project(Vec4 a) { return vec(a.x / a.w, a.y / a.w, a.z / a.w); }   /* to Euclidean space */
static inline Vec4 vec4_weighted(Vec4 p) { return vec4(p.x * p.w, p.y * p.w, p.z * p.w, p.w); }   /* the reverse */

#endif
