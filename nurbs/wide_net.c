/* Control nets to twice the precision of a double. See wide_net.h.
 *
 * What closing does to k points is a matrix, the same for all rows of a span: it is made once, and applied by sums of
 * products that keep what each operation rounds off ([ORO05] algorithm 5.3, Dot2). A term's product, its sum, and the
 * products with low parts leave four numbers that come to (k + 3) u times the sum of all sizes at most; these are summed in
 * doubles, by four roundings a term: 4 (k+1) (k+3) u^2 of the sizes in all. The entries of a row are positive and their sum
 * is 1, so that the sizes are those of the points. */
#include "nurbs/wide_net.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "render/simd.h"

#include <string.h>

/* x - w to. Only what is below the low parts' last bits is lost: 12 u^2 of x and w to. */
static void move(double *hi, double *lo, double w, double w_lo, double to)
{
    Wide product = wide_product(w, to), rest = wide_sum(*hi, -product.hi);
    Wide moved = wide_fast_sum(rest.hi, (rest.lo - product.lo) + (*lo - w_lo * to));
    *hi = moved.hi, *lo = moved.lo;
}

EVERY_X86
void wide_net_move(WideNet net, size_t n, Vec3 to)
{
    for (size_t i = 0; i < n; i++) {
        Vec4 *h = &net.hi[i], *l = &net.lo[i];
        move(&h->x, &l->x, h->w, l->w, to.x);
        move(&h->y, &l->y, h->w, l->w, to.y);
        move(&h->z, &l->z, h->w, l->w, to.z);
    }
}

/* ---- the matrices of closing ---- */

static bool is_closed(int k, const double *tau, int mu)
{
    return tau[mu - k + 2] == tau[mu] && tau[mu + k - 1] == tau[mu + 1];
}

static const Wide *closing_of(Arena *a, int k, const double *tau, int mu)
{
    if (is_closed(k, tau, mu)) return NULL;
    Wide *m = ARENA_ARRAY(a, Wide, k * k);
    for (int i = 0; i < k * k; i++) m[i] = wide(i % (k + 1) == 0);
    bezier_from_span_wide(k, tau, mu, k, m);
    return m;
}

static const Wide *const *closings(Arena *a, int k, int n, const double *tau)
{
    const Wide **list = ARENA_ARRAY(a, const Wide *, n);
    for (int mu = 0; mu < n; mu++) list[mu] = mu >= k - 1 && knots_is_span(tau, mu) ? closing_of(a, k, tau, mu) : NULL;
    return (const Wide *const *)list;
}

WideSurface wide_surface_make(Arena *a, const Surface *s, Vec3 base)
{
    size_t n = (size_t)s->n_u * (size_t)s->n_v;
    WideNet net = { arena_copy(a, s->p, n, sizeof *s->p), ARENA_ARRAY(a, Vec4, n) };
    memset(net.lo, 0, n * sizeof *net.lo);
    wide_net_move(net, n, base);
    return (WideSurface){ s, net, closings(a, s->k_u, s->n_u, s->tau_u), closings(a, s->k_v, s->n_v, s->tau_v) };
}

/* ---- closing a span ---- */

typedef struct { V4 sum, rest; } Dot;

/* Adds (m.hi + m.lo) (x + y). */
ALWAYS_INLINE void add_product(Dot *d, Wide m, V4 x, V4 y)
{
    V4 p = x * m.hi, sum = d->sum + p, z = sum - d->sum;
    V4 lost = (d->sum - (sum - z)) + (p - z);
    d->rest += v4_fma(y, m.hi, v4_fma(x, m.hi, -p) + (x * m.lo + lost));
    d->sum = sum;
}

/* k points, `stride` apart. */
ALWAYS_INLINE void close_line(int k, const Wide *m, WideNet p, int first, int stride)
{
    V4 x[NURBS_MAX_ORDER], y[NURBS_MAX_ORDER];
    for (int i = 0; i < k; i++) x[i] = v4_load(&p.hi[first + i * stride]), y[i] = v4_load(&p.lo[first + i * stride]);
    for (int i = 0; i < k; i++) {
        Dot d = { v4_splat(0), v4_splat(0) };
        for (int j = 0; j < k; j++)
            if (m[i * k + j].hi != 0) add_product(&d, m[i * k + j], x[j], y[j]);
        V4 hi = d.sum + d.rest;
        v4_store(&p.hi[first + i * stride], hi);
        v4_store(&p.lo[first + i * stride], d.rest - (hi - d.sum));
    }
}

EVERY_X86
static void close_lines(int k, const Wide *m, WideNet p, int n_lines, int step, int stride)
{
    for (int i = 0; m && i < n_lines; i++) close_line(k, m, p, i * step, stride);
}

void wide_surface_close(const WideSurface *w, int mu_u, int mu_v, WideNet out)
{
    const Surface *s = w->s;
    for (int i = 0; i < s->k_v; i++) {
        size_t first = (size_t)(mu_v - s->k_v + 1 + i) * (size_t)s->n_u + (size_t)(mu_u - s->k_u + 1);
        memcpy(out.hi + i * s->k_u, w->net.hi + first, (size_t)s->k_u * sizeof *out.hi);
        memcpy(out.lo + i * s->k_u, w->net.lo + first, (size_t)s->k_u * sizeof *out.lo);
    }
    close_lines(s->k_u, w->closing_u[mu_u], out, s->k_v, s->k_u, 1);
    close_lines(s->k_v, w->closing_v[mu_v], out, s->k_u, 1, s->k_u);
}
