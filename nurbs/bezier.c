/* Bézier polygons: closing, cutting, hull. See bezier.h.
 *
 * Closing is written with blossoms ([PT97] section 5.2 has the same by knot insertion): let f be the polar form of the span's
 * polynomial, a and b the ends of the span, t_1 = b, t_2, ... the knots after a. The given points are
 * f(tau_{j+1}, ..., tau_{j+k-1}). De Boor's triangle at a has f(a^{k-1-i}, t_1 .. t_i) along its last side; from these a second
 * triangle at b yields f(a^{k-1-i}, b^i): the Bézier points. */
#include "nurbs/bezier.h"

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

/* De Casteljau's triangle shrinks towards block 0 here, and leaves its lower side behind: the part after s. */
static void keep_after(int k, int width, double s, Vec4 p[])
{
    for (int q = 1; q < k; q++)
        for (int i = 0; i < k - q; i++) blend(width, s, p + i * width, p + (i + 1) * width, p + i * width);
}

/* The same towards the last block, with the upper side: the part before s. */
static void keep_before(int k, int width, double s, Vec4 p[])
{
    for (int q = 1; q < k; q++)
        for (int i = k - 1; i >= q; i--) blend(width, s, p + (i - 1) * width, p + i * width, p + i * width);
}

void bezier_cut(int k, int width, double s, Vec4 p[], Vec4 left[])
{
    memcpy(left, p, (size_t)(k * width) * sizeof *p);
    keep_before(k, width, s, left);
    keep_after(k, width, s, p);
    memcpy(p, left + (k - 1) * width, (size_t)width * sizeof *p);   /* equal but for roundings: made equal */
}

void bezier_restrict(int k, int width, double s0, double s1, Vec4 p[])
{
    keep_before(k, width, s1, p);
    keep_after(k, width, s0 / s1, p);
}

Vec4 bezier_point(int k, const Vec4 p[], double s)
{
    Vec4 q[NURBS_MAX_ORDER];
    memcpy(q, p, (size_t)k * sizeof *q);
    keep_after(k, 1, s, q);
    return q[0];
}

Box bezier_hull(int n, const Vec4 p[])
{
    Box b = box_empty();
    for (int i = 0; i < n; i++) b = box_add_point(b, vec4_project(p[i]));
    return b;
}
