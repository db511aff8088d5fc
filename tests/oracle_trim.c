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

/* A Bezier segment: order points {w u, w v, w}. */
typedef struct { int k; arb_ptr c; } Segment;
typedef struct { Segment *segment; int n; double area; } Loop;
struct OracleTrims { Loop *loop; int n; };

static void set_point(arb_ptr p, Vec3 from)
{
    arb_set_d(p + 2, from.z), arb_set_d(p, from.x), arb_set_d(p + 1, from.y);
    arb_mul(p, p, p + 2, ORACLE_BITS), arb_mul(p + 1, p + 1, p + 2, ORACLE_BITS);
}

static arb_ptr add_segment(Loop *l, int k)
{
    l->segment = realloc(l->segment, (size_t)(l->n + 1) * sizeof *l->segment);
    if (!l->segment) abort();
    l->segment[l->n++] = (Segment){ k, _arb_vec_init(3 * k) };
    return l->segment[l->n - 1].c;
}

static void add_line(Loop *l, Vec3 from, Vec3 to)
{
    if (from.x == to.x && from.y == to.y) return;
    arb_ptr c = add_segment(l, 2);
    from.z = to.z = 1;
    set_point(c, from), set_point(c + 3, to);
}

static void add_curve(Loop *l, const TrimCurveDesc *d)
{
    int k = d->order;
    arb_ptr p = _arb_vec_init(3 * k), row = _arb_vec_init(k);
    for (int mu = k - 1; mu < d->n; mu++) {
        if (!(d->knots[mu] < d->knots[mu + 1])) continue;
        arb_ptr c = add_segment(l, k);
        for (int i = 0; i < k; i++) set_point(p + 3 * i, d->points[mu - k + 1 + i]);
        for (int x = 0; x < 3; x++)
            for (int r = 0; r < k; r++) {
                for (int i = 0; i < k; i++) arb_set(row + i, p + 3 * i + x);
                oracle_bezier_point(k, d->knots, mu, r, row, c + 3 * r + x);
            }
    }
    _arb_vec_clear(p, 3 * k), _arb_vec_clear(row, k);
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
    return last ? sum + last->x * first->y - last->y * first->x : 0;
}

static void read_loop(const TrimLoopDesc *d, Loop *out)
{
    const TrimCurveDesc *c = d->curves;
    *out = (Loop){ .area = area_of(d) };
    for (int i = 0; d->is_polyline && i < c->n; i++) add_line(out, c->points[i], c->points[(i + 1) % c->n]);
    for (int i = 0; !d->is_polyline && i < d->n_curves; i++) {   /* of clamped curves: their ends are control points */
        add_curve(out, &c[i]);
        add_line(out, c[i].points[c[i].n - 1], c[(i + 1) % d->n_curves].points[0]);
    }
}

OracleTrims *oracle_trims_new(const TrimLoopDesc *loops, int n)
{
    OracleTrims *t = malloc(sizeof *t);
    Loop *list = calloc((size_t)n + 1, sizeof *list);
    if (!t || !list) abort();
    *t = (OracleTrims){ list, n };
    for (int i = 0; i < n; i++) read_loop(&loops[i], &t->loop[i]);
    return t;
}

void oracle_trims_free(OracleTrims *t)
{
    for (int i = 0; i < t->n; i++) {
        Loop *l = &t->loop[i];
        for (int j = 0; j < l->n; j++) _arb_vec_clear(l->segment[j].c, 3 * l->segment[j].k);
        free(l->segment);
    }
    free(t->loop), free(t);
}

static Outcome cross_loop(View *e, const Loop *l, int *crossings)
{
    Outcome outcome = SETTLED;
    *crossings = 0;
    for (int i = 0; i < l->n && outcome == SETTLED; i++) {
        const Segment *s = &l->segment[i];
        arb_ptr c = _arb_vec_init(3 * s->k);
        _arb_vec_set(c, s->c, 3 * s->k);
        for (int r = 0; r < s->k; r++) look(e, c + 3 * r);
        outcome = cross_segment(e, c, s->k, 0, crossings);
        _arb_vec_clear(c, 3 * s->k);
    }
    return outcome;
}

bool oracle_winding(const OracleTrims *t, int loop, double u, double v, int *winding, double *distance)
{
    View e = { .nearest = INFINITY };
    arb_init(e.u), arb_init(e.v), arb_init(e.x), arb_init(e.y);
    arb_set_d(e.u, u), arb_set_d(e.v, v);
    Outcome outcome = UNDECIDED;
    for (e.turn = 0; e.turn < 4 && outcome == UNDECIDED; e.turn++) outcome = cross_loop(&e, &t->loop[loop], winding);
    arb_clear(e.u), arb_clear(e.v), arb_clear(e.x), arb_clear(e.y);
    *distance = e.nearest;
    return outcome == SETTLED;
}

bool oracle_keeps(const OracleTrims *t, bool keep_left, double u, double v, bool *is_kept, double *distance)
{
    double least = INFINITY, most = 0;
    bool inner = false, outer = true;
    *distance = INFINITY;
    for (int i = 0; i < t->n; i++) {
        int winding;
        if (!oracle_winding(t, i, u, v, &winding, distance)) return false;
        double area = fabs(t->loop[i].area);
        bool keeps_inside = (t->loop[i].area > 0) == keep_left;
        if (area > most) most = area, outer = !keeps_inside;   /* the greatest loop is not inside another */
        if (winding != 0 && area < least) least = area, inner = keeps_inside;
    }
    *is_kept = least < INFINITY ? inner : outer;
    return true;
}
