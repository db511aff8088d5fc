/* The frame test, the certificate and Newton's method.
 *
 * With o the ray's origin relative to the patch's and H the homogeneous numerator, the equations are F = (N1.(H - w o),
 * N2.(H - w o)); F/w is the distance of S from the ray in the two planes. C = N.(half_s half_t) are the frame's half-vectors
 * as the ray sees them, q = N.(o - middle).
 *
 * Miss at sight: a root satisfies C (x, y) = q - N.r with |x|, |y| <= 1, |r| <= deviation. By Cramer's rule |x det C| >=
 * |q1 C22 - q2 C12| - |(C12, C22)| deviation.
 *
 * At most one root: let J_m = 2 w_middle C, and both columns be divided by their lengths in space. On a convex domain F(x) -
 * F(y) = (J_m + N.E)(x - y), N.E being an average of J - J_m. If |J_m^-1 N.E| < 1 this vanishes only for x = y. With P the
 * projection on the frame's plane and m its unit normal, N.E = N.PE + N.m (m.E). A vector v in the plane is that of the
 * frame's coordinates C^-1 N.v, which are no longer than |v| / sigma; and N.m is -N.Pd / m.d, since N.d = 0. So |J_m^-1 N.E|
 * <= stretch + turn cot, cot being that of the angle between the ray and the plane, whose sine is |m.d| = |det C| / |half_s
 * x half_t|. It holds on the tile with its margin, so that a root in the margin proves that the tile itself has none.
 *
 * |C^-1| itself is at most 1 / (sigma |m.d|): any vector across the ray is as good as its projection on the plane along the
 * ray, which is no longer than |v| / |m.d|. Sigma times the larger singular value, of at most sqrt 2, is |half_s x half_t|
 * over the lengths, so that this is at most sqrt 2 length_s length_t / |det C|.
 *
 * C is rounded by less than 2^-48 of the lengths (TILE_VIEW_ROUNDINGS), which counts as part of E. That C^-1 and det are of
 * C as rounded changes their bounds by a share of |C^-1| 2^-48, less than 2^-26 (TILE_LEAST_VARIATION). */
#include "nurbs/certify.h"

#include "nurbs/certify_proof.h"
#include "nurbs/clip.h"
#include "nurbs/doubt.h"
#include "nurbs/paraboloid_kernel.h"
#include "nurbs/patch_kernel.h"
#include "nurbs/pole.h"
#include "nurbs/pole_cone.h"

#include <math.h>

PatchRay patch_ray(Vec3 origin, Vec3 dir, double t_min, double t_max)
{
    PatchRay r = { .origin = origin, .d = dir, .t_min = t_min, .t_max = t_max };
    frame_of_direction(dir, &r.n1, &r.n2);
    return r;
}

double patch_rounding(const Patch *p, Vec3 offset) { return rounding_at(p, vec_length(offset)); }

/* The plane equations of one ray and tile, and where the iteration stands. */
typedef struct {
    const Tile *tile;
    const Patch *p;                /* the tile's */
    KernelPart part;               /* the tile's place */
    PatchRay *r;
    Vec3 o;                        /* the ray's origin about the patch's */
    double q1, q2, rounding;       /* q: about the tile's middle */
    double s, t;                   /* the iterate */
    V4 to_ray[4];                  /* columns: from (x, y, z, w) about the patch to (w F1, w F2, w depth, w) */
    PatchPoint last;               /* evaluated at (s - ds, t - dt), as the ray sees it */
    double ds, dt;
    double j11, j12, j21, j22, det;
    double c11, c12, c21, c22, c_det;   /* the frame's */
    double gain;                   /* at least |C^-1|, lengths being those of half the tile */
    double contraction;            /* q of the frame's certificate */
    double least_step2;            /* what proves a miss */
} Solve;

ALWAYS_INLINE void set_to_ray(Solve *k)
{
    const PatchRay *r = k->r;
    V4 x = { r->n1.x, r->n2.x, r->d.x, 0 }, y = { r->n1.y, r->n2.y, r->d.y, 0 }, z = { r->n1.z, r->n2.z, r->d.z, 0 };
    k->to_ray[0] = x, k->to_ray[1] = y, k->to_ray[2] = z;
    k->to_ray[3] = (V4){ 0, 0, 0, 1 } - (x * k->o.x + y * k->o.y + z * k->o.z);
}

ALWAYS_INLINE V4 seen(const Solve *k, V4 p)
{
    return (k->to_ray[0] * p[0] + k->to_ray[1] * p[1]) + (k->to_ray[2] * p[2] + k->to_ray[3] * p[3]);
}

/* Sets `last` and the Jacobian there. */
ALWAYS_INLINE void evaluate(Solve *k)
{
    PatchPoint at = kernel_tile(k->p, &k->part, &k->s, &k->t);
    k->last = (PatchPoint){ seen(k, at.value), seen(k, at.by_s), seen(k, at.by_t) };
    k->j11 = k->last.by_s[0], k->j12 = k->last.by_t[0];
    k->j21 = k->last.by_s[1], k->j22 = k->last.by_t[1];
    k->det = k->j11 * k->j22 - k->j12 * k->j21;
}

ALWAYS_INLINE double length2(double a, double b) { return sqrt(a * a + b * b); }
ALWAYS_INLINE double clamped(double x, double lo, double hi) { return double_min(double_max(x, lo), hi); }

/* Reports the root at (s, t): the last evaluation and a step by the derivatives, whose square is lost in the rounding. */
ALWAYS_INLINE bool report(const Solve *k, RootVisit visit, void *context)
{
    V4 h = k->last.value + k->last.by_s * k->ds + k->last.by_t * k->dt;
    double depth = h[2] / h[3];
    if (!(depth > k->r->t_min && depth < k->r->t_max)) return false;
    /* the rounding moves the root by J^-1 times itself, and the depth by how that changes along the surface */
    double along_s = k->last.by_s[2] - depth * k->last.by_s[3], along_t = k->last.by_t[2] - depth * k->last.by_t[3];
    double slope = length2(along_s * k->j22 - along_t * k->j21, along_t * k->j11 - along_s * k->j12);
    TilePlace at = k->part.at;
    Root root = { .s = at.s0 + clamped(k->s, 0, 1) * at.ds, .t = at.t0 + clamped(k->t, 0, 1) * at.dt,
                  .depth = depth, .distance = 2 * k->rounding, .beside = k->rounding,
                  .depth_error = k->rounding * (1 + slope / fabs(k->det)) };
    return visit(context, k->tile, k->r, &root);
}

typedef enum { NEWTON_INSIDE, NEWTON_OUTSIDE, NEWTON_UNDECIDED } NewtonResult;

/* Beyond the patch the sizes of a combination's terms add up to more than itself: the Bernstein polynomials of order k to
 * (1 + 2 d)^(k-1) at a distance of d, and roundings grow by as much. */
static __attribute__((noinline)) double growth_at(const Patch *p, double x, double y)
{
    double d = double_max(double_max(-x, x - 1), double_max(-y, y - 1));
    return d > 0 ? pow(1 + 2 * d, p->k_u + p->k_v - 2) : 1;
}

ALWAYS_INLINE double growth_beyond_patch(const Solve *k)
{
    if (k->s >= 0 && k->s <= 1 && k->t >= 0 && k->t <= 1) return 1;
    TilePlace at = k->part.at;
    return growth_at(k->p, at.s0 + k->s * at.ds, at.t0 + k->t * at.dt);
}

/* A converged iterate: on the patch, as far as rounding can tell, which can move the root by |J^-1| times itself, and by the
 * last bit of s and t? */
ALWAYS_INLINE NewtonResult place_of_root(const Solve *k)
{
    const double lo = -TILE_MARGIN, hi = 1 + TILE_MARGIN;
    if (k->s >= 0 && k->s <= 1 && k->t >= 0 && k->t <= 1) return NEWTON_INSIDE;
    if (!(k->s > lo && k->s < hi && k->t > lo && k->t < hi)) return NEWTON_UNDECIDED;
    double moved = growth_beyond_patch(k) * k->rounding * k->last.value[3] / fabs(k->det);
    double slack_s = moved * length2(k->j12, k->j22) + DBL_EPSILON, slack_t = moved * length2(k->j11, k->j21) + DBL_EPSILON;
    bool is_in = k->s >= -slack_s && k->s <= 1 + slack_s && k->t >= -slack_t && k->t <= 1 + slack_t;
    return is_in ? NEWTON_INSIDE : NEWTON_OUTSIDE;
}

/* ---- what a step proves ---- */

/* The square of the shortest step from which something is proved; INFINITY: none. */
ALWAYS_INLINE double least_step2(const Solve *k)
{
    const Tile *f = k->tile;
    const Patch *p = k->p;
    double u = f->length_s, v = f->length_t, q = k->contraction, off = p->growth * p->w_max * k->rounding;
    TilePlace at = k->part.at;
    double slopes = (p->k_u - 1) * at.ds * v + (p->k_v - 1) * at.dt * u;
    if (!(off * slopes * k->gain < 0.5 * BLUR * q * f->w_middle * u * v)) return INFINITY;
    double least = off * k->gain / (BLUR * q * (1 - q) * (1 - q) * f->w_middle);
    return least * least;
}

/* The square of the length of a step: lengths are those of half the tile. */
ALWAYS_INLINE double length2_of(const Solve *k, double ds, double dt)
{
    double x = k->tile->length_s * ds, y = k->tile->length_t * dt;
    return x * x + y * y;
}

/* Is it certain, from the Newton step (ds, dt) at (s, t), that the patch has no root? Let J = J_m (I + E_2) here and J_m (I
 * + E_1) on average on the way to a root x*: both |E| <= q in the frame's norm. Then x* - x = (I + E_1)^-1 (I + E_2) step,
 * so x* is within 2q/(1-q) |step| of x + step; if that is nearer than the patch, there is no such root. */
ALWAYS_INLINE bool proves_miss(const Solve *k, double ds, double dt)
{
    double s = k->s + ds, t = k->t + dt, step2 = length2_of(k, ds, dt), reach = 2 * k->contraction / (1 - k->contraction);
    double out2 = length2_of(k, double_max(double_max(-s, s - 1), 0), double_max(double_max(-t, t - 1), 0));
    return step2 > k->least_step2 && out2 > BLURRED * BLURRED * reach * reach * step2;
}

/* The same from F at (s, t), where steps are clamped to the square with its margin. G(x) = x - J_m^-1 F(x) contracts with q,
 * and so does PG, P the clamping, which lengthens nothing: a root x* in the square has |x* - x| <= |PG(x) - x| / (1 - q),
 * and |G(x) - x| <= (1 + q) |x* - x|. */
ALWAYS_INLINE bool proves_miss_by_clamping(const Solve *k, double f1, double f2)
{
    double scale = 1 / (2 * k->c_det * k->tile->w_middle);
    double g_s = (k->c12 * f2 - k->c22 * f1) * scale, g_t = (k->c21 * f1 - k->c11 * f2) * scale;   /* of the tile */
    double p_s = clamped(k->s + g_s, -TILE_MARGIN, 1 + TILE_MARGIN) - k->s;
    double p_t = clamped(k->t + g_t, -TILE_MARGIN, 1 + TILE_MARGIN) - k->t;
    double least = (1 + k->contraction) / (1 - k->contraction), g2 = length2_of(k, g_s, g_t);
    return g2 > k->least_step2 && g2 > BLURRED * BLURRED * least * least * length2_of(k, p_s, p_t);
}

/* Is the root x*, if there is one, certainly out of the ray's reach? With the bounds of proves_miss, |x* - x| is within
 * (1+q)/(1-q) |step|. The numerator about the root's point X vanishes there, so that at x it is at most (J_m + E)(x - x*):
 * |S(x) - X| <= 2 w_middle/w (sqrt 2 + turn + stretch) |x* - x|. */
ALWAYS_INLINE bool is_out_of_reach(const Solve *k, double depth, double ds, double dt)
{
    double gap = double_max(k->r->t_min - depth, depth - k->r->t_max) - k->rounding, step2 = length2_of(k, ds, dt);
    double far = BLURRED * (1 + k->contraction) * 2 * k->tile->w_middle * (M_SQRT2 + k->tile->turn + k->tile->stretch);
    double near = (1 - k->contraction) * k->last.value[3] * gap;
    return gap > 0 && step2 > k->least_step2 && near * near > far * far * step2;
}

/* From (s, t) to the root of F in the patch with its margin, if there is one. */
ALWAYS_INLINE NewtonResult newton(Solve *k, Trace *trace)
{
    const double lo = -TILE_MARGIN, hi = 1 + TILE_MARGIN;
    for (int step = 0; step < MAX_STEPS; step++) {
        trace->counters.newton_iterations++;
        evaluate(k);
        double f1 = k->last.value[0], f2 = k->last.value[1], scale = 1 / k->det;
        double ds = (k->j12 * f2 - k->j22 * f1) * scale, dt = (k->j21 * f1 - k->j11 * f2) * scale;
        double s = clamped(k->s + ds, lo, hi), t = clamped(k->t + dt, lo, hi);
        bool leaves = s != k->s + ds || t != k->t + dt;
        if (leaves && (proves_miss(k, ds, dt) || proves_miss_by_clamping(k, f1, f2))) return NEWTON_OUTSIDE;
        if (step > 0 && is_out_of_reach(k, k->last.value[2] / k->last.value[3], ds, dt)) return NEWTON_OUTSIDE;
        k->ds = leaves ? s - k->s : ds, k->dt = leaves ? t - k->t : dt;    /* with bits that s and t have no room for */
        k->s = s, k->t = t;
        if (fabs(k->ds) < LAST_STEP && fabs(k->dt) < LAST_STEP) return leaves ? NEWTON_UNDECIDED : place_of_root(k);
    }
    return NEWTON_UNDECIDED;
}

/* ---- where the ray starts ---- */

/* Is the point that the ray may be from on the tile, with its margin? Sets s and t of the tile: exact, s0 being no other
 * multiple of ds than one beside it. */
ALWAYS_INLINE bool is_from(const Tile *f, const PatchRay *r, double *s, double *t)
{
    if (r->from != f->patch) return false;
    TilePlace at = tile_place(f);
    *s = (r->from_s - at.s0) / at.ds, *t = (r->from_t - at.t0) / at.dt;
    return *s >= -TILE_MARGIN && *s <= 1 + TILE_MARGIN && *t >= -TILE_MARGIN && *t <= 1 + TILE_MARGIN;
}

/* Does the ray start above a point X of the tile, to the side that it leaves for, so that it cannot meet the tile?
 *
 * X = S(x_g). The numerator about X vanishes at x_g, so that at x it is 2 w_middle (F + E)(x - x_g), F being the
 * half-vectors over their lengths. The chord S(x) - X rises from the frame's plane by at most turn sigma |x - x_g|, and goes
 * along it by at least (1 - stretch) sigma |x - x_g|, both times 2 w_middle / w: no chord is steeper than
 * turn / (1 - stretch). What is steeper, on one side of the plane, is convex: if the start seen from X is, and the
 * direction, all of the ray is, and none of it on the tile.
 *
 * The start seen from X is `off` by the rounding of X, of the start and of their difference, and where the surface is
 * otherwise than the patch has it. For the direction, whose rounding is less than CONTRACTION leaves room for, a slope of
 * turn / (CONTRACTION - stretch) stands for the steepest chord's; `steepest` is its sine. */
ALWAYS_INLINE bool leaves_tile(const Tile *f, const PatchRay *r)
{
    double s, t;
    if (!is_from(f, r, &s, &t) || !(f->stretch < CONTRACTION)) return false;
    const Patch *p = f->patch;
    Vec3 normal = vec_cross(tile_vec(f->half_s), tile_vec(f->half_t)), o = vec_sub(r->origin, p->origin);
    double along = vec_dot(normal, r->d), area = (double)f->sine * f->length_s * f->length_t;
    double room = CONTRACTION - f->stretch, turn2 = (double)f->turn * f->turn, steepest2 = turn2 / (turn2 + room * room);
    if (!(along * along > steepest2 * area * area)) return false;
    V4 x = kernel_evaluate(p, r->from_s, r->from_t).value;
    Vec3 start = vec_add(vec_sub(o, vec_scale(vec(x[0], x[1], x[2]), 1 / x[3])), vec_scale(r->d, r->t_min));
    double off = rounding_at(p, p->radius + fabs(o.x) + fabs(o.y) + fabs(o.z) + fabs(r->t_min));
    double rise = copysign(1, along) * vec_dot(normal, start);
    return rise > area * (sqrt(steepest2 * vec_length2(start)) + 2 * off);
}

typedef enum { FRAME_MISS, FRAME_ONE_AT_MOST, FRAME_UNDECIDED, FRAME_HOPELESS } FrameResult;

/* What the frame says; sets s and t to the parallelogram's root, within the margin. */
ALWAYS_INLINE FrameResult frame_test(Solve *k)
{
    const Tile *f = k->tile;
    Vec3 a = tile_vec(f->half_s), b = tile_vec(f->half_t);
    double u = f->length_s, v = f->length_t, slack = f->deviation + k->rounding;
    k->c11 = vec_dot(k->r->n1, a), k->c12 = vec_dot(k->r->n1, b);
    k->c21 = vec_dot(k->r->n2, a), k->c22 = vec_dot(k->r->n2, b);
    k->c_det = k->c11 * k->c22 - k->c12 * k->c21;
    double det = fabs(k->c_det);
    if (!(det > NO_ANGLE * u * v)) return FRAME_HOPELESS;
    double x = k->q1 * k->c22 - k->q2 * k->c12, y = k->q2 * k->c11 - k->q1 * k->c21;   /* times det */
    double column_s2 = k->c11 * k->c11 + k->c21 * k->c21, column_t2 = k->c12 * k->c12 + k->c22 * k->c22;
    double past_x = double_max(fabs(x) - det, 0), past_y = double_max(fabs(y) - det, 0);
    if (past_x * past_x > column_t2 * slack * slack || past_y * past_y > column_s2 * slack * slack) return FRAME_MISS;
    double area = f->sine * u * v, along2 = double_max(area * area - det * det, 0), turn2 = along2 * f->turn * f->turn;
    double room = double_max(CONTRACTION - f->stretch, 0) * det, worth = double_max(WORTH_HALVING - f->stretch, 0) * det;
    if (!(turn2 < room * room)) return turn2 < worth * worth ? FRAME_UNDECIDED : FRAME_HOPELESS;
    k->gain = M_SQRT2 * u * v / det, k->contraction = f->stretch + f->turn * sqrt(along2) / det;
    const double lo = -TILE_MARGIN, hi = 1 + TILE_MARGIN, scale = 0.5 / k->c_det;
    k->s = clamped(0.5 + x * scale, lo, hi);
    k->t = clamped(0.5 + y * scale, lo, hi);
    return FRAME_ONE_AT_MOST;
}

/* The ray at the tile: false, it passes by. */
ALWAYS_INLINE bool set_up(Solve *k)
{
    const Tile *tile = k->tile;
    const PatchRay *r = k->r;
    k->o = vec_sub(r->origin, k->p->origin);
    Vec3 o = vec_sub(k->o, tile_vec(tile->middle));
    k->q1 = vec_dot(r->n1, o), k->q2 = vec_dot(r->n2, o);
    k->rounding = rounding_at(k->p, fabs(k->o.x) + fabs(k->o.y) + fabs(k->o.z));    /* no less, and takes no root */
    double depth = -vec_dot(r->d, o), reach = tile->radius + k->rounding;
    return !(k->q1 * k->q1 + k->q2 * k->q2 > reach * reach || depth - reach > r->t_max || depth + reach < r->t_min);
}

/* At most one root: Newton's method, from the parallelogram's or from where the ray comes from. False: it comes to no end,
 * or to the margin's; the tile's halves have better certificates. *ended: a visit ended the search. */
ALWAYS_INLINE bool solve_one(Solve *k, RootVisit visit, void *context, Trace *trace, bool *ended)
{
    trace->counters.certificates++, trace->counters.nurbs_tests++;
    const Tile *f = k->tile;
    k->rounding = patch_rounding(k->p, k->o);
    set_to_ray(k);
    k->part = kernel_part(f);
    k->least_step2 = least_step2(k);
    double from_s, from_t;
    if (is_from(f, k->r, &from_s, &from_t)) k->s = from_s, k->t = from_t;
    NewtonResult is = newton(k, trace);
    *ended = is == NEWTON_INSIDE && report(k, visit, context);
    return is != NEWTON_UNDECIDED;
}

ALWAYS_INLINE FrameResult meet_tile(Solve *k, const Tile *tile, PatchRay *r)
{
    if (leaves_tile(tile, r)) return FRAME_MISS;
    k->tile = tile, k->p = tile->patch, k->r = r;
    return set_up(k) ? frame_test(k) : FRAME_MISS;
}

/* ---- rays in doubt ---- */

/* The frame's answer for a half, unless the paraboloid knows better: in a quarter of the time of Newton's method, too. */
ALWAYS_INLINE FrameResult meet_half(Solve *k, const Halves *h, int i, PatchRay *r)
{
    halves_fetch_ahead(&h->tiles[i]);
    FrameResult is = meet_tile(k, &h->tiles[i], r);
    if (is == FRAME_MISS) return is;
    SeenTile seen = { r->n1, r->n2, k->q1, k->q2, k->c11, k->c12, k->c21, k->c22, k->c_det, k->rounding };
    return paraboloid_is_missed(&h->paraboloids[i], &seen) ? FRAME_MISS : is;
}

/* How often both halves of a tile may be in doubt on the way down. One half alone shows that halving leads somewhere: to a
 * near miss, or to two roots that part. Where both are in doubt again and again the ray keeps to the surface along a whole
 * line, as many tiles as there are would be met, and clip.c, which refines across the ray, is faster. */
#define DOUBTS 6

typedef struct { const Tile *tile; int doubts; } InDoubt;

static bool clip_in_doubt(const Tile *tile, PatchRay *r, RootVisit visit, void *context, Trace *trace)
{
    trace->counters.nurbs_tests++;
    return clip_roots(tile, r, visit, context, trace);
}

/* Is the first half the farther one? Where the nearest root is asked for, what lies behind it is not looked at. */
ALWAYS_INLINE bool is_second_nearer(const Halves *h, const PatchRay *r)
{
    return vec_dot(r->d, vec_sub(tile_vec(h->tiles[1].middle), tile_vec(h->tiles[0].middle))) < 0;
}

/* All roots of a tile in doubt. One with a pole on the ray would be halved for nothing. */
EVERY_X86
static bool roots_in_doubt(const Tile *tile, PatchRay *r, RootVisit visit, void *context, Trace *trace)
{
    PoleSide side;
    if (tile->patch->collapsed && pole_is_met(tile, r, &side)) return clip_in_doubt(tile, r, visit, context, trace);
    InDoubt stack[TILE_MAX_HALVINGS + 1] = { { tile, DOUBTS } };
    for (int top = 1; top > 0; ) {
        InDoubt d = stack[--top];
        const Halves *halves = tile_halves(d.tile);
        Solve k[2];
        FrameResult is[2] = { FRAME_MISS, FRAME_MISS };
        for (int i = 0; i < 2 && halves; i++) is[i] = meet_half(&k[i], halves, i, r);
        bool is_stuck = is[0] == FRAME_UNDECIDED && is[1] == FRAME_UNDECIDED && d.doubts-- == 0;
        if (!halves || is_stuck) {
            if (clip_in_doubt(d.tile, r, visit, context, trace)) return true;
            continue;
        }
        int near = is[0] != FRAME_MISS && is[1] != FRAME_MISS && is_second_nearer(halves, r), order[2] = { 1 - near, near };
        for (int n = 0; n < 2; n++) {
            int i = order[n];
            bool ended = false;
            if (is[i] == FRAME_HOPELESS) ended = clip_in_doubt(&halves->tiles[i], r, visit, context, trace);
            if (is[i] == FRAME_ONE_AT_MOST && !solve_one(&k[i], visit, context, trace, &ended)) is[i] = FRAME_UNDECIDED;
            if (is[i] == FRAME_UNDECIDED) stack[top++] = (InDoubt){ &halves->tiles[i], d.doubts };
            if (ended) return true;
        }
    }
    return false;
}

EVERY_X86
bool tile_roots(const Tile *tile, PatchRay *r, RootVisit visit, void *context, Trace *trace)
{
    if (tile->cone && pole_cone_is_out_of_reach(pole_cone_of(tile), tile->patch, r)) return false;
    Solve k;
    bool ended;
    switch (meet_tile(&k, tile, r)) {
    case FRAME_MISS: return false;
    case FRAME_UNDECIDED: break;
    case FRAME_HOPELESS: return clip_in_doubt(tile, r, visit, context, trace);
    case FRAME_ONE_AT_MOST:
        if (solve_one(&k, visit, context, trace, &ended)) return ended;
        break;
    }
    return roots_in_doubt(tile, r, visit, context, trace);
}
