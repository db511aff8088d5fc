/* Knot vectors: what is legal, spans, breaks; against the definitions by linear search. */
#include "nurbs/knots.h"
#include "tests/models.h"

static NurbsError verdict(int k, int n, const double *tau)
{
    NurbsError e = { .code = NURBS_OK };
    bool valid = knots_are_valid(k, n, tau, &e);
    CHECK(valid == (e.code == NURBS_OK), "code %d", e.code);
    return e;
}

static void legal_knots_are_taken(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 500; seed++) {
        TestRandom r = test_random(seed);
        double tau[MODEL_MAX_KNOTS];
        int k = test_int(&r, 2, 8), n = model_random_knots(&r, k, test_int(&r, 1, 6), k, tau);
        NurbsError e = verdict(k, n, tau);
        CHECK(e.code == NURBS_OK, "seed %u: code %d at %d", seed, e.code, e.index);
    }
}

static void each_fault_is_named_with_its_knot(void **state)
{
    (void)state;
    const double decreasing[7] = { 0, 0, 0, 2, 1, 3, 3 }, infinite[6] = { 0, 0, 0, INFINITY, INFINITY, INFINITY };
    const double nan[6] = { 0, 0, NAN, 1, 1, 1 }, inner[10] = { 0, 0, 0, 1, 1, 1, 1, 2, 2, 2 };
    const double start[7] = { 0, 0, 0, 0, 1, 1, 1 }, empty[6] = { 0, 1, 1, 1, 2, 3 };
    NurbsError e = verdict(3, 4, decreasing);
    CHECK(e.code == NURBS_KNOTS_DECREASE && e.index == 4 && e.value == 1, "index %d", e.index);
    e = verdict(3, 3, infinite);
    CHECK(e.code == NURBS_KNOT_NOT_FINITE && e.index == 3, "index %d", e.index);
    e = verdict(3, 3, nan);
    CHECK(e.code == NURBS_KNOT_NOT_FINITE && e.index == 2, "index %d", e.index);
    e = verdict(3, 7, inner);
    CHECK(e.code == NURBS_KNOT_MULTIPLICITY && e.index == 6 && e.other == 3, "index %d other %d", e.index, e.other);
    e = verdict(3, 4, start);
    CHECK(e.code == NURBS_KNOT_MULTIPLICITY && e.index == 3 && e.other == 3, "index %d other %d", e.index, e.other);
    e = verdict(3, 3, empty);
    CHECK(e.code == NURBS_EMPTY_DOMAIN, "code %d", e.code);
}

static void a_break_of_full_multiplicity_is_legal(void **state)
{
    (void)state;
    const double tau[9] = { 0, 0, 0, 1, 1, 1, 2, 2, 2 };
    CHECK(verdict(3, 6, tau).code == NURBS_OK, "C^-1");
}

/* By the definition, one span after the other. */
static int span_from_below(int k, int n, const double *tau, double t)
{
    for (int mu = k - 1; mu < n; mu++)
        if (tau[mu] <= t && t < tau[mu + 1]) return mu;
    int mu = t < tau[k - 1] ? k - 1 : n - 1, step = t < tau[k - 1] ? 1 : -1;
    while (!(tau[mu] < tau[mu + 1])) mu += step;
    return mu;
}

static int span_from_above(int k, int n, const double *tau, double t)
{
    for (int mu = k - 1; mu < n; mu++)
        if (tau[mu] < t && t <= tau[mu + 1]) return mu;
    return span_from_below(k, n, tau, t <= tau[k - 1] ? tau[k - 1] : t);
}

static void spans_are_found_at_beside_and_between_knots(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 500; seed++) {
        TestRandom r = test_random(seed);
        double tau[MODEL_MAX_KNOTS];
        int k = test_int(&r, 2, 6), n = model_random_knots(&r, k, test_int(&r, 1, 8), k, tau);
        for (int i = 0; i < n + k; i++) {
            double t[4] = { tau[i], nextafter(tau[i], -INFINITY), nextafter(tau[i], INFINITY), tau[i] + test_unit(&r) };
            for (int j = 0; j < 4; j++) {
                int mu = knots_span(k, n, tau, t[j]), left = knots_span_left(k, n, tau, t[j]);
                CHECK(mu == span_from_below(k, n, tau, t[j]), "seed %u t %.17g: %d", seed, t[j], mu);
                CHECK(left == span_from_above(k, n, tau, t[j]), "seed %u t %.17g: %d", seed, t[j], left);
                CHECK(knots_is_span(tau, mu) && knots_is_span(tau, left), "seed %u", seed);
            }
        }
    }
}

static void breaks_are_the_knots_of_multiplicity_k_minus_1(void **state)
{
    (void)state;
    const double tau[14] = { 0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 4, 4, 4 };        /* k = 4, n = 10: a corner at 3 */
    const double unclamped[10] = { 0, 1, 2, 2, 2, 3, 4, 4, 5, 6 };              /* k = 4, n = 6: the domain is [2, 4] */
    const double linear[6] = { 0, 0, 1, 2, 3, 3 };                              /* k = 2: every knot is a corner */
    double at[12];
    CHECK(knots_breaks(4, 10, tau, at) == 3 && at[0] == 0 && at[1] == 3 && at[2] == 4, "%g %g", at[0], at[1]);
    CHECK(knots_breaks(4, 6, unclamped, at) == 2 && at[0] == 2 && at[1] == 4, "%g %g", at[0], at[1]);
    CHECK(knots_breaks(2, 4, linear, at) == 4 && at[1] == 1 && at[2] == 2, "%g %g", at[1], at[2]);
    CHECK(knots_multiplicity(14, tau, 3) == 3 && knots_multiplicity(14, tau, 2.5) == 0, "at 3");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legal_knots_are_taken),
        cmocka_unit_test(each_fault_is_named_with_its_knot),
        cmocka_unit_test(a_break_of_full_multiplicity_is_legal),
        cmocka_unit_test(spans_are_found_at_beside_and_between_knots),
        cmocka_unit_test(breaks_are_the_knots_of_multiplicity_k_minus_1),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
