#include "tests/test.h"

#include "render/xform.h"

static const double U = 0x1p-53;

static Vec3 any_vector(TestRandom *r, double size)
{
    double x = test_range(r, -size, size), y = test_range(r, -size, size);
    return vec(x, y, test_range(r, -size, size));
}

static Xform any_xform(TestRandom *r)
{
    Xform x = xform_scale(vec(test_range(r, .2, 5), test_range(r, .2, 5), -test_range(r, .2, 5)));
    x = xform_then(x, xform_rotate(any_vector(r, 180)));
    x = xform_then(x, xform_translate(any_vector(r, 10)));
    return xform_then(x, xform_axis_rotate(any_vector(r, 1), test_range(r, -180, 180)));
}

static double distance(Vec3 a, Vec3 b) { return vec_length(vec_sub(a, b)); }

/* The values that POV-Ray prints for vrotate and vaxis_rotate: left-handed, x before y before z. */
static void rotations_turn_as_povray_turns(void **state)
{
    (void)state;
    Xform x = xform_rotate(vec(90, 0, 0)), y = xform_rotate(vec(0, 90, 0)), z = xform_rotate(vec(0, 0, 90));
    assert_true(distance(xform_point(&x, vec(0, 1, 0)), vec(0, 0, 1)) == 0);
    assert_true(distance(xform_point(&y, vec(0, 0, 1)), vec(1, 0, 0)) == 0);
    assert_true(distance(xform_point(&z, vec(1, 0, 0)), vec(0, 1, 0)) == 0);
    Xform xyz = xform_rotate(vec(90, 90, 0));
    assert_true(distance(xform_point(&xyz, vec(0, 1, 0)), vec(1, 0, 0)) == 0);
    Vec3 p = vec(.3, -.7, 1.1);
    double a = 33 * acos(-1) / 180, c = cos(a), s = sin(a);
    Xform t = xform_rotate(vec(33, 0, 0));
    CHECK_WITHIN(distance(xform_point(&t, p), vec(p.x, p.y * c - p.z * s, p.y * s + p.z * c)), 8 * U, "x");
    t = xform_rotate(vec(0, 33, 0));
    CHECK_WITHIN(distance(xform_point(&t, p), vec(p.x * c + p.z * s, p.y, -p.x * s + p.z * c)), 8 * U, "y");
    t = xform_rotate(vec(0, 0, 33));
    CHECK_WITHIN(distance(xform_point(&t, p), vec(p.x * c - p.y * s, p.x * s + p.y * c, p.z)), 8 * U, "z");
}

static void quarter_turns_are_exact(void **state)
{
    (void)state;
    for (int n = -9; n <= 9; n++) {
        static const double sine[4] = { 0, 1, 0, -1 }, cosine[4] = { 1, 0, -1, 0 };
        Xform z = xform_rotate(vec(0, 0, 90. * n));
        Vec3 p = xform_point(&z, vec(1, 0, 0));
        CHECK(p.x == cosine[n & 3] && p.y == sine[n & 3] && p.z == 0, "%d quarters: %g %g", n, p.x, p.y);
    }
}

static void turning_about_an_axis_is_turning_about_a_coordinate_axis(void **state)
{
    (void)state;
    TestRandom r = test_random(4);
    for (int i = 0; i < 1000; i++) {
        double angle = test_range(&r, -400, 400);
        Vec3 p = any_vector(&r, 1), axis = any_vector(&r, 1);
        Vec3 turns[3] = { vec(angle, 0, 0), vec(0, angle, 0), vec(0, 0, angle) };
        Vec3 axes[3] = { vec(2, 0, 0), vec(0, 1e-9, 0), vec(0, 0, 1e200) };
        for (int k = 0; k < 3; k++) {
            Xform a = xform_axis_rotate(axes[k], angle), b = xform_rotate(turns[k]);
            CHECK_WITHIN(distance(xform_point(&a, p), xform_point(&b, p)), 16 * U, "case %d, axis %d", i, k);
        }
        Xform a = xform_axis_rotate(axis, angle);
        CHECK_WITHIN(distance(xform_point(&a, axis), axis), 16 * U, "case %d: the axis moves", i);
        CHECK_WITHIN(fabs(vec_length(xform_point(&a, p)) - vec_length(p)), 16 * U, "case %d: lengths change", i);
    }
}

static void composing_applies_one_after_the_other(void **state)
{
    (void)state;
    TestRandom r = test_random(5);
    for (int i = 0; i < 1000; i++) {
        Xform a = any_xform(&r), b = any_xform(&r), ab = xform_then(a, b);
        Vec3 p = any_vector(&r, 3), expected = xform_point(&b, xform_point(&a, p));
        CHECK_WITHIN(distance(xform_point(&ab, p), expected), 64 * U * 1000, "case %d", i);
        CHECK_WITHIN(distance(xform_unpoint(&ab, expected), p), 64 * U * 10000, "case %d: back", i);
        Xform inverse = xform_inverse(ab);
        CHECK_WITHIN(distance(xform_point(&inverse, expected), p), 64 * U * 10000, "case %d: inverse", i);
    }
}

/* A normal is what is perpendicular to two directions in the surface; so it stays after the map. */
static void normals_stay_perpendicular(void **state)
{
    (void)state;
    TestRandom r = test_random(6);
    for (int i = 0; i < 1000; i++) {
        Xform x = any_xform(&r);
        Vec3 n = vec_normalize(any_vector(&r, 1)), v = vec_cross(n, any_vector(&r, 1));
        Vec3 n1 = vec_normalize(xform_normal(&x, n)), v1 = vec_normalize(xform_vector(&x, v));
        CHECK_WITHIN(fabs(vec_dot(n1, v1)), 500 * U, "case %d", i);
        CHECK(vec_dot(xform_normal(&x, n), xform_vector(&x, n)) > 0, "case %d: the side changed", i);
        CHECK_WITHIN(distance(xform_unnormal(&x, xform_normal(&x, n)), n), 5000 * U, "case %d: back", i);
        CHECK_WITHIN(distance(xform_unvector(&x, xform_vector(&x, v)), v), 5000 * U, "case %d: back", i);
    }
}

static void a_matrix_is_inverted_at_any_scale(void **state)
{
    (void)state;
    TestRandom r = test_random(7);
    for (int i = 0; i < 2000; i++) {
        double m[12], row[4];
        for (int k = 0; k < 4; k++) row[k] = pow(10, test_range(&r, -60, 60));
        for (int k = 0; k < 12; k++) m[k] = (test_range(&r, -.3, .3) + (k % 4 == 0)) * row[k / 3];
        Xform x;
        CHECK(xform_from_matrix(m, &x), "case %d was called singular", i);
        for (int k = 0; k < 3; k++) {
            Vec3 e = vec(k == 0, k == 1, k == 2), back = xform_unvector(&x, xform_vector(&x, e));
            CHECK_WITHIN(fabs((k == 0 ? back.x : k == 1 ? back.y : back.z) - 1), 200 * U, "case %d, axis %d", i, k);
        }
    }
}

static void singular_matrices_are_refused(void **state)
{
    (void)state;
    static const double bad[][12] = {
        { 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 },
        { 1, 2, 3, 2, 4, 6, 0, 1, 5, 0, 0, 0 },
        { .1, .2, .3, .2, .4, .6, .7, .11, .13, 0, 0, 0 },
        { 1, 1, 0, 0, 1, 1, 1, 2, 1, 0, 0, 0 },
        { 1e-200, 2e-200, 0, 2e-200, 4e-200, 0, 0, 0, 1, 0, 0, 0 },
        { 1, 0, 0, 0, INFINITY, 0, 0, 0, 1, 0, 0, 0 },
        { 1, 0, 0, 0, 1, 0, 0, 0, 1, NAN, 0, 0 },
    };
    Xform x;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) CHECK(!xform_from_matrix(bad[i], &x), "matrix %zu", i);
    static const double good[12] = { 1, 0, 0, 0, 1e-12, 0, 1, 1, 1e9, 5, 6, 7 };
    CHECK(xform_from_matrix(good, &x), "a matrix that is not singular");
}

/* The image of a box contains the images of its corners, and is no larger than it must be: each side touches a corner. */
static void the_image_of_a_box_is_that_of_its_corners(void **state)
{
    (void)state;
    TestRandom r = test_random(8);
    for (int i = 0; i < 5000; i++) {
        double size = pow(10, test_range(&r, -6, 6));
        Xform x = any_xform(&r);
        Box b = box_from(any_vector(&r, size), any_vector(&r, size)), image = xform_box(&x, b);
        Vec3 corners[8];
        for (int k = 0; k < 8; k++) {
            Vec3 corner = vec(k & 1 ? b.lo[0] : b.hi[0], k & 2 ? b.lo[1] : b.hi[1], k & 4 ? b.lo[2] : b.hi[2]);
            corners[k] = xform_point(&x, corner);
        }
        Box tight = box_of_points(corners, 8);
        for (int k = 0; k < 8; k++) CHECK(box_contains(image, corners[k]), "case %d, corner %d", i, k);
        double slack = 1e-6 * (box_diagonal(tight) + vec_length(box_centre(tight)));   /* some float roundings */
        for (int k = 0; k < 3; k++) {
            CHECK_WITHIN((double)tight.lo[k] - image.lo[k], slack, "case %d, lower side %d", i, k);
            CHECK_WITHIN((double)image.hi[k] - tight.hi[k], slack, "case %d, upper side %d", i, k);
        }
    }
}

static void infinite_and_empty_boxes_stay_so(void **state)
{
    (void)state;
    Xform turned = xform_rotate(vec(0, 0, 45)), flipped = xform_scale(vec(-1, 1, 1));
    Box half = box_infinite();
    half.lo[0] = 3;
    CHECK(box_is_empty(xform_box(&turned, box_empty())), "empty");
    Box all = xform_box(&turned, box_infinite());
    for (int k = 0; k < 3; k++) CHECK(all.lo[k] == -INFINITY && all.hi[k] == INFINITY, "infinite, axis %d", k);
    Box other = xform_box(&flipped, half);
    CHECK(other.lo[0] == -INFINITY && other.hi[0] >= -3 && other.hi[0] < -2.9, "half: %g %g", other.lo[0], other.hi[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rotations_turn_as_povray_turns),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(turning_about_an_axis_is_turning_about_a_coordinate_axis),
        cmocka_unit_test(composing_applies_one_after_the_other),
        cmocka_unit_test(normals_stay_perpendicular),
        cmocka_unit_test(a_matrix_is_inverted_at_any_scale),
        cmocka_unit_test(singular_matrices_are_refused),
        cmocka_unit_test(the_image_of_a_box_is_that_of_its_corners),
        cmocka_unit_test(infinite_and_empty_boxes_stay_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
