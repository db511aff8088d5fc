/* A ray and a paraboloid: inlined into its caller, as patch_kernel.h is. */
#ifndef TRIMRAY_PARABOLOID_KERNEL_H
#define TRIMRAY_PARABOLOID_KERNEL_H

#include "nurbs/paraboloid.h"
#include "render/simd.h"

/* What certify.c has of a ray and a tile: the planes' normals N, q = N.(o - middle), C = N.(half_s half_t), their
 * determinant, and the rounding of all. */
typedef struct { Vec3 n1, n2; double q1, q2, c11, c12, c21, c22, det, rounding; } SeenTile;

typedef struct { double lo, hi; } Span;

/* The least and the most of a x + b x^2 on [-1, 1]. */
ALWAYS_INLINE Span paraboloid_span(double a, double b)
{
    double x = fabs(a), y = fabs(b), far = x + y, near = 2 * y > x ? -0.25 * x * x / y : y - x;
    return b < 0 ? (Span){ -far, -near } : (Span){ near, far };
}

/* Is a x + b x^2 + c xy + d y^2 nowhere on the square within `slack` of the value? */
ALWAYS_INLINE bool paraboloid_is_beyond(double value, double a, double b, double c, double d, double slack)
{
    Span along = paraboloid_span(a, b);
    double lo = along.lo + double_min(d, 0) - fabs(c), hi = along.hi + double_max(d, 0) + fabs(c);
    return value > hi + slack || value < lo - slack;
}

typedef struct { double x, y; } Seen;

ALWAYS_INLINE Seen paraboloid_seen(const SeenTile *k, const float x[3])
{
    return (Seen){ vec_dot(k->n1, tile_vec(x)), vec_dot(k->n2, tile_vec(x)) };
}

/* Does it show that the ray misses the tile? A root satisfies C (x, y) = q - N.(at + x^2 ss + xy st + y^2 tt + r), and by
 * Cramer's rule x det C and y det C are what that makes of either side. */
ALWAYS_INLINE bool paraboloid_is_missed(const Paraboloid *f, const SeenTile *k)
{
    Seen at = paraboloid_seen(k, f->at), ss = paraboloid_seen(k, f->ss), st = paraboloid_seen(k, f->st);
    Seen tt = paraboloid_seen(k, f->tt);
    double q1 = k->q1 - at.x, q2 = k->q2 - at.y, slack = f->deviation + k->rounding;
    double c11 = k->c11, c12 = k->c12, c21 = k->c21, c22 = k->c22;
    return paraboloid_is_beyond(q1 * c22 - q2 * c12, k->det, ss.x * c22 - ss.y * c12, st.x * c22 - st.y * c12,
                                tt.x * c22 - tt.y * c12, slack * sqrt(c12 * c12 + c22 * c22))
        || paraboloid_is_beyond(q2 * c11 - q1 * c21, k->det, tt.y * c11 - tt.x * c21, st.y * c11 - st.x * c21,
                                ss.y * c11 - ss.x * c21, slack * sqrt(c11 * c11 + c21 * c21));
}

#endif
