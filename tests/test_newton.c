/* Newton on one leaf: what it finds, when it gives up, how wrong it may be. */
#include "nurbs/newton.h"
#include "nurbs/prepare.h"
#include "tests/models.h"

typedef struct { Arena *a, *scratch; Surface *s; LeafTree tree; } Fixture;

static Fixture fixture(const Model *m)
{
    Fixture f = { .a = arena_new(), .scratch = arena_new() };
    SurfaceDesc d = model_desc(m);
    NurbsError e;
    NurbsOptions o = { 0 };
    f.s = surface_new(f.a, &d, &e, NULL, 0, NULL);
    CHECK(f.s, "code %d", e.code);
    prepare_leaves(f.a, f.scratch, f.s, &o, &f.tree);
    return f;
}

static void done(Fixture *f) { arena_free(f->a), arena_free(f->scratch); }

static Vec3 random_direction(TestRandom *r)
{
    Vec3 d;
    do d = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1)); while (vec_length2(d) > 1);
    return vec_normalize(d);
}

static SurfacePoint random_leaf_point(TestRandom *r, const Fixture *f, const Leaf *l)
{
    SurfacePoint p;
    refine_evaluate(f->s, l->mu_u, test_range(r, l->u0, l->u1), l->mu_v, test_range(r, l->v0, l->v1), &p);
    return p;
}

static Model unit_square(void)
{
    Model m = { .k_u = 2, .k_v = 2, .n_u = 2, .n_v = 2, .knots_u = { 0, 0, 1, 1 }, .knots_v = { 0, 0, 1, 1 } };
    for (int i = 0; i < 4; i++) m.points[i] = vec4(i % 2, i / 2, 0, 1);
    return m;
}

static NewtonOutcome solve(const Fixture *f, uint32_t leaf, Ray ray, Counters *c, NewtonRoot *root)
{
    NewtonRay n = newton_ray(&ray);
    return newton_solve(f->s, &f->tree.leaves[leaf], &n, NEWTON_MAX_ITERATIONS, 1, c, root);
}

static void the_planes_are_perpendicular_and_hold_the_ray(void **state)
{
    (void)state;
    TestRandom r = test_random(1);
    for (int i = 0; i < 1000; i++) {
        Vec3 d = random_direction(&r);
        if (i < 6) d = vec(i / 2 == 0, i / 2 == 1, i / 2 == 2), d = vec_scale(d, i % 2 ? -1 : 1);
        if (i >= 6 && i < 12) d.x = i % 2 ? 0 : d.y;
        double length = pow(10, test_range(&r, -8, 8));
        Ray ray = { vec(1, 2, 3), vec_scale(d, length / vec_length(d)), 0 };
        NewtonRay n = newton_ray(&ray);
        CHECK_WITHIN(fabs(vec_dot(n.N1, n.d)) + fabs(vec_dot(n.N2, n.d)) + fabs(vec_dot(n.N1, n.N2)), 1e-15, "%d", i);
        CHECK_WITHIN(fabs(vec_length(n.N1) - 1) + fabs(vec_length(n.N2) - 1), 1e-15, "%d", i);
        CHECK_WITHIN(fabs(n.length / length - 1), 1e-15, "%d", i);
    }
}

static double sphere_error(Vec3 o, Vec3 d, double t)         /* distance to the nearer of the two roots; d is unit */
{
    double b = vec_dot(o, d), c = vec_length2(o) - 1, root = sqrt(fmax(b * b - c, 0));
    return fmin(fabs(t - (-b - root)), fabs(t - (-b + root)));
}

/* Rays that are not nearly tangent: there the closed form itself loses digits. */
static void roots_are_roots_within_their_error(void **state)
{
    (void)state;
    Model m;
    model_sphere(&m);
    Fixture f = fixture(&m);
    TestRandom r = test_random(2);
    Counters c = { 0 };
    int n_roots = 0, n = 20000;
    double worst = 0;
    for (int i = 0; i < n; i++) {
        uint32_t leaf = (uint32_t)test_int(&r, 0, (int)f.tree.n_leaves - 1);
        Vec3 p = random_leaf_point(&r, &f, &f.tree.leaves[leaf]).point, d = random_direction(&r);
        if (fabs(vec_dot(p, d)) < 0.05) continue;
        Ray ray = { vec_sub(p, vec_scale(d, 3)), d, 0 };
        NewtonRoot root;
        if (solve(&f, leaf, ray, &c, &root) != NEWTON_ROOT) continue;
        double error = sphere_error(ray.origin, d, root.t);
        n_roots++;
        worst = fmax(worst, error);
        CHECK_WITHIN(error, root.t_error + 1e-14, "ray %d", i);
        CHECK_WITHIN(root.t_error, 1e-9, "ray %d", i);
    }
    CHECK(n_roots > 0.9 * n, "%d of %d", n_roots, n);
    print_message("  %d roots of %d rays through a leaf, worst error of t %.1e; %.2f evaluations a test\n",
                  n_roots, n, worst, (double)c.newton_iterations / n);
    done(&f);
}

static void the_same_ray_scaled_has_the_same_root(void **state)
{
    (void)state;
    Model m;
    model_torus(&m, 0.4);
    Fixture f = fixture(&m);
    TestRandom r = test_random(3);
    Counters c = { 0 };
    for (int i = 0; i < 500; i++) {
        uint32_t leaf = (uint32_t)test_int(&r, 0, (int)f.tree.n_leaves - 1);
        Vec3 p = random_leaf_point(&r, &f, &f.tree.leaves[leaf]).point, d = random_direction(&r);
        NewtonRoot one, two;
        NewtonOutcome a = solve(&f, leaf, (Ray){ vec_sub(p, d), d, 0 }, &c, &one);
        NewtonOutcome b = solve(&f, leaf, (Ray){ vec_sub(p, d), vec_scale(d, 0x1p20), 0 }, &c, &two);
        CHECK(a == b, "ray %d", i);
        if (a == NEWTON_ROOT) CHECK(one.u == two.u && one.v == two.v && one.t == two.t * 0x1p20, "ray %d", i);
    }
    done(&f);
}

static void no_leaf_with_a_root_is_out_of_reach(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        Model m = { .k_u = test_int(&r, 2, 5), .k_v = test_int(&r, 2, 5) };
        m.n_u = model_random_knots(&r, m.k_u, 2, m.k_u, m.knots_u);
        m.n_v = model_random_knots(&r, m.k_v, 2, m.k_v, m.knots_v);
        model_random_points(&r, &m, seed % 2 ? 1 : 20);
        Fixture f = fixture(&m);
        for (int i = 0; i < 100; i++) {
            const Leaf *l = &f.tree.leaves[test_int(&r, 0, (int)f.tree.n_leaves - 1)];
            Vec3 p = random_leaf_point(&r, &f, l).point, d = random_direction(&r);
            Ray ray = { vec_sub(p, vec_scale(d, pow(10, test_range(&r, -3, 3)))), d, 0 };
            NewtonRay n = newton_ray(&ray);
            CHECK(newton_view(f.s, l, &n) != NEWTON_OFF, "seed %u ray %d", seed, i);
        }
        done(&f);
    }
}

static void a_ray_past_a_square_is_turned_away(void **state)
{
    (void)state;
    Model m = unit_square();
    Fixture f = fixture(&m);
    for (int i = -4; i <= 8; i++) {
        Ray ray = { vec(i * 0.25 + 1e-3, 0.5, 1), vec(0, 0, -1), 0 };
        NewtonRay n = newton_ray(&ray);
        CHECK((newton_view(f.s, &f.tree.leaves[0], &n) != NEWTON_OFF) == (i >= 0 && i < 4), "x = %g", i * 0.25 + 1e-3);
    }
    done(&f);
}

static double det_J(const NewtonRay *n, const SurfacePoint *p) { return vec_dot(n->d, vec_cross(p->s_u, p->s_v)); }

static void a_plain_leaf_does_not_fold(void **state)
{
    (void)state;
    Model m = { .k_u = 4, .k_v = 4, .n_u = 9, .n_v = 9 };          /* a bumpy sheet over [3, 9] x [3, 9] */
    int n_plain = 0;
    for (int i = 0; i < 13; i++) m.knots_u[i] = m.knots_v[i] = i;
    for (int i = 0; i < 81; i++) m.points[i] = vec4(i % 9, i / 9, sin(i) + cos(0.37 * i), 1);
    Fixture f = fixture(&m);
    TestRandom r = test_random(8);
    for (int i = 0; i < 5000; i++) {
        const Leaf *l = &f.tree.leaves[test_int(&r, 0, (int)f.tree.n_leaves - 1)];
        SurfacePoint p = random_leaf_point(&r, &f, l), q = random_leaf_point(&r, &f, l);
        Vec3 d = random_direction(&r);
        NewtonRay n = newton_ray(&(Ray){ vec_sub(p.point, d), d, 0 });
        if (newton_view(f.s, l, &n) != NEWTON_PLAIN) continue;
        n_plain++;
        CHECK(det_J(&n, &p) * det_J(&n, &q) > 0, "ray %d", i);
    }
    CHECK(n_plain > 2500 && n_plain < 4900, "%d", n_plain);
    done(&f);
}

static void quarters_are_leaves_that_tile_theirs(void **state)
{
    (void)state;
    Model m;
    model_torus(&m, 0.4);
    Fixture f = fixture(&m);
    TestRandom r = test_random(9);
    for (int i = 0; i < 2000; i++) {
        const Leaf *l = &f.tree.leaves[test_int(&r, 0, (int)f.tree.n_leaves - 1)];
        double u = test_range(&r, l->u0, l->u1), v = test_range(&r, l->v0, l->v1);
        for (int k = 0; k < 4; k++) {
            Leaf q = newton_quarter(f.s, l, k);
            CHECK((q.u0 <= u && u < q.u1 && q.v0 <= v && v < q.v1) ==
                  ((u >= (l->u0 + l->u1) / 2) == (k & 1) && (v >= (l->v0 + l->v1) / 2) == k / 2), "quarter %d", k);
            SurfacePoint p = random_leaf_point(&r, &f, &q);
            NewtonRay n = newton_ray(&(Ray){ vec_add(p.point, vec(1, 2, 3)), vec(-1, -2, -3), 0 });
            CHECK(newton_view(f.s, &q, &n) != NEWTON_OFF, "quarter %d", k);
        }
    }
    done(&f);
}

static void each_criterion_ends_the_iteration(void **state)
{
    (void)state;
    Model m = unit_square();
    Fixture square = fixture(&m);
    model_sphere(&m);
    Fixture sphere = fixture(&m);
    Counters c = { 0 };
    NewtonRoot root;
    Ray through = { vec(0.3, 0.9, 2), vec(0, 0, -1), 0 }, past = { vec(1.5, 0.9, 2), vec(0, 0, -1), 0 };
    CHECK(solve(&square, 0, through, &c, &root) == NEWTON_ROOT, "through the square");
    CHECK(fabs(root.u - 0.3) < 1e-15 && fabs(root.v - 0.9) < 1e-15 && root.t == 2, "(%g, %g) %g", root.u, root.v, root.t);
    CHECK(solve(&square, 0, past, &c, &root) == NEWTON_OUTSIDE, "past the square");

    const Leaf *l = &sphere.tree.leaves[0];
    Vec3 normal = vec_normalize(l->middle.point), side = vec_normalize(vec_cross(normal, vec(0.3, 0.5, 0.1)));
    Ray beside = { vec_add(vec_scale(normal, 1.5), vec_scale(side, -3)), vec_add(side, vec_scale(normal, 0.01)), 0 };
    CHECK(solve(&sphere, 0, beside, &c, &root) == NEWTON_WORSE, "a ray that misses the sphere");
    Ray slanted = { vec_add(l->middle.point, vec(1, 2, 3)), vec(-1, -2.01, -3.01), 0 };
    NewtonRay n = newton_ray(&slanted);
    CHECK(newton_solve(sphere.s, l, &n, 1, 1, &c, &root) == NEWTON_UNFINISHED, "one iteration");
    CHECK(newton_solve(sphere.s, l, &n, 9, 1, &c, &root) == NEWTON_ROOT, "nine");
    done(&square), done(&sphere);
}

/* A ray in the tangent plane of the first guess: det J = 0 there, and the paper's jitter would stay where it is. */
static void a_singular_first_guess_is_left_by_jitter(void **state)
{
    (void)state;
    Model m;
    model_sphere(&m);
    Fixture f = fixture(&m);
    const Leaf *l = &f.tree.leaves[5];
    Vec3 along = vec_normalize(vec_add(l->middle.s_u, l->middle.s_v)), normal = vec_normalize(l->middle.point);
    Ray inside = { vec_sub(vec_scale(normal, 0.9995), along), along, 0 };       /* two roots, 0.03 before and after */
    int n_found = 0;
    for (uint64_t seed = 0; seed < 50; seed++) {
        Counters c = { 0 }, again = { 0 };
        NewtonRoot root = { 0 }, same = { 0 };
        NewtonRay n = newton_ray(&inside);
        NewtonOutcome a = newton_solve(f.s, l, &n, NEWTON_MAX_ITERATIONS, seed, &c, &root);
        NewtonOutcome b = newton_solve(f.s, l, &n, NEWTON_MAX_ITERATIONS, seed, &again, &same);
        CHECK(c.newton_jitters > 0, "seed %d", (int)seed);
        CHECK(a == b && root.u == same.u && root.t == same.t, "the same seed, the same jitter");
        n_found += a == NEWTON_ROOT;
    }
    CHECK(n_found > 8, "%d of 50", n_found);           /* none, if the first guess stayed where it is */
    done(&f);
}

/* Rays through the border that two leaves share, and through the seam u = 0 = 4 of the cylinder: both sides find the root,
 * so that rounding cannot make both miss it. */
static void a_root_on_a_border_is_found_from_both_sides(void **state)
{
    (void)state;
    Model m;
    model_cylinder(&m);
    Fixture f = fixture(&m);
    Counters c = { 0 };
    for (uint32_t i = 0; i < f.tree.n_leaves; i++)
        for (int k = 1; k < 200; k++) {
            const Leaf *l = &f.tree.leaves[i], *next = &f.tree.leaves[(i + 1) % f.tree.n_leaves];
            SurfacePoint p;
            refine_evaluate(f.s, l->mu_u, l->u1, l->mu_v, k / 200.0, &p);
            Vec3 d = vec(-p.point.x + 0.01 * (k % 5), -p.point.y, 0.3);
            Ray ray = { vec_sub(p.point, d), d, 0 };
            NewtonRoot a, b;
            CHECK(solve(&f, i, ray, &c, &a) == NEWTON_ROOT, "leaf %u, ray %d", i, k);
            CHECK(solve(&f, (uint32_t)(next - f.tree.leaves), ray, &c, &b) == NEWTON_ROOT, "after leaf %u, ray %d", i, k);
            CHECK_WITHIN(fabs(a.t - b.t), a.t_error + b.t_error, "leaf %u, ray %d", i, k);
        }
    done(&f);
}

static void a_surface_far_from_the_origin_is_hit_as_well(void **state)
{
    (void)state;
    Model m;
    model_torus(&m, 0.4);
    for (int i = 0; i < 81; i++) m.points[i].x += 1e6, m.points[i].y -= 3e5;
    Fixture f = fixture(&m);
    TestRandom r = test_random(7);
    Counters c = { 0 };
    int n_roots = 0;
    for (int i = 0; i < 2000; i++) {
        uint32_t leaf = (uint32_t)test_int(&r, 0, (int)f.tree.n_leaves - 1);
        SurfacePoint p = random_leaf_point(&r, &f, &f.tree.leaves[leaf]);
        Vec3 d = random_direction(&r);
        NewtonRoot root;
        Vec3 normal = vec_normalize(vec_cross(p.s_u, p.s_v));
        if (fabs(vec_dot(normal, d)) < 0.3) continue;
        if (solve(&f, leaf, (Ray){ vec_sub(p.point, vec_scale(d, 2)), d, 0 }, &c, &root) != NEWTON_ROOT) continue;
        n_roots += fabs(root.t - 2) < 1e-7;
        CHECK_WITHIN(root.t_error, 1e-6, "ray %d", i);         /* coordinates of 1e6 are rounded to 1e-10 */
    }
    CHECK(n_roots > 1300, "%d", n_roots);
    done(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_planes_are_perpendicular_and_hold_the_ray),
        cmocka_unit_test(roots_are_roots_within_their_error),
        cmocka_unit_test(the_same_ray_scaled_has_the_same_root),
        cmocka_unit_test(no_leaf_with_a_root_is_out_of_reach),
        cmocka_unit_test(a_ray_past_a_square_is_turned_away),
        cmocka_unit_test(a_plain_leaf_does_not_fold),
        cmocka_unit_test(quarters_are_leaves_that_tile_theirs),
        cmocka_unit_test(each_criterion_ends_the_iteration),
        cmocka_unit_test(a_singular_first_guess_is_left_by_jitter),
        cmocka_unit_test(a_root_on_a_border_is_found_from_both_sides),
        cmocka_unit_test(a_surface_far_from_the_origin_is_hit_as_well),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
