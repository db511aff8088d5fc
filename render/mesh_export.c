/* Meshes as POV-Ray's mesh2, and as triangles for other programs. */
#include "render/export_look.h"
#include "render/mesh.h"
#include "render/mesh_sink.h"

static Vec3 vector(MeshVector v) { return vec(v.x, v.y, v.z); }

static void write_vectors(Sdl *out, const char *word, const MeshVector *v, uint32_t n, bool has_extra)
{
    sdl_text(out, "\n  %s { %u", word, n + has_extra);
    for (uint32_t i = 0; i < n; i++) sdl_text(out, ", <%.9g, %.9g, %.9g>", v[i].x, v[i].y, v[i].z);
    if (has_extra) sdl_text(out, ", <0, 0, 1>");
    sdl_text(out, " }");
}

/* How many things a list of indices speaks of. */
static uint32_t count_used(const MeshFace *faces, uint32_t n)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            if (faces[i].corner[k] != MESH_NONE && faces[i].corner[k] >= count) count = faces[i].corner[k] + 1;
    return count;
}

/* A layered texture must have a name to be in a list. */
static void write_textures(Sdl *out, const MeshDesc *d)
{
    Xform none = xform_identity();
    for (uint32_t i = 0; i < d->n_looks; i++) {
        sdl_text(out, "\n  #local Look_%u =", i);
        export_texture(out, "texture", d->looks[i], &none, false);
    }
    sdl_text(out, "\n  texture_list { %u", d->n_looks);
    for (uint32_t i = 0; i < d->n_looks; i++) sdl_text(out, ", texture { Look_%u }", i);
    sdl_text(out, " }");
}

static void write_faces(Sdl *out, const MeshDesc *d)
{
    sdl_text(out, "\n  face_indices { %u", d->n_faces);
    for (uint32_t i = 0; i < d->n_faces; i++) {
        const uint32_t *c = d->faces[i].corner;
        sdl_text(out, ", <%u, %u, %u>", c[0], c[1], c[2]);
        if (d->textures && d->textures[i] != MESH_NONE) sdl_text(out, ", %u", d->textures[i]);
    }
    sdl_text(out, " }");
}

/* `none` stands for what a face does not have. */
static void write_indices(Sdl *out, const char *word, const MeshFace *faces, uint32_t n, uint32_t none)
{
    sdl_text(out, "\n  %s { %u", word, n);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t *c = faces[i].corner;
        bool is_none = c[0] == MESH_NONE;
        sdl_text(out, ", <%u, %u, %u>", is_none ? none : c[0], is_none ? none : c[1], is_none ? none : c[2]);
    }
    sdl_text(out, " }");
}

static void write_uvs(Sdl *out, const MeshUv *uv, uint32_t n)
{
    sdl_text(out, "\n  uv_vectors { %u", n);
    for (uint32_t i = 0; i < n; i++) sdl_text(out, ", <%.9g, %.9g>", uv[i].u, uv[i].v);
    sdl_text(out, " }");
}

/* A face without normals gets one of its own three times: POV-Ray takes such a face for flat. */
void mesh_desc_write(const MeshDesc *d, Sdl *out)
{
    uint32_t n_normals = d->normal_faces ? count_used(d->normal_faces, d->n_faces) : 0;
    sdl_text(out, "mesh2 {");
    write_vectors(out, "vertex_vectors", d->vertices, d->n_vertices, false);
    if (d->normal_faces) write_vectors(out, "normal_vectors", d->normals, n_normals, true);
    if (d->uv_faces) write_uvs(out, d->uvs, count_used(d->uv_faces, d->n_faces));
    if (d->textures) write_textures(out, d);
    write_faces(out, d);
    if (d->uv_faces) write_indices(out, "uv_indices", d->uv_faces, d->n_faces, 0);
    if (d->normal_faces) write_indices(out, "normal_indices", d->normal_faces, d->n_faces, n_normals);
    if (d->has_inside) sdl_text(out, "\n  inside_vector"), sdl_vec(out, d->inside_vector);
}

void mesh_desc_tessellate(const MeshDesc *d, MeshSink *out)
{
    for (uint32_t i = 0; i < d->n_faces; i++) {
        Vec3 p[3];
        uint32_t v[3];
        for (int k = 0; k < 3; k++) p[k] = vector(d->vertices[d->faces[i].corner[k]]);
        Vec3 flat = vec_normalize(vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0])));
        for (int k = 0; k < 3; k++) {
            uint32_t n = d->normal_faces ? d->normal_faces[i].corner[k] : MESH_NONE;
            uint32_t uv = d->uv_faces ? d->uv_faces[i].corner[k] : MESH_NONE;
            Vec2 at = uv != MESH_NONE ? vec2(d->uvs[uv].u, d->uvs[uv].v) : vec2(p[k].x, p[k].y);
            Vec3 normal = n != MESH_NONE ? vec_normalize(vector(d->normals[n])) : flat;
            v[k] = mesh_sink_vertex(out, (MeshVertex){ p[k], normal, at });
        }
        mesh_sink_triangle(out, v[0], v[1], v[2]);
    }
}
