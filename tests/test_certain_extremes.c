/* `method certain` where there is no table to make: rays that leave a surface, numbers that are no numbers. */
#include "tests/stress/model.h"

#include <string.h>

enum { CERTAIN = NURBS_METHOD_CERTAIN };

static Model round_thing(Arena *a, int which, double size, double offset, TestRandom *r)
{
    Net n;
    Form f = which == 0 ? form_sphere(a, &n) : which == 1 ? form_torus(a, .4, &n) : form_saddle(a, 1, &n);
    Model m = model_new(a, f, n);
    QuadMap place = model_rotation(r, size);
    place.o = quad3_scale(random_direction(r), size * offset);
    model_finish(&m, &place, NULL, 0);
    return m;
}

static Trace new_trace(void)
{
    Trace t;
    memset(&t, 0, sizeof t);
    t.scratch = arena_new();
    return t;
}

/* Starting hit_offset off the surface, as the renderer does, with t_min 0: whatever is met within a thousandth of the
 * size is the surface that was left, for its radius of curvature is a tenth or more and the direction is no flatter than
 * 0.1. */
static void a_ray_that_leaves_does_not_meet_what_it_leaves(void **state)
{
    (void)state;
    static const double sizes[] = { 1e-6, 1, 1e6 }, offsets[] = { 0, 1e3 };
    for (unsigned seed = 0; seed < 180; seed++) {
        TestRandom random = test_random(seed);
        Arena *a = arena_new();
        Model m = round_thing(a, (int)(seed % 3), sizes[seed / 3 % 3], offsets[seed / 9 % 2], &random);
        Trace trace = new_trace();
        for (int i = 0; i < 100; i++) {
            Ray r = ray_anywhere(&m, 0, &random);
            Hit hit = { .t = INFINITY }, again = { .t = INFINITY };
            if (!shape_hit(m.shape[CERTAIN], &r, &hit, &trace)) continue;
            Attributes at;
            m.shape[CERTAIN]->type->attributes(m.shape[CERTAIN], &r, &hit, &at);
            Vec3 d = quad3_round(random_direction(&random));
            double slope = vec_dot(d, at.normal);
            if (fabs(slope) < .1) continue;
            Vec3 off = vec_scale(at.normal, copysign(hit_offset(&hit, &r), slope));
            Ray away = { vec_add(ray_at(&r, hit.t), off), d, 0 };
            bool meets = shape_hit(m.shape[CERTAIN], &away, &again, &trace);
            CHECK(!meets || again.t > 1e-3 * m.size, "seed %u, ray %d: %s, size %g: again at %g", seed, i, m.at.form.name,
                  m.size, again.t);
        }
        arena_free(trace.scratch);
        shape_release(m.shape[CERTAIN]);
        arena_free(a);
    }
}

static void a_ray_of_no_numbers_meets_nothing(void **state)
{
    (void)state;
    static const double odd[] = { NAN, INFINITY, -INFINITY, 0, 5e-324, 1e308, -1e308, 1 };
    enum { N = sizeof odd / sizeof *odd };
    Arena *a = arena_new();
    TestRandom random = test_random(3);
    Trace trace = new_trace();
    for (int which = 0; which < 3; which++) {
        Model m = round_thing(a, which, 1, 0, &random);
        for (int i = 0; i < 3000; i++) {
            double x[6];
            for (int k = 0; k < 6; k++) {
                double plain = test_range(&random, -1, 1);
                x[k] = test_int(&random, 0, 1) ? odd[test_int(&random, 0, N - 1)] : plain;
            }
            Ray r = { vec(x[0], x[1], x[2]), vec(x[3], x[4], x[5]), 0 };
            Hit hit = { .t = INFINITY };
            bool is_hit = shape_hit(m.shape[CERTAIN], &r, &hit, &trace);
            bool is_finite = vec_is_finite(r.origin) && vec_is_finite(r.dir) && vec_max_abs(r.dir) > 0;
            CHECK(!is_hit || (is_finite && isfinite(hit.t) && hit.t > 0), "%s, (%g, %g, %g) + t (%g, %g, %g): t %g",
                  m.at.form.name, x[0], x[1], x[2], x[3], x[4], x[5], hit.t);
            (void)shape_blocks(m.shape[CERTAIN], &r, INFINITY, &trace);
        }
        shape_release(m.shape[CERTAIN]);
    }
    arena_free(trace.scratch);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_that_leaves_does_not_meet_what_it_leaves),
        cmocka_unit_test(a_ray_of_no_numbers_meets_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
