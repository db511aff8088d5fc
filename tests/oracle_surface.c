/* Extraction of Bezier patches, and their nets as a ray sees them. See oracle_search.h. */
#include "tests/oracle_search.h"

#include <stdlib.h>

/* ---- extraction ---- */

typedef struct { int mu[4096]; int n; } Spans;

static void find_spans(int k, int n, const double *tau, Spans *s)
{
    s->n = 0;
    for (int mu = k - 1; mu < n; mu++)
        if (tau[mu] < tau[mu + 1] && s->n < 4096) s->mu[s->n++] = mu;
}

/* to = m_u from m_v^T, for one coordinate of a patch. */
static void extract(const Oracle *o, arb_srcptr m_u, arb_srcptr m_v, arb_srcptr from, arb_ptr to)
{
    int k_u = o->k[0], k_v = o->k[1];
    arb_ptr half = _arb_vec_init(o->n);
    for (int j = 0; j < k_v; j++)
        for (int r = 0; r < k_u; r++)
            arb_dot(half + j * k_u + r, NULL, 0, m_u + r * k_u, 1, from + j * k_u, 1, k_u, ORACLE_BITS);
    for (int r = 0; r < k_v; r++)
        for (int i = 0; i < k_u; i++)
            arb_dot(to + r * k_u + i, NULL, 0, m_v + r * k_v, 1, half + i, k_u, k_v, ORACLE_BITS);
    _arb_vec_clear(half, o->n);
}

/* The homogeneous coordinate m (0 .. 3) of the control points that matter in a span. */
static void gather(const SurfaceDesc *d, int mu_u, int mu_v, int m, arb_ptr out)
{
    arb_t w;
    arb_init(w);
    for (int j = 0; j < d->order_v; j++)
        for (int i = 0; i < d->order_u; i++) {
            const Vec4 *p = &d->points[(mu_v - d->order_v + 1 + j) * d->n_u + mu_u - d->order_u + 1 + i];
            const double x[4] = { p->x, p->y, p->z, 1 };
            arb_ptr to = out + j * d->order_u + i;
            arb_set_d(to, x[m]), arb_set_d(w, p->w);
            arb_mul(to, to, w, ORACLE_BITS);
        }
    arb_clear(w);
}

/* The control points' ball, with far more room than its numbers' rounding takes. */
static Ball ball_of(const Oracle *o, arb_srcptr p)
{
    Ball b = { { 0, 0, 0 }, 0 };
    Vec3 *at = calloc((size_t)o->n, sizeof *at);
    if (!at) abort();
    for (int i = 0; i < o->n; i++) {
        double w = oracle_double(p + 3 * o->n + i);
        at[i] = vec(oracle_double(p + i) / w, oracle_double(p + o->n + i) / w, oracle_double(p + 2 * o->n + i) / w);
        b.centre = vec_add(b.centre, vec_scale(at[i], 1. / o->n));
    }
    for (int i = 0; i < o->n; i++) b.radius = fmax(b.radius, vec_length(vec_sub(at[i], b.centre)));
    b.radius += 1e-9 * (b.radius + vec_length(b.centre));
    free(at);
    return b;
}

bool oracle_is_far(const Oracle *o, int span, const Ray *r, double band)
{
    Ball b = o->ball[span];
    Vec3 way = vec_sub(b.centre, r->origin), across = vec_cross(way, vec_normalize(r->dir));
    return vec_length(across) > b.radius + band + 1e-9 * vec_length(way);
}

Oracle *oracle_new(const SurfaceDesc *d)
{
    Oracle *o = calloc(1, sizeof *o);
    o->k[0] = d->order_u, o->k[1] = d->order_v, o->n = d->order_u * d->order_v;
    const int n[2] = { d->n_u, d->n_v };
    const double *tau[2] = { d->knots_u, d->knots_v };
    Spans *spans = calloc(2, sizeof *spans);
    arb_ptr matrix[2];
    for (int a = 0; a < 2; a++) {
        int k = o->k[a];
        find_spans(k, n[a], tau[a], &spans[a]);
        o->spans[a] = spans[a].n;
        o->breaks[a] = calloc((size_t)spans[a].n + 1, sizeof(double));
        matrix[a] = _arb_vec_init(spans[a].n * k * k);
        for (int i = 0; i < spans[a].n; i++) {
            o->breaks[a][i] = tau[a][spans[a].mu[i]], o->breaks[a][i + 1] = tau[a][spans[a].mu[i] + 1];
            oracle_span_matrix(k, tau[a], spans[a].mu[i], matrix[a] + i * k * k);
        }
    }
    o->patch = calloc((size_t)o->spans[0] * (size_t)o->spans[1], sizeof *o->patch);
    o->ball = calloc((size_t)o->spans[0] * (size_t)o->spans[1], sizeof *o->ball);
    arb_ptr points = _arb_vec_init(o->n);
    for (int j = 0; j < o->spans[1]; j++)
        for (int i = 0; i < o->spans[0]; i++) {
            arb_ptr p = o->patch[j * o->spans[0] + i] = _arb_vec_init(4 * o->n);
            for (int m = 0; m < 4; m++) {
                gather(d, spans[0].mu[i], spans[1].mu[j], m, points);
                extract(o, matrix[0] + i * o->k[0] * o->k[0], matrix[1] + j * o->k[1] * o->k[1], points, p + m * o->n);
            }
            o->ball[j * o->spans[0] + i] = ball_of(o, p);
        }
    _arb_vec_clear(points, o->n);
    for (int a = 0; a < 2; a++) _arb_vec_clear(matrix[a], spans[a].n * o->k[a] * o->k[a]);
    free(spans);
    return o;
}

void oracle_free(Oracle *o)
{
    for (int i = 0; i < o->spans[0] * o->spans[1]; i++) _arb_vec_clear(o->patch[i], 4 * o->n);
    free(o->patch), free(o->ball), free(o->breaks[0]), free(o->breaks[1]), free(o);
}

/* ---- a ray ---- */

static void cross(arb_srcptr a, arb_srcptr b, arb_ptr c)
{
    for (int i = 0; i < 3; i++) {
        arb_mul(c + i, a + (i + 1) % 3, b + (i + 2) % 3, ORACLE_BITS);
        arb_submul(c + i, a + (i + 2) % 3, b + (i + 1) % 3, ORACLE_BITS);
    }
}

static void divide_by_length(arb_ptr a, bool twice)
{
    arb_t l;
    arb_init(l);
    arb_dot(l, NULL, 0, a, 1, a, 1, 3, ORACLE_BITS);
    if (!twice) arb_sqrt(l, l, ORACLE_BITS);
    for (int i = 0; i < 3; i++) arb_div(a + i, a + i, l, ORACLE_BITS);
    arb_clear(l);
}

void oracle_begin_search(Search *k, const Oracle *o, const Ray *r, double band)
{
    const double d[3] = { r->dir.x, r->dir.y, r->dir.z }, origin[3] = { r->origin.x, r->origin.y, r->origin.z };
    *k = (Search){ .o = o, .band = band, .speed = vec_length(r->dir), .rows = _arb_vec_init(9), .origin = _arb_vec_init(3) };
    k->net = calloc((size_t)o->spans[0] * (size_t)o->spans[1], sizeof *k->net);
    int least = fabs(d[0]) <= fabs(d[1]) && fabs(d[0]) <= fabs(d[2]) ? 0 : fabs(d[1]) <= fabs(d[2]) ? 1 : 2;
    arb_ptr e = _arb_vec_init(3);
    arb_one(e + least);
    for (int i = 0; i < 3; i++) arb_set_d(k->rows + 6 + i, d[i]), arb_set_d(k->origin + i, origin[i]);
    cross(k->rows + 6, e, k->rows);
    cross(k->rows + 6, k->rows, k->rows + 3);
    divide_by_length(k->rows, false), divide_by_length(k->rows + 3, false), divide_by_length(k->rows + 6, true);
    _arb_vec_clear(e, 3);
}

void oracle_end_search(Search *k)
{
    for (int i = 0; i < k->o->spans[0] * k->o->spans[1]; i++)
        if (k->net[i]) _arb_vec_clear(k->net[i], NETS * k->o->n);
    _arb_vec_clear(k->rows, 9), _arb_vec_clear(k->origin, 3);
    free(k->net), free(k->found), free(k->clusters);
}

arb_srcptr oracle_net_of(Search *k, int span)
{
    if (k->net[span]) return k->net[span];
    int n = k->o->n;
    arb_srcptr p = k->o->patch[span];
    arb_ptr net = k->net[span] = _arb_vec_init(NETS * n), x = _arb_vec_init(3);
    for (int i = 0; i < n; i++) {
        for (int m = 0; m < 3; m++) {
            arb_mul(x + m, p + 3 * n + i, k->origin + m, ORACLE_BITS);
            arb_sub(x + m, p + m * n + i, x + m, ORACLE_BITS);
        }
        for (int m = 0; m < 3; m++)
            arb_dot(net + m * n + i, NULL, 0, k->rows + 3 * m, 1, x, 1, 3, ORACLE_BITS);
        arb_set(net + W * n + i, p + 3 * n + i);
    }
    _arb_vec_clear(x, 3);
    return net;
}

/* ---- nets in double ---- */

void oracle_round_net(const Oracle *o, arb_srcptr net, double *room, Rounded *out)
{
    out->c = room, out->margin = 0;
    for (int i = 0; i < NETS * o->n; i++) {
        room[i] = oracle_double(net + i);
        if (i < 2 * o->n) out->margin = fmax(out->margin, oracle_radius(net + i));
    }
}

Range oracle_derivative_range(const Oracle *o, const double *c, int axis)
{
    int k_u = o->k[0], step = axis ? k_u : 1;
    Range r = range_empty;
    for (int j = 0; j < o->k[1] - (axis == 1); j++)
        for (int i = 0; i < k_u - (axis == 0); i++)
            r = range_add(r, (o->k[axis] - 1) * (c[j * k_u + i + step] - c[j * k_u + i]));
    return r;
}
