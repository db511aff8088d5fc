/* mesh { triangle { } ... } and mesh2 { vertex_vectors { } ... face_indices { } ... }. Numbers become floats here, as
 * POV-Ray stores them. */
#include "parser/rules.h"
#include "render/mesh.h"

/* A mesh while it is read: lists that grow, and what the finished mesh points to. */
typedef struct {
    Parser *parser;
    MeshVector *vertices, *normals;
    MeshUv *uvs;
    MeshFace *faces, *normal_faces, *uv_faces;
    uint32_t *textures;
    const Texture **looks;
    size_t n_vertices, n_normals, n_uvs, n_faces, n_normal_faces, n_uv_faces, n_textures, n_looks;
    size_t vertices_room, normals_room, uvs_room, faces_room, normal_faces_room, uv_faces_room, textures_room, looks_room;
    bool has_inside, has_textures;
    Vec3 inside_vector;
} MeshDraft;

static const MeshFace NO_FACE = { { MESH_NONE, MESH_NONE, MESH_NONE } };

#define ADD(d, list) ARENA_PUSH(parser_arena((d)->parser), (d)->list, (d)->n_##list, (d)->list##_room)

static MeshVector to_mesh(Vec3 v) { return (MeshVector){ (float)v.x, (float)v.y, (float)v.z }; }

static uint32_t add_vertex(MeshDraft *d, Vec3 v)
{
    ADD(d, vertices) = to_mesh(v);
    return (uint32_t)d->n_vertices - 1;
}

/* Normals are unit before they become floats. */
static uint32_t add_normal(MeshDraft *d, Vec3 n)
{
    ADD(d, normals) = to_mesh(vec_normalize(n));
    return (uint32_t)d->n_normals - 1;
}

static uint32_t add_uv(MeshDraft *d, Vec2 uv)
{
    ADD(d, uvs) = (MeshUv){ (float)uv.x, (float)uv.y };
    return (uint32_t)d->n_uvs - 1;
}

static uint32_t add_look(MeshDraft *d, const Texture *t)
{
    for (size_t i = 0; i < d->n_looks; i++)
        if (d->looks[i] == t) return (uint32_t)i;
    ADD(d, looks) = t;
    return (uint32_t)d->n_looks - 1;
}

/* The way to the inside, as the last of a mesh's items. */
static bool accept_inside_vector(MeshDraft *d)
{
    if (!accept_word(d->parser, "inside_vector")) return false;
    Place where = here(d->parser);
    d->inside_vector = parse_vec3(d->parser);
    d->has_inside = vec_max_abs(d->inside_vector) > 0;
    if (!d->has_inside) parse_warn(d->parser, where, "this inside_vector is 0: the mesh has no inside");
    return true;
}

static Shape *finish(MeshDraft *d)
{
    MeshDesc desc = {
        .vertices = d->vertices, .normals = d->normals, .uvs = d->uvs, .faces = d->faces,
        .normal_faces = d->n_normal_faces ? d->normal_faces : NULL, .uv_faces = d->n_uv_faces ? d->uv_faces : NULL,
        .textures = d->has_textures ? d->textures : NULL, .looks = d->looks, .n_vertices = (uint32_t)d->n_vertices,
        .n_faces = (uint32_t)d->n_faces, .n_looks = (uint32_t)d->n_looks, .has_inside = d->has_inside,
        .inside_vector = d->inside_vector,
    };
    return mesh_new(parser_arena(d->parser), &desc);
}

/* ---- mesh ---- */

/* Once a triangle has uvs all have: those of the last that was given where there are none. */
static void read_triangle_uvs(MeshDraft *d)
{
    bool has_uvs = accept_word(d->parser, "uv_vectors");
    MeshFace uv = d->n_uv_faces ? d->uv_faces[d->n_uv_faces - 1] : NO_FACE;
    if (!has_uvs && d->n_uv_faces == 0) return;
    for (int i = 0; i < 3 && has_uvs; i++) {
        uv.corner[i] = add_uv(d, parse_vec2(d->parser));
        accept_comma(d->parser);
    }
    while (d->n_uv_faces < d->n_faces) ADD(d, uv_faces) = uv;
}

static void read_triangle(MeshDraft *d, bool is_smooth)
{
    Parser *p = d->parser;
    Place opened = expect_open(p, is_smooth ? "smooth_triangle" : "triangle");
    MeshFace face, normals = NO_FACE;
    for (int i = 0; i < 3; i++) {
        face.corner[i] = add_vertex(d, parse_vec3(p));
        accept_comma(p);
        if (!is_smooth) continue;
        normals.corner[i] = add_normal(d, parse_vec3(p));
        accept_comma(p);
    }
    ADD(d, faces) = face;
    ADD(d, normal_faces) = normals;
    read_triangle_uvs(d);
    refuse_word(p, "texture_list", "texture_list in a triangle");
    bool has_texture = accept_word(p, "texture");
    ADD(d, textures) = has_texture ? add_look(d, parse_texture(p)) : MESH_NONE;
    d->has_textures |= has_texture;
    expect_close(p, '}', is_smooth ? "smooth_triangle" : "triangle", opened);
}

Shape *parse_mesh(Parser *p, Place word)
{
    MeshDraft d = { .parser = p };
    for (;;) {
        if (accept_word(p, "triangle")) read_triangle(&d, false);
        else if (accept_word(p, "smooth_triangle")) read_triangle(&d, true);
        else if (!accept_inside_vector(&d)) break;
    }
    if (d.n_faces == 0) parse_error(p, word, "expected a triangle in this mesh");
    return finish(&d);
}

/* ---- mesh2 ---- */

/* { count, item, item ... }: calls read for each item. */
static void read_list(MeshDraft *d, const char *what, void (*read)(MeshDraft *d))
{
    Parser *p = d->parser;
    Place opened = expect_open(p, what), where = here(p);
    int n = parse_int(p);
    if (n < 0) parse_fail(p, where, "expected a number of items in %s, found %d", what, n);
    accept_comma(p);
    for (int i = 0; i < n; i++) {
        read(d);
        accept_comma(p);
    }
    expect_close(p, '}', what, opened);
}

static void read_vertex(MeshDraft *d) { (void)add_vertex(d, parse_vec3(d->parser)); }
static void read_normal(MeshDraft *d) { (void)add_normal(d, parse_vec3(d->parser)); }
static void read_uv(MeshDraft *d) { (void)add_uv(d, parse_vec2(d->parser)); }

static void read_look(MeshDraft *d)
{
    Parser *p = d->parser;
    if (!accept_word(p, "texture")) parse_fail_expected(p, "a texture");
    ADD(d, looks) = parse_texture(p);
}

static uint32_t checked_index(MeshDraft *d, Place where, double x, size_t n, const char *what)
{
    if (!(x >= 0 && x < (double)n))
        parse_fail(d->parser, where, "expected the index of one of %zu %s, found %g", n, what, x);
    return (uint32_t)x;
}

static MeshFace read_indices(MeshDraft *d, size_t n, const char *what)
{
    Place where = here(d->parser);
    Vec3 v = parse_vec3(d->parser);
    return (MeshFace){ { checked_index(d, where, v.x, n, what), checked_index(d, where, v.y, n, what),
                         checked_index(d, where, v.z, n, what) } };
}

/* <a, b, c>, or <a, b, c>, texture; three textures (one for each corner) if they are the same. */
static void read_face(MeshDraft *d)
{
    Parser *p = d->parser;
    uint32_t texture[3] = { MESH_NONE };
    int n = 0;
    ADD(d, faces) = read_indices(d, d->n_vertices, "vertices");
    for (accept_comma(p); n < 3 && !peek_punct(p, '<') && !peek_punct(p, '}'); accept_comma(p)) {
        Token t = peek(p);
        texture[n] = checked_index(d, t.place, parse_int(p), d->n_looks, "textures");
        t.text = "a texture for each corner of a face";
        if (n > 0 && texture[n] != texture[0]) parse_fail_unsupported(p, t);
        n++;
    }
    ADD(d, textures) = texture[0];
    d->has_textures |= n > 0;
}

static void read_normal_face(MeshDraft *d) { ADD(d, normal_faces) = read_indices(d, d->n_normals, "normals"); }
static void read_uv_face(MeshDraft *d) { ADD(d, uv_faces) = read_indices(d, d->n_uvs, "uv vectors"); }

static const struct {
    const char *word;
    void (*read)(MeshDraft *d);
} lists[] = {
    { "vertex_vectors", read_vertex }, { "normal_vectors", read_normal }, { "uv_vectors", read_uv },
    { "texture_list", read_look }, { "face_indices", read_face }, { "normal_indices", read_normal_face },
    { "uv_indices", read_uv_face },
};

static bool accept_list(MeshDraft *d)
{
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        if (!accept_word(d->parser, lists[i].word)) continue;
        read_list(d, lists[i].word, lists[i].read);
        return true;
    }
    return false;
}

/* Without indices of their own, normals and uvs go by those of the vertices: there must be as many. */
static bool goes_by_vertices(MeshDraft *d, Place word, size_t n, size_t n_indices, const char *what, const char *list)
{
    if (n == 0 || n_indices > 0) return false;
    if (n == d->n_vertices) return true;
    parse_error(d->parser, word, "expected as many %s as vertices (%zu), or %s, found %zu", what, d->n_vertices, list, n);
    return false;
}

/* Faces that normal_indices leaves out are flat; uv_indices must name all. */
static void complete_mesh2(MeshDraft *d, Place word)
{
    if (goes_by_vertices(d, word, d->n_normals, d->n_normal_faces, "normals", "normal_indices"))
        d->normal_faces = d->faces, d->n_normal_faces = d->n_faces;
    if (goes_by_vertices(d, word, d->n_uvs, d->n_uv_faces, "uv vectors", "uv_indices"))
        d->uv_faces = d->faces, d->n_uv_faces = d->n_faces;
    if (d->n_normal_faces > 0)
        while (d->n_normal_faces < d->n_faces) ADD(d, normal_faces) = NO_FACE;
    if (d->n_uv_faces > 0 && d->n_uv_faces < d->n_faces)
        parse_fail(d->parser, word, "expected uv_indices for %zu faces, found %zu", d->n_faces, d->n_uv_faces);
}

Shape *parse_mesh2(Parser *p, Place word)
{
    MeshDraft d = { .parser = p };
    while (accept_list(&d) || accept_inside_vector(&d)) continue;
    if (d.n_faces == 0) parse_error(p, word, "expected faces in this mesh2");
    complete_mesh2(&d, word);
    return finish(&d);
}
