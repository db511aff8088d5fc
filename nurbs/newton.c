/* Newton's iteration ([MCFS00] section 2.3). With the paper's letters: F(u, v) = (N1 . S + d1, N2 . S + d2), here
 * (N1 . (S - o), N2 . (S - o)), which spares the origin's rounding; F_u, F_v its derivatives; J = (F_u, F_v).
 *
 * The four criteria (Yang's):
 *   1. hit: |F| < epsilon, the rounding error of F itself (f_rounding): no smaller one can be asked for. And as the last
 *      step of a quadratic iteration is known before it is made, a step so small that what it leaves is below that (or
 *      below GOOD_ENOUGH) is made without evaluating again: see is_last_step. The error of t is derived from what is left.
 *   2. miss: |F| has grown since the last step. Not so when both are of the size of the rounding.
 *   3. miss: outside the domain. A step that leaves is shortened to the border, first; it is outside if the iteration, from
 *      a point on a border, wants to leave across that border again. A root on the border itself is so found from inside,
 *      with whatever sign its rounding has: the surfaces on both sides of a seam cannot both miss it. The domain is that of
 *      the smooth stretch round the leaf: beyond a corner J says nothing.
 *   4. miss: more than MAXITER iterations. The paper takes "around 7"; we allow 10, for a root at a border costs a
 *      step or two more, and near a silhouette a few halvings come before the quadratic end.
 *
 * If J is singular, the point is jittered: u_{k+1} = u_k + .1 (u_r - u_k) with u_r a random point of the leaf. The paper has
 * u_r between u_0 and u_k, which is u_0 itself at the first guess: no jitter where it is needed most. */
#include "nurbs/newton.h"

#include "nurbs/knots.h"
#include "nurbs/refine.h"
#include "render/hash.h"

#include <float.h>

/* |det J| <= SINGULAR |S_u| |S_v|: the sine of the ray's angle to the surface, times that between S_u and S_v. The rounding
 * of det J is some 2^-50 |S_u| |S_v|; a step computed with this J has 10 bits at least. */
#define SINGULAR 0x1p-40
#define JITTER 0.1           /* the paper's */

/* A step that leaves less than this share of the leaf's size is the last, too, if that is more than the rounding: it saves
 * the evaluation that would take a hit from 11 digits of a leaf to the last bit. t_error knows it. */
#define GOOD_ENOUGH 0x1p-36

NewtonRay newton_ray(const Ray *r)
{
    NewtonRay n = { .origin = r->origin, .d = vec_normalize(r->dir), .length = vec_length(r->dir) };
    bool x_is_largest = fabs(n.d.x) > fabs(n.d.y) && fabs(n.d.x) > fabs(n.d.z);
    n.N1 = vec_normalize(x_is_largest ? vec(n.d.y, -n.d.x, 0) : vec(0, n.d.z, -n.d.y));
    n.N2 = vec_cross(n.N1, n.d);
    return n;
}

/* Where the iteration stands. */
typedef struct {
    const Surface *s;
    const Leaf *leaf;
    const NewtonRay *ray;
    double u, v;
    int mu_u, mu_v;
    SurfacePoint at;
    Vec3 from_origin;        /* S - o */
    double F1, F2, F;        /* F = |(F1, F2)| */
    double J11, J12, J21, J22, det;
    double du, dv;           /* -J^-1 F */
    double epsilon;
} Iteration;

/* A span of t with t at its end at worst: the same as before if it will do (no search), from the left at the end of a
 * stretch. */
static int span_at(int mu, double t, int k, int n, const double *tau, const Piece *piece)
{
    if (tau[mu] <= t && t <= tau[mu + 1]) return mu;
    return t < piece->hi ? knots_span(k, n, tau, t) : knots_span_left(k, n, tau, t);
}

/* The rounding of F: that of the point, and 4 roundings of S - o and of N . (S - o), whose factor N has 4 of its own. */
static double f_rounding(const Surface *s, Vec3 from_origin)
{
    return 2 * (s->rounding + 8 * (DBL_EPSILON / 2) * vec_length(from_origin));
}

/* F, J and epsilon from S, S_u, S_v. */
static void project(Iteration *i)
{
    const NewtonRay *ray = i->ray;
    i->from_origin = vec_sub(i->at.point, ray->origin);
    i->F1 = vec_dot(ray->N1, i->from_origin), i->F2 = vec_dot(ray->N2, i->from_origin);
    i->F = sqrt(i->F1 * i->F1 + i->F2 * i->F2);
    i->J11 = vec_dot(ray->N1, i->at.s_u), i->J12 = vec_dot(ray->N1, i->at.s_v);
    i->J21 = vec_dot(ray->N2, i->at.s_u), i->J22 = vec_dot(ray->N2, i->at.s_v);
    i->det = i->J11 * i->J22 - i->J12 * i->J21;
    i->epsilon = f_rounding(i->s, i->from_origin);
}

static void evaluate(Iteration *i)
{
    const Surface *s = i->s;
    i->mu_u = span_at(i->mu_u, i->u, s->k_u, s->n_u, s->tau_u, i->leaf->piece_u);
    i->mu_v = span_at(i->mu_v, i->v, s->k_v, s->n_v, s->tau_v, i->leaf->piece_v);
    refine_evaluate(s, i->mu_u, i->u, i->mu_v, i->v, &i->at);
    project(i);
}

/* Compares squares: no root, and zero at a pole counts as singular. */
static bool is_singular(const Iteration *i)
{
    return !(i->det * i->det > SINGULAR * SINGULAR * vec_length2(i->at.s_u) * vec_length2(i->at.s_v));
}

static void newton_step(Iteration *i)   /* -adj(J) F / det J */
{
    i->du = (i->J12 * i->F2 - i->J22 * i->F1) / i->det;
    i->dv = (i->J21 * i->F1 - i->J11 * i->F2) / i->det;
}

/* How large the step is in units of the leaf. */
static double relative_step(const Iteration *i)
{
    return fmax(fabs(i->du) / (i->leaf->u1 - i->leaf->u0), fabs(i->dv) / (i->leaf->v1 - i->leaf->v0));
}

/* How far from the root the step ends, beyond what its first derivatives say; leaf.h. */
static double remainder_after(const Iteration *i) { return i->leaf->bend * relative_step(i) * relative_step(i); }

static bool is_in_spans(const Iteration *i, double u, double v)
{
    const double *tau_u = i->s->tau_u + i->leaf->mu_u, *tau_v = i->s->tau_v + i->leaf->mu_v;
    return tau_u[0] <= u && u <= tau_u[1] && tau_v[0] <= v && v <= tau_v[1];
}

/* Does the step leave less than the rounding of F? Then there is nothing to gain by evaluating again. The leaf vouches for
 * that as long as the step stays within its spans. */
static bool is_last_step(const Iteration *i)
{
    return remainder_after(i) < fmax(i->epsilon, GOOD_ENOUGH * i->leaf->size)
        && is_in_spans(i, i->u, i->v) && is_in_spans(i, i->u + i->du, i->v + i->dv);
}

static double clamp(double x, Piece p) { return fmin(fmax(x, p.lo), p.hi); }

/* Criterion 3. Takes the step, shortened to the border; false: the point was on the border that the step crosses. */
static bool move(Iteration *i)
{
    double u = i->u + i->du, v = i->v + i->dv;
    double on_u = clamp(u, *i->leaf->piece_u), on_v = clamp(v, *i->leaf->piece_v);
    if ((on_u != u && on_u == i->u) || (on_v != v && on_v == i->v)) return false;
    i->u = on_u, i->v = on_v;
    return true;
}

static void jitter(Iteration *i, uint64_t seed)
{
    const Leaf *l = i->leaf;
    double u_r = l->u0 + hash_unit(hash_combine(seed, 1)) * (l->u1 - l->u0);
    double v_r = l->v0 + hash_unit(hash_combine(seed, 2)) * (l->v1 - l->v0);
    i->u += JITTER * (u_r - i->u), i->v += JITTER * (v_r - i->v);
}

/* The depth of the root: the projection of the point on the ray, moved along by the step that was not evaluated. To first
 * order an error e of F moves the root by J^-1 e and so its depth by slant * e, slant = |d . (S_u, S_v) J^-1|, the cotangent
 * of the ray's angle to the surface: that times the rounding of F and what the step leaves is the error, and the rounding of
 * the projection. Where J is singular the ray touches the surface: then two circles' sagitta tells how far: sqrt(2 epsilon
 * size). */
static void set_root(const Iteration *i, bool with_step, NewtonRoot *out)
{
    Vec3 d = i->ray->d;
    double a = vec_dot(d, i->at.s_u), b = vec_dot(d, i->at.s_v);
    double slant = hypot(a * i->J22 - b * i->J21, b * i->J11 - a * i->J12) / fabs(i->det);
    double depth = vec_dot(i->from_origin, d);
    out->u = i->u, out->v = i->v;
    double touching = i->epsilon + sqrt(2 * i->epsilon * (i->leaf->size + i->epsilon));
    double error = (1 + slant) * (i->epsilon + (with_step ? remainder_after(i) : i->epsilon));
    if (with_step) {
        out->u = i->u + i->du, out->v = i->v + i->dv;
        depth += a * i->du + b * i->dv;
    } else if (!(error < touching)) {
        error = touching;
    }
    out->t = depth / i->ray->length, out->t_error = error / i->ray->length;
}

/* A point off the parallelogram |s| <= 1, |t| <= 1 of s F_u + t F_v lies beyond one of its two pairs of sides: its distance
 * from the line through the middle along F_u exceeds area / |F_u|, or the like for F_v. And det J = F_u x F_v
 * differs from that of the middle by at most turn_u |F_v| + turn_v |F_u| + turn_u turn_v. */
NewtonView newton_view(const Surface *s, const Leaf *leaf, const NewtonRay *ray)
{
    Vec3 from_origin = vec_sub(leaf->middle.point, ray->origin);
    Vec3 half_u = vec_scale(leaf->middle.s_u, (leaf->u1 - leaf->u0) / 2);
    Vec3 half_v = vec_scale(leaf->middle.s_v, (leaf->v1 - leaf->v0) / 2);
    Vec2 F = vec2(vec_dot(ray->N1, from_origin), vec_dot(ray->N2, from_origin));
    Vec2 F_u = vec2(vec_dot(ray->N1, half_u), vec_dot(ray->N2, half_u));
    Vec2 F_v = vec2(vec_dot(ray->N1, half_v), vec_dot(ray->N2, half_v));
    double off = leaf->bulge + f_rounding(s, from_origin), area = fabs(vec2_cross(F_u, F_v));
    double along_u = sqrt(vec2_dot(F_u, F_u)), along_v = sqrt(vec2_dot(F_v, F_v));
    if (fabs(vec2_cross(F, F_u)) > area + off * along_u) return NEWTON_OFF;
    if (fabs(vec2_cross(F, F_v)) > area + off * along_v) return NEWTON_OFF;
    double change = leaf->turn_u * along_v + leaf->turn_v * along_u + leaf->turn_u * leaf->turn_v;
    return area > change ? NEWTON_PLAIN : NEWTON_FOLDED;
}

Leaf newton_quarter(const Surface *s, const Leaf *leaf, int quarter)
{
    Leaf q = *leaf;
    double u = leaf->u0 + (leaf->u1 - leaf->u0) / 2, v = leaf->v0 + (leaf->v1 - leaf->v0) / 2;
    if (quarter & 1) q.u0 = u; else q.u1 = u;
    if (quarter & 2) q.v0 = v; else q.v1 = v;
    q.size /= 2, q.bend /= 4, q.bulge /= 4, q.turn_u /= 4, q.turn_v /= 4;
    refine_evaluate(s, q.mu_u, q.u0 + (q.u1 - q.u0) / 2, q.mu_v, q.v0 + (q.v1 - q.v0) / 2, &q.middle);
    return q;
}

NewtonOutcome newton_solve(const Surface *s, const Leaf *leaf, const NewtonRay *ray, int max_iterations, uint64_t seed,
                           Counters *counters, NewtonRoot *out)
{
    Iteration i = { .s = s, .leaf = leaf, .ray = ray, .mu_u = leaf->mu_u, .mu_v = leaf->mu_v, .at = leaf->middle };
    i.u = leaf->u0 + (leaf->u1 - leaf->u0) / 2, i.v = leaf->v0 + (leaf->v1 - leaf->v0) / 2;
    double F_before = INFINITY;
    project(&i);                                 /* the first evaluation is the same for all rays: see leaf.h */
    for (int n = 0; ; n++) {
        bool can_step = !is_singular(&i);
        if (can_step) newton_step(&i);
        if (can_step && is_last_step(&i)) return set_root(&i, true, out), NEWTON_ROOT;
        if (i.F < i.epsilon) return set_root(&i, false, out), NEWTON_ROOT;
        if (i.F > F_before + i.epsilon) return NEWTON_WORSE;
        if (n == max_iterations) return NEWTON_UNFINISHED;
        F_before = can_step ? i.F : INFINITY;
        if (!can_step) jitter(&i, hash_combine(seed, (uint64_t)n)), counters->newton_jitters++;
        else if (!move(&i)) return NEWTON_OUTSIDE;
        evaluate(&i);
        counters->newton_iterations++;
    }
}
