/* Preparation: leaves tile the domain, their boxes contain them, breaks split, trims drop. */
#include "nurbs/knots.h"
#include "nurbs/prepare.h"
#include "tests/models.h"

typedef struct { Arena *a, *scratch; Surface *s; LeafTree tree; } Fixture;

static Fixture fixture_of(SurfaceDesc d, NurbsOptions o)
{
    Fixture f = { .a = arena_new(), .scratch = arena_new() };
    NurbsError e;
    f.s = surface_new(f.a, &d, &e, NULL, 0, NULL);
    CHECK(f.s, "code %d", e.code);
    prepare_leaves(f.a, f.scratch, f.s, &o, &f.tree);
    return f;
}

static Fixture fixture(const Model *m) { return fixture_of(model_desc(m), (NurbsOptions){ 0 }); }
static void done(Fixture *f) { arena_free(f->a), arena_free(f->scratch); }

static Model random_model(unsigned seed)
{
    TestRandom r = test_random(seed);
    Model m = { .k_u = test_int(&r, 2, 6), .k_v = test_int(&r, 2, 6) };
    m.n_u = model_random_knots(&r, m.k_u, test_int(&r, 1, 3), m.k_u, m.knots_u);
    m.n_v = model_random_knots(&r, m.k_v, test_int(&r, 1, 3), m.k_v, m.knots_v);
    model_random_points(&r, &m, seed % 2 ? 1 : 100);
    return m;
}

/* The boxes of a tree are asked for by a ray that passes through a point: does it reach item i? */
typedef struct { uint32_t wanted; bool reached; } Reach;

static bool note(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Reach *reach = context;
    (void)r, (void)t_max, (void)t;
    return reach->reached |= i == reach->wanted;
}

static bool box_of_leaf_contains(const LeafTree *tree, uint32_t leaf, Vec3 p, Vec3 dir)
{
    Trace t = { .scratch = NULL };
    Reach reach = { leaf, false };
    Ray r = { .origin = p, .dir = dir, .t_min = 0 };
    double t_max = 0;                                 /* nothing but the point itself */
    bvh_traverse(tree->bvh, &r, &t_max, note, &reach, &t);
    return reach.reached;
}

static SurfacePoint leaf_point(const Surface *s, const Leaf *l, double x, double y)
{
    SurfacePoint p;
    refine_evaluate(s, l->mu_u, x == 1 ? l->u1 : l->u0 + x * (l->u1 - l->u0),
                    l->mu_v, y == 1 ? l->v1 : l->v0 + y * (l->v1 - l->v0), &p);
    return p;
}

static void every_box_contains_its_leaf(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        Model m = random_model(seed);
        Fixture f = fixture(&m);
        TestRandom r = test_random(seed);
        for (int n = 0; n < 200; n++) {
            uint32_t leaf = (uint32_t)test_int(&r, 0, (int)f.tree.n_leaves - 1);
            double x = n % 3 ? test_unit(&r) : n % 2, y = n % 5 ? test_unit(&r) : n % 2;     /* inside, borders, corners */
            Vec3 p = leaf_point(f.s, &f.tree.leaves[leaf], x, y).point;
            CHECK(box_of_leaf_contains(&f.tree, leaf, p, vec(n % 3 - 1, 1, n % 7 - 3)), "seed %u leaf %u", seed, leaf);
        }
        done(&f);
    }
}

static void every_leaf_lies_in_its_spans_and_stretches(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        Model m = random_model(seed);
        Fixture f = fixture(&m);
        for (uint32_t i = 0; i < f.tree.n_leaves; i++) {
            const Leaf *l = &f.tree.leaves[i];
            CHECK(l->u0 < l->u1 && l->v0 < l->v1, "seed %u leaf %u", seed, i);
            CHECK(f.s->tau_u[l->mu_u] <= l->u0 && l->u1 <= f.s->tau_u[l->mu_u + 1], "seed %u leaf %u: span in u", seed, i);
            CHECK(f.s->tau_v[l->mu_v] <= l->v0 && l->v1 <= f.s->tau_v[l->mu_v + 1], "seed %u leaf %u: span in v", seed, i);
            CHECK(l->piece_u->lo <= l->u0 && l->u1 <= l->piece_u->hi, "seed %u leaf %u: stretch in u", seed, i);
            CHECK(l->piece_v->lo <= l->v0 && l->v1 <= l->piece_v->hi, "seed %u leaf %u: stretch in v", seed, i);
            CHECK(!l->needs_trim_test, "no trims");
        }
        done(&f);
    }
}

/* Each parameter belongs to exactly one half-open leaf, and the areas add up. */
static void leaves_tile_the_domain(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        Model m = random_model(seed);
        Fixture f = fixture(&m);
        TestRandom r = test_random(seed);
        double area = 0, whole = (f.s->u1 - f.s->u0) * (f.s->v1 - f.s->v0);
        for (uint32_t i = 0; i < f.tree.n_leaves; i++) {
            const Leaf *l = &f.tree.leaves[i];
            area += (l->u1 - l->u0) * (l->v1 - l->v0);
        }
        CHECK_WITHIN(fabs(area - whole), 1e-12 * whole, "seed %u", seed);
        for (int n = 0; n < 50; n++) {
            double u = test_range(&r, f.s->u0, f.s->u1), v = test_range(&r, f.s->v0, f.s->v1);
            int owners = 0;
            for (uint32_t i = 0; i < f.tree.n_leaves; i++) {
                const Leaf *l = &f.tree.leaves[i];
                owners += l->u0 <= u && u < l->u1 && l->v0 <= v && v < l->v1;
            }
            CHECK(owners == 1, "seed %u (%g, %g): %d leaves", seed, u, v, owners);
        }
        done(&f);
    }
}

static void the_tangent_parallelogram_is_as_near_as_its_bulge_says(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        Model m = random_model(seed);
        Fixture f = fixture(&m);
        TestRandom r = test_random(seed);
        for (int n = 0; n < 200; n++) {
            const Leaf *l = &f.tree.leaves[test_int(&r, 0, (int)f.tree.n_leaves - 1)];
            double x = test_unit(&r), y = test_unit(&r);
            Vec3 p = leaf_point(f.s, l, x, y).point;
            Vec3 q = vec_add(l->middle.point, vec_add(vec_scale(l->middle.s_u, (x - 0.5) * (l->u1 - l->u0)),
                                                      vec_scale(l->middle.s_v, (y - 0.5) * (l->v1 - l->v0))));
            CHECK_WITHIN(vec_length(vec_sub(p, q)), l->bulge + 1e-11 * l->size, "seed %u", seed);
        }
        done(&f);
    }
}

/* Two flat squares, one at z = 0 and one at z = 1, that share no point: a C^-1 break at u = 1. */
static void a_break_splits_the_surface(void **state)
{
    (void)state;
    Model m = { .k_u = 2, .k_v = 2, .n_u = 4, .n_v = 2, .knots_u = { 0, 0, 1, 1, 2, 2 }, .knots_v = { 0, 0, 1, 1 } };
    for (int i = 0; i < 8; i++) m.points[i] = vec4(i % 4 < 2 ? i % 4 : i % 4 - 1, i / 4, i % 4 < 2 ? 0 : 1, 1);
    Fixture f = fixture(&m);
    CHECK(f.tree.n_leaves == 2, "%u leaves", f.tree.n_leaves);
    for (uint32_t i = 0; i < 2; i++) {
        CHECK(f.tree.leaves[i].piece_u->hi - f.tree.leaves[i].piece_u->lo == 1, "leaf %u", i);
        CHECK(box_of_leaf_contains(&f.tree, i, vec(0.5 + i, 0.5, i), vec(0, 0, 1)), "leaf %u", i);
        CHECK(!box_of_leaf_contains(&f.tree, i, vec(1, 0.5, 0.5), vec(0, 0, 1)), "leaf %u does not bridge the gap", i);
    }
    done(&f);
}

static void what_is_trimmed_away_has_no_leaves(void **state)
{
    (void)state;
    Model m;
    model_torus(&m, 0.4);
    const Vec3 square[4] = { { 0.5, 0.5, 1 }, { 0.5, 2.5, 1 }, { 2.5, 2.5, 1 }, { 2.5, 0.5, 1 } };  /* clockwise: kept */
    const TrimCurveDesc curve = { .order = 2, .n = 4, .points = square };
    const TrimLoopDesc loop = { .curves = &curve, .n_curves = 1, .is_polyline = true };
    SurfaceDesc d = model_desc(&m);
    Fixture whole = fixture_of(d, (NurbsOptions){ 0 });
    d.trims = &loop, d.n_trims = 1;
    Fixture trimmed = fixture_of(d, (NurbsOptions){ 0 });
    uint32_t n_untested = 0;
    CHECK(trimmed.tree.n_leaves + trimmed.tree.n_cut == whole.tree.n_leaves, "%u kept", trimmed.tree.n_leaves);
    CHECK(trimmed.tree.n_cut > whole.tree.n_leaves / 2, "%u of %u dropped", trimmed.tree.n_cut, whole.tree.n_leaves);
    for (uint32_t i = 0; i < trimmed.tree.n_leaves; i++) {
        const Leaf *l = &trimmed.tree.leaves[i];
        CHECK(l->u1 >= 0.5 && l->u0 <= 2.5 && l->v1 >= 0.5 && l->v0 <= 2.5, "leaf %u lies outside", i);
        bool is_inside = l->u0 > 0.5 && l->u1 < 2.5 && l->v0 > 0.5 && l->v1 < 2.5;
        CHECK(is_inside || l->needs_trim_test, "leaf %u is on the trim", i);
        n_untested += !l->needs_trim_test;
    }
    CHECK(n_untested > 0 && n_untested == trimmed.tree.n_untested, "%u, %u", n_untested, trimmed.tree.n_untested);
    done(&whole), done(&trimmed);
}

static void scratch_is_left_as_it_was(void **state)
{
    (void)state;
    Model m;
    model_sphere(&m);
    Fixture f = fixture(&m);
    ArenaMark mark = arena_mark(f.scratch);
    LeafTree again;
    NurbsOptions o = { .flattening = NURBS_FLATTENING_ADAPTIVE };
    prepare_leaves(f.a, f.scratch, f.s, &o, &again);
    ArenaMark after = arena_mark(f.scratch);
    CHECK(mark.block == after.block && mark.used == after.used, "marks");
    done(&f);
}

/* A strip of n bicubic spans: twice as many spans may take about twice the memory, not four times. */
static size_t bytes_for_spans(int n)
{
    Arena *points = arena_new();
    double *knots = ARENA_ARRAY(points, double, n + 7);
    Vec4 *p = ARENA_ARRAY(points, Vec4, (n + 3) * 4);
    const double knots_v[8] = { 0, 0, 0, 0, 1, 1, 1, 1 };
    for (int i = 0; i < n + 7; i++) knots[i] = i;
    for (int i = 0; i < (n + 3) * 4; i++) p[i] = vec4(i % (n + 3), i / (n + 3), 0.1 * ((i * 7) % 3), 1);
    SurfaceDesc d = { .order_u = 4, .order_v = 4, .n_u = n + 3, .n_v = 4, .knots_u = knots, .knots_v = knots_v,
                      .points = p };
    Fixture f = fixture_of(d, (NurbsOptions){ .flatness = 1e-9 });
    CHECK((int)f.tree.n_leaves == n, "%u leaves", f.tree.n_leaves);
    size_t bytes = arena_bytes(f.a) + arena_bytes(f.scratch);
    done(&f);
    arena_free(points);
    return bytes;
}

static void thousands_of_spans_take_linear_memory(void **state)
{
    (void)state;
    size_t few = bytes_for_spans(1000), many = bytes_for_spans(16000);
    CHECK(many < 24 * few, "%zu and %zu bytes", few, many);              /* 16, and blocks that double */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_box_contains_its_leaf),
        cmocka_unit_test(every_leaf_lies_in_its_spans_and_stretches),
        cmocka_unit_test(leaves_tile_the_domain),
        cmocka_unit_test(the_tangent_parallelogram_is_as_near_as_its_bulge_says),
        cmocka_unit_test(a_break_splits_the_surface),
        cmocka_unit_test(what_is_trimmed_away_has_no_leaves),
        cmocka_unit_test(scratch_is_left_as_it_was),
        cmocka_unit_test(thousands_of_spans_take_linear_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
