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
 * orthonormal, so projecting shortens): the test is |J_m| variation < |det|. It holds on the patch with its margin, so that a
 * root in the margin proves that the patch itself has none. */
#include "nurbs/certify.h"

#include "nurbs/clip.h"
#include "nurbs/nurbs.h"

#include <float.h>
#include <math.h>

enum { MAX_STEPS = 8 };

PatchRay patch_ray(Vec3 origin, Vec3 dir, double t_min, double t_max)
{
    PatchRay r = { .origin = origin, .d = dir, .t_min = t_min, .t_max = t_max };
    /* an orthonormal basis without a special direction but the sign of z: [Duff et al. 17] */
    double sign = copysign(1, dir.z), a = -1 / (sign + dir.z), b = dir.x * dir.y * a;
    r.n1 = vec(1 + sign * dir.x * dir.x * a, sign * b, -sign * dir.x);
    r.n2 = vec(b, sign + dir.y * dir.y * a, -dir.y);
    return r;
}

double patch_rounding(const Patch *p, Vec3 offset)
{
    /* Every coordinate of S is a convex combination of points no longer than the radius: 2 (k_u + k_v) + 4 roundings, relative
     * to it; N.S and N.o add 3 each, N itself is off by 4. All of them relative to the largest term, hence the maximum norm
     * times 3 for a dot product of three terms. */
    double n = 2 * (p->k_u + p->k_v) + 16;
    return 0.5 * DBL_EPSILON * n * (p->radius + fabs(offset.x) + fabs(offset.y) + fabs(offset.z));
}

typedef struct { double j11, j12, j21, j22, det; } Jacobian;

static Jacobian jacobian(const PatchRay *r, Vec3 a, Vec3 b)
{
    Jacobian j = { vec_dot(r->n1, a), vec_dot(r->n1, b), vec_dot(r->n2, a), vec_dot(r->n2, b), 0 };
    j.det = j.j11 * j.j22 - j.j12 * j.j21;
    return j;
}

/* Reports the root at (s, t), where F and the derivatives were last evaluated at (s - ds, t - dt). */
typedef struct { Vec4 value, by_s, by_t; double ds, dt; } LastStep;

static bool report(const Patch *p, PatchRay *r, Vec3 o, double s, double t, const LastStep *e, double rounding, Jacobian j,
                   RootVisit visit, void *context)
{
    double w = e->value.w + e->by_s.w * e->ds + e->by_t.w * e->dt;
    Vec3 h = vec(e->value.x + e->by_s.x * e->ds + e->by_t.x * e->dt, e->value.y + e->by_s.y * e->ds + e->by_t.y * e->dt,
                 e->value.z + e->by_s.z * e->ds + e->by_t.z * e->dt);
    double depth = vec_dot(r->d, vec_sub(vec_scale(h, 1 / w), o));
    if (!(depth > r->t_min && depth < r->t_max)) return false;
    Vec3 d_s = vec(e->by_s.x, e->by_s.y, e->by_s.z), d_t = vec(e->by_t.x, e->by_t.y, e->by_t.z);
    /* |J^-1| times the rounding, times how fast the depth changes along the surface */
    double slope = fabs(vec_dot(r->d, d_s)) * hypot(j.j12, j.j22) + fabs(vec_dot(r->d, d_t)) * hypot(j.j11, j.j21);
    Root root = { .s = double_min(double_max(s, 0), 1), .t = double_min(double_max(t, 0), 1), .depth = depth, .distance = 2 * rounding,
                  .depth_error = rounding * (1 + slope / fabs(j.det)) };
    return visit(context, p, r, &root);
}

typedef enum { NEWTON_INSIDE, NEWTON_OUTSIDE, NEWTON_UNDECIDED } NewtonResult;

/* From (*s, *t) to the root of F in the patch with its margin, if there is one. */
static NewtonResult newton(const Patch *p, const PatchRay *r, Vec3 o, double rounding, double *s, double *t, LastStep *e,
                           Jacobian *j, Trace *trace)
{
    double q1 = vec_dot(r->n1, o), q2 = vec_dot(r->n2, o);
    const double lo = -PATCH_MARGIN, hi = 1 + PATCH_MARGIN;
    for (int step = 0; step < MAX_STEPS; step++) {
        trace->counters.newton_iterations++;
        patch_evaluate(p, *s, *t, &e->value, &e->by_s, &e->by_t);
        *j = jacobian(r, vec(e->by_s.x, e->by_s.y, e->by_s.z), vec(e->by_t.x, e->by_t.y, e->by_t.z));
        if (!p->is_polynomial) {
            j->j11 -= e->by_s.w * q1, j->j21 -= e->by_s.w * q2;
            j->j12 -= e->by_t.w * q1, j->j22 -= e->by_t.w * q2;
            j->det = j->j11 * j->j22 - j->j12 * j->j21;
        }
        Vec3 h = vec(e->value.x, e->value.y, e->value.z);
        double f1 = vec_dot(r->n1, h) - e->value.w * q1, f2 = vec_dot(r->n2, h) - e->value.w * q2;
        double ds = (j->j12 * f2 - j->j22 * f1) / j->det, dt = (j->j21 * f1 - j->j11 * f2) / j->det;
        double s_new = double_min(double_max(*s + ds, lo), hi), t_new = double_min(double_max(*t + dt, lo), hi);
        e->ds = s_new - *s, e->dt = t_new - *t;
        *s = s_new, *t = t_new;
        if (!(fabs(ds) < 0x1p-26 && fabs(dt) < 0x1p-26)) continue;   /* the next error is about the square of this step */
        if (s_new == lo || s_new == hi || t_new == lo || t_new == hi) return NEWTON_UNDECIDED;
        /* how far rounding can move the root: |J^-1| times it */
        double slack_s = rounding * e->value.w * hypot(j->j12, j->j22) / fabs(j->det) + DBL_EPSILON;
        double slack_t = rounding * e->value.w * hypot(j->j11, j->j21) / fabs(j->det) + DBL_EPSILON;
        bool in = *s >= -slack_s && *s <= 1 + slack_s && *t >= -slack_t && *t <= 1 + slack_t;
        return in ? NEWTON_INSIDE : NEWTON_OUTSIDE;
    }
    return NEWTON_UNDECIDED;
}

bool patch_roots(const Patch *p, PatchRay *r, RootVisit visit, void *context, Trace *trace)
{
    Vec3 o = vec_sub(r->origin, p->origin);
    double q1 = vec_dot(r->n1, o), q2 = vec_dot(r->n2, o), depth = -vec_dot(r->d, o);
    double rounding = patch_rounding(p, o), reach = p->radius + rounding;
    if (q1 * q1 + q2 * q2 > reach * reach) return false;
    if (depth - reach > r->t_max || depth + reach < r->t_min) return false;
    if (!p->has_frame) return clip_roots(p, r, visit, context, trace);

    Jacobian j = jacobian(r, p->e_u, p->e_v);
    double det = fabs(j.det), slack = p->deviation + rounding;
    double x_s = q1 * j.j22 - q2 * j.j12, x_t = q2 * j.j11 - q1 * j.j21;   /* times det */
    double norm_s2 = j.j12 * j.j12 + j.j22 * j.j22, norm_t2 = j.j11 * j.j11 + j.j21 * j.j21;   /* at most 1 */
    double row_s = sqrt(norm_s2), row_t = sqrt(norm_t2);
    if (fabs(x_s) > p->half_u * det + row_s * slack || fabs(x_t) > p->half_v * det + row_t * slack) return false;
    if (!((norm_s2 + norm_t2) * p->variation * p->variation < 0.98 * j.det * j.det)) return clip_roots(p, r, visit, context, trace);
    trace->counters.certificates++;

    const double lo = -PATCH_MARGIN, hi = 1 + PATCH_MARGIN;
    double s = double_min(double_max(0.5 + 0.5 * x_s / (j.det * p->half_u), lo), hi);
    double t = double_min(double_max(0.5 + 0.5 * x_t / (j.det * p->half_v), lo), hi);
    LastStep e;
    switch (newton(p, r, o, rounding, &s, &t, &e, &j, trace)) {
    case NEWTON_INSIDE: return report(p, r, o, s, t, &e, rounding, j, visit, context);
    case NEWTON_OUTSIDE: return false;
    case NEWTON_UNDECIDED: break;
    }
    return clip_roots(p, r, visit, context, trace);
}
