/* Straight pieces. See trim_piece.h. */
#include "nurbs/trim_piece.h"

#include <float.h>

/* Adds x to the expansion of n doubles that do not overlap, ascending ([She97] Grow-Expansion); returns n + 1. */
static int grow(double e[], int n, double x)
{
    for (int i = 0; i < n; i++) {
        double sum = x + e[i], part = sum - x;
        e[i] = (x - (sum - part)) + (e[i] - part);
        x = sum;
    }
    e[n] = x;
    return n + 1;
}

static int grow_product(double e[], int n, double x, double y)
{
    double product = x * y;
    n = grow(e, n, fma(x, y, -product));
    return grow(e, n, product);
}

/* a x b + b x p + p x a, without rounding. */
static int side_exact(Vec2 a, Vec2 b, Vec2 p)
{
    double e[12];
    int n = 0;
    n = grow_product(e, n, a.x, b.y), n = grow_product(e, n, -a.y, b.x);
    n = grow_product(e, n, b.x, p.y), n = grow_product(e, n, -b.y, p.x);
    n = grow_product(e, n, p.x, a.y), n = grow_product(e, n, -p.y, a.x);
    for (int i = n - 1; i >= 0; i--) {
        if (e[i] != 0) return e[i] > 0 ? 1 : -1;
    }
    return 0;
}

int trim_side(Vec2 a, Vec2 b, Vec2 p)
{
    const double u = DBL_EPSILON / 2;
    double left = (b.x - a.x) * (p.y - a.y), right = (b.y - a.y) * (p.x - a.x);
    double det = left - right, bound = (3 + 16 * u) * u * (fabs(left) + fabs(right));   /* [She97] ccwerrboundA */
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return side_exact(a, b, p);
}

Vec2 trim_piece_nearest(Vec2 a, Vec2 b, Vec2 p)
{
    Vec2 ab = vec2_sub(b, a);
    double along = vec2_dot(vec2_sub(p, a), ab), length2 = vec2_dot(ab, ab);
    if (!(along > 0)) return a;
    return along < length2 ? vec2_add(a, vec2_scale(ab, along / length2)) : b;
}

bool trim_piece_meets_rect(Vec2 a, Vec2 b, TrimRect r)
{
    if (!trim_rects_meet(trim_rect_of(a, b), r)) return false;
    int s = trim_side(a, b, vec2(r.u0, r.v0));
    return s == 0 || s != trim_side(a, b, vec2(r.u1, r.v0)) || s != trim_side(a, b, vec2(r.u0, r.v1))
        || s != trim_side(a, b, vec2(r.u1, r.v1));
}

bool trim_pieces_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
    return trim_rects_meet(trim_rect_of(a, b), trim_rect_of(c, d))
        && trim_side(a, b, c) * trim_side(a, b, d) <= 0 && trim_side(c, d, a) * trim_side(c, d, b) <= 0;
}
