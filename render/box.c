/* Axis-aligned boxes: made in double, kept in float, rounded outward. */
#include "render/box.h"

#include <float.h>

Box box_infinite(void)
{
    return (Box){ { -INFINITY, -INFINITY, -INFINITY }, { INFINITY, INFINITY, INFINITY } };
}

Box box_of_points(const Vec3 *points, int n)
{
    Box b = box_empty();
    for (int i = 0; i < n; i++) b = box_add_point(b, points[i]);
    return b;
}

Box box_from(Vec3 lo, Vec3 hi) { return box_add_point(box_add_point(box_empty(), lo), hi); }

/* The double next to the rounded sum is beyond the exact one. */
Box box_around(Vec3 centre, Vec3 half)
{
    const double c[3] = { centre.x, centre.y, centre.z }, h[3] = { half.x, half.y, half.z };
    Box b;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = float_down(nextafter(c[k] - h[k], -INFINITY));
        b.hi[k] = float_up(nextafter(c[k] + h[k], INFINITY));
    }
    return b;
}

/* lo - by is rounded to nearest in double before it is rounded down to float: one step further down covers that. */
Box box_expand(Box b, double by)
{
    if (box_is_empty(b) || by == 0) return b;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = float_down(nextafter(b.lo[k] - by, -INFINITY));
        b.hi[k] = float_up(nextafter(b.hi[k] + by, INFINITY));
    }
    return b;
}

Box box_moved(Box b, Vec3 by)
{
    const double d[3] = { by.x, by.y, by.z };
    if (box_is_empty(b) || vec_max_abs(by) == 0) return b;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = float_down(nextafter(b.lo[k] + d[k], -INFINITY));
        b.hi[k] = float_up(nextafter(b.hi[k] + d[k], INFINITY));
    }
    return b;
}

bool box_is_finite(Box b)
{
    if (box_is_empty(b)) return false;
    for (int k = 0; k < 3; k++)
        if (!isfinite(b.lo[k]) || !isfinite(b.hi[k])) return false;
    return true;
}

bool box_contains(Box b, Vec3 p)
{
    return b.lo[0] <= p.x && p.x <= b.hi[0] && b.lo[1] <= p.y && p.y <= b.hi[1] && b.lo[2] <= p.z && p.z <= b.hi[2];
}

Vec3 box_centre(Box b)
{
    return vec(.5 * ((double)b.lo[0] + b.hi[0]), .5 * ((double)b.lo[1] + b.hi[1]), .5 * ((double)b.lo[2] + b.hi[2]));
}

double box_diagonal(Box b)
{
    if (box_is_empty(b)) return 0;
    return vec_length(vec((double)b.hi[0] - b.lo[0], (double)b.hi[1] - b.lo[1], (double)b.hi[2] - b.lo[2]));
}

BoxRay box_ray(Vec3 origin, Vec3 dir)
{
    BoxRay r = { { origin.x, origin.y, origin.z }, { 1 / dir.x, 1 / dir.y, 1 / dir.z }, { 0 } };
    for (int k = 0; k < 3; k++) r.is_negative[k] = signbit(r.inverse[k]) != 0;
    return r;
}

/* The slab method [KK86], with care at its edges:
 * - dir[k] = +-0: inverse is an infinity of that sign. A slab that holds the origin gives (-inf, inf); one that does not
 *   gives two infinities of one sign, and no hit. An origin in a face gives 0 * inf = NaN there, which the comparisons
 *   pass over: the face belongs to the box.
 * - (bound - origin) * inverse has three roundings, so a relative error of at most 3u + O(u^2), u = 2^-53; the products
 *   are moved outward by WIDEN = 8u of themselves, which covers the roundings of the move as well. */
bool box_hit(const Box *b, const BoxRay *r, double t_min, double t_max, double *t_enter)
{
    static const double WIDEN = 8 * 0x1p-53;
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
    enter -= fabs(enter) * WIDEN;
    leave += fabs(leave) * WIDEN;
    if (!(enter > t_min)) enter = t_min;
    if (!(leave < t_max)) leave = t_max;
    *t_enter = enter;
    return enter <= leave;
}
