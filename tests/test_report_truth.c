/* What reports hold all methods against, `method certain` with the smallest leaves, is itself held against the oracle; and so
 * are the leaf sizes that reports sweep. */
#include "tests/oracle.h"
#include "tests/test.h"

#include "nurbs/nurbs.h"
#include "render/shape.h"

enum { ORDER = 4, N = 6, MAX_ROOTS = 16, N_SURFACES = 12, N_RAYS = 40 };

/* How far hits may be from the oracle's, before the ray's slant makes more of it: the patches' own rounding is some 20 units
 * 2^-53 of the surface's size, which is about 2 here. */
static const double BAND = 1e-14;

/* A bumpy rational sheet over [-1, 1]^2, with uneven knots. */
static void make_surface(TestRandom *r, SurfaceDesc *out, double knots[2][N + ORDER], Vec4 *points)
{
    for (int d = 0; d < 2; d++)
        for (int i = 0; i < N + ORDER; i++)
            knots[d][i] = i < ORDER ? 0 : i >= N ? N - ORDER + 1 : i - ORDER + test_range(r, .6, 1.4);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++)
            points[j * N + i] = (Vec4){ 2. * i / (N - 1) - 1, 2. * j / (N - 1) - 1, test_range(r, -.4, .4), test_range(r, .5, 2) };
    *out = (SurfaceDesc){ .order_u = ORDER, .order_v = ORDER, .n_u = N, .n_v = N, .knots_u = knots[0], .knots_v = knots[1],
                          .points = points };
}

static Ray make_ray(TestRandom *r)
{
    Vec3 from = vec(test_range(r, -2, 2), test_range(r, -2, 2), test_range(r, -2, 2));
    Vec3 to = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -.3, .3));
    return (Ray){ from, vec_normalize(vec_sub(to, from)), 0 };
}

/* The first root beyond the origin; -1: there is none; -2: none that is sure to be the first. */
static int first_root(const OracleRoot *roots, int n)
{
    for (int i = 0; i < n; i++) {
        if (roots[i].t + roots[i].t_error + BAND < 0) continue;
        return roots[i].is_cluster || !roots[i].is_sure || roots[i].t - roots[i].t_moves - BAND < 0 ? -2 : i;
    }
    return -1;
}

static void check_ray(Shape *const shapes[3], const Oracle *o, const Ray *r, unsigned seed, int *n_sure)
{
    OracleRoot roots[MAX_ROOTS];
    int n = oracle_roots(o, r, BAND, roots, MAX_ROOTS), first = first_root(roots, n);
    if (first == -2) return;
    for (int k = 0; k < 3; k++) {
        Trace t = { .scratch = arena_new() };
        Hit h = { .t = INFINITY };
        bool is_hit = shape_hit(shapes[k], r, &h, &t);
        CHECK(is_hit == (first >= 0), "seed %u, leaves %d: hit %d, %d roots", seed, k, is_hit, n);
        if (is_hit)
            CHECK_WITHIN(fabs(h.t - roots[first].t), roots[first].t_error + roots[first].t_moves + BAND, "seed %u, leaves %d",
                         seed, k);
        arena_free(t.scratch);
    }
    (*n_sure)++;
}

static void no_leaf_size_loses_or_moves_a_hit(void **state)
{
    static const double variations[] = { .05, .35, 1.4 };    /* of the reference, by default, the largest of a sweep */
    int n_sure = 0;
    (void)state;
    for (unsigned seed = 0; seed < N_SURFACES; seed++) {
        Arena *a = arena_new();
        TestRandom random = test_random(seed);
        SurfaceDesc desc;
        double knots[2][N + ORDER];
        Vec4 points[N * N];
        NurbsError error;
        Shape *shapes[3];
        make_surface(&random, &desc, knots, points);
        for (int k = 0; k < 3; k++) {
            NurbsOptions options = { .method = NURBS_METHOD_CERTAIN, .leaf_variation = variations[k] };
            shapes[k] = nurbs_shape_new(a, &desc, &options, &error, NULL, 0, NULL);
            CHECK(shapes[k] != NULL, "seed %u: error %d", seed, error.code);
        }
        Oracle *oracle = oracle_new(&desc);
        for (int i = 0; i < N_RAYS; i++) {
            Ray r = make_ray(&random);
            check_ray(shapes, oracle, &r, seed, &n_sure);
        }
        oracle_free(oracle);
        for (int k = 0; k < 3; k++) shape_release(shapes[k]);
        arena_free(a);
    }
    CHECK(n_sure > N_SURFACES * N_RAYS * 9 / 10, "only %d rays are sure", n_sure);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(no_leaf_size_loses_or_moves_a_hit) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
