/* Tiles and their frames: bounds that are computed once, so that a ray is decided by some forty operations.
 *
 * deviation   bounds the distance between the tile and a parallelogram of its derivatives at the middle, which lies where
 *             the tile bends away from it to both sides alike. With L its map, w (S - L) is a polynomial of one degree more
 *             in s and in t; its Bernstein coefficients bound it ([Far02] convex hull property), the least weight bounds w.
 * turn and    bound how far the Jacobian of a ray's two plane equations moves from the one at the middle (see
 * stretch     certify.c).
 *
 * The numbers of a frame are rounded to single precision first, and the bounds computed for them as they are then, and
 * rounded up. */
#include "nurbs/tile.h"

#include "nurbs/bezier.h"
#include "nurbs/patch_kernel.h"
#include "nurbs/restrict.h"
#include "render/box.h"

#include <float.h>
#include <math.h>

static const double unit = 0.5 * DBL_EPSILON;

/* Products, quotients, roots and sums of positive numbers make a bound, fewer than 2^10 of them one after the other. What is
 * lost by differences is added to it. */
#define ROUNDED_UP (1 + 0x1p-42)

static Vec3 xyz(Vec4 p) { return vec(p.x, p.y, p.z); }

/* A vector is the first three lanes; the fourth one may be anything. */
ALWAYS_INLINE V4 lanes_of(Vec3 x) { return (V4){ x.x, x.y, x.z, x.z }; }

ALWAYS_INLINE double dot3(V4 a, V4 b)
{
    V4 ab = a * b;
    return ab[0] + ab[1] + ab[2];
}

static void to_floats(Vec3 x, float out[3]) { out[0] = (float)x.x, out[1] = (float)x.y, out[2] = (float)x.z; }

/* Roundings of a net in each direction, for each of k - 1 combinations. The preparation halves at most five times, with one
 * each. On demand tile_net takes 3 and 5 (restrict.h; the quotient's two), and a halving one more. */
#define NET_ROUNDINGS 9
_Static_assert(TILE_FIRST_HALVINGS <= NET_ROUNDINGS, "five halvings or one restriction");

/* They are those of a convex combination; and of the weights that it is divided by, if these differ. */
double tile_net_error(const Patch *p)
{
    return (p->is_polynomial ? 1 : 2) * unit * NET_ROUNDINGS * (p->k_u + p->k_v - 2) * p->radius;
}

/* What the bounds are computed from: the net about the tile's middle, its orders, and the frame as it is stored. */
typedef struct {
    int k_u, k_v;
    Vec4 net[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    Vec3 half_s, half_t;
} Source;

/* In a function of its own: gcc 12 was seen to pass on, in place of what it stores in single precision, what it stored it
 * from. */
EVERY_X86 __attribute__((noinline))
static void make_source(const Tile *f, const Vec4 *net, Source *out)
{
    const Patch *p = f->patch;
    Vec3 middle = tile_vec(f->middle);
    out->half_s = tile_vec(f->half_s), out->half_t = tile_vec(f->half_t);
    for (int i = 0; i < p->k_u * p->k_v; i++) out->net[i] = patch_point_about(net[i], middle);
}

ALWAYS_INLINE void cut_net(Vec4 *net, int k_u, int k_v, TilePlace at)
{
    restrict_net(net, k_u, k_v, true, at.s0, at.s0 + at.ds);
    restrict_net(net, k_u, k_v, false, at.t0, at.t0 + at.dt);
}

EVERY_X86
void tile_net(const Patch *p, TilePlace at, Vec4 *net)
{
    for (int i = 0; i < p->k_u * p->k_v; i++) net[i] = p->p[i];
    if (p->k_u == 4 && p->k_v == 4) cut_net(net, 4, 4, at);    /* unrolled */
    else cut_net(net, p->k_u, p->k_v, at);
}

TilePlaces tile_cut(const Patch *p, TilePlace at, bool along_u, Vec4 *net, Vec4 *first)
{
    TilePlaces out = { at, at };
    if (along_u) {
        out.first.ds = out.second.ds = 0.5 * at.ds, out.second.s0 += out.first.ds;
        for (int j = 0; j < p->k_v; j++) bezier_cut(p->k_u, 1, 0.5, net + j * p->k_u, first + j * p->k_u);
    } else {
        out.first.dt = out.second.dt = 0.5 * at.dt, out.second.t0 += out.first.dt;
        bezier_cut(p->k_v, p->k_u, 0.5, net, first);
    }
    return out;
}

/* ---- radius, turn and stretch, with the margin ---- */

ALWAYS_INLINE double root_of_squares(double x, double y) { return sqrt(x * x + y * y); }

ALWAYS_INLINE double net_radius(const Vec4 *net, int n)
{
    double most2 = 0;
    for (int i = 0; i < n; i++) {
        V4 p = v4_load(&net[i]);
        most2 = double_max(most2, dot3(p, p) / (p[3] * p[3]));
    }
    return sqrt(most2);
}

/* Largest distances of the Bernstein coefficients of a derivative of the net from `middle`, along the unit normal and across
 * it, and of its weight from 0. step is the distance of neighbours along the derivative's direction, scale the degree over
 * the interval's length. */
typedef struct { double along, across, w; } Spread;

ALWAYS_INLINE Spread derivative_spread(const Source *p, const Vec4 *net, int step, double scale, Vec3 middle, Vec3 normal)
{
    int n_i = step == 1 ? p->k_u - 1 : p->k_u, n_j = step == 1 ? p->k_v : p->k_v - 1;
    double along2 = 0, across2 = 0, w = 0;
    V4 from = lanes_of(middle), up = lanes_of(normal);
    for (int j = 0; j < n_j; j++)
        for (int i = 0; i < n_i; i++) {
            const Vec4 *q = net + j * p->k_u + i;
            V4 d = (v4_load(q + step) - v4_load(q)) * scale, off = d - from;
            double height = dot3(off, up);
            V4 flat = off - up * height;
            along2 = double_max(along2, height * height);
            across2 = double_max(across2, dot3(flat, flat));
            w = double_max(w, fabs(d[3]));
        }
    return (Spread){ sqrt(along2), sqrt(across2), w };
}

/* Restricting to the margin adds 3 roundings and 5, and takes combinations with 1 + m and -m, then with m / (1 + m) and its
 * opposite added to 1: sums of sizes grow by (1 + 2m) and by (1 + 3m) / (1 + m) each time, and errors with them. Two more
 * are those of the way to the tile's middle. The result is relative: of the largest weight and, for points, of the patch's
 * radius. */
static double margin_error(const Source *p)
{
    const double grows = (1 + 2 * TILE_MARGIN) * (1 + 3 * TILE_MARGIN) / (1 + TILE_MARGIN);
    int combinations = p->k_u + p->k_v - 2;
    double error = unit * ((NET_ROUNDINGS + 8) * combinations + 2);
    for (int i = 0; i < combinations; i++) error *= grows;
    return error;
}

typedef struct { double lo, hi; } Weights;

ALWAYS_INLINE Weights weights_of(const Vec4 *net, int n)
{
    Weights w = { INFINITY, 0 };
    for (int i = 0; i < n; i++) w.lo = double_min(w.lo, net[i].w), w.hi = double_max(w.hi, net[i].w);
    return w;
}

/* What is in the margin: an error of `error` w_max radius in a coordinate and error w_max in the weight moves a point by
 * twice the sum of both over the weight, which is twice the errors at least. */
ALWAYS_INLINE double margin_radius(const Vec4 *net, int n, double inner, double error, Weights w)
{
    double radius = double_max(inner, net_radius(net, n));
    return radius + 4 * error * w.hi / w.lo * double_max(radius, inner);
}

/* The unit normal of the frame; with a, b the half-vectors over length_s, length_t, the sine |a x b|; and 1/sigma, their
 * smaller singular value: times the larger one it is the sine, and the sum of their squares is |a|^2 + |b|^2. */
typedef struct { Vec3 normal; double sine, per_sigma; } Plane;

/* Of a x b: 2 each of a and b, 2 of the products and their difference, of sums up to sqrt 2 long; 3 of the length. */
#define SINE_ROUNDINGS 12

ALWAYS_INLINE Plane plane_of(const Source *p, double length_s, double length_t)
{
    Vec3 a = vec_scale(p->half_s, 1 / length_s), b = vec_scale(p->half_t, 1 / length_t), normal = vec_cross(a, b);
    double sine = vec_length(normal), both2 = vec_length2(a) + vec_length2(b);
    double larger = 0.5 * (sqrt(both2 + 2 * sine) + sqrt(double_max(both2 - 2 * sine, 0)));
    return (Plane){ vec_scale(normal, 1 / sine), sine, larger / (sine - SINE_ROUNDINGS * unit) };
}

/* Sets turn, stretch and sine of the tile, whose frame and radius are there. `net` is that of the margin, off by `error` of
 * the largest weight w_max and of a radius. */
ALWAYS_INLINE void bound_variation(const Source *p, const Vec4 *net, double error, double w_max, Tile *out)
{
    double length = 1 + 2 * TILE_MARGIN, s = 2.0 * out->w_middle * out->length_s, t = 2.0 * out->w_middle * out->length_t;
    Plane plane = plane_of(p, out->length_s, out->length_t);
    if (!(s > 0) || !(t > 0) || !isfinite(s) || !isfinite(t) || !(plane.sine > TILE_LEAST_VARIATION)) return;
    Vec3 middle_s = vec_scale(p->half_s, 2.0 * out->w_middle), middle_t = vec_scale(p->half_t, 2.0 * out->w_middle);
    Spread by_s = derivative_spread(p, net, 1, (p->k_u - 1) / length, middle_s, plane.normal);
    Spread by_t = derivative_spread(p, net, p->k_u, (p->k_v - 1) / length, middle_t, plane.normal);
    double lost = 3 * error * w_max * (out->patch->radius + out->radius);    /* by neighbours, and by their differences */
    double any_s = (p->k_u - 1) * lost + out->radius * by_s.w, any_t = (p->k_v - 1) * lost + out->radius * by_t.w;
    double turn = root_of_squares((by_s.along + any_s) / s, (by_t.along + any_t) / t);
    double stretch = root_of_squares((by_s.across + any_s) / s, (by_t.across + any_t) / t);
    double tilt = SINE_ROUNDINGS * unit / plane.sine * (turn + stretch);      /* the normal's own error */
    double add = tilt + M_SQRT2 * TILE_VIEW_ROUNDINGS * unit;
    turn = double_max(turn * ROUNDED_UP + add, TILE_LEAST_VARIATION) * plane.per_sigma;
    stretch = double_max(stretch * ROUNDED_UP + add, TILE_LEAST_VARIATION) * plane.per_sigma;
    if (!(turn < FLT_MAX && stretch < FLT_MAX)) return;
    out->turn = float_up(turn * ROUNDED_UP), out->stretch = float_up(stretch * ROUNDED_UP);
    out->sine = float_up((plane.sine + (SINE_ROUNDINGS + 2 * TILE_VIEW_ROUNDINGS) * unit) * ROUNDED_UP);
}

/* Sets what holds with the margin, too: the radius, and bound_variation's. */
ALWAYS_INLINE void bound_margin(const Source *p, Tile *out)
{
    int n = p->k_u * p->k_v;
    Vec4 net[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    double error = margin_error(p);
    for (int i = 0; i < n; i++) net[i] = p->net[i];
    restrict_net(net, p->k_u, p->k_v, true, -TILE_MARGIN, 1 + TILE_MARGIN);
    restrict_net(net, p->k_u, p->k_v, false, -TILE_MARGIN, 1 + TILE_MARGIN);
    Weights w = { weights_of(net, n).lo, weights_of(p->net, n).hi };
    out->turn = out->stretch = INFINITY;
    bool has_margin = w.lo > 2 * error * w.hi;    /* extrapolated weights may be negative: then the margin proves nothing */
    double radius = net_radius(p->net, n) + tile_net_error(out->patch) + 2 * unit * out->patch->radius;
    if (has_margin) radius = margin_radius(net, n, radius, error, w);
    out->radius = float_up(radius * ROUNDED_UP);
    if (has_margin && isfinite(radius)) bound_variation(p, net, error, w.hi, out);
}

/* ---- deviation ---- */

/* Coefficient (i, j) of a tensor product polynomial times (u0 (1-s) + u1 s) (v0 (1-t) + v1 t), one order more in both: the
 * Bernstein product formula, [Far02]. Points have four components; those beyond the net count as zero. */
ALWAYS_INLINE Vec4 product_coefficient(const Source *p, int i, int j, double u0, double u1, double v0, double v1)
{
    Vec4 sum = { 0 };
    for (int b = 0; b < 2; b++)
        for (int a = 0; a < 2; a++) {
            int ii = i - a, jj = j - b;
            if (ii < 0 || ii >= p->k_u || jj < 0 || jj >= p->k_v) continue;
            double f = a ? i * u1 : (p->k_u - i) * u0, g = b ? j * v1 : (p->k_v - j) * v0;
            sum = vec4_add(sum, vec4_scale(p->net[jj * p->k_u + ii], f * g));
        }
    return vec4_scale(sum, 1.0 / (p->k_u * p->k_v));
}

/* With equal weights S - L itself has the order of S: L's coefficients are its values at the Greville abscissae. */
ALWAYS_INLINE double polynomial_deviation(const Source *p)
{
    double most2 = 0;
    V4 a = lanes_of(p->half_s), b = lanes_of(p->half_t);
    for (int j = 0; j < p->k_v; j++) {
        V4 row = b * (2.0 * j / (p->k_v - 1) - 1);
        for (int i = 0; i < p->k_u; i++) {
            V4 r = v4_load(&p->net[j * p->k_u + i]) - (row + a * (2.0 * i / (p->k_u - 1) - 1));
            most2 = double_max(most2, dot3(r, r));
        }
    }
    return sqrt(most2);
}

/* The Bernstein coefficients of w (S - L), of order k_u + 1 by k_v + 1, over the least weight. */
ALWAYS_INLINE double rational_deviation(const Source *p)
{
    double most2 = 0, w_min = INFINITY;
    for (int i = 0; i < p->k_u * p->k_v; i++) w_min = double_min(w_min, p->net[i].w);
    for (int j = 0; j <= p->k_v; j++)
        for (int i = 0; i <= p->k_u; i++) {
            Vec3 r = xyz(product_coefficient(p, i, j, 1, 1, 1, 1));
            r = vec_sub(r, vec_scale(p->half_s, product_coefficient(p, i, j, -1, 1, 1, 1).w));   /* w (2s - 1) half_s */
            r = vec_sub(r, vec_scale(p->half_t, product_coefficient(p, i, j, 1, 1, -1, 1).w));
            most2 = double_max(most2, vec_length2(r));
        }
    return sqrt(most2) / w_min;
}

/* That of the net; up to 16 roundings of its points and 10 of the half-vectors in their sums and differences, over the least
 * weight; and those of a ray's view. */
static double deviation_error(const Source *p, const Tile *tile)
{
    Weights w = weights_of(p->net, p->k_u * p->k_v);
    double lengths = (double)tile->length_s + tile->length_t;
    double of_sums = unit * (16 * tile->patch->radius + 10 * lengths);
    return (tile_net_error(tile->patch) + of_sums) * w.hi / w.lo + TILE_VIEW_ROUNDINGS * unit * lengths;
}

/* ---- the tile ---- */

EVERY_X86
void tile_evaluate(const Tile *tile, double *s, double *t, Vec4 *value, Vec4 *by_s, Vec4 *by_t)
{
    KernelPart part = kernel_part(tile);
    PatchPoint at = kernel_tile(tile->patch, &part, s, t);
    v4_store(value, at.value), v4_store(by_s, at.by_s), v4_store(by_t, at.by_t);
}

static void middle_of(const Patch *p, const Vec4 *net, Vec4 *value, Vec4 *by_s, Vec4 *by_t)
{
    Patch whole = { .k_u = p->k_u, .k_v = p->k_v, .p = net };
    patch_evaluate(&whole, 0.5, 0.5, value, by_s, by_t);
}

/* The middle of the box of what separates a net's points from those of the parallelogram about `at`: moved by that, it is
 * as far from what bends away to one side as to the other. Any place will do, bounds are of what is stored. */
ALWAYS_INLINE Vec3 middle_residual(const Vec4 *net, int k_u, int k_v, Vec3 at, Vec3 half_s, Vec3 half_t)
{
    V4 lo = v4_splat(INFINITY), hi = -lo, a = lanes_of(half_s), b = lanes_of(half_t), middle = lanes_of(at);
    for (int j = 0; j < k_v; j++) {
        V4 row = middle + b * (2.0 * j / (k_v - 1) - 1);
        for (int i = 0; i < k_u; i++) {
            const Vec4 *p = &net[j * k_u + i];
            V4 r = v4_load(p) / p->w - (row + a * (2.0 * i / (k_u - 1) - 1));
            lo = v4_min(lo, r), hi = v4_max(hi, r);
        }
    }
    Vec4 m;
    v4_store(&m, (lo + hi) * 0.5);
    return xyz(m);
}

/* Half the derivatives at the middle, and where their parallelogram lies best. */
ALWAYS_INLINE void set_frame(const Patch *p, const Vec4 *net, int k_u, int k_v, Tile *out)
{
    Vec4 value, by_s, by_t;
    middle_of(p, net, &value, &by_s, &by_t);
    Vec3 at = vec4_project(value);
    Vec3 half_s = vec_scale(vec_sub(xyz(by_s), vec_scale(at, by_s.w)), 0.5 / value.w);
    Vec3 half_t = vec_scale(vec_sub(xyz(by_t), vec_scale(at, by_t.w)), 0.5 / value.w);
    to_floats(vec_add(at, middle_residual(net, k_u, k_v, at, half_s, half_t)), out->middle);
    to_floats(half_s, out->half_s), to_floats(half_t, out->half_t);
    out->w_middle = p->is_polynomial ? 1 : (float)value.w;
}

/* For constant orders unrolled. */
ALWAYS_INLINE void make(const Patch *p, const Vec4 *net, int k_u, int k_v, Tile *out)
{
    set_frame(p, net, k_u, k_v, out);
    Source source;
    make_source(out, net, &source);
    source.k_u = k_u, source.k_v = k_v;
    out->length_s = float_up(vec_length(source.half_s) * ROUNDED_UP);
    out->length_t = float_up(vec_length(source.half_t) * ROUNDED_UP);
    bound_margin(&source, out);
    double deviation = p->is_polynomial ? polynomial_deviation(&source) : rational_deviation(&source);
    deviation = deviation * ROUNDED_UP + deviation_error(&source, out);
    out->deviation = deviation < FLT_MAX ? float_up(deviation) : INFINITY;
}

EVERY_X86
void tile_make(const Patch *p, const Vec4 *net, TilePlace place, Tile *out)
{
    const double per_unit = 1 / TILE_PLACE_UNIT;
    *out = (Tile){ .patch = p, .s0 = (uint16_t)(place.s0 * per_unit), .t0 = (uint16_t)(place.t0 * per_unit),
                   .ds = (uint16_t)(place.ds * per_unit), .dt = (uint16_t)(place.dt * per_unit) };
    if (p->k_u == 4 && p->k_v == 4) make(p, net, 4, 4, out);
    else if (p->k_u == 3 && p->k_v == 3) make(p, net, 3, 3, out);
    else make(p, net, p->k_u, p->k_v, out);
}

TrimRect tile_rect(const Patch *p, TilePlace at)
{
    return (TrimRect){ patch_u(p, at.s0), patch_u(p, at.s0 + at.ds), patch_v(p, at.t0), patch_v(p, at.t0 + at.dt) };
}

/* ---- is it worth a frame? ---- */

/* The longest second difference of the net: steps of a and b points; of the weights, times the radius. */
ALWAYS_INLINE double longest_difference(int k_u, const Vec4 *net, double radius, int a, int b, int n_i, int n_j)
{
    double most2 = 0, most_w = 0;
    for (int j = 0; j < n_j; j++)
        for (int i = 0; i < n_i; i++) {
            const Vec4 *q = net + j * k_u + i;
            V4 d = (v4_load(q + a + b) - v4_load(q + a)) - (v4_load(q + b) - v4_load(q));
            most2 = double_max(most2, dot3(d, d)), most_w = double_max(most_w, fabs(d[3]));
        }
    return sqrt(most2) + radius * most_w;
}

/* The derivatives change by at most their own derivatives' coefficients, times half the interval. */
EVERY_X86
TileBend tile_bend(int k_u, int k_v, const Vec4 *points)
{
    Vec4 net[NURBS_MAX_ORDER * NURBS_MAX_ORDER], value, by_s, by_t;
    Patch p = { .k_u = k_u, .k_v = k_v };
    for (int i = 0; i < k_u * k_v; i++) net[i] = points[i];
    patch_move_origin(&p, (WideNet){ net, NULL });
    patch_evaluate(&p, 0.5, 0.5, &value, &by_s, &by_t);
    double length_s = vec_length(xyz(by_s)), length_t = vec_length(xyz(by_t)), radius = length_s + length_t;
    int m = k_u - 1, n = k_v - 1;
    double ss = m * (m - 1) * longest_difference(k_u, net, radius, 1, 1, k_u - 2, k_v);
    double tt = n * (n - 1) * longest_difference(k_u, net, radius, k_u, k_u, k_u, k_v - 2);
    double st = m * n * longest_difference(k_u, net, radius, 1, k_u, k_u - 1, k_v - 1);
    double x = (ss + st) / length_s, y = (st + tt) / length_t;
    return (TileBend){ .variation = 0.5 * sqrt(x * x + y * y),
                       .along_u = ss / length_s + st / length_t, .along_v = tt / length_t + st / length_s };
}
