/* Tiles as their pole sees them: the cone holds the tile, and what it lets rays leave out is none of their roots. The truth
 * are points of the patch, and rays made to go through one of them and the pole. */
#include "test.h"

#include "nurbs/pole_cone.h"
#include "render/shapes.h"

#include <string.h>

typedef struct { Patch *patch; TilePlace place; PoleCone cone; bool has_cone; } PoleTile;

static Vec3 random_direction(TestRandom *r)
{
    for (;;) {
        Vec3 d = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
        if (vec_length2(d) > 0.01 && vec_length2(d) < 1) return vec_normalize(d);
    }
}

/* A wedge between two lines from a point, bent by `bump`: its side 0, 1, 2 or 3 (s = 0, s = 1, t = 0, t = 1) is the pole. */
static Patch *random_wedge(Arena *a, TestRandom *r, int side, double bump, double ratio)
{
    int k_u = test_int(r, 2, 5), k_v = test_int(r, 2, 5);
    Vec4 p[25];
    Vec3 pole = vec_scale(random_direction(r), pow(10, test_range(r, -3, 3)));
    Vec3 x = random_direction(r), y = vec_normalize(vec_cross(x, random_direction(r))), z = vec_cross(x, y);
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i < k_u; i++) {
            double s = i / (k_u - 1.0), t = j / (k_v - 1.0);
            double far = side == 0 ? s : side == 1 ? 1 - s : side == 2 ? t : 1 - t, angle = (side < 2 ? t : s) - .5;
            Vec3 at = vec_add(vec_scale(x, far * cos(angle)), vec_scale(y, far * sin(angle)));
            at = vec_add(vec_add(at, vec_scale(z, far * bump * test_range(r, -1, 1))), pole);
            p[j * k_u + i] = vec4_weighted(vec4(at.x, at.y, at.z, pow(ratio, test_unit(r))));
        }
    Patch *patch = ARENA_NEW(a, Patch);
    patch_make(a, k_u, k_v, (WideNet){ p, NULL }, 0x1p-50 * vec_length(pole), (TrimRect){ 0, 1, 0, 1 }, patch);
    return patch;
}

/* Some part of it that has the pole on it. */
static PoleTile random_pole_tile(Arena *a, TestRandom *r)
{
    int side = test_int(r, 0, 3);
    PoleTile f = { .patch = random_wedge(a, r, side, pow(10, test_range(r, -3, 0)), test_int(r, 0, 1) ? 1 : 8) };
    double far = ldexp(1, -test_int(r, 0, 5)), wide = ldexp(1, -test_int(r, 0, 4)), from = wide * test_int(r, 0, 1);
    if (wide == 1) from = 0;
    double start = side % 2 ? 1 - far : 0;
    f.place = side < 2 ? (TilePlace){ start, from, far, wide } : (TilePlace){ from, start, wide, far };
    Vec4 net[25];
    tile_net(f.patch, f.place, net);
    f.has_cone = pole_cone_make(f.patch, f.place, net, &f.cone);
    return f;
}

/* A point of the tile, more often than not near the pole; about the patch's origin. */
static Vec3 random_point(const PoleTile *f, TestRandom *r)
{
    TilePlace at = f->place;
    double far = pow(10, -test_range(r, 0, test_int(r, 0, 8))), along = test_unit(r);
    bool is_s = f->patch->collapsed & 3, is_end = f->patch->collapsed & 10;
    double s = at.s0 + at.ds * (!is_s ? along : is_end ? 1 - far : far);
    double t = at.t0 + at.dt * (is_s ? along : is_end ? 1 - far : far);
    Vec4 value, by_s, by_t;
    patch_evaluate(f->patch, s, t, &value, &by_s, &by_t);
    return vec4_project(value);
}

static void the_cone_holds_the_tile(void **state)
{
    Arena *a = arena_new();
    int n_cones = 0;
    (void)state;
    for (unsigned seed = 0; seed < 3000; seed++) {
        TestRandom r = test_random(seed);
        PoleTile f = random_pole_tile(a, &r);
        n_cones += f.has_cone;
        for (int n = 0; n < 50 && f.has_cone; n++) {
            Vec3 chord = vec_sub(random_point(&f, &r), f.cone.pole);
            double outside = f.cone.cosine * vec_length(chord) - vec_dot(tile_vec(f.cone.axis), chord);
            CHECK_WITHIN(double_max(outside, 0), 4 * patch_rounding(f.patch, vec(0, 0, 0)), "seed %u", seed);
        }
    }
    CHECK(n_cones > 2500, "%d cones of 3000", n_cones);
    arena_free(a);
}

/* A ray through the pole and another point of the tile, which ends or begins at the pole: the other point is a root within
 * its reach, unless it is as near to the pole as the rounding. */
static void what_is_left_out_of_a_ray_through_the_pole_has_no_other_root(void **state)
{
    Arena *a = arena_new();
    (void)state;
    for (unsigned seed = 0; seed < 3000; seed++) {
        TestRandom r = test_random(seed);
        PoleTile f = random_pole_tile(a, &r);
        for (int n = 0; n < 50 && f.has_cone; n++) {
            Vec3 other = random_point(&f, &r), chord = vec_sub(other, f.cone.pole);
            bool ends = test_int(&r, 0, 1);
            double before = pow(10, test_range(&r, -3, 3)), length = vec_length(chord);
            Vec3 d = vec_scale(vec_normalize(chord), ends ? -1 : 1);
            Vec3 from = vec_sub(vec_add(f.patch->origin, ends ? other : f.cone.pole), vec_scale(d, before));
            double pole = ends ? before + length : before;
            double rounding = patch_rounding(f.patch, vec_sub(from, f.patch->origin));
            PatchRay ray = patch_ray(from, d, ends ? 0 : pole * (1 + 1e-15) + rounding, ends ? pole : INFINITY);
            if (length < 1000 * rounding) continue;
            CHECK(!pole_cone_is_out_of_reach(&f.cone, f.patch, &ray), "seed %u: %g away", seed, length);
        }
    }
    arena_free(a);
}

/* Of the tiles round the pole of a sphere nearly all are left out, once its root is known; rays to it meet it all the same,
 * and so do those that come from within. */
static void rays_meet_the_pole_of_a_sphere_once(void **state)
{
    static const double knots_u[] = { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 }, knots_v[] = { 0, 0, 0, 1, 1, 2, 2, 2 };
    static const double x[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, y[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
    static const double radius[5] = { 0, 1, 1, 1, 0 }, z[5] = { -1, -1, 0, 1, 1 };
    Arena *a = arena_new();
    Vec4 p[45];
    Trace t;
    (void)state;
    memset(&t, 0, sizeof t);
    t.scratch = arena_new();
    for (int j = 0; j < 5; j++)
        for (int i = 0; i < 9; i++)
            p[j * 9 + i] = vec4(radius[j] * x[i], radius[j] * y[i], z[j], (i % 2 ? M_SQRT1_2 : 1) * (j % 2 ? M_SQRT1_2 : 1));
    SurfaceDesc desc = { .order_u = 3, .order_v = 3, .n_u = 9, .n_v = 5, .knots_u = knots_u, .knots_v = knots_v,
                         .points = p };
    NurbsError error;
    Shape *sphere = nurbs_shape_new(a, &desc, &(NurbsOptions){ .method = NURBS_METHOD_CERTAIN }, &error, NULL, 0, NULL);
    assert_non_null(sphere);
    TestRandom r = test_random(1);
    enum { RAYS = 2000 };
    for (unsigned n = 0; n < RAYS; n++) {
        Vec3 pole = vec(0, 0, n % 2 ? 1 : -1), d = random_direction(&r);
        double before = test_range(&r, 2, 9), chord = -2 * vec_dot(pole, d);   /* to where it leaves, or came in if < 0 */
        Ray ray = { vec_sub(pole, vec_scale(d, before)), d, 0 };
        Hit hit = { .t = INFINITY };
        t.seed = n + 1;
        CHECK(shape_hit(sphere, &ray, &hit, &t), "ray %u misses the pole", n);
        CHECK_WITHIN(fabs(hit.t - double_min(before, before + chord)), 1e-13 / fabs(chord), "ray %u", n);
        ray.t_min = double_min(before, before + chord) + 1e-9, hit.t = INFINITY;
        CHECK(shape_hit(sphere, &ray, &hit, &t), "ray %u from within misses the pole", n);
        CHECK_WITHIN(fabs(hit.t - double_max(before, before + chord)), 1e-13 / fabs(chord), "ray %u from within", n);
    }
    CHECK(t.counters.nurbs_tests < 5 * 2 * RAYS, "%lu tests", (unsigned long)t.counters.nurbs_tests);
    shape_release(sphere);
    arena_free(t.scratch);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cone_holds_the_tile),
        cmocka_unit_test(what_is_left_out_of_a_ray_through_the_pole_has_no_other_root),
        cmocka_unit_test(rays_meet_the_pole_of_a_sphere_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
