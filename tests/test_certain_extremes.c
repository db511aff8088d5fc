/* `method certain`: rays that leave a surface that they met. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_that_leaves_does_not_meet_what_it_leaves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
