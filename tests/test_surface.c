/* Surface: what is copied, what is refused, what is known of it. */
#include "nurbs/surface.h"
#include "tests/models.h"

static NurbsError verdict(const Model *m)
{
    Arena *a = arena_new();
    SurfaceDesc d = model_desc(m);
    NurbsError e;
    Surface *s = surface_new(a, &d, &e, NULL, 0, NULL);
    CHECK((s != NULL) == (e.code == NURBS_OK), "code %d", e.code);
    arena_free(a);
    return e;
}

static void check_error(const Model *m, NurbsCode code, NurbsWhere where, int index, int other)
{
    NurbsError e = verdict(m);
    CHECK(e.code == code && e.where == where, "code %d in %d", e.code, e.where);
    CHECK(e.index == index && e.other == other, "index %d other %d", e.index, e.other);
}

static void each_error_has_its_code_and_place(void **state)
{
    (void)state;
    Model good, m;
    model_torus(&good, 0.4);
    CHECK(verdict(&good).code == NURBS_OK, "the torus");
    m = good, m.k_u = 1, check_error(&m, NURBS_BAD_ORDER, NURBS_IN_SURFACE_U, 0, 1);
    m = good, m.k_v = 33, check_error(&m, NURBS_BAD_ORDER, NURBS_IN_SURFACE_V, 1, 33);
    m = good, m.n_u = 2, check_error(&m, NURBS_TOO_FEW_POINTS, NURBS_IN_SURFACE_U, 0, 3);
    m = good, m.n_v = 2, check_error(&m, NURBS_TOO_FEW_POINTS, NURBS_IN_SURFACE_V, 1, 3);
    m = good, m.knots_u[4] = 0.5, check_error(&m, NURBS_KNOTS_DECREASE, NURBS_IN_SURFACE_U, 4, 3);
    m = good, m.knots_v[5] = NAN, check_error(&m, NURBS_KNOT_NOT_FINITE, NURBS_IN_SURFACE_V, 5, 0);
    m = good, m.knots_v[3] = m.knots_v[4] = 0, check_error(&m, NURBS_KNOT_MULTIPLICITY, NURBS_IN_SURFACE_V, 3, 3);
    m = good, m.points[7].w = 0, check_error(&m, NURBS_BAD_WEIGHT, NURBS_IN_SURFACE_POINTS, 7, 0);
    m = good, m.points[8].w = -1, check_error(&m, NURBS_BAD_WEIGHT, NURBS_IN_SURFACE_POINTS, 8, 0);
    m = good, m.points[9].w = INFINITY, check_error(&m, NURBS_BAD_WEIGHT, NURBS_IN_SURFACE_POINTS, 9, 0);
    m = good, m.points[80].y = NAN, check_error(&m, NURBS_POINT_NOT_FINITE, NURBS_IN_SURFACE_POINTS, 80, 1);
}

static void an_empty_domain_is_an_error(void **state)
{
    (void)state;
    Model m = { .k_u = 3, .k_v = 2, .n_u = 3, .n_v = 2, .knots_u = { 0, 1, 1, 1, 2, 3 }, .knots_v = { 0, 0, 1, 1 } };
    for (int i = 0; i < 6; i++) m.points[i] = vec4(i, 0, 0, 1);
    check_error(&m, NURBS_EMPTY_DOMAIN, NURBS_IN_SURFACE_U, 2, 3);
}

static Surface *surface_of(Arena *a, const Model *m)
{
    SurfaceDesc d = model_desc(m);
    NurbsError e;
    Surface *s = surface_new(a, &d, &e, NULL, 0, NULL);
    CHECK(s, "code %d", e.code);
    return s;
}

static void everything_is_copied(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Model m;
    model_sphere(&m);
    Surface *s = surface_of(a, &m);
    memset(&m, 0xFF, sizeof m);
    Vec3 p, s_u, s_v;
    surface_point(s, 1, 1, &p, &s_u, &s_v);
    CHECK_WITHIN(vec_length(vec_sub(p, vec(0, 1, 0))), 1e-15, "a quarter round the equator");
    CHECK(s->u0 == 0 && s->u1 == 4 && s->v0 == 0 && s->v1 == 2, "domain");
    arena_free(a);
}

static void equal_weights_make_a_polynomial(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TestRandom r = test_random(1);
    Model m = { .k_u = 3, .k_v = 3, .n_u = 3, .n_v = 3, .knots_u = { 0, 0, 0, 1, 1, 1 }, .knots_v = { 0, 0, 0, 1, 1, 1 } };
    model_random_points(&r, &m, 1);
    Surface *one = surface_of(a, &m);
    for (int i = 0; i < 9; i++) m.points[i].w = 0.3;
    Surface *third = surface_of(a, &m);
    CHECK(one->is_polynomial && third->is_polynomial, "weights");
    CHECK(memcmp(one->p, third->p, 9 * sizeof *one->p) == 0, "the weight is dropped");
    m.points[4].w = 0.31;
    CHECK(!surface_of(a, &m)->is_polynomial, "one differs");
    arena_free(a);
}

static void weights_scale_freely(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Model m;
    model_torus(&m, 0.4);
    Surface *plain = surface_of(a, &m);
    for (int i = 0; i < 81; i++) m.points[i].w *= 0x1p900, m.points[i].x *= 0x1p300;     /* w x would overflow */
    Surface *large = surface_of(a, &m);
    for (int i = 0; i < 50; i++) {
        Vec3 p, q, s_u, s_v;
        surface_point(plain, 0.08 * i, 4 - 0.07 * i, &p, &s_u, &s_v);
        surface_point(large, 0.08 * i, 4 - 0.07 * i, &q, &s_u, &s_v);
        CHECK(p.x * 0x1p300 == q.x && p.y == q.y && p.z == q.z, "point %d", i);
    }
    arena_free(a);
}

static void the_sphere_is_one(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Model m;
    model_sphere(&m);
    Surface *s = surface_of(a, &m);
    TestRandom r = test_random(3);
    for (int i = 0; i < 1000; i++) {
        Vec3 p, s_u, s_v;
        surface_point(s, test_range(&r, 0, 4), test_range(&r, 0, 2), &p, &s_u, &s_v);
        CHECK_WITHIN(fabs(vec_length(p) - 1), s->rounding, "point %d", i);
        CHECK_WITHIN(fabs(vec_dot(p, s_u)), 1e-14, "S_u is tangent");
        CHECK_WITHIN(fabs(vec_dot(p, s_v)), 1e-14, "S_v is tangent");
        CHECK(box_contains(s->box, p), "point %d", i);
    }
    arena_free(a);
}

/* With unclamped knots, points before and after the domain matter only if their functions reach into it. */
static void points_that_do_not_matter_do_not_count(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Model m = { .k_u = 2, .k_v = 2, .n_u = 4, .n_v = 2, .knots_u = { 0, 1, 1, 2, 3, 4 }, .knots_v = { 0, 0, 1, 1 } };
    for (int i = 0; i < 8; i++) m.points[i] = vec4(i % 4 == 0 ? 100 : i % 4, i / 4, 0, 1);
    Surface *s = surface_of(a, &m);                /* the domain is [1, 3]: N_0 ends at 1, where span [1, 1] is empty */
    CHECK(s->box.hi[0] < 4 && s->box.lo[0] < 1.1f, "box [%g, %g]", s->box.lo[0], s->box.hi[0]);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_error_has_its_code_and_place),
        cmocka_unit_test(an_empty_domain_is_an_error),
        cmocka_unit_test(everything_is_copied),
        cmocka_unit_test(equal_weights_make_a_polynomial),
        cmocka_unit_test(weights_scale_freely),
        cmocka_unit_test(the_sphere_is_one),
        cmocka_unit_test(points_that_do_not_matter_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
