#include "tests/solids.h"

#include "render/object.h"

#include <stdbool.h>

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

enum { CASES = 400, RAYS = 30 };

/* Runs a check for each kind of solid, at random sizes, with rays near it. */
typedef void (*Check)(const Solid *s, const Ray *r, TestRandom *random, const char *where);

static void for_all_solids(unsigned seed, double decades, Check check)
{
    for (int kind = 0; kind < N_SOLIDS; kind++) {
        TestRandom random = test_random(seed * 100 + (unsigned)kind);
        ArenaMark mark = arena_mark(arena);
        for (int i = 0; i < CASES; i++) {
            Solid s = any_solid(arena, &random, (SolidKind)kind, decades);
            CHECK(s.shape, "%s, case %d", solid_names[kind], i);
            for (int k = 0; k < RAYS; k++) {
                Ray r = any_ray_at(&random, &s);
                char where[80];
                snprintf(where, sizeof where, "seed %u: %s, case %d, ray %d", seed, solid_names[kind], i, k);
                check(&s, &r, &random, where);
            }
            arena_reset(arena, mark);
        }
    }
}

static bool hit_of(const Shape *s, const Ray *r, Hit *h)
{
    Trace t = { 0 };
    *h = (Hit){ .t = INFINITY };
    return shape_hit(s, r, h, &t);
}

/* How far, at most, the point at t of the ray may seem to lie from the surface for no reason but extended precision. */
static Real noise(const Solid *s, const Ray *r, Real t)
{
    return 0x1p-60L * (vec_length(r->origin) + t * vec_length(r->dir) + vec_length(s->centre) + s->size);
}

static void check_on_the_surface(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    Hit h;
    (void)random;
    if (!hit_of(s->shape, r, &h)) return;
    Real distance = solid_distance(s, real_at(r, h.t)), bound = (Real)h.t_error * vec_length(r->dir) + noise(s, r, h.t);
    CHECK(h.t > 0 && h.shape == s->shape && h.n_objects == 0 && h.index == 0, "%s", where);
    CHECK_WITHIN((double)distance, (double)bound, "%s, size %g, t %g", where, s->size, h.t);
    Box b = box_expand(shape_bounds(s->shape), (double)bound);
    Real3 p = real_at(r, h.t);
    CHECK(box_contains(b, vec((double)p.x, (double)p.y, (double)p.z)), "%s: outside the bounds", where);
}

static void hits_lie_on_the_surface_within_their_error(void **state)
{
    (void)state;
    for_all_solids(1, 8, check_on_the_surface);
}

/* The error stays small beside what the numbers themselves allow: 2^-53 of the distances involved. */
static void check_error_is_small(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    Hit h;
    (void)random;
    if (s->kind == TRIANGLE || !hit_of(s->shape, r, &h)) return;    /* slivers have errors of their own */
    double reach = vec_length(r->origin) + h.t * vec_length(r->dir) + s->size + vec_length(s->centre), steep = 1;
    if (s->kind == CONE || s->kind == OPEN_CONE || s->kind == SHARP_CONE)
        steep = 1 + (double)(fabsl(s->profile[0][0] - s->profile[1][0]) / s->height);
    CHECK_WITHIN(h.t_error * vec_length(r->dir), 64 * 0x1p-53 * reach * steep, "%s", where);
}

static void the_error_is_a_few_roundings(void **state)
{
    (void)state;
    for_all_solids(2, 8, check_error_is_small);
}

/* Between the origin and the hit, or all along a ray without hit, the ray stays on one side. */
static void check_nothing_is_missed(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    Hit h;
    if (!solid_has_inside(s)) return;
    bool is_hit = hit_of(s->shape, r, &h), side = solid_inside(s, real3(r->origin));
    double middle = vec_length(vec_sub(s->centre, r->origin)), length = vec_length(r->dir);
    double reach = (middle + 2 * s->size) / length, from = fmax(0, (middle - 2 * s->size) / length);
    Real clear = 1e-9L * (s->size + middle);
    if (solid_distance(s, real3(r->origin)) < clear) return;
    for (int i = 0; i < 60; i++) {
        double t = test_range(random, from, reach);
        if (is_hit && t >= h.t) continue;
        Real3 p = real_at(r, t);
        if (solid_distance(s, p) < clear) continue;
        CHECK(solid_inside(s, p) == side, "%s: crossed before %g, hit %d at %g", where, t, is_hit, h.t);
    }
}

static void no_ray_crosses_a_surface_without_a_hit(void **state)
{
    (void)state;
    for_all_solids(3, 8, check_nothing_is_missed);
}

static void check_blocks(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    Hit h;
    Trace t = { 0 };
    Ray later = *r;
    bool is_hit = hit_of(s->shape, r, &h);
    CHECK(shape_blocks(s->shape, r, INFINITY, &t) == is_hit, "%s", where);
    if (!is_hit) return;
    CHECK(!shape_blocks(s->shape, r, h.t, &t), "%s: the interval is open", where);
    CHECK(shape_blocks(s->shape, r, nextafter(h.t, INFINITY), &t), "%s: just beyond the hit", where);
    CHECK(!shape_blocks(s->shape, r, h.t * test_unit(random), &t), "%s: before the hit", where);
    later.t_min = h.t;
    Hit second;
    CHECK(shape_blocks(s->shape, &later, INFINITY, &t) == hit_of(s->shape, &later, &second), "%s: from the hit on", where);
    CHECK(!hit_of(s->shape, &later, &second) || second.t > h.t, "%s: second %g, first %g", where, second.t, h.t);
    Hit best = { .t = h.t, .leaf = 77 };
    CHECK(!shape_hit(s->shape, r, &best, &t) && best.t == h.t && best.leaf == 77, "%s: a miss must touch nothing", where);
}

static void hit_and_blocks_agree(void **state)
{
    (void)state;
    for_all_solids(4, 8, check_blocks);
}

/* The normal is the gradient of the distance, where it has one. */
static void check_normal(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    Hit h;
    (void)random;
    if (!hit_of(s->shape, r, &h)) return;
    Attributes at = { .is_without_uv = false };
    s->shape->type->attributes(s->shape, r, &h, &at);
    CHECK_WITHIN(fabs(vec_length(at.normal) - 1), 4 * 0x1p-53, "%s", where);
    Real step = 1e-4L * s->size, far;
    Real3 p = real_at(r, h.t), n = real3(at.normal);
    if (s->kind == THIN_TORUS) step = 1e-2L * s->radius;
    /* one step along the normal is one step away from the surface, on one side at least (beside an edge on one alone) */
    far = fmaxl(solid_distance(s, real_add(p, real_scale(n, step))), solid_distance(s, real_sub(p, real_scale(n, step))));
    CHECK_WITHIN((double)fabsl(far - step), (double)(1e-3L * step + h.t_error * vec_length(r->dir)), "%s", where);
}

static void normals_point_straight_away(void **state)
{
    (void)state;
    for_all_solids(5, 8, check_normal);
}

/* From a point that is set off by hit_offset, to either side: a ray from outside must enter first, one from inside leave
 * first. A ray that met its own starting point again would do the contrary. */
static void check_no_self_hit(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    Hit h, second;
    if (!hit_of(s->shape, r, &h)) return;
    Attributes at = { .is_without_uv = false };
    s->shape->type->attributes(s->shape, r, &h, &at);
    Vec3 point = ray_at(r, h.t);
    for (int way = -1; way <= 1; way += 2) {
        Vec3 n = vec_scale(at.normal, way), dir = vec_normalize(any_point(random));
        if (vec_dot(dir, n) < 0) dir = vec_neg(dir);
        if (test_int(random, 0, 3) == 0) dir = vec_add(dir, vec_scale(n, -.9999 * vec_dot(dir, n)));      /* grazing */
        Ray next = { vec_add(point, vec_scale(n, hit_offset(&h, r))), vec_scale(dir, any_size(random, 3)), 0 };
        if (!hit_of(s->shape, &next, &second)) continue;
        Attributes other = { .is_without_uv = false };
        s->shape->type->attributes(s->shape, &next, &second, &other);
        if (s->kind == SPINDLE && second.t * vec_length(next.dir) > 1e-3 * s->size) continue;   /* the other sheet */
        double facing = way * vec_dot(other.normal, dir);
        bool is_flat = s->kind == DISC || s->kind == TRIANGLE || s->kind == PLANE;
        CHECK(!is_flat, "%s: %s of itself, t %g", where, way > 0 ? "front" : "back", second.t);
        CHECK(facing < 1e-3, "%s: from %s, offset %g, t %g, facing %g", where, way > 0 ? "outside" : "inside",
              hit_offset(&h, r), second.t * vec_length(next.dir), facing);
    }
}

static void secondary_rays_do_not_hit_their_own_surface(void **state)
{
    (void)state;
    for_all_solids(6, 8, check_no_self_hit);
}

/* An instance, scaled and moved, hits where the map of its surface is. */
static void check_instance(const Solid *s, const Ray *r, TestRandom *random, const char *where)
{
    static const double scales[] = { 2, 1e6, 1e-6 };
    double scale = scales[test_int(random, 0, 2)];
    Object *o = object_new(arena, s->shape);
    Xform grow = xform_scale(vec(scale, scale, scale));
    Xform move = xform_translate(vec_scale(any_point(random), scale * s->size));
    object_transform(o, &grow);
    object_transform(o, &move);
    Ray world = { xform_point(&o->placement, r->origin), xform_vector(&o->placement, r->dir), 0 };
    Hit h, plain;
    if (!hit_of(&o->shape, &world, &h)) return;
    Real3 p = real_sub(real_at(&world, h.t), (Real3){ move.forward.m[3][0], move.forward.m[3][1], move.forward.m[3][2] });
    Real distance = scale * solid_distance(s, real_scale(p, 1 / (Real)scale));
    Real bound = (Real)h.t_error * vec_length(world.dir) + scale * noise(s, r, h.t);
    CHECK_WITHIN((double)distance, (double)bound, "%s, scaled by %g", where, scale);
    CHECK(h.n_objects == 1 && h.objects[0] == o && h.shape == s->shape, "%s: the chain", where);
    if (hit_of(s->shape, r, &plain) && fabs(plain.t - h.t) < 1e-3 * plain.t)
        CHECK_WITHIN(fabs(plain.t - h.t), 1e-6 * plain.t, "%s, scaled by %g", where, scale);
}

static void instances_hit_where_their_image_is(void **state)
{
    (void)state;
    for_all_solids(7, 8, check_instance);
}

/* ---- single shapes against formulas ---- */

static double t_of(const Shape *s, Vec3 origin, Vec3 dir)
{
    Hit h;
    Ray r = { origin, dir, 0 };
    return hit_of(s, &r, &h) ? h.t : INFINITY;
}

static Vec3 normal_of(const Shape *s, Vec3 origin, Vec3 dir)
{
    Hit h;
    Ray r = { origin, dir, 0 };
    CHECK(hit_of(s, &r, &h), "no hit");
    Attributes at = { .is_without_uv = false };
    s->type->attributes(s, &r, &h, &at);
    return at.normal;
}

static void check_vec(Vec3 a, Vec3 b, double bound)
{
    CHECK_WITHIN(vec_max_abs(vec_sub(a, b)), bound, "%g %g %g", a.x, a.y, a.z);
}

static void a_sphere_is_hit_in_front_and_from_inside(void **state)
{
    (void)state;
    Shape *s = sphere_new(arena, vec(0, 0, 0), 2);
    assert_true(t_of(s, vec(0, 0, -5), vec(0, 0, 1)) == 3);
    assert_true(t_of(s, vec(0, 0, -5), vec(0, 0, .5)) == 6);        /* t is in units of dir */
    assert_true(t_of(s, vec(0, 0, 0), vec(0, 4, 0)) == .5);
    assert_true(t_of(s, vec(0, 0, -5), vec(0, 0, -1)) == INFINITY);
    CHECK_WITHIN(fabs(t_of(s, vec(0, 2, -5), vec(0, 0, 1)) - 5), 1e-15, "a tangent");
    assert_true(t_of(s, vec(0, 2.0001, -5), vec(0, 0, 1)) == INFINITY);
    CHECK_WITHIN(fabs(t_of(s, vec(0, 0, -1e9), vec(0, 0, 1)) - (1e9 - 2)), 1e-6, "from far away");
    assert_true(t_of(s, vec(0, 1.999999, -1e9), vec(0, 0, 1)) < 1e9);
    assert_true(t_of(s, vec(0, 2.000001, -1e9), vec(0, 0, 1)) == INFINITY);
    assert_null(sphere_new(arena, vec(0, 0, 0), 0));
    assert_null(sphere_new(arena, vec(0, NAN, 0), 1));
}

static void a_plane_is_below_its_normal(void **state)
{
    (void)state;
    Shape *p = plane_new(arena, vec(0, 3, 0), 2);
    assert_true(t_of(p, vec(7, 5, 1), vec(0, -1, 0)) == 3);
    assert_true(t_of(p, vec(7, 5, 1), vec(1, 0, 0)) == INFINITY);
    assert_true(t_of(p, vec(7, 2, 1), vec(1, 0, 0)) == INFINITY);   /* within the plane */
    assert_true(p->type->inside(p, vec(9, 1.5, 0)) && !p->type->inside(p, vec(9, 2.5, 0)));
    assert_false(box_is_finite(shape_bounds(p)));
    assert_null(plane_new(arena, vec(0, 0, 0), 1));
}

static void a_box_shows_the_face_that_is_met(void **state)
{
    (void)state;
    Shape *b = box_shape_new(arena, vec(1, 2, 3), vec(-1, -2, -3));
    assert_true(t_of(b, vec(0, 0, -5), vec(0, 0, 1)) == 2);
    assert_true(t_of(b, vec(0, 0, 0), vec(0, -1, 0)) == 2);
    check_vec(normal_of(b, vec(0, 0, 0), vec(0, -1, 0)), vec(0, -1, 0), 0);
    check_vec(normal_of(b, vec(9, 1, 1), vec(-1, 0, 0)), vec(1, 0, 0), 0);
    assert_true(t_of(b, vec(1, 0, -5), vec(0, 0, 1)) == 2);         /* along a face, which belongs to the box */
    assert_true(t_of(b, vec(1, 2, -5), vec(-0., 0., 1)) == 2);      /* along an edge */
    assert_true(t_of(b, vec(1.0000001, 0, -5), vec(0, 0, 1)) == INFINITY);
    check_vec(normal_of(b, vec(3, 3, 0), vec(-2, -1, 0)), vec(1, 0, 0), 0);   /* an edge: the face that is faced more */
    check_vec(normal_of(b, vec(2, 4, 0), vec(-1, -2, 0)), vec(0, 1, 0), 0);
}

static void a_box_unfolds_to_povrays_cross(void **state)
{
    (void)state;
    Shape *b = box_shape_new(arena, vec(0, 0, 0), vec(1, 1, 1));
    static const struct { Vec3 dir; Vec2 uv; } faces[6] = {                 /* through (.25, .5, .75) of each face */
        { { 1, 0, 0 }, { .75 / 4, .5 } }, { { -1, 0, 0 }, { .75 - .75 / 4, .5 } },
        { { 0, 1, 0 }, { .25 + .25 / 4, .25 } }, { { 0, -1, 0 }, { .25 + .25 / 4, .75 } },
        { { 0, 0, 1 }, { 1 - .25 / 4, .5 } }, { { 0, 0, -1 }, { .25 + .25 / 4, .5 } },
    };
    for (int i = 0; i < 6; i++) {
        Ray r = { vec_sub(vec(.25, .5, .75), vec_scale(faces[i].dir, 5)), faces[i].dir, 0 };
        Hit h;
        Attributes at = { .is_without_uv = false };
        assert_true(hit_of(b, &r, &h));
        b->type->attributes(b, &r, &h, &at);
        CHECK_WITHIN(vec2_length(vec2_sub(at.uv, faces[i].uv)), 1e-15, "face %d: %g %g", i, at.uv.x, at.uv.y);
    }
}

static void cylinders_and_cones_have_caps_unless_open(void **state)
{
    (void)state;
    Shape *closed = cylinder_new(arena, vec(0, 0, 0), vec(0, 4, 0), 1, false);
    Shape *open = cylinder_new(arena, vec(0, 0, 0), vec(0, 4, 0), 1, true);
    assert_true(t_of(closed, vec(.5, 9, 0), vec(0, -1, 0)) == 5 && t_of(open, vec(.5, 9, 0), vec(0, -1, 0)) == INFINITY);
    check_vec(normal_of(closed, vec(.5, 9, 0), vec(0, -1, 0)), vec(0, 1, 0), 0);
    check_vec(normal_of(closed, vec(.5, -9, 0), vec(0, 1, 0)), vec(0, -1, 0), 0);
    assert_true(t_of(closed, vec(-5, 2, 0), vec(1, 0, 0)) == 4 && t_of(open, vec(-5, 2, 0), vec(1, 0, 0)) == 4);
    assert_true(t_of(open, vec(0, 2, 0), vec(1, 0, 0)) == 1);
    assert_true(t_of(closed, vec(0, 2, 0), vec(0, 1, 0)) == 2 && t_of(open, vec(0, 2, 0), vec(0, 1, 0)) == INFINITY);
    check_vec(normal_of(open, vec(-5, 2, 0), vec(1, 0, 0)), vec(-1, 0, 0), 0);
    Shape *cone = cone_new(arena, vec(0, 0, 0), 2, vec(0, 2, 0), 0, false);
    CHECK_WITHIN(fabs(t_of(cone, vec(-5, 1, 0), vec(1, 0, 0)) - 4), 1e-15, "the side");
    assert_true(t_of(cone, vec(-5, 3, 0), vec(1, 0, 0)) == INFINITY);          /* above the apex: not the mirror image */
    check_vec(normal_of(cone, vec(-5, 1, 0), vec(1, 0, 0)), vec(-sqrt(.5), sqrt(.5), 0), 1e-15);
    CHECK_WITHIN(fabs(t_of(cone, vec(0, 9, 0), vec(0, -1, 0)) - 7), 1e-7, "the apex, from above");
    CHECK_WITHIN(fabs(t_of(cone, vec(-1.5, .25, 0), vec(1, 1, 0)) - 1.625), 1e-15, "parallel to the other side");
    assert_null(cylinder_new(arena, vec(1, 1, 1), vec(1, 1, 1), 1, false));
    assert_null(cone_new(arena, vec(0, 0, 0), 0, vec(0, 1, 0), 0, false));
}

/* Many rays at the rim of a closed cylinder: the solid is convex, so a ray that passes within is seen to enter it. */
static void the_rim_of_a_cylinder_is_closed(void **state)
{
    (void)state;
    TestRandom r = test_random(8);
    Shape *c = cylinder_new(arena, vec(0, 0, 0), vec(0, 1, 0), 1, false);
    for (int i = 0; i < 100000; i++) {
        double angle = test_range(&r, 0, 6.3);
        Vec3 rim = vec(cos(angle), 1, sin(angle)), inner = vec(.5 * cos(angle), .5, .5 * sin(angle));
        Vec3 origin = vec_add(rim, vec_scale(vec_sub(rim, inner), test_range(&r, .1, 9)));
        double t = t_of(c, origin, vec_sub(rim, origin));
        CHECK_WITHIN(fabs(t - 1), 1e-14, "case %d", i);
    }
}

static void a_disc_has_a_hole(void **state)
{
    (void)state;
    Shape *d = disc_new(arena, vec(0, 0, 1), vec(0, 0, -9), 3, 1);
    assert_true(t_of(d, vec(2, 0, 0), vec(0, 0, 1)) == 1 && t_of(d, vec(0, -3, 0), vec(0, 0, 1)) == 1);
    assert_true(t_of(d, vec(.5, 0, 0), vec(0, 0, 1)) == INFINITY && t_of(d, vec(0, 3.1, 0), vec(0, 0, 1)) == INFINITY);
    assert_true(t_of(d, vec(-5, 0, 1), vec(1, 0, 0)) == INFINITY);               /* edge on */
    check_vec(normal_of(d, vec(2, 0, 5), vec(0, 0, -1)), vec(0, 0, -1), 0);
    assert_null(disc_new(arena, vec(0, 0, 0), vec(0, 0, 0), 1, 0));
}

/* Through the tube at a given place: the four crossings of a line through the axis are known. */
static void a_torus_is_crossed_four_times(void **state)
{
    (void)state;
    for (int decade = -8; decade <= 8; decade++) {
        double m = pow(10, decade);
        Shape *s = torus_new(arena, 3 * m, m);
        const double expected[4] = { 6 * m, 8 * m, 12 * m, 14 * m };
        Ray r = { vec(-10 * m, 0, 0), vec(1, 0, 0), 0 };
        Hit h;
        for (int i = 0; i < 4; i++) {
            CHECK(hit_of(s, &r, &h), "size %g: crossing %d", m, i);
            CHECK_WITHIN(fabs(h.t - expected[i]), 1e-14 * m, "size %g: crossing %d", m, i);
            r.t_min = h.t;
        }
        CHECK(!hit_of(s, &r, &h), "size %g: a fifth, %g", m, h.t);
        assert_true(t_of(s, vec(0, 5 * m, 0), vec(0, -1, 0)) == INFINITY);             /* through the hole */
        CHECK_WITHIN(fabs(t_of(s, vec(3 * m, 5 * m, 0), vec(0, -1, 0)) - 4 * m), 1e-14 * m, "size %g", m);
        check_vec(normal_of(s, vec(3 * m, 5 * m, 0), vec(0, -1, 0)), vec(0, 1, 0), 1e-15);
    }
    assert_null(torus_new(arena, 1, 0));
}

static void torus_and_sphere_have_povrays_uv(void **state)
{
    (void)state;
    static const double PI = 3.14159265358979323846;
    Attributes at = { .is_without_uv = false };
    Hit h;
    Shape *ball = sphere_new(arena, vec(1, 2, 3), 2), *torus = torus_new(arena, 3, 1);
    Ray r = { vec(1 + 5 * cos(.7) * cos(2.5), 2 + 5 * sin(.7), 3 + 5 * cos(.7) * sin(2.5)), vec(0, 0, 0), 0 };
    r.dir = vec_sub(vec(1, 2, 3), r.origin);
    assert_true(hit_of(ball, &r, &h));
    ball->type->attributes(ball, &r, &h, &at);
    CHECK_WITHIN(fabs(at.uv.x - 2.5 / (2 * PI)) + fabs(at.uv.y - .5 - .7 / PI), 1e-14, "sphere: %g %g", at.uv.x, at.uv.y);
    Vec3 middle = vec(3 * cos(1.1), 0, 3 * sin(1.1)), out = vec(cos(1.1) * cos(.6), sin(.6), sin(1.1) * cos(.6));
    r = (Ray){ vec_add(middle, vec_scale(out, 4)), vec_neg(out), 0 };
    assert_true(hit_of(torus, &r, &h));
    torus->type->attributes(torus, &r, &h, &at);
    CHECK_WITHIN(fabs(at.uv.x - (1 - (1.1 + PI) / (2 * PI))) + fabs(at.uv.y - (.6 + PI) / (2 * PI)), 1e-14, "torus");
}

static void a_triangle_is_hit_from_both_sides(void **state)
{
    (void)state;
    const Vec3 p[3] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 } };
    Shape *t = triangle_new(arena, p);
    assert_true(t_of(t, vec(.5, .5, -3), vec(0, 0, 1)) == 3 && t_of(t, vec(.5, .5, 3), vec(0, 0, -1)) == 3);
    assert_true(t_of(t, vec(1.5, 1.5, -3), vec(0, 0, 1)) == INFINITY && t_of(t, vec(-1, .5, 0), vec(1, 0, 0)) == INFINITY);
    check_vec(normal_of(t, vec(.5, .5, -3), vec(0, 0, 1)), vec(0, 0, -1), 0);   /* (P3 - P1) x (P2 - P1) */
    const Vec3 line[3] = { { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } };
    assert_null(triangle_new(arena, line));
}

/* Two triangles share an edge: a ray through the edge hits one of them at least, wherever it comes from. */
static void two_triangles_leave_no_gap(void **state)
{
    (void)state;
    TestRandom r = test_random(9);
    for (int i = 0; i < 100000; i++) {
        Vec3 a = any_point(&r), b = any_point(&r), c = any_point(&r), d = any_point(&r), e = vec_sub(b, a);
        if (vec_dot(vec_cross(e, vec_sub(c, a)), vec_cross(e, vec_sub(d, a))) > 0) d = vec_sub(vec_scale(a, 2), d);
        const Vec3 one[3] = { a, b, c }, two[3] = { b, a, d };
        Vec3 origin = vec_scale(any_point(&r), 10), on = vec_add(a, vec_scale(e, test_unit(&r)));
        Vec3 dir = vec_sub(on, origin), side = vec_cross(dir, e);
        if (vec_dot(side, vec_sub(c, a)) * vec_dot(side, vec_sub(d, a)) > 0) continue;     /* the edge is a silhouette */
        ArenaMark mark = arena_mark(arena);
        Shape *first = triangle_new(arena, one), *second = triangle_new(arena, two);
        CHECK(t_of(first, origin, dir) < 2 || t_of(second, origin, dir) < 2, "case %d", i);
        arena_reset(arena, mark);
    }
}

/* POV-Ray: normalize(sum of weight times normal). */
static void smooth_triangles_blend_their_normals(void **state)
{
    (void)state;
    const Vec3 p[3] = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 } }, n[3] = { { 0, 0, -1 }, { 2, 0, -2 }, { 0, 3, -3 } };
    Shape *s = smooth_triangle_new(arena, p, n);
    Ray r = { vec(1, 2, -5), vec(0, 0, 1), 0 };
    Hit h;
    Attributes at = { .is_without_uv = false };
    assert_true(hit_of(s, &r, &h) && h.u == .25 && h.v == .5);
    s->type->attributes(s, &r, &h, &at);
    double q = sqrt(.5);
    check_vec(at.shading_normal, vec_normalize(vec(.25 * q, .5 * q, -.25 - .75 * q)), 1e-15);
    check_vec(at.normal, vec(0, 0, -1), 0);
    const Vec3 torn[3] = { { 0, 0, -1 }, { 0, 0, 1 }, { 0, 0, -1 } };
    assert_null(smooth_triangle_new(arena, p, torn));
}

static void primitives_count_their_tests(void **state)
{
    (void)state;
    TestRandom random = test_random(10);
    for (int kind = 0; kind < N_SOLIDS; kind++) {
        Solid s = any_solid(arena, &random, (SolidKind)kind, 1);
        Ray r = any_ray_at(&random, &s);
        Trace t = { 0 };
        Hit h = { .t = INFINITY };
        shape_hit(s.shape, &r, &h, &t);
        shape_blocks(s.shape, &r, INFINITY, &t);
        CHECK(t.counters.primitive_tests == 2, "%s: %d", solid_names[kind], (int)t.counters.primitive_tests);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_lie_on_the_surface_within_their_error),
        cmocka_unit_test(the_error_is_a_few_roundings),
        cmocka_unit_test(no_ray_crosses_a_surface_without_a_hit),
        cmocka_unit_test(hit_and_blocks_agree),
        cmocka_unit_test(normals_point_straight_away),
        cmocka_unit_test(secondary_rays_do_not_hit_their_own_surface),
        cmocka_unit_test(instances_hit_where_their_image_is),
        cmocka_unit_test(a_sphere_is_hit_in_front_and_from_inside),
        cmocka_unit_test(a_plane_is_below_its_normal),
        cmocka_unit_test(a_box_shows_the_face_that_is_met),
        cmocka_unit_test(a_box_unfolds_to_povrays_cross),
        cmocka_unit_test(cylinders_and_cones_have_caps_unless_open),
        cmocka_unit_test(the_rim_of_a_cylinder_is_closed),
        cmocka_unit_test(a_disc_has_a_hole),
        cmocka_unit_test(a_torus_is_crossed_four_times),
        cmocka_unit_test(torus_and_sphere_have_povrays_uv),
        cmocka_unit_test(a_triangle_is_hit_from_both_sides),
        cmocka_unit_test(two_triangles_leave_no_gap),
        cmocka_unit_test(smooth_triangles_blend_their_normals),
        cmocka_unit_test(primitives_count_their_tests),
    };
    return cmocka_run_group_tests(tests, make_arena, free_arena);
}
