/* Meshes against their triangles one by one, against a solid whose inside is known, and through their own vertices and
 * edges, where nothing may slip through and nothing may count twice. */
#include "tests/solids.h"

#include "render/hit.h"
#include "render/hit_list.h"
#include "render/mesh.h"

static Arena *arena;
static Trace trace;

enum { N = 6 };                  /* squares along a side of the ball */

/* A ball made of a cube's surface: (N + 1)^2 vertices on each of 6 sides, 2 faces a square, all wound alike; neighbouring
 * sides share the coordinates of their vertices, not the indices. */
typedef struct {
    MeshDesc desc;
    MeshVector vertices[6 * (N + 1) * (N + 1)];
    MeshFace faces[12 * N * N];
    double scale;
    Vec3 centre;
} Ball;

static MeshVector on_ball(const Ball *b, int side, int i, int j, bool is_round)
{
    int c[3], axis = side / 2;
    c[axis] = side % 2 ? N : -N;
    c[(axis + 1) % 3] = side % 2 ? 2 * i - N : 2 * j - N;
    c[(axis + 2) % 3] = side % 2 ? 2 * j - N : 2 * i - N;
    Vec3 v = vec_scale(vec(c[0], c[1], c[2]), 1. / N);
    if (is_round) v = vec_scale(v, 1 / sqrt(vec_length2(v)));
    v = vec_add(b->centre, vec_scale(v, b->scale));
    return (MeshVector){ (float)v.x, (float)v.y, (float)v.z };
}

static Ball *ball_new(double scale, Vec3 centre, bool is_round)
{
    Ball *b = ARENA_NEW(arena, Ball);
    uint32_t n_faces = 0;
    b->scale = scale, b->centre = centre;
    for (int side = 0; side < 6; side++)
        for (int j = 0; j <= N; j++)
            for (int i = 0; i <= N; i++) {
                uint32_t at = (uint32_t)((side * (N + 1) + j) * (N + 1) + i);
                b->vertices[at] = on_ball(b, side, i, j, is_round);
                if (i == N || j == N) continue;
                b->faces[n_faces++] = (MeshFace){ { at, at + 1, at + N + 1 } };
                b->faces[n_faces++] = (MeshFace){ { at + 1, at + N + 2, at + N + 1 } };
            }
    b->desc = (MeshDesc){ .vertices = b->vertices, .faces = b->faces, .n_faces = n_faces,
                          .n_vertices = 6 * (N + 1) * (N + 1), .has_inside = true, .inside_vector = vec(0, 0, 1) };
    return b;
}

static Vec3 to_vec(MeshVector v) { return vec(v.x, v.y, v.z); }

static HitList hits_of(const Shape *s, const Ray *r)
{
    HitList list = hit_list_make(trace.scratch, INFINITY);
    shape_all_hits(s, r, &list, &trace);
    return list;
}

static Vec3 any_target(TestRandom *r, const Ball *b)
{
    const MeshFace *f = &b->faces[test_int(r, 0, (int)b->desc.n_faces - 1)];
    Vec3 p = to_vec(b->vertices[f->corner[0]]), q = to_vec(b->vertices[f->corner[1]]), s = to_vec(b->vertices[f->corner[2]]);
    switch (test_int(r, 0, 3)) {
    case 0: return p;
    case 1: return vec_scale(vec_add(p, q), .5);
    case 2: return vec_scale(vec_add(q, s), .5);
    default: return vec_add(vec_scale(p, .2), vec_add(vec_scale(q, .3), vec_scale(s, .5)));
    }
}

/* A ray at a place of a closed surface meets it, at vertices and edges too, and an even number of times in all. */
static void nothing_slips_between_faces(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        ArenaMark mark = arena_mark(arena), scratch = arena_mark(trace.scratch);
        double scale = any_size(&r, 6);
        Ball *b = ball_new(scale, vec_scale(any_point(&r), test_int(&r, 0, 1) ? 10 * scale : 0), true);
        Shape *mesh = mesh_new(arena, &b->desc);
        for (int k = 0; k < 100; k++) {
            Vec3 from = vec_add(b->centre, vec_scale(vec_normalize(any_point(&r)), b->scale * test_range(&r, 2, 50)));
            Vec3 to = any_target(&r, b);
            Ray ray = { from, vec_scale(vec_sub(to, from), any_size(&r, 3)), 0 };
            Hit h = { .t = INFINITY };
            bool is_hit = shape_hit(mesh, &ray, &h, &trace);
            bool is_in_front = vec_dot(vec_sub(to, b->centre), vec_normalize(ray.dir)) < -.4 * b->scale;   /* no outline */
            CHECK(is_hit || !is_in_front, "seed %u, ray %d", seed, k);
            CHECK(shape_blocks(mesh, &ray, INFINITY, &trace) == is_hit, "seed %u, ray %d", seed, k);
            HitList hits = hits_of(mesh, &ray);
            CHECK(hits.n % 2 == 0, "seed %u, ray %d: %zu crossings", seed, k, hits.n);
            if (hits.n > 0) CHECK(hits.hits[0].t >= h.t - h.t_error - hits.hits[0].t_error, "seed %u, ray %d", seed, k);
        }
        shape_release(mesh);
        arena_reset(trace.scratch, scratch);
        arena_reset(arena, mark);
    }
}

/* One by one as triangles, whose own tests know the truth. */
static void a_mesh_is_its_triangles(void **state)
{
    (void)state;
    Ball *b = ball_new(1, vec(.1, .2, .3), true);
    Shape *mesh = mesh_new(arena, &b->desc);
    Shape *triangles[12 * N * N];
    for (uint32_t i = 0; i < b->desc.n_faces; i++) {
        Vec3 p[3];
        for (int k = 0; k < 3; k++) p[k] = to_vec(b->vertices[b->faces[i].corner[k]]);
        triangles[i] = triangle_new(arena, p);
    }
    TestRandom r = test_random(7);
    for (int k = 0; k < 3000; k++) {
        Vec3 from = vec_scale(any_point(&r), 3);
        Ray ray = { from, vec_sub(any_target(&r, b), from), 0 };
        Hit h = { .t = INFINITY }, truth = { .t = INFINITY };
        uint32_t face = 0;
        for (uint32_t i = 0; i < b->desc.n_faces; i++)
            if (shape_hit(triangles[i], &ray, &truth, &trace)) face = i;
        bool is_hit = shape_hit(mesh, &ray, &h, &trace);
        assert_true(is_hit == !isinf(truth.t) && h.t == truth.t);
        if (!is_hit) continue;
        CHECK(h.leaf == face && h.u == truth.u && h.v == truth.v && h.t_error == truth.t_error, "ray %d", k);
        Attributes a, c;
        mesh->type->attributes(mesh, &ray, &h, &a);
        triangles[face]->type->attributes(triangles[face], &ray, &truth, &c);
        assert_true(vec_length(vec_sub(a.normal, c.normal)) == 0 && vec_length(vec_sub(a.shading_normal, c.normal)) == 0);
    }
    shape_release(mesh);
}

/* A cube of faces whose vertices stand on the way of the inside vector: exact answers, away from the surface. */
static void the_inside_is_where_crossings_are_odd(void **state)
{
    (void)state;
    Ball *cube = ball_new(1, vec(0, 0, 0), false);
    static const Vec3 ways[] = { { 0, 0, 1 }, { 1, 0, 0 }, { 1, 1, 1 }, { .3, .2, -.9 } };
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
        cube->desc.inside_vector = ways[w];
        Shape *mesh = mesh_new(arena, &cube->desc);
        for (int i = -4; i <= 4; i++)
            for (int j = -4; j <= 4; j++)
                for (int k = -4; k <= 4; k++) {
                    Vec3 p = vec(i / 3., j / 3., k / 3.);
                    if (fabs(vec_max_abs(p) - 1) < 1e-9) continue;
                    CHECK(shape_inside(mesh, p) == (vec_max_abs(p) < 1), "%g %g %g along %zu", p.x, p.y, p.z, w);
                }
        shape_release(mesh);
    }
    cube->desc.has_inside = false;
    assert_false(shape_inside(mesh_new(arena, &cube->desc), vec(0, 0, 0)));
}

/* ---- one face ---- */

static const MeshVector corners[3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 } };
static const MeshFace face = { { 0, 1, 2 } };

static MeshDesc one_face(void)
{
    return (MeshDesc){ .vertices = corners, .faces = &face, .n_vertices = 3, .n_faces = 1 };
}

static Attributes seen_at(const MeshDesc *desc, double x, double y)
{
    Shape *mesh = mesh_new(arena, desc);
    Object *o = object_new(arena, mesh);
    Ray r = { vec(x, y, -4), vec(0, 0, 2), 0 };
    Hit h = { .t = INFINITY };
    Attributes a;
    assert_true(shape_hit(&o->shape, &r, &h, &trace) && h.t == 2);
    hit_attributes(&h, &r, &a);
    shape_release(mesh);
    return a;
}

static void normals_are_blended_by_weight(void **state)
{
    (void)state;
    static const MeshVector n[3] = { { -1, 0, -1 }, { 1, 1, -2 }, { 0, 1, -1 } };
    MeshDesc desc = one_face();
    desc.normals = n, desc.normal_faces = &face;
    Vec3 sum = vec(0, 0, 0);
    const double weight[3] = { .25, .25, .5 };      /* of (0, 0) */
    for (int i = 0; i < 3; i++) sum = vec_add(sum, vec_scale(vec_normalize(to_vec(n[i])), weight[i]));
    Attributes a = seen_at(&desc, 0, 0);
    CHECK_WITHIN(vec_length(vec_sub(a.shading_normal, vec_normalize(sum))), 1e-15, "in the middle");
    assert_true(fabs(a.normal.z) == 1);
    a = seen_at(&desc, 0, 1);
    CHECK_WITHIN(vec_length(vec_sub(a.shading_normal, vec_normalize(to_vec(n[2])))), 1e-15, "at a vertex");
}

static void three_equal_normals_are_those_of_the_face(void **state)
{
    (void)state;
    static const MeshVector n[3] = { { .5f, .6f, -1 }, { .5f, .6f, -1 }, { .5f, .6f, -1 } };
    MeshDesc desc = one_face();
    desc.normals = n, desc.normal_faces = &face;
    assert_true(fabs(seen_at(&desc, 0, 0).shading_normal.z) == 1);
    static const MeshFace none = { { MESH_NONE, MESH_NONE, MESH_NONE } };
    desc.normal_faces = &none;
    assert_true(fabs(seen_at(&desc, 0, 0).shading_normal.z) == 1);
}

static void uvs_are_blended_or_the_worlds(void **state)
{
    (void)state;
    static const MeshUv uvs[3] = { { 0, 0 }, { 1, 0 }, { .5f, 3 } };
    MeshDesc desc = one_face();
    Attributes a = seen_at(&desc, .25, 0);
    assert_true(a.uv.x == .25 && a.uv.y == 0);
    desc.uvs = uvs, desc.uv_faces = &face;
    a = seen_at(&desc, .25, 0);
    CHECK_WITHIN(hypot(a.uv.x - (.125 * 0 + .375 * 1 + .5 * .5), a.uv.y - 1.5), 1e-15, "%g %g", a.uv.x, a.uv.y);
}

static const Texture *texture_of(Color c)
{
    Pigment *pigment = ARENA_NEW(arena, Pigment);
    Layer *layer = ARENA_NEW(arena, Layer);
    Texture *t = ARENA_NEW(arena, Texture);
    *pigment = pigment_solid(c);
    *layer = (Layer){ .pigment = pigment, .finish = finish_default() };
    *t = (Texture){ .layers = layer, .n_layers = 1 };
    return t;
}

/* A face's own texture counts before that of the whole, and is seen in the space of the mesh. */
static void a_face_may_have_a_texture_of_its_own(void **state)
{
    (void)state;
    static const MeshVector square[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    static const MeshFace faces[2] = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
    static const uint32_t textures[2] = { MESH_NONE, 0 };
    const Texture *clear = texture_of((Color){ 1, 0, 0, 0, .5f }), *whole = texture_of((Color){ 0, 1, 0, 0, 0 });
    MeshDesc desc = { .vertices = square, .faces = faces, .textures = textures, .looks = &clear, .n_vertices = 4,
                      .n_faces = 2, .n_looks = 1 };
    Shape *mesh = mesh_new(arena, &desc);
    Object *o = object_new(arena, mesh);
    Xform x = xform_translate(vec(5, 0, 0));
    o->texture = whole;
    object_transform(o, &x);
    for (int i = 0; i < 2; i++) {
        Ray r = { vec(i ? 5.2 : 5.8, .5, -1), vec(0, 0, 1), 0 };
        Hit h = { .t = INFINITY };
        assert_true(shape_hit(&o->shape, &r, &h, &trace) && h.leaf == (uint32_t)i);
        assert_true(hit_textured_object(&h)->texture == (i ? clear : whole));
        CHECK_WITHIN(fabs(hit_texture_point(&h, ray_at(&r, h.t)).x - (i ? .2 : .8)), 1e-15, "face %d", i);
    }
    assert_true(object_looks(o) & LOOKS_CLEAR);
    shape_release(mesh);
}

static void faces_without_an_area_are_left_out(void **state)
{
    (void)state;
    static const MeshFace flat[2] = { { { 0, 1, 1 } }, { { 0, 1, 2 } } };
    MeshDesc desc = one_face();
    desc.faces = flat, desc.n_faces = 2;
    (void)seen_at(&desc, 0, -.5);
    desc.n_faces = 1;
    Shape *mesh = mesh_new(arena, &desc);
    Ray r = { vec(0, -1, -4), vec(0, 0, 1), 0 };
    Hit h = { .t = INFINITY };
    assert_false(shape_hit(mesh, &r, &h, &trace));
    shape_release(mesh);
}

static int set_up(void **state)
{
    (void)state;
    arena = arena_new();
    trace.scratch = arena_new();
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    arena_free(arena);
    arena_free(trace.scratch);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_slips_between_faces),
        cmocka_unit_test(a_mesh_is_its_triangles),
        cmocka_unit_test(the_inside_is_where_crossings_are_odd),
        cmocka_unit_test(normals_are_blended_by_weight),
        cmocka_unit_test(three_equal_normals_are_those_of_the_face),
        cmocka_unit_test(uvs_are_blended_or_the_worlds),
        cmocka_unit_test(a_face_may_have_a_texture_of_its_own),
        cmocka_unit_test(faces_without_an_area_are_left_out),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
