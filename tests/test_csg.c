/* Compounds against the truth that a point is inside or not: along a ray the whole changes exactly at the hits that are
 * reported, in random trees of solids, and where the faces of many boxes coincide. */
#include "tests/solids.h"

#include "render/hit_list.h"
#include "render/mesh.h"

static Arena *arena;
static Trace trace;

/* ---- trees ---- */

typedef enum { LEAF, INTERSECTION, MERGE, DIFFERENCE, DIFFERENCE_OF_UNION, N_NODES } NodeKind;

typedef struct Node Node;
struct Node {
    NodeKind kind;
    Solid solid;
    Vec3 shift;                  /* of the solid, by a placement */
    Node *parts[3];
    int n;
    Shape *shape;
};

static bool member(const Node *node, Real3 p)
{
    if (node->kind == LEAF) return solid_inside(&node->solid, real_sub(p, real3(node->shift)));
    bool first = member(node->parts[0], p), any = first, all = first;
    for (int i = 1; i < node->n; i++) {
        bool m = member(node->parts[i], p);
        any |= m, all &= m;
        if (m && node->kind >= DIFFERENCE) return false;
    }
    return node->kind == INTERSECTION ? all : node->kind == MERGE ? any : first;
}

/* How far the nearest surface of any leaf is. */
static Real clearance(const Node *node, Real3 p)
{
    if (node->kind == LEAF) return solid_distance(&node->solid, real_sub(p, real3(node->shift)));
    Real nearest = INFINITY;
    for (int i = 0; i < node->n; i++) nearest = fminl(nearest, clearance(node->parts[i], p));
    return nearest;
}

static Shape *compound(const Node *node)
{
    Shape *parts[3];
    for (int i = 0; i < node->n; i++) parts[i] = node->parts[i]->shape;
    switch (node->kind) {
    case INTERSECTION: return intersection_new(arena, parts, (uint32_t)node->n);
    case MERGE: return merge_new(arena, parts, (uint32_t)node->n);
    case DIFFERENCE: return difference_new(arena, parts, (uint32_t)node->n);
    default: break;
    }
    Shape *two[2] = { parts[0], union_new(arena, parts + 1, (uint32_t)node->n - 1) };
    return difference_new(arena, two, 2);
}

typedef Node *(*MakeLeaf)(TestRandom *r);

static Node *any_tree(TestRandom *r, int depth, MakeLeaf leaf)
{
    if (depth == 0) return leaf(r);
    Node *node = ARENA_NEW(arena, Node);
    node->kind = (NodeKind)test_int(r, INTERSECTION, N_NODES - 1);
    node->n = test_int(r, 2, 3);
    for (int i = 0; i < node->n; i++) node->parts[i] = any_tree(r, test_int(r, 0, depth - 1), leaf);
    node->shape = compound(node);
    return node;
}

/* A solid of a size near 1, moved to near the origin. */
static Node *any_leaf(TestRandom *r)
{
    static const SolidKind kinds[] = { SPHERE, BOX, CYLINDER, CONE, SHARP_CONE, TORUS, THIN_TORUS, PLANE };
    Node *node = ARENA_NEW(arena, Node);
    node->solid = any_solid(arena, r, kinds[test_int(r, 0, 7)], .3);
    node->shift = vec_sub(vec_scale(any_point(r), .7), node->solid.centre);
    Object *o = object_new(arena, node->solid.shape);
    Xform x = xform_translate(node->shift);
    object_transform(o, &x);
    node->shape = &o->shape;
    return node;
}

/* A box with corners on the integers: its faces lie in those of others more often than not. */
static Node *any_lattice_box(TestRandom *r)
{
    Node *node = ARENA_NEW(arena, Node);
    Vec3 lo = vec(test_int(r, 0, 2), test_int(r, 0, 2), test_int(r, 0, 2));
    Vec3 hi = vec_add(lo, vec(test_int(r, 1, 2), test_int(r, 1, 2), test_int(r, 1, 2)));
    node->solid = (Solid){ .kind = BOX, .shape = box_shape_new(arena, lo, hi), .size = 4 };
    node->solid.corner[0] = real3(lo), node->solid.corner[1] = real3(hi);
    node->shape = node->solid.shape;
    return node;
}

/* ---- the check ---- */

static HitList hits_of(Shape *s, const Ray *r)
{
    HitList list = hit_list_make(trace.scratch, INFINITY);
    shape_all_hits(s, r, &list, &trace);
    return list;
}

/* At each hit the whole changes, and between hits it does not. Points nearer than `margin` to a surface say nothing. */
static void check_changes(const Node *node, const Ray *r, const HitList *hits, double t_end, double margin, unsigned seed)
{
    bool is_known = false, expected = false;
    TestRandom random = test_random(seed + 1);
    for (size_t i = 0; i <= hits->n; i++) {
        double from = i ? hits->hits[i - 1].t : 0, to = i < hits->n ? hits->hits[i].t : fmax(t_end, 2 * from);
        CHECK(from <= to, "seed %u: hit %zu out of order", seed, i);
        for (int k = 0; k < 20; k++) {
            Real3 p = real_at(r, from + (to - from) * test_unit(&random));
            if (!(clearance(node, p) > margin)) continue;
            if (!is_known) expected = member(node, p), is_known = true;
            CHECK(member(node, p) == expected, "seed %u: interval %zu of %zu", seed, i, hits->n);
        }
        expected = !expected;
    }
}

static void check_queries_agree(Shape *s, const Ray *r, const HitList *hits, unsigned seed)
{
    Hit h = { .t = INFINITY };
    bool is_hit = shape_hit(s, r, &h, &trace);
    CHECK(is_hit == (hits->n > 0) && (!is_hit || h.t == hits->hits[0].t), "seed %u", seed);
    CHECK(shape_blocks(s, r, INFINITY, &trace) == is_hit, "seed %u", seed);
    if (!is_hit) return;
    CHECK(h.shape == hits->hits[0].shape && h.index == hits->hits[0].index, "seed %u", seed);
    h.t = hits->hits[0].t;
    CHECK(!shape_hit(s, r, &h, &trace) && !shape_blocks(s, r, h.t, &trace), "seed %u: nothing before the nearest", seed);
}

static void a_compound_changes_where_it_is_hit(void **state)
{
    (void)state;
    size_t n_hits = 0;
    for (unsigned seed = 0; seed < 3000; seed++) {
        TestRandom r = test_random(seed);
        ArenaMark mark = arena_mark(arena), scratch = arena_mark(trace.scratch);
        const Node *node = any_tree(&r, 3, any_leaf);
        for (int k = 0; k < 4; k++) {
            Vec3 from = vec_scale(any_point(&r), 4), to = vec_scale(any_point(&r), 1.2);
            Ray ray = { from, vec_scale(vec_sub(to, from), any_size(&r, 2)), 0 };
            HitList hits = hits_of(node->shape, &ray);
            check_changes(node, &ray, &hits, 20 / vec_length(ray.dir), 1e-9, seed);
            check_queries_agree(node->shape, &ray, &hits, seed);
            n_hits += hits.n;
        }
        arena_reset(trace.scratch, scratch);
        arena_reset(arena, mark);
    }
    CHECK(n_hits > 3000, "only %zu hits", n_hits);
}

/* Rays from anywhere to anywhere, to corners and edges, and along the axes. */
static Ray any_lattice_ray(TestRandom *r)
{
    Vec3 from = vec_add(vec(1.7, 1.3, 1.9), vec_scale(any_point(r), 6));
    Vec3 to = vec(test_int(r, 0, 4), test_int(r, 0, 4), test_int(r, 0, 4));
    int kind = test_int(r, 0, 3);
    if (kind == 0) to = vec_scale(vec(test_range(r, 0, 4), test_range(r, 0, 4), test_range(r, 0, 4)), 1);
    if (kind == 1) to.x = test_range(r, 0, 4);
    if (kind == 2) return (Ray){ from, vec(test_int(r, 0, 1) ? 1 : -1, 0, 0), 0 };
    return (Ray){ from, vec_sub(to, from), 0 };
}

static void faces_that_coincide_are_never_lost_or_doubled(void **state)
{
    (void)state;
    size_t n_hits = 0;
    for (unsigned seed = 0; seed < 4000; seed++) {
        TestRandom r = test_random(seed);
        ArenaMark mark = arena_mark(arena), scratch = arena_mark(trace.scratch);
        const Node *node = any_tree(&r, 3, any_lattice_box);
        for (int k = 0; k < 10; k++) {
            Ray ray = any_lattice_ray(&r);
            HitList hits = hits_of(node->shape, &ray);
            check_changes(node, &ray, &hits, 20 / vec_length(ray.dir), 1e-9, seed);
            check_queries_agree(node->shape, &ray, &hits, seed);
            n_hits += hits.n;
        }
        arena_reset(trace.scratch, scratch);
        arena_reset(arena, mark);
    }
    CHECK(n_hits > 10000, "only %zu hits", n_hits);
}

/* ---- single rules ---- */

static bool hit_of(Shape *s, Vec3 from, Vec3 to, Hit *h)
{
    Ray r = { from, vec_sub(to, from), 0 };
    *h = (Hit){ .t = INFINITY };
    return shape_hit(s, &r, h, &trace);
}

static Shape *unit_box(double x) { return box_shape_new(arena, vec(x, 0, 0), vec(x + 1, 1, 1)); }

/* POV-Ray's choice: of two faces at the same place the part written later is seen. */
static void the_later_part_is_seen_where_two_coincide(void **state)
{
    (void)state;
    Shape *parts[2] = { unit_box(0), box_shape_new(arena, vec(0, 0, 0), vec(1, 1, 2)) };
    Shape *wholes[2] = { intersection_new(arena, parts, 2), merge_new(arena, parts, 2) };
    Hit h;
    for (int i = 0; i < 2; i++) {
        assert_true(hit_of(wholes[i], vec(.3, .3, -1), vec(.3, .3, 0), &h) && h.t == 1);
        assert_true(h.shape == parts[1] && h.index == 1);
    }
}

/* A hole as deep as the box is wide leaves no skin; boxes side by side make one. */
static void shared_faces_leave_no_skin(void **state)
{
    (void)state;
    Shape *hole[2] = { unit_box(0), box_shape_new(arena, vec(.2, .2, 0), vec(.8, .8, 1)) };
    Shape *row[3] = { unit_box(0), unit_box(1), unit_box(2) };
    Shape *pierced = difference_new(arena, hole, 2), *joined = merge_new(arena, row, 3);
    TestRandom r = test_random(1);
    for (int i = 0; i < 1000; i++) {
        Vec3 from = vec(.5, .5, -test_range(&r, 1, 9)), to = vec(test_range(&r, .25, .75), test_range(&r, .25, .75), 1);
        Ray ray = { from, vec_sub(to, from), 0 };
        CHECK(hits_of(pierced, &ray).n == 0, "ray %d", i);
        ray = (Ray){ vec(-1, .5, .5), vec(1, test_range(&r, -.1, .1), test_range(&r, -.1, .1)), 0 };
        CHECK(hits_of(joined, &ray).n == 2, "ray %d", i);
    }
}

static void a_surface_without_an_inside_is_cut(void **state)
{
    (void)state;
    const Vec3 corners[3] = { { -5, -5, .5 }, { 5, -5, .5 }, { 0, 9, .5 } };
    Shape *parts[2] = { unit_box(0), triangle_new(arena, corners) };
    Shape *cut = intersection_new(arena, parts, 2);
    Hit h;
    assert_true(hit_of(cut, vec(.5, .5, -1), vec(.5, .5, 0), &h) && h.shape == parts[1] && h.t == 1.5);
    assert_false(hit_of(cut, vec(1.5, .5, -1), vec(1.5, .5, 0), &h));
}

static void clips_cut_and_leave_open(void **state)
{
    (void)state;
    Object *ball = object_new(arena, sphere_new(arena, vec(0, 0, 0), 1));
    Xform right = xform_translate(vec(5, 0, 0));
    object_transform(ball, &right);
    Shape *clips[1] = { plane_new(arena, vec(1, 0, 0), 5) };
    object_clip(arena, ball, clips, 1);                   /* the left half is kept: the clip is where the ball is now */
    object_transform(ball, &right);                       /* and moves with it */
    Hit h;
    assert_true(hit_of(&ball->shape, vec(20, .3, 0), vec(19, .3, 0), &h));
    CHECK_WITHIN(fabs(20 - h.t - (10 - sqrt(1 - .09))), 1e-14, "the far side, from within");
    assert_false(hit_of(&ball->shape, vec(10.5, 0, -5), vec(10.5, 0, 0), &h));
    assert_true(shape_inside(&ball->shape, vec(9.5, 0, 0)) && !shape_inside(&ball->shape, vec(10.5, 0, 0)));
    object_invert(arena, ball);                           /* POV-Ray clips the inverse, too */
    assert_false(shape_inside(&ball->shape, vec(9.5, 0, 0)) || shape_inside(&ball->shape, vec(10.5, 0, 0)));
    assert_true(shape_inside(&ball->shape, vec(5, 0, 0)));
}

/* Clips are no parts of what a scene sees, but what their meshes hold is given back with it. */
static void clips_are_prepared_and_released(void **state)
{
    (void)state;
    static const MeshVector v[4] = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 0, 0, 4 } };
    static const MeshFace f[4] = { { { 0, 1, 2 } }, { { 0, 2, 3 } }, { { 0, 3, 1 } }, { { 1, 3, 2 } } };
    MeshDesc desc = { .vertices = v, .faces = f, .n_vertices = 4, .n_faces = 4, .has_inside = true };
    desc.inside_vector = vec(1, 2, 3);
    Shape *corner = mesh_new(arena, &desc), *clips[1] = { corner };
    Object *ball = object_new(arena, sphere_new(arena, vec(0, 0, 0), 1));
    object_clip(arena, ball, clips, 1);
    Hit h;
    assert_true(hit_of(&ball->shape, vec(.3, .4, -5), vec(.3, .4, -4), &h));
    CHECK_WITHIN(fabs(h.t - (5 + sqrt(.75))), 1e-14, "only where x, y and z are positive");
    assert_false(hit_of(&ball->shape, vec(-.3, .4, -5), vec(-.3, .4, -4), &h));
    assert_true(shape_was_prepared(corner));
    shape_release(ball->child);
    assert_false(shape_was_prepared(corner));
}

/* Inverting a union gives the intersection of the inverses: the surfaces within are gone. */
static void an_inverse_union_has_no_surfaces_within(void **state)
{
    (void)state;
    Shape *balls[2] = { sphere_new(arena, vec(0, 0, 0), 1), sphere_new(arena, vec(1, 0, 0), 1) };
    Shape *both = union_new(arena, balls, 2);
    Ray r = { vec(-5, 0, 0), vec(1, 0, 0), 0 };
    assert_int_equal(hits_of(both, &r).n, 4);
    Shape *inverse = shape_inverse(arena, both);
    HitList hits = hits_of(inverse, &r);
    assert_true(hits.n == 2 && hits.hits[0].t == 4 && hits.hits[1].t == 7);
    assert_true(shape_inside(inverse, vec(-3, 0, 0)) && !shape_inside(inverse, vec(.5, 0, 0)));
    hits = hits_of(shape_inverse(arena, inverse), &r);
    assert_true(hits.n == 2);
    shape_release(both);
}

/* More placements than a hit can list are distributed over the parts, clips and inverses included. */
static void deep_nests_of_compounds_stay_what_they_are(void **state)
{
    (void)state;
    Object *ball = object_new(arena, sphere_new(arena, vec(0, 0, 0), 2));
    Shape *clips[1] = { plane_new(arena, vec(0, 1, 0), .5) };
    object_clip(arena, ball, clips, 1);
    Shape *parts[2] = { &ball->shape, box_shape_new(arena, vec(-1, -1, -9), vec(1, 1, 9)) };
    Shape *s = difference_new(arena, parts, 2);
    Xform step = xform_translate(vec(1, 0, 0));
    for (int i = 0; i < 3 * HIT_MAX_OBJECTS; i++) {
        Object *o = object_new(arena, s);
        object_transform(o, &step);
        s = &o->shape;
    }
    double x = 3 * HIT_MAX_OBJECTS;
    Hit h;
    assert_true(hit_of(s, vec(x + 1.5, 0, -5), vec(x + 1.5, 0, -4), &h));
    CHECK_WITHIN(fabs(h.t - (5 - sqrt(4 - 2.25))), 1e-13, "beside the hole");
    assert_false(hit_of(s, vec(x + .5, 0, -5), vec(x + .5, 0, -4), &h));        /* through the hole */
    assert_false(hit_of(s, vec(x + 1.5, .6, -5), vec(x + 1.5, .6, -4), &h));    /* clipped away */
    assert_true(shape_inside(s, vec(x + 1.5, 0, 0)));
    assert_false(shape_inside(s, vec(x, 0, 0)) || shape_inside(s, vec(x + 1.5, .6, 0)));
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
        cmocka_unit_test(a_compound_changes_where_it_is_hit),
        cmocka_unit_test(faces_that_coincide_are_never_lost_or_doubled),
        cmocka_unit_test(the_later_part_is_seen_where_two_coincide),
        cmocka_unit_test(shared_faces_leave_no_skin),
        cmocka_unit_test(a_surface_without_an_inside_is_cut),
        cmocka_unit_test(clips_cut_and_leave_open),
        cmocka_unit_test(clips_are_prepared_and_released),
        cmocka_unit_test(an_inverse_union_has_no_surfaces_within),
        cmocka_unit_test(deep_nests_of_compounds_stay_what_they_are),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
