/* All roots of a ray and a surface, with proof. See oracle.h.
 *
 * With n1, n2 unit and perpendicular to the ray (built from its direction without rounding, but for their lengths), the
 * homogeneous surface (P, w) gives the net F = (n1.(P - w o), n2.(P - w o)), and t = d.(P - w o) / (w d.d). The nets are
 * balls of ORACLE_BITS bits; those of boxes, which only tell where there is nothing, are in fixed point with a counted
 * error. Decisions are taken on numbers rounded to double, with all errors added to the margin: what is too near to decide
 * is split further.
 *
 *   exclude   a box has no root if some combination of the two components has coefficients of one sign only. Besides the
 *             components themselves the two are tried that do not feel one of the parameters: near a tangency these are
 *             what shrinks with the square of the box;
 *   certify   with A the inverse Jacobian at a Newton iterate x, on the box X = x +- h (over as many spans as it meets,
 *             beyond the domain too): if |A F(x)| + |I - A J(X)| h < h, then there is one root in X, and but one
 *             ([Kra69]; J is the hull of the Jacobians, which makes it hold across knots where the surface is only
 *             continuous).
 *
 * A ray moved by up to `band` is F + e w with |e1|, |e2| <= band, in both tests. */
#include "tests/oracle_search.h"

#include <stdlib.h>

enum { MAX_BOXES = 20000 };      /* a ray in the surface: what is left then is a cluster */
#define MIN_WIDTH 0x1p-45        /* of a patch */
/* Where the band is as wide as the sagitta of a chord, that is sqrt(8 band R) long: boxes are split to this share of
 * that, with the size of the patch for the radius R. */
#define ENOUGH 0x1p-6

/* ---- nets in double ---- */

/* Has alpha a + beta b (+ up to the band) one sign? */
static bool has_one_sign(const Search *k, const Rounded *r, double alpha, double beta)
{
    int n = k->o->n;
    bool above = true, below = true;
    double size = fabs(alpha) + fabs(beta);
    for (int i = 0; i < n && (above || below); i++) {
        double a = alpha * r->c[i], b = beta * r->c[n + i], e = size * k->band * r->c[W * n + i];
        double margin = size * r->margin + 0x1p-50 * (fabs(a) + fabs(b) + e);
        above = above && a + b - e > margin, below = below && a + b + e < -margin;
    }
    return above || below;
}

static Matrix mean_jacobian(const Oracle *o, const double *c)
{
    Matrix m;
    for (int f = 0; f < 2; f++)
        for (int axis = 0; axis < 2; axis++) {
            Range r = oracle_derivative_range(o, c + f * o->n, axis);
            m.j[f][axis] = (r.lo + r.hi) / 2;
        }
    return m;
}

static bool is_excluded(const Search *k, const Rounded *r, const Matrix *m)
{
    if (has_one_sign(k, r, 1, 0) || has_one_sign(k, r, 0, 1)) return true;
    for (int axis = 0; axis < 2; axis++) {
        double l = hypot(m->j[0][axis], m->j[1][axis]);
        if (l > 0 && has_one_sign(k, r, m->j[1][axis] / l, -m->j[0][axis] / l)) return true;
    }
    return false;
}

/* ---- search ---- */

/* `net` is in fixed point, NETS * n coefficients, each off by `error` units at most. */
typedef struct { int span; double s[2], width[2]; Fixed *net; double unit[NETS], error; } Box;

static Fixed *new_net(const Oracle *o)
{
    Fixed *net = malloc((size_t)(NETS * o->n) * sizeof *net);
    if (!net) abort();
    return net;
}

static Box whole_span(Search *k, int span)
{
    int n = k->o->n;
    Box b = { .span = span, .width = { 1, 1 }, .net = new_net(k->o), .error = 1 };
    for (int m = 0; m < NETS; m++) b.unit[m] = oracle_to_fixed(oracle_net_of(k, span) + m * n, n, b.net + m * n);
    return b;
}

static Rounded round_box(const Oracle *o, const Box *b, double *room)
{
    Rounded r = { room, 0 };
    for (int i = 0; i < NETS * o->n; i++) {
        double unit = b->unit[i / o->n];
        room[i] = (double)b->net[i] * unit;
        if (i < 2 * o->n) r.margin = fmax(r.margin, 0x1p-52 * fabs(room[i]) + b->error * unit);
    }
    return r;
}

static Area area_of(const Oracle *o, const Box *b)
{
    Area a;
    const int span[2] = { b->span % o->spans[0], b->span / o->spans[0] };
    for (int axis = 0; axis < 2; axis++) {
        double lo = o->breaks[axis][span[axis]], length = o->breaks[axis][span[axis] + 1] - lo;
        a.lo[axis] = nextafter(lo + b->s[axis] * length, -INFINITY);
        a.hi[axis] = nextafter(lo + (b->s[axis] + b->width[axis]) * length, INFINITY);
    }
    return a;
}

static bool is_covered(const Search *k, const Area *a)
{
    for (int i = 0; i < k->n_found; i++) {
        const Area *x = &k->found[i].alone;
        if (x->lo[0] < a->lo[0] && a->hi[0] < x->hi[0] && x->lo[1] < a->lo[1] && a->hi[1] < x->hi[1]) return true;
    }
    return false;
}

static void keep_cluster(Search *k, const Area *a, const Rounded *r)
{
    int n = k->o->n;
    Range t = range_empty;
    double residual = 0;
    for (int i = 0; i < n; i++) {
        double w = r->c[W * n + i];
        t = range_add(t, r->c[T * n + i] / w);
        residual = fmax(residual, hypot(r->c[i], r->c[n + i]) / w);
    }
    OracleRoot root = { .is_cluster = true, .u = a->lo[0] / 2 + a->hi[0] / 2, .v = a->lo[1] / 2 + a->hi[1] / 2,
                        .u_box = { a->lo[0], a->hi[0] }, .v_box = { a->lo[1], a->hi[1] }, .t = t.lo / 2 + t.hi / 2,
                        .t_error = (t.hi - t.lo) / 2 * (1 + 1e-9) + 0x1p-50 * fabs(t.hi), .residual = residual };
    root.t_moves = root.t_error;
    k->clusters = oracle_grow(k->clusters, k->n_clusters, sizeof *k->clusters);
    k->clusters[k->n_clusters++] = root;
}

/* Could A J be near the unit matrix all over the box? */
static bool is_promising(const Oracle *o, const Rounded *r, const Matrix *m)
{
    double det = m->j[0][0] * m->j[1][1] - m->j[0][1] * m->j[1][0];
    if (!(fabs(det) > 0)) return false;
    for (int i = 0; i < 2; i++) {
        double a1 = (i ? -m->j[1][0] : m->j[1][1]) / det, a2 = (i ? m->j[0][0] : -m->j[0][1]) / det, sum = 0;
        for (int axis = 0; axis < 2; axis++) {
            Range d1 = oracle_derivative_range(o, r->c, axis), d2 = oracle_derivative_range(o, r->c + o->n, axis);
            sum += fabs(a1) * (d1.hi - d1.lo) / 2 + fabs(a2) * (d2.hi - d2.lo) / 2;
        }
        if (!(sum < 0.5)) return false;
    }
    return true;
}

/* Along which axis is the image of the box longer? -1: the box is not to be split. */
static int axis_to_split(const Search *k, const Box *b, const Rounded *r)
{
    double length[2];
    for (int axis = 0; axis < 2; axis++) {
        Range d1 = oracle_derivative_range(k->o, r->c, axis), d2 = oracle_derivative_range(k->o, r->c + k->o->n, axis);
        length[axis] = fmax(fmax(-d1.lo, d1.hi), fmax(-d2.lo, d2.hi));
        if (b->width[axis] <= MIN_WIDTH) length[axis] = -1;
    }
    if (length[0] < 0 && length[1] < 0) return -1;
    return length[0] >= length[1] ? 0 : 1;
}

static Box halve(const Oracle *o, Box *b, int axis)
{
    Box right = *b;
    right.net = new_net(o);
    int k_a = o->k[axis];
    for (int r = 0; r < NETS * o->n / k_a; r++) {
        int at = axis == 0 ? r * k_a : r / o->k[0] * o->n + r % o->k[0];
        oracle_fixed_halve(b->net + at, right.net + at, axis == 0 ? 1 : o->k[0], k_a);
    }
    b->error = right.error = b->error + .5 * (k_a - 1);
    b->width[axis] /= 2, right.width[axis] /= 2;
    right.s[axis] += right.width[axis];
    return right;
}

/* How far apart the control points of a box are, in space: a bound for the box. */
static double size_of(const Search *k, const Rounded *r)
{
    int n = k->o->n;
    Range x[3] = { range_empty, range_empty, range_empty };
    for (int i = 0; i < n; i++)
        for (int m = 0; m < 3; m++) x[m] = range_add(x[m], r->c[m * n + i] / r->c[W * n + i]);
    return hypot(hypot(x[A].hi - x[A].lo, x[B].hi - x[B].lo), (x[T].hi - x[T].lo) * k->speed);
}

/* Within the band all over, or no longer than where the band's tangents end: splitting it tells no more. */
static bool is_enough(const Search *k, const Rounded *r)
{
    bool is_in = k->band > 0;
    for (int i = 0; i < k->o->n && is_in; i++)
        is_in = fmax(fabs(r->c[i]), fabs(r->c[k->o->n + i])) <= k->band * r->c[W * k->o->n + i];
    return is_in || (k->band > 0 && size_of(k, r) <= k->enough);
}

static void search_box(Search *k, Box b, double *room)
{
    Rounded r = round_box(k->o, &b, room);
    Matrix m = mean_jacobian(k->o, r.c);
    Area a = area_of(k->o, &b);
    bool is_done = is_excluded(k, &r, &m) || is_covered(k, &a);
    if (!is_done && is_promising(k->o, &r, &m)) is_done = oracle_certify(k, &a, &r);
    int axis = is_done || is_enough(k, &r) ? -1 : axis_to_split(k, &b, &r);
    if (!is_done && (axis < 0 || ++k->n_boxes > MAX_BOXES)) keep_cluster(k, &a, &r), is_done = true;
    if (!is_done) {
        Box right = halve(k->o, &b, axis);
        search_box(k, right, room);
        search_box(k, b, room);
        return;
    }
    free(b.net);
}

/* ---- results ---- */

static bool is_touching(const OracleRoot *a, const OracleRoot *b)
{
    return a->u_box[0] <= b->u_box[1] && b->u_box[0] <= a->u_box[1]
        && a->v_box[0] <= b->v_box[1] && b->v_box[0] <= a->v_box[1];
}

static void join(OracleRoot *a, const OracleRoot *b)
{
    double lo = fmin(a->t - a->t_error, b->t - b->t_error), hi = fmax(a->t + a->t_error, b->t + b->t_error);
    for (int i = 0; i < 2; i++) {
        double (*least)(double, double) = i ? fmax : fmin;
        a->u_box[i] = least(a->u_box[i], b->u_box[i]), a->v_box[i] = least(a->v_box[i], b->v_box[i]);
    }
    a->u = (a->u_box[0] + a->u_box[1]) / 2, a->v = (a->v_box[0] + a->v_box[1]) / 2;
    a->t = lo / 2 + hi / 2, a->t_error = a->t_moves = (hi - lo) / 2 * (1 + 1e-9);
    a->residual = fmax(a->residual, b->residual);
}

/* Joins clusters that touch. */
static void join_clusters(Search *k)
{
    int n = 0;
    for (int i = 0; i < k->n_clusters; i++) {
        OracleRoot root = k->clusters[i];
        for (int j = 0; j < n; j++) {
            if (!is_touching(&root, &k->clusters[j])) continue;
            join(&root, &k->clusters[j]);
            k->clusters[j] = k->clusters[--n];
            j = -1;
        }
        k->clusters[n++] = root;
    }
    k->n_clusters = n;
}

static int by_t(const void *a, const void *b)
{
    double x = ((const OracleRoot *)a)->t, y = ((const OracleRoot *)b)->t;
    return (x > y) - (x < y);
}

int oracle_roots(const Oracle *o, const Ray *r, double band, OracleRoot *out, int max)
{
    Search k;
    oracle_begin_search(&k, o, r, band);
    double *room = calloc((size_t)(NETS * o->n), sizeof *room);
    for (int i = 0; i < o->spans[0] * o->spans[1]; i++) {
        if (oracle_is_far(o, i, r, band)) continue;
        Box b = whole_span(&k, i);
        Rounded whole = round_box(o, &b, room);
        k.enough = sqrt(band * size_of(&k, &whole)) * ENOUGH;
        search_box(&k, b, room);
    }
    free(room);
    join_clusters(&k);
    int n = 0;
    OracleRoot *all = calloc((size_t)(k.n_found + k.n_clusters + 1), sizeof *all);
    for (int i = 0; i < k.n_found; i++)
        if (k.found[i].counts) all[n++] = k.found[i].root;
    for (int i = 0; i < k.n_clusters; i++) all[n++] = k.clusters[i];
    qsort(all, (size_t)n, sizeof *all, by_t);
    for (int i = 0; i < n && i < max; i++) out[i] = all[i];
    free(all);
    oracle_end_search(&k);
    return n;
}
