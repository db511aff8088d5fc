/* Axis-aligned boxes in float, rounded outward from double: a box always contains what it was made from.
 * An empty box has lo > hi and absorbs nothing in unions; an unbounded shape (a plane) has an infinite box. */
#ifndef TRIMRAY_BOX_H
#define TRIMRAY_BOX_H

#include "render/vec.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef struct { float lo[3], hi[3]; } Box;

Box box_empty(void);
Box box_infinite(void);
Box box_of_points(const Vec3 *points, int n);
Box box_from(Vec3 lo, Vec3 hi);                /* corners in any order */
Box box_around(Vec3 centre, Vec3 half);        /* centre - half to centre + half, half >= 0 */
Box box_union(Box a, Box b);
Box box_intersection(Box a, Box b);            /* may be empty */
Box box_add_point(Box b, Vec3 p);
Box box_expand(Box b, double by);              /* by >= 0, to every side, rounded outward */
Box box_moved(Box b, Vec3 by);                 /* rounded outward */
bool box_is_empty(Box b);
bool box_is_finite(Box b);                     /* not empty, every side finite */
bool box_contains(Box b, Vec3 p);
double box_area(Box b);                        /* 0 if empty; may be +inf */
Vec3 box_centre(Box b);
double box_diagonal(Box b);

/* The neighbour of a float that is not NaN: towards -INFINITY (up -1) or INFINITY (up 1). */
static inline float float_neighbour(float f, int up)
{
    int32_t bits;
    memcpy(&bits, &f, sizeof bits);
    if (f == 0) return up > 0 ? 0x1p-149f : -0x1p-149f;
    bits += (f > 0) == (up > 0) ? 1 : -1;
    memcpy(&f, &bits, sizeof f);
    return f;
}

/* The largest float <= x, the smallest >= x. */
static inline float float_down(double x) { float f = (float)x; return (double)f > x ? float_neighbour(f, -1) : f; }
static inline float float_up(double x) { float f = (float)x; return (double)f < x ? float_neighbour(f, 1) : f; }

/* What the slab test needs of a ray; made once per ray and tree. inverse[k] = 1 / dir[k] keeps the sign of zero. */
typedef struct { double origin[3], inverse[3]; int is_negative[3]; } BoxRay;
BoxRay box_ray(Vec3 origin, Vec3 dir);

/* Does the ray meet the box in [t_min, t_max]? Conservative: the interval is widened by the rounding error of the slabs, so
 * that a ray that touches the box in exact arithmetic is never turned away. *t_enter gets a lower bound of the entry,
 * clamped to t_min. */
bool box_hit(const Box *b, const BoxRay *r, double t_min, double t_max, double *t_enter);

#endif
