/* The frame test, the certificate and Newton's method.
 *
 * With o the ray's origin relative to the patch's, q = (N1.o, N2.o) and H the homogeneous numerator, the equations are
 * F = (N1.H - w q1, N2.H - w q2); F/w is the distance of S from the ray in the two planes. J_m is the Jacobian at the middle
 * with both columns divided by the lengths of the derivatives there.
 *
 * Miss at sight: a root satisfies J (x_s, x_t) = q - N.r with |x_s| <= half_u, |x_t| <= half_v, |r| <= deviation, J = N.(e_u
 * e_v). By Cramer's rule |x_s det| >= |q1 J22 - q2 J12| - |(J12, J22)| deviation.
 *
 * At most one root: on a convex domain F(x) - F(y) = (J_m + E)(x - y) with E an average of J - J_m. If |J_m^-1 E| < 1 this
 * vanishes only for x = y. The Frobenius norm of J_m^-1 is |J_m|/|det|, the one of E at most `variation` (N1, N2 are
 * orthonormal, so projecting shortens): the test is |J_m| variation < |det|. It holds on the patch with its margin, so that
 * a root in the margin proves that the patch itself has none. */
#include "nurbs/certify.h"

#include "nurbs/clip.h"
#include "nurbs/patch_kernel.h"

#include <float.h>
#include <math.h>

enum { MAX_STEPS = 8 };


PatchRay patch_ray(Vec3 origin, Vec3 dir, double t_min, double t_max)
{
    PatchRay r = { .origin = origin, .d = dir, .t_min = t_min, .t_max = t_max };
    /* an orthonormal basis without a special direction but the sign of z: [DBC17] */
    double sign = copysign(1, dir.z), a = -1 / (sign + dir.z), b = dir.x * dir.y * a;
    r.n1 = vec(1 + sign * dir.x * dir.x * a, sign * b, -sign * dir.x);
    r.n2 = vec(b, sign + dir.y * dir.y * a, -dir.y);
    return r;
}

double patch_rounding(const Patch *p, Vec3 offset)
{
    /* Every coordinate of S is a convex combination of points no longer than the radius: 2 (k_u + k_v) + 4 roundings,
     * relative to it; N.S and N.o add 3 each, N itself is off by 4. All of them relative to the largest term, hence the
     * maximum norm times 3 for a dot product of three terms. */
    double n = 2 * (p->k_u + p->k_v) + 16;
    return p->rounding + 0.5 * DBL_EPSILON * n * (p->radius + fabs(offset.x) + fabs(offset.y) + fabs(offset.z));
}

/* The plane equations of one ray and patch, and where the iteration stands. */
typedef struct {
    const Patch *p;
    PatchRay *r;
    Vec3 o;                        /* the ray's origin about the patch's */
    double q1, q2, rounding;
    double s, t;                   /* the iterate */
    PatchPoint last;               /* evaluated at (s - ds, t - dt) */
    double ds, dt;
    double j11, j12, j21, j22, det;
    double m11, m12, m21, m22, m_det;   /* the frame's */
    double contraction;            /* q of the frame's certificate */
} Solve;

ALWAYS_INLINE void set_jacobian(Solve *k, Vec3 a, Vec3 b)
{
    k->j11 = vec_dot(k->r->n1, a), k->j12 = vec_dot(k->r->n1, b);
    k->j21 = vec_dot(k->r->n2, a), k->j22 = vec_dot(k->r->n2, b);
    k->det = k->j11 * k->j22 - k->j12 * k->j21;
}

ALWAYS_INLINE double length2(double a, double b) { return sqrt(a * a + b * b); }
ALWAYS_INLINE double clamped(double x, double lo, double hi) { return double_min(double_max(x, lo), hi); }
ALWAYS_INLINE Vec3 xyz(V4 p) { return vec(p[0], p[1], p[2]); }

/* Reports the root at (s, t): the last evaluation and a step by the derivatives, whose square is lost in the rounding. */
ALWAYS_INLINE bool report(const Solve *k, RootVisit visit, void *context)
{
    V4 h = k->last.value + k->last.by_s * k->ds + k->last.by_t * k->dt;
    Vec3 at = vec_scale(xyz(h), 1 / h[3]);
    double depth = vec_dot(k->r->d, vec_sub(at, k->o));
    if (!(depth > k->r->t_min && depth < k->r->t_max)) return false;
    /* the rounding moves the root by J^-1 times itself, and the depth by how that changes along the surface */
    double along_s = vec_dot(k->r->d, vec_sub(xyz(k->last.by_s), vec_scale(at, k->last.by_s[3])));
    double along_t = vec_dot(k->r->d, vec_sub(xyz(k->last.by_t), vec_scale(at, k->last.by_t[3])));
    double slope = length2(along_s * k->j22 - along_t * k->j21, along_t * k->j11 - along_s * k->j12);
    Root root = { .s = clamped(k->s, 0, 1), .t = clamped(k->t, 0, 1), .depth = depth, .distance = 2 * k->rounding,
                  .depth_error = k->rounding * (1 + slope / fabs(k->det)) };
    return visit(context, k->p, k->r, &root);
}

typedef enum { NEWTON_INSIDE, NEWTON_OUTSIDE, NEWTON_UNDECIDED } NewtonResult;

/* A converged iterate: on the patch, as far as rounding can tell, which can move the root by |J^-1| times itself? */
ALWAYS_INLINE NewtonResult place_of_root(const Solve *k)
{
    const double lo = -PATCH_MARGIN, hi = 1 + PATCH_MARGIN;
    if (k->s >= 0 && k->s <= 1 && k->t >= 0 && k->t <= 1) return NEWTON_INSIDE;
    if (!(k->s > lo && k->s < hi && k->t > lo && k->t < hi)) return NEWTON_UNDECIDED;
    double moved = k->rounding * k->last.value[3] / fabs(k->det);
    double slack_s = moved * length2(k->j12, k->j22) + DBL_EPSILON, slack_t = moved * length2(k->j11, k->j21) + DBL_EPSILON;
    bool is_in = k->s >= -slack_s && k->s <= 1 + slack_s && k->t >= -slack_t && k->t <= 1 + slack_t;
    return is_in ? NEWTON_INSIDE : NEWTON_OUTSIDE;
}

/* Makes up for the rounding of a bound that is computed by some ten operations. */
#define ROUNDED_UP 1.0001

/* Is it certain, from the Newton step (ds, dt) at (s, t), that the patch has no root? Let J = J_m (I + E_2) here and J_m (I
 * + E_1) on average on the way to a root x*: both |E| <= q in the frame's norm. Then x* - x = (I + E_1)^-1 (I + E_2) step,
 * so x* is within 2q/(1-q) |step| of x + step; if that is nearer than the patch, there is no such root. */
ALWAYS_INLINE bool proves_miss(const Solve *k, double ds, double dt)
{
    const Patch *p = k->p;
    double s = k->s + ds, t = k->t + dt;
    double out_s = 2 * p->half_u * double_max(double_max(-s, s - 1), 0);
    double out_t = 2 * p->half_v * double_max(double_max(-t, t - 1), 0);
    double step_s = 2 * p->half_u * ds, step_t = 2 * p->half_v * dt, reach = 2 * k->contraction / (1 - k->contraction);
    return out_s * out_s + out_t * out_t > ROUNDED_UP * reach * reach * (step_s * step_s + step_t * step_t);
}

/* The same from F at (s, t), where steps are clamped to the square with its margin. G(x) = x - J_m^-1 F(x) contracts with q,
 * and so does PG, P the clamping, which lengthens nothing: a root x* in the square has |x* - x| <= |PG(x) - x| / (1 - q),
 * and |G(x) - x| <= (1 + q) |x* - x|. (Lengths are in space; the numerator's F is over the weight at the middle, as its
 * derivatives there.) */
ALWAYS_INLINE bool proves_miss_by_clamping(const Solve *k, double f1, double f2)
{
    const Patch *p = k->p;
    double scale = 1 / (k->m_det * p->w_middle), u = 2 * p->half_u, v = 2 * p->half_v;
    double g_s = (k->m12 * f2 - k->m22 * f1) * scale, g_t = (k->m21 * f1 - k->m11 * f2) * scale;
    double p_s = u * (clamped(k->s + g_s / u, -PATCH_MARGIN, 1 + PATCH_MARGIN) - k->s);
    double p_t = v * (clamped(k->t + g_t / v, -PATCH_MARGIN, 1 + PATCH_MARGIN) - k->t);
    double least = (1 + k->contraction) / (1 - k->contraction);
    return g_s * g_s + g_t * g_t > ROUNDED_UP * least * least * (p_s * p_s + p_t * p_t);
}

/* From (s, t) to the root of F in the patch with its margin, if there is one. */
ALWAYS_INLINE NewtonResult newton(Solve *k, Trace *trace)
{
    const double lo = -PATCH_MARGIN, hi = 1 + PATCH_MARGIN;
    for (int step = 0; step < MAX_STEPS; step++) {
        trace->counters.newton_iterations++;
        k->last = kernel_evaluate(k->p, k->s, k->t);
        double w = k->last.value[3], w_s = k->last.by_s[3], w_t = k->last.by_t[3];
        Vec3 h = xyz(k->last.value), at = vec_scale(k->o, w);
        set_jacobian(k, vec_sub(xyz(k->last.by_s), vec_scale(k->o, w_s)), vec_sub(xyz(k->last.by_t), vec_scale(k->o, w_t)));
        double f1 = vec_dot(k->r->n1, vec_sub(h, at)), f2 = vec_dot(k->r->n2, vec_sub(h, at)), scale = 1 / k->det;
        double ds = (k->j12 * f2 - k->j22 * f1) * scale, dt = (k->j21 * f1 - k->j11 * f2) * scale;
        double s = clamped(k->s + ds, lo, hi), t = clamped(k->t + dt, lo, hi);
        bool leaves = s != k->s + ds || t != k->t + dt;
        if (leaves && (proves_miss(k, ds, dt) || proves_miss_by_clamping(k, f1, f2))) return NEWTON_OUTSIDE;
        k->ds = leaves ? s - k->s : ds, k->dt = leaves ? t - k->t : dt;    /* with bits that s and t have no room for */
        k->s = s, k->t = t;
        if (fabs(ds) < LAST_STEP && fabs(dt) < LAST_STEP) return place_of_root(k);
    }
    return NEWTON_UNDECIDED;
}

/* The columns of the frame's Jacobian are at most 1 long: a determinant below this proves nothing, and squares under it
 * vanish. */
#define NO_ANGLE 0x1p-400

typedef enum { FRAME_MISS, FRAME_ONE_AT_MOST, FRAME_UNDECIDED } FrameResult;

/* What the frame says; sets s and t to the parallelogram's root, within the margin. */
ALWAYS_INLINE FrameResult frame_test(Solve *k)
{
    const Patch *p = k->p;
    if (!p->has_frame) return FRAME_UNDECIDED;
    set_jacobian(k, p->e_u, p->e_v);
    double det = fabs(k->det), slack = p->deviation + k->rounding;
    if (!(det > NO_ANGLE)) return FRAME_UNDECIDED;
    double x_s = k->q1 * k->j22 - k->q2 * k->j12, x_t = k->q2 * k->j11 - k->q1 * k->j21;   /* times det */
    double column_v2 = k->j12 * k->j12 + k->j22 * k->j22, column_u2 = k->j11 * k->j11 + k->j21 * k->j21;   /* at most 1 */
    if (fabs(x_s) > p->half_u * det + sqrt(column_v2) * slack) return FRAME_MISS;
    if (fabs(x_t) > p->half_v * det + sqrt(column_u2) * slack) return FRAME_MISS;
    k->m11 = k->j11, k->m12 = k->j12, k->m21 = k->j21, k->m22 = k->j22, k->m_det = k->det;
    k->contraction = sqrt(column_u2 + column_v2) * p->variation / det;
    if (!(k->contraction < CONTRACTION)) return FRAME_UNDECIDED;
    const double lo = -PATCH_MARGIN, hi = 1 + PATCH_MARGIN;
    k->s = clamped(0.5 + 0.5 * x_s / (k->det * p->half_u), lo, hi);
    k->t = clamped(0.5 + 0.5 * x_t / (k->det * p->half_v), lo, hi);
    return FRAME_ONE_AT_MOST;
}

/* ---- where the frame is in doubt: the hull of the control points as the ray sees them ---- */

#define HULL_POINTS 64         /* patches of more points go to clip.c at once */

typedef struct { double lo, hi; } Extent;

ALWAYS_INLINE Extent extent_of(const double *x, int n)
{
    Extent e = { x[0], x[0] };
    for (int i = 1; i < n; i++) e.lo = double_min(x[i], e.lo), e.hi = double_max(x[i], e.hi);
    return e;
}

ALWAYS_INLINE bool excludes(Extent e, double error) { return e.lo > error || e.hi < -error; }

/* Is the patch certainly off the ray, by its hull on either plane, or along either of the two directions that its mean
 * derivatives have there? A patch seen on edge is a needle: the second pair sees it from its side. */
ALWAYS_INLINE bool hull_is_off(const Solve *k)
{
    const Patch *p = k->p;
    int k_u = p->k_u, k_v = p->k_v, n = k_u * k_v;
    double a[HULL_POINTS], b[HULL_POINTS], g[HULL_POINTS], error = k->rounding * p->w_max;
    a[0] = b[0] = g[0] = 0;    /* compilers do not know that there is a point */
    for (int i = 0; i < n; i++) {
        Vec3 x = vec(p->p[i].x, p->p[i].y, p->p[i].z);
        a[i] = vec_dot(k->r->n1, x) - p->p[i].w * k->q1;
        b[i] = vec_dot(k->r->n2, x) - p->p[i].w * k->q2;
    }
    if (excludes(extent_of(a, n), error) || excludes(extent_of(b, n), error)) return true;
    double a_s = 0, b_s = 0, a_t = 0, b_t = 0;
    for (int j = 0; j < k_v; j++) a_s += a[j * k_u + k_u - 1] - a[j * k_u], b_s += b[j * k_u + k_u - 1] - b[j * k_u];
    for (int i = 0; i < k_u; i++) a_t += a[n - k_u + i] - a[i], b_t += b[n - k_u + i] - b[i];
    for (int i = 0; i < n; i++) g[i] = b_t * a[i] - a_t * b[i];
    if (excludes(extent_of(g, n), error * length2(a_t, b_t))) return true;
    for (int i = 0; i < n; i++) g[i] = b_s * a[i] - a_s * b[i];
    return excludes(extent_of(g, n), error * length2(a_s, b_s));
}

EVERY_X86
bool patch_roots(const Patch *p, PatchRay *r, RootVisit visit, void *context, Trace *trace)
{
    Solve k = { .p = p, .r = r, .o = vec_sub(r->origin, p->origin) };
    k.q1 = vec_dot(r->n1, k.o), k.q2 = vec_dot(r->n2, k.o), k.rounding = patch_rounding(p, k.o);
    double depth = -vec_dot(r->d, k.o), reach = p->radius + k.rounding;
    if (k.q1 * k.q1 + k.q2 * k.q2 > reach * reach) return false;
    if (depth - reach > r->t_max || depth + reach < r->t_min) return false;
    switch (frame_test(&k)) {
    case FRAME_MISS: return false;
    case FRAME_UNDECIDED:
        if (p->k_u * p->k_v <= HULL_POINTS && hull_is_off(&k)) return false;
        return clip_roots(p, r, visit, context, trace);
    case FRAME_ONE_AT_MOST: trace->counters.certificates++; break;
    }
    if (r->guess == p) k.s = r->guess_s, k.t = r->guess_t;
    switch (newton(&k, trace)) {
    case NEWTON_INSIDE: return report(&k, visit, context);
    case NEWTON_OUTSIDE: return false;
    case NEWTON_UNDECIDED: break;
    }
    return clip_roots(p, r, visit, context, trace);
}
