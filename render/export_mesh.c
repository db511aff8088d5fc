#include "render/export_mesh.h"

#include "render/mesh_sink.h"

#include <string.h>

typedef struct Walk Walk;
typedef struct { float v[4][3]; } Facet;   /* of STL: normal and corners */

/* Writes what one primitive's mesh adds, in the world already. */
typedef void (*Writer)(Walk *w, const char *name, const MeshSink *m);

struct Walk {
    FILE *file;
    Arena *arena;
    const ExportList *list;
    double chord_error;
    Writer write;
    size_t n_vertices, n_groups;
    Facet *facets;
    size_t n_facets, facets_capacity;
    ExportMeshResult result;
};

static void leave_out(Walk *w, const char *name)
{
    ExportMeshResult *r = &w->result;
    for (size_t i = 0; i < r->n; i++)
        if (strcmp(r->list[i].name, name) == 0) {
            r->list[i].n++;
            return;
        }
    ARENA_PUSH(w->arena, r->list, r->n, r->capacity) = (ExportLeftOut){ name, 1 };
}

/* A map that mirrors turns triangles over: they are turned back, so that their sides stay those of the normals. */
static void move(MeshSink *m, const Xform *x)
{
    const double (*a)[3] = x->forward.m;
    Vec3 r0 = vec(a[0][0], a[0][1], a[0][2]), r1 = vec(a[1][0], a[1][1], a[1][2]), r2 = vec(a[2][0], a[2][1], a[2][2]);
    bool mirrors = vec_dot(vec_cross(r0, r1), r2) < 0;
    for (size_t i = 0; i < m->n_vertices; i++) {
        m->vertices[i].point = xform_point(x, m->vertices[i].point);
        m->vertices[i].normal = vec_normalize(xform_normal(x, m->vertices[i].normal));
    }
    for (size_t i = 0; mirrors && i < m->n_triangles; i++) {
        uint32_t *v = m->triangles[i].v, t = v[1];
        v[1] = v[2], v[2] = t;
    }
}

static void add_primitive(Walk *w, const Shape *s, const Xform *placement)
{
    Arena *own = arena_new();
    MeshSink m = mesh_sink(own);
    double e = w->chord_error / export_find(w->list, s)->stretch;
    if (s->type->tessellate && s->type->tessellate(s, e, &m)) {
        move(&m, placement);
        w->write(w, s->type->name, &m);
        w->result.n_triangles += m.n_triangles;
    } else {
        leave_out(w, s->type->name);
    }
    arena_free(own);
}

/* What a compound makes of its parts (but a union) has no mesh. */
static void walk(Walk *w, const Shape *s, const Xform *placement)
{
    Shape *const *parts;
    if (shape_is_object(s)) {
        const Object *o = (const Object *)s;
        Xform within = xform_then(o->placement, *placement);
        walk(w, o->child, &within);
    } else if (!s->type->parts) {
        add_primitive(w, s, placement);
    } else if (strcmp(s->type->name, "union") != 0) {
        leave_out(w, s->type->name);
    } else {
        uint32_t n = s->type->parts(s, &parts);
        for (uint32_t i = 0; i < n; i++) walk(w, parts[i], placement);
    }
}

static Walk walk_scene(FILE *file, Arena *a, const Scene *s, const ExportList *list, double chord_error, Writer write)
{
    Walk w = { .file = file, .arena = a, .list = list, .chord_error = chord_error, .write = write };
    Xform world = xform_identity();
    for (size_t i = 0; i < s->n_objects; i++) walk(&w, &s->objects[i]->shape, &world);
    return w;
}

/* ---- OBJ ---- */

static void write_obj(Walk *w, const char *name, const MeshSink *m)
{
    fprintf(w->file, "g %s_%zu\n", name, ++w->n_groups);
    for (size_t i = 0; i < m->n_vertices; i++) {
        const MeshVertex *v = &m->vertices[i];
        fprintf(w->file, "v %.17g %.17g %.17g\nvn %.9g %.9g %.9g\nvt %.17g %.17g\n", v->point.x, v->point.y, v->point.z,
                v->normal.x, v->normal.y, v->normal.z, v->uv.x, v->uv.y);
    }
    for (size_t i = 0; i < m->n_triangles; i++) {
        size_t c[3];
        for (int k = 0; k < 3; k++) c[k] = w->n_vertices + 1 + m->triangles[i].v[k];
        fprintf(w->file, "f %zu/%zu/%zu %zu/%zu/%zu %zu/%zu/%zu\n", c[0], c[0], c[0], c[1], c[1], c[1], c[2], c[2], c[2]);
    }
    w->n_vertices += m->n_vertices;
}

ExportMeshResult export_obj(FILE *file, Arena *a, const Scene *s, const ExportList *list, double chord_error)
{
    fprintf(file, "# Written by trimray: triangles within %.9g of their surfaces.\n", chord_error);
    return walk_scene(file, a, s, list, chord_error, write_obj).result;
}

/* ---- STL ----
 * 80 bytes of text, the number of triangles, and for each a normal, three corners and two bytes; little endian. */

enum { HEADER_BYTES = 80 };

static void put_u32(FILE *file, uint32_t x)
{
    for (int i = 0; i < 4; i++) fputc((int)(x >> 8 * i & 255), file);
}

static void put_vec(FILE *file, const float v[3])
{
    for (int i = 0; i < 3; i++) {
        uint32_t bits;
        memcpy(&bits, &v[i], sizeof bits);
        put_u32(file, bits);
    }
}

static void set_vec(float out[3], Vec3 v) { out[0] = (float)v.x, out[1] = (float)v.y, out[2] = (float)v.z; }

/* Kept until their number is known, which stands before them. */
static void keep_facets(Walk *w, const char *name, const MeshSink *m)
{
    (void)name;
    for (size_t i = 0; i < m->n_triangles; i++) {
        Facet f;
        Vec3 p[3];
        for (int k = 0; k < 3; k++) p[k] = m->vertices[m->triangles[i].v[k]].point, set_vec(f.v[k + 1], p[k]);
        set_vec(f.v[0], vec_normalize(vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0]))));
        ARENA_PUSH(w->arena, w->facets, w->n_facets, w->facets_capacity) = f;
    }
}

ExportMeshResult export_stl(FILE *file, Arena *a, const Scene *s, const ExportList *list, double chord_error)
{
    Walk w = walk_scene(file, a, s, list, chord_error, keep_facets);
    fprintf(file, "%-*s", HEADER_BYTES, "triangles of trimray");
    put_u32(file, (uint32_t)w.n_facets);
    for (size_t i = 0; i < w.n_facets; i++) {
        for (int k = 0; k < 4; k++) put_vec(file, w.facets[i].v[k]);
        fputc(0, file), fputc(0, file);
    }
    return w.result;
}
