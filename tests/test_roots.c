#include "tests/test.h"

#include "render/roots.h"

#include <math.h>
#include <stdbool.h>

static const double U = 0x1p-53;

/* The coefficients of leading * (x - root[0]) ... (x - root[n-1]), in extended precision before the last rounding. */
static void polynomial_of(int n, const double *root, double leading, double *c)
{
    long double p[6] = { leading };
    for (int i = 0; i < n; i++)
        for (int k = i + 1; k >= 0; k--) p[k] = (k > 0 ? p[k - 1] : 0) - (k <= i ? p[k] * root[i] : 0);
    for (int k = 0; k <= n; k++) c[k] = (double)p[k];
}

static int solve(int n, const double *c, double *x)
{
    return n == 2 ? roots_quadratic(c, x) : n == 3 ? roots_cubic(c, x) : roots_quartic(c, x);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How far rounding the coefficients alone may move the root: 4u sum |c_i x^i| / |p'(x)|, and the solver as much again. */
static double condition_bound(int n, const double *c, double x)
{
    double sum = 0, slope = 0, power = 1;
    for (int i = 0; i <= n; i++) {
        sum += fabs(c[i]) * power;
        power *= fabs(x);
    }
    for (int i = n; i > 0; i--) slope = slope * x + i * c[i];
    return 16 * U * sum / fabs(slope) + 4 * U * fabs(x);
}

static void separate_roots_are_all_found(void **state)
{
    (void)state;
    TestRandom r = test_random(1);
    for (int i = 0; i < 30000; i++) {
        int n = test_int(&r, 2, 4);
        double root[4], x[4], c[5], scale = pow(10, test_range(&r, -8, 8)), leading = pow(10, test_range(&r, -8, 8));
        for (int k = 0; k < n; k++) root[k] = scale * (test_range(&r, -4, 4) + 10 * test_int(&r, -1, 1));
        qsort(root, (size_t)n, sizeof *root, by_value);
        bool is_close = false;
        for (int k = 1; k < n; k++) is_close |= root[k] - root[k - 1] < 1e-2 * scale;
        if (is_close) continue;
        polynomial_of(n, root, leading, c);
        CHECK(solve(n, c, x) == n, "case %d: %d of %d roots", i, solve(n, c, x), n);
        for (int k = 0; k < n; k++)
            CHECK_WITHIN(fabs(x[k] - root[k]), condition_bound(n, c, root[k]), "case %d, root %d", i, k);
    }
}

static void roots_of_very_different_size_keep_their_digits(void **state)
{
    (void)state;
    TestRandom r = test_random(2);
    for (int i = 0; i < 10000; i++) {
        int n = test_int(&r, 2, 4);
        double root[4], x[4], c[5];
        for (int k = 0; k < n; k++) root[k] = (test_int(&r, 0, 1) ? 1 : -1) * pow(10, 5 * k - 10 + test_range(&r, 0, 3));
        polynomial_of(n, root, 1, c);
        qsort(root, (size_t)n, sizeof *root, by_value);
        CHECK(solve(n, c, x) == n, "case %d: %d of %d roots", i, solve(n, c, x), n);
        for (int k = 0; k < n; k++) CHECK_WITHIN(fabs(x[k] - root[k]), 32 * U * fabs(root[k]), "case %d, root %d", i, k);
    }
}

/* (x^2 + a^2) times the rest: roots that are not real are not listed. */
static void complex_roots_are_not_listed(void **state)
{
    (void)state;
    TestRandom r = test_random(3);
    for (int i = 0; i < 10000; i++) {
        double a = test_range(&r, .1, 3), b = test_range(&r, -3, 3), p = test_range(&r, -3, 3), x[4];
        double q = p + test_range(&r, .1, 3);
        double square = b * b + a * a;                                /* (x - b)^2 + a^2 */
        const double two[3] = { square, -2 * b, 1 };
        const double three[4] = { -p * square, square + 2 * b * p, -2 * b - p, 1 };
        const double four[5] = { p * q * square, -(p + q) * square - 2 * b * p * q, p * q + 2 * b * (p + q) + square,
                                 -2 * b - p - q, 1 };
        CHECK(roots_quadratic(two, x) == 0, "case %d: quadratic", i);
        CHECK(roots_cubic(three, x) == 1, "case %d: cubic, %d", i, roots_cubic(three, x));
        CHECK_WITHIN(fabs(x[0] - p), condition_bound(3, three, p), "case %d: cubic", i);
        CHECK(roots_quartic(four, x) == 2, "case %d: quartic, %d", i, roots_quartic(four, x));
        CHECK_WITHIN(fabs(x[0] - p), condition_bound(4, four, p), "case %d: quartic", i);
        CHECK_WITHIN(fabs(x[1] - q), condition_bound(4, four, q), "case %d: quartic", i);
    }
}

/* Roots and leading coefficients of few bits, so that the coefficients are exact. */
static void a_touch_is_listed_twice(void **state)
{
    (void)state;
    TestRandom r = test_random(4);
    for (int i = 0; i < 10000; i++) {
        double a = test_int(&r, -50, 50) / 8., b = a + test_int(&r, 8, 60) / 8., x[4], c[5];
        double scale = ldexp(1, test_int(&r, -40, 40));
        const double two[4] = { a, a }, three[4] = { a, a, b }, four[4] = { a, a, b, b };
        polynomial_of(2, two, scale, c);
        CHECK(roots_quadratic(c, x) == 2 && x[0] == x[1], "case %d: quadratic", i);
        CHECK_WITHIN(fabs(x[0] - a), 4 * U * fabs(a), "case %d", i);
        polynomial_of(3, three, scale, c);
        CHECK(roots_cubic(c, x) == 3, "case %d: cubic, %d", i, roots_cubic(c, x));
        CHECK_WITHIN(fabs(x[0] - a) + fabs(x[1] - a) + fabs(x[2] - b), 1e-6 * (1 + fabs(a) + fabs(b)), "case %d: cubic", i);
        polynomial_of(4, four, scale, c);
        CHECK(roots_quartic(c, x) == 4, "case %d: quartic, %d", i, roots_quartic(c, x));
        CHECK_WITHIN(fabs(x[1] - a) + fabs(x[2] - b), 1e-6 * (1 + fabs(a) + fabs(b)), "case %d: quartic", i);
    }
}

static void an_inflection_on_the_axis_is_one_root(void **state)
{
    (void)state;
    double x[4];
    CHECK(roots_cubic((double[]){ -1, 3, -3, 1 }, x) == 1 && fabs(x[0] - 1) < 1e-5, "(x - 1)^3: %g", x[0]);
    CHECK(roots_cubic((double[]){ 0, 0, 0, 5 }, x) == 1 && x[0] == 0, "5 x^3");
    CHECK(roots_quartic((double[]){ -3, 10, -12, 6, -1 }, x) == 2, "(1 - x)^3 (x - 3)");
    CHECK(fabs(x[0] - 1) < 1e-4 && fabs(x[1] - 3) < 1e-12, "(1 - x)^3 (x - 3): %.17g %.17g", x[0], x[1]);
}

static void leading_zeros_lower_the_degree(void **state)
{
    (void)state;
    double x[4];
    assert_int_equal(roots_quartic((double[]){ -6, 11, -6, 1, 0 }, x), 3);
    CHECK(fabs(x[0] - 1) + fabs(x[1] - 2) + fabs(x[2] - 3) < 1e-14, "%g %g %g", x[0], x[1], x[2]);
    assert_int_equal(roots_quartic((double[]){ -6, 2, 0, 0, 0 }, x), 1);
    assert_true(x[0] == 3);
    assert_int_equal(roots_quadratic((double[]){ 1, 0, 0 }, x), 0);
    assert_int_equal(roots_quartic((double[]){ 0, 0, 0, 0, 0 }, x), 0);
    assert_int_equal(roots_quadratic((double[]){ -1, 1, 1e-320 }, x) >= 1, 1);
    CHECK(x[0] == 1 || x[1] == 1, "a negligible leading coefficient: %g", x[0]);
}

static void scale_does_not_matter(void **state)
{
    (void)state;
    double x[4], y[4];
    static const double c[5] = { 2, -3, -4, 1, 1 };
    int n = roots_quartic(c, x);
    for (int e = -900; e <= 900; e += 300) {
        double d[5];
        for (int k = 0; k < 5; k++) d[k] = ldexp(c[k], e);
        CHECK(roots_quartic(d, y) == n, "2^%d", e);
        for (int k = 0; k < n; k++) CHECK(x[k] == y[k], "2^%d: root %d", e, k);
    }
}

static void an_interval_keeps_what_lies_in_it(void **state)
{
    (void)state;
    TestRandom r = test_random(5);
    for (int i = 0; i < 20000; i++) {
        int n = test_int(&r, 1, 4), expected = 0;
        double root[4], c[5], x[4], lo = test_range(&r, -3, 2), hi = lo + test_range(&r, 0, 3);
        bool is_unclear = false;
        for (int k = 0; k < n; k++) {
            root[k] = test_range(&r, -3, 3);
            expected += root[k] > lo && root[k] < hi;
            is_unclear |= fabs(root[k] - lo) < 1e-3 || fabs(root[k] - hi) < 1e-3;
            for (int j = 0; j < k; j++) is_unclear |= fabs(root[k] - root[j]) < 1e-3;
        }
        if (is_unclear) continue;
        polynomial_of(n, root, 1, c);
        int found = roots_between(n, c, lo, hi, x);
        CHECK(found == expected, "case %d: degree %d, %d, not %d", i, n, found, expected);
        for (int k = 0; k < found; k++) CHECK(x[k] >= (k > 0 ? x[k - 1] : lo) && x[k] <= hi, "case %d, root %d", i, k);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(separate_roots_are_all_found),
        cmocka_unit_test(roots_of_very_different_size_keep_their_digits),
        cmocka_unit_test(complex_roots_are_not_listed),
        cmocka_unit_test(a_touch_is_listed_twice),
        cmocka_unit_test(an_inflection_on_the_axis_is_one_root),
        cmocka_unit_test(leading_zeros_lower_the_degree),
        cmocka_unit_test(scale_does_not_matter),
        cmocka_unit_test(an_interval_keeps_what_lies_in_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
