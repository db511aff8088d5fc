/* Bézier polygons against the basis functions, and against what cutting must keep. */
#include "nurbs/basis.h"
#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "tests/models.h"

static void random_polygon(TestRandom *r, int n, Vec4 *p)
{
    for (int i = 0; i < n; i++) {
        double w = exp(test_range(r, -2, 2));
        p[i] = vec4_weighted(vec4(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1), w));
    }
}

static double distance4(Vec4 a, Vec4 b)
{
    return fmax(fmax(fabs(a.x - b.x), fabs(a.y - b.y)), fmax(fabs(a.z - b.z), fabs(a.w - b.w)));
}

static double largest4(int n, const Vec4 *p)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, distance4(p[i], vec4(0, 0, 0, 0)));
    return most;
}

static Vec4 spline_point(int k, const double *tau, int mu, double t, const Vec4 *p)
{
    double N[NURBS_MAX_ORDER];
    Vec4 sum = { 0 };
    basis_derivative(k, tau, mu, t, 0, N);
    for (int i = 0; i < k; i++) sum = vec4_add(sum, vec4_scale(p[mu - k + 1 + i], N[i]));
    return sum;
}

static void check_closing(int k, const double *tau, int mu, const Vec4 *p, unsigned seed)
{
    Vec4 q[NURBS_MAX_ORDER];
    memcpy(q, p + mu - k + 1, (size_t)k * sizeof *q);
    bezier_from_span(k, tau, mu, 1, q);
    double rounding_of_t = fmax(fabs(tau[mu]), fabs(tau[mu + 1])) / (tau[mu + 1] - tau[mu]);   /* in spans, times u */
    double bound = (40 + 2 * rounding_of_t) * k * 0x1p-53 * largest4(k, p + mu - k + 1);    /* closing, two evaluations */
    for (int i = 0; i <= 8; i++) {
        double t = i == 8 ? tau[mu + 1] : tau[mu] + (tau[mu + 1] - tau[mu]) * i / 8;
        Vec4 truth = spline_point(k, tau, mu, t, p);
        CHECK_WITHIN(distance4(bezier_point(k, q, i / 8.0), truth), bound, "seed %u k %d mu %d i %d", seed, k, mu, i);
    }
}

static void closing_leaves_the_curve_where_it_was(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        double tau[4 * MODEL_MAX_KNOTS];
        Vec4 p[4 * MODEL_MAX_KNOTS];
        int k = seed % 10 == 0 ? test_int(&r, 17, 32) : test_int(&r, 2, 16);
        int n = model_random_knots(&r, k, test_int(&r, 1, 5), k, tau);
        random_polygon(&r, n, p);
        for (int mu = k - 1; mu < n; mu++)
            if (knots_is_span(tau, mu)) check_closing(k, tau, mu, p, seed);
    }
}

static void a_bezier_span_is_closed_already(void **state)
{
    (void)state;
    const double tau[8] = { 2, 2, 2, 2, 3, 3, 3, 3 };
    TestRandom r = test_random(1);
    Vec4 p[4], q[4];
    random_polygon(&r, 4, p);
    memcpy(q, p, sizeof p);
    bezier_from_span(4, tau, 3, 1, q);
    CHECK(memcmp(p, q, sizeof p) == 0, "bit for bit");
}

static void cutting_keeps_the_curve(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 500; seed++) {
        TestRandom r = test_random(seed);
        int k = test_int(&r, 2, 32);
        Vec4 p[32], left[32], right[32];
        random_polygon(&r, k, p);
        memcpy(right, p, sizeof p);
        double s = test_unit(&r), x = test_unit(&r), bound = 12 * k * 0x1p-53 * largest4(k, p);
        bezier_cut(k, 1, s, right, left);
        CHECK_WITHIN(distance4(bezier_point(k, left, x), bezier_point(k, p, s * x)), bound, "seed %u", seed);
        CHECK_WITHIN(distance4(bezier_point(k, right, x), bezier_point(k, p, s + (1 - s) * x)), bound, "seed %u", seed);
        CHECK(memcmp(&left[k - 1], &right[0], sizeof *p) == 0, "the halves meet, seed %u", seed);
        CHECK(memcmp(&left[0], &p[0], sizeof *p) == 0 && memcmp(&right[k - 1], &p[k - 1], sizeof *p) == 0, "ends");
    }
}

static void polygons_side_by_side_are_cut_alike(void **state)
{
    (void)state;
    TestRandom r = test_random(5);
    enum { K = 5, WIDTH = 3 };
    Vec4 both[K * WIDTH], left[K * WIDTH];
    random_polygon(&r, K * WIDTH, both);
    Vec4 alone[WIDTH][K], alone_left[WIDTH][K];
    for (int c = 0; c < WIDTH; c++) {
        for (int i = 0; i < K; i++) alone[c][i] = both[i * WIDTH + c];
        bezier_cut(K, 1, 0.3, alone[c], alone_left[c]);
    }
    bezier_cut(K, WIDTH, 0.3, both, left);
    for (int c = 0; c < WIDTH; c++)
        for (int i = 0; i < K; i++) {
            CHECK(memcmp(&both[i * WIDTH + c], &alone[c][i], sizeof(Vec4)) == 0, "right %d %d", c, i);
            CHECK(memcmp(&left[i * WIDTH + c], &alone_left[c][i], sizeof(Vec4)) == 0, "left %d %d", c, i);
        }
}

static void hulls_contain_the_curve(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 200; seed++) {
        TestRandom r = test_random(seed);
        int k = test_int(&r, 2, 12);
        Vec4 p[12];
        random_polygon(&r, k, p);
        Box b = box_expand(bezier_hull(k, p), 1e-14);
        for (int i = 0; i <= 20; i++) CHECK(box_contains(b, vec4_project(bezier_point(k, p, i / 20.0))), "seed %u", seed);
    }
}

/* The point of a patch, and its first derivatives by central differences of a polynomial: exact to about 1e-9. */
static Vec3 patch_point(int k_u, int k_v, const Vec4 *patch, double s, double t)
{
    Vec4 column[NURBS_MAX_ORDER];
    for (int i = 0; i < k_v; i++) column[i] = bezier_point(k_u, patch + i * k_u, s);
    return vec4_project(bezier_point(k_v, column, t));
}

static void check_bend(int k_u, int k_v, const Vec4 *patch, TestRandom *r, unsigned seed)
{
    const double h = 1e-5;
    double bend = bezier_bend(k_u, k_v, patch);
    double s = test_range(r, h, 1 - h), t = test_range(r, h, 1 - h), x = test_unit(r), y = test_unit(r);
    Vec3 at = patch_point(k_u, k_v, patch, s, t);
    Vec3 s_u = vec_scale(vec_sub(patch_point(k_u, k_v, patch, s + h, t), patch_point(k_u, k_v, patch, s - h, t)), 0.5 / h);
    Vec3 s_v = vec_scale(vec_sub(patch_point(k_u, k_v, patch, s, t + h), patch_point(k_u, k_v, patch, s, t - h)), 0.5 / h);
    Vec3 tangent = vec_add(at, vec_add(vec_scale(s_u, x - s), vec_scale(s_v, y - t)));
    double off = vec_length(vec_sub(patch_point(k_u, k_v, patch, x, y), tangent));
    double step = fmax(fabs(x - s), fabs(y - t));
    CHECK_WITHIN(off, bend * step * step + 1e-6, "seed %u k %d %d", seed, k_u, k_v);
}

static void no_patch_bends_more_than_its_bound(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 2000; seed++) {
        TestRandom r = test_random(seed);
        int k_u = test_int(&r, 2, 6), k_v = test_int(&r, 2, 6);
        Vec4 p[36];
        random_polygon(&r, k_u * k_v, p);
        check_bend(k_u, k_v, p, &r, seed);
    }
}

static void a_parallelogram_does_not_bend(void **state)
{
    (void)state;
    Vec4 p[12];
    for (int i = 0; i < 12; i++) p[i] = vec4(i % 4, 2 * (i / 4), i % 4 + i / 4, 1);
    CHECK(bezier_bend(4, 3, p) == 0, "%g", bezier_bend(4, 3, p));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closing_leaves_the_curve_where_it_was),
        cmocka_unit_test(a_bezier_span_is_closed_already),
        cmocka_unit_test(cutting_keeps_the_curve),
        cmocka_unit_test(polygons_side_by_side_are_cut_alike),
        cmocka_unit_test(hulls_contain_the_curve),
        cmocka_unit_test(no_patch_bends_more_than_its_bound),
        cmocka_unit_test(a_parallelogram_does_not_bend),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
