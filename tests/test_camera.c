/* Cameras against POV-Ray's measured rays and against geometry: angles, what lies in the middle, what stays up. */
#include "render/camera.h"
#include "tests/test.h"

static const double ROUNDING = 1e-14;   /* relative: a dozen operations in double */

static Camera made(const CameraDesc *desc, CameraStatus expected)
{
    Camera c = { 0 };
    CameraStatus status = camera_make(desc, &c);
    CHECK(status == expected, "status %d, expected %d", (int)status, (int)expected);
    return c;
}

static double apart(Vec3 a, Vec3 b) { return vec_length(vec_sub(a, b)); }
static Vec3 random_vec(TestRandom *r, double size)
{
    return vec(test_range(r, -size, size), test_range(r, -size, size), test_range(r, -size, size));
}

static void a_scene_without_a_camera_looks_along_z(void **state)
{
    (void)state;
    CameraDesc desc = camera_desc_default();
    Camera c = made(&desc, CAMERA_OK);
    Ray r = camera_ray(&c, 0, 0, 4, 3);
    CHECK_WITHIN(apart(r.dir, vec(-.4277, .2858, .8575)), 1e-4, "POV-Ray's, to the digits measured");
    CHECK(vec_max_abs(r.origin) == 0 && r.t_min == 0, "starts at the origin");
    Ray middle = camera_ray(&c, 1.5, 1, 4, 3);
    CHECK_WITHIN(apart(middle.dir, vec(0, 0, 1)), ROUNDING, "the middle");
}

static void the_angle_is_that_between_the_left_and_right_borders(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 200; seed++) {
        TestRandom r = test_random(seed);
        CameraDesc desc = camera_desc_default();
        desc.location = random_vec(&r, 10), desc.look_at = random_vec(&r, 10), desc.has_look_at = true;
        desc.right = vec_scale(random_vec(&r, 1), 3);
        desc.angle = test_range(&r, 1, 179), desc.has_angle = true;
        Camera c = made(&desc, CAMERA_OK);
        Ray left = camera_ray(&c, -.5, 49.5, 100, 100), right = camera_ray(&c, 99.5, 49.5, 100, 100);
        double angle = 2 * asin(apart(left.dir, right.dir) / 2) * (180 / M_PI);
        CHECK_WITHIN(fabs(angle - desc.angle), 1e-11, "seed %u", seed);
    }
}

static void look_at_comes_to_the_middle_and_sky_stays_up(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 200; seed++) {
        TestRandom r = test_random(seed);
        CameraDesc desc = camera_desc_default();
        desc.location = random_vec(&r, 10), desc.look_at = random_vec(&r, 10), desc.has_look_at = true;
        desc.sky = random_vec(&r, 5);
        desc.right = vec(seed % 2 ? 1.5 : -1.5, 0, 0);
        Camera c = made(&desc, CAMERA_OK);
        Vec3 to = vec_normalize(vec_sub(desc.look_at, desc.location));
        CHECK_WITHIN(apart(camera_ray(&c, 31.5, 23.5, 64, 48).dir, to), ROUNDING, "seed %u", seed);
        CHECK_WITHIN(fabs(vec_dot(c.right, vec_normalize(desc.sky))), 2 * ROUNDING, "right is level, seed %u", seed);
        CHECK(vec_dot(c.up, desc.sky) > 0, "up is up, seed %u", seed);
        CHECK_WITHIN(fabs(vec_length(c.right) - 1.5), ROUNDING, "lengths stay, seed %u", seed);
        double hand = vec_dot(vec_cross(c.up, c.direction), c.right);
        CHECK(seed % 2 ? hand > 0 : hand < 0, "handedness stays, seed %u", seed);
    }
}

/* Measured: on which side x > 0 appears. */
static void a_negative_right_vector_turns_the_picture_over(void **state)
{
    (void)state;
    CameraDesc desc = camera_desc_default();      /* camera{right <-4/3,0,0> location <0,0,-5> look_at 0} */
    desc.right = vec(-4. / 3, 0, 0), desc.location = vec(0, 0, -5), desc.look_at = vec(0, 0, 0), desc.has_look_at = true;
    Camera c = made(&desc, CAMERA_OK);
    CHECK_WITHIN(apart(c.right, vec(-4. / 3, 0, 0)), ROUNDING, "x is to the left");
    desc.sky = desc.up = vec(0, 0, 1), desc.direction = vec(0, 1, 0), desc.location = vec(0, -5, 0);
    c = made(&desc, CAMERA_OK);                   /* sky z up z right <-4/3,0,0> direction y location <0,-5,0> */
    CHECK_WITHIN(apart(c.right, vec(-4. / 3, 0, 0)), ROUNDING, "x is to the left");
    CHECK_WITHIN(apart(c.up, vec(0, 0, 1)), ROUNDING, "z is up");
    desc.direction = vec(0, 0, 1);                /* the same without direction: up and direction are parallel */
    c = made(&desc, CAMERA_OK);
    CHECK_WITHIN(apart(c.right, vec(4. / 3, 0, 0)), ROUNDING, "x is to the right");
}

static void a_camera_that_looks_along_sky_keeps_its_right_vector(void **state)
{
    (void)state;
    CameraDesc desc = camera_desc_default();      /* measured: camera{location <0,5,0> look_at 0} */
    desc.location = vec(0, 5, 0), desc.look_at = vec(0, 0, 0), desc.has_look_at = true;
    Camera c = made(&desc, CAMERA_SKY_ALONG_DIRECTION);
    CHECK_WITHIN(apart(c.right, vec(1.33, 0, 0)), ROUNDING, "right");
    CHECK_WITHIN(apart(c.up, vec(0, 0, 1)), ROUNDING, "up");
}

static void an_orthographic_camera_with_an_angle_shows_what_a_perspective_one_does_at_look_at(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        CameraDesc desc = camera_desc_default();
        desc.location = random_vec(&r, 10), desc.look_at = random_vec(&r, 10), desc.has_look_at = true;
        desc.has_angle = seed % 2, desc.angle = test_range(&r, 5, 120);
        double distance = apart(desc.location, desc.look_at);
        Camera p = made(&desc, CAMERA_OK);
        desc.kind = CAMERA_ORTHOGRAPHIC;
        Camera o = made(&desc, CAMERA_OK);
        double x = test_range(&r, 0, 79), y = test_range(&r, 0, 59);
        Ray a = camera_ray(&p, x, y, 80, 60), b = camera_ray(&o, x, y, 80, 60);
        Vec3 towards = vec_normalize(vec_sub(desc.look_at, desc.location));
        Vec3 in_focus = ray_at(&a, distance / vec_dot(a.dir, towards));
        CHECK_WITHIN(apart(in_focus, ray_at(&b, distance)), 1e-12 * distance, "seed %u", seed);
        CHECK_WITHIN(apart(b.dir, towards), ROUNDING, "seed %u: parallel rays", seed);
    }
}

static void an_orthographic_camera_with_its_own_vectors_is_as_large_as_they_are(void **state)
{
    (void)state;
    CameraDesc desc = camera_desc_default();      /* the camera of the antialiasing measurements */
    desc.kind = CAMERA_ORTHOGRAPHIC, desc.location = vec(0, 0, -1);
    desc.right = vec(3, 0, 0), desc.up = vec(0, 3, 0), desc.has_right_or_up = true;
    Camera c = made(&desc, CAMERA_OK);
    CHECK_WITHIN(apart(camera_ray(&c, 0, 0, 3, 3).origin, vec(-1, 1, -1)), ROUNDING, "top left pixel centre");
    CHECK_WITHIN(apart(camera_ray(&c, 2, 2, 3, 3).origin, vec(1, -1, -1)), ROUNDING, "bottom right");
}

static void transformations_act_last(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        CameraDesc desc = camera_desc_default();
        desc.kind = seed % 2 ? CAMERA_PERSPECTIVE : CAMERA_ORTHOGRAPHIC;
        desc.location = random_vec(&r, 3), desc.look_at = random_vec(&r, 3), desc.has_look_at = true;
        Camera plain = made(&desc, CAMERA_OK);
        desc.xform = xform_then(xform_rotate(random_vec(&r, 180)), xform_translate(random_vec(&r, 5)));
        Camera moved = made(&desc, CAMERA_OK);
        double x = test_range(&r, 0, 63), y = test_range(&r, 0, 63);
        Ray a = camera_ray(&plain, x, y, 64, 64), b = camera_ray(&moved, x, y, 64, 64);
        CHECK_WITHIN(apart(xform_vector(&desc.xform, a.dir), b.dir), 10 * ROUNDING, "seed %u", seed);
        CHECK_WITHIN(apart(xform_point(&desc.xform, a.origin), b.origin), 100 * ROUNDING, "seed %u", seed);
    }
}

static void what_cannot_be_a_camera_is_said(void **state)
{
    (void)state;
    CameraDesc desc = camera_desc_default();
    desc.has_angle = true, desc.angle = 180;
    made(&desc, CAMERA_ANGLE_TOO_LARGE);
    desc.angle = -1;
    made(&desc, CAMERA_ANGLE_NEGATIVE);
    desc.angle = 0;
    made(&desc, CAMERA_OK);
    desc.location = desc.look_at = vec(1, 2, 3), desc.has_look_at = true;
    made(&desc, CAMERA_LOOKS_AT_ITSELF);
    desc = camera_desc_default();
    desc.up = vec(.1, 1, 0);
    made(&desc, CAMERA_NOT_PERPENDICULAR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_without_a_camera_looks_along_z),
        cmocka_unit_test(the_angle_is_that_between_the_left_and_right_borders),
        cmocka_unit_test(look_at_comes_to_the_middle_and_sky_stays_up),
        cmocka_unit_test(a_negative_right_vector_turns_the_picture_over),
        cmocka_unit_test(a_camera_that_looks_along_sky_keeps_its_right_vector),
        cmocka_unit_test(an_orthographic_camera_with_an_angle_shows_what_a_perspective_one_does_at_look_at),
        cmocka_unit_test(an_orthographic_camera_with_its_own_vectors_is_as_large_as_they_are),
        cmocka_unit_test(transformations_act_last),
        cmocka_unit_test(what_cannot_be_a_camera_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
