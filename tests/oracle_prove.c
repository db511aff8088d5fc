/* One root in a box, and but one: Krawczyk's test. See oracle.c for the formula, oracle_search.h for the rest. */
#include "tests/oracle_search.h"

#include <stdlib.h>

static int span_of(const Oracle *o, int axis, double x)
{
    int i = 0;
    while (i < o->spans[axis] - 1 && o->breaks[axis][i + 1] <= x) i++;
    return i;
}

/* s = (x - lo) / (hi - lo) of a span. */
static void to_local(const Oracle *o, int axis, int span, const arb_t x, arb_t s)
{
    arb_t lo, length;
    arb_init(lo), arb_init(length);
    arb_set_d(lo, o->breaks[axis][span]), arb_set_d(length, o->breaks[axis][span + 1]);
    arb_sub(length, length, lo, ORACLE_BITS), arb_sub(s, x, lo, ORACLE_BITS);
    arb_div(s, s, length, ORACLE_BITS);
    arb_clear(lo), arb_clear(length);
}

/* Values and derivatives by u and v of the first `nets` nets at (u, v): out[3 net + (0, 1, 2)]. */
static void evaluate(Search *k, arb_srcptr x, int nets, arb_ptr out)
{
    const Oracle *o = k->o;
    arb_ptr local = _arb_vec_init(2);
    arb_t length, lo;
    arb_init(length), arb_init(lo);
    int span[2];
    for (int axis = 0; axis < 2; axis++) {
        span[axis] = span_of(o, axis, oracle_double(x + axis));
        to_local(o, axis, span[axis], x + axis, local + axis);
    }
    arb_srcptr net = oracle_net_of(k, span[1] * o->spans[0] + span[0]);
    for (int m = 0; m < nets; m++)
        oracle_net_at(net + m * o->n, o->k[0], o->k[1], local, local + 1, out + 3 * m, out + 3 * m + 1, out + 3 * m + 2);
    for (int axis = 0; axis < 2; axis++) {
        arb_set_d(lo, o->breaks[axis][span[axis]]), arb_set_d(length, o->breaks[axis][span[axis] + 1]);
        arb_sub(length, length, lo, ORACLE_BITS);
        for (int m = 0; m < nets; m++) arb_div(out + 3 * m + 1 + axis, out + 3 * m + 1 + axis, length, ORACLE_BITS);
    }
    _arb_vec_clear(local, 2);
    arb_clear(length), arb_clear(lo);
}

/* One step of Newton's method from x; *step gets its length relative to the axes' scale. False: singular. */
static bool newton_step(Search *k, arb_ptr x, const double scale[2], double *step)
{
    arb_ptr f = _arb_vec_init(6);
    arb_t det, d[2];
    arb_init(det), arb_init(d[0]), arb_init(d[1]);
    evaluate(k, x, 2, f);
    arb_mul(det, f + 1, f + 5, ORACLE_BITS), arb_submul(det, f + 2, f + 4, ORACLE_BITS);
    arb_mul(d[0], f + 2, f + 3, ORACLE_BITS), arb_submul(d[0], f + 5, f, ORACLE_BITS);
    arb_mul(d[1], f + 4, f, ORACLE_BITS), arb_submul(d[1], f + 1, f + 3, ORACLE_BITS);
    bool ok = !arb_contains_zero(det);
    *step = 0;
    for (int axis = 0; ok && axis < 2; axis++) {
        arb_div(d[axis], d[axis], det, ORACLE_BITS);
        arb_add(x + axis, x + axis, d[axis], ORACLE_BITS);
        arb_get_mid_arb(x + axis, x + axis);             /* any point will do */
        *step = fmax(*step, fabs(oracle_double(d[axis])) / scale[axis]);
    }
    arb_clear(det), arb_clear(d[0]), arb_clear(d[1]);
    _arb_vec_clear(f, 6);
    return ok;
}

/* ---- where to look: in double, which proves nothing ---- */

/* Value and derivative at x of k coefficients. */
static void row_in_double(const double *c, int k, double x, double *value, double *derivative)
{
    double d[NURBS_MAX_ORDER];
    d[0] = d[1] = 0;         /* compilers do not know that k >= 2 */
    for (int i = 0; i < k; i++) d[i] = c[i];
    for (int level = 1; level < k - 1; level++)
        for (int i = 0; i < k - level; i++) d[i] += x * (d[i + 1] - d[i]);
    *derivative = (k - 1) * (d[1] - d[0]);
    *value = d[0] + x * (d[1] - d[0]);
}

typedef struct { double value, by_s, by_t; } Point;

static Point net_in_double(const Oracle *o, const double *c, const double x[2])
{
    double values[NURBS_MAX_ORDER], slopes[NURBS_MAX_ORDER], unused;
    for (int j = 0; j < o->k[1]; j++) row_in_double(c + j * o->k[0], o->k[0], x[0], &values[j], &slopes[j]);
    Point p;
    row_in_double(values, o->k[1], x[1], &p.value, &p.by_t);
    row_in_double(slopes, o->k[1], x[1], &p.by_s, &unused);
    return p;
}

/* Newton's method on a box's net, in the box's own coordinates. False: it leaves the box's neighbourhood, or does not
 * settle. */
static bool guess_root(const Oracle *o, const Rounded *net, double x[2])
{
    x[0] = x[1] = .5;
    for (int i = 0; i < 12; i++) {
        Point a = net_in_double(o, net->c + A * o->n, x), b = net_in_double(o, net->c + B * o->n, x);
        double det = a.by_s * b.by_t - a.by_t * b.by_s;
        double ds = (a.by_t * b.value - b.by_t * a.value) / det, dt = (b.by_s * a.value - a.by_s * b.value) / det;
        x[0] += ds, x[1] += dt;
        if (!(fabs(x[0]) <= 3 && fabs(x[1]) <= 3)) return false;
        if (fabs(ds) < 1e-9 && fabs(dt) < 1e-9) return true;
    }
    return false;
}

/* ---- proof ---- */

/* The hull over an area of the Jacobian by (u, v), of the weight and of its derivatives. */
typedef struct { Range j[2][2], w_slope[2]; double w_max; } Hull;

static void add_span(Search *k, const Area *x, int i, int j, Hull *h, double *room)
{
    const Oracle *o = k->o;
    arb_ptr net = _arb_vec_init(NETS * o->n), ends = _arb_vec_init(2);
    _arb_vec_set(net, oracle_net_of(k, j * o->spans[0] + i), NETS * o->n);
    const int span[2] = { i, j };
    double length[2];
    for (int axis = 0; axis < 2; axis++) {
        const double *b = o->breaks[axis] + span[axis];      /* beyond the domain the outermost spans go on */
        double lo = span[axis] == 0 ? x->lo[axis] : fmax(x->lo[axis], b[0]);
        double hi = span[axis] == o->spans[axis] - 1 ? x->hi[axis] : fmin(x->hi[axis], b[1]);
        arb_set_d(ends, lo), arb_set_d(ends + 1, hi);
        length[axis] = hi - lo;
        to_local(o, axis, span[axis], ends, ends), to_local(o, axis, span[axis], ends + 1, ends + 1);
        int k_a = o->k[axis], rows = NETS * o->n / k_a;
        for (int r = 0; r < rows; r++) {
            arb_ptr row = net + (axis == 0 ? r * k_a : r / o->k[0] * o->n + r % o->k[0]);
            oracle_row_restrict(row, axis == 0 ? 1 : o->k[0], k_a, ends, ends + 1);
        }
    }
    Rounded r;
    oracle_round_net(o, net, room, &r);
    for (int axis = 0; axis < 2; axis++) {
        double error = 4 * o->k[axis] * r.margin / length[axis];
        for (int f = 0; f < 2; f++) {
            Range d = oracle_derivative_range(o, r.c + f * o->n, axis);
            h->j[f][axis] = range_add(range_add(h->j[f][axis], d.lo / length[axis] - error), d.hi / length[axis] + error);
        }
        Range d = oracle_derivative_range(o, r.c + W * o->n, axis);
        h->w_slope[axis] = range_add(range_add(h->w_slope[axis], d.lo / length[axis]), d.hi / length[axis]);
    }
    for (int c = 0; c < o->n; c++) h->w_max = fmax(h->w_max, r.c[W * o->n + c]);
    _arb_vec_clear(net, NETS * o->n), _arb_vec_clear(ends, 2);
}

static Hull hull_over(Search *k, const Area *x)
{
    const Oracle *o = k->o;
    Hull h = { { { range_empty, range_empty }, { range_empty, range_empty } }, { range_empty, range_empty }, 0 };
    double *room = calloc((size_t)(NETS * o->n), sizeof *room);
    for (int j = span_of(o, 1, x->lo[1]); j < o->spans[1]; j++) {
        if (j > 0 && o->breaks[1][j] >= x->hi[1]) break;
        for (int i = span_of(o, 0, x->lo[0]); i < o->spans[0]; i++) {
            if (i > 0 && o->breaks[0][i] >= x->hi[0]) break;
            add_span(k, x, i, j, &h, room);
        }
    }
    free(room);
    return h;
}

static double largest(const arb_t x) { return fabs(oracle_double(x)) + oracle_radius(x); }

/* Krawczyk's test. a: A; q: |I - A J| h / h, axis by axis; off: |A F(x)|, moved: |A (band w)|. */
typedef struct { Matrix a; double q[2], off[2], moved[2]; } Proof;

static bool prove(Search *k, arb_srcptr x, const Area *area, const double h[2], Proof *out)
{
    arb_ptr f = _arb_vec_init(6);
    evaluate(k, x, 2, f);
    double a = oracle_double(f + 1), b = oracle_double(f + 2), c = oracle_double(f + 4), d = oracle_double(f + 5);
    double det = a * d - b * c, f1 = largest(f), f2 = largest(f + 3);
    _arb_vec_clear(f, 6);
    if (!(fabs(det) > 0) || !isfinite(1 / det)) return false;
    *out = (Proof){ .a = { { { d / det, -b / det }, { -c / det, a / det } } } };
    Hull hull = hull_over(k, area);
    bool ok = true;
    for (int i = 0; i < 2; i++) {
        double a1 = out->a.j[i][0], a2 = out->a.j[i][1], sum = 0;
        for (int axis = 0; axis < 2; axis++) {
            Range j1 = hull.j[0][axis], j2 = hull.j[1][axis];
            double w = k->band * fmax(fabs(hull.w_slope[axis].lo), fabs(hull.w_slope[axis].hi));
            double lo = fmin(a1 * j1.lo, a1 * j1.hi) + fmin(a2 * j2.lo, a2 * j2.hi);
            double hi = fmax(a1 * j1.lo, a1 * j1.hi) + fmax(a2 * j2.lo, a2 * j2.hi);
            double terms = fabs(a1) * fmax(-j1.lo, j1.hi) + fabs(a2) * fmax(-j2.lo, j2.hi), margin = 0x1p-48 * fabs(terms);
            double unit = i == axis, spread = fmax(fabs(lo - unit), fabs(hi - unit)) + margin + (fabs(a1) + fabs(a2)) * w;
            sum += spread * h[axis];
        }
        out->off[i] = (fabs(a1) * f1 + fabs(a2) * f2) * (1 + 1e-9);
        out->moved[i] = (fabs(a1) + fabs(a2)) * k->band * hull.w_max;
        out->q[i] = sum / h[i];
        ok = ok && out->off[i] + out->moved[i] + sum < h[i] * (1 - 1e-9);
    }
    return ok;
}

static bool is_within(const Area *x, const double at[2])
{
    return x->lo[0] < at[0] && at[0] < x->hi[0] && x->lo[1] < at[1] && at[1] < x->hi[1];
}

void *oracle_grow(void *list, int n, size_t size)
{
    if (n & (n - 1)) return list;
    list = realloc(list, (n ? 2 * (size_t)n : 1) * size);
    if (!list) abort();
    return list;
}

/* What is known of the root at x, refined: how far it is from x at most, its t, what moves it. */
static OracleRoot describe(Search *k, arb_srcptr x, const Proof *p)
{
    const Oracle *o = k->o;
    OracleRoot r = { .u = oracle_double(x), .v = oracle_double(x + 1), .is_sure = true };
    arb_ptr f = _arb_vec_init(3 * NETS);
    arb_t t, tail;
    arb_init(t), arb_init(tail);
    evaluate(k, x, NETS, f);
    arb_div(t, f + 3 * T, f + 3 * W, ORACLE_BITS);
    r.t = oracle_double(t);
    arb_set_d(tail, r.t), arb_sub(tail, t, tail, ORACLE_BITS);
    r.t_tail = oracle_double(tail);
    double w = oracle_double(f + 3 * W), slope[2], error[2], *box[2] = { r.u_box, r.v_box };
    const double at[2] = { r.u, r.v };
    r.t_error = oracle_radius(tail);
    r.residual = 0;
    for (int c = 0; c < 2; c++) r.residual = fmax(r.residual, largest(f + 3 * c) / w);
    for (int axis = 0; axis < 2; axis++) {
        slope[axis] = (oracle_double(f + 3 * T + 1 + axis) - r.t * oracle_double(f + 3 * W + 1 + axis)) / w;
        double shrink = 1 - fmax(p->q[0], p->q[1]), *a = (double *)p->a.j[axis];
        error[axis] = (fabs(a[0]) + fabs(a[1])) * r.residual * w / shrink;
        double moved = p->moved[axis] / shrink;
        box[axis][0] = nextafter(at[axis] - error[axis], -INFINITY);
        box[axis][1] = nextafter(at[axis] + error[axis], INFINITY);
        r.is_sure = r.is_sure && at[axis] - moved > o->breaks[axis][0] && at[axis] + moved < o->breaks[axis][o->spans[axis]];
        r.t_error += 2 * fabs(slope[axis]) * error[axis];
    }
    for (int c = 0; c < 2; c++)
        r.t_moves += 1.5 * k->band * w * fabs(slope[0] * p->a.j[0][c] + slope[1] * p->a.j[1][c]);
    _arb_vec_clear(f, 3 * NETS);
    arb_clear(t), arb_clear(tail);
    return r;
}

/* Is the root (or may it be) on the domain? Exactly on the border counts, as far as the proof goes. */
static bool is_on_domain(const Search *k, const OracleRoot *r, const Proof *p)
{
    const Oracle *o = k->o;
    const double *box[2] = { r->u_box, r->v_box };
    for (int axis = 0; axis < 2; axis++) {
        double moved = p->moved[axis] / (1 - fmax(p->q[0], p->q[1]));
        if (box[axis][1] + moved < o->breaks[axis][0]) return false;
        if (box[axis][0] - moved > o->breaks[axis][o->spans[axis]]) return false;
    }
    return true;
}

bool oracle_certify(Search *k, const Area *box, const Rounded *net)
{
    double start[2];
    if (!guess_root(k->o, net, start)) return false;
    const double scale[2] = { box->hi[0] - box->lo[0], box->hi[1] - box->lo[1] };
    arb_ptr x = _arb_vec_init(2);
    for (int axis = 0; axis < 2; axis++) arb_set_d(x + axis, box->lo[axis] + start[axis] * scale[axis]);
    double step = 1, at[2], h[2];
    bool ok = true;
    for (int i = 0; ok && i < 6 && step > 1e-20; i++) {
        ok = newton_step(k, x, scale, &step);
        for (int axis = 0; axis < 2; axis++) at[axis] = oracle_double(x + axis);
        for (int axis = 0; axis < 2; axis++) ok = ok && fabs(at[axis] - box->lo[axis]) <= 3 * scale[axis];
    }
    Found f;
    for (int axis = 0; axis < 2; axis++) {
        h[axis] = 1.0625 * fmax(fmax(at[axis] - box->lo[axis], box->hi[axis] - at[axis]), 0);
        f.alone.lo[axis] = at[axis] - h[axis], f.alone.hi[axis] = at[axis] + h[axis];
        h[axis] = fmax(at[axis] - f.alone.lo[axis], f.alone.hi[axis] - at[axis]);   /* as rounded */
    }
    Proof p;
    ok = ok && step <= 1e-20 && prove(k, x, &f.alone, h, &p);
    if (ok) {
        for (int i = 0; i < 3 && ok && step > 1e-36; i++) ok = newton_step(k, x, scale, &step);
        f.root = describe(k, x, &p);
        f.counts = is_on_domain(k, &f.root, &p);
        for (int i = 0; i < k->n_found; i++) {
            const double other[2] = { k->found[i].root.u, k->found[i].root.v };
            f.counts = f.counts && !is_within(&f.alone, other);
        }
        k->found = oracle_grow(k->found, k->n_found, sizeof *k->found);
        k->found[k->n_found++] = f;
    }
    _arb_vec_clear(x, 2);
    return ok;
}
