#include "render/mesh_sink.h"

uint32_t mesh_sink_vertex(MeshSink *m, MeshVertex v)
{
    ARENA_PUSH(m->arena, m->vertices, m->n_vertices, m->vertices_capacity) = v;
    return (uint32_t)(m->n_vertices - 1);
}

static bool are_one(const MeshSink *m, uint32_t a, uint32_t b)
{
    return vec_is_same(m->vertices[a].point, m->vertices[b].point);
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

MeshCircle mesh_circle(Vec3 centre, Vec3 unit_axis, double radius)
{
    Vec3 a = unit_axis, least = vec(0, 0, 1);
    if (fabs(a.x) <= fabs(a.y) && fabs(a.x) <= fabs(a.z)) least = vec(1, 0, 0);
    else if (fabs(a.y) <= fabs(a.z)) least = vec(0, 1, 0);
    Vec3 x = vec_normalize(vec_cross(least, a));
    return (MeshCircle){ centre, x, vec_cross(a, x), radius };
}

static Vec3 on_circle(const MeshCircle *c, double cosine, double sine)
{
    Vec3 out = vec_add(vec_scale(c->x, cosine), vec_scale(c->y, sine));
    return vec_add(c->centre, vec_scale(out, c->radius));
}

void mesh_sink_strip(MeshSink *m, MeshCircle a, MeshCircle b, int n)
{
    static const double PI = 3.14159265358979323846;
    uint32_t first = (uint32_t)m->n_vertices;
    if (n < 3) n = 3;
    for (int i = 0; i < n; i++) {
        double angle = 2 * PI * i / n, cosine = cos(angle), sine = sin(angle);
        Vec3 p = on_circle(&a, cosine, sine), q = on_circle(&b, cosine, sine);
        Vec3 tangent = vec_sub(vec_scale(a.y, cosine), vec_scale(a.x, sine));
        Vec3 normal = vec_normalize(vec_cross(tangent, vec_sub(q, p)));
        mesh_sink_vertex(m, (MeshVertex){ p, normal, { p.x, p.y } });
        mesh_sink_vertex(m, (MeshVertex){ q, normal, { q.x, q.y } });
    }
    for (uint32_t i = 0; i < (uint32_t)n; i++) {
        uint32_t p = first + 2 * i, next = first + 2 * ((i + 1) % (uint32_t)n);
        mesh_sink_triangle(m, p, next, next + 1);
        mesh_sink_triangle(m, p, next + 1, p + 1);
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
