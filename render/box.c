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
        b.lo[k] = float_down(double_neighbour(c[k] - h[k], -1));
        b.hi[k] = float_up(double_neighbour(c[k] + h[k], 1));
    }
    return b;
}

/* lo - by is rounded to nearest in double before it is rounded down to float: one step further down covers that. */
Box box_expand(Box b, double by)
{
    if (box_is_empty(b) || by == 0) return b;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = float_down(double_neighbour(b.lo[k] - by, -1));
        b.hi[k] = float_up(double_neighbour(b.hi[k] + by, 1));
    }
    return b;
}

Box box_moved(Box b, Vec3 by)
{
    const double d[3] = { by.x, by.y, by.z };
    if (box_is_empty(b) || vec_max_abs(by) == 0) return b;
    for (int k = 0; k < 3; k++) {
        b.lo[k] = float_down(double_neighbour(b.lo[k] + d[k], -1));
        b.hi[k] = float_up(double_neighbour(b.hi[k] + d[k], 1));
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
