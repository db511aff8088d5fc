/* A scene whose NURBS surfaces are meshes within a chord error, and which is the same in all else: what a renderer of
 * triangles would trace. */
#include "render/report.h"

#include "render/export_list.h"
#include "render/mesh.h"
#include "render/mesh_sink.h"

static bool is_surface(const Shape *s)
{
    NurbsInfo info;
    return nurbs_shape_info(s, &info);
}

double report_scene_size(Arena *a, const Scene *s)
{
    ExportList list = export_list(a, s, is_surface);
    return box_is_finite(list.meshes) ? box_diagonal(list.meshes) : 0;
}

static MeshVector to_float(Vec3 v) { return (MeshVector){ (float)v.x, (float)v.y, (float)v.z }; }

static Shape *mesh_of(Arena *a, const MeshSink *m)
{
    MeshVector *points = ARENA_ARRAY(a, MeshVector, m->n_vertices), *normals = ARENA_ARRAY(a, MeshVector, m->n_vertices);
    MeshUv *uvs = ARENA_ARRAY(a, MeshUv, m->n_vertices);
    MeshFace *faces = ARENA_ARRAY(a, MeshFace, m->n_triangles);
    for (size_t i = 0; i < m->n_vertices; i++) {
        const MeshVertex *v = &m->vertices[i];
        points[i] = to_float(v->point), normals[i] = to_float(v->normal);
        uvs[i] = (MeshUv){ (float)v->uv.x, (float)v->uv.y };
    }
    for (size_t i = 0; i < m->n_triangles; i++)
        for (int k = 0; k < 3; k++) faces[i].corner[k] = m->triangles[i].v[k];
    MeshDesc desc = { .vertices = points, .normals = normals, .uvs = uvs, .faces = faces, .normal_faces = faces,
                      .uv_faces = faces, .n_vertices = (uint32_t)m->n_vertices, .n_faces = (uint32_t)m->n_triangles };
    return mesh_new(a, &desc);
}

typedef struct {
    Arena *arena;
    const ExportList *list;
    Shape **made;                    /* of each shape in the list; NULL: not yet */
    double chord_error;
    size_t meshes_capacity;
    ReportMesh *out;
} Walk;

static Shape *make_mesh(Walk *w, const Shape *s, double stretch)
{
    Arena *own = arena_new();
    MeshSink m = mesh_sink(own);
    s->type->tessellate(s, w->chord_error / stretch, &m);
    Shape *mesh = mesh_of(w->arena, &m);
    ReportMesh *o = w->out;
    o->n_triangles += m.n_triangles, o->n_vertices += m.n_vertices;
    o->n_bytes += m.n_vertices * (2 * sizeof(MeshVector) + sizeof(MeshUv)) + m.n_triangles * sizeof(MeshFace);
    ARENA_PUSH(w->arena, o->meshes, o->n_meshes, w->meshes_capacity) = mesh;
    arena_free(own);
    return mesh;
}

static Shape *rebuild(Walk *w, Shape *s);

static Shape *rebuild_compound(Walk *w, Shape *s)
{
    Shape *const *parts;
    uint32_t n = s->type->parts(s, &parts);
    Shape **others = ARENA_ARRAY(w->arena, Shape *, n + 1);
    bool is_same = true;
    for (uint32_t i = 0; i < n; i++) others[i] = rebuild(w, parts[i]), is_same &= others[i] == parts[i];
    return is_same ? s : s->type->with_parts(s, w->arena, others, false, NULL);
}

/* What has no surface in it is shared with the scene that it comes from. */
static Shape *rebuild(Walk *w, Shape *s)
{
    if (shape_is_object(s)) {
        Object *o = (Object *)s;
        Shape *child = rebuild(w, o->child);
        if (child == o->child) return s;
        Object *copy = object_copy(w->arena, o);
        copy->child = child;
        return &copy->shape;
    }
    ExportShape *listed = export_find(w->list, s);
    Shape **made = &w->made[listed - w->list->shapes];
    if (!*made) *made = is_surface(s) ? make_mesh(w, s, listed->stretch) : s->type->parts ? rebuild_compound(w, s) : s;
    return *made;
}

Scene *report_mesh_scene(Arena *a, const Scene *s, double chord_error, ReportMesh *out)
{
    ExportList list = export_list(a, s, is_surface);
    *out = (ReportMesh){ 0 };
    Walk w = { .arena = a, .list = &list, .made = arena_zalloc(a, list.n + 1, sizeof(Shape *)), .chord_error = chord_error,
               .out = out };
    Scene *copy = ARENA_NEW(a, Scene);
    *copy = *s;
    copy->objects = ARENA_ARRAY(a, Object *, s->n_objects);
    for (size_t i = 0; i < s->n_objects; i++) copy->objects[i] = (Object *)rebuild(&w, &s->objects[i]->shape);
    copy->tree = NULL;
    scene_prepare(copy);
    return copy;
}

size_t report_mesh_bytes(const ReportMesh *m)
{
    size_t n = m->n_bytes;
    for (size_t i = 0; i < m->n_meshes; i++) n += m->meshes[i]->own ? arena_bytes(m->meshes[i]->own) : 0;
    return n;
}
