/* Partial refinement against evaluation by basis functions. */
#include "nurbs/basis.h"
#include "nurbs/knots.h"
#include "nurbs/refine.h"
#include "tests/models.h"

#define TOLERANCE 1e-13      /* relative: to 1 for values, to the largest slope, to the largest term of the surface's sums */

static double largest_of(int k, const double *x)
{
    double most = 0;
    for (int i = 0; i < k; i++) most = fmax(most, fabs(x[i]));
    return most;
}

static void check_row(int k, const double *tau, int mu, double t, unsigned seed)
{
    RefineRow row;
    double value[NURBS_MAX_ORDER], slope[NURBS_MAX_ORDER];
    refine_row(k, tau, mu, t, &row);
    basis_derivative(k, tau, mu, t, 0, value);
    basis_derivative(k, tau, mu, t, 1, slope);
    double steepest = largest_of(k, slope);
    CHECK(row.first == mu - k + 1 && row.count >= 2 && row.count <= k, "seed %u count %d", seed, row.count);
    for (int i = 0; i < k; i++) {
        double v = i < row.count ? row.value[i] : 0, s = i < row.count ? row.slope[i] : 0;
        CHECK_WITHIN(fabs(v - value[i]), TOLERANCE, "value: seed %u k %d t %.17g i %d", seed, k, t, i);
        CHECK_WITHIN(fabs(s - slope[i]), TOLERANCE * steepest, "slope: seed %u k %d t %.17g i %d", seed, k, t, i);
    }
}

/* At a knot (from both sides), beside it on both sides, between knots: and so at both ends of the domain. */
static void check_rows_of(int k, int n, const double *tau, TestRandom *r, unsigned seed)
{
    for (int i = k - 1; i <= n; i++) {
        double knot = tau[i], lo = tau[k - 1], hi = tau[n];
        double above = fmin(nextafter(knot, INFINITY), hi), below = fmax(nextafter(knot, -INFINITY), lo);
        double t[4] = { knot, above, below, test_range(r, lo, hi) };
        for (int j = 0; j < 4; j++) check_row(k, tau, knots_span(k, n, tau, t[j]), t[j], seed);
        check_row(k, tau, knots_span_left(k, n, tau, knot), knot, seed);
    }
}

static void rows_are_the_basis_functions_and_their_slopes(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 600; seed++) {
        TestRandom r = test_random(seed);
        double tau[4 * MODEL_MAX_KNOTS];
        int k = seed % 20 == 0 ? test_int(&r, 17, 32) : test_int(&r, 2, 16);
        int n = model_random_knots(&r, k, test_int(&r, 1, 5), k, tau);
        check_rows_of(k, n, tau, &r, seed);
    }
}

static void a_knot_of_multiplicity_n_leaves_max_of_k_minus_1_minus_n_and_1_steps(void **state)
{
    (void)state;
    const int k = 5;
    for (int n = 1; n <= k; n++) {
        double tau[32] = { 0, 0, 0, 0, 0 };
        for (int i = 0; i < n; i++) tau[k + i] = 1;
        for (int i = 0; i < k; i++) tau[k + n + i] = 2;
        RefineRow row;
        refine_row(k, tau, k + n - 1, 1, &row);
        CHECK(row.count == (k - 1 - n > 1 ? k - 1 - n : 1) + 1, "n %d: %d points", n, row.count);
    }
}

static Surface *surface_of(Arena *a, const Model *m)
{
    SurfaceDesc d = model_desc(m);
    NurbsError e;
    Surface *s = surface_new(a, &d, &e, NULL, 0, NULL);
    CHECK(s, "code %d at %d", e.code, e.index);
    return s;
}

static double parameter(TestRandom *r, int k, int n, const double *tau)
{
    double knot = tau[test_int(r, k - 1, n)];
    switch (test_int(r, 0, 3)) {
    case 0: return knot;
    case 1: return fmin(nextafter(knot, INFINITY), tau[n]);
    case 2: return fmax(nextafter(knot, -INFINITY), tau[k - 1]);
    default: return test_range(r, tau[k - 1], tau[n]);
    }
}

/* The sum of |slope| of the basis functions: what a derivative is made of, times the coordinates. */
static double steepness(int k, int n, const double *tau, double t)
{
    double slope[NURBS_MAX_ORDER], sum = 0;
    basis_derivative(k, tau, knots_span(k, n, tau, t), t, 1, slope);
    for (int i = 0; i < k; i++) sum += fabs(slope[i]);
    return sum;
}

/* Coordinates are at most 1. The quotient rule multiplies terms by the ratio of weights. */
static void check_surface(const Surface *s, double u, double v, double weight_ratio, unsigned seed)
{
    SurfacePoint p;
    Vec3 point, s_u, s_v;
    surface_point(s, u, v, &point, &s_u, &s_v);
    refine_evaluate(s, knots_span(s->k_u, s->n_u, s->tau_u, u), u, knots_span(s->k_v, s->n_v, s->tau_v, v), v, &p);
    double steep_u = steepness(s->k_u, s->n_u, s->tau_u, u), steep_v = steepness(s->k_v, s->n_v, s->tau_v, v);
    CHECK_WITHIN(vec_length(vec_sub(p.point, point)), TOLERANCE, "seed %u S(%.17g, %.17g)", seed, u, v);
    CHECK_WITHIN(vec_length(vec_sub(p.s_u, s_u)), TOLERANCE * weight_ratio * steep_u, "seed %u S_u(%.17g, %g)", seed, u, v);
    CHECK_WITHIN(vec_length(vec_sub(p.s_v, s_v)), TOLERANCE * weight_ratio * steep_v, "seed %u S_v(%g, %.17g)", seed, u, v);
}

static void check_random_surface(unsigned seed, double weight_ratio)
{
    TestRandom r = test_random(seed);
    Model m = { .k_u = test_int(&r, 2, 16), .k_v = test_int(&r, 2, 16) };
    m.n_u = model_random_knots(&r, m.k_u, test_int(&r, 1, 3), (m.k_u + 3) / 4, m.knots_u);
    m.n_v = model_random_knots(&r, m.k_v, test_int(&r, 1, 3), (m.k_v + 3) / 4, m.knots_v);
    model_random_points(&r, &m, weight_ratio);
    Arena *a = arena_new();
    Surface *s = surface_of(a, &m);
    CHECK(s->is_polynomial == (weight_ratio == 1), "seed %u", seed);
    for (int i = 0; i < 30; i++)
        check_surface(s, parameter(&r, s->k_u, s->n_u, s->tau_u), parameter(&r, s->k_v, s->n_v, s->tau_v), weight_ratio,
                      seed);
    arena_free(a);
}

static void polynomial_surfaces_are_those_of_the_basis_functions(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 200; seed++) check_random_surface(seed, 1);
}

static void rational_surfaces_are_those_of_the_basis_functions(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 200; seed++) check_random_surface(seed, seed % 2 ? 10 : 1e4);
}

static void derivatives_are_the_limits_of_differences(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Model m;
    model_torus(&m, 0.4);
    Surface *s = surface_of(a, &m);
    const double u = 1.3, v = 2.6, h = 1e-5;
    SurfacePoint p, before, after;
    int mu_u = knots_span(3, 9, s->tau_u, u), mu_v = knots_span(3, 9, s->tau_v, v);
    refine_evaluate(s, mu_u, u, mu_v, v, &p);
    refine_evaluate(s, mu_u, u - h, mu_v, v, &before), refine_evaluate(s, mu_u, u + h, mu_v, v, &after);
    CHECK_WITHIN(vec_length(vec_sub(vec_scale(vec_sub(after.point, before.point), 0.5 / h), p.s_u)), 1e-8, "S_u");
    refine_evaluate(s, mu_u, u, mu_v, v - h, &before), refine_evaluate(s, mu_u, u, mu_v, v + h, &after);
    CHECK_WITHIN(vec_length(vec_sub(vec_scale(vec_sub(after.point, before.point), 0.5 / h), p.s_v)), 1e-8, "S_v");
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_the_basis_functions_and_their_slopes),
        cmocka_unit_test(a_knot_of_multiplicity_n_leaves_max_of_k_minus_1_minus_n_and_1_steps),
        cmocka_unit_test(polynomial_surfaces_are_those_of_the_basis_functions),
        cmocka_unit_test(rational_surfaces_are_those_of_the_basis_functions),
        cmocka_unit_test(derivatives_are_the_limits_of_differences),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
