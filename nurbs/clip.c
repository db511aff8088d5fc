/* See clip.h. A Net holds, over one box of the patch, the Bernstein coefficients of
 *   a, b   the two plane equations times the weight: zero together exactly at a root;
 *   c, w   numerator and denominator of the depth along the ray: c/w bounds it by its coefficients' extremes.
 *
 * Rounding. The first net is exact within `rounding` (certify.h) times the weights. Restricting to a box is a convex
 * combination whose own error is relative to the coefficients there, which shrink at least with the box: the errors of all
 * levels together stay within half of what `rounding` allows for. So a hull that excludes zero by more than PATCH_SLACK
 * times that excludes a root.
 *
 * Memory comes from the thread's scratch arena, with marks; the recursion is some 100 deep at most: both
 * sides of a box are halved until they are MIN_WIDTH. */
#include "nurbs/clip.h"

#include "nurbs/nurbs.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define ON_THE_RAY 1.25      /* a box whose coefficients are within that many errors of zero cannot be told from the ray */
/* A box on the ray that is longer than this share of the tile's shorter side is no tangent point (those are some 2^-26 long,
 * 2^-17 at a cusp): the ray runs in the surface there, and the hit is where it enters. Boxes that a trim declines are not cut up
 * without end. */
#define IN_THE_SURFACE 0x1p-8
enum { MAX_DECLINED = 64 };
/* Boxes of one search. Tangencies take some hundred; a search that goes on is among roots that no visitor takes as the
 * nearest, on a surface that keeps to the ray within a few roundings: then each box has one point of it reported, or none if
 * Newton's method finds none. */
enum { PATIENCE = 1 << 15 };
#define MIN_CLIP 0.8         /* a clip that leaves more than this of both sides is followed by a halving: the 20 % rule */
#define MIN_WIDTH 0x1p-50    /* of the patch: parameters closer than that are one */

typedef struct {
    double *a, *b, *c, *w;
    double s0, s1, t0, t1;
    bool is_certified;       /* at most one root in it */
    bool is_in_surface;      /* the ray runs in the surface about here */
} Net;

typedef struct {
    const Tile *tile;
    const Patch *p;          /* the tile's */
    PatchRay *ray;
    RootVisit visit;
    void *context;
    Trace *trace;
    double rounding;         /* over the weight */
    int n;                   /* coefficients of a net */
    int *declined;           /* roots that the visitor did not take as the nearest, in the whole search */
    bool *was_halved;        /* the search had to split: counted once as a fallback */
    int *patience;           /* boxes that may still be looked at before the search makes do with points that Newton finds */
} Clip;

typedef struct { double lo, hi; } Range;

static Range range_of(const double *c, int n)
{
    Range r = { c[0], c[0] };
    for (int i = 1; i < n; i++) {
        r.lo = c[i] < r.lo ? c[i] : r.lo;
        r.hi = c[i] > r.hi ? c[i] : r.hi;
    }
    return r;
}

static Net net_new(const Clip *k)
{
    double *m = ARENA_ARRAY(k->trace->scratch, double, 4 * k->n);
    return (Net){ .a = m, .b = m + k->n, .c = m + 2 * k->n, .w = m + 3 * k->n };
}

static Net net_copy(const Clip *k, const Net *from)
{
    Net to = net_new(k);
    memcpy(to.a, from->a, 4 * (size_t)k->n * sizeof(double));
    to.s0 = from->s0, to.s1 = from->s1, to.t0 = from->t0, to.t1 = from->t1, to.is_certified = from->is_certified;
    to.is_in_surface = from->is_in_surface;
    return to;
}

/* k coefficients, `stride` apart, on [x0, x1] of their interval, 0 <= x0 < x1 <= 1. The ends that stay keep their bits. */
static void restrict_row(double *c, int k, int stride, double x0, double x1)
{
    if (x1 < 1)
        for (int n = 1; n < k; n++)
            for (int i = k - 1; i >= n; i--)
                c[i * stride] = (1 - x1) * c[(i - 1) * stride] + x1 * c[i * stride];
    if (x0 > 0) {
        double x = x0 / x1;
        for (int n = 1; n < k; n++)
            for (int i = 0; i < k - n; i++)
                c[i * stride] = (1 - x) * c[i * stride] + x * c[(i + 1) * stride];
    }
}

static void restrict_s(const Clip *k, Net *n, double x0, double x1)
{
    if (x0 <= 0 && x1 >= 1) return;
    for (int row = 0; row < 4 * k->p->k_v; row++) restrict_row(n->a + row * k->p->k_u, k->p->k_u, 1, x0, x1);
    double width = n->s1 - n->s0;
    if (x1 < 1) n->s1 = n->s0 + x1 * width;
    n->s0 += x0 * width;
}

static void restrict_t(const Clip *k, Net *n, double x0, double x1)
{
    if (x0 <= 0 && x1 >= 1) return;
    for (int m = 0; m < 4; m++)
        for (int i = 0; i < k->p->k_u; i++) restrict_row(n->a + m * k->n + i, k->p->k_v, k->p->k_u, x0, x1);
    double width = n->t1 - n->t0;
    if (x1 < 1) n->t1 = n->t0 + x1 * width;
    n->t0 += x0 * width;
}

/* Bounds of the depth: a quotient of convex combinations lies between the extreme quotients of the coefficients. */
static Range depth_range(const Clip *k, const Net *n)
{
    Range r = { INFINITY, -INFINITY };
    for (int i = 0; i < k->n; i++) {
        double d = n->c[i] / n->w[i];
        r.lo = double_min(r.lo, d), r.hi = double_max(r.hi, d);
    }
    return r;
}

/* The two plane equations over the weight, and Newton's step. */
typedef struct {
    double s, t, f1, f2, depth, ds, dt;
    double depth_step;       /* what the step changes of the depth, to first order */
    double slope;            /* how much farther than F the depth moves: |d S_s|, |d S_t| through the inverse Jacobian */
} Place;

static Place place_at(const Clip *k, double s, double t)
{
    const PatchRay *r = k->ray;
    Vec4 value, by_s, by_t;
    tile_evaluate(k->tile, &s, &t, &value, &by_s, &by_t);
    Vec3 o = vec_sub(r->origin, k->p->origin), at = vec_sub(vec4_project(value), o);
    Vec3 d_s = vec_sub(vec(by_s.x, by_s.y, by_s.z), vec_scale(vec4_project(value), by_s.w));    /* w S_s */
    Vec3 d_t = vec_sub(vec(by_t.x, by_t.y, by_t.z), vec_scale(vec4_project(value), by_t.w));
    double a_s = vec_dot(r->n1, d_s), a_t = vec_dot(r->n1, d_t), b_s = vec_dot(r->n2, d_s), b_t = vec_dot(r->n2, d_t);
    double det = a_s * b_t - a_t * b_s;
    Place out = { .s = s, .t = t, .f1 = vec_dot(r->n1, at), .f2 = vec_dot(r->n2, at), .depth = vec_dot(r->d, at) };
    out.slope = (fabs(vec_dot(r->d, d_s)) * hypot(a_t, b_t) + fabs(vec_dot(r->d, d_t)) * hypot(a_s, b_s)) / fabs(det);
    out.ds = value.w * (a_t * out.f2 - b_t * out.f1) / det, out.dt = value.w * (b_s * out.f1 - a_s * out.f2) / det;
    out.depth_step = (vec_dot(r->d, d_s) * out.ds + vec_dot(r->d, d_t) * out.dt) / value.w;
    return out;
}

/* Where the surface runs through much of space within little of s or t, their last bits are not fine enough: the point that
 * counts lies a step beside them. */
static void take_last_step(Place *p)
{
    p->depth += p->depth_step;
    p->f1 = p->f2 = 0;
}

static double residual2(const Place *p) { return p->f1 * p->f1 + p->f2 * p->f2; }

/* The middle of the box, moved by Newton's method as long as that comes nearer to the ray and stays about the box. */
static Place polish(const Clip *k, const Net *n)
{
    double w_s = n->s1 - n->s0, s0 = double_max(n->s0 - w_s, 0), s1 = double_min(n->s1 + w_s, 1);
    double w_t = n->t1 - n->t0, t0 = double_max(n->t0 - w_t, 0), t1 = double_min(n->t1 + w_t, 1);
    Place best = place_at(k, 0.5 * (n->s0 + n->s1), 0.5 * (n->t0 + n->t1));
    for (int step = 0; step < 8; step++) {
        double s = double_min(double_max(best.s + best.ds, s0), s1), t = double_min(double_max(best.t + best.dt, t0), t1);
        if (!(isfinite(best.ds) && isfinite(best.dt)) || (s == best.s && t == best.t)) break;
        Place next = place_at(k, s, t);
        if (!(residual2(&next) < residual2(&best))) break;
        best = next;
    }
    const double last_bits = 4 * DBL_EPSILON;    /* of the patch's parameters */
    if (fabs(best.ds) * k->tile->ds <= last_bits && fabs(best.dt) * k->tile->dt <= last_bits) take_last_step(&best);
    return best;
}

static bool report_at(const Clip *k, const Place *at, double depth_error, bool is_tangent)
{
    if (!(at->depth > k->ray->t_min && at->depth < k->ray->t_max)) return false;
    Root root = { .s = at->s, .t = at->t, .depth = at->depth, .depth_error = depth_error,
                  .distance = 2 * k->rounding + sqrt(residual2(at)), .is_tangent = is_tangent };
    double t_max = k->ray->t_max;
    bool ended = k->visit(k->context, k->tile, k->ray, &root);
    *k->declined += k->ray->t_max >= t_max;
    return ended;
}

/* What is left of a box that cannot be cut any more, or lies on the ray. */
static bool report(const Clip *k, const Net *n, bool is_tangent)
{
    Place at = polish(k, n);
    Range depth = depth_range(k, n);
    double reach = double_max(depth.hi - at.depth, at.depth - depth.lo);
    return report_at(k, &at, double_max(reach, 0) + k->rounding, is_tangent);
}

/* Does Newton's method find a point of the box on the ray, as far as rounding can tell? */
static bool is_on_ray(const Clip *k, const Net *n)
{
    Place at = polish(k, n);
    return residual2(&at) <= 4 * k->rounding * k->rounding;
}

/* (certify.c's Newton may leave the patch by its margin; this one may not leave the certified box; polish() has no
 * certificate and only goes downhill.) A box with at most one root: Newton's method from its middle, if it ends well inside.
 * Else clipping goes on. */
static bool finish(const Clip *k, const Net *n, Place *root)
{
    *root = place_at(k, 0.5 * (n->s0 + n->s1), 0.5 * (n->t0 + n->t1));
    for (int step = 0; step < 6; step++) {
        double s = root->s + root->ds, t = root->t + root->dt;
        bool is_last = fabs(root->ds) < LAST_STEP * (n->s1 - n->s0) && fabs(root->dt) < LAST_STEP * (n->t1 - n->t0);
        if (!(s > n->s0 && s < n->s1 && t > n->t0 && t < n->t1)) return false;
        *root = place_at(k, s, t);
        if (!is_last) continue;
        take_last_step(root);
        return isfinite(root->depth);
    }
    return false;
}

/* At the middle; of a tile that is a curve there, the one side that it has. */
static double shorter_side(const Tile *f)
{
    double a = 2.0 * f->length_s, b = 2.0 * f->length_t;
    return a > 0 && b > 0 ? double_min(a, b) : double_max(a, b);
}

/* Is a box on the ray to be cut further, to find where the ray enters the surface? */
static bool runs_in_surface(const Clip *k, Net *n, Range depth)
{
    double length = depth.hi - depth.lo;
    if (*k->declined >= MAX_DECLINED) return length > k->tile->radius / 16;
    n->is_in_surface = n->is_in_surface || length > IN_THE_SURFACE * shorter_side(k->tile);
    return n->is_in_surface && length > 4 * k->rounding;
}

/* Where the convex hull of the points (i / (k-1), lo_i) and (i / (k-1), hi_i) meets zero, as an interval of [0, 1]; empty:
 * lo > hi. Its ends lie on segments from a point above to one below; the ones that start at the lower of two points above,
 * or end at the upper of two below, reach furthest. */
static Range hull_meets_zero(const double *lo, const double *hi, int k)
{
    Range x = { INFINITY, -INFINITY };
    for (int i = 0; i < k; i++) {
        double x_i = (double)i / (k - 1);
        if (lo[i] <= 0 && hi[i] >= 0) x.lo = double_min(x.lo, x_i), x.hi = double_max(x.hi, x_i);
        if (!(hi[i] > 0)) continue;
        double above = lo[i] > 0 ? lo[i] : hi[i];
        for (int j = 0; j < k; j++) {
            if (!(lo[j] < 0)) continue;
            double below = hi[j] < 0 ? hi[j] : lo[j], step = (double)(j - i) / (k - 1);
            double ends[4] = { above / (above - below), above / (above - lo[j]), hi[i] / (hi[i] - below),
                               hi[i] / (hi[i] - lo[j]) };
            for (int m = 0; m < 4; m++) {
                double at = x_i + step * ends[m];
                x.lo = double_min(x.lo, at), x.hi = double_max(x.hi, at);
            }
        }
    }
    return x;
}

/* The part of [0, 1] along s (or t) outside which g has no zero, widened by the rounding. */
static Range clip_range(const Clip *k, const double *g, double error, bool along_s)
{
    int k_u = k->p->k_u, k_v = k->p->k_v, n = along_s ? k_u : k_v;
    double lo[NURBS_MAX_ORDER], hi[NURBS_MAX_ORDER];
    for (int i = 0; i < n; i++) lo[i] = INFINITY, hi[i] = -INFINITY;
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i < k_u; i++) {
            int at = along_s ? i : j;
            double x = g[j * k_u + i];
            lo[at] = double_min(lo[at], x), hi[at] = double_max(hi[at], x);
        }
    for (int i = 0; i < n; i++) lo[i] -= error, hi[i] += error;
    Range r = hull_meets_zero(lo, hi, n);
    return (Range){ double_max(0, r.lo - 4 * DBL_EPSILON), double_min(1, r.hi + 4 * DBL_EPSILON) };
}

/* The mean of the derivative coefficients: the difference quotient of the net's sides. */
static void mean_derivatives(const Clip *k, const double *g, double *by_s, double *by_t)
{
    int k_u = k->p->k_u, k_v = k->p->k_v;
    double s = 0, t = 0;
    for (int j = 0; j < k_v; j++) s += g[j * k_u + k_u - 1] - g[j * k_u];
    for (int i = 0; i < k_u; i++) t += g[(k_v - 1) * k_u + i] - g[i];
    *by_s = s / k_v, *by_t = t / k_u;
}

/* Largest distance of the derivative coefficients of g from (by_s, by_t). */
static void derivative_spread(const Clip *k, const double *g, double by_s, double by_t, double *spread_s, double *spread_t)
{
    int k_u = k->p->k_u, k_v = k->p->k_v;
    *spread_s = *spread_t = 0;
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i + 1 < k_u; i++)
            *spread_s = double_max(*spread_s, fabs((k_u - 1) * (g[j * k_u + i + 1] - g[j * k_u + i]) - by_s));
    for (int j = 0; j + 1 < k_v; j++)
        for (int i = 0; i < k_u; i++)
            *spread_t = double_max(*spread_t, fabs((k_v - 1) * (g[(j + 1) * k_u + i] - g[j * k_u + i]) - by_t));
}

typedef struct { Range s, t; } Clipped;

static bool is_empty(const Clipped *c) { return c->s.lo > c->s.hi || c->t.lo > c->t.hi; }

static Range meet(Range a, Range b) { return (Range){ double_max(a.lo, b.lo), double_min(a.hi, b.hi) }; }

/* g = m1 a + m2 b, in scratch memory. The error of (a, b) is that of a point in space, seen along two perpendicular
 * directions: its length is within `error`, so that of g is within error * hypot(m1, m2). */
static double *combine(const Clip *k, const Net *n, double m1, double m2)
{
    double *g = ARENA_ARRAY(k->trace->scratch, double, k->n);
    for (int i = 0; i < k->n; i++) g[i] = m1 * n->a[i] + m2 * n->b[i];
    return g;
}

/* The mean Jacobian of (a, b) over the box. */
typedef struct { double a_s, a_t, b_s, b_t, det; } Mean;

static Mean mean_jacobian(const Clip *k, const Net *n)
{
    Mean m;
    mean_derivatives(k, n->a, &m.a_s, &m.a_t);
    mean_derivatives(k, n->b, &m.b_s, &m.b_t);
    m.det = m.a_s * m.b_t - m.a_t * m.b_s;
    return m;
}

/* Clips the box by g = A (a, b), A the inverse of the mean Jacobian; notes in n whether that certifies it. */
static Clipped clip_by_inverse(const Clip *k, Net *n, const Mean *m, double error)
{
    double a11 = m->b_t / m->det, a12 = -m->a_t / m->det, a21 = -m->b_s / m->det, a22 = m->a_s / m->det;
    double *g1 = combine(k, n, a11, a12), *g2 = combine(k, n, a21, a22);
    Clipped out = { clip_range(k, g1, error * hypot(a11, a12), true), clip_range(k, g2, error * hypot(a21, a22), false) };
    if (!n->is_certified) {   /* |I - A J| < 1 in the maximum norm, from the Bernstein coefficients of A J */
        double ss, st, ts, tt;
        derivative_spread(k, g1, 1, 0, &ss, &st);
        derivative_spread(k, g2, 0, 1, &ts, &tt);
        n->is_certified = ss + st < CONTRACTION && ts + tt < CONTRACTION;
    }
    return out;
}

/* Where the Jacobian has no inverse to speak of, the box's image is a needle: (a, b) is turned so that one component runs
 * along it and the other across, which shows at once whether the needle passes zero. A turn does not enlarge the error. */
static Clipped clip_by_turning(const Clip *k, const Net *n, const Mean *m, double error)
{
    double aa = m->a_s * m->a_s + m->a_t * m->a_t, bb = m->b_s * m->b_s + m->b_t * m->b_t;
    double angle = 0.5 * atan2(2 * (m->a_s * m->b_s + m->a_t * m->b_t), aa - bb), c = cos(angle), s = sin(angle);
    double *along = combine(k, n, c, s), *across = combine(k, n, -s, c);
    return (Clipped){ meet(clip_range(k, along, error, true), clip_range(k, across, error, true)),
                      meet(clip_range(k, along, error, false), clip_range(k, across, error, false)) };
}

/* The determinant in shares of |J_s| |J_t|: below the first, it is mostly rounding, and there is no inverse; below the
 * second, an inverse that does not certify the box is helped by turning. */
#define NO_INVERSE 0x1p-46
#define NEEDLE 0x1p-20

static Clipped clip_box(const Clip *k, Net *n, double error)
{
    Mean m = mean_jacobian(k, n);
    double share = fabs(m.det) / (hypot(m.a_s, m.b_s) * hypot(m.a_t, m.b_t));
    Clipped c = { { 0, 1 }, { 0, 1 } };
    if (share > NO_INVERSE && isfinite(1 / m.det)) c = clip_by_inverse(k, n, &m, error);
    if (n->is_certified || share > NEEDLE) return c;
    Clipped d = clip_by_turning(k, n, &m, error);
    return (Clipped){ meet(c.s, d.s), meet(c.t, d.t) };
}

static bool settle(const Clip *k, Net *n);

/* Both halves, the nearer one first, so that what lies behind an accepted root is never looked at. */
static bool halve(const Clip *k, Net *n)
{
    if (!*k->was_halved) k->trace->counters.fallbacks++, *k->was_halved = true;
    double span_s = n->s1 - n->s0, span_t = n->t1 - n->t0, a_s, a_t, b_s, b_t;
    derivative_spread(k, n->a, 0, 0, &a_s, &a_t);
    derivative_spread(k, n->b, 0, 0, &b_s, &b_t);
    bool along_s = double_max(a_s, b_s) >= double_max(a_t, b_t);   /* the longer side of the image */
    if (span_s <= MIN_WIDTH) along_s = false;
    if (span_t <= MIN_WIDTH) along_s = true;
    Net other = net_copy(k, n);
    if (along_s) restrict_s(k, n, 0, 0.5), restrict_s(k, &other, 0.5, 1);
    else restrict_t(k, n, 0, 0.5), restrict_t(k, &other, 0.5, 1);
    bool other_first = depth_range(k, &other).lo < depth_range(k, n).lo;
    return settle(k, other_first ? &other : n) || settle(k, other_first ? n : &other);
}

/* Finds all roots in a box; n is used up. Returns whether a visit ended the search. */
static bool settle_in_scratch(const Clip *k, Net *n)
{
    for (;;) {
        double w_max = range_of(n->w, k->n).hi, error = PATCH_SLACK * k->rounding * w_max;
        Range a = range_of(n->a, k->n), b = range_of(n->b, k->n);
        if (a.lo > error || a.hi < -error || b.lo > error || b.hi < -error) return false;
        Range depth = depth_range(k, n);
        if (depth.lo - k->rounding > k->ray->t_max || depth.hi + k->rounding < k->ray->t_min) return false;
        bool is_point = n->s1 - n->s0 <= MIN_WIDTH && n->t1 - n->t0 <= MIN_WIDTH;
        if (--*k->patience < 0) return is_on_ray(k, n) && report(k, n, !n->is_certified);
        double size = double_max(double_max(a.hi, -a.lo), double_max(b.hi, -b.lo));
        if (is_point) return report(k, n, !n->is_certified);
        if (size <= ON_THE_RAY * error)
            return runs_in_surface(k, n, depth) ? halve(k, n) : report(k, n, !n->is_certified);

        Clipped c = clip_box(k, n, error);
        if (is_empty(&c)) return false;
        Place root;
        if (n->is_certified && finish(k, n, &root)) return report_at(k, &root, k->rounding * (1 + root.slope), false);
        bool is_worth_it = c.s.hi - c.s.lo <= MIN_CLIP || c.t.hi - c.t.lo <= MIN_CLIP;
        restrict_s(k, n, c.s.lo, c.s.hi);
        restrict_t(k, n, c.t.lo, c.t.hi);
        if (is_worth_it) continue;
        /* At most one root, and clipping converges quadratically to it: what stops it is the rounding, unless that is much
         * enlarged by the inverse of a needle. */
        return n->is_certified && is_on_ray(k, n) ? report(k, n, false) : halve(k, n);
    }
}

static bool settle(const Clip *k, Net *n)
{
    ArenaMark mark = arena_mark(k->trace->scratch);
    bool ended = settle_in_scratch(k, n);
    arena_reset(k->trace->scratch, mark);
    return ended;
}

/* The net over the tile: that of the patch, restricted. */
static Net first_net(const Clip *k, double q1, double q2, double q3)
{
    const Tile *f = k->tile;
    const PatchRay *ray = k->ray;
    Net n = net_new(k);
    n.s0 = n.t0 = 0, n.s1 = n.t1 = 1, n.is_certified = n.is_in_surface = false;
    for (int i = 0; i < k->n; i++) {
        Vec4 h = k->p->p[i];
        Vec3 x = vec(h.x, h.y, h.z);
        n.a[i] = vec_dot(ray->n1, x) - h.w * q1;
        n.b[i] = vec_dot(ray->n2, x) - h.w * q2;
        n.c[i] = vec_dot(ray->d, x) - h.w * q3;
        n.w[i] = h.w;
    }
    restrict_s(k, &n, f->s0, f->s0 + f->ds);
    restrict_t(k, &n, f->t0, f->t0 + f->dt);
    n.s0 = n.t0 = 0, n.s1 = n.t1 = 1;
    return n;
}

bool clip_roots(const Tile *tile, PatchRay *ray, RootVisit visit, void *context, Trace *trace)
{
    const Patch *p = tile->patch;
    Vec3 o = vec_sub(ray->origin, p->origin);
    int declined = 0, patience = PATIENCE;
    bool was_halved = false;
    Clip k = { tile, p, ray, visit, context, trace, patch_rounding(p, o), p->k_u * p->k_v,
               &declined, &was_halved, &patience };
    ArenaMark mark = arena_mark(trace->scratch);
    Net n = first_net(&k, vec_dot(ray->n1, o), vec_dot(ray->n2, o), vec_dot(ray->d, o));
    bool ended = settle_in_scratch(&k, &n);
    arena_reset(trace->scratch, mark);
    return ended;
}
