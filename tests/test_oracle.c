/* The oracle against closed forms: roots of sphere, torus, cylinder, cone and plane in all representations, known
 * tangencies, circles as trims. */
#include "tests/oracle.h"

#include "tests/stress/model.h"
#include "tests/test.h"
#include "tests/trims.h"

enum { MAX_ROOTS = 32 };

typedef struct { const char *name; Form form; Net net; } Thing;

static Thing thing(Arena *a, int which)
{
    Thing t;
    switch (which) {
    case 0: t.form = form_sphere(a, &t.net); break;
    case 1: t.form = form_torus(a, .4, &t.net); break;
    case 2: t.form = form_cylinder(a, &t.net); break;
    case 3: t.form = form_cone(a, &t.net); break;
    case 4: t.form = form_saddle(a, 0, &t.net); break;
    case 5: t.form = form_saddle(a, 1, &t.net); break;
    case 6: t.form = form_monkey(a, 1, &t.net); break;
    default: t.form = form_whitney(a, &t.net); break;
    }
    t.name = t.form.name;
    return t;
}

typedef struct { Model m; Oracle *o; } Subject;

static Subject subject(Arena *a, Thing t, const QuadMap *place)
{
    Subject s = { .m = model_new(a, t.form, t.net) };
    model_place(&s.m, place);
    s.o = oracle_new(&s.m.desc);
    return s;
}

static bool may_be(const OracleRoot *a, const TruthRoot *b)
{
    return a->t + a->t_error >= b->lo && a->t - a->t_error <= b->hi;
}

/* Each root of the truth that is sure is a root of the oracle, and the other way round. */
static void check_roots(const Subject *s, const Ray *r, const char *name, unsigned seed)
{
    Truth truth;
    OracleRoot roots[MAX_ROOTS];
    truth_of_form(&s->m.at, r, &truth);
    int n = oracle_roots(s->o, r, 0, roots, MAX_ROOTS);
    CHECK(n <= MAX_ROOTS, "%s, seed %u: %d roots", name, seed, n);
    for (int i = 0; i < truth.n; i++) {
        bool is_there = false;
        for (int j = 0; j < n; j++)
            is_there = is_there || may_be(&roots[j], &truth.root[i]);
        CHECK(is_there || !truth_is_sure(&truth.root[i]), "%s, seed %u: root %d of %d at %Lg is missing", name, seed, i,
              truth.n, truth.root[i].t);
    }
    for (int j = 0; j < n; j++) {
        bool is_true = false;
        for (int i = 0; i < truth.n; i++)
            is_true = is_true || may_be(&roots[j], &truth.root[i]);
        CHECK(is_true, "%s, seed %u: %s at %.17g", name, seed, roots[j].is_cluster ? "cluster" : "root", roots[j].t);
    }
}

static void roots_are_those_of_the_closed_forms(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 160; seed++) {
        TestRandom random = test_random(seed);
        Arena *a = arena_new();
        Thing t = thing(a, (int)(seed % 8));
        if (seed % 3 == 1) net_mobius(&t.net, test_int(&random, 0, 1), pow(10, test_range(&random, -6, 6)));
        if (seed % 3 == 2) net_raise(a, &t.net, test_int(&random, 0, 1), test_int(&random, 4, 6));
        for (int axis = 0; axis < 2; axis++)
            net_insert(a, &t.net, axis, t.net.knots[axis][t.net.n[axis]] * test_range(&random, .1, .9));
        QuadMap place = model_rotation(&random, pow(10, test_range(&random, -3, 3)));
        Subject s = subject(a, t, &place);
        for (int i = 0; i < 4; i++) {
            Ray r = ray_anywhere(&s.m, 0, &random);
            check_roots(&s, &r, t.name, seed);
        }
        oracle_free(s.o);
        arena_free(a);
    }
}

/* The corners of a tall paraboloid are farther from its origin than anything else that forms have. */
static void a_corner_far_from_the_middle_is_seen(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 40; seed++) {
        TestRandom random = test_random(seed);
        Arena *a = arena_new();
        Thing t = { .name = "tall paraboloid" };
        t.form = form_paraboloid(a, seed & 4 ? 2 : -2, &t.net);
        QuadMap place = model_rotation(&random, 1);
        Subject s = subject(a, t, &place);
        Quad3 corner = net_point(&s.m.plain, seed & 1 ? 1e-9 : 1 - 1e-9, seed & 2 ? 1e-9 : 1 - 1e-9);
        Ray r = ray_towards(&s.m, corner, random_direction(&random), 3, &random);
        Truth truth;
        truth_of_form(&s.m.at, &r, &truth);
        bool is_there = false;
        long double at = (long double)(quad3_length(quad3_sub(corner, quad3_of(r.origin))) / quad3_length(quad3_of(r.dir)));
        for (int i = 0; i < truth.n; i++)
            is_there = is_there || (truth.root[i].lo <= at && at <= truth.root[i].hi && truth.root[i].is_inside);
        CHECK(is_there, "seed %u: nothing at %Lg", seed, at);
        check_roots(&s, &r, t.name, seed);
        oracle_free(s.o);
        arena_free(a);
    }
}

static void a_root_is_good_to_thirty_digits(void **state)
{
    (void)state;
    static const double knots[] = { 0, 0, 0, 1, 1, 1 };
    Vec4 points[9];   /* z = x^2 + y^2 over [0, 1]^2 */
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) points[3 * j + i] = vec4(i / 2., j / 2., (i == 2) + (j == 2), 1);
    SurfaceDesc d = { .order_u = 3, .order_v = 3, .n_u = 3, .n_v = 3, .knots_u = knots, .knots_v = knots, .points = points };
    Oracle *o = oracle_new(&d);
    OracleRoot roots[2];
    Ray r = { { 0, 0, .5 }, { 1, 1, 0 }, 0 };   /* 2 t^2 = 1/2 */
    assert_int_equal(oracle_roots(o, &r, 0, roots, 2), 1);
    CHECK(!roots[0].is_cluster && roots[0].t == .5, "t %.17g", roots[0].t);
    CHECK_WITHIN(fabs(roots[0].t_tail) + roots[0].t_error, 1e-30, "t %.17g", roots[0].t);
    r = (Ray){ { 0, 0, 1 }, { 1, 1, 0 }, 0 };   /* 2 t^2 = 1: t = sqrt(1/2), whose tail is known */
    assert_int_equal(oracle_roots(o, &r, 0, roots, 2), 1);
    CHECK_WITHIN(fabs(roots[0].t - 0x1.6a09e667f3bcdp-1), 0, "t %.17g", roots[0].t);
    CHECK_WITHIN(fabs(roots[0].t_tail + 4.8336466567264565e-17), 1e-30, "tail %.17g", roots[0].t_tail);
    oracle_free(o);
}

static void a_tangent_is_a_cluster_and_a_miss_is_none(void **state)
{
    (void)state;
    static const double knots[] = { 0, 0, 0, 1, 1, 1 };
    Vec4 points[9];   /* z = (2u-1)^2 + (2v-1)^2 */
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            points[3 * j + i] = vec4(i - 1, j - 1, (i == 1 ? -1 : 1) + (j == 1 ? -1 : 1), 1);
    SurfaceDesc d = { .order_u = 3, .order_v = 3, .n_u = 3, .n_v = 3, .knots_u = knots, .knots_v = knots, .points = points };
    Oracle *o = oracle_new(&d);
    OracleRoot roots[4];
    Ray r = { { -2, 0, 0 }, { 1, 0, 0 }, 0 };
    assert_int_equal(oracle_roots(o, &r, 0, roots, 4), 1);
    CHECK(roots[0].is_cluster, "t %.17g", roots[0].t);
    CHECK_WITHIN(fabs(roots[0].t - 2), roots[0].t_error, "t %.17g", roots[0].t);
    CHECK_WITHIN(roots[0].t_error, 1e-12, "t %.17g", roots[0].t);
    for (double by = 1e-1; by > 1e-18; by /= 10) {
        Ray below = { { -2, 0, -by }, { 1, 0, 0 }, 0 }, above = { { -2, 0, by }, { 1, 0, 0 }, 0 };
        assert_int_equal(oracle_roots(o, &below, 0, roots, 4), 0);
        assert_int_equal(oracle_roots(o, &above, 0, roots, 4), 2);
        for (int i = 0; i < 2; i++)
            CHECK_WITHIN(fabs(roots[i].t - (2 + (2 * i - 1) * sqrt(by))), 4e-16, "by %g: t %.17g", by, roots[i].t);
        assert_int_equal(oracle_roots(o, &below, 2 * by, roots, 4), 1);
        CHECK(!roots[0].is_sure, "by %g", by);
    }
    oracle_free(o);
}

static void a_root_on_a_knot_or_a_corner_is_one_root(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Thing t = thing(a, 6);
    net_insert(a, &t.net, 0, .5), net_insert(a, &t.net, 1, .25);
    QuadMap place = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } };
    Subject s = subject(a, t, &place);
    static const double at[3] = { 0, .5, 1 };
    for (int i = 0; i < 9; i++) {
        double u = at[i % 3], v = i / 3 == 1 ? .25 : at[i / 3], x = 2 * u - 1, y = 2 * v - 1;
        double z = x * x * x - 3 * x * y * y;
        Ray r = { { x + .25, y - .5, z + 1 }, { -.25, .5, -1 }, 0 };
        OracleRoot roots[4];
        int n = oracle_roots(s.o, &r, 0, roots, 4), here = 0;
        for (int j = 0; j < n; j++) {
            if (fabs(roots[j].t - 1) > 1e-6) continue;
            here++;
            bool is_one = !roots[j].is_cluster && roots[j].t == 1 && fabs(roots[j].t_tail) < 1e-30;
            CHECK(is_one, "corner %d: %.17g", i, roots[j].t);
        }
        CHECK(here == 1, "corner %d: %d roots", i, here);
    }
    oracle_free(s.o);
    arena_free(a);
}

static void the_ray_in_a_plane_is_a_cluster(void **state)
{
    (void)state;
    static const double knots[] = { 0, 0, 1, 1 };
    static const Vec4 points[] = { { 0, 0, 0, 1 }, { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 1, 1, 0, 1 } };
    SurfaceDesc d = { .order_u = 2, .order_v = 2, .n_u = 2, .n_v = 2, .knots_u = knots, .knots_v = knots, .points = points };
    Oracle *o = oracle_new(&d);
    OracleRoot roots[4];
    Ray r = { { -1, .25, 0 }, { 1, .125, 0 }, 0 };
    assert_int_equal(oracle_roots(o, &r, 0, roots, 4), 1);
    CHECK(roots[0].is_cluster, "t %.17g", roots[0].t);
    CHECK_WITHIN(fabs(roots[0].t - 1.5) + fabs(roots[0].t_error - .5), .0625, "t %.17g", roots[0].t);
    oracle_free(o);
}

/* ---- trims ---- */

static void a_circle_goes_round_its_inside_once(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        Vec2 centre = vec2(test_range(&r, .3, .7), test_range(&r, .3, .7));
        double radius = test_range(&r, .05, .3), angle = test_range(&r, -4, 4), by = pow(10, -test_range(&r, 0, 15));
        if (test_int(&r, 0, 1)) by = -by;
        if (seed % 5 == 0) angle = test_int(&r, 0, 7) * atan(1);
        TrimLoopDesc loop = circle(a, centre, radius, seed & 1);
        Vec2 p = vec2(centre.x + (radius + by * radius) * cos(angle), centre.y + (radius + by * radius) * sin(angle));
        Quad x = (Quad)p.x - centre.x, y = (Quad)p.y - centre.y, beyond = quad_sqrt(x * x + y * y) - radius;
        if (quad_abs(beyond) < 4 * 0x1p-53) continue;   /* the control points' own rounding */
        int winding;
        double distance;
        OracleTrims *o = oracle_trims_new(&loop, 1);
        CHECK(oracle_winding(o, 0, p.x, p.y, &winding, &distance), "seed %u: within %g", seed, distance);
        CHECK(winding == (beyond > 0 ? 0 : seed & 1 ? -1 : 1), "seed %u: %d at %g", seed, winding, (double)beyond);
        oracle_trims_free(o);
    }
    arena_free(a);
}

static void a_point_on_a_trim_is_too_close_to_tell(void **state)
{
    (void)state;
    static const double knots[] = { 0, 0, 0, 1, 1, 1 }, line[] = { 0, 0, 1, 1 };
    static const Vec3 arc[] = { { 0, 0, 1 }, { .5, 1, 1 }, { 1, 0, 1 } }, back[] = { { 1, 0, 1 }, { 0, 0, 1 } };
    const TrimCurveDesc curves[] = { { 3, 3, knots, arc }, { 2, 2, line, back } };
    const TrimLoopDesc loop = { curves, 2, false };   /* v = 2 u (1 - u), clockwise */
    OracleTrims *o = oracle_trims_new(&loop, 1);
    int winding;
    double distance;
    CHECK(!oracle_winding(o, 0, .25, .375, &winding, &distance), "winding %d", winding);
    CHECK_WITHIN(distance, 1e-30, "on the arc");
    CHECK(oracle_winding(o, 0, .25, nextafter(.375, 0), &winding, &distance) && winding == -1, "%d", winding);
    CHECK(oracle_winding(o, 0, .25, nextafter(.375, 1), &winding, &distance) && winding == 0, "%d", winding);
    oracle_trims_free(o);
}

static void nested_trims_keep_what_their_directions_say(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const TrimLoopDesc loops[] = { rectangle(a, .1, .9, .1, .9, true), circle(a, vec2(.5, .5), .3, false),
                                   circle(a, vec2(.5, .5), .1, true) };
    static const double at[4] = { .05, .15, .3, .45 };
    static const bool kept[4] = { false, true, false, true };
    OracleTrims *o = oracle_trims_new(loops, 3);
    for (int i = 0; i < 4; i++) {
        bool is_kept;
        double distance;
        CHECK(oracle_keeps(o, false, at[i], .5, &is_kept, &distance) && is_kept == kept[i], "ring %d", i);
        CHECK(oracle_keeps(o, true, at[i], .5, &is_kept, &distance) && is_kept != kept[i], "ring %d, left", i);
    }
    oracle_trims_free(o);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roots_are_those_of_the_closed_forms),
        cmocka_unit_test(a_corner_far_from_the_middle_is_seen),
        cmocka_unit_test(a_root_is_good_to_thirty_digits),
        cmocka_unit_test(a_tangent_is_a_cluster_and_a_miss_is_none),
        cmocka_unit_test(a_root_on_a_knot_or_a_corner_is_one_root),
        cmocka_unit_test(the_ray_in_a_plane_is_a_cluster),
        cmocka_unit_test(a_circle_goes_round_its_inside_once),
        cmocka_unit_test(a_point_on_a_trim_is_too_close_to_tell),
        cmocka_unit_test(nested_trims_keep_what_their_directions_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
