/* Bézier polygons: closing, cutting, hull. See bezier.h.
 *
 * Closing is written with blossoms ([PT97] section 5.2 has the same by knot insertion): let f be the polar form of the
 * span's polynomial, a and b the ends of the span, t_1 = b, t_2, ... the knots after a. The given points are
 * f(tau_{j+1}, ..., tau_{j+k-1}). De Boor's triangle at a has f(a^{k-1-i}, t_1 .. t_i) along its last side; from these a
 * second triangle at b yields f(a^{k-1-i}, b^i): the Bézier points. */
#include "nurbs/bezier.h"

#include "nurbs/restrict.h"

#include <string.h>

/* out = (1-s) a + s b for blocks of `width` points; out may be a or b. */
static inline void blend(int width, double s, const Vec4 *a, const Vec4 *b, Vec4 *out)
{
    for (int c = 0; c < width; c++) out[c] = vec4_lerp(a[c], b[c], s);
}

/* De Boor's triangle at a, in place: column q begins at block 0 and is one block shorter than the column before it, whose
 * last block stays behind; so block i ends as f(a^{k-1-i}, t_1 .. t_i). */
static void close_start(int k, const double tau[], int mu, int width, Vec4 p[])
{
    for (int q = 1; q < k; q++)
        for (int i = 0; i < k - q; i++) {
            double low = tau[mu - k + 1 + q + i], high = tau[mu + 1 + i];
            blend(width, (tau[mu] - low) / (high - low), p + i * width, p + (i + 1) * width, p + i * width);
        }
}

/* The second triangle, at b: column q leaves its first block behind, f(a^{k-1-q}, b^q). */
static void close_end(int k, const double tau[], int mu, int width, Vec4 p[])
{
    double a = tau[mu], length = tau[mu + 1] - a;
    for (int q = 1; q < k; q++)
        for (int i = k - 1; i >= q; i--)
            blend(width, length / (tau[mu + i - q + 1] - a), p + (i - 1) * width, p + i * width, p + i * width);
}

void bezier_from_span(int k, const double tau[], int mu, int width, Vec4 p[])
{
    close_start(k, tau, mu, width, p);
    close_end(k, tau, mu, width, p);
}

/* ---- the same with twice the precision ---- */

/* (at - from) / (to - from). Differences of knots are exact; of half the knots, where they overflow. */
static Wide share(double from, double at, double to)
{
    Wide part = wide_sum(at, -from), all = wide_sum(to, -from);
    return isfinite(all.hi) ? wide_div(part, all) : wide_div(wide_sum(at / 2, -from / 2), wide_sum(to / 2, -from / 2));
}

/* out = (1-s) a + s b; out may be a or b. */
static void blend_wide(int width, Wide s, const Wide *a, const Wide *b, Wide *out)
{
    Wide r = wide_sub(wide(1), s);
    for (int c = 0; c < width; c++)
        if (a[c].hi != 0 || b[c].hi != 0) out[c] = wide_add(wide_mul(r, a[c]), wide_mul(s, b[c]));
}

void bezier_from_span_wide(int k, const double tau[], int mu, int width, Wide p[])
{
    double a = tau[mu], b = tau[mu + 1];
    for (int q = 1; q < k; q++)
        for (int i = 0; i < k - q; i++) {
            Wide s = share(tau[mu - k + 1 + q + i], a, tau[mu + 1 + i]);
            if (s.hi != 0) blend_wide(width, s, p + i * width, p + (i + 1) * width, p + i * width);
        }
    for (int q = 1; q < k; q++)
        for (int i = k - 1; i >= q; i--) {
            Wide s = share(a, b, tau[mu + i - q + 1]);
            if (s.hi != 1 || s.lo != 0) blend_wide(width, s, p + (i - 1) * width, p + i * width, p + i * width);
        }
}

/* ---- cutting ---- */

EVERY_X86
void bezier_cut(int k, int width, double s, Vec4 p[], Vec4 left[])
{
    memcpy(left, p, (size_t)(k * width) * sizeof *p);
    restrict_before(left, k, width, width, s, 1 - s);
    restrict_after(p, k, width, width, s, 1 - s);
    memcpy(p, left + (k - 1) * width, (size_t)width * sizeof *p);   /* equal but for roundings: made equal */
}

Vec4 bezier_point(int k, const Vec4 p[], double s)
{
    Vec4 q[NURBS_MAX_ORDER];
    memcpy(q, p, (size_t)k * sizeof *q);
    restrict_after(q, k, 1, 1, s, 1 - s);
    return q[0];
}

Box bezier_hull(int n, const Vec4 p[])
{
    Vec3 lo = vec4_project(p[0]), hi = lo;
    for (int i = 1; i < n; i++) {
        Vec3 q = vec4_project(p[i]);
        lo = vec(double_min(lo.x, q.x), double_min(lo.y, q.y), double_min(lo.z, q.z));
        hi = vec(double_max(hi.x, q.x), double_max(hi.y, q.y), double_max(hi.z, q.z));
    }
    return box_from(lo, hi);
}

/* The largest derivative of order (a, b), of the points and of the weights: its control points are differences. */
typedef struct { double point, weight; } Largest;

static Largest largest_derivative(int k_u, int k_v, const Vec4 *q, int a, int b)
{
    static const double choose[3][3] = { { 1 }, { -1, 1 }, { 1, -2, 1 } };   /* signed: of the a-th difference */
    Largest most = { 0, 0 };
    for (int i = 0; i < k_v - b; i++)
        for (int j = 0; j < k_u - a; j++) {
            Vec4 d = { 0 };
            for (int y = 0; y <= b; y++)
                for (int x = 0; x <= a; x++)
                    d = vec4_add(d, vec4_scale(q[(i + y) * k_u + j + x], choose[a][x] * choose[b][y]));
            most.point = fmax(most.point, d.x * d.x + d.y * d.y + d.z * d.z);
            most.weight = fmax(most.weight, fabs(d.w));
        }
    double factor = (a > 0 ? k_u - 1 : 1) * (a > 1 ? k_u - 2 : 1) * (b > 0 ? k_v - 1 : 1) * (b > 1 ? k_v - 2 : 1);
    return (Largest){ factor * sqrt(most.point), factor * most.weight };
}

/* About a point c of the hull the patch is S - c = Q / w, Q = sum B w_i (P_i - c), |S - c| <= radius. The quotient rule
 * gives w S_u = Q_u - w_u (S - c), w S_uu = Q_uu - 2 w_u S_u - w_uu (S - c), w S_uv = Q_uv - w_u S_v - w_v S_u - w_uv (S -
 * c). With equal weights all but the first terms are 0. */
BezierSeconds bezier_seconds(int k_u, int k_v, const Vec4 patch[])
{
    Vec4 q[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    Vec3 c = box_centre(bezier_hull(k_u * k_v, patch));
    double radius = 0, w = INFINITY;
    for (int i = 0; i < k_u * k_v; i++) {
        Vec3 r = vec_sub(vec4_project(patch[i]), c);
        q[i] = vec4_weighted(vec4(r.x, r.y, r.z, patch[i].w));
        radius = fmax(radius, vec_length(r)), w = fmin(w, patch[i].w);
    }
    Largest u = largest_derivative(k_u, k_v, q, 1, 0), v = largest_derivative(k_u, k_v, q, 0, 1);
    Largest uu = largest_derivative(k_u, k_v, q, 2, 0), vv = largest_derivative(k_u, k_v, q, 0, 2);
    Largest uv = largest_derivative(k_u, k_v, q, 1, 1);
    double s_u = (u.point + u.weight * radius) / w, s_v = (v.point + v.weight * radius) / w;
    double s_uu = (uu.point + 2 * u.weight * s_u + uu.weight * radius) / w;
    double s_vv = (vv.point + 2 * v.weight * s_v + vv.weight * radius) / w;
    double s_uv = (uv.point + u.weight * s_v + v.weight * s_u + uv.weight * radius) / w;
    return (BezierSeconds){ s_uu, s_uv, s_vv };
}

/* Taylor. */
double bezier_bend(int k_u, int k_v, const Vec4 patch[])
{
    BezierSeconds s = bezier_seconds(k_u, k_v, patch);
    return (s.ss + 2 * s.st + s.tt) / 2;
}
