#include "tests/bench/mesh.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "nurbs/prepare.h"
#include "render/mesh_sink.h"

static void append(Mesh *m, const MeshSink *sink)
{
    for (size_t i = 0; i < sink->n_vertices; i++) {
        float *v = m->vertices + 3 * (m->n_vertices + i);
        Vec3 p = sink->vertices[i].point;
        v[0] = (float)p.x, v[1] = (float)p.y, v[2] = (float)p.z;
    }
    for (size_t i = 0; i < sink->n_triangles; i++)
        for (int k = 0; k < 3; k++)
            m->triangles[3 * (m->n_triangles + i) + (size_t)k] = (uint32_t)m->n_vertices + sink->triangles[i].v[k];
    m->n_vertices += sink->n_vertices, m->n_triangles += sink->n_triangles;
}

Mesh mesh_make(Arena *a, const Model *model, double chord_error)
{
    Mesh m = { 0 };
    Arena *lists = arena_new();
    MeshSink *sinks = ARENA_ARRAY(lists, MeshSink, model->n);
    size_t n_vertices = 0, n_triangles = 0;
    double begin = processor_now();
    for (int i = 0; i < model->n; i++) {
        NurbsError error;
        Shape *s = nurbs_shape_new(lists, &model->surfaces[i], &(NurbsOptions){ .method = NURBS_METHOD_CERTAIN }, &error,
                                   NULL, 0, NULL);
        sinks[i] = mesh_sink(lists);
        s->type->tessellate(s, chord_error, &sinks[i]);
        n_vertices += sinks[i].n_vertices, n_triangles += sinks[i].n_triangles;
    }
    m.seconds = processor_now() - begin;
    m.vertices = ARENA_ARRAY(a, float, 3 * n_vertices + 1);   /* Embree reads 16 bytes of each */
    m.triangles = ARENA_ARRAY(a, uint32_t, 3 * n_triangles);
    for (int i = 0; i < model->n; i++) append(&m, &sinks[i]);
    arena_free(lists);
    return m;
}

/* ---- grids ---- */

static size_t count_spans(const Model *m)
{
    size_t n = 0;
    for (int i = 0; i < m->n; i++) {
        const SurfaceDesc *s = &m->surfaces[i];
        size_t n_u = 0, n_v = 0;
        for (int k = s->order_u - 1; k < s->n_u; k++) n_u += knots_is_span(s->knots_u, k);
        for (int k = s->order_v - 1; k < s->n_v; k++) n_v += knots_is_span(s->knots_v, k);
        n += n_u * n_v;
    }
    return n;
}

static void add_grid(GridMesh *g, int k_u, int k_v, const Vec4 *patch)
{
    for (int j = 0; j <= g->steps; j++) {
        Vec4 row[NURBS_MAX_ORDER], column[NURBS_MAX_ORDER];
        for (int c = 0; c < k_u; c++) {
            for (int r = 0; r < k_v; r++) column[r] = patch[r * k_u + c];
            row[c] = bezier_point(k_v, column, (double)j / g->steps);
        }
        for (int i = 0; i <= g->steps; i++) {
            Vec3 p = vec4_project(bezier_point(k_u, row, (double)i / g->steps));
            float *v = g->vertices + 3 * g->n_vertices++;
            v[0] = (float)p.x, v[1] = (float)p.y, v[2] = (float)p.z;
        }
    }
    g->n_grids++;
}

GridMesh mesh_grids(Arena *a, const Model *m, int steps)
{
    GridMesh g = { .steps = steps };
    Arena *scratch = arena_new();
    double begin = processor_now();
    g.vertices = ARENA_ARRAY(a, float, count_spans(m) * (size_t)(steps + 1) * (size_t)(steps + 1) * 3 + 1);
    for (int i = 0; i < m->n; i++) {
        NurbsError error;
        SurfaceDesc bare = m->surfaces[i];
        bare.n_trims = 0;
        const Surface *s = surface_new(scratch, &bare, &error, NULL, 0, NULL);
        Vec4 patch[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
        for (int v = s->k_v - 1; v < s->n_v; v++)
            for (int u = s->k_u - 1; u < s->n_u; u++) {
                if (!knots_is_span(s->tau_u, u) || !knots_is_span(s->tau_v, v)) continue;
                prepare_close_span(s, u, v, patch);
                add_grid(&g, s->k_u, s->k_v, patch);
            }
    }
    g.seconds = processor_now() - begin;
    arena_free(scratch);
    return g;
}
