/* Thinning by [DP73], in space: the distance of a point from a chord is that to the image of the chord's
 * point that is nearest on the tangent plane. Trims are dense by themselves (TRIM_CHORD) where they are curved. The thinned
 * loops get a tree of their own, so that sides are judged by what the segments are and not by what they were. */
#include "nurbs/trim_thin.h"

#include "nurbs/refine.h"
#include "nurbs/trim_curve.h"
#include "nurbs/trim_flat.h"
#include "nurbs/trim_test.h"

#include <stdlib.h>

typedef struct { GridSegment segment; uint32_t span; } Placed;

typedef struct {
    const Grid *grid;
    Arena *arena, *scratch;
    double error;
    Placed *list;
    size_t n, capacity;
    TrimLoopDesc *loops;             /* thinned */
    size_t n_loops, loops_capacity;
} Thinning;

/* ---- thinning ---- */

typedef struct { Vec2 p; Vec3 point, s_u, s_v; } Point;   /* p in the unit square; the image, its derivatives by p */

static Point point_at(const Grid *g, Vec2 unit)
{
    const Surface *s = g->s;
    TrimRect domain = { s->u0, s->u1, s->v0, s->v1 };
    Vec2 p = trim_from_unit(&domain, unit);
    SurfacePoint at;
    refine_evaluate(s, g->u.mu[grid_span(&g->u, p.x)], p.x, g->v.mu[grid_span(&g->v, p.y)], p.y, &at);
    return (Point){ unit, at.point, vec_scale(at.s_u, s->u1 - s->u0), vec_scale(at.s_v, s->v1 - s->v0) };
}

/* Where on the chord from a to b, 0 to 1, the point is nearest, on the tangent plane. */
static double share_of(const Point *p, Vec2 a, Vec2 b)
{
    Vec2 to = vec2_sub(p->p, a), along = vec2_sub(b, a);
    Vec3 x = vec_add(vec_scale(p->s_u, to.x), vec_scale(p->s_v, to.y));
    Vec3 d = vec_add(vec_scale(p->s_u, along.x), vec_scale(p->s_v, along.y));
    double length2 = vec_length2(d);
    return length2 > 0 ? fmin(fmax(vec_dot(x, d) / length2, 0), 1) : 0;
}

static double distance(const Grid *g, Vec3 from, Vec2 to) { return vec_length(vec_sub(from, point_at(g, to).point)); }

typedef struct { int from, to; } Run;
typedef struct { Run *runs; size_t n, capacity; } RunList;

/* Of the points between the run's ends, the one that is worst served by their chord; -1: all are served well. The chord's own
 * part between what is nearest to two neighbours must be near, too: where a border is nearly a point, others may be within
 * the error of some point of the chord while much of it is far from all. */
static int worst_point(const Thinning *t, const Point *p, Run r)
{
    Vec2 a = p[r.from].p, b = p[r.to].p;
    int worst = -1;
    double most = t->error, last = 0;
    for (int i = r.from + 1; i <= r.to; i++) {
        double share = i < r.to ? share_of(&p[i], a, b) : 1, between = (last + share) / 2;
        Vec2 foot = vec2_add(a, vec2_scale(vec2_sub(b, a), share));
        Vec2 half = vec2_add(a, vec2_scale(vec2_sub(b, a), between));
        Vec2 middle = vec2_scale(vec2_add(p[i - 1].p, p[i].p), 0.5);
        double d = distance(t->grid, p[i].point, foot), d_half = distance(t->grid, point_at(t->grid, middle).point, half);
        if (i < r.to && d > most) most = d, worst = i;
        if (d_half > most && r.to - r.from > 1) most = d_half, worst = i < r.to ? i : i - 1;
        last = share;
    }
    return worst;
}

static void keep_between(Thinning *t, const Point *p, bool *keep, Run r, RunList *todo)
{
    int worst = worst_point(t, p, r);
    if (worst < 0) return;
    keep[worst] = true;
    ARENA_PUSH(t->scratch, todo->runs, todo->n, todo->capacity) = (Run){ r.from, worst };
    ARENA_PUSH(t->scratch, todo->runs, todo->n, todo->capacity) = (Run){ worst, r.to };
}

static int farthest_from_point(const Point *p, int n, Vec2 from)
{
    int farthest = 0;
    for (int i = 1; i <= n; i++)
        if (vec2_length(vec2_sub(p[i].p, from)) > vec2_length(vec2_sub(p[farthest].p, from))) farthest = i;
    return farthest;
}

static int farthest_from_line(const Point *p, int n, Vec2 from, Vec2 along)
{
    int farthest = 0;
    double most = 0;
    for (int i = 1; i <= n; i++) {
        double d = fabs(vec2_cross(along, vec2_sub(p[i].p, from)));
        if (d > most) most = d, farthest = i;
    }
    return farthest;
}

/* The chain is closed: of the smallest loop, too, three points are kept that span an area. */
static void mark_kept(Thinning *t, const Point *p, int n, bool *keep)
{
    for (int i = 0; i <= n; i++) keep[i] = i == 0 || i == n;
    int opposite = farthest_from_point(p, n, p[0].p);
    keep[opposite] = true;
    keep[farthest_from_line(p, n, p[0].p, vec2_sub(p[opposite].p, p[0].p))] = true;
    RunList todo = { 0 };
    for (int i = 1, last = 0; i <= n; i++) {
        if (!keep[i]) continue;
        ARENA_PUSH(t->scratch, todo.runs, todo.n, todo.capacity) = (Run){ last, i };
        last = i;
    }
    while (todo.n > 0) keep_between(t, p, keep, todo.runs[--todo.n], &todo);
}

/* ---- onto the grid ---- */

/* Within one span. Segments along its border divide nothing. */
static void place(Thinning *t, Vec2 p, Vec2 q)
{
    const GridAxis *u = &t->grid->u, *v = &t->grid->v;
    int i = grid_span(u, (p.x + q.x) / 2), j = grid_span(v, (p.y + q.y) / 2);
    GridPoint a = { grid_local(u, i, p.x), grid_local(v, j, p.y) }, b = { grid_local(u, i, q.x), grid_local(v, j, q.y) };
    bool is_border = (a.x == b.x && (a.x == 0 || a.x == GRID_SPAN)) || (a.y == b.y && (a.y == 0 || a.y == GRID_SPAN));
    if (is_border || (a.x == b.x && a.y == b.y)) return;
    Placed placed = { { a, b }, (uint32_t)(j * u->n + i) };
    ARENA_PUSH(t->scratch, t->list, t->n, t->capacity) = placed;
}

/* A point of a piece that lies on a knot line: there the coordinate is the knot. */
typedef struct { double share; Vec2 p; } Stop;

static int by_share(const void *a, const void *b)
{
    double d = ((const Stop *)a)->share - ((const Stop *)b)->share;
    return (d > 0) - (d < 0);
}

static int add_stops(const GridAxis *axis, bool is_u, Vec2 p, Vec2 q, Stop *stops)
{
    double from = is_u ? p.x : p.y, to = is_u ? q.x : q.y;
    int n = 0;
    for (int i = grid_span(axis, fmin(from, to)) + 1; i < axis->n; i++) {
        double knot = axis->tau[axis->mu[i]];
        if (knot >= fmax(from, to)) break;
        if (knot <= fmin(from, to)) continue;
        double share = (knot - from) / (to - from);
        Vec2 at = vec2_add(p, vec2_scale(vec2_sub(q, p), share));
        stops[n++] = (Stop){ share, is_u ? vec2(knot, at.y) : vec2(at.x, knot) };
    }
    return n;
}

static void place_piece(Thinning *t, Vec2 p, Vec2 q)
{
    const Grid *g = t->grid;
    Stop *stops = ARENA_ARRAY(t->arena, Stop, g->u.n + g->v.n);
    int n = add_stops(&g->u, true, p, q, stops);
    n += add_stops(&g->v, false, p, q, stops + n);
    qsort(stops, (size_t)n, sizeof *stops, by_share);
    for (int i = 0; i < n; i++) {
        place(t, p, stops[i].p);
        p = stops[i].p;
    }
    place(t, p, q);
}

static void add_loop(Thinning *t, const Point *p, int n, const bool *keep)
{
    const Surface *s = t->grid->s;
    TrimRect domain = { s->u0, s->u1, s->v0, s->v1 };
    TrimCurveDesc curve = { .order = 2 };
    Vec3 *points = ARENA_ARRAY(t->scratch, Vec3, n);
    for (int i = 0; i < n; i++) {
        Vec2 at = trim_from_unit(&domain, p[i].p);
        if (keep[i]) points[curve.n++] = vec(at.x, at.y, 1);
    }
    curve.points = points;
    const TrimCurveDesc *kept = arena_copy(t->scratch, &curve, 1, sizeof curve);
    TrimLoopDesc loop = { .curves = kept, .n_curves = 1, .is_polyline = true };
    ARENA_PUSH(t->scratch, t->loops, t->n_loops, t->loops_capacity) = loop;
}

typedef struct { Point *points; size_t n, capacity; } PointList;

/* How many spans lie between two parameters, fractions included. */
static double spans_between(const GridAxis *axis, double a, double b)
{
    int i = grid_span(axis, a), j = grid_span(axis, b);
    double steps = (double)(grid_local(axis, j, b) - grid_local(axis, i, a)) / (double)GRID_SPAN;
    return fabs(j - i + steps);
}

/* Straight pieces are long, but their images bend with the surface: they get points along them too. */
static void add_piece(Thinning *t, Vec2 from, Vec2 to, PointList *out)
{
    static const double POINTS_PER_SPAN = 32;
    const Surface *s = t->grid->s;
    TrimRect domain = { s->u0, s->u1, s->v0, s->v1 };
    Vec2 p = trim_from_unit(&domain, from), q = trim_from_unit(&domain, to), along = vec2_sub(to, from);
    double spans = fmax(spans_between(&t->grid->u, p.x, q.x), spans_between(&t->grid->v, p.y, q.y));
    int n = (int)ceil(spans * POINTS_PER_SPAN);
    for (int i = 0; i < n || i == 0; i++) {
        Vec2 at = i == 0 ? from : vec2_add(from, vec2_scale(along, (double)i / n));
        ARENA_PUSH(t->scratch, out->points, out->n, out->capacity) = point_at(t->grid, at);
    }
}

static void thin_chain(Thinning *t, const TrimChain *exact)
{
    TrimChain flat = trim_chain_flatten(t->scratch, exact, TRIM_CHORD);
    const Surface *s = t->grid->s;
    TrimRect domain = { s->u0, s->u1, s->v0, s->v1 };
    PointList list = { 0 };
    for (int i = 0; i < flat.path.n; i++) add_piece(t, flat.path.p[i], flat.path.p[i + 1], &list);
    const Point first = list.points[0];
    ARENA_PUSH(t->scratch, list.points, list.n, list.capacity) = first;
    const Point *p = list.points;
    int n = (int)list.n - 1;
    bool *keep = ARENA_ARRAY(t->scratch, bool, n + 1);
    mark_kept(t, p, n, keep);
    add_loop(t, p, n, keep);
    for (int i = 1, last = 0; i <= n; i++) {
        if (!keep[i]) continue;
        ArenaMark mark = arena_mark(t->arena);
        place_piece(t, trim_from_unit(&domain, p[last].p), trim_from_unit(&domain, p[i].p));
        arena_reset(t->arena, mark);
        last = i;
    }
}

static void thin_list(Thinning *t, const TrimList *l)
{
    for (int i = 0; i < l->n; i++) {
        thin_chain(t, &l->trims[i]->chain);
        thin_list(t, &l->trims[i]->inner);
    }
}

/* Should thinned loops cross more than trims may, the trims as they are must do. */
static const TrimTree *thinned_tree(const Thinning *t)
{
    const Surface *s = t->grid->s;
    NurbsError error;
    TrimInput in = { .loops = t->loops, .n_loops = (int)t->n_loops, .keep_left = s->trims->keep_left,
                     .domain = { s->u0, s->u1, s->v0, s->v1 } };
    const TrimTree *tree = trim_tree_new(t->arena, &in, &error, NULL, 0, NULL);
    return tree ? tree : s->trims;
}

static GridTrims sort_by_span(const Thinning *t)
{
    uint32_t n_spans = (uint32_t)(t->grid->u.n * t->grid->v.n);
    uint32_t *first = arena_zalloc(t->arena, n_spans + 2, sizeof *first);
    GridSegment *segments = ARENA_ARRAY(t->arena, GridSegment, t->n);
    for (size_t i = 0; i < t->n; i++) first[t->list[i].span + 2]++;
    for (uint32_t c = 2; c < n_spans + 2; c++) first[c] += first[c - 1];
    for (size_t i = 0; i < t->n; i++) segments[first[t->list[i].span + 1]++] = t->list[i].segment;
    return (GridTrims){ segments, first, thinned_tree(t) };
}

GridTrims grid_trims(Arena *a, Arena *scratch, const Grid *grid, double error)
{
    Thinning t = { .grid = grid, .arena = a, .scratch = scratch, .error = error };
    ArenaMark mark = arena_mark(scratch);
    thin_list(&t, &grid->s->trims->top);
    GridTrims sorted = sort_by_span(&t);
    arena_reset(scratch, mark);
    return sorted;
}
