/* cells.h makes the cells, and knows where their neighbours have vertices on their borders; here each becomes triangles
 * between all of these and the trims within it. What trims part is kept or dropped as a whole. */
#include "nurbs/tessellate.h"

#include "nurbs/cells.h"
#include "nurbs/refine.h"

/* Vertices that exist: by their place on the grid and the smooth stretches that they belong to. */
typedef struct { int64_t x, y; int stretch_u, stretch_v; uint32_t vertex; bool is_there; } Slot;

typedef struct {
    const Surface *s;
    const Grid *grid;
    const Cells *cells;
    MeshSink *out;
    Arena *arena, *scratch;
    Slot *slots;                     /* open addressing */
    size_t n_slots, n_used;          /* n_slots: a power of 2 */
} Tessellation;

/* ---- vertices ---- */

static size_t slot_of(const Tessellation *t, const Slot *key)
{
    uint64_t h = (uint64_t)key->x * 0x9E3779B97F4A7C15u ^ (uint64_t)key->y * 0xC2B2AE3D27D4EB4Fu;
    h = (h ^ h >> 29) * 0xBF58476D1CE4E5B9u + (uint64_t)(key->stretch_u * 31 + key->stretch_v);
    size_t i = (h ^ h >> 32) & (t->n_slots - 1);
    for (; t->slots[i].is_there; i = (i + 1) & (t->n_slots - 1)) {
        const Slot *s = &t->slots[i];
        if (s->x == key->x && s->y == key->y && s->stretch_u == key->stretch_u && s->stretch_v == key->stretch_v) break;
    }
    return i;
}

static void grow_slots(Tessellation *t)
{
    Slot *old = t->slots;
    size_t n = t->n_slots;
    t->n_slots = n > 0 ? 2 * n : 1024;
    t->slots = arena_zalloc(t->arena, t->n_slots, sizeof *t->slots);
    for (size_t i = 0; i < n; i++)
        if (old[i].is_there) t->slots[slot_of(t, &old[i])] = old[i];
}

/* A place on one axis as its point is computed: on a knot line from the span above it, so that both sides get the same bits,
 * except where the surface tears. */
typedef struct { int span; int64_t local; } Place;

static Place place_on(const GridAxis *axis, int span, int64_t x)
{
    int64_t above = x / GRID_SPAN;
    if (above >= axis->n) above = axis->n - 1;
    if (above > span && axis->has_gap[above]) above = span;
    return (Place){ (int)above, x - above * GRID_SPAN };
}

/* Closed directions end where they begin, and all of a pole is one point, bit for bit. */
static Vec3 point_at(const Tessellation *t, const Cell *c, int64_t x, int64_t y)
{
    const Grid *g = t->grid;
    const Cells *k = t->cells;
    int64_t end_x = g->u.n * GRID_SPAN, end_y = g->v.n * GRID_SPAN;
    bool first_u = x == 0, last_u = x == end_x, first_v = y == 0, last_v = y == end_y;
    if (last_u && k->is_closed_u) x = 0;
    if (last_v && k->is_closed_v) y = 0;
    if ((first_u && k->is_point[0]) || (last_u && k->is_point[1])) y = 0;
    if ((first_v && k->is_point[2]) || (last_v && k->is_point[3])) x = 0;
    Place u = place_on(&g->u, x == 0 ? 0 : c->i, x), v = place_on(&g->v, y == 0 ? 0 : c->j, y);
    SurfacePoint p;
    refine_evaluate(t->s, g->u.mu[u.span], grid_param(&g->u, u.span, u.local), g->v.mu[v.span],
                    grid_param(&g->v, v.span, v.local), &p);
    return p.point;
}

static uint32_t make_vertex(Tessellation *t, const Cell *c, GridPoint p)
{
    const Surface *s = t->s;
    const Patch *patch = &t->cells->patches[c->j * t->grid->u.n + c->i];
    double u = grid_param(&t->grid->u, c->i, p.x), v = grid_param(&t->grid->v, c->j, p.y);
    return mesh_sink_vertex(t->out, (MeshVertex){
        .point = point_at(t, c, c->i * GRID_SPAN + p.x, c->j * GRID_SPAN + p.y),
        .normal = patch_normal(patch, (double)p.x / (double)GRID_SPAN, (double)p.y / (double)GRID_SPAN, vec(0, 0, 1)),
        .uv = vec2((u - s->u0) / (s->u1 - s->u0), (v - s->v0) / (s->v1 - s->v0)),
    });
}

static uint32_t vertex_at(Tessellation *t, const Cell *c, GridPoint p)
{
    if (2 * t->n_used >= t->n_slots) grow_slots(t);
    Slot key = { .x = c->i * GRID_SPAN + p.x, .y = c->j * GRID_SPAN + p.y, .stretch_u = t->grid->u.stretch[c->i],
                 .stretch_v = t->grid->v.stretch[c->j], .is_there = true };
    size_t i = slot_of(t, &key);
    if (!t->slots[i].is_there) {
        key.vertex = make_vertex(t, c, p);
        t->slots[i] = key;
        t->n_used++;
    }
    return t->slots[i].vertex;
}

/* ---- a cell ---- */

static void add_border(const Tessellation *t, const Cell *c, Triangulation *d)
{
    const Cells *k = t->cells;
    int64_t from_x = c->i * GRID_SPAN, from_y = c->j * GRID_SPAN;
    int n;
    for (int side = 0; side < 2; side++) {
        GridPoint at = side ? c->high : c->low;
        int64_t x = from_x + at.x, y = from_y + at.y;
        if (k->is_closed_u && x == t->grid->u.n * GRID_SPAN) x = 0;
        if (k->is_closed_v && y == t->grid->v.n * GRID_SPAN) y = 0;
        const GridStop *s = cells_stops(&k->across_u, x, from_y + c->low.y, from_y + c->high.y, &n);
        for (int i = 0; i < n; i++) triangulation_add(d, (GridPoint){ at.x, s[i].at - from_y });
        s = cells_stops(&k->across_v, y, from_x + c->low.x, from_x + c->high.x, &n);
        for (int i = 0; i < n; i++) triangulation_add(d, (GridPoint){ s[i].at - from_x, at.y });
    }
}

static void add_trims(const Cell *c, Triangulation *d)
{
    for (int i = 0; i < c->n_segments; i++) {
        triangulation_add(d, c->segments[i].a);
        triangulation_add(d, c->segments[i].b);
    }
    for (int i = 0; i < c->n_segments; i++)
        triangulation_join(d, triangulation_add(d, c->segments[i].a), triangulation_add(d, c->segments[i].b));
}

/* Whether the middle of its largest triangle is kept. */
static bool part_is_kept(const Tessellation *t, const Cell *c, const Triangulation *d, int part)
{
    int64_t most = -1;
    GridPoint sum = { 0, 0 };
    for (size_t f = 0; f < d->n_triangles; f++) {
        const GridTriangle *g = &d->triangles[f];
        GridPoint p = d->points[g->v[0]], q = d->points[g->v[1]], r = d->points[g->v[2]];
        if (g->part != part || grid_area(p, q, r) <= most) continue;
        most = grid_area(p, q, r);
        sum = (GridPoint){ p.x + q.x + r.x, p.y + q.y + r.y };
    }
    return trim_keeps(t->cells->trims, grid_param(&t->grid->u, c->i, sum.x / 3), grid_param(&t->grid->v, c->j, sum.y / 3));
}

static void emit(Tessellation *t, const Cell *c, const Triangulation *d, const bool *keeps)
{
    for (size_t f = 0; f < d->n_triangles; f++) {
        const GridTriangle *g = &d->triangles[f];
        if (keeps && !keeps[g->part]) continue;
        uint32_t v[3];
        for (int i = 0; i < 3; i++) v[i] = vertex_at(t, c, d->points[g->v[i]]);
        mesh_sink_triangle(t->out, v[0], v[1], v[2]);
    }
}

static void tessellate_cell(Tessellation *t, const Cell *c)
{
    ArenaMark mark = arena_mark(t->scratch);
    Triangulation d = triangulation_of(t->scratch, c->low, c->high);
    bool *keeps = NULL;
    add_border(t, c, &d);
    if (c->n_segments > 0) {
        add_trims(c, &d);
        int n = triangulation_parts(&d);
        keeps = ARENA_ARRAY(t->scratch, bool, n);
        for (int i = 0; i < n; i++) keeps[i] = part_is_kept(t, c, &d, i);
    }
    emit(t, c, &d, keeps);
    arena_reset(t->scratch, mark);
}

void tessellate_surface(const Surface *s, double chord_error, MeshSink *out)
{
    Arena *own = arena_new(), *scratch = arena_new();
    Grid grid = grid_make(own, s);
    Cells cells = cells_make(own, scratch, &grid, chord_error);
    Tessellation t = { .s = s, .grid = &grid, .cells = &cells, .out = out, .arena = own, .scratch = scratch };
    for (size_t i = 0; i < cells.n_cells; i++) tessellate_cell(&t, &cells.cells[i]);
    arena_free(scratch);
    arena_free(own);
}
