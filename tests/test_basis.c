/* B-spline basis functions against the recurrence in exact rational arithmetic: doubles are rationals. */
#include "nurbs/basis.h"
#include "nurbs/knots.h"
#include "tests/models.h"

#include <gmp.h>

/* N += a (to - from) / (high - low); nothing where the function a is 0 by definition. */
static void add_share(mpq_t N, const mpq_t a, double from, double to, double low, double high)
{
    if (low == high) return;
    mpq_t x, y, z;
    mpq_inits(x, y, z, NULL);
    mpq_set_d(x, to), mpq_set_d(y, from), mpq_sub(x, x, y), mpq_mul(x, x, a);
    mpq_set_d(y, high), mpq_set_d(z, low), mpq_sub(y, y, z), mpq_div(x, x, y);
    mpq_add(N, N, x);
    mpq_clears(x, y, z, NULL);
}

/* N += a factor / (high - low) */
static void add_slope(mpq_t N, const mpq_t a, int factor, double low, double high)
{
    if (low == high) return;
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    mpq_set_d(x, high), mpq_set_d(y, low), mpq_sub(x, x, y), mpq_div(x, a, x);
    mpq_set_si(y, factor, 1), mpq_mul(x, x, y), mpq_add(N, N, x);
    mpq_clears(x, y, NULL);
}

/* All functions of the whole knot vector, order by order; the last r orders by the derivative's recurrence. */
static void exact_derivative(int k, int n_knots, const double *tau, int mu, double t, int r, mpq_t *N)
{
    for (int j = 0; j < n_knots - 1; j++) mpq_set_si(N[j], j == mu && r < k, 1);
    for (int m = 2; m <= k; m++)
        for (int j = 0; j + m < n_knots; j++) {
            mpq_t sum;
            mpq_init(sum);
            if (m <= k - r) {
                add_share(sum, N[j], tau[j], t, tau[j], tau[j + m - 1]);
                add_share(sum, N[j + 1], t, tau[j + m], tau[j + 1], tau[j + m]);
            } else {
                add_slope(sum, N[j], m - 1, tau[j], tau[j + m - 1]);
                add_slope(sum, N[j + 1], 1 - m, tau[j + 1], tau[j + m]);
            }
            mpq_set(N[j], sum);
            mpq_clear(sum);
        }
}

static void check_against_exact(int k, int n, const double *tau, double t, int mu, int r, unsigned seed)
{
    double out[NURBS_MAX_ORDER], largest = 0;
    mpq_t N[MODEL_MAX_KNOTS];
    for (int j = 0; j < n + k; j++) mpq_init(N[j]);
    exact_derivative(k, n + k, tau, mu, t, r, N);
    basis_derivative(k, tau, mu, t, r, out);
    for (int j = 0; j < n; j++) largest = fmax(largest, fabs(mpq_get_d(N[j])));
    for (int j = 0; j < n; j++) {
        double exact = mpq_get_d(N[j]), value = j < mu - k + 1 || j > mu ? 0 : out[j - mu + k - 1];
        double bound = r == 0 ? 8 * k * 0x1p-53 * exact : 64 * k * 0x1p-53 * largest;   /* values: no cancellation */
        CHECK_WITHIN(fabs(value - exact), bound, "seed %u k %d r %d j %d t %.17g exact %g", seed, k, r, j, t, exact);
    }
    for (int j = 0; j < n + k; j++) mpq_clear(N[j]);
}

static void values_and_derivatives_are_those_of_exact_arithmetic(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        TestRandom r = test_random(seed);
        double tau[MODEL_MAX_KNOTS];
        int k = test_int(&r, 2, 10), n = model_random_knots(&r, k, test_int(&r, 1, 4), k, tau);
        for (int i = 0; i < 8; i++) {
            double knot = tau[test_int(&r, k - 1, n)];
            double t[4] = { knot, nextafter(knot, tau[n]), nextafter(knot, tau[k - 1]), test_range(&r, tau[k - 1], tau[n]) };
            int mu = knots_span(k, n, tau, t[i % 4]);
            for (int order = 0; order <= 2; order++) check_against_exact(k, n, tau, t[i % 4], mu, order, seed);
        }
    }
}

static void the_end_of_a_span_is_its_limit_from_below(void **state)
{
    (void)state;
    const double tau[8] = { 0, 0, 0, 1, 2, 3, 3, 3 };
    double at_end[3], beside[3];
    basis_derivative(3, tau, 4, 3, 0, at_end);                 /* tau[4] .. tau[5] = 2 .. 3: the end of the domain */
    CHECK(at_end[0] == 0 && at_end[1] == 0 && at_end[2] == 1, "%g %g %g", at_end[0], at_end[1], at_end[2]);
    basis_derivative(3, tau, 3, 2, 0, at_end);
    basis_derivative(3, tau, 3, nextafter(2, 0), 0, beside);
    for (int i = 0; i < 3; i++) CHECK_WITHIN(fabs(at_end[i] - beside[i]), 1e-15, "function %d", i);
}

static void derivatives_of_the_order_and_beyond_vanish(void **state)
{
    (void)state;
    const double tau[6] = { 0, 0, 0, 1, 1, 1 };
    double out[3];
    basis_derivative(3, tau, 2, 0.3, 3, out);
    CHECK(out[0] == 0 && out[1] == 0 && out[2] == 0, "third derivative of a quadratic");
    basis_derivative(3, tau, 2, 0.3, 2, out);
    CHECK(out[0] == 2 && out[1] == -4 && out[2] == 2, "second: %g %g %g", out[0], out[1], out[2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_and_derivatives_are_those_of_exact_arithmetic),
        cmocka_unit_test(the_end_of_a_span_is_its_limit_from_below),
        cmocka_unit_test(derivatives_of_the_order_and_beyond_vanish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
