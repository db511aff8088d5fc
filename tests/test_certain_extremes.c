/* `method certain` where there is no table to make: rays that leave a surface, numbers that are no numbers. */
#include "nurbs/certain.h"
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

/* A torus or a saddle; then it is placed so far from the origin. */
static Model torus_or_saddle(Arena *a, unsigned seed)
{
    Net plain;
    Form f = seed % 2 ? form_torus(a, .4, &plain) : form_saddle(a, 1, &plain);
    return model_new(a, f, plain);
}

static void place_at(Model *m, double offset, TestRandom *r)
{
    QuadMap place = model_rotation(r, 1);
    place.o = quad3_scale(random_direction(r), offset);
    model_finish(m, &place, NULL, 0);
}

/* The doubles that the shape was made of, without rounding. */
static Net net_of_desc(Arena *a, const SurfaceDesc *d, const Net *like)
{
    Net n = *like;
    n.p = ARENA_ARRAY(a, Quad4, d->n_u * d->n_v);
    for (int i = 0; i < d->n_u * d->n_v; i++) {
        Quad w = d->points[i].w;
        n.p[i] = (Quad4){ d->points[i].x * w, d->points[i].y * w, d->points[i].z * w, w };
    }
    return n;
}

/* The distance from the ray's point at t to the tangent plane at S(u, v), in 113 bits; what u and v were rounded by lies in
 * that plane. */
static double distance_to_surface(const Net *n, const Ray *r, double t, double u, double v, Vec3 normal)
{
    Quad3 at = quad3_add(quad3_of(r->origin), quad3_scale(quad3_of(r->dir), t));
    return (double)quad_abs(quad3_dot(quad3_sub(at, net_point(n, u, v)), quad3_of(normal)));
}

/* With weights of a ratio up to 1e6, up to 1e8 sizes off. What a hit says is a bound, and no more than some hundred units in
 * the last place of what there is. */
static void a_hit_is_as_near_to_the_surface_as_it_says(void **state)
{
    (void)state;
    static const double offsets[] = { 0, 1, 1e4, 1e8 }, ratios[] = { 1, 1e3, 1e6 };
    for (unsigned seed = 0; seed < 48; seed++) {
        TestRandom random = test_random(seed);
        Arena *a = arena_new();
        Model m = torus_or_saddle(a, seed);
        net_mobius(&m.net, NET_U, ratios[seed / 2 % 3]);
        place_at(&m, offsets[seed / 6 % 4], &random);
        Net exact = net_of_desc(a, &m.desc, &m.net);
        Trace trace = new_trace();
        for (int i = 0; i < 100; i++) {
            Ray r = ray_anywhere(&m, 0, &random);
            Hit hit = { .t = INFINITY };
            if (!shape_hit(m.shape[CERTAIN], &r, &hit, &trace)) continue;
            Attributes at;
            m.shape[CERTAIN]->type->attributes(m.shape[CERTAIN], &r, &hit, &at);
            double error = distance_to_surface(&exact, &r, hit.t, hit.u, hit.v, at.normal);
            double says = hit.t_error * vec_length(r.dir);
            double far = m.at.extent + vec_length(r.origin) + hit.t * vec_length(r.dir);
            CHECK_WITHIN(error, says, "seed %u, ray %d, offset %g, weights 1 to %g", seed, i, offsets[seed / 6 % 4],
                         ratios[seed / 2 % 3]);
            CHECK_WITHIN(says, 256 * 0x1p-53 * far, "seed %u, ray %d: a bound that tells nothing", seed, i);
        }
        arena_free(trace.scratch);
        shape_release(m.shape[CERTAIN]);
        arena_free(a);
    }
}

/* Orders up to 16, weights and knots of all sorts; quarters of the spans, which are dyadic: parameters are exact. At corners
 * the point is a control point, between them its evaluation adds what patch_rounding says. */
static void patches_are_as_near_to_the_surface_as_they_say(void **state)
{
    (void)state;
    static const double offsets[] = { 0, 1, 1e4 };
    for (unsigned seed = 0; seed < 120; seed++) {
        TestRandom random = test_random(seed);
        Arena *a = arena_new();
        Model m = torus_or_saddle(a, seed);
        for (int axis = 0; axis < 2; axis++) {
            net_raise(a, &m.net, axis, test_int(&random, m.net.k[axis], 16));
            if (test_int(&random, 0, 1)) net_mobius(&m.net, axis, pow(10, test_range(&random, 0, 4)));
            double end = m.net.knots[axis][m.net.n[axis]];
            for (int i = 0; i < 3; i++) net_insert(a, &m.net, axis, end * test_int(&random, 1, 63) / 64);
        }
        place_at(&m, offsets[seed / 2 % 3], &random);
        Net exact = net_of_desc(a, &m.desc, &m.net);
        TileTree tree;
        tile_tree_make(a, surface_of_shape(m.shape[CERTAIN]), 1e300, &tree);    /* a tile is a patch */
        for (uint32_t i = 0; i < tree.n_tiles; i++) {
            const Patch *p = tree.tiles[i].patch;
            double s = test_int(&random, 0, 4) / 4., t = test_int(&random, 0, 4) / 4.;
            bool is_corner = (s == 0 || s == 1) && (t == 0 || t == 1);
            Vec4 value, by_s, by_t;
            patch_evaluate(p, s, t, &value, &by_s, &by_t);
            Quad3 at = quad3_add(quad3_of(tree.base), quad3_add(quad3_of(p->origin), quad3_of(vec4_project(value))));
            double error = (double)quad3_length(quad3_sub(at, net_point(&exact, patch_u(p, s), patch_v(p, t))));
            CHECK_WITHIN(error, is_corner ? p->rounding : patch_rounding(p, vec(0, 0, 0)),
                         "seed %u, orders %d and %d, offset %g, at %g, %g", seed, p->k_u, p->k_v, offsets[seed / 2 % 3],
                         s, t);
        }
        shape_release(m.shape[CERTAIN]);
        arena_free(a);
    }
}

/* Knots whose spacing differs by up to 1e12, of multiplicity up to k - 1, with ends clamped or not. */
static int random_knots(TestRandom *r, int k, double *tau)
{
    int n = k, runs = test_int(r, 0, 4), at = 0;
    bool is_clamped = test_int(r, 0, 1);
    double t = test_int(r, 0, 1) ? test_range(r, -1, 1) : 0;
    for (int i = 0; i < k; i++) tau[at++] = t += is_clamped || i == 0 ? 0 : pow(10, test_range(r, -12, 0));
    for (int i = 0; i < runs; i++) {
        int multiplicity = test_int(r, 1, k - 1);
        t += pow(10, test_range(r, -12, 0));
        for (int j = 0; j < multiplicity; j++) tau[at++] = t;
        n += multiplicity;
    }
    t += pow(10, test_range(r, -12, 0));
    for (int i = 0; i < k; i++) tau[at++] = t += is_clamped || i == 0 ? 0 : pow(10, test_range(r, -12, 0));
    return n;
}

enum { MAX_KNOTS = 64 };

/* A surface of numbers that are as good as any, and its net without rounding. */
typedef struct { SurfaceDesc desc; Net net; double knots[2][MAX_KNOTS]; } AnySurface;

static AnySurface *random_surface(Arena *a, TestRandom *r, double offset, double ratio)
{
    AnySurface *s = ARENA_NEW(a, AnySurface);
    int k_u = test_int(r, 2, 8), k_v = test_int(r, 2, 8);
    int n_u = random_knots(r, k_u, s->knots[0]), n_v = random_knots(r, k_v, s->knots[1]);
    Vec4 *p = ARENA_ARRAY(a, Vec4, n_u * n_v);
    for (int i = 0; i < n_u * n_v; i++)
        p[i] = vec4(offset + test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1), pow(ratio, test_unit(r)));
    s->desc = (SurfaceDesc){ .order_u = k_u, .order_v = k_v, .n_u = n_u, .n_v = n_v, .knots_u = s->knots[0],
                             .knots_v = s->knots[1], .points = p };
    s->net = net_of_desc(a, &s->desc, &(Net){ { k_u, k_v }, { n_u, n_v }, { s->knots[0], s->knots[1] }, NULL });
    return s;
}

static int multiplicity(const Net *n, int axis, double t)
{
    int count = 0;
    for (int i = 0; i < n->n[axis] + n->k[axis]; i++) count += n->knots[axis][i] == t;
    return count;
}

/* Closes both knots of a span by inserting them ([PT97] A5.1, in 113 bits); the first of its points then. */
static int insert_ends(Arena *a, Net *n, int axis, double from, double to)
{
    int k = n->k[axis], mu = k - 1;
    while (multiplicity(n, axis, from) < k - 1) net_insert(a, n, axis, from);
    while (multiplicity(n, axis, to) < k - 1) net_insert(a, n, axis, to);
    while (n->knots[axis][mu + 1] <= from) mu++;
    return mu - k + 1;
}

static double distance_to_point(const TileTree *tree, const Patch *p, int i, Quad4 truth)
{
    Quad3 at = quad3_add(quad3_of(tree->base), quad3_add(quad3_of(p->origin), quad3_scale(quad3_of(
        vec(p->p[i].x, p->p[i].y, p->p[i].z)), 1 / (Quad)p->p[i].w)));
    return (double)quad3_length(quad3_sub(at, quad3_scale(quad3(truth.x, truth.y, truth.z), 1 / truth.w)));
}

static void closing_a_span_rounds_each_point_once(void **state)
{
    (void)state;
    static const double offsets[] = { 0, 1e4 }, ratios[] = { 1, 1e6 };
    for (unsigned seed = 0; seed < 80; seed++) {
        TestRandom random = test_random(seed);
        Arena *a = arena_new();
        AnySurface *any = random_surface(a, &random, offsets[seed % 2], ratios[seed / 2 % 2]);
        NurbsError e;
        const Surface *s = surface_new(a, &any->desc, &e, NULL, 0, NULL);
        CHECK(s, "seed %u: code %d, index %d", seed, e.code, e.index);
        TileTree tree;
        tile_tree_make(a, s, 1e300, &tree);    /* a tile is a patch */
        for (uint32_t tile = 0; tile < tree.n_tiles; tile++) {
            const Patch *p = tree.tiles[tile].patch;
            CHECK_WITHIN(p->rounding, 0x1p-53 * (3 * s->size + s->farthest), "seed %u: a bound that tells nothing", seed);
            Net closed = any->net;
            int i = insert_ends(a, &closed, NET_U, p->u0, p->u1), j = insert_ends(a, &closed, NET_V, p->v0, p->v1);
            for (int at = 0; at < p->k_u * p->k_v; at++) {
                Quad4 truth = closed.p[(j + at / p->k_u) * closed.n[NET_U] + i + at % p->k_u];
                CHECK_WITHIN(distance_to_point(&tree, p, at, truth), p->rounding, "seed %u, tile %u, point %d", seed, tile,
                             at);
            }
        }
        arena_free(a);
    }
}

static void a_ray_of_no_numbers_meets_nothing(void **state)
{
    (void)state;
    static const double odd[] = { NAN, INFINITY, -INFINITY, 0, 5e-324, 1e308, -1e308, 1 };
    enum { N = sizeof odd / sizeof *odd };
    Arena *a = arena_new();
    TestRandom random = test_random(3);
    Trace trace = new_trace();
    for (int which = 0; which < 3; which++) {
        Model m = round_thing(a, which, 1, 0, &random);
        for (int i = 0; i < 3000; i++) {
            double x[6];
            for (int k = 0; k < 6; k++) {
                double plain = test_range(&random, -1, 1);
                x[k] = test_int(&random, 0, 1) ? odd[test_int(&random, 0, N - 1)] : plain;
            }
            Ray r = { vec(x[0], x[1], x[2]), vec(x[3], x[4], x[5]), 0 };
            Hit hit = { .t = INFINITY };
            bool is_hit = shape_hit(m.shape[CERTAIN], &r, &hit, &trace);
            bool is_finite = vec_is_finite(r.origin) && vec_is_finite(r.dir) && vec_max_abs(r.dir) > 0;
            CHECK(!is_hit || (is_finite && isfinite(hit.t) && hit.t > 0), "%s, (%g, %g, %g) + t (%g, %g, %g): t %g",
                  m.at.form.name, x[0], x[1], x[2], x[3], x[4], x[5], hit.t);
            (void)shape_blocks(m.shape[CERTAIN], &r, INFINITY, &trace);
        }
        shape_release(m.shape[CERTAIN]);
    }
    arena_free(trace.scratch);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_that_leaves_does_not_meet_what_it_leaves),
        cmocka_unit_test(a_hit_is_as_near_to_the_surface_as_it_says),
        cmocka_unit_test(patches_are_as_near_to_the_surface_as_they_say),
        cmocka_unit_test(closing_a_span_rounds_each_point_once),
        cmocka_unit_test(a_ray_of_no_numbers_meets_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
