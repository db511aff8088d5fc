/* Monotone arcs. See trim_arc.h.
 *
 * trim_arc_is_right: with h = w (curve - p), a plane polynomial, the question is the sign of h_x where h_y = 0, and no
 * division is needed. A bracket [t_low, t_high] with h_y <= 0 < h_y at its ends answers it if both ends are on one side,
 * for x is monotone; or if the chord between them passes p by more than h can leave the chord, |h''| (t_high - t_low)^2 /
 * 8, and rounding. If not, h is evaluated on either side of where the chord crosses the line, so near to it that the root
 * must be between: the bracket's width is squared. All this in doubles, and where their rounding leaves it open, again
 * with twice the precision. */
#include "nurbs/trim_arc.h"

#include "nurbs/bernstein.h"
#include "nurbs/bezier.h"
#include "nurbs/trim_chain.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const double unit = DBL_EPSILON / 2;

/* ---- segments ---- */

/* The largest difference of the given order (0 or 2) of any coordinate, each with that of the weight: |h| and |h''| are
 * bounded by those of their control points x_i - p w_i, 0 <= p <= 1. */
static double largest(int k, const WideControl *p, int order)
{
    double x = 0, y = 0, w = 0;
    for (int i = 0; i + order < k; i++) {
        const WideControl *a = p + i, *b = p + i + order / 2, *c = p + i + order;
        double f = order ? -2 : 0, g = order ? 1 : 0;
        x = fmax(x, fabs(a->x.hi + f * b->x.hi + g * c->x.hi));
        y = fmax(y, fabs(a->y.hi + f * b->y.hi + g * c->y.hi));
        w = fmax(w, fabs(a->w.hi + f * b->w.hi + g * c->w.hi));
    }
    return fmax(x, y) + w;
}

/* Of the first parts, of the coordinate's sum with the weight, of the product with these. */
#define ROUNDINGS_OF_SIZE 4
/* Second differences are 4 sizes at most: 4 roundings of the first parts, 3 and 4 of their sums, and 4 each of the sum with
 * the weight's, that with these roundings, and the product. */
#define ROUNDINGS_OF_BEND 24

TrimSegment trim_segment_make(int k, const WideControl *p)
{
    TrimSegment s = { .k = k, .p = p, .size = largest(k, p, 0) * (1 + ROUNDINGS_OF_SIZE * unit) };
    s.bend = (k - 1) * (k - 2) * (largest(k, p, 2) + ROUNDINGS_OF_BEND * unit * s.size);
    return s;
}

static WideControl control_at(const TrimSegment *s, double t)
{
    WideControl q[NURBS_MAX_ORDER];
    Wide at = wide(t);
    memcpy(q, s->p, (size_t)s->k * sizeof *q);
    for (int r = 1; r < s->k; r++)
        for (int i = 0; i < s->k - r; i++)
            q[i] = (WideControl){ wide_lerp(q[i].x, q[i + 1].x, at), wide_lerp(q[i].y, q[i + 1].y, at),
                                  wide_lerp(q[i].w, q[i + 1].w, at) };
    return q[0];
}

WidePoint trim_segment_at(const TrimSegment *s, double t)
{
    WideControl c = control_at(s, t);
    return (WidePoint){ wide_div(c.x, c.w), wide_div(c.y, c.w) };
}

/* ---- turns ---- */

static Wide coordinate_of(const WideControl *p, int coordinate) { return coordinate ? p->y : p->x; }

/* The numerator of the derivative of x = X / W. With X = (1-t) X_0 + t X_1, X_0 and X_1 having the control points but the
 * last and but the first, X' W - X W' = (k-1) (X_1 W_0 - X_0 W_1): order 2k - 3. */
static int hodograph(const TrimSegment *s, int coordinate, double out[])
{
    int d = s->k - 2;                                    /* the degree of X_0 and X_1 */
    double row[NURBS_MAX_ORDER], all = 1;
    for (int i = 0; i <= d; i++) row[i] = i ? row[i - 1] * (d - i + 1) / i : 1;
    for (int r = 0; r <= 2 * d; r++) {
        Wide sum = wide(0);
        for (int i = r > d ? r - d : 0; i <= r && i <= d; i++) {
            const WideControl *a = s->p + i, *b = s->p + r - i;
            Wide term = wide_sub(wide_mul(coordinate_of(a + 1, coordinate), b->w),
                                 wide_mul(coordinate_of(a, coordinate), b[1].w));
            sum = wide_add(sum, wide_mul(term, wide_product(row[i], row[r - i])));
        }
        out[r] = sum.hi / all;
        all = all * (2 * d - r) / (r + 1);
    }
    return 2 * d + 1;
}

/* A hodograph's m = 2k - 3 coefficients are known to 64 m of WIDE_UNIT, m 2^-97, of size^2. Control points come from m + 1
 * combinations (bezier_from_span_wide: 2^-98.7 each, wide_net.h) and from the way to the unit square (2^-99.8 with the
 * weight); a coordinate times a weight is a quarter of size^2 at most, and there are two such products of two factors each.
 * Their own arithmetic adds 2 m roundings. So what is below this is no turn, but a straight line along an axis. */
#define TURN_ROUNDINGS 64

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int trim_segment_turns(const TrimSegment *s, double t[])
{
    double c[BERNSTEIN_MAX];
    int n = 0, distinct = 0;
    for (int coordinate = 0; coordinate < 2; coordinate++) {
        int m = hodograph(s, coordinate, c);
        n += bernstein_turns(m, c, TURN_ROUNDINGS * m * WIDE_UNIT * s->size * s->size, t + n);
    }
    qsort(t, (size_t)n, sizeof *t, by_value);
    for (int i = 0; i < n; i++)
        if (t[i] > 0 && (distinct == 0 || t[i] > t[distinct - 1])) t[distinct++] = t[i];
    return distinct;
}

/* ---- arcs ---- */

void trim_arc_control(const TrimArc *arc, Vec4 out[])
{
    const TrimSegment *s = arc->segment;
    Vec4 whole[NURBS_MAX_ORDER];
    for (int i = 0; i < s->k; i++) whole[i] = vec4(s->p[i].x.hi, s->p[i].y.hi, 0, s->p[i].w.hi);
    bezier_cut(s->k, 1, arc->t1, whole, out);            /* before t1 is in out, and of that */
    bezier_cut(s->k, 1, arc->t0 / arc->t1, out, whole);  /* what is after t0 */
}

/* A control point's, for each of k: cutting twice has 3 and 5 (where its place is a quotient), relative to the sizes of
 * coordinate and weight together, in both coordinates sqrt 2 times as many; and the rest is for the distance. */
#define BULGE_ROUNDINGS 16

TrimArc trim_arc_make(const TrimSegment *s, double t0, double t1)
{
    TrimArc arc = { s, t0, t1, control_at(s, t0).w.hi, control_at(s, t1).w.hi, 0 };
    Vec4 p[NURBS_MAX_ORDER];
    trim_arc_control(&arc, p);
    Vec2 a = wide_point_round(trim_segment_at(s, t0)), b = wide_point_round(trim_segment_at(s, t1));
    double w_min = fmin(arc.w0, arc.w1);
    for (int i = 0; i < s->k; i++) {
        Vec2 q = vec2(p[i].x / p[i].w, p[i].y / p[i].w);
        w_min = fmin(w_min, p[i].w);
        arc.bulge = fmax(arc.bulge, vec2_length(vec2_sub(q, trim_piece_nearest(a, b, q))));
    }
    arc.bulge += BULGE_ROUNDINGS * s->k * unit * s->size / w_min;
    return arc;
}

/* ---- beside an arc ---- */

typedef struct { double t; Vec2 h; } Mark;

static Mark end_mark(double t, double w, WidePoint at, WidePoint p)
{
    return (Mark){ t, vec2(w * wide_sub(at.x, p.x).hi, w * wide_sub(at.y, p.y).hi) };
}

static Vec2 h_in_doubles(const TrimSegment *s, WidePoint p, double t)
{
    Vec2 h[NURBS_MAX_ORDER];
    double r = 1 - t;
    for (int i = 0; i < s->k; i++)
        h[i] = vec2(s->p[i].x.hi - p.x.hi * s->p[i].w.hi, s->p[i].y.hi - p.y.hi * s->p[i].w.hi);
    for (int q = 1; q < s->k; q++)
        for (int i = 0; i < s->k - q; i++) h[i] = vec2(r * h[i].x + t * h[i + 1].x, r * h[i].y + t * h[i + 1].y);
    return h[0];
}

static Vec2 h_in_wide(const TrimSegment *s, WidePoint p, double t)
{
    WidePoint h[NURBS_MAX_ORDER];
    Wide at = wide(t);
    for (int i = 0; i < s->k; i++)
        h[i] = (WidePoint){ wide_sub(s->p[i].x, wide_mul(p.x, s->p[i].w)), wide_sub(s->p[i].y, wide_mul(p.y, s->p[i].w)) };
    for (int q = 1; q < s->k; q++)
        for (int i = 0; i < s->k - q; i++)
            h[i] = (WidePoint){ wide_lerp(h[i].x, h[i + 1].x, at), wide_lerp(h[i].y, h[i + 1].y, at) };
    return vec2(h[0].x.hi, h[0].y.hi);
}

typedef struct {
    const TrimSegment *segment;
    WidePoint p;
    Vec2 (*h)(const TrimSegment *s, WidePoint p, double t);
    double error;                                        /* of h; its own rounding to a double comes on top, relatively */
    bool is_last;                                        /* no higher precision is there to ask */
    Mark low, high;                                      /* the bracket: p is not below the one, and below the other */
    int answer;                                          /* 1: right, -1: not; 0: not known */
} Passing;

/* How far h leaves the bracket's chord, and how wrong that is. */
static double slack(const Passing *s)
{
    double width = s->high.t - s->low.t;
    return s->segment->bend * width * width / 8 + 2 * s->error;
}

static int side_of_bracket(const Passing *s)
{
    Vec2 a = s->low.h, b = s->high.h;
    if (a.x > s->error && b.x > s->error) return 1;
    if (a.x < -s->error && b.x < -s->error) return -1;
    double left = a.x * b.y, right = b.x * a.y;          /* their difference: where the chord passes, times b.y - a.y > 0 */
    double bound = slack(s) * (fabs(b.y - a.y) + fabs(b.x - a.x)) + 4 * unit * (fabs(left) + fabs(right));
    return left - right > bound ? 1 : left - right < -bound ? -1 : 0;
}

/* Moves one end of the bracket to t. False: h_y is 0 there as far as can be seen, so p is as near to the arc as h_x is to
 * 0. */
static bool narrow(Passing *s, double t)
{
    if (!((t > s->low.t && t < s->high.t) || (t < s->low.t && t > s->high.t))) return true;
    Mark m = { t, s->h(s->segment, s->p, t) };
    if (fabs(m.h.y) <= s->error) {
        if (s->is_last) s->answer = m.h.x > s->error ? 1 : m.h.x < -s->error ? -1 : 0;
        return false;
    }
    if (m.h.y > 0) s->high = m;
    else s->low = m;
    return true;
}

/* Narrows the bracket until it answers, or the precision is spent. */
static void narrow_all(Passing *s)
{
    while ((s->answer = side_of_bracket(s)) == 0) {
        double width = s->high.t - s->low.t, rise = s->high.h.y - s->low.h.y, low = s->low.t;
        double at = -s->low.h.y / rise, margin = 2 * slack(s) / rise, middle = low + width / 2;
        if (middle == low || middle == s->high.t || s->segment->bend * width * width / 8 <= s->error) return;
        if (margin < .25) {
            if (!narrow(s, low + width * (at - margin)) || !narrow(s, low + width * (at + margin))) return;
        }
        if (!(fabs(s->high.t - s->low.t) < fabs(width) / 2) && !narrow(s, s->low.t + (s->high.t - s->low.t) / 2)) return;
    }
}

bool trim_arc_is_right(const TrimArc *arc, WidePoint a, WidePoint b, WidePoint p)
{
    const TrimSegment *s = arc->segment;
    Mark at_a = end_mark(arc->t0, arc->w0, a, p), at_b = end_mark(arc->t1, arc->w1, b, p);
    Mark low = trim_is_above(b, p) ? at_a : at_b, high = trim_is_above(b, p) ? at_b : at_a;
    /* Roundings: 4 for the control points of h, 4 for a column of de Casteljau's triangle. */
    double roundings = 4 * (s->k + 1) * s->size;
    Passing in_doubles = { s, p, h_in_doubles, roundings * unit, false, low, high, 0 };
    narrow_all(&in_doubles);
    if (in_doubles.answer != 0) return in_doubles.answer > 0;
    Passing in_wide = { s, p, h_in_wide, roundings * WIDE_UNIT, true, low, high, 0 };
    narrow_all(&in_wide);
    return in_wide.answer > 0;
}

double trim_arc_find(const TrimArc *arc, int coordinate, double value)
{
    WidePoint begin = trim_segment_at(arc->segment, arc->t0);
    bool starts_below = (coordinate ? begin.y.hi : begin.x.hi) < value;
    double lo = arc->t0, hi = arc->t1;
    for (;;) {
        double middle = lo + (hi - lo) / 2;
        if (!(middle > lo && middle < hi)) return hi < arc->t1 ? hi : lo;
        WidePoint p = trim_segment_at(arc->segment, middle);
        bool is_below = wide_less(coordinate ? p.y : p.x, wide(value));
        if (is_below == starts_below) lo = middle;
        else hi = middle;
    }
}

/* ---- area ---- */

/* Gauss's rule of 4 points. With h = w (curve - about), the integrand is (h_x h_y' - h_y h_x') / w^2. */
static double area_by_rule(int k, const Vec4 p[])
{
    static const double at[2] = { .3399810435848563, .8611363115940526 };
    static const double weight[2] = { .6521451548625461, .3478548451374538 };
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        double t = .5 + (i % 2 ? .5 : -.5) * at[i / 2];
        Vec4 q[NURBS_MAX_ORDER];
        memcpy(q, p, (size_t)k * sizeof *q);
        for (int r = 1; r < k - 1; r++)
            for (int j = 0; j < k - r; j++) q[j] = vec4_lerp(q[j], q[j + 1], t);
        Vec4 h = vec4_lerp(q[0], q[1], t);               /* q[0] and q[1] span the tangent */
        sum += weight[i / 2] / 2 * (k - 1) * (q[0].x * q[1].y - q[1].x * q[0].y) / (h.w * h.w);
    }
    return sum / 2;
}

#define AREA_HALVINGS 20

/* Halved until the halves agree with the whole. */
static double area_of(int k, Vec4 p[], double whole, double tolerance, int halvings)
{
    Vec4 left[NURBS_MAX_ORDER];
    bezier_cut(k, 1, .5, p, left);
    double a = area_by_rule(k, left), b = area_by_rule(k, p);
    if (fabs(a + b - whole) <= tolerance || halvings == AREA_HALVINGS) return a + b;
    return area_of(k, left, a, tolerance, halvings + 1) + area_of(k, p, b, tolerance, halvings + 1);
}

/* The tolerance, of the arc's length in the unit square: the direction of a loop between two arcs is that of the difference
 * of their areas, however close they are (TRIM_THIN). 8 units of 2^-53, less than the control points' own rounding. */
#define AREA_ERROR 0x1p-50

double trim_arc_area(const TrimArc *arc)
{
    Vec4 p[NURBS_MAX_ORDER];
    int k = arc->segment->k;
    trim_arc_control(arc, p);
    double x = p[0].x / p[0].w, y = p[0].y / p[0].w;
    for (int i = 0; i < k; i++) p[i] = vec4(p[i].x - x * p[i].w, p[i].y - y * p[i].w, 0, p[i].w);
    double dx = fabs(p[k - 1].x / p[k - 1].w), dy = fabs(p[k - 1].y / p[k - 1].w);
    return area_of(k, p, area_by_rule(k, p), AREA_ERROR * (dx + dy), 0);
}
