/* The curvature heuristic against a hand-worked example; adaptive cuts against the bound that they promise. */
#include "nurbs/basis.h"
#include "nurbs/flatten.h"
#include "nurbs/knots.h"
#include "tests/models.h"

/* By hand, [MCFS00] section 2.1: a cubic (k = 4) over the uniform knots 0 .. 7, control points (0,0) (1,0) (1,1) (0,1). The
 * one span is [3, 4]: i = 3, dt = 1.
 *   V_j = 3 (P_j - P_{j-1}) / (t_{j+3} - t_j), j = 1..3; every difference of knots is 3:  V = (1,0) (0,1) (-1,0)
 *   avg|V| = (1 + 1 + 1) / 3 = 1
 *   A_j = 2 (V_j - V_{j-1}) / (t_{j+2} - t_j), j = 2..3; every difference of knots is 2:  A = (-1,1) (-1,-1), max|A| = sqrt
 *   2 n = C sqrt(2) 1^{3/2} / 1^{1/2} = 1.414 C; scaled by 4 in space: V, A times 4: n = C 4 sqrt(2) / 2 = 2.828 C */
static const double uniform[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
static const Vec3 arch[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };

static void the_heuristic_is_that_of_the_hand_worked_example(void **state)
{
    (void)state;
    Vec3 large[4];
    for (int i = 0; i < 4; i++) large[i] = vec_scale(arch[i], 4);
    FlattenCurve c = flatten_curve(4, uniform, 3, arch), d = flatten_curve(4, uniform, 3, large);
    CHECK_WITHIN(fabs(c.turn * sqrt(c.length) - sqrt(2)), 1e-15, "n / C");
    CHECK_WITHIN(fabs(d.turn * sqrt(d.length) - 2 * sqrt(2)), 1e-15, "n / C at four times the size");
    CHECK(c.length == 1 && d.length == 4 && c.turn == d.turn, "length %g, turn %g", c.length, c.turn);
}

static void lines_and_points_ask_for_no_knots(void **state)
{
    (void)state;
    const Vec3 line[4] = { { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 }, { 3, 3, 3 } }, pole[4] = { { 0 } };
    CHECK(flatten_curve(4, uniform, 3, line).turn == 0, "a line");
    CHECK(flatten_curve(4, uniform, 3, pole).turn == 0 && flatten_curve(4, uniform, 3, pole).length == 0, "a pole");
    CHECK(flatten_curve(2, uniform, 1, line).turn == 0, "order 2");
}

typedef struct { Arena *a, *scratch; Surface *s; } Fixture;

static Fixture fixture(const Model *m)
{
    Fixture f = { .a = arena_new(), .scratch = arena_new() };
    SurfaceDesc d = model_desc(m);
    NurbsError e;
    f.s = surface_new(f.a, &d, &e, NULL, 0, NULL);
    CHECK(f.s, "code %d", e.code);
    return f;
}

static void done(Fixture *f) { arena_free(f->a), arena_free(f->scratch); }

/* The arch in u, extruded along z in v. */
static Model extruded_arch(double size)
{
    Model m = { .k_u = 4, .n_u = 4, .k_v = 2, .n_v = 2, .knots_v = { 0, 0, 1, 1 } };
    memcpy(m.knots_u, uniform, sizeof uniform);
    for (int i = 0; i < 8; i++) m.points[i] = vec4(size * arch[i % 4].x, size * arch[i % 4].y, size * (i / 4), 1);
    return m;
}

static void cuts_are_spaced_evenly_and_as_many_as_the_heuristic_says(void **state)
{
    (void)state;
    Model m = extruded_arch(1);
    Fixture f = fixture(&m);
    NurbsOptions o = { .flatness = 5 };                       /* n = 7.07: seven knots, eight cells */
    Cuts u = flatten_cuts(f.s, &o, FLATTEN_U, f.a, f.scratch), v = flatten_cuts(f.s, &o, FLATTEN_V, f.a, f.scratch);
    CHECK(u.n == 9 && v.n == 2, "%d %d", u.n, v.n);
    for (int i = 0; i < 9; i++) CHECK_WITHIN(fabs(u.at[i] - (3 + i / 8.0)), 1e-15, "cut %d", i);
    CHECK(u.at[0] == 3 && u.at[8] == 4, "the ends are the knots themselves");
    done(&f);
}

static void the_choice_does_not_depend_on_the_scale(void **state)
{
    (void)state;
    int expected = 0;
    for (int e = -8; e <= 8; e += 4) {
        Model m = extruded_arch(pow(10, e));
        Fixture f = fixture(&m);
        for (int way = 0; way < 2; way++) {
            NurbsOptions o = { .flattening = way ? NURBS_FLATTENING_ADAPTIVE : NURBS_FLATTENING_CURVATURE };
            Cuts u = flatten_cuts(f.s, &o, FLATTEN_U, f.a, f.scratch);
            if (e == -8) expected += way ? 1000 * u.n : u.n;
            CHECK(u.n == (way ? expected / 1000 : expected % 1000), "1e%d, way %d: %d cuts", e, way, u.n);
        }
        done(&f);
    }
}

static void a_twisted_bilinear_patch_is_cut_both_ways(void **state)
{
    (void)state;
    Model m = { .k_u = 2, .k_v = 2, .n_u = 2, .n_v = 2, .knots_u = { 0, 0, 1, 1 }, .knots_v = { 0, 0, 1, 1 },
                .points = { { -1, -1, 1, 1 }, { 1, -1, -1, 1 }, { -1, 1, -1, 1 }, { 1, 1, 1, 1 } } };
    Fixture twisted = fixture(&m);
    for (int i = 0; i < 4; i++) m.points[i].z = 0;
    Fixture flat = fixture(&m);
    NurbsOptions o = { 0 };
    CHECK(flatten_cuts(twisted.s, &o, FLATTEN_U, twisted.a, twisted.scratch).n > 4, "u");
    CHECK(flatten_cuts(twisted.s, &o, FLATTEN_V, twisted.a, twisted.scratch).n > 4, "v");
    CHECK(flatten_cuts(flat.s, &o, FLATTEN_U, flat.a, flat.scratch).n == 2, "a plane is one leaf");
    done(&twisted), done(&flat);
}

/* The sagitta of the surface's own points over each piece, along rows at many v: at most the bound, for the control polygon,
 * which is farther out, is within it. */
static void adaptive_pieces_are_within_the_chord_bound(void **state)
{
    (void)state;
    Model m;
    model_torus(&m, 0.4);
    Fixture f = fixture(&m);
    const double bound = 0.003;
    NurbsOptions o = { .flattening = NURBS_FLATTENING_ADAPTIVE, .flatness = bound };
    Cuts u = flatten_cuts(f.s, &o, FLATTEN_U, f.a, f.scratch);
    for (int i = 0; i + 1 < u.n; i++)
        for (int j = 0; j <= 8; j++) {
            Vec3 a, b, p, d_u, d_v;
            surface_point(f.s, u.at[i], 0.5 * j, &a, &d_u, &d_v);
            surface_point(f.s, u.at[i + 1], 0.5 * j, &b, &d_u, &d_v);
            surface_point(f.s, (u.at[i] + u.at[i + 1]) / 2, 0.5 * j, &p, &d_u, &d_v);
            Vec3 chord = vec_normalize(vec_sub(b, a));
            CHECK_WITHIN(vec_length(vec_cross(vec_sub(p, a), chord)), bound, "piece %d, row %d", i, j);
        }
    CHECK(u.n > 4 * 4 && u.n < 4 * 64, "%d cuts", u.n);
    done(&f);
}

static void absurd_flatness_is_bounded(void **state)
{
    (void)state;
    Model m = extruded_arch(1);
    Fixture f = fixture(&m);
    NurbsOptions c = { .flatness = 1e300 }, h = { .flatness = 1e-300, .flattening = NURBS_FLATTENING_ADAPTIVE };
    CHECK(flatten_cuts(f.s, &c, FLATTEN_U, f.a, f.scratch).n == 1025, "curvature");
    CHECK(flatten_cuts(f.s, &h, FLATTEN_U, f.a, f.scratch).n == 1025, "adaptive");
    done(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_heuristic_is_that_of_the_hand_worked_example),
        cmocka_unit_test(lines_and_points_ask_for_no_knots),
        cmocka_unit_test(cuts_are_spaced_evenly_and_as_many_as_the_heuristic_says),
        cmocka_unit_test(the_choice_does_not_depend_on_the_scale),
        cmocka_unit_test(a_twisted_bilinear_patch_is_cut_both_ways),
        cmocka_unit_test(adaptive_pieces_are_within_the_chord_bound),
        cmocka_unit_test(absurd_flatness_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
