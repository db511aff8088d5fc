/* `method certain` within one patch: bounds that bound, roots that are all found. The truth is a dense sample of the patch
 * for the bounds, the plain clipping for the frame's shortcut, and rays made from points of the patch for the roots. */
#include "tests/tiles.h"

#include "nurbs/clip.h"
#include "nurbs/doubt.h"
#include "nurbs/nurbs.h"
#include "render/hit_list.h"

static void bernstein_polynomials_sum_to_one_and_their_derivatives_to_zero(void **state)
{
    (void)state;
    TestRandom r = test_random(1);
    for (int k = 2; k <= NURBS_MAX_ORDER; k++) {
        double x = test_unit(&r), b[NURBS_MAX_ORDER], d[NURBS_MAX_ORDER], sum = 0, slope = 0, mean = 0;
        bernstein(k, x, b, d);
        for (int i = 0; i < k; i++) sum += b[i], slope += d[i], mean += b[i] * i / (k - 1.0);
        CHECK_WITHIN(fabs(sum - 1), 1e-14, "order %d", k);
        CHECK_WITHIN(fabs(slope), 1e-12 * k, "order %d", k);
        CHECK_WITHIN(fabs(mean - x), 1e-14, "order %d", k);   /* linear precision */
    }
}

static void the_radius_and_the_deviation_bound_the_tile(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        double bump = seed % 3 ? 0.5 : 1e-12;    /* a frame in single precision is itself off by more than that */
        const Tile *p = random_part(&r, random_tile(f, &r, bump, seed % 2 ? 1 : 20));
        for (int n = 0; n < 200; n++) {
            double s = test_unit(&r), t = test_unit(&r);
            Vec3 at = point_of(p, s, t), half_s = tile_vec(p->half_s), half_t = tile_vec(p->half_t);
            Vec3 flat = vec_add(vec_scale(half_s, 2 * s - 1), vec_scale(half_t, 2 * t - 1));
            CHECK_WITHIN(vec_length(at), p->radius, "seed %u", seed);
            CHECK_WITHIN(vec_length(vec_sub(at, flat)), p->deviation + 1e-14, "seed %u", seed);
        }
    }
}

/* A derivative of the numerator about x, of which `value` is about the patch's origin. */
static Vec3 column_about(Vec4 by, Vec3 x) { return vec_sub(vec(by.x, by.y, by.z), vec_scale(x, by.w)); }

/* The columns of the Jacobian of w (S - x) for points x within the radius of the middle, in the margin too. */
static void turn_and_stretch_bound_the_derivatives(void **state)
{
    Fixture *f = *state;
    const double m = TILE_MARGIN;
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        const Tile *p = random_part(&r, random_tile(f, &r, seed % 3 ? 0.2 : 1e-12, seed % 2 ? 1 : 3));
        if (!isfinite(p->turn)) continue;
        Vec3 a = vec_scale(tile_vec(p->half_s), 1.0 / p->length_s), b = vec_scale(tile_vec(p->half_t), 1.0 / p->length_t);
        Vec3 normal = vec_normalize(vec_cross(a, b));
        double aa = vec_length2(a), bb = vec_length2(b), sigma = sqrt((aa + bb) / 2 - hypot((aa - bb) / 2, vec_dot(a, b)));
        CHECK_WITHIN(vec_length(vec_cross(a, b)), p->sine, "seed %u", seed);
        Vec3 middle_s = vec_scale(tile_vec(p->half_s), 2 * p->w_middle);
        Vec3 middle_t = vec_scale(tile_vec(p->half_t), 2 * p->w_middle);
        double unit_s = 2.0 * p->w_middle * p->length_s, unit_t = 2.0 * p->w_middle * p->length_t;
        for (int n = 0; n < 200; n++) {
            Vec4 value, by_s, by_t;
            double s = test_range(&r, -m, 1 + m), t = test_range(&r, -m, 1 + m);
            tile_evaluate(p, &s, &t, &value, &by_s, &by_t);
            Vec3 x = vec_add(tile_vec(p->middle), vec_scale(random_direction(&r), p->radius * test_unit(&r)));
            Vec3 e_s = vec_scale(vec_sub(column_about(by_s, x), middle_s), 1 / unit_s);
            Vec3 e_t = vec_scale(vec_sub(column_about(by_t, x), middle_t), 1 / unit_t);
            double up_s = vec_dot(e_s, normal), up_t = vec_dot(e_t, normal);
            double in_s = vec_length(vec_sub(e_s, vec_scale(normal, up_s)));
            double in_t = vec_length(vec_sub(e_t, vec_scale(normal, up_t)));
            CHECK_WITHIN(hypot(up_s, up_t), sigma * p->turn + 1e-12, "seed %u", seed);
            CHECK_WITHIN(hypot(in_s, in_t), sigma * p->stretch + 1e-12, "seed %u", seed);
        }
    }
}

/* A ray through a point of the patch meets it there, whatever its direction. */
static void a_ray_through_a_point_of_the_patch_finds_it(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 3000; seed++) {
        TestRandom r = test_random(seed);
        Tile *p = random_tile(f, &r, seed % 3 ? 0.05 : 0.7, seed % 2 ? 1 : 10);
        double s = test_unit(&r), t = test_unit(&r), distance = test_range(&r, 0.5, 4);
        if (seed % 5 == 0) s = (double)test_int(&r, 0, 1);   /* on a border */
        Vec3 d = random_direction(&r), at = vec_add(middle_of(p), point_of(p, s, t));
        PatchRay ray = patch_ray(vec_sub(at, vec_scale(d, distance)), d, 0, INFINITY);
        Found found = { 0 };
        tile_roots(p, &ray, collect, &found, &f->trace);
        CHECK(has_depth(&found, distance, 1e-14 * (distance + 10)), "seed %u: %d roots", seed, found.n);
    }
}

/* A patch one of whose sides is a point, and a ray from it to another point of the patch: it meets both. (Were the patch
 * ruled from there, the ray would run in it.) */
static void a_pole_on_the_ray_hides_no_other_root(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 3000; seed++) {
        TestRandom r = test_random(seed);
        int side = test_int(&r, 0, 3), k_u = test_int(&r, side < 2 ? 3 : 2, 5), k_v = test_int(&r, side < 2 ? 2 : 3, 5);
        Vec4 p[25];
        Vec3 pole = vec_scale(random_direction(&r), 3);
        for (int j = 0; j < k_v; j++)
            for (int i = 0; i < k_u; i++) {
                bool is_pole = side == 0 ? i == 0 : side == 1 ? i == k_u - 1 : side == 2 ? j == 0 : j == k_v - 1;
                Vec3 at = vec(i / (k_u - 1.0), j / (k_v - 1.0), test_range(&r, -0.3, 0.3));
                if (is_pole) at = pole;
                p[j * k_u + i] = vec4_weighted(vec4(at.x, at.y, at.z, pow(seed % 2 ? 1 : 10, test_unit(&r))));
            }
        Tile *tile = rounded_tile(f, k_u, k_v, p, 0x1p-48);
        CHECK(tile->patch->collapsed == 1u << side, "seed %u: %u", seed, tile->patch->collapsed);
        Vec3 other = vec_add(middle_of(tile), point_of(tile, test_range(&r, .1, .9), test_range(&r, .1, .9)));
        Vec3 d = vec_normalize(vec_sub(other, pole));
        PatchRay ray = patch_ray(vec_sub(pole, vec_scale(d, 2)), d, 0, INFINITY);
        Found found = { 0 };
        tile_roots(tile, &ray, collect, &found, &f->trace);
        double depth = 2 + vec_length(vec_sub(other, pole));
        CHECK(has_depth(&found, 2, 1e-13), "seed %u: the pole, of %d roots", seed, found.n);
        CHECK(has_depth(&found, depth, 1e-13), "seed %u: %g, of %d roots", seed, depth, found.n);
    }
}

/* The frame's shortcut and plain clipping find the same roots. */
static void the_frame_loses_and_invents_nothing(void **state)
{
    Fixture *f = *state;
    int n_roots = 0;
    for (unsigned seed = 0; seed < 20000; seed++) {
        TestRandom r = test_random(seed);
        Tile *p = random_tile(f, &r, test_range(&r, 0, 0.3), seed % 2 ? 1 : 4);
        Vec3 aim = vec_add(middle_of(p), vec_scale(random_direction(&r), p->radius * test_unit(&r)));
        Vec3 d = random_direction(&r);
        PatchRay ray = patch_ray(vec_sub(aim, vec_scale(d, 3)), d, 0, INFINITY);
        Found by_frame = { 0 }, by_clipping = { 0 };
        tile_roots(p, &ray, collect, &by_frame, &f->trace);
        clip_roots(p, &ray, collect, &by_clipping, &f->trace);
        for (int i = 0; i < by_frame.n; i++)
            CHECK(has_depth(&by_clipping, by_frame.depth[i], by_frame.error[i]), "seed %u", seed);
        for (int i = 0; i < by_clipping.n; i++)
            CHECK(has_depth(&by_frame, by_clipping.depth[i], by_clipping.error[i]), "seed %u", seed);
        n_roots += by_frame.n;
    }
    assert_true(n_roots > 5000);
    assert_true(f->trace.counters.certificates > 0);
}

/* It finds what it finds if it does not know the point, and what plain clipping finds; but with fewer tests. */
static void a_ray_that_knows_where_it_is_from_loses_nothing(void **state)
{
    Fixture *f = *state;
    int n_roots = 0, n_tests[2] = { 0 };
    for (unsigned seed = 0; seed < 20000; seed++) {
        TestRandom r = test_random(seed);
        const Tile *p = random_part(&r, random_tile(f, &r, test_range(&r, 0, 0.3), seed % 2 ? 1 : 4));
        PatchRay ray = random_ray_from(&r, p), unknowing = ray;
        Found found = { 0 }, by_frame = { 0 }, by_clipping = { 0 };
        Counters *count = &f->trace.counters;
        unknowing.from = NULL;
        n_tests[0] -= (int)count->nurbs_tests;
        tile_roots(p, &ray, collect, &found, &f->trace);
        n_tests[0] += (int)count->nurbs_tests, n_tests[1] -= (int)count->nurbs_tests;
        tile_roots(p, &unknowing, collect, &by_frame, &f->trace);
        n_tests[1] += (int)count->nurbs_tests;
        clip_roots(p, &unknowing, collect, &by_clipping, &f->trace);
        for (int i = 0; i < found.n; i++)
            CHECK(has_depth(&by_frame, found.depth[i], found.error[i]), "seed %u", seed);
        for (int i = 0; i < by_clipping.n; i++) {
            if (by_clipping.depth[i] <= ray.t_min + 2 * by_clipping.error[i]) continue;    /* it may as well be behind */
            CHECK(has_depth(&found, by_clipping.depth[i], by_clipping.error[i]), "seed %u", seed);
            n_roots++;
        }
    }
    assert_true(n_roots > 2000);
    assert_true(n_tests[0] < 0.8 * n_tests[1]);
}

/* z = x^2 over [-1, 1]^2, and rays along y... along x at height h: two roots for h > 0, a tangent one at 0, none below. */
static void a_tangent_ray_hits_and_one_beside_it_does_not(void **state)
{
    Fixture *f = *state;
    Vec4 p[6];
    for (int j = 0; j < 2; j++) {
        double y = 2 * j - 1;
        p[3 * j] = vec4(-1, y, 1, 1), p[3 * j + 1] = vec4(0, y, -1, 1), p[3 * j + 2] = vec4(1, y, 1, 1);
    }
    Tile *tile = new_tile(f, 3, 2, p);
    const double heights[] = { 0.25, 1e-4, 1e-8, 1e-12, 0, -1e-13, -1e-8, -0.1 };
    for (int i = 0; i < 8; i++) {
        PatchRay ray = patch_ray(vec(-3, 0.3, heights[i]), vec(1, 0, 0), 0, INFINITY);
        Found found = { 0 };
        tile_roots(tile, &ray, collect, &found, &f->trace);
        if (heights[i] < 0) assert_int_equal(found.n, 0);
        else {
            CHECK(has_depth(&found, 3 - sqrt(heights[i]), 1e-15), "height %g", heights[i]);
            CHECK(has_depth(&found, 3 + sqrt(heights[i]), 1e-15), "height %g", heights[i]);
        }
    }
}

/* A flat patch seen edge on: the ray runs in it, and the hit is where it enters. */
static void a_ray_in_the_surface_hits_where_it_enters(void **state)
{
    Fixture *f = *state;
    Vec4 p[4] = { { 0, 0, 0, 1 }, { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 1, 1, 0, 1 } };
    Tile *tile = new_tile(f, 2, 2, p);
    PatchRay ray = patch_ray(vec(-2, 0.5, 0), vec(1, 0, 0), 0, INFINITY);
    double nearest = INFINITY;
    tile_roots(tile, &ray, keep_nearest, &nearest, &f->trace);
    CHECK_WITHIN(fabs(nearest - 2), 1e-13, "enters at %.17g", nearest);
}

/* ---- normals ---- */

/* A bilinear patch with corners o, o + a, o + b, o + a + c, turned at random. */
static Patch *sheared(Fixture *f, Vec3 a, Vec3 b, Vec3 c, Vec3 o)
{
    Vec3 corner[4] = { o, vec_add(o, a), vec_add(o, b), vec_add(vec_add(o, a), c) };
    Vec4 p[4];
    for (int i = 0; i < 4; i++) p[i] = vec4(corner[i].x, corner[i].y, corner[i].z, 1);
    Patch *out = ARENA_NEW(f->arena, Patch);
    patch_make(f->arena, 2, 2, (WideNet){ p, NULL }, 0, (TrimRect){ 0, 1, 0, 1 }, out);
    return out;
}

/* On the collapsed side of a triangle, and where one side is shorter than the other by up to 2^-40: the plane's own. The
 * shorter side has as many bits less; the first step from the collapsed one, 20. */
static void a_flat_patch_has_the_normal_of_its_plane_wherever_it_collapses(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        Vec3 a = random_direction(&r), z = vec_normalize(vec_cross(a, random_direction(&r))), b = vec_cross(z, a);
        double width = ldexp(1, -test_int(&r, 0, 40));
        bool is_triangle = seed % 2;
        Patch *p = is_triangle ? sheared(f, a, vec(0, 0, 0), b, vec(0, 0, 0))
                               : sheared(f, a, vec_scale(b, width), vec_scale(b, width), vec(0, 0, 0));
        double s = is_triangle ? 0 : test_unit(&r), t = test_unit(&r);
        Vec3 n = patch_normal(p, s, t, vec(0, 0, 1));
        double bound = is_triangle ? 0x1p-48 / 0x1p-20 : 0x1p-48 / width;
        CHECK_WITHIN(vec_length(vec_sub(n, z)), bound, "seed %u, width %g", seed, width);
    }
}

/* An eighth of a sphere, whose side t = 1 is the pole. */
static void the_normal_at_a_pole_is_the_limit(void **state)
{
    Fixture *f = *state;
    const double h = sqrt(0.5), c[3] = { 1, h, 0 }, e[3] = { 0, h, 1 }, w[3] = { 1, h, 1 };   /* homogeneous quarter */
    Vec4 p[9];
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) p[3 * j + i] = vec4(c[j] * c[i], c[j] * e[i], e[j] * w[i], w[i] * w[j]);
    Patch patch;
    patch_make(f->arena, 3, 3, (WideNet){ p, NULL }, 0, (TrimRect){ 0, 1, 0, 1 }, &patch);
    for (int i = 0; i <= 10; i++) {
        Vec3 n = patch_normal(&patch, i / 10.0, 1, vec(1, 0, 0));
        CHECK_WITHIN(vec_length(vec_sub(n, vec(0, 0, 1))), 0x1p-19, "at s %g: (%g, %g, %g)", i / 10.0, n.x, n.y, n.z);
    }
}

/* A patch that is a line, or a point: of length 1, across it, and on the side of who looks. */
static void a_patch_without_a_normal_has_one_that_faces_who_looks(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        Vec3 along = random_direction(&r), from = vec_scale(random_direction(&r), 10), none = { 0, 0, 0 };
        if (seed % 3 == 0) from = along;
        Patch *p = sheared(f, seed % 2 ? along : none, none, none, random_direction(&r));
        Vec3 n = patch_normal(p, test_unit(&r), test_unit(&r), from);
        CHECK_WITHIN(fabs(vec_length(n) - 1), 1e-15, "seed %u", seed);
        CHECK_WITHIN(-vec_dot(n, from), 1e-7, "seed %u", seed);   /* looking along the line, all are as good */
        if (seed % 2) CHECK_WITHIN(fabs(vec_dot(n, along)), 0x1p-49, "seed %u", seed);
        else CHECK_WITHIN(vec_length(vec_sub(n, vec_normalize(from))), 1e-15, "seed %u", seed);
    }
}

/* ---- whole surfaces ---- */

/* A torus of radii 1 and 0.4 as a rational biquadratic surface of 9 x 9 points: circles of four arcs in both directions. */
static Shape *torus_shape(Arena *a)
{
    static const double knots[12] = { 0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1 };
    static const double cx[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, cy[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
    Vec4 p[81];
    for (int j = 0; j < 9; j++)
        for (int i = 0; i < 9; i++) {
            double w = (i % 2 ? sqrt(0.5) : 1) * (j % 2 ? sqrt(0.5) : 1), radius = 1 + 0.4 * cx[j];
            p[9 * j + i] = vec4(radius * cx[i], radius * cy[i], 0.4 * cy[j], w);
        }
    SurfaceDesc d = { .order_u = 3, .order_v = 3, .n_u = 9, .n_v = 9, .knots_u = knots, .knots_v = knots, .points = p };
    NurbsOptions options = { .method = NURBS_METHOD_CERTAIN };
    NurbsError error;
    return nurbs_shape_new(a, &d, &options, &error, NULL, 0, NULL);
}

/* In and out again, in order, and as many as the quartic has; rays towards points, so that seams and borders are met,
 * too. */
static void a_closed_surface_is_left_as_often_as_entered(void **state)
{
    Fixture *f = *state;
    Shape *torus = torus_shape(f->arena);
    assert_non_null(torus);
    int n_hits = 0;
    for (unsigned seed = 0; seed < 50000; seed++) {
        TestRandom r = test_random(seed);
        Vec3 d = random_direction(&r);
        Vec3 aim = vec(test_range(&r, -1.4, 1.4), test_range(&r, -1.4, 1.4), test_range(&r, -0.4, 0.4));
        if (seed % 7 == 0) aim.y = 0;                     /* the seam of u lies in this plane */
        if (seed % 11 == 0) aim.z = 0, d = vec_normalize(vec(d.x, d.y, 0));    /* in the plane of the seam of v */
        Ray ray = { vec_sub(aim, vec_scale(d, 5)), d, 0 };
        ArenaMark mark = arena_mark(f->trace.scratch);
        HitList list = hit_list_make(f->trace.scratch, INFINITY);
        shape_all_hits(torus, &ray, &list, &f->trace);
        CHECK(list.n % 2 == 0, "seed %u: %zu hits", seed, list.n);
        for (size_t i = 0; i < list.n; i++) {
            Vec3 at = ray_at(&ray, list.hits[i].t);
            CHECK_WITHIN(fabs(hypot(hypot(at.x, at.y) - 1, at.z) - 0.4), 1e-13, "seed %u", seed);
            if (i > 0) assert_true(list.hits[i].t >= list.hits[i - 1].t);
        }
        n_hits += (int)list.n;
        arena_reset(f->trace.scratch, mark);
    }
    assert_true(n_hits > 50000);
    shape_release(torus);
}

/* A triple root, in a monkey saddle whose other two rounding moves apart or away: each tile and box about it finds its own,
 * some of which are certain to 1e-6 and others to 1e-5 only. From one side of the surface to the other they are odd. */
static void a_ray_through_the_middle_of_a_saddle_passes_it(void **state)
{
    Fixture *f = *state;
    static const double knots_u[] = { 0, 0, 0, 0, 1, 1, 1, 1 }, knots_v[] = { 0, 0, 0, 1, 1, 1 };
    static const double A = 0x1.18eba5b8e374p+0, B = 0x1.738a2d238e46p+1;
    const double z[12] = { A, A, B, B, 0x1.e7145a471c8cp+1, 2, 2, 0x1.8eba5b8e374p-3, A, A, B, B };
    Vec4 p[12];
    for (int i = 0; i < 12; i++) p[i] = vec4(i % 4 * (2 / 3.), i / 4 - 3, z[i], 1);
    SurfaceDesc d = { .order_u = 4, .order_v = 3, .n_u = 4, .n_v = 3, .knots_u = knots_u, .knots_v = knots_v, .points = p };
    NurbsError error;
    Shape *saddle = nurbs_shape_new(f->arena, &d, &(NurbsOptions){ .method = NURBS_METHOD_CERTAIN }, &error, NULL, 0, NULL);
    assert_non_null(saddle);
    Ray ray = { vec(4, 1, 2), vec(-1, -1, -0.), 0 };     /* -0: for its planes */
    HitList list = hit_list_make(f->trace.scratch, INFINITY);
    shape_all_hits(saddle, &ray, &list, &f->trace);
    CHECK(list.n % 2 == 1, "%zu hits", list.n);
    shape_release(saddle);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bernstein_polynomials_sum_to_one_and_their_derivatives_to_zero),
        cmocka_unit_test_setup_teardown(the_radius_and_the_deviation_bound_the_tile, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ray_that_knows_where_it_is_from_loses_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(turn_and_stretch_bound_the_derivatives, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ray_through_a_point_of_the_patch_finds_it, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_pole_on_the_ray_hides_no_other_root, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_frame_loses_and_invents_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_tangent_ray_hits_and_one_beside_it_does_not, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ray_in_the_surface_hits_where_it_enters, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_flat_patch_has_the_normal_of_its_plane_wherever_it_collapses, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_normal_at_a_pole_is_the_limit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_patch_without_a_normal_has_one_that_faces_who_looks, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_closed_surface_is_left_as_often_as_entered, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ray_through_the_middle_of_a_saddle_passes_it, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
