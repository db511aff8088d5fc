/* What a mesh of a surface must be: its points on the surface, its triangles near it, its edges between two triangles. */
#ifndef TRIMRAY_TESTS_MESH_CHECKS_H
#define TRIMRAY_TESTS_MESH_CHECKS_H

#include "nurbs/surface.h"
#include "render/mesh_sink.h"
#include "tests/test.h"

static inline Vec2 to_domain(const Surface *s, Vec2 p)
{
    return vec2(s->u0 + p.x * (s->u1 - s->u0), s->v0 + p.y * (s->v1 - s->v0));
}

static inline Vec3 reference(const Surface *s, Vec2 unit)
{
    Vec3 p, s_u, s_v;
    Vec2 at = to_domain(s, unit);
    surface_point(s, at.x, at.y, &p, &s_u, &s_v);
    return p;
}

static inline Vec3 blend3(const Vec3 p[3], const double c[3])
{
    return vec_add(vec_add(vec_scale(p[0], c[0]), vec_scale(p[1], c[1])), vec_scale(p[2], c[2]));
}

static inline void check_vertices(const Surface *s, const MeshSink *m, uint64_t seed)
{
    for (size_t i = 0; i < m->n_vertices; i++) {
        const MeshVertex *v = &m->vertices[i];
        double off = vec_length(vec_sub(v->point, reference(s, v->uv)));
        CHECK_WITHIN(off, 1e-9 * s->size, "seed %lu, vertex %zu", (unsigned long)seed, i);
        CHECK_WITHIN(fabs(vec_length(v->normal) - 1), 1e-12, "seed %lu, vertex %zu", (unsigned long)seed, i);
    }
}

/* The point of the surface over a triangle's point is one that the mesh is near to. */
static inline void check_distance(const Surface *s, const MeshSink *m, double e, TestRandom *r, uint64_t seed)
{
    for (size_t f = 0; f < m->n_triangles; f++) {
        Vec3 p[3];
        Vec2 uv = { 0, 0 };
        double a = test_unit(r), b = test_unit(r), c[3] = { a, (1 - a) * b, (1 - a) * (1 - b) };
        for (int i = 0; i < 3; i++) {
            const MeshVertex *v = &m->vertices[m->triangles[f].v[i]];
            p[i] = v->point, uv = vec2_add(uv, vec2_scale(v->uv, c[i]));
        }
        double off = vec_length(vec_sub(blend3(p, c), reference(s, uv)));
        CHECK_WITHIN(off, e, "seed %lu, triangle %zu", (unsigned long)seed, f);
    }
}

/* ---- edges ---- */

typedef struct { Vec3 p, q; Vec2 uv, uv_q; int balance, uses; } MeshEdge;   /* p < q; balance: forwards less backwards */

static inline int compare_points(Vec3 p, Vec3 q)
{
    if (p.x != q.x) return p.x < q.x ? -1 : 1;
    if (p.y != q.y) return p.y < q.y ? -1 : 1;
    return (p.z > q.z) - (p.z < q.z);
}

static inline int compare_edges(const void *a, const void *b)
{
    const MeshEdge *e = a, *f = b;
    int c = compare_points(e->p, f->p);
    return c ? c : compare_points(e->q, f->q);
}

/* All edges, with vertices at one point taken for one. */
static inline MeshEdge *edges_of(Arena *a, const MeshSink *m, size_t *n)
{
    MeshEdge *e = ARENA_ARRAY(a, MeshEdge, 3 * m->n_triangles);
    size_t k = 0, n_edges = 0;
    for (size_t f = 0; f < m->n_triangles; f++)
        for (int i = 0; i < 3; i++) {
            const MeshVertex *p = &m->vertices[m->triangles[f].v[i]], *q = &m->vertices[m->triangles[f].v[(i + 1) % 3]];
            bool is_forward = compare_points(p->point, q->point) < 0;
            if (!is_forward) { const MeshVertex *t = p; p = q, q = t; }
            e[k++] = (MeshEdge){ p->point, q->point, p->uv, q->uv, is_forward ? 1 : -1, 1 };
        }
    if (k > 0) qsort(e, k, sizeof *e, compare_edges);
    for (size_t i = 0; i < k; i++) {
        MeshEdge *last = n_edges > 0 ? &e[n_edges - 1] : NULL;
        if (last && compare_edges(&e[i], last) == 0) last->balance += e[i].balance, last->uses++;
        else e[n_edges++] = e[i];
    }
    *n = n_edges;
    return e;
}

/* Is the point at p, on one border, a pole that the border through q begins or ends at? */
static inline bool is_pole_of(const Surface *s, Vec2 p, Vec2 q)
{
    Vec2 at_u = vec2(q.x, p.y), at_v = vec2(p.x, q.y);
    bool by_u = (q.x == 0 || q.x == 1) && (p.y == 0 || p.y == 1), by_v = (q.y == 0 || q.y == 1) && (p.x == 0 || p.x == 1);
    return (by_u && vec_length(vec_sub(reference(s, at_u), reference(s, p))) <= 1e-12 * s->size)
        || (by_v && vec_length(vec_sub(reference(s, at_v), reference(s, p))) <= 1e-12 * s->size);
}

/* Of the domain; at a pole any of its parameters may stand for the right ones. */
static inline bool is_on_border(const Surface *s, const MeshEdge *e)
{
    Vec2 p = e->uv, q = e->uv_q;
    return (p.x == q.x && (p.x == 0 || p.x == 1)) || (p.y == q.y && (p.y == 0 || p.y == 1)) || is_pole_of(s, p, q)
        || is_pole_of(s, q, p);
}

static inline double distance_to_edge(Vec3 p, Vec3 a, Vec3 b)
{
    Vec3 to = vec_sub(p, a), along = vec_sub(b, a);
    double t = fmin(fmax(vec_dot(to, along) / vec_length2(along), 0), 1);
    return vec_length(vec_sub(to, vec_scale(along, t)));
}

#endif
