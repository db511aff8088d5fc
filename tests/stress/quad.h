/* Numbers with some 113 bits, for truths: vectors, affine maps, polynomials in the ray's parameter and their real roots. */
#ifndef TRIMRAY_STRESS_QUAD_H
#define TRIMRAY_STRESS_QUAD_H

#include "render/vec.h"

#include <stdbool.h>

#if defined(__SIZEOF_FLOAT128__)
typedef __float128 Quad;
#else
typedef long double Quad;   /* 113 bits on the machines that have no __float128 */
#endif

#define QUAD_EPSILON ((Quad)0x1p-112L)

typedef struct { Quad x, y, z; } Quad3;
typedef struct { Quad x, y, z, w; } Quad4;   /* homogeneous: {wx, wy, wz, w} */

static inline Quad quad_abs(Quad a) { return a < 0 ? -a : a; }
static inline Quad quad_max(Quad a, Quad b) { return a > b ? a : b; }
static inline Quad quad_min(Quad a, Quad b) { return a < b ? a : b; }
static inline Quad quad_sqrt(Quad a)   /* two steps of Heron's from 64 bits (or 53) */
{
    if (!(a > 0)) return 0;
    Quad x = sqrtl((long double)a);
    if (!(x > 0)) return 0;
    x = (x + a / x) / 2;
    return (x + a / x) / 2;
}

static inline Quad3 quad3(Quad x, Quad y, Quad z) { return (Quad3){ x, y, z }; }
static inline Quad3 quad3_of(Vec3 a) { return (Quad3){ a.x, a.y, a.z }; }
static inline Vec3 quad3_round(Quad3 a) { return vec((double)a.x, (double)a.y, (double)a.z); }
static inline Quad3 quad3_add(Quad3 a, Quad3 b) { return quad3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Quad3 quad3_sub(Quad3 a, Quad3 b) { return quad3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Quad3 quad3_scale(Quad3 a, Quad s) { return quad3(a.x * s, a.y * s, a.z * s); }
static inline Quad quad3_dot(Quad3 a, Quad3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Quad quad3_length(Quad3 a) { return quad_sqrt(quad3_dot(a, a)); }
static inline Quad3 quad3_cross(Quad3 a, Quad3 b)
{
    return quad3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* p -> x p.x + y p.y + z p.z + o: its columns. */
typedef struct { Quad3 x, y, z, o; } QuadMap;
static inline Quad3 quad_map_vector(const QuadMap *m, Quad3 v)
{
    return quad3_add(quad3_add(quad3_scale(m->x, v.x), quad3_scale(m->y, v.y)), quad3_scale(m->z, v.z));
}
static inline Quad3 quad_map_point(const QuadMap *m, Quad3 p) { return quad3_add(quad_map_vector(m, p), m->o); }
QuadMap quad_map_inverse(const QuadMap *m);                   /* not singular */
Quad3 quad_map_normal(const QuadMap *inverse, Quad3 n);       /* the inverse's transpose times n */

#define POLY_MAX 8           /* degree */
typedef struct { int n; Quad c[POLY_MAX + 1]; } Poly;         /* degree n: c[0] + c[1] s + ... */
static inline Poly poly_line(Quad at, Quad slope) { return (Poly){ 1, { at, slope } }; }
static inline Poly poly_constant(Quad a) { return (Poly){ 0, { a } }; }
Poly poly_add(Poly a, Poly b);
Poly poly_scale(Poly a, Quad s);
Poly poly_mul(Poly a, Poly b);                                /* the degrees must not add up to more than POLY_MAX */
Poly poly_derivative(Poly a);
Quad poly_at(const Poly *a, Quad s);

/* The places in (lo, hi), ascending, where a changes sign or touches zero; a touch may be missed by rounding, as may a
 * pair of roots that is closer than it: who cares looks at the roots of the derivative too. Room for a.n. */
int poly_roots(const Poly *a, Quad lo, Quad hi, Quad out[]);

/* The same, given these places of the derivative. */
int poly_roots_between(const Poly *a, Quad lo, Quad hi, const Quad critical[], int n_critical, Quad out[]);

#endif
