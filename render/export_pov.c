#include "render/export_pov.h"

#include "render/export_look.h"
#include "render/mesh_sink.h"

typedef struct {
    Sdl sdl;                 /* first: what shapes are given */
    const Scene *scene;
    ExportList *list;
    double chord_error;
    const char *unsupported;
} Exporter;

bool export_pov_is_mesh(const Shape *s) { return !s->type->write; }

/* ---- meshes ---- */

static void write_points(Sdl *out, const char *word, const MeshSink *m, size_t member)
{
    sdl_text(out, "\n  %s { %zu", word, m->n_vertices);
    for (size_t i = 0; i < m->n_vertices; i++) {
        sdl_text(out, i % 4 ? "," : ",\n   ");
        sdl_vec(out, *(const Vec3 *)((const char *)&m->vertices[i] + member));
    }
    sdl_text(out, " }");
}

static void write_uv(Sdl *out, const MeshSink *m)
{
    sdl_text(out, "\n  uv_vectors { %zu", m->n_vertices);
    for (size_t i = 0; i < m->n_vertices; i++) {
        sdl_text(out, i % 8 ? "," : ",\n   ");
        sdl_vec2(out, m->vertices[i].uv);
    }
    sdl_text(out, " }");
}

/* Normals and uv go by the numbers of the vertices. */
static void write_mesh(Sdl *out, const MeshSink *m)
{
    sdl_text(out, "mesh2 {");
    write_points(out, "vertex_vectors", m, offsetof(MeshVertex, point));
    write_points(out, "normal_vectors", m, offsetof(MeshVertex, normal));
    write_uv(out, m);
    sdl_text(out, "\n  face_indices { %zu", m->n_triangles);
    for (size_t i = 0; i < m->n_triangles; i++) {
        const uint32_t *v = m->triangles[i].v;
        sdl_text(out, "%s <%u, %u, %u>", i % 8 ? "," : ",\n   ", v[0], v[1], v[2]);
    }
    sdl_text(out, " }");
}

/* POV-Ray has neither meshes nor compounds without anything in them. */
static void write_nothing(Sdl *out) { sdl_text(out, "sphere { 0, 1 clipped_by { sphere { 9, 1 } }"); }

static void write_as_mesh(Exporter *e, const Shape *s)
{
    Arena *own = arena_new();
    MeshSink m = mesh_sink(own);
    const ExportShape *listed = export_find(e->list, s);
    double stretch = listed ? listed->stretch : 1;
    if (!s->type->tessellate || !s->type->tessellate(s, e->chord_error / stretch, &m)) e->unsupported = s->type->name;
    if (m.n_triangles > 0) write_mesh(&e->sdl, &m);
    else write_nothing(&e->sdl);
    arena_free(own);
}

/* ---- shapes and objects ---- */

static bool is_empty(const Shape *s)
{
    Shape *const *parts;
    return s->type->parts && s->type->parts(s, &parts) == 0;
}

/* Left open for what else an object's block has. */
static void write_geometry(Exporter *e, const Shape *s)
{
    Shape *const *parts;
    if (s->type->write) {
        s->type->write(s, &e->sdl);
    } else if (!s->type->parts) {
        write_as_mesh(e, s);
    } else if (is_empty(s)) {
        write_nothing(&e->sdl);
    } else {
        uint32_t n = s->type->parts(s, &parts);
        sdl_text(&e->sdl, "%s {", s->type->name);
        for (uint32_t i = 0; i < n; i++) sdl_text(&e->sdl, "\n"), e->sdl.shape(&e->sdl, parts[i]);
        sdl_text(&e->sdl, "\n");
    }
}

static void write_flags(Sdl *out, const Object *o)
{
    if (o->no_shadow) sdl_text(out, " no_shadow");
    if (o->no_image) sdl_text(out, " no_image");
    if (o->no_reflection) sdl_text(out, " no_reflection");
    if (o->is_inverse) sdl_text(out, " inverse");
    if (o->is_hollow) sdl_text(out, " hollow");
    if (o->double_illuminate) sdl_text(out, " double_illuminate");
}

static void write_look(Sdl *out, const Object *o)
{
    if (o->has_uv_mapping) sdl_text(out, " uv_mapping");
    if (o->texture) export_texture(out, "texture", o->texture, &o->texture_space, o->has_uv_mapping);
    if (o->interior_texture)
        export_texture(out, "interior_texture", o->interior_texture, &o->texture_space, o->has_uv_mapping);
    if (o->interior) export_interior(out, o->interior);
}

static void open_shape(Exporter *e, const Shape *s)
{
    const ExportShape *listed = shape_is_object(s) ? NULL : export_find(e->list, s);
    if (listed && listed->number) {
        sdl_text(&e->sdl, "object { Shape_%d", listed->number);
    } else if (shape_is_object(s)) {
        sdl_text(&e->sdl, "object { ");
        e->sdl.shape(&e->sdl, s);
    } else {
        write_geometry(e, s);
    }
}

static void write_object(Exporter *e, const Object *o)
{
    e->sdl.placement = &o->placement, e->sdl.is_placed = false;
    open_shape(e, o->child);
    if (!e->sdl.is_placed) export_matrix(&e->sdl, &o->placement);
    write_look(&e->sdl, o);
    write_flags(&e->sdl, o);
}

/* As a part of another: a block of its own. */
static void write_shape(Sdl *out, const Shape *s)
{
    const Xform *outer = out->placement;
    out->placement = NULL;
    if (shape_is_object(s)) write_object((Exporter *)out, (const Object *)s);
    else open_shape((Exporter *)out, s);
    sdl_text(out, " }");
    out->placement = outer, out->is_placed = false;
}

/* ---- the scene ---- */

static void declare_shared(Exporter *e)
{
    int number = 0;
    for (size_t i = 0; i < e->list->n; i++) {
        ExportShape *s = &e->list->shapes[i];
        bool is_heavy = s->shape->type->parts || !s->shape->type->write;
        if (s->n_uses < 2 || !is_heavy) continue;
        sdl_text(&e->sdl, "#declare Shape_%d = ", number + 1);
        write_geometry(e, s->shape);
        sdl_text(&e->sdl, " }\n");
        s->number = ++number;
    }
}

/* Textures that are not given anywhere are given here, as they would be by default. */
static void write_scene_object(Exporter *e, Object *o)
{
    write_object(e, o);
    if (!o->texture && (object_looks(o) & LOOKS_UNTEXTURED)) {
        Xform none = xform_identity();
        export_texture(&e->sdl, "texture", e->scene->default_texture, &none, o->has_uv_mapping);
    }
    sdl_text(&e->sdl, " }\n");
}

const char *export_pov(FILE *file, const Scene *s, ExportList *list, double chord_error)
{
    Exporter e = { .sdl = { .file = file, .shape = write_shape }, .scene = s, .list = list, .chord_error = chord_error };
    sdl_text(&e.sdl, "// Written by trimray: meshes within %.9g of their surfaces.\n", chord_error);
    export_surroundings(&e.sdl, s);
    declare_shared(&e);
    for (size_t i = 0; i < s->n_objects; i++) write_scene_object(&e, s->objects[i]);
    return e.unsupported;
}
