#include "tests/test.h"

#include "render/box.h"

#include <float.h>

/* A number of either sign, its size log-uniform over 16 decades; 0 now and then. */
static double any_number(TestRandom *r)
{
    if (test_int(r, 0, 9) == 0) return 0;
    return (test_int(r, 0, 1) ? 1 : -1) * pow(10, test_range(r, -8, 8));
}

static Vec3 any_vector(TestRandom *r)
{
    double x = any_number(r), y = any_number(r);
    return vec(x, y, any_number(r));
}

static void floats_are_rounded_outward(void **state)
{
    (void)state;
    TestRandom r = test_random(1);
    for (int i = 0; i < 100000; i++) {
        double x = any_number(&r);
        float down = float_down(x), up = float_up(x);
        CHECK(down <= x && x <= up, "%.17g: %.9g %.9g", x, down, up);
        CHECK(nextafterf(down, INFINITY) > x || down == x, "%.17g: %.9g is not the largest", x, down);
        CHECK(nextafterf(up, -INFINITY) < x || up == x, "%.17g: %.9g is not the smallest", x, up);
    }
    CHECK(float_down(1e300) == FLT_MAX && float_up(1e300) == INFINITY, "beyond the range of float");
    CHECK(float_down(-1e-300) < 0 && float_up(-1e-300) == 0, "below the range of float");
}

static void boxes_contain_what_they_are_made_of(void **state)
{
    (void)state;
    TestRandom r = test_random(2);
    for (int i = 0; i < 20000; i++) {
        Vec3 p[5];
        for (int k = 0; k < 5; k++) p[k] = any_vector(&r);
        double by = fabs(any_number(&r));
        Box b = box_of_points(p, 5), wide = box_expand(b, by), around = box_around(p[0], vec(by, by, by));
        Box both = box_union(box_from(p[0], p[1]), box_from(p[2], p[3]));
        for (int k = 0; k < 5; k++) CHECK(box_contains(b, p[k]) && box_contains(wide, p[k]), "case %d, point %d", i, k);
        for (int k = 0; k < 4; k++) CHECK(box_contains(both, p[k]), "case %d, point %d", i, k);
        CHECK((long double)wide.lo[0] <= (long double)b.lo[0] - by, "case %d: lower side", i);
        CHECK((long double)wide.hi[2] >= (long double)b.hi[2] + by, "case %d: upper side", i);
        CHECK((long double)around.lo[1] <= (long double)p[0].y - by, "case %d: lower side", i);
        CHECK((long double)around.hi[1] >= (long double)p[0].y + by, "case %d: upper side", i);
    }
}

static void empty_boxes_hold_nothing_and_add_nothing(void **state)
{
    (void)state;
    Box e = box_empty(), b = box_from(vec(1, 2, 3), vec(-1, 5, 4)), u = box_union(e, b);
    CHECK(box_is_empty(e) && !box_is_finite(e) && !box_contains(e, vec(0, 0, 0)), "empty");
    CHECK(box_area(e) == 0 && box_diagonal(e) == 0, "empty: sizes");
    for (int k = 0; k < 3; k++) CHECK(u.lo[k] == b.lo[k] && u.hi[k] == b.hi[k], "axis %d", k);
    CHECK(box_is_empty(box_expand(e, 5)), "expanded");
    CHECK(box_is_empty(box_intersection(b, box_from(vec(7, 7, 7), vec(8, 8, 8)))), "intersection");
    CHECK(!box_is_finite(box_infinite()) && box_area(box_infinite()) == INFINITY, "infinite");
    CHECK(box_area(b) == 2 * (2 * 3 + 3 * 1 + 1 * 2), "area %g", box_area(b));
}

static double whole(TestRandom *r, int size) { return test_int(r, -size, size); }

/* A ray through a point of the box, in any direction, is not turned away; nor is its entry put too late. Whole numbers, so
 * that the ray passes through the point exactly; often on a face, an edge, a corner, where one rounding would lose it. */
static void a_ray_through_a_point_of_the_box_meets_it(void **state)
{
    (void)state;
    TestRandom r = test_random(3);
    for (int i = 0; i < 300000; i++) {
        double scale = ldexp(1, test_int(&r, -20, 20)), t = test_int(&r, 1, 1000), t_enter = -1;
        Box b;
        double dir[3], origin[3];
        for (int k = 0; k < 3; k++) {
            double a = whole(&r, 1000), c = whole(&r, 1000), within = test_int(&r, (int)fmin(a, c), (int)fmax(a, c));
            const double in[3] = { a, c, within };
            b.lo[k] = (float)(scale * fmin(a, c)), b.hi[k] = (float)(scale * fmax(a, c));
            dir[k] = test_int(&r, 0, 3) ? scale * whole(&r, 1000) : test_int(&r, 0, 1) ? 0. : -0.;
            origin[k] = scale * in[test_int(&r, 0, 2)] - t * dir[k];
        }
        BoxRay ray = box_ray(vec(origin[0], origin[1], origin[2]), vec(dir[0], dir[1], dir[2]));
        CHECK(box_hit(&b, &ray, 0, INFINITY, &t_enter), "seed 3, case %d", i);
        CHECK(t_enter >= 0 && t_enter <= t, "case %d: enters at %.17g, after %.17g", i, t_enter, t);
        CHECK(box_hit(&b, &ray, 0, t, &t_enter), "case %d: up to t", i);
        CHECK(box_hit(&b, &ray, t, INFINITY, &t_enter), "case %d: from t on", i);
    }
}

static bool meets(Box b, Vec3 origin, Vec3 dir)
{
    BoxRay r = box_ray(origin, dir);
    double t_enter;
    return box_hit(&b, &r, 0, INFINITY, &t_enter);
}

static void a_ray_beside_the_box_misses_it(void **state)
{
    (void)state;
    Box b = box_from(vec(-1, -1, -1), vec(1, 1, 1));
    const double small[] = { 0., -0., 1e-300, -1e-300, 1e-310, -1e-310 };
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) {
            double x = small[i], y = small[k];
            CHECK(!meets(b, vec(2, 0, -5), vec(x, y, 1)), "beside in x, %g %g", x, y);
            CHECK(!meets(b, vec(0, -2, -5), vec(x, y, 1)), "beside in y, %g %g", x, y);
            CHECK(!meets(b, vec(-1.0000001, 1.0000001, 5), vec(x, y, -1)), "beside a corner, %g %g", x, y);
            CHECK(!meets(b, vec(0, 0, 5), vec(x, y, 1)), "behind, %g %g", x, y);
            CHECK(meets(b, vec(0, 0, -5), vec(x, y, 1)), "through, %g %g", x, y);
            CHECK(meets(b, vec(1, 0, -5), vec(0 * x, 0 * y, 1)), "in a face, %g %g", x, y);
            CHECK(meets(b, vec(1, -1, -5), vec(0 * x, 0 * y, 1)), "in an edge, %g %g", x, y);
            CHECK(meets(b, vec(0, 0, 0), vec(x, y, 0)), "from inside, %g %g", x, y);
        }
    CHECK(!meets(box_empty(), vec(0, 0, 0), vec(0, 0, 1)), "an empty box");
    CHECK(meets(box_infinite(), vec(1e30, 0, 0), vec(1, 0, 0)), "an infinite box");
    CHECK(meets(box_from(vec(0, 0, 0), vec(0, 0, 0)), vec(-1, -1, -1), vec(1, 1, 1)), "a point");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_rounded_outward),
        cmocka_unit_test(boxes_contain_what_they_are_made_of),
        cmocka_unit_test(empty_boxes_hold_nothing_and_add_nothing),
        cmocka_unit_test(a_ray_through_a_point_of_the_box_meets_it),
        cmocka_unit_test(a_ray_beside_the_box_misses_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
