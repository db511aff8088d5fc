/* The paraboloid of a tile goes through the tile's own middle, and so through those of its sides and its corners as is even
 * in x, in y, or in both. What it leaves is of the third order in the tile's size, where the frame leaves the second.
 *
 * Let P = F + Q be the paraboloid, F = at + x half_s + y half_t, Q the rest; and w = W + v, W = w_0 + x w_x + y w_y. Then
 *     w (S - P) = [w S - W F - w_0 Q] - v F - (w - w_0) Q.
 * The bracket is a polynomial of the net's degrees, at least 2, and its Bernstein coefficients bound it ([Far02] convex hull
 * property), as those of v bound v; the least weight bounds w. Where a degree is 1, x^2 is taken for 1/2, which it is within
 * 1/2. */
#include "nurbs/paraboloid.h"

#include "nurbs/patch_kernel.h"
#include "render/box.h"

#include <float.h>
#include <math.h>

static void to_floats(Vec3 x, float out[3]) { out[0] = (float)x.x, out[1] = (float)x.y, out[2] = (float)x.z; }

/* The net's polynomial at x and y of -1, 0 and 1, which are i - 1 and j - 1 in at[j][i]. */
typedef struct { V4 at[3][3]; } Nine;

ALWAYS_INLINE V4 blend(const double b[], int k, const V4 *p, int stride)
{
    V4 sum = p[0] * b[0];
    for (int i = 1; i < k; i++) sum += p[i * stride] * b[i];
    return sum;
}

ALWAYS_INLINE Nine nine_points(const V4 *net, int k_u, int k_v)
{
    double b_u[NURBS_MAX_ORDER], b_v[NURBS_MAX_ORDER], d[NURBS_MAX_ORDER];
    V4 middles[NURBS_MAX_ORDER];
    kernel_bernstein(k_u, 0.5, b_u, d);
    kernel_bernstein(k_v, 0.5, b_v, d);
    for (int j = 0; j < k_v; j++) middles[j] = blend(b_u, k_u, net + j * k_u, 1);
    const V4 *last = net + (k_v - 1) * k_u;
    return (Nine){ { { net[0], middles[0], net[k_u - 1] },
                     { blend(b_v, k_v, net, k_u), blend(b_v, k_v, middles, 1), blend(b_v, k_v, net + k_u - 1, k_u) },
                     { last[0], middles[k_v - 1], last[k_u - 1] } } };
}

ALWAYS_INLINE V4 lanes_of(const float x[3]) { return (V4){ x[0], x[1], x[2], 0 }; }
ALWAYS_INLINE Vec3 xyz(V4 x) { return vec(x[0], x[1], x[2]); }

/* From what separates the points from the frame. (In a function of its own, as the frame is made in tile.c: the bound is of
 * what is stored.) */
EVERY_X86 __attribute__((noinline))
static void fit(const Tile *f, const Nine *n, Paraboloid *out)
{
    V4 r[3][3], half_s = lanes_of(f->half_s), half_t = lanes_of(f->half_t);
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) r[j][i] = n->at[j][i] / n->at[j][i][3] - half_s * (i - 1) - half_t * (j - 1);
    to_floats(xyz(r[1][1]), out->at);
    to_floats(xyz((r[1][0] + r[1][2]) * 0.5 - r[1][1]), out->ss);
    to_floats(xyz((r[0][1] + r[2][1]) * 0.5 - r[1][1]), out->tt);
    to_floats(xyz((r[0][0] + r[2][2] - r[0][2] - r[2][0]) * 0.25), out->st);
}

/* ---- the bound ---- */

/* In the first three lanes of W F + w_0 Q, in the last of W: the coefficients of 1, x, y, x^2, xy, y^2. */
typedef struct { V4 one, x, y, xx, xy, yy; } Quadratic;

ALWAYS_INLINE Quadratic quadratic_of(const Tile *f, const Nine *n, const Paraboloid *q)
{
    double w = n->at[1][1][3], w_x = (n->at[1][2][3] - n->at[1][0][3]) * 0.5, w_y = (n->at[2][1][3] - n->at[0][1][3]) * 0.5;
    V4 half_s = lanes_of(f->half_s), half_t = lanes_of(f->half_t), at = lanes_of(q->at), last = { 0, 0, 0, 1 };
    return (Quadratic){ .one = at * w + last * w, .x = half_s * w + at * w_x + last * w_x,
                        .y = half_t * w + at * w_y + last * w_y, .xx = lanes_of(q->ss) * w + half_s * w_x,
                        .xy = lanes_of(q->st) * w + half_s * w_y + half_t * w_x, .yy = lanes_of(q->tt) * w + half_t * w_y };
}

/* Bernstein coefficient i of x and of x^2, of order k. */
ALWAYS_INLINE double linear_at(int k, int i) { return 2.0 * i / (k - 1) - 1; }
ALWAYS_INLINE double square_at(int k, int i)
{
    return k == 2 ? 0.5 : 4.0 * i * (i - 1) / ((k - 1) * (k - 2)) - 4.0 * i / (k - 1) + 1;
}

/* Bounds of what the quadratic leaves of the net: of the bracket, and of v. */
typedef struct { double bracket, v; } Left;

ALWAYS_INLINE Left left_of(const V4 *net, int k_u, int k_v, const Quadratic *q)
{
    double most2 = 0, v = 0;
    for (int j = 0; j < k_v; j++) {
        double y = linear_at(k_v, j);
        V4 row = q->one + q->y * y + q->yy * square_at(k_v, j), along = q->x + q->xy * y;
        for (int i = 0; i < k_u; i++) {
            V4 r = net[j * k_u + i] - row - along * linear_at(k_u, i) - q->xx * square_at(k_u, i), rr = r * r;
            most2 = double_max(most2, rr[0] + rr[1] + rr[2]), v = double_max(v, fabs(r[3]));
        }
    }
    double lost = (k_u == 2 ? 0.5 * vec_length(xyz(q->xx)) : 0) + (k_v == 2 ? 0.5 * vec_length(xyz(q->yy)) : 0);
    return (Left){ sqrt(most2) + lost, v };
}

static double length_of(const float x[3]) { return vec_length(tile_vec(x)); }

/* Roundings of the coefficients, and of what a ray's test makes of the paraboloid, over the weights' ratio. Points about the
 * middle, up to 2 radii long, have 1, and 6 of sums; those of a quadratic, whose sizes add up to 3 times the vectors', have
 * 4 of themselves, 4 of the numbers that they are multiplied with, and 7 of products and sums; a ray's view has
 * TILE_VIEW_ROUNDINGS of the vectors, and the test at most 16 sums and products of the tile's radius and the vectors. In all
 * 14 of the patch's radius, 16 of the tile's, and 45 + 22 + 16 of the vectors. */
#define ROUNDINGS 100

ALWAYS_INLINE double bound(const Tile *f, const Paraboloid *q, const V4 *net, int n, double w, Left left)
{
    double w_min = INFINITY, w_max = 0;
    for (int i = 0; i < n; i++) w_min = double_min(w_min, net[i][3]), w_max = double_max(w_max, net[i][3]);
    double flat = length_of(q->at) + f->length_s + f->length_t, bent = length_of(q->ss) + length_of(q->st) + length_of(q->tt);
    double sizes = f->patch->radius + f->radius + flat + bent;
    double error = (0.5 * DBL_EPSILON * ROUNDINGS * sizes + tile_net_error(f->patch)) * w_max / w_min;
    double lost = left.v * flat + double_max(w_max - w, w - w_min) * bent;
    return (left.bracket + lost) / w_min * (1 + ROUNDINGS * DBL_EPSILON) + error;
}

/* For constant orders unrolled. */
ALWAYS_INLINE double make(const Tile *f, const Vec4 *net, int k_u, int k_v, Paraboloid *out)
{
    V4 points[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    for (int i = 0; i < k_u * k_v; i++) {
        Vec4 p = patch_point_about(net[i], tile_vec(f->middle));
        points[i] = v4_load(&p);
    }
    Nine nine = nine_points(points, k_u, k_v);
    fit(f, &nine, out);
    Quadratic q = quadratic_of(f, &nine, out);
    return bound(f, out, points, k_u * k_v, nine.at[1][1][3], left_of(points, k_u, k_v, &q));
}

EVERY_X86
void paraboloid_make(const Tile *f, const Vec4 *net, Paraboloid *out)
{
    int k_u = f->patch->k_u, k_v = f->patch->k_v;
    double deviation = k_u == 4 && k_v == 4 ? make(f, net, 4, 4, out)
        : k_u == 3 && k_v == 3 ? make(f, net, 3, 3, out) : make(f, net, k_u, k_v, out);
    out->deviation = deviation < FLT_MAX ? float_up(deviation) : INFINITY;
}
