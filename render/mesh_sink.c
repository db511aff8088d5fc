#include "render/mesh_sink.h"

uint32_t mesh_sink_vertex(MeshSink *m, MeshVertex v)
{
    ARENA_PUSH(m->arena, m->vertices, m->n_vertices, m->vertices_capacity) = v;
    return (uint32_t)(m->n_vertices - 1);
}

static bool are_one(const MeshSink *m, uint32_t a, uint32_t b)
{
    Vec3 p = m->vertices[a].point, q = m->vertices[b].point;
    return p.x == q.x && p.y == q.y && p.z == q.z;
}

void mesh_sink_triangle(MeshSink *m, uint32_t a, uint32_t b, uint32_t c)
{
    if (are_one(m, a, b) || are_one(m, b, c) || are_one(m, c, a)) return;
    ARENA_PUSH(m->arena, m->triangles, m->n_triangles, m->triangles_capacity) = (MeshTriangle){ { a, b, c } };
}

void mesh_sink_grid(MeshSink *m, int n_u, int n_v, MeshAt at, const void *context)
{
    uint32_t first = (uint32_t)m->n_vertices, row = (uint32_t)n_u + 1;
    for (int j = 0; j <= n_v; j++)
        for (int i = 0; i <= n_u; i++) mesh_sink_vertex(m, at(context, (double)i / n_u, (double)j / n_v));
    for (uint32_t j = 0; j < (uint32_t)n_v; j++)
        for (uint32_t i = 0; i < (uint32_t)n_u; i++) {
            uint32_t a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
            mesh_sink_triangle(m, a, b, c);
            mesh_sink_triangle(m, a, c, d);
        }
}

/* The sagitta of a chord is r (1 - cos(step / 2)) = 2 r sin^2(step / 4). */
int mesh_arc_steps(double radius, double angle, double error)
{
    static const int MOST = 1 << 14;   /* finer than any picture shows */
    double step = 4 * asin(fmin(1, sqrt(error / (2 * radius))));
    double n = ceil(angle / step);
    return n >= 1 && n < MOST ? (int)n : n >= MOST ? MOST : 1;
}
