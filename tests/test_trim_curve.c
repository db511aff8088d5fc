/* Reading trims: curves against basis functions and circles, joints, the domain's border, degenerate loops. */
#include "tests/test.h"

#include "nurbs/basis.h"
#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "nurbs/trim_flat.h"
#include "nurbs/trim_loop.h"
#include "tests/trims.h"

/* ---- curves ---- */

typedef struct { TrimCurveDesc desc; double knots[64]; Vec3 points[64]; } Curve;

/* Orders 2 to 8, any multiplicities up to the order, clamped or not, weights over four decades. */
static void random_curve(TestRandom *r, Curve *c)
{
    int k = test_int(r, 2, 8), n = test_int(r, k, k + 12);
    double t = test_range(r, -3, 3);
    for (int i = 0, left = 0; i < n + k; i++, left--) {
        if (left <= 0) {
            t += test_range(r, .01, 1);
            left = i == 0 || i >= n || test_int(r, 0, 3) == 0 ? test_int(r, 1, k) : 1;
        }
        c->knots[i] = t;
    }
    for (int i = 0; i < n; i++) {
        c->points[i] = vec(test_unit(r), test_unit(r), pow(10, test_range(r, -2, 2)));
    }
    c->desc = (TrimCurveDesc){ .order = k, .n = n, .knots = c->knots, .points = c->points };
}

static void random_valid_curve(TestRandom *r, Curve *c)
{
    NurbsError error;
    memset(&error, 0, sizeof error);
    do random_curve(r, c); while (!trim_curve_is_valid(&c->desc, &error));   /* the domain may have come out empty */
}

static Vec2 point_by_basis(const TrimCurveDesc *c, int span, double t)
{
    double b[NURBS_MAX_ORDER], w = 0, x = 0, y = 0;
    basis_derivative(c->order, c->knots, span, t, 0, b);
    for (int i = 0; i < c->order; i++) {
        Vec3 p = c->points[span - c->order + 1 + i];
        x += b[i] * p.z * p.x, y += b[i] * p.z * p.y, w += b[i] * p.z;
    }
    return vec2(x / w, y / w);
}

static double between(Vec2 a, Vec2 b) { return vec2_length(vec2_sub(a, b)); }

static void segment_of(const TrimCurveDesc *c, int span, Vec4 out[])
{
    WideControl p[NURBS_MAX_ORDER];
    trim_curve_segment(c, &unit_square, span, p);
    for (int i = 0; i < c->order; i++) out[i] = vec4(p[i].x.hi, p[i].y.hi, 0, p[i].w.hi);
}

static void a_segment_is_its_span_of_the_curve(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        Curve c;
        random_valid_curve(&r, &c);
        for (int s = trim_curve_span(&c.desc, 0); s >= 0; s = trim_curve_span(&c.desc, s + 1)) {
            Vec4 segment[NURBS_MAX_ORDER];
            segment_of(&c.desc, s, segment);
            for (int i = 0; i <= 8; i++) {
                Vec4 q = bezier_point(c.desc.order, segment, i / 8.);
                double t = c.knots[s] + (c.knots[s + 1] - c.knots[s]) * i / 8;
                CHECK_WITHIN(between(vec2(q.x / q.w, q.y / q.w), point_by_basis(&c.desc, s, t)), 1e-11, "seed %u", seed);
            }
        }
    }
}

/* Every point of the curve is near the polyline, and the polyline's points are on the curve: sampled against it. */
static void a_flattened_curve_is_within_the_chord_error(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        Curve c;
        random_valid_curve(&r, &c);
        for (int s = trim_curve_span(&c.desc, 0); s >= 0; s = trim_curve_span(&c.desc, s + 1)) {
            Vec4 segment[NURBS_MAX_ORDER];
            TrimPoints list = { 0 };
            segment_of(&c.desc, s, segment);
            trim_points_add(a, &list, vec2(segment[0].x / segment[0].w, segment[0].y / segment[0].w));
            trim_flatten(a, c.desc.order, segment, TRIM_CHORD, &list);
            TrimChain chain = trim_chain_make(a, &(TrimPath){ .n = (int)list.n - 1, .p = list.p });
            for (int i = 0; i <= 100; i++) {
                double t = c.knots[s] + (c.knots[s + 1] - c.knots[s]) * i / 100;
                double d = trim_chain_nearest(&chain, point_by_basis(&c.desc, s, t), 1).distance;
                CHECK_WITHIN(d, TRIM_CHORD * 1.001, "seed %u", seed);
            }
        }
        arena_free(a);
    }
}

static void a_clamped_end_is_met_exactly(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 500; seed++) {
        TestRandom r = test_random(seed);
        Curve c;
        random_curve(&r, &c);
        int k = c.desc.order, n = c.desc.n;
        for (int i = 0; i < k; i++) c.knots[i] = c.knots[k - 1], c.knots[n + i] = c.knots[n];
        for (int i = 0; i < n; i++) c.points[i].z = 1;
        if (!knots_is_span(c.knots, k - 1) || !knots_is_span(c.knots, n - 1)) continue;
        Vec4 first[NURBS_MAX_ORDER], last[NURBS_MAX_ORDER];
        segment_of(&c.desc, k - 1, first);
        segment_of(&c.desc, n - 1, last);
        Vec4 a = first[0], b = last[k - 1];
        CHECK(a.x / a.w == c.points[0].x && a.y / a.w == c.points[0].y, "seed %u", seed);
        CHECK(b.x / b.w == c.points[n - 1].x && b.y / b.w == c.points[n - 1].y, "seed %u", seed);
    }
}

static void a_rational_circle_becomes_arcs_of_the_circle(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (int e = 0; e < 5; e++) {
        double radius = .4 * pow(10, -e), turn = e * .3;
        TrimLoopDesc loop = turned_circle(a, vec2(.5, .5), radius, turn, e % 2);
        TrimInput in = { .loops = &loop, .n_loops = 1, .domain = unit_square };
        TrimLoop l;
        NurbsError error;
        CHECK(trim_loop_read(a, &in, 0, &l, &error), "radius %g", radius);
        CHECK(l.path.n == (e ? 8 : 4), "radius %g: %d arcs", radius, l.path.n);      /* quarters, cut where they turn */
        double true_area = (e % 2 ? -1 : 1) * acos(-1) * radius * radius;
        CHECK_WITHIN(fabs(l.area - true_area), 1e-9 * radius * radius + 1e-15 * radius, "radius %g", radius);
        TrimChain chain = trim_chain_make(a, &l.path), flat = trim_chain_flatten(a, &chain, TRIM_CHORD);
        for (int i = 0; i < flat.path.n; i++) {
            Vec2 middle = vec2_scale(vec2_add(flat.path.p[i], flat.path.p[i + 1]), .5);
            CHECK_WITHIN(fabs(between(flat.path.p[i], vec2(.5, .5)) - radius), 1e-15, "radius %g", radius);
            CHECK_WITHIN(radius - between(middle, vec2(.5, .5)), TRIM_CHORD, "radius %g", radius);
        }
        CHECK(flat.path.n < 20000 * sqrt(radius), "%d points", flat.path.n);
    }
    arena_free(a);
}

static void each_fault_of_a_curve_has_its_code(void **state)
{
    (void)state;
    const double good[8] = { 0, 0, 0, 1, 2, 3, 3, 3 };
    const Vec3 p[5] = { { .1, .1, 1 }, { .9, .1, 1 }, { .9, .9, 1 }, { .1, .9, 1 }, { .1, .1, 1 } };
    struct { NurbsCode code; int order, n, knot, point, index, other; double knot_value; Vec3 point_value; } rows[] = {
        { NURBS_OK, 3, 5, -1, -1, 0, 0, 0, { 0, 0, 0 } },
        { NURBS_BAD_ORDER, 1, 5, -1, -1, 0, 1, 0, { 0, 0, 0 } },
        { NURBS_BAD_ORDER, 33, 5, -1, -1, 0, 33, 0, { 0, 0, 0 } },
        { NURBS_TOO_FEW_POINTS, 3, 2, -1, -1, 0, 3, 0, { 0, 0, 0 } },
        { NURBS_KNOTS_DECREASE, 3, 5, 4, -1, 4, 3, .5, { 0, 0, 0 } },
        { NURBS_KNOT_NOT_FINITE, 3, 5, 4, -1, 4, 0, NAN, { 0, 0, 0 } },
        { NURBS_KNOT_MULTIPLICITY, 3, 5, 3, -1, 3, 3, 0, { 0, 0, 0 } },
        { NURBS_BAD_WEIGHT, 3, 5, -1, 2, 2, 0, 0, { .9, .9, 0 } },
        { NURBS_BAD_WEIGHT, 3, 5, -1, 2, 2, 0, 0, { .9, .9, INFINITY } },
        { NURBS_POINT_NOT_FINITE, 3, 5, -1, 3, 3, 1, 0, { .9, NAN, 1 } },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double knots[8];
        Vec3 points[5];
        memcpy(knots, good, sizeof good), memcpy(points, p, sizeof p);
        if (rows[i].knot >= 0) knots[rows[i].knot] = rows[i].knot_value;
        if (rows[i].point >= 0) points[rows[i].point] = rows[i].point_value;
        TrimCurveDesc c = { .order = rows[i].order, .n = rows[i].n, .knots = knots, .points = points };
        TrimLoopDesc loop = { .curves = &c, .n_curves = 1 };
        Arena *a = arena_new();
        Made m = make_of(a, &loop, 1);
        CHECK(m.error.code == rows[i].code, "row %zu: code %d", i, m.error.code);
        if (rows[i].code != NURBS_OK) {
            CHECK(m.error.where == NURBS_IN_TRIM && m.error.trim == 0 && m.error.curve == 0, "row %zu", i);
            CHECK(m.error.index == rows[i].index && m.error.other == rows[i].other, "row %zu", i);
        }
        arena_free(a);
    }
}

static void a_trim_of_too_few_points_is_refused(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 p[3] = { { .2, .2 }, { .8, .2 }, { .5, .8 } };
    TrimLoopDesc loops[3] = { loop_of(a, p, 3), loop_of(a, p, 2), { 0 } };
    for (int n = 0; n < 2; n++) {
        loops[1] = n == 0 ? loops[1] : loops[2];
        Made m = make_of(a, loops, 2);
        CHECK(m.tree == NULL && m.error.code == NURBS_TRIM_TOO_SHORT && m.error.index == 1 && m.error.trim == 1, "%d", n);
    }
    Vec2 bad[3] = { { .2, .2 }, { .8, INFINITY }, { .5, .8 } };
    loops[1] = loop_of(a, bad, 3);
    Made m = make_of(a, loops, 2);
    CHECK(m.tree == NULL && m.error.code == NURBS_POINT_NOT_FINITE && m.error.trim == 1 && m.error.index == 1, "inf");
    arena_free(a);
}

/* ---- joints ---- */

/* A square whose corner between side 1 and side 2 is open by `gap` along u, over another domain than the unit square. */
static Made square_with_gap(Arena *a, double gap, TrimDistance distance)
{
    TrimRect domain = { -10, 30, 5, 7 };
    Vec2 p[4] = { { .2, .2 }, { .8, .2 }, { .8, .8 }, { .2, .8 } }, start[4], end[4];
    for (int i = 0; i < 4; i++) start[i] = trim_from_unit(&domain, p[i]), end[i] = trim_from_unit(&domain, p[(i + 1) % 4]);
    start[2].x += gap * 40;
    TrimLoopDesc loop = sides(a, start, end, 4);
    return make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .domain = domain, .distance = distance });
}

static double a_tenth_of_the_domain(const void *surface, Vec2 p, Vec2 q)
{
    (void)surface;
    return hypot((p.x - q.x) / 40, (p.y - q.y) / 2) / 10;
}

static void joints_close_silently_up_to_1e_6_and_are_bridged_up_to_1e_3(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const double gaps[] = { 0, 1e-15, 9.9e-7, -9.9e-7 }, bridges[] = { 1.01e-6, -1.01e-6, 1e-4, 9.9e-4 };
    for (int i = 0; i < 4; i++) {
        Made m = square_with_gap(a, gaps[i], NULL);
        CHECK(m.tree && m.n_warnings == 0, "gap %g", gaps[i]);
        CHECK(trim_piece_count(m.tree) == 4, "gap %g: closed by its midpoint", gaps[i]);
    }
    for (int i = 0; i < 4; i++) {
        Made m = square_with_gap(a, bridges[i], NULL);
        CHECK(m.tree && m.n_warnings == 1 && m.warnings[0].code == NURBS_WARN_TRIM_BRIDGED, "gap %g", bridges[i]);
        CHECK_WITHIN(fabs(m.warnings[0].value - fabs(bridges[i])), 1e-12, "gap %g", bridges[i]);
        CHECK(trim_piece_count(m.tree) == 5, "gap %g: a piece more", bridges[i]);
    }
    arena_free(a);
}

static void a_small_gap_closes_half_way(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 start[3] = { { .2, .2 }, { .8 + 8e-7, .2 - 4e-7 }, { .5, .8 } }, end[3] = { { .8, .2 }, { .5, .8 }, { .2, .2 } };
    TrimLoopDesc loop = sides(a, start, end, 3);
    TrimInput in = { .loops = &loop, .n_loops = 1, .domain = unit_square };
    TrimLoop l;
    NurbsError error;
    CHECK(trim_loop_read(a, &in, 0, &l, &error) && l.path.n == 3, "%d points", l.path.n);
    double nearest = INFINITY;
    for (int i = 0; i < 3; i++) nearest = fmin(nearest, between(l.path.p[i], vec2(.8 + 4e-7, .2 - 2e-7)));
    CHECK_WITHIN(nearest, 1e-15, "the joint");
    arena_free(a);
}

static void a_wider_gap_is_open_and_says_which_curve_and_where(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Made m = square_with_gap(a, 1.01e-3, NULL);
    CHECK(!m.tree && m.error.code == NURBS_TRIM_OPEN && m.error.index == 0 && m.error.other == 2, "code %d", m.error.code);
    CHECK(m.error.where == NURBS_IN_TRIM && m.error.trim == 0 && m.error.curve == 2, "curve %d", m.error.curve);
    CHECK_WITHIN(fabs(m.error.u - (22 + .0404)), 1e-9, "u");
    CHECK_WITHIN(fabs(m.error.v - 6.6), 1e-9, "v");
    CHECK_WITHIN(fabs(m.error.value - 1.01e-3), 1e-12, "gap");
    arena_free(a);
}

static double a_hundredth_of_the_domain(const void *surface, Vec2 p, Vec2 q)
{
    return a_tenth_of_the_domain(surface, p, q) / 10;
}

static void a_gap_that_is_small_in_space_is_bridged(void **state)
{
    (void)state;
    Arena *a = arena_new();
    CHECK(square_with_gap(a, 1.01e-3, a_tenth_of_the_domain).error.code == NURBS_TRIM_OPEN, "1.01e-4 in space");
    CHECK(square_with_gap(a, 9.9e-3, a_hundredth_of_the_domain).tree, "0.99e-4 in space");
    CHECK(square_with_gap(a, 1.01e-2, a_hundredth_of_the_domain).error.code == NURBS_TRIM_OPEN, "1.01e-4 in space");
    arena_free(a);
}

/* The unit sphere by angles over its diameter: poles at v = 0 and v = 1, closed along u. */
static double on_a_sphere(const void *surface, Vec2 p, Vec2 q)
{
    (void)surface;
    const double pi = acos(-1);
    Vec3 a = vec(sin(pi * p.y) * cos(2 * pi * p.x), sin(pi * p.y) * sin(2 * pi * p.x), cos(pi * p.y));
    Vec3 b = vec(sin(pi * q.y) * cos(2 * pi * q.x), sin(pi * q.y) * sin(2 * pi * q.x), cos(pi * q.y));
    return vec_length(vec_sub(a, b)) / 2;
}

/* From (.25, 0) up, along v = .5, and down to (.75, 0): the side along v = 0 is left out. */
static Made without_its_last_side(Arena *a, double v_low, double u0, double u1)
{
    Vec2 start[3] = { { u0, v_low }, { u0, .5 }, { u1, .5 } }, end[3] = { { u0, .5 }, { u1, .5 }, { u1, v_low } };
    TrimLoopDesc loop = sides(a, start, end, 3);
    return make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .domain = unit_square, .distance = on_a_sphere });
}

static void a_trim_may_leave_out_the_side_of_a_pole(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Made m = without_its_last_side(a, 0, .25, .75);
    CHECK(m.tree, "code %d", m.error.code);
    CHECK(trim_keeps(m.tree, .5, .25) && trim_keeps(m.tree, .5, 1e-9) && !trim_keeps(m.tree, .2, .25), "the region");
    CHECK(without_its_last_side(a, .25, .25, .75).error.code == NURBS_TRIM_OPEN, "not at a pole");
    arena_free(a);
}

static void a_gap_round_a_closed_surface_is_not_bridged_across_it(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 start[2] = { { 0, .5 }, { .5, .6 } }, end[2] = { { .5, .6 }, { 1, .5 } };   /* its ends are one point in space */
    TrimLoopDesc loop = sides(a, start, end, 2);
    Made m = make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .domain = unit_square, .distance = on_a_sphere });
    CHECK(!m.tree && m.error.code == NURBS_TRIM_OPEN && m.error.other == 0, "code %d", m.error.code);
    arena_free(a);
}

static void a_knot_of_full_multiplicity_is_a_joint(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (int is_open = 0; is_open < 2; is_open++) {
        double jump = is_open ? 2e-3 : 5e-7;
        const double knots[8] = { 0, 0, 1, 2, 2, 3, 4, 4 };
        Vec3 p[6] = { { .2, .2, 1 }, { .8, .2, 1 }, { .8, .8, 1 }, { .8, .8 + jump, 1 }, { .2, .8, 1 }, { .2, .2, 1 } };
        TrimCurveDesc c = { .order = 2, .n = 6, .knots = knots, .points = p };
        TrimLoopDesc loop = { .curves = &c, .n_curves = 1 };
        Made m = make_of(a, &loop, 1);
        CHECK(is_open ? m.error.code == NURBS_TRIM_OPEN && m.error.other == 0 : m.tree && m.n_warnings == 0, "%g", jump);
    }
    arena_free(a);
}

/* ---- the border ---- */

/* A triangle clockwise whose tip is outside the domain by d. */
static Made tip_outside(Arena *a, double d)
{
    TrimRect domain = { 100, 300, -1, 3 };
    Vec2 p[3] = { { .3, .3 }, { .3, .7 }, { 1 + d, .5 } };
    for (int i = 0; i < 3; i++) p[i] = trim_from_unit(&domain, p[i]);
    TrimLoopDesc loop = loop_of(a, p, 3);
    return make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .domain = domain });
}

static void points_outside_are_clamped_silently_up_to_1e_6(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const double silent[] = { 0, 1e-16, 9.9e-7 }, warned[] = { 1.01e-6, 1e-4, .0099 };
    for (int i = 0; i < 3; i++) {
        Made m = tip_outside(a, silent[i]);
        CHECK(m.tree && m.n_warnings == 0, "%g", silent[i]);
    }
    for (int i = 0; i < 3; i++) {
        Made m = tip_outside(a, warned[i]);
        CHECK(m.tree && m.n_warnings == 1 && m.warnings[0].code == NURBS_WARN_TRIM_CLAMPED, "%g", warned[i]);
        CHECK_WITHIN(fabs(m.warnings[0].value - warned[i]), 1e-12, "%g", warned[i]);
        CHECK_WITHIN(fabs(m.warnings[0].u - (300 + 200 * warned[i])), 1e-9, "%g", warned[i]);
        CHECK_WITHIN(fabs(m.warnings[0].v - 1), 1e-9, "%g", warned[i]);
    }
    Made m = tip_outside(a, .0101);
    CHECK(!m.tree && m.error.code == NURBS_TRIM_OUTSIDE && m.error.index == 0 && m.error.trim == 0, "code %d", m.error.code);
    CHECK_WITHIN(fabs(m.error.u - 302.02), 1e-9, "u");
    CHECK_WITHIN(fabs(m.error.value - .0101), 1e-12, "value");
    arena_free(a);
}

/* What is inside the domain stays where it was: the border cuts, it does not bend. */
static void clamping_leaves_what_is_inside_alone(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 p[3] = { { .3, .3 }, { .3, .7 }, { 1.009, .5 } };
    TrimLoopDesc loop = loop_of(a, p, 3);
    Made m = make_of(a, &loop, 1);
    TestRandom r = test_random(1);
    for (int i = 0; i < 20000; i++) {
        double u = test_unit(&r), v = test_unit(&r), half = .2 * (1.009 - u) / .709;
        CHECK(trim_keeps(m.tree, u, v) == (u > .3 && fabs(v - .5) < half), "(%.17g, %.17g)", u, v);
    }
    arena_free(a);
}

static void the_curve_counts_and_not_its_control_points(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const double knots[6] = { 0, 0, 0, 1, 1, 1 };
    for (int i = 0; i < 2; i++) {
        double peak = i == 0 ? 1 : 1.011;   /* the parabola from v = .5 to v = .5 goes half as far as its control point */
        Vec3 p[3] = { { .2, .5, 1 }, { .5, .5 + 2 * (peak - .5), 1 }, { .8, .5, 1 } };
        Vec3 q[2] = { { .8, .5, 1 }, { .2, .5, 1 } };
        const double line[4] = { 0, 0, 1, 1 };
        TrimCurveDesc c[2] = { { .order = 3, .n = 3, .knots = knots, .points = p },
                               { .order = 2, .n = 2, .knots = line, .points = q } };
        TrimLoopDesc loop = { .curves = c, .n_curves = 2 };
        Made m = make_of(a, &loop, 1);
        CHECK(i == 0 ? m.tree && m.n_warnings == 0 : m.error.code == NURBS_TRIM_OUTSIDE, "peak %g", peak);
    }
    arena_free(a);
}

/* A region whose lower side is a cubic of many spans beside the border, as CAD systems write an isoline: `off` is how
 * far. */
static TrimLoopDesc beside_the_border(Arena *a, double off, int n, TestRandom *r)
{
    static const double line[4] = { 0, 0, 1, 1 };
    double *knots = ARENA_ARRAY(a, double, n + 4);
    Vec3 *p = ARENA_ARRAY(a, Vec3, n), *corner = ARENA_ARRAY(a, Vec3, 4);
    for (int i = 0; i < n + 4; i++) knots[i] = i < 4 ? 0 : i >= n ? n - 3 : i - 3;
    for (int i = 0; i < n; i++) p[i] = vec((double)i / (n - 1), off * test_range(r, -1, 1), 1);
    corner[0] = p[n - 1], corner[1] = vec(1, .5, 1), corner[2] = vec(0, .5, 1), corner[3] = p[0];
    TrimCurveDesc *c = ARENA_ARRAY(a, TrimCurveDesc, 4);
    c[0] = (TrimCurveDesc){ .order = 4, .n = n, .knots = knots, .points = p };
    for (int i = 0; i < 3; i++) c[i + 1] = (TrimCurveDesc){ .order = 2, .n = 2, .knots = line, .points = corner + i };
    return (TrimLoopDesc){ .curves = c, .n_curves = 4 };
}

static void a_curve_along_the_border_is_the_border(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 50; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        TrimLoopDesc loop = beside_the_border(a, pow(10, test_range(&r, -16, -6)), test_int(&r, 4, 200), &r);
        Made m = make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .keep_left = true, .domain = unit_square });
        CHECK(m.tree && m.n_warnings == 0, "seed %u: code %d", seed, m.error.code);
        CHECK(trim_piece_count(m.tree) == 4, "seed %u: %d pieces", seed, trim_piece_count(m.tree));
        for (int i = 0; i <= 100; i++) CHECK(trim_keeps(m.tree, i / 100., 0), "seed %u", seed);
        CHECK(trim_class(m.tree, (TrimRect){ 0, 1, 0, .49 }) == TRIM_KEPT, "seed %u: no trim test at the border", seed);
        arena_free(a);
    }
}

static void a_curve_that_leaves_the_domain_is_clamped_where_it_leaves(void **state)
{
    (void)state;
    for (int e = 0; e < 2; e++) {
        Arena *a = arena_new();
        double radius = .25, out = e ? 9e-3 : 1.1e-6;
        Vec2 centre = vec2(1 - radius + out, .5);
        for (int i = 0; i < 5; i++) {
            TrimLoopDesc loop = turned_circle(a, centre, radius, i * .4, true);
            Made m = make_of(a, &loop, 1);
            CHECK(m.tree && m.n_warnings == 1 && m.warnings[0].code == NURBS_WARN_TRIM_CLAMPED, "code %d", m.error.code);
            CHECK_WITHIN(fabs(m.warnings[0].value - out), 1e-12, "how far");
            CHECK_WITHIN(fabs(m.warnings[0].v - .5), 1e-6, "where");
            TestRandom r = test_random((uint64_t)i);
            for (int j = 0; j < 5000; j++) {
                double angle = test_range(&r, -.4, .4), s = radius + (j % 2 ? -1 : 1) * pow(10, test_range(&r, -14, -2));
                Vec2 q = vec2(centre.x + s * cos(angle), centre.y + s * sin(angle));
                if (q.x <= 1) CHECK(trim_keeps(m.tree, q.x, q.y) == (s < radius), "(%.17g, %.17g)", q.x, q.y);
            }
            CHECK(trim_keeps(m.tree, 1, .5) && !trim_keeps(m.tree, 1, .5 + 1.1 * sqrt(2 * radius * out)), "the border");
        }
        arena_free(a);
    }
}

static void a_curve_of_thirty_thousand_knots_is_read(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const int n = 30000;
    double *knots = ARENA_ARRAY(a, double, n + 4);
    Vec3 *p = ARENA_ARRAY(a, Vec3, n);
    for (int i = 0; i < n + 4; i++) knots[i] = i < 4 ? 0 : i >= n ? n - 3 : i - 3;
    for (int i = 0; i < n; i++) {
        double t = 2 * acos(-1) * i / (n - 1), radius = .4 + .05 * sin(100 * t);
        p[i] = vec(.5 + radius * cos(t), .5 + radius * sin(t), 1);
    }
    p[n - 1] = p[0];
    TrimCurveDesc c = { .order = 4, .n = n, .knots = knots, .points = p };
    TrimLoopDesc loop = { .curves = &c, .n_curves = 1 };
    Made m = make_of(a, &loop, 1);
    CHECK(m.tree && m.n_warnings == 0, "code %d", m.error.code);
    CHECK(trim_piece_count(m.tree) >= n - 3 && trim_piece_count(m.tree) < n + 1000, "%d pieces", trim_piece_count(m.tree));
    TestRandom r = test_random(1);
    for (int i = 0; i < 20000; i++) {           /* counterclockwise: a hole; between knots the curve is near its points */
        double t = test_range(&r, .01, 6.27), radius = .4 + .05 * sin(100 * t) + (i % 2 ? 1e-4 : -1e-4);
        CHECK(trim_keeps(m.tree, .5 + radius * cos(t), .5 + radius * sin(t)) == i % 2, "%.17g", t);
    }
    arena_free(a);
}

/* A curve that goes very far out is refused at once, not flattened to 1e-7 of the domain. */
static void a_curve_that_goes_far_out_costs_nothing(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loop = circle(a, vec2(.5, .5), 1e12, false);
    CHECK(make_of(a, &loop, 1).error.code == NURBS_TRIM_OUTSIDE, "a circle of radius 1e12");
    CHECK(arena_bytes(a) < 1u << 20, "%zu bytes", arena_bytes(a));
    loop = circle(a, vec2(.5, .5), 1e300, false);
    CHECK(make_of(a, &loop, 1).error.code == NURBS_TRIM_OUTSIDE, "a circle of radius 1e300");
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_segment_is_its_span_of_the_curve),
        cmocka_unit_test(a_flattened_curve_is_within_the_chord_error),
        cmocka_unit_test(a_clamped_end_is_met_exactly),
        cmocka_unit_test(a_rational_circle_becomes_arcs_of_the_circle),
        cmocka_unit_test(each_fault_of_a_curve_has_its_code),
        cmocka_unit_test(a_trim_of_too_few_points_is_refused),
        cmocka_unit_test(joints_close_silently_up_to_1e_6_and_are_bridged_up_to_1e_3),
        cmocka_unit_test(a_small_gap_closes_half_way),
        cmocka_unit_test(a_wider_gap_is_open_and_says_which_curve_and_where),
        cmocka_unit_test(a_gap_that_is_small_in_space_is_bridged),
        cmocka_unit_test(a_trim_may_leave_out_the_side_of_a_pole),
        cmocka_unit_test(a_gap_round_a_closed_surface_is_not_bridged_across_it),
        cmocka_unit_test(a_knot_of_full_multiplicity_is_a_joint),
        cmocka_unit_test(points_outside_are_clamped_silently_up_to_1e_6),
        cmocka_unit_test(clamping_leaves_what_is_inside_alone),
        cmocka_unit_test(the_curve_counts_and_not_its_control_points),
        cmocka_unit_test(a_curve_along_the_border_is_the_border),
        cmocka_unit_test(a_curve_that_leaves_the_domain_is_clamped_where_it_leaves),
        cmocka_unit_test(a_curve_of_thirty_thousand_knots_is_read),
        cmocka_unit_test(a_curve_that_goes_far_out_costs_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
