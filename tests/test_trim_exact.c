/* Trims next to their curves, against the oracle's exact windings: circles and closed rational curves of all orders, in
 * domains of all sizes. */
#include "tests/oracle.h"
#include "tests/test.h"
#include "tests/trims.h"

/* Control points and points are taken to the unit square with one rounding each, relative to the domain's ends. */
#define DOMAIN_ROUNDING 0x1p-51

/* The domain for a seed: the unit square, or one that is somewhere else and has another size. */
static TrimRect some_domain(TestRandom *r)
{
    if (test_int(r, 0, 2) == 0) return unit_square;
    double size = pow(10, test_range(r, -4, 4)), u0 = test_range(r, -2, 2) * size, v0 = test_range(r, -2, 2);
    return (TrimRect){ u0, u0 + size, v0, v0 + test_range(r, .5, 2) };
}

static Vec2 in_domain(const TrimRect *d, double x, double y)
{
    return vec2(d->u0 + x * (d->u1 - d->u0), d->v0 + y * (d->v1 - d->v0));
}

/* A closed curve of order k about the middle: points at rising angles, weights of up to a hundred. */
static TrimLoopDesc round_curve(Arena *a, const TrimRect *d, int k, TestRandom *r)
{
    int n = (k < 4 ? 6 : 2 * k) + test_int(r, 0, 4), turn = test_int(r, 0, 1) ? 1 : -1;
    Vec3 *p = ARENA_ARRAY(a, Vec3, n);
    double *tau = ARENA_ARRAY(a, double, n + k), t = 0, decades = test_range(r, 0, 2);
    for (int i = 0; i < n; i++) {
        double angle = turn * 6.283185307179586 * i / (n - 1), radius = test_range(r, .3, .4);
        Vec2 q = in_domain(d, .5 + radius * cos(angle), .5 + radius * sin(angle));
        p[i] = vec(q.x, q.y, pow(10, test_range(r, 0, decades)));
    }
    p[n - 1].x = p[0].x, p[n - 1].y = p[0].y;
    for (int i = 0; i < n + k; i++) {
        if (i >= k && i <= n) t += test_range(r, .1, 1);
        tau[i] = t;
    }
    TrimCurveDesc *c = ARENA_NEW(a, TrimCurveDesc);
    *c = (TrimCurveDesc){ .order = k, .n = n, .knots = tau, .points = p };
    return (TrimLoopDesc){ .curves = c, .n_curves = 1 };
}

/* A point on the curve, or so. */
static Vec2 curve_point(const TrimCurveDesc *c, double t)
{
    int k = c->order, mu = k - 1;
    while (mu < c->n - 1 && c->knots[mu + 1] <= t) mu++;
    double x[32], y[32], w[32];
    for (int i = 0; i < k; i++) {
        Vec3 p = c->points[mu - k + 1 + i];
        x[i] = p.x * p.z, y[i] = p.y * p.z, w[i] = p.z;
    }
    for (int level = 1; level < k; level++)
        for (int i = k - 1; i >= level; i--) {
            double lo = c->knots[mu - k + 1 + i], hi = c->knots[mu + 1 + i - level], s = (t - lo) / (hi - lo);
            x[i] += (s - 1) * (x[i] - x[i - 1]), y[i] += (s - 1) * (y[i] - y[i - 1]), w[i] += (s - 1) * (w[i] - w[i - 1]);
        }
    return vec2(x[k - 1] / w[k - 1], y[k - 1] / w[k - 1]);
}

/* Does exact arithmetic say the same of a point and of its neighbours, the rounding of domains apart? The unit square is met
 * without. */
static bool is_clear(const OracleTrims *o, const TrimRect *d, Vec2 p, bool *is_kept)
{
    static const double step[5][2] = { { 0, 0 }, { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    bool is_unit = d->u0 == 0 && d->u1 == 1 && d->v0 == 0 && d->v1 == 1;
    double bu = DOMAIN_ROUNDING * fmax(fabs(d->u0), fabs(d->u1)), bv = DOMAIN_ROUNDING * fmax(fabs(d->v0), fabs(d->v1));
    for (int i = 0; i < (is_unit ? 1 : 5); i++) {
        bool kept;
        double distance;
        if (!oracle_keeps(o, false, p.x + bu * step[i][0], p.y + bv * step[i][1], &kept, &distance)) return false;
        if (i > 0 && kept != *is_kept) return false;
        *is_kept = kept;
    }
    return true;
}

/* Points up to 1e-17 of the domain beside the loop are kept or cut as exact arithmetic says. */
static void check_beside(TrimRect d, const TrimLoopDesc *loop, TestRandom *r, unsigned seed)
{
    Arena *a = arena_new();
    Made m = make(a, (TrimInput){ .loops = loop, .n_loops = 1, .domain = d });
    CHECK(m.tree && m.n_warnings == 0, "seed %u: code %d", seed, m.error.code);
    const TrimCurveDesc *c = loop->curves;
    OracleTrims *o = oracle_trims_new(loop, 1);
    for (int i = 0; i < 60; i++) {
        double by = pow(10, -test_range(r, 1, 17)), angle = test_range(r, -4, 4);
        Vec2 p = curve_point(c, test_unit(r) * c->knots[c->n]);
        p.x += by * (d.u1 - d.u0) * cos(angle), p.y += by * (d.v1 - d.v0) * sin(angle);
        bool is_kept;
        if (!is_clear(o, &d, p, &is_kept)) continue;
        CHECK(trim_keeps(m.tree, p.x, p.y) == is_kept, "seed %u, order %d: (%.17g, %.17g), some %g beside", seed, c->order,
              p.x, p.y, by);
    }
    oracle_trims_free(o);
    arena_free(a);
}

static void beside_a_circle_is_where_exact_arithmetic_says(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new();
        Vec2 centre = vec2(test_range(&r, .3, .7), test_range(&r, .3, .7));
        TrimLoopDesc loop = circle(a, centre, test_range(&r, .01, .29), seed & 1);
        check_beside(unit_square, &loop, &r, seed);
        arena_free(a);
    }
}

static void beside_a_curve_of_any_order_too(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new();
        TrimRect d = some_domain(&r);
        TrimLoopDesc loop = round_curve(a, &d, 2 + (int)(seed % 15), &r);
        check_beside(d, &loop, &r, seed);
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beside_a_circle_is_where_exact_arithmetic_says),
        cmocka_unit_test(beside_a_curve_of_any_order_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
