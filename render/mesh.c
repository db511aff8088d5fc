/* mesh and mesh2: triangles under their own tree, which is built when the first ray comes near. A face with a texture of its
 * own puts an object that carries it first on the hit's chain, so that all else finds it as it finds any texture. */
#include "render/mesh.h"

#include "render/bvh.h"
#include "render/hit_list.h"
#include "render/watertight.h"

typedef struct {
    Shape shape;
    MeshDesc desc;
    Box bounds;
    const Object *const *looks;
    Bvh *bvh;                       /* made by prepare */
} Mesh;

static Vec3 from_mesh(MeshVector v) { return vec(v.x, v.y, v.z); }

static void corners_of(const MeshDesc *d, uint32_t face, Vec3 p[3])
{
    for (int i = 0; i < 3; i++) p[i] = from_mesh(d->vertices[d->faces[face].corner[i]]);
}

static Vec3 face_normal(const Vec3 p[3]) { return vec_cross(vec_sub(p[2], p[0]), vec_sub(p[1], p[0])); }

/* ---- the tree ---- */

static Box mesh_bounds(const Shape *shape) { return ((const Mesh *)shape)->bounds; }

static void mesh_prepare(Shape *shape, Arena *own, Trace *t)
{
    Mesh *m = (Mesh *)shape;
    Arena *scratch = arena_new();
    Box *boxes = ARENA_ARRAY(scratch, Box, m->desc.n_faces);
    (void)t;
    for (uint32_t i = 0; i < m->desc.n_faces; i++) {
        Vec3 p[3];
        corners_of(&m->desc, i, p);
        boxes[i] = vec_max_abs(face_normal(p)) > 0 ? box_of_points(p, 3) : box_empty();
    }
    m->bvh = bvh_build(own, boxes, m->desc.n_faces, BVH_SAH);
    arena_free(scratch);
}

/* ---- rays ---- */

typedef struct {
    const Mesh *mesh;
    Shear shear;
    TriangleHit hit;
    uint32_t face;                  /* MESH_NONE: nothing yet */
    HitList *out;
    uint64_t n_crossings;
} Search;

static void sheared_corners(const Search *s, uint32_t face, const Ray *r, Vec3 v[3])
{
    corners_of(&s->mesh->desc, face, v);
    for (int i = 0; i < 3; i++) v[i] = sheared(&s->shear, vec_sub(v[i], r->origin));
}

/* Of two faces at exactly the same t (a ray through an edge) the first in the file wins. */
static bool visit_nearest(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *s = context;
    Vec3 v[3];
    t->counters.primitive_tests++;
    sheared_corners(s, i, r, v);
    double limit = s->face != MESH_NONE && i < s->face ? double_neighbour(*t_max, 1) : *t_max;
    if (!watertight_hit(&s->shear, v, r->t_min, limit, &s->hit)) return false;
    s->face = i;
    *t_max = s->hit.t;
    return false;
}

static void set_hit(const Mesh *m, const TriangleHit *h, uint32_t face, Hit *out)
{
    hit_set(out, h->t, h->error, h->u, h->v, &m->shape, face);
    uint32_t look = m->desc.textures ? m->desc.textures[face] : MESH_NONE;
    if (look != MESH_NONE) out->objects[out->n_objects++] = m->looks[look];
}

static bool mesh_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Mesh *m = (const Mesh *)shape;
    Search s = { .mesh = m, .shear = shear_of(r), .face = MESH_NONE };
    double t_max = best->t;
    bvh_traverse(m->bvh, r, &t_max, visit_nearest, &s, t);
    if (s.face != MESH_NONE) set_hit(m, &s.hit, s.face, best);
    return s.face != MESH_NONE;
}

static bool visit_any(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *s = context;
    Vec3 v[3];
    t->counters.primitive_tests++;
    sheared_corners(s, i, r, v);
    return watertight_hit(&s->shear, v, r->t_min, *t_max, &s->hit);
}

static bool mesh_blocks(const Shape *shape, const Ray *r, double t_max, Trace *t)
{
    Search s = { .mesh = (const Mesh *)shape, .shear = shear_of(r) };
    return bvh_any(s.mesh->bvh, r, t_max, visit_any, &s, t);
}

/* Every crossing once: of faces that share an edge that the ray meets, one, or both or none where the mesh turns back. */
static bool visit_all(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *s = context;
    Vec3 v[3];
    t->counters.primitive_tests++;
    sheared_corners(s, i, r, v);
    if (!watertight_passes(v) || !watertight_hit(&s->shear, v, r->t_min, *t_max, &s->hit)) return false;
    s->n_crossings++;
    if (s->out) set_hit(s->mesh, &s->hit, i, hit_list_add(s->out));
    return false;
}

static void mesh_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    Search s = { .mesh = (const Mesh *)shape, .shear = shear_of(r), .out = out };
    size_t first = out->n;
    double t_max = out->t_max;
    bvh_traverse(s.mesh->bvh, r, &t_max, visit_all, &s, t);
    hit_list_sort(out, first);
}

/* The counters of this ray are nobody's. */
static bool mesh_inside(const Shape *shape, Vec3 p)
{
    const Mesh *m = (const Mesh *)shape;
    if (!m->desc.has_inside || !box_contains(m->bounds, p)) return false;
    Trace t = { 0 };
    shape_be_prepared(shape, &t);
    Ray r = { p, m->desc.inside_vector, 0 };
    Search s = { .mesh = m, .shear = shear_of(&r) };
    double t_max = INFINITY;
    bvh_traverse(m->bvh, &r, &t_max, visit_all, &s, &t);
    return s.n_crossings % 2 == 1;
}

/* ---- appearance ---- */

/* POV-Ray takes a face whose three normals are equal (squared distances of unit vectors) for a flat one. */
static const double EQUAL_NORMALS = 1e-10;

static bool shading_normal(const MeshDesc *d, const Hit *h, Vec3 *out)
{
    if (!d->normal_faces || d->normal_faces[h->leaf].corner[0] == MESH_NONE) return false;
    Vec3 n[3];
    for (int i = 0; i < 3; i++) n[i] = vec_normalize(from_mesh(d->normals[d->normal_faces[h->leaf].corner[i]]));
    if (vec_length2(vec_sub(n[1], n[0])) <= EQUAL_NORMALS && vec_length2(vec_sub(n[2], n[0])) <= EQUAL_NORMALS) return false;
    *out = vec_add(vec_scale(n[0], 1 - h->u - h->v), vec_add(vec_scale(n[1], h->u), vec_scale(n[2], h->v)));
    return vec_max_abs(*out) > 0;
}

static Vec2 uv_at(const MeshDesc *d, const Hit *h)
{
    const double weight[3] = { 1 - h->u - h->v, h->u, h->v };
    Vec2 uv = vec2(0, 0);
    for (int i = 0; i < 3; i++) {
        MeshUv c = d->uvs[d->uv_faces[h->leaf].corner[i]];
        uv = vec2_add(uv, vec2_scale(vec2(c.u, c.v), weight[i]));
    }
    return uv;
}

static void mesh_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    const MeshDesc *d = &((const Mesh *)shape)->desc;
    Vec3 p[3], smooth;
    (void)r;
    corners_of(d, h->leaf, p);
    out->normal = out->shading_normal = vec_normalize(face_normal(p));
    if (shading_normal(d, h, &smooth)) out->shading_normal = vec_normalize(smooth);
    if (d->uv_faces) out->uv = uv_at(d, h);
}

/* Some faces may have no texture of their own. */
static unsigned mesh_looks(const Shape *shape)
{
    const MeshDesc *d = &((const Mesh *)shape)->desc;
    unsigned looks = LOOKS_UNTEXTURED;
    for (uint32_t i = 0; i < d->n_looks; i++)
        looks |= (texture_is_opaque(d->looks[i]) ? 0u : LOOKS_CLEAR) |
                 (texture_reflects(d->looks[i]) ? LOOKS_REFLECTING : 0u);
    return looks;
}

static void mesh_release(Shape *shape) { ((Mesh *)shape)->bvh = NULL; }

static bool mesh_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    (void)chord_error;
    mesh_desc_tessellate(&((const Mesh *)shape)->desc, out);
    return true;
}

static void mesh_write(const Shape *shape, Sdl *out) { mesh_desc_write(&((const Mesh *)shape)->desc, out); }

static const ShapeType mesh_type = {
    .name = "mesh", .bounds = mesh_bounds, .prepare = mesh_prepare, .hit = mesh_hit, .blocks = mesh_blocks,
    .all_hits = mesh_all_hits, .inside = mesh_inside, .attributes = mesh_attributes, .looks = mesh_looks,
    .tessellate = mesh_tessellate, .write = mesh_write, .release = mesh_release,
};

/* ---- building ---- */

static const Object *const *make_looks(Arena *a, const MeshDesc *d, Shape *mesh)
{
    const Object **looks = ARENA_ARRAY(a, const Object *, d->n_looks);
    for (uint32_t i = 0; i < d->n_looks; i++) {
        Object *o = object_new(a, mesh);
        o->texture = d->looks[i];
        looks[i] = o;
    }
    return looks;
}

Shape *mesh_new(Arena *a, const MeshDesc *desc)
{
    Mesh *m = ARENA_NEW(a, Mesh);
    shape_init(&m->shape, &mesh_type);
    m->desc = *desc;
    m->looks = make_looks(a, desc, &m->shape);
    m->shape.depth = desc->n_looks > 0;
    m->bounds = box_empty();
    for (uint32_t i = 0; i < desc->n_faces; i++)
        for (int k = 0; k < 3; k++)
            m->bounds = box_add_point(m->bounds, from_mesh(desc->vertices[desc->faces[i].corner[k]]));
    return &m->shape;
}
