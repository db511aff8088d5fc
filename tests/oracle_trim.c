/* Windings of trim loops, exactly: signed crossings of the ray from the point along +x. Curves are cut into Bezier
 * segments and halved until the control polygon settles a piece: on one side of the ray's line, behind the point, or
 * wholly before it, where only the ends matter. See oracle.h. */
#include "tests/oracle_net.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_HALVINGS = 200 };

/* The point of view: coordinates are turned by quarter turns, so that no direction is special if one fails. */
typedef struct { arb_t u, v, x, y; int turn; double nearest; } View;

typedef enum { SETTLED, UNDECIDED } Outcome;

/* Homogeneous {w u, w v, w} to {w x, w y, w} as seen from the point. */
static void look(View *e, arb_ptr p)
{
    arb_mul(e->x, e->u, p + 2, ORACLE_BITS), arb_sub(e->x, p, e->x, ORACLE_BITS);
    arb_mul(e->y, e->v, p + 2, ORACLE_BITS), arb_sub(e->y, p + 1, e->y, ORACLE_BITS);
    for (int i = 0; i < e->turn; i++) {
        arb_swap(e->x, e->y);
        arb_neg(e->x, e->x);
    }
    arb_set(p, e->x), arb_set(p + 1, e->y);
}

typedef struct { bool all_positive, all_negative; } Signs;

static Signs signs_of(arb_srcptr c, int k, int which)
{
    Signs s = { true, true };
    for (int i = 0; i < k; i++) {
        s.all_positive = s.all_positive && arb_is_positive(c + 3 * i + which);
        s.all_negative = s.all_negative && arb_is_negative(c + 3 * i + which);
    }
    return s;
}

/* An end at height y counts as above if y >= 0: 1 above, 0 below, -1 unknown. */
static int is_above(const arb_t y) { return arb_is_nonnegative(y) ? 1 : arb_is_negative(y) ? 0 : -1; }

static double hull_distance(arb_srcptr c, int k)
{
    double most = 0;
    for (int i = 0; i < k; i++) {
        double w = oracle_double(c + 3 * i + 2);
        most = fmax(most, hypot(oracle_double(c + 3 * i), oracle_double(c + 3 * i + 1)) / w);
    }
    return most;
}

/* Adds the crossings of one segment, which is used up. */
static Outcome cross_segment(View *e, arb_ptr c, int k, int depth, int *crossings)
{
    Signs x = signs_of(c, k, 0), y = signs_of(c, k, 1);
    if (x.all_negative || y.all_positive || y.all_negative) return SETTLED;
    int begin = is_above(c + 1), end = is_above(c + 3 * (k - 1) + 1);
    if (x.all_positive && begin >= 0 && end >= 0) {
        *crossings += end - begin;
        return SETTLED;
    }
    if (depth == MAX_HALVINGS) {
        e->nearest = fmin(e->nearest, hull_distance(c, k));
        return UNDECIDED;
    }
    arb_ptr right = _arb_vec_init(3 * k);
    for (int m = 0; m < 3; m++) oracle_row_halve(c + m, right + m, 3, k);
    Outcome first = cross_segment(e, c, k, depth + 1, crossings);
    Outcome second = first == SETTLED ? cross_segment(e, right, k, depth + 1, crossings) : UNDECIDED;
    _arb_vec_clear(right, 3 * k);
    return second;
}

static void set_point(arb_ptr p, Vec3 from)
{
    arb_set_d(p + 2, from.z), arb_set_d(p, from.x), arb_set_d(p + 1, from.y);
    arb_mul(p, p, p + 2, ORACLE_BITS), arb_mul(p + 1, p + 1, p + 2, ORACLE_BITS);
}

static Outcome cross_curve(View *e, const TrimCurveDesc *d, int *crossings)
{
    int k = d->order;
    arb_ptr m = _arb_vec_init(k * k), p = _arb_vec_init(3 * k), c = _arb_vec_init(3 * k);
    Outcome outcome = SETTLED;
    for (int mu = k - 1; mu < d->n && outcome == SETTLED; mu++) {
        if (!(d->knots[mu] < d->knots[mu + 1])) continue;
        oracle_span_matrix(k, d->knots, mu, m);
        for (int i = 0; i < k; i++) set_point(p + 3 * i, d->points[mu - k + 1 + i]);
        for (int r = 0; r < k; r++) {
            for (int x = 0; x < 3; x++) arb_dot(c + 3 * r + x, NULL, 0, m + r * k, 1, p + x, 3, k, ORACLE_BITS);
            look(e, c + 3 * r);
        }
        outcome = cross_segment(e, c, k, 0, crossings);
    }
    _arb_vec_clear(m, k * k), _arb_vec_clear(p, 3 * k), _arb_vec_clear(c, 3 * k);
    return outcome;
}

static Outcome cross_line(View *e, Vec3 from, Vec3 to, int *crossings)
{
    arb_ptr c = _arb_vec_init(6);
    from.z = to.z = 1;
    set_point(c, from), set_point(c + 3, to);
    look(e, c), look(e, c + 3);
    Outcome outcome = cross_segment(e, c, 2, 0, crossings);
    _arb_vec_clear(c, 6);
    return outcome;
}

static Outcome cross_loop(View *e, const TrimLoopDesc *loop, int *crossings)
{
    Outcome outcome = SETTLED;
    *crossings = 0;
    const TrimCurveDesc *c = loop->curves;
    if (loop->is_polyline) {
        for (int i = 0; i < c->n && outcome == SETTLED; i++)
            outcome = cross_line(e, c->points[i], c->points[(i + 1) % c->n], crossings);
        return outcome;
    }
    for (int i = 0; i < loop->n_curves && outcome == SETTLED; i++) {   /* of clamped curves: ends are control points */
        const TrimCurveDesc *next = &loop->curves[(i + 1) % loop->n_curves];
        outcome = cross_curve(e, &c[i], crossings);
        if (outcome == SETTLED) outcome = cross_line(e, c[i].points[c[i].n - 1], next->points[0], crossings);
    }
    return outcome;
}

bool oracle_winding(const TrimLoopDesc *loop, double u, double v, int *winding, double *distance)
{
    View e = { .nearest = INFINITY };
    arb_init(e.u), arb_init(e.v), arb_init(e.x), arb_init(e.y);
    arb_set_d(e.u, u), arb_set_d(e.v, v);
    Outcome outcome = UNDECIDED;
    for (e.turn = 0; e.turn < 4 && outcome == UNDECIDED; e.turn++) outcome = cross_loop(&e, loop, winding);
    arb_clear(e.u), arb_clear(e.v), arb_clear(e.x), arb_clear(e.y);
    *distance = e.nearest;
    return outcome == SETTLED;
}

/* Twice the area of the control polygon: enough to tell which of two nested loops is the inner one. */
static double area_of(const TrimLoopDesc *loop)
{
    double sum = 0;
    const Vec3 *last = NULL, *first = NULL;
    for (int c = 0; c < loop->n_curves; c++)
        for (int i = 0; i < loop->curves[c].n; i++) {
            const Vec3 *p = &loop->curves[c].points[i];
            if (last) sum += last->x * p->y - last->y * p->x;
            if (!first) first = p;
            last = p;
        }
    return sum + last->x * first->y - last->y * first->x;
}

bool oracle_keeps(const TrimLoopDesc *loops, int n, bool keep_left, double u, double v, bool *is_kept, double *distance)
{
    double least = INFINITY, most = 0;
    bool inner = false, outer = true;
    *distance = INFINITY;
    for (int i = 0; i < n; i++) {
        int winding;
        if (!oracle_winding(&loops[i], u, v, &winding, distance)) return false;
        double area = area_of(&loops[i]);
        bool keeps_inside = (area > 0) == keep_left;
        if (fabs(area) > most) most = fabs(area), outer = !keeps_inside;   /* the greatest loop is not inside another */
        if (winding != 0 && fabs(area) < least) least = fabs(area), inner = keeps_inside;
    }
    *is_kept = least < INFINITY ? inner : outer;
    return true;
}
