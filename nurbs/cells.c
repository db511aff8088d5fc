/* Each span's Bézier patch is halved until its second derivatives are small enough.
 *
 * Over a rectangle of sides a and b let T be the map of a triangle with corners on S. At a point x of the triangle, with
 * barycentric coordinates c_i of its corners x_i, Taylor about x gives T - S = 1/2 sum c_i (x_i - x)' H_i (x_i - x). As
 * sum c_i (u_i - u)^2 <= a^2 / 4 for numbers within an interval of length a, and likewise for v and, by Cauchy and Schwarz,
 * for the product,
 *     |T - S| <= (a^2 max|S_uu| + 2 a b max|S_uv| + b^2 max|S_vv|) / 8
 * whatever the triangle's form ([FMM86] have it for right triangles). So cells may be triangulated as
 * their neighbours and the trims want it. */
#include "nurbs/cells.h"

#include "nurbs/bezier.h"
#include "nurbs/prepare.h"

#include <stdlib.h>

typedef struct {
    Arena *arena, *scratch;
    const Grid *grid;
    double chord_error;
    Cells out;
    Cell *cells;
    size_t n_cells, capacity;
} Division;

/* Trims take half of the error: a quarter for thinning them, which is measured at their points, and a quarter in reserve for
 * what lies between these. */
#define SHARE_OF_TRIMS 0.25
#define SHARE_NEAR_TRIMS 0.5

/* Cells with more segments are halved: triangulating takes the square of their number. */
#define MOST_SEGMENTS 128

/* ---- stops ---- */

static void add_stop(Division *d, GridStops *s, int64_t line, int64_t at)
{
    ARENA_PUSH(d->arena, s->stops, s->n, s->capacity) = (GridStop){ line, at };
}

static void add_stops(Division *d, const Cell *c, GridPoint p)
{
    const Grid *g = d->grid;
    int64_t x = c->i * GRID_SPAN + p.x, y = c->j * GRID_SPAN + p.y;
    bool is_last_u = x == g->u.n * GRID_SPAN, is_last_v = y == g->v.n * GRID_SPAN;
    if (p.x == c->low.x || p.x == c->high.x) add_stop(d, &d->out.across_u, is_last_u && d->out.is_closed_u ? 0 : x, y);
    if (p.y == c->low.y || p.y == c->high.y) add_stop(d, &d->out.across_v, is_last_v && d->out.is_closed_v ? 0 : y, x);
}

static int by_place(const void *a, const void *b)
{
    const GridStop *s = a, *t = b;
    if (s->line != t->line) return s->line < t->line ? -1 : 1;
    return (s->at > t->at) - (s->at < t->at);
}

static void sort_stops(GridStops *s)
{
    size_t n = 0;
    if (s->n > 0) qsort(s->stops, s->n, sizeof *s->stops, by_place);
    for (size_t i = 0; i < s->n; i++)
        if (n == 0 || by_place(&s->stops[i], &s->stops[n - 1]) != 0) s->stops[n++] = s->stops[i];
    s->n = n;
}

static size_t first_from(const GridStops *s, GridStop from)
{
    size_t lo = 0, hi = s->n;
    while (lo < hi) {
        size_t middle = lo + (hi - lo) / 2;
        if (by_place(&s->stops[middle], &from) < 0) lo = middle + 1;
        else hi = middle;
    }
    return lo;
}

const GridStop *cells_stops(const GridStops *s, int64_t line, int64_t from, int64_t to, int *n)
{
    size_t first = first_from(s, (GridStop){ line, from });
    *n = (int)(first_from(s, (GridStop){ line, to + 1 }) - first);
    return s->stops + first;
}

/* ---- halving ---- */

static GridPoint turned(GridPoint p) { return (GridPoint){ p.y, p.x }; }

/* The part of a segment on one side of a line; false: nothing but a point, or on the line. */
static bool cut_segment(const GridSegment *s, bool along_u, int64_t line, bool above, GridSegment *out)
{
    GridPoint a = along_u ? s->a : turned(s->a), b = along_u ? s->b : turned(s->b);
    bool a_is_in = above ? a.x >= line : a.x <= line, b_is_in = above ? b.x >= line : b.x <= line;
    if (!a_is_in && !b_is_in) return false;
    if (!a_is_in || !b_is_in) {
        GridPoint at = { line, grid_cross(a, b, line) };
        if (a_is_in) b = at;
        else a = at;
    }
    if (a.x == line && b.x == line) return false;
    *out = (GridSegment){ along_u ? a : turned(a), along_u ? b : turned(b) };
    return true;
}

static void cut_segments(Division *d, Cell *c, bool along_u, int64_t line, bool above)
{
    GridSegment *mine = ARENA_ARRAY(d->arena, GridSegment, c->n_segments);
    int n = 0;
    for (int i = 0; i < c->n_segments; i++) n += cut_segment(&c->segments[i], along_u, line, above, &mine[n]);
    c->segments = mine, c->n_segments = n;
}

/* The halves of a net of k_u * k_v points: `p` becomes the second. */
static void halve_net(const Surface *s, bool along_u, Vec4 *p, Vec4 *first)
{
    if (!along_u) bezier_cut(s->k_v, s->k_u, 0.5, p, first);
    else for (int j = 0; j < s->k_v; j++) bezier_cut(s->k_u, 1, 0.5, p + j * s->k_u, first + j * s->k_u);
}

static bool is_kept(const Division *d, const Cell *c)
{
    const Grid *g = d->grid;
    double u = grid_param(&g->u, c->i, (c->low.x + c->high.x) / 2), v = grid_param(&g->v, c->j, (c->low.y + c->high.y) / 2);
    return trim_keeps(d->out.trims, u, v);
}

/* Which way to halve; false: it is good as it is. */
static bool choose(const Division *d, const Cell *c, const Vec4 *net, bool *along_u)
{
    BezierSeconds s = bezier_seconds(d->grid->s->k_u, d->grid->s->k_v, net);
    double error = (s.ss + 2 * s.st + s.tt) / 8, allowed = d->chord_error * (c->n_segments > 0 ? SHARE_NEAR_TRIMS : 1);
    int64_t wide = c->high.x - c->low.x, high = c->high.y - c->low.y;
    bool is_good = error <= allowed;
    if (is_good && c->n_segments <= MOST_SEGMENTS) return false;
    *along_u = is_good || s.ss == s.tt ? wide >= high : s.ss > s.tt;
    if ((*along_u ? wide : high) < 2) *along_u = !*along_u;
    return (*along_u ? wide : high) >= 2;
}

static void add_cell(Division *d, const Cell *c)
{
    GridPoint corners[4] = { c->low, { c->high.x, c->low.y }, c->high, { c->low.x, c->high.y } };
    for (int i = 0; i < 4; i++) add_stops(d, c, corners[i]);
    for (int i = 0; i < c->n_segments; i++) {
        add_stops(d, c, c->segments[i].a);
        add_stops(d, c, c->segments[i].b);
    }
    ARENA_PUSH(d->arena, d->cells, d->n_cells, d->capacity) = *c;
}

/* is_mixed: trims were near so far. Destroys the net. */
static void divide(Division *d, Cell c, Vec4 *net, bool is_mixed)
{
    bool along_u;
    if (is_mixed && c.n_segments == 0) {
        if (!is_kept(d, &c)) return;
        is_mixed = false;
    }
    if (!choose(d, &c, net, &along_u)) {
        add_cell(d, &c);
        return;
    }
    ArenaMark mark = arena_mark(d->scratch);
    Vec4 *first = ARENA_ARRAY(d->scratch, Vec4, d->grid->s->k_u * d->grid->s->k_v);
    halve_net(d->grid->s, along_u, net, first);
    int64_t line = along_u ? (c.low.x + c.high.x) / 2 : (c.low.y + c.high.y) / 2;
    for (int above = 0; above < 2; above++) {
        Cell half = c;
        *(along_u ? above ? &half.low.x : &half.high.x : above ? &half.low.y : &half.high.y) = line;
        cut_segments(d, &half, along_u, line, above);
        divide(d, half, above ? net : first, is_mixed);
    }
    arena_reset(d->scratch, mark);
}

/* ---- borders ---- */

/* Points closer than this, relative to the surface's size, are one, as far as who wrote them could tell: a thousand times the
 * rounding of points of that size, far below any chord error. Their own rounding here comes on top: that of an evaluated
 * point has 6 (k-1) for each direction (surface.c), closing 18 (k-1) (bezier.h). */
#define ONE_POINT 1e-12
#define CLOSED_ROUNDING 3

static bool are_one(const Surface *s, Vec4 p, Vec4 q)
{
    return vec_length(vec_sub(vec4_project(p), vec4_project(q))) <= ONE_POINT * s->size + 2 * CLOSED_ROUNDING * s->rounding
        && fabs(p.w - q.w) <= ONE_POINT * (p.w + q.w);
}

/* Control point k of the patch's border: u = 0, u = 1, v = 0, v = 1. */
static Vec4 border_point(const Patch *p, int border, int k)
{
    int at = border == 0 ? k * p->k_u : border == 1 ? k * p->k_u + p->k_u - 1 : border == 2 ? k : (p->k_v - 1) * p->k_u + k;
    Vec4 q = p->p[at];
    return vec4(q.x + q.w * p->origin.x, q.y + q.w * p->origin.y, q.z + q.w * p->origin.z, q.w);
}

static const Patch *border_patch(const Division *d, int border, int k)
{
    int n_u = d->grid->u.n, n_v = d->grid->v.n;
    int i = border == 0 ? 0 : border == 1 ? n_u - 1 : k, j = border == 2 ? 0 : border == 3 ? n_v - 1 : k;
    return &d->out.patches[j * n_u + i];
}

/* Do two borders run through the same points, curve for curve? Or is one border the same point all along? */
static bool borders_are_one(const Division *d, int border, int other, bool is_point)
{
    const Surface *s = d->grid->s;
    int n = border < 2 ? d->grid->v.n : d->grid->u.n, order = border < 2 ? s->k_v : s->k_u;
    Vec4 start = border_point(border_patch(d, border, 0), border, 0);
    for (int k = 0; k < n; k++)
        for (int i = 0; i < order; i++) {
            Vec4 p = border_point(border_patch(d, border, k), border, i);
            Vec4 q = is_point ? start : border_point(border_patch(d, other, k), other, i);
            if (is_point) q = vec4_scale(q, p.w / q.w);
            if (!are_one(s, p, q)) return false;
        }
    return true;
}

static void find_borders(Division *d)
{
    d->out.is_closed_u = borders_are_one(d, 0, 1, false);
    d->out.is_closed_v = borders_are_one(d, 2, 3, false);
    for (int i = 0; i < 4; i++) d->out.is_point[i] = borders_are_one(d, i, i, true);
}

/* ---- all of it ---- */

static void make_patches(Division *d)
{
    const Grid *g = d->grid;
    Patch *patches = ARENA_ARRAY(d->arena, Patch, g->u.n * g->v.n);
    ArenaMark mark = arena_mark(d->scratch);
    Vec4 *net = ARENA_ARRAY(d->scratch, Vec4, g->s->k_u * g->s->k_v);
    for (int j = 0; j < g->v.n; j++)
        for (int i = 0; i < g->u.n; i++) {
            int mu_u = g->u.mu[i], mu_v = g->v.mu[j];
            prepare_close_span(g->s, mu_u, mu_v, net);
            TrimRect span = { g->s->tau_u[mu_u], g->s->tau_u[mu_u + 1], g->s->tau_v[mu_v], g->s->tau_v[mu_v + 1] };
            patch_make(d->arena, g->s->k_u, g->s->k_v, (WideNet){ net, NULL }, g->s->rounding, span,
                       &patches[j * g->u.n + i]);
        }
    arena_reset(d->scratch, mark);
    d->out.patches = patches;
}

/* The second derivatives of a patch are the same about its own origin, and better conditioned there. */
static void divide_span(Division *d, int i, int j, const GridTrims *trims)
{
    int c = j * d->grid->u.n + i, n = d->grid->s->k_u * d->grid->s->k_v;
    Cell cell = { .i = i, .j = j, .low = { 0, 0 }, .high = { GRID_SPAN, GRID_SPAN } };
    if (trims) {
        cell.segments = trims->segments + trims->first[c];
        cell.n_segments = (int)(trims->first[c + 1] - trims->first[c]);
    }
    ArenaMark mark = arena_mark(d->scratch);
    divide(d, cell, arena_copy(d->scratch, d->out.patches[c].p, (size_t)n, sizeof(Vec4)), trims != NULL);
    arena_reset(d->scratch, mark);
}

Cells cells_make(Arena *a, Arena *scratch, const Grid *grid, double chord_error)
{
    Division d = { .arena = a, .scratch = scratch, .grid = grid, .chord_error = chord_error };
    GridTrims trims;
    if (grid->s->trims) {
        trims = grid_trims(a, scratch, grid, SHARE_OF_TRIMS * chord_error);
        d.out.trims = trims.tree;
    }
    make_patches(&d);
    find_borders(&d);
    for (int j = 0; j < grid->v.n; j++)
        for (int i = 0; i < grid->u.n; i++) divide_span(&d, i, j, grid->s->trims ? &trims : NULL);
    sort_stops(&d.out.across_u);
    sort_stops(&d.out.across_v);
    d.out.cells = d.cells, d.out.n_cells = d.n_cells;
    return d.out;
}
