#include "tests/solids.h"

#include "render/hit.h"
#include "render/shape_tree.h"

#include <stdbool.h>
#include <string.h>

static Arena *arena;

static int make_arena(void **state)
{
    (void)state;
    arena = arena_new();
    return 0;
}

static int free_arena(void **state)
{
    (void)state;
    arena_free(arena);
    return 0;
}

static bool hit_of(const Shape *s, const Ray *r, Hit *h)
{
    Trace t = { 0 };
    *h = (Hit){ .t = INFINITY };
    return shape_hit(s, r, h, &t);
}

/* What the shapes of a small tree have prepared. */
static void release_all(Shape *s)
{
    Shape *const *parts;
    uint32_t n = s->type->parts ? s->type->parts(s, &parts) : 0;
    for (uint32_t i = 0; i < n; i++) release_all(parts[i]);
    shape_release(s);
}

static Shape *ball(Vec3 centre, double radius) { return sphere_new(arena, centre, radius); }

static const Texture *texture(void)
{
    Texture *t = ARENA_NEW(arena, Texture);
    return t;
}

static Xform any_xform(TestRandom *r, double size)
{
    Xform x = xform_scale(vec(any_size(r, .5), -any_size(r, .5), any_size(r, .5)));
    x = xform_then(x, xform_axis_rotate(any_point(r), test_range(r, -180, 180)));
    return xform_then(x, xform_translate(vec_scale(any_point(r), size)));
}

static void move(Object *o, Xform x) { object_transform(o, &x); }

static void a_moved_object_is_hit_where_it_was_moved(void **state)
{
    (void)state;
    Object *o = object_new(arena, ball(vec(0, 0, 0), 1));
    move(o, xform_scale(vec(2, 1, 1)));
    move(o, xform_rotate(vec(0, 0, 90)));
    move(o, xform_translate(vec(10, 0, 0)));
    Ray r = { vec(10, 9, 0), vec(0, -2, 0), 0 };
    Hit h;
    assert_true(hit_of(&o->shape, &r, &h));
    assert_true(h.t == 3.5);                                   /* (9 - 2) / 2: the long axis is upright now */
    Attributes at;
    hit_attributes(&h, &r, &at);
    assert_true(at.normal.x == 0 && at.normal.y == 1 && at.normal.z == 0);
    Box b = shape_bounds(&o->shape);
    CHECK(box_contains(b, vec(9, -2, -1)) && box_contains(b, vec(11, 2, 1)) && box_diagonal(b) < 4.9 + 1e-3, "bounds");
}

static Real3 real_unpoint(const Xform *x, Real3 p)
{
    const double (*m)[3] = x->backward.m;
    return (Real3){ p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
                    p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
                    p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2] };
}

/* The longest semi-axis of the image of the unit ball, at most: the Frobenius norm. */
static double norm_of(const Xform *x)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) sum += x->forward.m[i][k] * x->forward.m[i][k];
    return sqrt(sum);
}

/* The whole way through random placements: the hit lies on the image of the surface within its error, measured by taking
 * the point back in extended precision through the same matrices. */
static void hits_of_objects_lie_on_their_image_within_their_error(void **state)
{
    (void)state;
    TestRandom random = test_random(1);
    int n_hits = 0;
    for (int i = 0; i < 20000; i++) {
        ArenaMark mark = arena_mark(arena);
        Solid s = any_solid(arena, &random, (SolidKind)(i % N_SOLIDS), 8);
        Object *inner = object_new(arena, s.shape), *outer = object_new(arena, &inner->shape);
        move(inner, any_xform(&random, 3 * s.size));
        move(outer, any_xform(&random, 30 * s.size));
        Ray local = any_ray_at(&random, &s), r = local;
        Object *way[2] = { inner, outer };
        for (int k = 0; k < 2; k++)
            r = (Ray){ xform_point(&way[k]->placement, r.origin), xform_vector(&way[k]->placement, r.dir), 0 };
        Hit h;
        bool is_hit = hit_of(&outer->shape, &r, &h);
        arena_reset(arena, mark);
        if (!is_hit) continue;
        n_hits++;
        CHECK(h.n_objects == 2 && h.objects[0] == inner && h.objects[1] == outer, "case %d", i);
        Real3 p = real_unpoint(&inner->placement, real_unpoint(&outer->placement, real_at(&r, h.t)));
        Real within = solid_distance(&s, p);
        double stretched = norm_of(&inner->placement) * norm_of(&outer->placement);
        CHECK_WITHIN((double)within, h.t_error * vec_length(r.dir) * stretched, "case %d, %s", i, solid_names[s.kind]);
        double scale = h.t + (vec_length(r.origin) + 100 * s.size) / vec_length(r.dir);
        CHECK_WITHIN(h.t_error, 1e-10 * scale, "case %d: an error bound that tells nothing", i);
    }
    CHECK(n_hits > 5000, "%d hits", n_hits);
}

static void secondary_rays_leave_objects_behind(void **state)
{
    (void)state;
    TestRandom random = test_random(2);
    for (int i = 0; i < 20000; i++) {
        ArenaMark mark = arena_mark(arena);
        Solid s = any_solid(arena, &random, (SolidKind)(i % N_SOLIDS), 8);
        Object *o = object_new(arena, s.shape);
        move(o, any_xform(&random, 30 * s.size));
        Ray local = any_ray_at(&random, &s);
        Ray r = { xform_point(&o->placement, local.origin), xform_vector(&o->placement, local.dir), 0 };
        Hit h, second;
        Attributes at, other;
        if (hit_of(&o->shape, &r, &h)) {
            hit_attributes(&h, &r, &at);
            Vec3 dir = vec_normalize(any_point(&random)), n = at.normal;
            if (vec_dot(dir, n) < 0) n = vec_neg(n);
            Ray next = { vec_add(ray_at(&r, h.t), vec_scale(n, hit_offset(&h, &r))), dir, 0 };
            bool is_near = hit_of(&o->shape, &next, &second) && second.t < 1e-4 * s.size;
            if (is_near) hit_attributes(&second, &next, &other);
            double out = is_near ? vec_dot(other.normal, dir) * vec_dot(at.normal, dir) : 0;
            CHECK(!is_near || out < 1e-3, "case %d: %s, t %g of size %g", i, solid_names[s.kind], second.t, s.size);
        }
        arena_reset(arena, mark);
    }
}

static void hit_and_blocks_agree_for_objects(void **state)
{
    (void)state;
    TestRandom random = test_random(3);
    Trace t = { 0 };
    for (int i = 0; i < 5000; i++) {
        ArenaMark mark = arena_mark(arena);
        Solid s = any_solid(arena, &random, (SolidKind)(i % N_SOLIDS), 2);
        Object *o = object_new(arena, s.shape);
        move(o, any_xform(&random, s.size));
        s.centre = xform_point(&o->placement, s.centre);
        Ray r = any_ray_at(&random, &s);
        Hit h;
        bool is_hit = hit_of(&o->shape, &r, &h);
        CHECK(shape_blocks(&o->shape, &r, INFINITY, &t) == is_hit, "case %d", i);
        CHECK(!is_hit || !shape_blocks(&o->shape, &r, h.t, &t), "case %d: the interval is open", i);
        arena_reset(arena, mark);
    }
}

/* ---- appearance ---- */

static void the_innermost_texture_and_interior_count(void **state)
{
    (void)state;
    Object *part = object_new(arena, ball(vec(0, 0, 0), 1));
    Shape *const parts[] = { &part->shape };
    Object *whole = object_new(arena, union_new(arena, parts, 1)), *top = object_new(arena, &whole->shape);
    Ray r = { vec(0, 0, -5), vec(0, 0, 1), 0 };
    Hit h;
    assert_true(hit_of(&top->shape, &r, &h) && h.n_objects == 3);
    assert_null(hit_textured_object(&h));
    assert_null(hit_interior(&h));
    assert_ptr_equal(hit_innermost(&h), part);
    const Interior glass = { .ior = 1.5f }, water = { .ior = 1.3f };
    top->texture = texture(), top->interior = &glass;
    assert_ptr_equal(hit_textured_object(&h), top);
    assert_ptr_equal(hit_interior(&h), &glass);
    part->texture = texture(), whole->interior = &water;
    assert_ptr_equal(hit_textured_object(&h), part);
    assert_ptr_equal(hit_interior(&h), &water);
    assert_false(hit_has_flag_no_shadow(&h));
    whole->no_shadow = true;
    assert_true(hit_has_flag_no_shadow(&h));
    release_all(&top->shape);
}

/* sphere { ... translate A pigment { } translate B }: the texture is moved by B, and by all that moves the object later. */
static void textures_move_with_what_is_written_after_them(void **state)
{
    (void)state;
    Object *part = object_new(arena, ball(vec(0, 0, 0), 1));
    move(part, xform_translate(vec(10, 0, 0)));
    part->texture = texture();
    part->texture_space = xform_identity();
    move(part, xform_translate(vec(0, 20, 0)));
    Shape *const parts[] = { &part->shape };
    Object *whole = object_new(arena, union_new(arena, parts, 1));
    move(whole, xform_scale(vec(2, 2, 2)));
    Ray r = { vec(20, 40, -9), vec(0, 0, 1), 0 };
    Hit h;
    assert_true(hit_of(&whole->shape, &r, &h) && h.t == 7);
    Vec3 p = hit_texture_point(&h, vec(20, 40, -2));
    assert_true(p.x == 10 && p.y == 0 && p.z == -1);
    part->texture = NULL;
    whole->texture = texture();
    p = hit_texture_point(&h, vec(20, 40, -2));
    assert_true(p.x == 10 && p.y == 20 && p.z == -1);       /* a texture of the whole is not moved by the part's own maps */
    whole->texture = NULL;
    p = hit_texture_point(&h, vec(20, 40, -2));
    assert_true(p.x == 20 && p.y == 40 && p.z == -2);
    release_all(&whole->shape);
}

static void an_inverse_object_turns_its_normals_over(void **state)
{
    (void)state;
    Object *o = object_new(arena, ball(vec(0, 0, 0), 1)), *twice = object_new(arena, &o->shape);
    o->is_inverse = true;
    Ray r = { vec(0, 0, -5), vec(0, 0, 1), 0 };
    Hit h;
    Attributes at;
    assert_true(hit_of(&o->shape, &r, &h));
    hit_attributes(&h, &r, &at);
    assert_true(at.normal.z == 1 && at.shading_normal.z == 1);
    twice->is_inverse = true;
    assert_true(hit_of(&twice->shape, &r, &h));
    hit_attributes(&h, &r, &at);
    assert_true(at.normal.z == -1);
    assert_true(o->shape.type->inside(&o->shape, vec(0, 0, 3)) && !twice->shape.type->inside(&twice->shape, vec(0, 0, 3)));
}

static void shapes_without_parameters_have_the_worlds_x_and_y(void **state)
{
    (void)state;
    Object *o = object_new(arena, plane_new(arena, vec(0, 0, 1), 0));
    move(o, xform_scale(vec(3, 3, 3)));
    move(o, xform_translate(vec(1, 1, 0)));
    Ray r = { vec(7, 8, -5), vec(0, 0, 1), 0 };
    Hit h;
    Attributes at;
    assert_true(hit_of(&o->shape, &r, &h));
    hit_attributes(&h, &r, &at);
    assert_true(at.uv.x == 7 && at.uv.y == 8);
}

static void normals_are_the_same_without_uv(void **state)
{
    (void)state;
    Shape *const shapes[] = { ball(vec(0, 0, 0), 1), torus_new(arena, 1, .4),
                              box_shape_new(arena, vec(-1, -1, -1), vec(1, 1, 1)) };
    TestRandom random = test_random(8);
    for (int i = 0; i < 300; i++) {
        Object *o = object_new(arena, shapes[i % 3]);
        move(o, xform_scale(vec(test_range(&random, .5, 2), 1, test_range(&random, .5, 2))));
        Ray r = { vec(test_range(&random, -.5, .5), test_range(&random, -.2, .2), -5), vec(0, 0, 1), 0 };
        Hit h;
        Attributes all, normals;
        if (!hit_of(&o->shape, &r, &h)) continue;
        hit_attributes(&h, &r, &all);
        hit_normals(&h, &r, &normals);
        CHECK(memcmp(&all.normal, &normals.normal, sizeof all.normal) == 0, "case %d", i);
        CHECK(memcmp(&all.shading_normal, &normals.shading_normal, sizeof all.normal) == 0, "case %d", i);
        CHECK(!all.is_without_uv && normals.is_without_uv, "case %d", i);
    }
}

static void a_copy_shares_geometry_and_nothing_else(void **state)
{
    (void)state;
    Object *o = object_new(arena, ball(vec(0, 0, 0), 1));
    o->texture = texture(), o->no_shadow = o->is_hollow = o->double_illuminate = o->has_uv_mapping = true;
    move(o, xform_translate(vec(5, 0, 0)));
    Object *c = object_copy(arena, o);
    assert_ptr_equal(c->child, o->child);
    assert_true(c->texture == o->texture && c->no_shadow && c->is_hollow && c->double_illuminate && c->has_uv_mapping);
    assert_true(c->shape.depth == 1);
    move(c, xform_translate(vec(5, 0, 0)));
    assert_true(o->placement.forward.m[3][0] == 5 && c->placement.forward.m[3][0] == 10);
}

/* ---- deep trees ---- */

/* A chain of unions of objects, each with its own placement, textures here and there; the truth is composed by hand. */
static void deep_trees_are_kept_within_a_hits_chain(void **state)
{
    (void)state;
    TestRandom random = test_random(4);
    for (int depth = 1; depth <= 20; depth++) {
        Object *o = object_new(arena, ball(vec(0, 0, 0), 1));
        Xform all = xform_identity(), texture_space = xform_identity();
        const Texture *expected = NULL;
        for (int i = 0; i < depth; i++) {
            if (i > 0) {
                Shape *const parts[] = { ball(vec(1e6, 0, 0), 1), &o->shape };
                o = object_new(arena, i % 3 == 2 ? &o->shape : union_new(arena, parts, 2));
            }
            Xform x = xform_rotate(vec(0, 0, 90 * test_int(&random, 0, 3)));
            x = xform_then(x, xform_translate(vec(test_int(&random, -3, 3), test_int(&random, -3, 3), 0)));
            if (i % 4 == 1) {
                o->texture = texture();
                o->texture_space = xform_identity();
                if (!expected) expected = o->texture, texture_space = xform_identity();
            }
            move(o, x);
            all = xform_then(all, x);
            if (expected) texture_space = xform_then(texture_space, x);
        }
        Vec3 centre = xform_point(&all, vec(0, 0, 0));
        Ray r = { vec_add(centre, vec(.5, .25, -5)), vec(0, 0, 1), 0 };
        Hit h;
        CHECK(hit_of(&o->shape, &r, &h), "depth %d", depth);
        CHECK_WITHIN(fabs(h.t - (5 - sqrt(1 - .3125))), 1e-13, "depth %d", depth);
        CHECK(h.n_objects <= HIT_MAX_OBJECTS && (depth > HIT_MAX_OBJECTS || h.n_objects == depth), "depth %d", depth);
        const Object *textured = hit_textured_object(&h);
        CHECK((textured ? textured->texture : NULL) == expected, "depth %d: another texture", depth);
        Vec3 p = ray_at(&r, h.t), q = hit_texture_point(&h, p);
        Vec3 truth = expected ? xform_unpoint(&texture_space, p) : p;
        CHECK_WITHIN(vec_length(vec_sub(q, truth)), 1e-13, "depth %d: texture point", depth);
        uint32_t n_others = 0;
        for (int i = 1; i < depth; i++) n_others += i % 3 != 2;
        CHECK(o->shape.n_primitives == n_others + 1 && h.index == n_others, "depth %d: index %u", depth, h.index);
        release_all(&o->shape);
    }
}

/* ---- unions ---- */

static void a_union_is_its_parts(void **state)
{
    (void)state;
    TestRandom random = test_random(5);
    enum { N = 60 };
    for (int i = 0; i < 30; i++) {
        Shape *parts[N];
        uint32_t n = (uint32_t)test_int(&random, 0, N);
        for (uint32_t k = 0; k < n; k++) {
            Solid s = any_solid(arena, &random, (SolidKind)test_int(&random, 0, k == 3 ? PLANE : TRIANGLE), .5);
            Object *o = object_new(arena, s.shape);
            move(o, xform_translate(vec_scale(any_point(&random), 5)));
            parts[k] = &o->shape;
        }
        Shape *u = union_new(arena, parts, n);
        assert_int_equal(u->n_primitives, n);
        for (int k = 0; k < 200; k++) {
            Ray r = { vec_scale(any_point(&random), 20), any_point(&random), 0 };
            if (test_int(&random, 0, 3) == 0) r.t_min = test_range(&random, 0, 9);
            Hit best = { .t = INFINITY }, h;
            Trace t = { 0 };
            uint32_t index = 0;
            for (uint32_t p = 0; p < n; p++)
                if (shape_hit(parts[p], &r, &best, &t)) index = p;
            bool is_hit = hit_of(u, &r, &h);
            CHECK(h.t == best.t && h.shape == best.shape && h.n_objects == best.n_objects, "case %d, ray %d", i, k);
            CHECK(!is_hit || h.index == index, "case %d, ray %d: index %u, not %u", i, k, h.index, index);
            CHECK(shape_blocks(u, &r, INFINITY, &t) == is_hit, "case %d, ray %d", i, k);
            CHECK(!is_hit || !shape_blocks(u, &r, h.t, &t), "case %d, ray %d", i, k);
        }
        shape_release(u);
    }
}

/* Boxes with a common face: the first of the list is seen, from wherever the search comes to them. */
static void of_surfaces_that_coincide_the_first_is_seen(void **state)
{
    (void)state;
    for (int order = 0; order < 2; order++)
        for (int way = -1; way <= 1; way += 2) {
            Shape *parts[40];
            for (int i = 0; i < 40; i++) parts[i] = box_shape_new(arena, vec(-1 - i, -1, 0), vec(1 + i, 1, 1));
            if (order) parts[39] = plane_new(arena, vec(0, 0, 1), 0);
            Shape *u = union_new(arena, parts, 40);
            Ray r = { vec(.3 * way, 0, -2), vec(0, 0, 1), 0 };
            Hit h;
            CHECK(hit_of(u, &r, &h) && h.t == 2 && h.index == 0, "index %u", h.index);
            ShapeTree *planes_first = shape_tree_build(arena, parts, NULL, 40, true);
            Hit best = { .t = INFINITY };
            Trace t = { 0 };
            CHECK(shape_tree_hit(planes_first, &r, 0, &best, &t) && best.t == 2, "hit");
            CHECK(best.index == (order ? 39u : 0u), "unbounded first: index %u", best.index);
            shape_release(u);
        }
}

static void a_union_builds_its_tree_when_it_is_reached(void **state)
{
    (void)state;
    Shape *const inner_parts[] = { ball(vec(0, 0, 0), 1), ball(vec(3, 0, 0), 1) };
    Shape *inner = union_new(arena, inner_parts, 2);
    Shape *const parts[] = { inner, ball(vec(0, 50, 0), 1) };
    Shape *outer = union_new(arena, parts, 2);
    Ray away = { vec(0, 50, -5), vec(0, 0, 1), 0 }, there = { vec(0, 0, -5), vec(0, 0, 1), 0 };
    Hit h;
    assert_true(hit_of(outer, &away, &h) && h.index == 2);
    assert_true(shape_was_prepared(outer) && !shape_was_prepared(inner));
    assert_true(hit_of(outer, &there, &h) && h.index == 0);
    assert_true(shape_was_prepared(inner));
    release_all(outer);
}

typedef struct { Shape shape; uint32_t among; } Listener;

static Box listener_bounds(const Shape *s)
{
    (void)s;
    return box_from(vec(0, 0, 0), vec(1, 1, 1));
}

static void listener_be_among(Shape *s, uint32_t n) { ((Listener *)s)->among = n; }

static const ShapeType listener_type = { .name = "listener", .bounds = listener_bounds, .be_among = listener_be_among };

static void parts_of_a_union_know_how_many_they_are_unless_they_are_moved(void **state)
{
    (void)state;
    Listener bare = { .among = 1 }, within = { .among = 1 }, moved = { .among = 1 };
    shape_init(&bare.shape, &listener_type), shape_init(&within.shape, &listener_type);
    shape_init(&moved.shape, &listener_type);
    Object *around = object_new(arena, &within.shape), *away = object_new(arena, &moved.shape);
    move(away, xform_translate(vec(1, 0, 0)));
    Shape *const two[] = { ball(vec(0, 0, 0), 1), ball(vec(3, 0, 0), 1) };
    Shape *const parts[] = { &bare.shape, &around->shape, &away->shape, union_new(arena, two, 2) };
    (void)union_new(arena, parts, 4);
    CHECK(bare.among == 5 && within.among == 5, "%u and %u of 5", bare.among, within.among);
    CHECK(moved.among == 1, "its tree is lent to nobody");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moved_object_is_hit_where_it_was_moved),
        cmocka_unit_test(hits_of_objects_lie_on_their_image_within_their_error),
        cmocka_unit_test(secondary_rays_leave_objects_behind),
        cmocka_unit_test(hit_and_blocks_agree_for_objects),
        cmocka_unit_test(the_innermost_texture_and_interior_count),
        cmocka_unit_test(textures_move_with_what_is_written_after_them),
        cmocka_unit_test(an_inverse_object_turns_its_normals_over),
        cmocka_unit_test(shapes_without_parameters_have_the_worlds_x_and_y),
        cmocka_unit_test(normals_are_the_same_without_uv),
        cmocka_unit_test(a_copy_shares_geometry_and_nothing_else),
        cmocka_unit_test(deep_trees_are_kept_within_a_hits_chain),
        cmocka_unit_test(a_union_is_its_parts),
        cmocka_unit_test(of_surfaces_that_coincide_the_first_is_seen),
        cmocka_unit_test(a_union_builds_its_tree_when_it_is_reached),
        cmocka_unit_test(parts_of_a_union_know_how_many_they_are_unless_they_are_moved),
    };
    return cmocka_run_group_tests(tests, make_arena, free_arena);
}
