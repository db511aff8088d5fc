/* See pole.h.
 *
 * Let t run from the side, and F be the two plane equations times the weight, of degree n in t. Where F(s, 0) = 0, F = t G:
 * by B_j,n(t) = t n/j B_j-1,n-1(t), G is of degree n - 1 in t and has the coefficients F_ij n/j, j from 1 to n. If e.G is at
 * least m for a direction e, by the convex hull of these, |F| >= t m. What F(s, 0) really is may be twice the error times
 * the weight in either equation, and F is off by as much once: so there is no root where t m is more than four times that. */
#include "nurbs/pole.h"

#include <math.h>

static const PoleSide SIDES[4] = { { false, false }, { false, true }, { true, false }, { true, true } };

static bool is_on_side(TilePlace at, PoleSide side)
{
    double from = side.is_t ? at.t0 : at.s0, width = side.is_t ? at.dt : at.ds;
    return side.is_end ? from + width >= 1 : from <= 0;
}

static double largest(double x, double y) { return double_max(fabs(x), fabs(y)); }

Vec3 pole_of(const Patch *p, PoleSide side)
{
    int last = side.is_t ? (p->k_v - 1) * p->k_u : p->k_u - 1;
    return vec4_project(p->p[side.is_end ? last : 0]);
}

int pole_sides(const Patch *p, TilePlace place, PoleSide *side)
{
    int n = 0;
    for (int i = 0; i < 4; i++)
        if (p->collapsed & 1u << i && is_on_side(place, SIDES[i])) *side = SIDES[i], n++;
    return n;
}

bool pole_is_met(const Tile *f, const PatchRay *r, PoleSide *side)
{
    const Patch *p = f->patch;
    Vec3 o = vec_sub(r->origin, p->origin);
    for (int i = 0; i < 4 && p->collapsed; i++) {
        if (!(p->collapsed & 1u << i) || !is_on_side(tile_place(f), SIDES[i])) continue;
        Vec3 pole = vec_sub(pole_of(p, SIDES[i]), o);
        *side = SIDES[i];
        if (largest(vec_dot(r->n1, pole), vec_dot(r->n2, pole)) <= patch_rounding(p, o)) return true;
    }
    return false;
}

/* Coefficient i along the side, in line j from it. */
static const Vec4 *coefficient(const View *v, PoleSide side, int i, int j)
{
    int last = side.is_t ? v->k_v - 1 : v->k_u - 1, line = side.is_end ? last - j : j;
    return side.is_t ? v->p + line * v->k_u + i : v->p + i * v->k_u + line;
}

/* Shares of the box's width: of more the pole is not told from its neighbourhood at once (that is an error of a thousandth of
 * the box, where rounding mostly is 2^-40 of it); and the least, that has eight bits to be evaluated in, beside 1. */
#define POLE_MOST 0x1p-10
#define POLE_LEAST 0x1p-44

bool pole_has_all(View *v, PoleSide side, double error)
{
    int n_along = side.is_t ? v->k_u : v->k_v, n = (side.is_t ? v->k_v : v->k_u) - 1;
    double least = INFINITY, w_max = 0;
    Vec2 sum = { 0, 0 };
    for (int i = 0; i < n_along; i++)
        for (int j = 1; j <= n; j++) {
            const Vec4 *f = coefficient(v, side, i, j);
            sum = vec2(sum.x + f->x * n / j, sum.y + f->y * n / j);
        }
    Vec2 e = vec2_scale(sum, 1 / vec2_length(sum));
    for (int i = 0; i < n_along; i++)
        for (int j = 0; j <= n; j++) {
            const Vec4 *f = coefficient(v, side, i, j);
            w_max = double_max(w_max, f->w);
            if (j > 0) least = double_min(least, (e.x * f->x + e.y * f->y) * n / j);
            else if (largest(f->x, f->y) > 2 * error * f->w) return false;
        }
    double part = 4 * error * w_max / least;
    if (!(least > 0 && part < POLE_MOST)) return false;
    part = double_max(part, POLE_LEAST);
    view_restrict(v, !side.is_t, side.is_end ? (Range){ 1 - part, 1 } : (Range){ 0, part });
    return true;
}
