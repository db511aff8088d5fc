/* Points are added by splitting the triangle or the edge that they lie in or on. A segment becomes an edge by turning the
 * edges that it crosses, each in its quadrilateral, until none is left ([Slo93]). Triangles are few (a cell's), so that
 * what is asked seldom is found by looking at all of them. */
#include "nurbs/triangulate.h"

#include <math.h>

static int after(int i) { return i == 2 ? 0 : i + 1; }

static int64_t area_of(const Triangulation *t, int a, int b, int c)
{
    return grid_area(t->points[a], t->points[b], t->points[c]);
}

/* All numbers stay below 2^62. */
int64_t grid_cross(GridPoint p, GridPoint q, int64_t at)
{
    int64_t run = q.x - p.x, sum = (q.y - p.y) * (at - p.x);
    if (run < 0) run = -run, sum = -sum;
    sum += run / 2;                                              /* rounds half up */
    return p.y + (sum >= 0 ? sum / run : -((-sum + run - 1) / run));
}

/* ---- triangles ---- */

static int add_triangle(Triangulation *t, GridTriangle g)
{
    ARENA_PUSH(t->arena, t->triangles, t->n_triangles, t->triangles_capacity) = g;
    return (int)t->n_triangles - 1;
}

static int add_point(Triangulation *t, GridPoint p)
{
    ARENA_PUSH(t->arena, t->points, t->n_points, t->points_capacity) = p;
    return (int)t->n_points - 1;
}

/* Which of f's edges has g beside it? */
static int edge_towards(const GridTriangle *f, int g)
{
    return f->beside[0] == g ? 0 : f->beside[1] == g ? 1 : 2;
}

static int corner_at(const GridTriangle *f, int point)
{
    return f->v[0] == point ? 0 : f->v[1] == point ? 1 : f->v[2] == point ? 2 : -1;
}

/* What had `old` beside it now has `new`. */
static void relink(Triangulation *t, int triangle, int old, int new)
{
    if (triangle >= 0) t->triangles[triangle].beside[edge_towards(&t->triangles[triangle], old)] = new;
}

Triangulation triangulation_of(Arena *a, GridPoint low, GridPoint high)
{
    Triangulation t = { .arena = a };
    add_point(&t, low), add_point(&t, (GridPoint){ high.x, low.y });
    add_point(&t, high), add_point(&t, (GridPoint){ low.x, high.y });
    add_triangle(&t, (GridTriangle){ .v = { 0, 1, 2 }, .beside = { -1, 1, -1 } });
    add_triangle(&t, (GridTriangle){ .v = { 0, 2, 3 }, .beside = { -1, -1, 0 } });
    return t;
}

/* ---- adding a point ---- */

/* A triangle that contains p: walks towards it; where the walk goes round in circles, looks at all. */
static int locate(const Triangulation *t, GridPoint p)
{
    int at = t->last, n = (int)t->n_triangles;
    for (int step = 0; step < n; step++) {
        const GridTriangle *g = &t->triangles[at];
        int i = 0;
        while (i < 3 && grid_area(t->points[g->v[after(i)]], t->points[g->v[after(after(i))]], p) >= 0) i++;
        if (i == 3) return at;
        if (g->beside[i] < 0) break;
        at = g->beside[i];
    }
    for (at = 0; at < n; at++) {
        const int *v = t->triangles[at].v;
        int i = 0;
        while (i < 3 && grid_area(t->points[v[i]], t->points[v[after(i)]], p) >= 0) i++;
        if (i == 3) break;
    }
    return at < n ? at : 0;
}

/* Three triangles in place of f. */
static void split_inside(Triangulation *t, int f, int p)
{
    GridTriangle g = t->triangles[f];
    int one = (int)t->n_triangles, two = one + 1;
    t->triangles[f] = (GridTriangle){ { p, g.v[1], g.v[2] }, { g.beside[0], one, two }, { g.is_wall[0], false, false }, 0 };
    add_triangle(t, (GridTriangle){ { g.v[0], p, g.v[2] }, { f, g.beside[1], two }, { false, g.is_wall[1], false }, 0 });
    add_triangle(t, (GridTriangle){ { g.v[0], g.v[1], p }, { f, one, g.beside[2] }, { false, false, g.is_wall[2] }, 0 });
    relink(t, g.beside[1], f, one);
    relink(t, g.beside[2], f, two);
}

/* Cuts f from corner i to p on the edge opposite to it: f keeps the part with the corner after i. Returns the other part;
 * what lies beyond the two halves of the edge is left to the caller. */
static int split_side(Triangulation *t, int f, int i, int p)
{
    GridTriangle g = t->triangles[f];
    int j = after(i), k = after(j), other = (int)t->n_triangles;
    GridTriangle far = { { 0, 0, 0 }, { 0, 0, 0 }, { false, false, false }, 0 };
    far.v[i] = g.v[i], far.v[j] = p, far.v[k] = g.v[k];
    far.beside[i] = -1, far.beside[j] = g.beside[j], far.beside[k] = f;
    far.is_wall[i] = g.is_wall[i], far.is_wall[j] = g.is_wall[j];
    add_triangle(t, far);
    relink(t, g.beside[j], f, other);
    t->triangles[f].v[k] = p;
    t->triangles[f].beside[j] = other;
    t->triangles[f].is_wall[j] = false;
    return other;
}

/* Both triangles at the edge opposite to corner i of f are cut in two. */
static void split_edge(Triangulation *t, int f, int i, int p)
{
    int g = t->triangles[f].beside[i];
    int j = g < 0 ? -1 : edge_towards(&t->triangles[g], f);
    int f_other = split_side(t, f, i, p);
    if (g < 0) return;
    int g_other = split_side(t, g, j, p);        /* g keeps the half that f_other has: its corners run the other way */
    t->triangles[f].beside[i] = g_other, t->triangles[g_other].beside[j] = f;
    t->triangles[f_other].beside[i] = g, t->triangles[g].beside[j] = f_other;
}

int triangulation_add(Triangulation *t, GridPoint p)
{
    int f = t->last = locate(t, p), on[3], n_on = 0;
    const int *v = t->triangles[f].v;
    for (int i = 0; i < 3; i++) {
        GridPoint q = t->points[v[i]];
        if (q.x == p.x && q.y == p.y) return v[i];
        if (grid_area(t->points[v[after(i)]], t->points[v[after(after(i))]], p) == 0) on[n_on++] = i;
    }
    int new = add_point(t, p);
    if (n_on > 0) split_edge(t, f, on[0], new);
    else split_inside(t, f, new);
    return new;
}

/* ---- making an edge ---- */

typedef struct { int p, q; } Edge;
typedef struct { Edge *edges; size_t n, capacity; } EdgeList;

/* The triangle with the edge from p to q in its own direction, and the corner opposite to it; -1: none. */
static int find_edge(const Triangulation *t, int p, int q, int *corner)
{
    for (int f = 0; f < (int)t->n_triangles; f++) {
        int i = corner_at(&t->triangles[f], p);
        if (i < 0 || t->triangles[f].v[after(i)] != q) continue;
        *corner = after(after(i));
        return f;
    }
    return -1;
}

static void set_wall(Triangulation *t, int p, int q, bool is_wall)
{
    int i;
    for (int side = 0; side < 2; side++) {
        int f = side ? find_edge(t, q, p, &i) : find_edge(t, p, q, &i);
        if (f >= 0) t->triangles[f].is_wall[i] = is_wall;
    }
}

/* What leaving a towards b meets first. */
typedef enum { MEETS_VERTEX, MEETS_EDGE, MEETS_NOTHING } Meeting;

static Meeting first_meeting(const Triangulation *t, int a, int b, Edge *edge, int *vertex, int *triangle)
{
    GridPoint o = t->points[a], d = t->points[b];
    for (int f = 0; f < (int)t->n_triangles; f++) {
        const GridTriangle *g = &t->triangles[f];
        int i = corner_at(g, a);
        if (i < 0) continue;
        int p = g->v[after(i)], q = g->v[after(after(i))];
        int64_t right = area_of(t, a, b, p), left = area_of(t, a, b, q);
        GridPoint on = t->points[right == 0 ? p : q];
        bool is_ahead = (on.x > o.x) == (d.x > o.x) && (on.y > o.y) == (d.y > o.y);   /* of points on the line */
        if ((right == 0 || left == 0) && is_ahead) return *vertex = right == 0 ? p : q, MEETS_VERTEX;
        if (right < 0 && left > 0) return *edge = (Edge){ p, q }, *triangle = f, MEETS_EDGE;
    }
    return MEETS_NOTHING;
}

static bool is_wall_between(const Triangulation *t, int f, Edge e)
{
    const GridTriangle *g = &t->triangles[f];
    for (int i = 0; i < 3; i++)
        if (g->v[i] != e.p && g->v[i] != e.q) return g->is_wall[i];
    return false;
}

static int across(const Triangulation *t, int f, Edge e)
{
    const GridTriangle *g = &t->triangles[f];
    for (int i = 0; i < 3; i++)
        if (g->v[i] != e.p && g->v[i] != e.q) return g->beside[i];
    return -1;
}

static int third_corner(const GridTriangle *g, Edge e)
{
    for (int i = 0; i < 2; i++)
        if (g->v[i] != e.p && g->v[i] != e.q) return g->v[i];
    return g->v[2];
}

/* Lists the edges that a segment crosses, from edge `e` of triangle f on. Ends at b (returns b), at another vertex on the
 * way (returns that), or at a wall, which is last in the list then (returns -1). */
static int list_crossed(const Triangulation *t, int a, int b, int f, Edge e, EdgeList *list)
{
    for (;;) {
        ARENA_PUSH(t->arena, list->edges, list->n, list->capacity) = e;
        if (is_wall_between(t, f, e)) return -1;
        f = across(t, f, e);
        int r = third_corner(&t->triangles[f], e);
        if (r == b) return b;
        int64_t side = area_of(t, a, b, r);
        if (side == 0) return r;
        if (side > 0) e.q = r;
        else e.p = r;
    }
}

/* Turns the edge p q into the other diagonal of its quadrilateral, if that is strictly convex. */
static bool turn(Triangulation *t, Edge e, Edge *turned)
{
    int i = 0, j = 0, f = find_edge(t, e.p, e.q, &i), g = find_edge(t, e.q, e.p, &j);
    GridTriangle old_f = t->triangles[f], old_g = t->triangles[g];
    int r = old_f.v[i], s = old_g.v[j];                       /* r p q and s q p, counterclockwise */
    if (area_of(t, r, e.p, s) <= 0 || area_of(t, s, e.q, r) <= 0) return false;
    int f_qr = after(i), f_rp = after(f_qr), g_ps = after(j), g_sq = after(g_ps);   /* the corners opposite to these sides */
    t->triangles[f] = (GridTriangle){ { r, e.p, s }, { old_g.beside[g_ps], g, old_f.beside[f_rp] },
                                      { old_g.is_wall[g_ps], false, old_f.is_wall[f_rp] }, 0 };
    t->triangles[g] = (GridTriangle){ { s, e.q, r }, { old_f.beside[f_qr], f, old_g.beside[g_sq] },
                                      { old_f.is_wall[f_qr], false, old_g.is_wall[g_sq] }, 0 };
    relink(t, old_g.beside[g_ps], g, f);
    relink(t, old_f.beside[f_qr], f, g);
    *turned = (Edge){ r, s };
    return true;
}

static bool is_crossed(const Triangulation *t, int a, int b, Edge e)
{
    if (e.p == a || e.p == b || e.q == a || e.q == b) return false;
    return (area_of(t, a, b, e.p) > 0) != (area_of(t, a, b, e.q) > 0);
}

static void turn_all(Triangulation *t, int a, int b, EdgeList *list)
{
    for (size_t i = 0; i < list->n; i++) {
        Edge turned, e = list->edges[i];
        if (!turn(t, e, &turned)) turned = e;
        else if (!is_crossed(t, a, b, turned)) continue;
        ARENA_PUSH(t->arena, list->edges, list->n, list->capacity) = turned;
    }
}

/* Where the segment a b meets the wall e, on the grid: within the boxes of both. */
static GridPoint crossing_point(const Triangulation *t, int a, int b, Edge e)
{
    double right = -(double)area_of(t, a, b, e.p), left = (double)area_of(t, a, b, e.q), s = right / (right + left);
    GridPoint p = t->points[e.p], q = t->points[e.q], c = t->points[a], d = t->points[b];
    double x = (double)p.x + s * (double)(q.x - p.x), y = (double)p.y + s * (double)(q.y - p.y);
    double x0 = fmax(fmin(p.x, q.x), fmin(c.x, d.x)), x1 = fmin(fmax(p.x, q.x), fmax(c.x, d.x));
    double y0 = fmax(fmin(p.y, q.y), fmin(c.y, d.y)), y1 = fmin(fmax(p.y, q.y), fmax(c.y, d.y));
    return (GridPoint){ (int64_t)rint(fmin(fmax(x, x0), x1)), (int64_t)rint(fmin(fmax(y, y0), y1)) };
}

/* Rounding a crossing moves four segments by up to half a grid step each, so that they may cross others; that dies out. The
 * limit is for what we have not thought of: a segment is then left out, which is an error of the size of the grid. */
enum { MAX_DEPTH = 60 };

static void join(Triangulation *t, int a, int b, int depth);

static void cross_wall(Triangulation *t, int a, int b, Edge wall, int depth)
{
    set_wall(t, wall.p, wall.q, false);
    int x = triangulation_add(t, crossing_point(t, a, b, wall));
    join(t, wall.p, x, depth), join(t, x, wall.q, depth);
    join(t, a, x, depth), join(t, x, b, depth);
}

static void join(Triangulation *t, int a, int b, int depth)
{
    Edge e;
    int vertex, f;
    if (a == b || depth > MAX_DEPTH) return;
    switch (first_meeting(t, a, b, &e, &vertex, &f)) {
    case MEETS_NOTHING: return;
    case MEETS_VERTEX:
        set_wall(t, a, vertex, true);
        join(t, vertex, b, depth);
        return;
    case MEETS_EDGE: break;
    }
    EdgeList list = { 0 };
    int end = list_crossed(t, a, b, f, e, &list);
    if (end < 0) {
        cross_wall(t, a, b, list.edges[list.n - 1], depth + 1);
    } else {
        turn_all(t, a, end, &list);
        set_wall(t, a, end, true);
        join(t, end, b, depth);
    }
}

void triangulation_join(Triangulation *t, int a, int b) { join(t, a, b, 0); }

/* ---- parts ---- */

static void fill_part(Triangulation *t, int f, int part, int *stack)
{
    int n = 0;
    stack[n++] = f;
    t->triangles[f].part = part;
    while (n > 0) {
        const GridTriangle *g = &t->triangles[stack[--n]];
        for (int i = 0; i < 3; i++) {
            int next = g->beside[i];
            if (next < 0 || g->is_wall[i] || t->triangles[next].part >= 0) continue;
            t->triangles[next].part = part;
            stack[n++] = next;
        }
    }
}

int triangulation_parts(Triangulation *t)
{
    int n = (int)t->n_triangles, n_parts = 0, *stack = ARENA_ARRAY(t->arena, int, n);
    for (int f = 0; f < n; f++) t->triangles[f].part = -1;
    for (int f = 0; f < n; f++)
        if (t->triangles[f].part < 0) fill_part(t, f, n_parts++, stack);
    return n_parts;
}
