/* Decisions beside curves against exact rational arithmetic: the truth takes the doubles of the scene as they are, and
 * shares no code with nurbs/. */
#include "tests/test.h"

#include "nurbs/basis.h"
#include "nurbs/bernstein.h"
#include "nurbs/knots.h"
#include "nurbs/trim_curve.h"
#include "nurbs/trim_test.h"
#include "tests/trims.h"

#include <gmp.h>

/* ---- the truth ---- */

#define MAX_K 16

/* A Bézier curve relative to the tested point: {w (u - p_u), w (v - p_v)}, exact. */
typedef struct { int k; mpq_t x[MAX_K], y[MAX_K]; } Exact;

static void exact_init(Exact *e, int k)
{
    e->k = k;
    for (int i = 0; i < k; i++) mpq_inits(e->x[i], e->y[i], NULL);
}

static void exact_clear(Exact *e)
{
    for (int i = 0; i < e->k; i++) mpq_clears(e->x[i], e->y[i], NULL);
}

/* out = (1 - s) a + s b; out may be a or b. */
static void blend(mpq_t out, const mpq_t a, const mpq_t b, const mpq_t s)
{
    mpq_t d;
    mpq_init(d);
    mpq_sub(d, b, a), mpq_mul(d, d, s), mpq_add(out, a, d);
    mpq_clear(d);
}

static void share(mpq_t out, double from, double at, double to)
{
    mpq_t f, a;
    mpq_inits(f, a, NULL);
    mpq_set_d(f, from), mpq_set_d(a, at), mpq_set_d(out, to);
    mpq_sub(a, a, f), mpq_sub(out, out, f), mpq_div(out, a, out);
    mpq_clears(f, a, NULL);
}

/* The point p + (du, dv) 2^-90. */
typedef struct { Vec2 p; int du, dv; } Place;

static void exact_shift(mpq_t x, double from, int steps)
{
    mpq_t step;
    mpq_init(step);
    mpq_set_d(x, from), mpq_set_d(step, steps * 0x1p-90), mpq_add(x, x, step);
    mpq_clear(step);
}

/* The span mu of a curve, by inserting both of its knots (blossoms). */
static void exact_span(const TrimCurveDesc *c, int mu, Place p, Exact *e)
{
    int k = c->order;
    mpq_t s, pu, pv, w;
    mpq_inits(s, pu, pv, w, NULL);
    exact_shift(pu, p.p.x, p.du), exact_shift(pv, p.p.y, p.dv);
    for (int i = 0; i < k; i++) {
        Vec3 q = c->points[mu - k + 1 + i];
        mpq_set_d(e->x[i], q.x), mpq_set_d(e->y[i], q.y), mpq_set_d(w, q.z);
        mpq_sub(e->x[i], e->x[i], pu), mpq_mul(e->x[i], e->x[i], w);
        mpq_sub(e->y[i], e->y[i], pv), mpq_mul(e->y[i], e->y[i], w);
    }
    const double *tau = c->knots;
    for (int q = 1; q < k; q++)
        for (int i = 0; i < k - q; i++) {
            share(s, tau[mu - k + 1 + q + i], tau[mu], tau[mu + 1 + i]);
            blend(e->x[i], e->x[i], e->x[i + 1], s), blend(e->y[i], e->y[i], e->y[i + 1], s);
        }
    for (int q = 1; q < k; q++)
        for (int i = k - 1; i >= q; i--) {
            share(s, tau[mu], tau[mu + 1], tau[mu + i - q + 1]);
            blend(e->x[i], e->x[i - 1], e->x[i], s), blend(e->y[i], e->y[i - 1], e->y[i], s);
        }
    mpq_clears(s, pu, pv, w, NULL);
}

/* Whole numbers from here on: coefficients over one denominator. */
typedef struct { int k; mpz_t x[MAX_K], y[MAX_K]; } Whole;

static void whole_init(Whole *w, int k)
{
    w->k = k;
    for (int i = 0; i < k; i++) mpz_inits(w->x[i], w->y[i], NULL);
}

static void whole_clear(Whole *w)
{
    for (int i = 0; i < w->k; i++) mpz_clears(w->x[i], w->y[i], NULL);
}

static void clear_denominators(int k, mpq_t q[], mpz_t out[])
{
    mpz_t all;
    mpz_init_set_ui(all, 1);
    for (int i = 0; i < k; i++) mpz_lcm(all, all, mpq_denref(q[i]));
    for (int i = 0; i < k; i++) {
        mpz_divexact(out[i], all, mpq_denref(q[i]));
        mpz_mul(out[i], out[i], mpq_numref(q[i]));
    }
    mpz_clear(all);
}

/* Both halves, times 2^(k-1): de Casteljau's sums without their divisions. */
static void halve(int k, const mpz_t c[], mpz_t left[], mpz_t right[])
{
    for (int i = 0; i < k; i++) mpz_set(right[i], c[i]);
    for (int q = 0; q < k; q++) {
        mpz_mul_2exp(left[q], right[0], (mp_bitcnt_t)(k - 1 - q));
        for (int i = 0; i + 1 < k - q; i++) mpz_add(right[i], right[i], right[i + 1]);
        mpz_mul_2exp(right[k - 1 - q], right[k - 1 - q], (mp_bitcnt_t)(k - 1 - q));
    }
}

/* All of one sign: that; else 0. Zeros have none. */
static int common_sign(const mpz_t c[], int k)
{
    int sign = mpz_sgn(c[0]);
    for (int i = 1; i < k; i++)
        if (mpz_sgn(c[i]) != sign) return 0;
    return sign;
}

/* How often the curve passes the ray from the point towards +u, upward as +1; *is_on: the point is on it, as far as 200
 * halvings tell. */
static int exact_crossings(const Whole *e, int halvings, bool *is_on)
{
    int k = e->k, sign = common_sign(e->x, k);
    if (common_sign(e->y, k) != 0 || sign < 0 || *is_on) return 0;
    if (sign > 0) return (mpz_sgn(e->y[k - 1]) > 0) - (mpz_sgn(e->y[0]) > 0);
    *is_on = halvings == 200;
    Whole left, right;
    whole_init(&left, k), whole_init(&right, k);
    halve(k, e->x, left.x, right.x), halve(k, e->y, left.y, right.y);
    int n = exact_crossings(&left, halvings + 1, is_on) + exact_crossings(&right, halvings + 1, is_on);
    whole_clear(&left), whole_clear(&right);
    return n;
}

static int span_crossings(Exact *e, bool *is_on)
{
    Whole w;
    whole_init(&w, e->k);
    clear_denominators(e->k, e->x, w.x), clear_denominators(e->k, e->y, w.y);
    int n = exact_crossings(&w, 0, is_on);
    whole_clear(&w);
    return n;
}

static int exact_winding_at(const TrimLoopDesc *loop, Place p, bool *is_on)
{
    int winding = 0;
    *is_on = false;
    for (int c = 0; c < loop->n_curves; c++) {
        const TrimCurveDesc *d = &loop->curves[c];
        for (int mu = d->order - 1; mu < d->n && !*is_on; mu++) {
            if (!(d->knots[mu] < d->knots[mu + 1])) continue;
            Exact e;
            exact_init(&e, d->order);
            exact_span(d, mu, p, &e);
            winding += span_crossings(&e, is_on);
            exact_clear(&e);
        }
    }
    return winding;
}

static int exact_winding(const TrimLoopDesc *loop, Vec2 p, bool *is_on)
{
    return exact_winding_at(loop, (Place){ p, 0, 0 }, is_on);
}

/* Nearer than that to the curve a point is as good as on it. */
static bool is_as_good_as_on(const TrimLoopDesc *loop, Vec2 p, int winding)
{
    bool is_on = false;
    for (int i = 0; i < 4; i++) {
        Place q = { p, (i == 0) - (i == 1), (i == 2) - (i == 3) };
        if (exact_winding_at(loop, q, &is_on) != winding || is_on) return true;
    }
    return false;
}

static void the_truth_knows_a_square(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 p[4] = { { .25, .25 }, { .75, .25 }, { .75, .75 }, { .25, .75 } }, q[4] = { p[1], p[2], p[3], p[0] };
    TrimLoopDesc loop = sides(a, p, q, 4);
    bool is_on;
    CHECK(exact_winding(&loop, vec2(.5, .5), &is_on) == 1 && !is_on, "inside");
    CHECK(exact_winding(&loop, vec2(.25 + 1e-16, .5), &is_on) == 1 && !is_on, "just inside");
    CHECK(exact_winding(&loop, vec2(.25 - 1e-16, .5), &is_on) == 0 && !is_on, "just outside");
    CHECK(exact_winding(&loop, vec2(.8, .25), &is_on) == 0 && !is_on, "level with a side");
    (void)exact_winding(&loop, vec2(.25, .5), &is_on);
    CHECK(is_on, "on it");
    arena_free(a);
}

/* ---- beside curves ---- */

static Vec2 point_of(const TrimCurveDesc *c, double t)
{
    double b[NURBS_MAX_ORDER], w = 0, x = 0, y = 0;
    int mu = knots_span(c->order, c->n, c->knots, t);
    basis_derivative(c->order, c->knots, mu, t, 0, b);
    for (int i = 0; i < c->order; i++) {
        Vec3 p = c->points[mu - c->order + 1 + i];
        x += b[i] * p.z * p.x, y += b[i] * p.z * p.y, w += b[i] * p.z;
    }
    return vec2(x / w, y / w);
}

/* Tests points at distances of 1e-12 to 1e-17 of the domain and more; returns how many were on the very edge of what doubles
 * can tell: the next double in u or v is decided otherwise. */
static int judge_points(const TrimLoopDesc *loop, bool is_clockwise, TrimRect domain, TestRandom *r, int n_points,
                        unsigned seed)
{
    Arena *a = arena_new();
    Made m = make(a, (TrimInput){ .loops = loop, .n_loops = 1, .keep_left = !is_clockwise, .domain = domain });
    CHECK(m.tree && m.n_warnings == 0, "seed %u: code %d", seed, m.error.code);
    const TrimCurveDesc *c = &loop->curves[0];
    double from = c->knots[c->order - 1], to = c->knots[c->n];
    int n_close = 0;
    for (int i = 0; i < n_points; i++) {
        double t = test_range(r, from, to), angle = test_range(r, 0, 7), off = pow(10, test_range(r, -17, -12));
        double beside = test_range(r, -1, 1) * pow(10, test_range(r, -17, -2));
        if (i % 4 == 0) t = c->knots[test_int(r, c->order - 1, c->n)] + beside;
        Vec2 p = point_of(c, fmin(fmax(t, from), to));
        p = vec2(p.x + off * cos(angle) * (domain.u1 - domain.u0), p.y + off * sin(angle) * (domain.v1 - domain.v0));
        bool is_on, unused;
        int winding = exact_winding(loop, p, &is_on);
        bool is_right = trim_keeps(m.tree, p.x, p.y) == (winding != 0);
        CHECK(is_right || is_on || is_as_good_as_on(loop, p, winding), "seed %u: (%.17g, %.17g) off %g", seed, p.x, p.y,
              off);
        n_close += exact_winding(loop, vec2(nextafter(p.x, 1e9), p.y), &unused) != winding
                || exact_winding(loop, vec2(p.x, nextafter(p.y, 1e9)), &unused) != winding;
    }
    arena_free(a);
    return n_close;
}

static void a_point_beside_a_circle_is_classified_as_exact_arithmetic_does(void **state)
{
    (void)state;
    int n_close = 0;
    for (unsigned seed = 0; seed < 40; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        double radius = .4 * pow(10, -test_range(&r, 0, 3)), turn = seed % 4 ? test_range(&r, 0, 7) : 0;
        Vec2 centre = vec2(test_range(&r, .45, .55), test_range(&r, .45, .55));
        TrimLoopDesc loop = turned_circle(a, centre, radius, turn, seed % 2);
        n_close += judge_points(&loop, seed % 2, unit_square, &r, 100, seed);
        arena_free(a);
    }
    CHECK(n_close > 200, "only %d points at the very edge", n_close);
}

static void the_domain_and_its_scaling_do_not_blur_the_edge(void **state)
{
    (void)state;
    int n_close = 0;
    for (unsigned seed = 0; seed < 20; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        double size = pow(10, test_range(&r, -6, 6)), u = test_range(&r, -3, 3) * size, v = test_range(&r, -3, 3) * size;
        TrimRect domain = { u, u + size, v, v + size * test_range(&r, 1, 2) };
        Vec2 centre = vec2(u + size / 2, (domain.v0 + domain.v1) / 2);
        TrimLoopDesc loop = turned_circle(a, centre, size * .4, test_range(&r, 0, 7), seed % 2);
        n_close += judge_points(&loop, seed % 2, domain, &r, 100, seed);
        arena_free(a);
    }
    CHECK(n_close > 60, "only %d points at the very edge", n_close);
}

/* A closed curve of order k whose control polygon, and so itself, is passed at most twice by any line through the middle:
 * simple. Any knots, weights over some decades. */
static TrimLoopDesc random_ring(Arena *a, TestRandom *r, int k)
{
    int n = k + test_int(r, 4, 10);
    double *knots = ARENA_ARRAY(a, double, n + k), t = 0;
    Vec3 *points = ARENA_ARRAY(a, Vec3, n);
    for (int i = 0; i < n + k; i++) {
        if (i >= k && i <= n) t += i == n || test_int(r, 0, 3) ? test_int(r, 1, 16) / 16. : 0;   /* short: a fast truth */
        knots[i] = t;
    }
    for (int i = 0; i < n; i++) {
        double angle = 2 * acos(-1) * i / (n - 1), radius = test_range(r, .2, .45);
        points[i] = vec(.5 + radius * cos(angle), .5 + radius * sin(angle), pow(10, test_range(r, -1, 1)));
    }
    points[n - 1].x = points[0].x, points[n - 1].y = points[0].y;
    TrimCurveDesc *c = ARENA_NEW(a, TrimCurveDesc);
    *c = (TrimCurveDesc){ .order = k, .n = n, .knots = knots, .points = points };
    return (TrimLoopDesc){ .curves = c, .n_curves = 1 };
}

static bool is_smooth(const TrimCurveDesc *c)
{
    NurbsError error;
    if (!trim_curve_is_valid(c, &error)) return false;
    for (int i = c->order; i < c->n; i++)
        if (c->knots[i] == c->knots[i + c->order - 1] && c->knots[i] < c->knots[c->n]) return false;
    return true;
}

static void curves_of_all_orders_are_exact(void **state)
{
    (void)state;
    int n_close = 0;
    for (unsigned seed = 0; seed < 30; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        int k = 2 + (int)seed % 15;
        TrimLoopDesc loop;
        do loop = random_ring(a, &r, k); while (!is_smooth(loop.curves));
        n_close += judge_points(&loop, false, unit_square, &r, 30, seed);
        arena_free(a);
    }
    CHECK(n_close > 60, "only %d points at the very edge", n_close);
}

/* Two regions with one curve as their border, one of them with the curve reversed: no point is in both or in none. */
static void a_common_curve_leaves_no_gap(void **state)
{
    (void)state;
    static const double knots[8] = { 0, 0, 0, 0, 1, 1, 1, 1 }, line[4] = { 0, 0, 1, 1 };
    for (unsigned seed = 0; seed < 100; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        Vec3 up[4], down[4], corner[2][4] = { { { .5, .9, 1 }, { .1, .9, 1 }, { .1, .1, 1 }, { .5, .1, 1 } },
                                              { { .5, .1, 1 }, { .9, .1, 1 }, { .9, .9, 1 }, { .5, .9, 1 } } };
        for (int i = 0; i < 4; i++) {
            up[i] = vec(i % 3 ? test_range(&r, .2, .8) : .5, .1 + .8 * i / 3, test_range(&r, .2, 5));
            down[3 - i] = up[i];
        }
        up[3].y = down[0].y = .9;
        Made m[2];
        for (int s = 0; s < 2; s++) {
            TrimCurveDesc curves[4] = { { .order = 4, .n = 4, .knots = knots, .points = s ? down : up } };
            for (int i = 0; i < 3; i++)
                curves[i + 1] = (TrimCurveDesc){ .order = 2, .n = 2, .knots = line, .points = corner[s] + i };
            TrimLoopDesc loop = { .curves = curves, .n_curves = 4 };
            m[s] = make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .keep_left = true, .domain = unit_square });
            CHECK(m[s].tree && m[s].n_warnings == 0, "seed %u: code %d", seed, m[s].error.code);
        }
        TrimCurveDesc curve = { .order = 4, .n = 4, .knots = knots, .points = up };
        for (int i = 0; i < 500; i++) {
            Vec2 p = point_of(&curve, i % 10 ? test_unit(&r) : test_int(&r, 1, 7) / 8.);
            bool first = trim_keeps(m[0].tree, p.x, p.y), second = trim_keeps(m[1].tree, p.x, p.y);
            CHECK(first != second, "seed %u: (%.17g, %.17g)", seed, p.x, p.y);
        }
        arena_free(a);
    }
}

/* ---- turns ---- */

/* The polynomial with the given roots, in Bernstein form: multiplied by (t - root) = -root (1-t) + (1 - root) t, one by
 * one. */
static int polynomial_of(const double *root, int n, double c[])
{
    c[0] = 1;
    for (int m = 0; m < n; m++) {
        double next[BERNSTEIN_MAX] = { 0 };
        for (int i = 0; i <= m; i++) {
            next[i] += c[i] * -root[m] * (m + 1 - i) / (m + 1);
            next[i + 1] += c[i] * (1 - root[m]) * (i + 1) / (m + 1);
        }
        memcpy(c, next, sizeof next);
    }
    return n + 1;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void all_sign_changes_are_found(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 2000; seed++) {
        TestRandom r = test_random(seed);
        double root[12], wanted[12], c[BERNSTEIN_MAX], found[BERNSTEIN_MAX];
        int n = test_int(&r, 1, seed % 3 == 2 ? 2 : 12), n_wanted = 0;
        for (int i = 0; i < n; i++) {
            root[i] = (i + test_range(&r, .2, .8)) * 1.6 / n - .3;          /* some outside; or where intervals are halved */
            if (seed % 3 == 1) root[i] = (double)(i - 2) / 8;
            if (seed % 3 == 2) root[i] = (double)test_int(&r, 0, 3) / 4;    /* or double: no sign change */
        }
        qsort(root, (size_t)n, sizeof *root, by_value);
        for (int i = 0, run = 1; i < n; i += run) {
            for (run = 1; i + run < n && root[i + run] == root[i]; run++) continue;
            if (run % 2 && root[i] > 0 && root[i] < 1) wanted[n_wanted++] = root[i];
        }
        int n_coefficients = polynomial_of(root, n, c);
        double largest = 0;
        for (int i = 0; i < n_coefficients; i++) largest = fmax(largest, fabs(c[i]));
        int n_found = bernstein_turns(n_coefficients, c, 1e-17 * largest, found);
        CHECK(n_found == n_wanted, "seed %u: %d of %d", seed, n_found, n_wanted);
        for (int i = 0; i < n_found; i++) CHECK_WITHIN(fabs(found[i] - wanted[i]), 1e-4, "seed %u", seed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_truth_knows_a_square),
        cmocka_unit_test(a_point_beside_a_circle_is_classified_as_exact_arithmetic_does),
        cmocka_unit_test(the_domain_and_its_scaling_do_not_blur_the_edge),
        cmocka_unit_test(curves_of_all_orders_are_exact),
        cmocka_unit_test(a_common_curve_leaves_no_gap),
        cmocka_unit_test(all_sign_changes_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
