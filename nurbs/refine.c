/* Evaluation by stacked knots with partial refinement ([MCFS00] sections 2.4, 2.5; [LCM85]), derived again.
 *
 * Stacking k-1 knots at t makes one point of the refined polygon the point of the curve. Its row of the refinement matrix is
 * the last column of a triangle that starts with a single 1 (alpha', tau, mu and nu as in the paper; mu is the paper's mu'):
 *
 *   alpha'_{j,p+1} = gamma_{j,p} alpha'_{j,p} + (1 - gamma_{j+1,p}) alpha'_{j+1,p}
 *   gamma_{j,p} = (t - tau_j) / (tau_{j+p+1} - tau_j),   j = mu-p .. mu-m
 *
 * where p counts from m, the number of columns skipped. If n knots of tau already equal t, then n columns only move the 1
 * along; the paper's rule is to make nu = max(k-1-n, 1) steps, so m = k-1-nu. All denominators contain the span mu: they are
 * positive, and the paper's case "d = 0: arbitrary" does not arise.
 *
 * For the derivative the paper takes the next point of the refined polygon, c' = (k-1) (D_{r} - D) / (tau_{mu+1} - t): 0/0
 * at the end of the domain, and cancellation just before it. The same number stands in the triangle one column earlier:
 * column k-2 holds the refinement of the derivative's polygon V_j = (k-1) (P_j - P_{j-1}) / (tau_{j+k-1} - tau_j), so that
 *
 *   c'(t) = sum_j alpha'_{j,k-2} V_j
 *
 * whose quotients alpha' / (tau_{j+k-1} - tau_j) the last step computes anyway. That is why at least one step is made. */
#include "nurbs/refine.h"

/* How many columns of the triangle are skipped for knots that equal t; t above tau[mu] equals none that would help. */
static int skipped_columns(int k, const double tau[], int mu, double t)
{
    int n = 0;
    while (n < k - 2 && tau[mu - n] == t) n++;
    return n;
}

/* One step of the triangle, in place: column p in a[0 .. count-1] becomes column p+1 in a[0 .. count]. `low` is where the
 * first knot of the column stands: tau + mu - p. */
static inline void next_column(int count, int p, const double *low, double t, double a[])
{
    const double *high = low + p + 1;
    double carried = 0;
    for (int i = 0; i < count; i++) {
        double share = a[i] / (high[i] - low[i]);
        a[i] = carried + (high[i] - t) * share;
        carried = (t - low[i]) * share;
    }
    a[count] = carried;
}

/* The last step, which also gives the slopes from its quotients. */
static inline void last_column(int k, int count, const double *low, double t, double a[], double slope[])
{
    const double *high = low + k - 1;
    double carried = 0, before = 0;
    for (int i = 0; i < count; i++) {
        double share = a[i] / (high[i] - low[i]);
        a[i] = carried + (high[i] - t) * share;
        carried = (t - low[i]) * share;
        slope[i] = (k - 1) * (before - share);
        before = share;
    }
    a[count] = carried;
    slope[count] = (k - 1) * before;
}

void refine_row(int k, const double tau[], int mu, double t, RefineRow *out)
{
    int m = skipped_columns(k, tau, mu, t);
    out->first = mu - k + 1;
    out->count = k - m;
    out->value[0] = 1;
    for (int p = m; p < k - 2; p++) next_column(p - m + 1, p, tau + mu - p, t, out->value);
    last_column(k, k - 1 - m, tau + mu - k + 2, t, out->value, out->slope);
}

typedef struct { Vec4 point, d_u, d_v; } Homogeneous;

static inline void add_scaled(Vec4 *sum, double s, Vec4 p, bool has_weight)
{
    sum->x += s * p.x, sum->y += s * p.y, sum->z += s * p.z;
    if (has_weight) sum->w += s * p.w;
}

/* A_u P A_v^T for the rows that are needed: along u first, row by row of the mesh. */
static inline Homogeneous refine_mesh(const Surface *s, const RefineRow *a, const RefineRow *b, bool has_weight)
{
    Homogeneous h = { 0 };
    for (int i = 0; i < b->count; i++) {
        const Vec4 *p = s->p + (size_t)(b->first + i) * (size_t)s->n_u + a->first;
        Vec4 point = { 0 }, d_u = { 0 };
        for (int j = 0; j < a->count; j++) {
            add_scaled(&point, a->value[j], p[j], has_weight);
            add_scaled(&d_u, a->slope[j], p[j], has_weight);
        }
        add_scaled(&h.point, b->value[i], point, has_weight);
        add_scaled(&h.d_u, b->value[i], d_u, has_weight);
        add_scaled(&h.d_v, b->slope[i], point, has_weight);
    }
    return h;
}

static inline Vec3 xyz(Vec4 p) { return vec(p.x, p.y, p.z); }

/* The quotient rule: (D / w)' = (D' - w' S) / w with S = D / w. */
static inline Vec3 quotient_slope(Vec4 d, Vec3 point, double w)
{
    return vec_scale(vec_sub(xyz(d), vec_scale(point, d.w)), 1 / w);
}

void refine_evaluate(const Surface *s, int mu_u, double u, int mu_v, double v, SurfacePoint *out)
{
    RefineRow a, b;
    refine_row(s->k_u, s->tau_u, mu_u, u, &a);
    refine_row(s->k_v, s->tau_v, mu_v, v, &b);
    if (s->is_polynomial) {
        Homogeneous h = refine_mesh(s, &a, &b, false);
        *out = (SurfacePoint){ xyz(h.point), xyz(h.d_u), xyz(h.d_v) };
        return;
    }
    Homogeneous h = refine_mesh(s, &a, &b, true);
    Vec3 point = vec4_project(h.point);
    *out = (SurfacePoint){ point, quotient_slope(h.d_u, point, h.point.w), quotient_slope(h.d_v, point, h.point.w) };
}
