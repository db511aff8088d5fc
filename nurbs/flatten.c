/* Flattening ([MCFS00] section 2.1): how finely to cut, before anything is cut.
 *
 * Curvature (the paper's choice): the number of knots to add to a span of a curve is n = C max|A| dt^{3/2} / avg|V|^{1/2},
 * with V and A the control points of the first and second derivative; the largest n of all rows (for u; columns for v)
 * counts, rounded to the nearest integer, and the knots are spaced evenly. In other words n = C turn sqrt(length).
 *
 * Without a C of the user's, sqrt(length) is left out: n = TURN_CUTS turn. Newton's iteration knows no scale. What it needs
 * of a leaf is that the surface turns through a small angle only, and how long the leaf is matters to no one, as nothing is
 * drawn in straight lines; so the choice does not depend on the scale of the scene, and a small fillet on a large part is
 * cut as finely as a large one. And as curves that are straight each may still twist against each other (a bilinear patch),
 * the angle through which the other direction's tangent turns along the span is an n as well.
 *
 * Adaptive (after [Pet94]): a span of all rows is halved until the control polygon of each row is within a chord bound of
 * its chord; without a bound of the user's, within CHORD_SHARE of the polygon's own length, for the same reason. */
#include "nurbs/flatten.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"

#include <string.h>

#define TURN_CUTS   3.0    /* knots added for each radian that a span turns through */
#define CHORD_SHARE 0.02    /* sagitta over length: of a circular arc of angle a it is a/8, so 0.16 rad a piece */
#define MAX_ADDED   1023    /* knots in one span: its square is the worst case of leaves, reached by absurd C only */
#define MAX_DEPTH   10      /* halvings: 2^10 pieces, the same limit */

/* One direction of the mesh: curves of order k, one for each of n_across control points of the other direction. */
typedef struct {
    const Surface *s;
    int k, n, n_across;
    const double *tau;
    size_t step, step_across;     /* between control points along the curve, and from curve to curve */
} Direction;

static Direction direction_of(const Surface *s, FlattenDirection d)
{
    if (d == FLATTEN_U) return (Direction){ s, s->k_u, s->n_u, s->n_v, s->tau_u, 1, (size_t)s->n_u };
    return (Direction){ s, s->k_v, s->n_v, s->n_u, s->tau_v, (size_t)s->n_u, 1 };
}

static Vec4 control_point(const Direction *d, int curve, int i)
{
    return d->s->p[(size_t)curve * d->step_across + (size_t)i * d->step];
}

FlattenCurve flatten_curve(int k, const double tau[], int mu, const Vec3 p[])
{
    Vec3 velocity[NURBS_MAX_ORDER];            /* V_j, j = mu-k+2 .. mu, at j - (mu-k+1); and p[0] is P_{mu-k+1} */
    double speed = 0, acceleration = 0, dt = tau[mu + 1] - tau[mu];
    for (int i = 1; i < k; i++) {
        int j = mu - k + 1 + i;
        velocity[i] = vec_scale(vec_sub(p[i], p[i - 1]), (k - 1) / (tau[j + k - 1] - tau[j]));
        speed += vec_length(velocity[i]) / (k - 1);
    }
    for (int i = 2; i < k; i++) {
        int j = mu - k + 1 + i;
        Vec3 a = vec_scale(vec_sub(velocity[i], velocity[i - 1]), (k - 2) / (tau[j + k - 2] - tau[j]));
        acceleration = fmax(acceleration, vec_length(a));
    }
    if (!(speed > 0)) return (FlattenCurve){ 0, 0 };
    return (FlattenCurve){ acceleration * dt / speed, speed * dt };
}

/* The angle between two edges across the quad, from a to c and from b to d, seen along it: each is turned by half of the
 * angle out of the plane of the middle lines. */
static double quad_twist(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    Vec3 along = vec_add(vec_sub(b, a), vec_sub(d, c)), across = vec_add(vec_sub(c, a), vec_sub(d, b));
    Vec3 lift = vec_sub(vec_sub(d, c), vec_sub(b, a)), normal = vec_normalize(vec_cross(along, across));
    return 2 * atan2(fabs(vec_dot(lift, normal)), vec_length(across));
}

/* The angle through which the tangent from curve p to its neighbour q turns along the span: the control points stand for
 * steps of (tau_{j+k-1} - tau_j) / (k-1), as in V_j. */
static double twist(int k, const double tau[], int mu, const Vec3 p[], const Vec3 q[])
{
    double turn = 0;
    for (int i = 1; i < k; i++) {
        int j = mu - k + 1 + i;
        double steps = (k - 1) * (tau[mu + 1] - tau[mu]) / (tau[j + k - 1] - tau[j]);
        turn = fmax(turn, steps * quad_twist(p[i - 1], p[i], q[i - 1], q[i]));
    }
    return turn;
}

static void curve_points(const Direction *d, int curve, int mu, Vec3 p[])
{
    for (int i = 0; i < d->k; i++) p[i] = vec4_project(control_point(d, curve, mu - d->k + 1 + i));
}

static int added_by_curvature(const Direction *d, const NurbsOptions *o, int mu)
{
    Vec3 p[NURBS_MAX_ORDER], neighbour[NURBS_MAX_ORDER];
    double n = 0;
    for (int curve = 0; curve < d->n_across; curve++) {
        curve_points(d, curve, mu, p);
        FlattenCurve c = flatten_curve(d->k, d->tau, mu, p);
        if (o->flatness > 0) {
            n = fmax(n, o->flatness * c.turn * sqrt(c.length));
        } else {
            n = fmax(n, TURN_CUTS * c.turn);
            if (curve > 0) n = fmax(n, TURN_CUTS * twist(d->k, d->tau, mu, neighbour, p));
            memcpy(neighbour, p, sizeof p);
        }
    }
    return (int)fmin(n + 0.5, MAX_ADDED);
}

/* A growing list in the caller's arena. */
typedef struct { Arena *a; double *at; size_t n, capacity; } CutList;

static void add_cut(CutList *l, double t) { ARENA_PUSH(l->a, l->at, l->n, l->capacity) = t; }

static void cut_evenly(CutList *l, double from, double to, int n_added)
{
    for (int i = 1; i <= n_added; i++) add_cut(l, from + (to - from) * i / (n_added + 1));
}

/* The farthest that an inner point of the polygon is from its chord, and the length of the polygon. */
static double chord_deviation(int k, const Vec3 p[], double *length)
{
    Vec3 chord = vec_sub(p[k - 1], p[0]);
    double c2 = vec_length2(chord), farthest = 0;
    *length = 0;
    for (int i = 1; i < k; i++) {
        Vec3 r = vec_sub(p[i], p[0]);
        double s = c2 > 0 ? fmin(fmax(vec_dot(r, chord) / c2, 0), 1) : 0;
        farthest = fmax(farthest, vec_length(vec_sub(r, vec_scale(chord, s))));
        *length += vec_length(vec_sub(p[i], p[i - 1]));
    }
    return farthest;
}

/* Are all curves flat? They stand side by side in `polygons`: blocks of n_across points (bezier.h). */
static bool is_flat(const Direction *d, const NurbsOptions *o, const Vec4 *polygons)
{
    for (int curve = 0; curve < d->n_across; curve++) {
        Vec3 p[NURBS_MAX_ORDER];
        double length;
        for (int i = 0; i < d->k; i++) p[i] = vec4_project(polygons[i * d->n_across + curve]);
        double deviation = chord_deviation(d->k, p, &length);
        if (deviation > (o->flatness > 0 ? o->flatness : CHORD_SHARE * length)) return false;
    }
    return true;
}

static void cut_adaptively(CutList *l, const Direction *d, const NurbsOptions *o, Arena *scratch, Vec4 *polygons,
                           double from, double to, int depth)
{
    double middle = from + (to - from) / 2;
    if (depth == MAX_DEPTH || !(from < middle && middle < to) || is_flat(d, o, polygons)) return;
    ArenaMark mark = arena_mark(scratch);
    Vec4 *left = ARENA_ARRAY(scratch, Vec4, d->k * d->n_across);
    bezier_cut(d->k, d->n_across, 0.5, polygons, left);
    cut_adaptively(l, d, o, scratch, left, from, middle, depth + 1);
    arena_reset(scratch, mark);
    add_cut(l, middle);
    cut_adaptively(l, d, o, scratch, polygons, middle, to, depth + 1);
}

static void cut_span_adaptively(CutList *l, const Direction *d, const NurbsOptions *o, Arena *scratch, int mu)
{
    ArenaMark mark = arena_mark(scratch);
    Vec4 *polygons = ARENA_ARRAY(scratch, Vec4, d->k * d->n_across);
    for (int i = 0; i < d->k; i++)
        for (int curve = 0; curve < d->n_across; curve++)
            polygons[i * d->n_across + curve] = control_point(d, curve, mu - d->k + 1 + i);
    bezier_from_span(d->k, d->tau, mu, d->n_across, polygons);
    cut_adaptively(l, d, o, scratch, polygons, d->tau[mu], d->tau[mu + 1], 0);
    arena_reset(scratch, mark);
}

Cuts flatten_cuts(const Surface *s, const NurbsOptions *o, FlattenDirection direction, Arena *a, Arena *scratch)
{
    Direction d = direction_of(s, direction);
    CutList l = { .a = a };
    for (int mu = d.k - 1; mu < d.n; mu++) {
        if (!knots_is_span(d.tau, mu)) continue;
        add_cut(&l, d.tau[mu]);
        if (o->flattening == NURBS_FLATTENING_ADAPTIVE) cut_span_adaptively(&l, &d, o, scratch, mu);
        else cut_evenly(&l, d.tau[mu], d.tau[mu + 1], added_by_curvature(&d, o, mu));
    }
    add_cut(&l, d.tau[d.n]);
    return (Cuts){ l.at, (int)l.n };
}
