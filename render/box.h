/* Axis-aligned boxes in float, rounded outward from double: a box always contains what it was made from.
 * An empty box has lo > hi and absorbs nothing in unions; an unbounded shape (a plane) has an infinite box. */
#ifndef TRIMRAY_BOX_H
#define TRIMRAY_BOX_H

#include "render/vec.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef struct { float lo[3], hi[3]; } Box;

Box box_infinite(void);
Box box_of_points(const Vec3 *points, int n);
Box box_from(Vec3 lo, Vec3 hi);                /* corners in any order */
Box box_around(Vec3 centre, Vec3 half);        /* centre - half to centre + half, half >= 0 */
Box box_expand(Box b, double by);              /* by >= 0, to every side, rounded outward */
Box box_moved(Box b, Vec3 by);                 /* rounded outward */
bool box_is_finite(Box b);                     /* not empty, every side finite */
bool box_contains(Box b, Vec3 p);
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

/* The same of a double, without a call; infinite ones and NaN stay as they are. */
static inline double double_neighbour(double x, int up)
{
    int64_t bits;
    memcpy(&bits, &x, sizeof bits);
    if (x == 0) return up > 0 ? 0x1p-1074 : -0x1p-1074;
    if (!(fabs(x) < INFINITY)) return x;
    bits += (x > 0) == (up > 0) ? 1 : -1;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The largest float <= x, the smallest >= x. */
static inline float float_down(double x) { float f = (float)x; return (double)f > x ? float_neighbour(f, -1) : f; }
static inline float float_up(double x) { float f = (float)x; return (double)f < x ? float_neighbour(f, 1) : f; }

/* Building trees asks for these as often as there are boxes, times the depth. */
static inline Box box_empty(void)
{
    return (Box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

static inline bool box_is_empty(Box b) { return !(b.lo[0] <= b.hi[0] && b.lo[1] <= b.hi[1] && b.lo[2] <= b.hi[2]); }

static inline Box box_union(Box a, Box b)
{
    for (int k = 0; k < 3; k++) {
        a.lo[k] = b.lo[k] < a.lo[k] ? b.lo[k] : a.lo[k];
        a.hi[k] = b.hi[k] > a.hi[k] ? b.hi[k] : a.hi[k];
    }
    return a;
}

static inline Box box_intersection(Box a, Box b)      /* may be empty */
{
    for (int k = 0; k < 3; k++) {
        a.lo[k] = b.lo[k] > a.lo[k] ? b.lo[k] : a.lo[k];
        a.hi[k] = b.hi[k] < a.hi[k] ? b.hi[k] : a.hi[k];
    }
    return a;
}

static inline Box box_add_point(Box b, Vec3 p)        /* coordinates that are no numbers count for nothing */
{
    const double c[3] = { p.x, p.y, p.z };
    for (int k = 0; k < 3; k++) {
        float down = float_down(c[k]), up = float_up(c[k]);
        b.lo[k] = down < b.lo[k] ? down : b.lo[k];
        b.hi[k] = up > b.hi[k] ? up : b.hi[k];
    }
    return b;
}

static inline double box_area(Box b)                  /* 0 if empty; may be +inf */
{
    if (box_is_empty(b)) return 0;
    double x = (double)b.hi[0] - b.lo[0], y = (double)b.hi[1] - b.lo[1], z = (double)b.hi[2] - b.lo[2];
    return isfinite(x + y + z) ? 2 * (x * y + y * z + z * x) : INFINITY;
}

/* What the slab test needs of a ray; made once per ray and tree. inverse[k] = 1 / dir[k] keeps the sign of zero. */
typedef struct { double origin[3], inverse[3]; int is_negative[3]; } BoxRay;
static inline BoxRay box_ray(Vec3 origin, Vec3 dir)
{
    BoxRay r = { { origin.x, origin.y, origin.z }, { 1 / dir.x, 1 / dir.y, 1 / dir.z }, { 0 } };
    for (int k = 0; k < 3; k++) r.is_negative[k] = signbit(r.inverse[k]) != 0;
    return r;
}

/* Does the ray meet the box in [t_min, t_max]? Conservative: the interval is widened by the rounding error of the slabs, so
 * that a ray that touches the box in exact arithmetic is never turned away. *t_enter gets a lower bound of the entry,
 * clamped to t_min.
 *
 * The slab method [KK86], with care at its edges:
 * - dir[k] = +-0: inverse is an infinity of that sign. A slab that holds the origin gives (-inf, inf); one that does not
 *   gives two infinities of one sign, and no hit. An origin in a face gives 0 * inf = NaN there, which the comparisons
 *   pass over: the face belongs to the box.
 * - (bound - origin) * inverse has three roundings, so a relative error of at most 3u + O(u^2), u = 2^-53; the products
 *   are moved outward by BOX_WIDEN = 8u of themselves, which covers the roundings of the move as well. */
#define BOX_WIDEN (8 * 0x1p-53)
static inline bool box_hit(const Box *b, const BoxRay *r, double t_min, double t_max, double *t_enter)
{
    double enter = -INFINITY, leave = INFINITY;
    for (int k = 0; k < 3; k++) {
        double near_bound = r->is_negative[k] ? b->hi[k] : b->lo[k];
        double far_bound = r->is_negative[k] ? b->lo[k] : b->hi[k];
        double near_t = (near_bound - r->origin[k]) * r->inverse[k];
        double far_t = (far_bound - r->origin[k]) * r->inverse[k];
        if (near_t > enter) enter = near_t;
        if (far_t < leave) leave = far_t;
    }
    if (!(enter < INFINITY && leave > -INFINITY)) return false;
    enter -= fabs(enter) * BOX_WIDEN;
    leave += fabs(leave) * BOX_WIDEN;
    if (!(enter > t_min)) enter = t_min;
    if (!(leave < t_max)) leave = t_max;
    *t_enter = enter;
    return enter <= leave;
}

#endif
