/* Surface: a validated copy of a SurfaceDesc in homogeneous form. See surface.h.
 *
 * Weights are scaled by a power of two so that the largest lies in [1/2, 1): exact, it changes no point of the surface, and
 * w x cannot overflow. If all are equal they are dropped, and the surface is evaluated as a polynomial. */
#include "nurbs/surface.h"

#include "nurbs/basis.h"
#include "nurbs/knots.h"

#include <float.h>

static bool surface_error(NurbsError *error, NurbsCode code, NurbsWhere where, int index, int other, double value)
{
    *error = (NurbsError){ .code = code, .where = where, .trim = -1, .curve = -1, .index = index, .other = other,
                           .value = value };
    return false;
}

static bool direction_is_valid(int order, int n, const double *knots, NurbsWhere where, NurbsError *error)
{
    int index = where == NURBS_IN_SURFACE_V;
    if (order < NURBS_MIN_ORDER || order > NURBS_MAX_ORDER)
        return surface_error(error, NURBS_BAD_ORDER, where, index, order, order);
    if (n < order) return surface_error(error, NURBS_TOO_FEW_POINTS, where, index, order, n);
    surface_error(error, NURBS_OK, where, 0, 0, 0);
    return knots_are_valid(order, n, knots, error);
}

static bool points_are_valid(const Vec4 *p, int n, NurbsError *error)
{
    for (int i = 0; i < n; i++) {
        const double xyz[3] = { p[i].x, p[i].y, p[i].z };
        for (int k = 0; k < 3; k++)
            if (!isfinite(xyz[k]))
                return surface_error(error, NURBS_POINT_NOT_FINITE, NURBS_IN_SURFACE_POINTS, i, k, xyz[k]);
        if (!(p[i].w > 0 && isfinite(p[i].w)))
            return surface_error(error, NURBS_BAD_WEIGHT, NURBS_IN_SURFACE_POINTS, i, 0, p[i].w);
    }
    return true;
}

static bool weights_are_equal(const Vec4 *p, int n)
{
    for (int i = 1; i < n; i++)
        if (p[i].w != p[0].w) return false;
    return true;
}

static int exponent_of_largest_weight(const Vec4 *p, int n)
{
    double largest = 0;
    int e;
    for (int i = 0; i < n; i++) largest = fmax(largest, p[i].w);
    (void)frexp(largest, &e);
    return e;
}

/* A weight this many times the largest or less counts as that: the point cannot be seen, and 0 must not come of it. */
#define LEAST_WEIGHT 0x1p-1000

static Vec4 *homogeneous_points(Arena *a, const Vec4 *p, int n, bool is_polynomial)
{
    Vec4 *out = ARENA_ARRAY(a, Vec4, n);
    int e = exponent_of_largest_weight(p, n);
    for (int i = 0; i < n; i++) {
        double w = is_polynomial ? 1 : fmax(ldexp(p[i].w, -e), LEAST_WEIGHT);
        out[i] = vec4_weighted(vec4(p[i].x, p[i].y, p[i].z, w));
    }
    return out;
}

/* Point i has a say on (tau_i, tau_{i+k}): does that meet the domain? */
static bool matters(int k, int n, const double *tau, int i) { return tau[i] < tau[n] && tau[i + k] > tau[k - 1]; }

/* The box, its diagonal and the rounding bound. A point is a sum of k_u k_v terms, whose factors are positive and come from
 * k-1 columns of 5 roundings (refine.c: two differences of knots, a quotient, a product, a sum); with a product and k-1 sums
 * in each direction and the division that is (6 k_u + 6 k_v - 9) u of the farthest control point, u = 2^-53, to first order.
 * With weights it is twice that, once for the numerator and once for the denominator, and u more for the products. */
static void measure(Surface *s, const Vec4 *euclidean)
{
    Box box = box_empty();
    for (int j = 0; j < s->n_v; j++)
        for (int i = 0; i < s->n_u; i++) {
            if (!matters(s->k_u, s->n_u, s->tau_u, i) || !matters(s->k_v, s->n_v, s->tau_v, j)) continue;
            Vec4 p = euclidean[(size_t)j * (size_t)s->n_u + (size_t)i];
            box = box_add_point(box, vec(p.x, p.y, p.z));
            s->farthest = fmax(s->farthest, vec_length(vec(p.x, p.y, p.z)));
        }
    int depth = 6 * (s->k_u + s->k_v) - 8;
    s->rounding = (s->is_polynomial ? 1 : 2) * depth * (DBL_EPSILON / 2) * s->farthest;
    s->size = box_diagonal(box);
    s->box = box_expand(box, s->rounding);
}

/* For gaps between trims: the distance in space, relative to the surface's size. */
static double relative_distance(const void *surface, Vec2 a, Vec2 b)
{
    const Surface *s = surface;
    Vec3 p, q, d_u, d_v;
    surface_point(s, a.x, a.y, &p, &d_u, &d_v);
    surface_point(s, b.x, b.y, &q, &d_u, &d_v);
    return s->size > 0 ? vec_length(vec_sub(p, q)) / s->size : 0;
}

static bool add_trims(Arena *a, Surface *s, const SurfaceDesc *desc, NurbsError *error,
                      NurbsWarning *warnings, int max_warnings, int *n_warnings)
{
    if (desc->n_trims == 0) return true;
    TrimInput in = { .loops = desc->trims, .n_loops = desc->n_trims, .keep_left = desc->keep_left,
                     .domain = { s->u0, s->u1, s->v0, s->v1 }, .distance = relative_distance, .surface = s };
    s->trims = trim_tree_new(a, &in, error, warnings, max_warnings, n_warnings);
    return s->trims || error->code == NURBS_OK;
}

static Surface *copy_of(Arena *a, const SurfaceDesc *d)
{
    Surface *s = ARENA_NEW(a, Surface);
    int n_points = d->n_u * d->n_v;
    *s = (Surface){ .k_u = d->order_u, .k_v = d->order_v, .n_u = d->n_u, .n_v = d->n_v };
    s->tau_u = arena_copy(a, d->knots_u, (size_t)(d->n_u + d->order_u), sizeof *d->knots_u);
    s->tau_v = arena_copy(a, d->knots_v, (size_t)(d->n_v + d->order_v), sizeof *d->knots_v);
    s->is_polynomial = weights_are_equal(d->points, n_points);
    s->p = homogeneous_points(a, d->points, n_points, s->is_polynomial);
    s->u0 = s->tau_u[s->k_u - 1], s->u1 = s->tau_u[s->n_u];
    s->v0 = s->tau_v[s->k_v - 1], s->v1 = s->tau_v[s->n_v];
    measure(s, d->points);
    return s;
}

Surface *surface_new(Arena *a, const SurfaceDesc *desc, NurbsError *error,
                     NurbsWarning *warnings, int max_warnings, int *n_warnings)
{
    if (n_warnings) *n_warnings = 0;
    if (!direction_is_valid(desc->order_u, desc->n_u, desc->knots_u, NURBS_IN_SURFACE_U, error)) return NULL;
    if (!direction_is_valid(desc->order_v, desc->n_v, desc->knots_v, NURBS_IN_SURFACE_V, error)) return NULL;
    if (!points_are_valid(desc->points, desc->n_u * desc->n_v, error)) return NULL;
    surface_error(error, NURBS_OK, NURBS_IN_TRIM, 0, 0, 0);
    Surface *s = copy_of(a, desc);
    return add_trims(a, s, desc, error, warnings, max_warnings, n_warnings) ? s : NULL;
}

typedef struct { int first, count; double value[NURBS_MAX_ORDER], slope[NURBS_MAX_ORDER]; } BasisRow;

static BasisRow basis_row(int k, int n, const double *tau, double t)
{
    int mu = knots_span(k, n, tau, t);
    BasisRow row = { .first = mu - k + 1, .count = k };
    t = fmin(fmax(t, tau[k - 1]), tau[n]);
    basis_derivative(k, tau, mu, t, 0, row.value);
    basis_derivative(k, tau, mu, t, 1, row.slope);
    return row;
}

static Vec4 blend_mesh(const Surface *s, const BasisRow *a, const double *in_u, const BasisRow *b, const double *in_v)
{
    Vec4 sum = { 0 };
    for (int i = 0; i < b->count; i++)
        for (int j = 0; j < a->count; j++)
            sum = vec4_add(sum, vec4_scale(s->p[(size_t)(b->first + i) * (size_t)s->n_u + (size_t)(a->first + j)],
                                           in_v[i] * in_u[j]));
    return sum;
}

static Vec3 quotient_slope(Vec4 d, Vec3 point, double w)
{
    return vec_scale(vec_sub(vec(d.x, d.y, d.z), vec_scale(point, d.w)), 1 / w);
}

void surface_point(const Surface *s, double u, double v, Vec3 *point, Vec3 *s_u, Vec3 *s_v)
{
    BasisRow a = basis_row(s->k_u, s->n_u, s->tau_u, u), b = basis_row(s->k_v, s->n_v, s->tau_v, v);
    Vec4 p = blend_mesh(s, &a, a.value, &b, b.value);
    Vec4 d_u = blend_mesh(s, &a, a.slope, &b, b.value), d_v = blend_mesh(s, &a, a.value, &b, b.slope);
    *point = vec4_project(p);
    *s_u = quotient_slope(d_u, *point, p.w);
    *s_v = quotient_slope(d_v, *point, p.w);
}
