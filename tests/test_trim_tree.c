/* The hierarchy, the keep rule, loops that say nothing, conflicts, and crossings on both sides of each bound. */
#include "tests/test.h"

#include "nurbs/trim_cross.h"
#include "nurbs/trim_loop.h"
#include "nurbs/trim_test.h"
#include "tests/trims.h"

/* ---- hierarchy and keep rule ---- */

static const TrimNode *only(const TrimList *l)
{
    CHECK(l->n == 1, "%d trims", l->n);
    return l->trims[0];
}

static void trims_nest_by_containment_in_any_order(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc nested[4] = { rectangle(a, .1, .9, .1, .9, true), rectangle(a, .2, .8, .2, .8, false),
                               rectangle(a, .3, .7, .3, .7, true), rectangle(a, .4, .6, .4, .6, false) };
    int order[4];
    for (int code = 0; code < 256; code++) {                  /* all permutations are among them */
        unsigned seen = 0;
        for (int i = 0; i < 4; i++) order[i] = code >> (2 * i) & 3, seen |= 1u << order[i];
        if (seen != 15) continue;
        TrimLoopDesc loops[4];
        for (int i = 0; i < 4; i++) loops[order[i]] = nested[i];
        Made m = make_of(a, loops, 4);
        const TrimList *l = &m.tree->top;
        for (int i = 0; i < 4; i++) {
            CHECK(only(l)->index == order[i] && only(l)->is_region == (i % 2 == 0), "order %d, level %d", code, i);
            l = &only(l)->inner;
        }
        CHECK(l->n == 0, "order %d", code);
    }
    arena_free(a);
}

static void trims_of_one_list_stay_side_by_side(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[11];
    loops[0] = rectangle(a, .05, .95, .05, .95, true);
    for (int i = 0; i < 9; i++) {
        double u = .1 + i % 3 * .25, v = .1 + i / 3 * .25;
        loops[i + 1] = rectangle(a, u, u + .2, v, v + .2, false);
    }
    loops[10] = rectangle(a, .13, .17, .13, .17, true);
    Made m = make_of(a, loops, 11);
    const TrimNode *outer = only(&m.tree->top);
    CHECK(outer->index == 0 && outer->inner.n == 9 && trim_loop_count(m.tree) == 11, "%d inside", outer->inner.n);
    for (int i = 0; i < 9; i++) {
        const TrimNode *hole = outer->inner.trims[i];
        CHECK(hole->inner.n == (hole->index == 1), "trim %d", hole->index);
    }
    CHECK(trim_piece_count(m.tree) == 44, "%d pieces", trim_piece_count(m.tree));
    arena_free(a);
}

static void a_region_keeps_its_inside_and_a_hole_its_outside(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (int is_clockwise = 0; is_clockwise < 2; is_clockwise++) {
        for (int keep_left = 0; keep_left < 2; keep_left++) {
            TrimLoopDesc loop = rectangle(a, .25, .75, .25, .75, is_clockwise);
            Made m = make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .keep_left = keep_left, .domain = unit_square });
            bool is_region = is_clockwise != keep_left;
            CHECK(trim_keeps(m.tree, .5, .5) == is_region, "%d %d", is_clockwise, keep_left);
            CHECK(trim_keeps(m.tree, .1, .5) != is_region, "%d %d", is_clockwise, keep_left);
            CHECK(trim_class(m.tree, (TrimRect){ .3, .7, .3, .7 }) == (is_region ? TRIM_KEPT : TRIM_CUT), "inside");
            CHECK(trim_class(m.tree, (TrimRect){ 0, .2, 0, 1 }) == (is_region ? TRIM_CUT : TRIM_KEPT), "outside");
            CHECK(trim_class(m.tree, (TrimRect){ .2, .3, .3, .7 }) == TRIM_MIXED, "between");
        }
    }
    arena_free(a);
}

static void holes_alone_leave_the_rest_of_the_domain(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[2] = { circle(a, vec2(.3, .3), .2, false), circle(a, vec2(.7, .7), .2, false) };
    Made m = make_of(a, loops, 2);
    CHECK(m.tree->top.n == 2, "%d", m.tree->top.n);
    CHECK(trim_keeps(m.tree, .5, .5) && trim_keeps(m.tree, 0, 0) && trim_keeps(m.tree, 1, 1), "the rest");
    CHECK(!trim_keeps(m.tree, .3, .3) && !trim_keeps(m.tree, .7, .7), "the holes");
    arena_free(a);
}

static void a_level_has_one_direction(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[4] = { rectangle(a, .05, .95, .05, .95, true), rectangle(a, .1, .4, .1, .4, false),
                              rectangle(a, .5, .9, .1, .4, true), rectangle(a, .6, .8, .2, .3, false) };
    Made m = make_of(a, loops, 4);
    CHECK(!m.tree && m.error.code == NURBS_TRIMS_CONFLICT, "code %d", m.error.code);
    CHECK(m.error.where == NURBS_IN_TRIM && m.error.index == 1 && m.error.other == 2, "%d %d", m.error.index, m.error.other);
    loops[2] = rectangle(a, .5, .9, .1, .4, false);
    CHECK(make_of(a, loops, 4).tree, "a hole in a hole is another level");
    TrimLoopDesc top[2] = { rectangle(a, .5, .9, .1, .4, false), rectangle(a, .1, .4, .1, .4, true) };
    m = make_of(a, top, 2);
    CHECK(m.error.code == NURBS_TRIMS_CONFLICT && m.error.index == 0 && m.error.other == 1, "code %d", m.error.code);
    arena_free(a);
}

/* ---- loops that say nothing ---- */

static void a_loop_that_is_the_border_is_left_out(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc hole = rectangle(a, .25, .75, .25, .75, false);
    for (int i = 0; i < 4; i++) {
        double off = (const double[]){ 0, 1e-15, -1e-12, 9e-7 }[i];       /* as real data has it */
        Vec2 p[6] = { { off, -off }, { 0, .3 }, { off, 1 }, { .5, 1 - off }, { 1, 1 }, { 1 - off, 0 } };
        TrimLoopDesc loops[2] = { loop_of(a, p, 6), hole };
        Made m = make_of(a, loops, 1);
        CHECK(!m.tree && m.error.code == NURBS_OK && m.n_warnings == 0, "off %g: code %d", off, m.error.code);
        m = make_of(a, loops, 2);
        CHECK(only(&m.tree->top)->index == 1 && trim_keeps(m.tree, .1, .1) && !trim_keeps(m.tree, .5, .5), "off %g", off);
    }
    TrimLoopDesc all = rectangle(a, 0, 1, 0, 1, false);                   /* the other way round it cuts everything */
    Made m = make_of(a, &all, 1);
    CHECK(trim_class(m.tree, unit_square) == TRIM_CUT && !trim_keeps(m.tree, 0, .5), "a hole as large as the domain");
    arena_free(a);
}

static void a_trim_along_the_border_keeps_the_border(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimRect domain = { -3, 5, 100, 300 };
    Vec2 p[4] = { { -3, 100 }, { -3, 300 }, { 1, 300 }, { 1, 100 } };
    TrimLoopDesc half = loop_of(a, p, 4);
    Made m = make(a, (TrimInput){ .loops = &half, .n_loops = 1, .domain = domain });
    CHECK(trim_keeps(m.tree, -3, 100) && trim_keeps(m.tree, -3, 300) && trim_keeps(m.tree, 0, 300), "corners");
    CHECK(trim_keeps(m.tree, -3 - 1e-9, 100 - 1e-9), "a rounding error outside");
    CHECK(!trim_keeps(m.tree, 5, 100) && !trim_keeps(m.tree, 5, 200), "the other side");
    CHECK(trim_class(m.tree, (TrimRect){ -3, .99, 100, 300 }) == TRIM_KEPT, "a leaf at the border needs no test");
    CHECK(trim_class(m.tree, (TrimRect){ 1.01, 5, 100, 300 }) == TRIM_CUT, "nor one beyond");
    arena_free(a);
}

static void loops_without_area_are_left_out(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 slit[3] = { { .1, .1 }, { .9, .7 }, { .5, .4 } }, point[3] = { { .5, .5 }, { .5, .5 }, { .5, .5 } };
    Vec2 there_and_back[4] = { { .1, .1 }, { .5, .9 }, { .1, .1 }, { .9, .5 } };
    TrimLoopDesc loops[4] = { loop_of(a, slit, 3), loop_of(a, point, 3), loop_of(a, there_and_back, 4),
                              circle(a, vec2(.5, .5), 1e-14, true) };
    Made m = make_of(a, loops, 4);
    CHECK(!m.tree && m.error.code == NURBS_OK && m.n_warnings == 0, "code %d", m.error.code);
    arena_free(a);
}

/* Where nothing was mended a thin loop is as sure as any other. */
static void a_sliver_is_there_if_its_sides_were_not_moved(void **state)
{
    (void)state;
    for (int e = -12; e <= -4; e++) {
        Arena *a = arena_new();
        double w = pow(10, e);
        Vec2 p[4] = { { .1, .5 }, { .1, .5 + w }, { .9, .5 + w }, { .9, .5 } }, start[4], end[4];
        TrimLoopDesc loop = loop_of(a, p, 4);
        Made m = make_of(a, &loop, 1);
        CHECK(m.tree && m.n_warnings == 0, "1e%d: code %d", e, m.error.code);
        CHECK(trim_keeps(m.tree, .3, .5 + w / 2), "1e%d: within", e);
        CHECK(!trim_keeps(m.tree, .3, .5 - w) && !trim_keeps(m.tree, .3, .5 + 2 * w), "1e%d: beside", e);
        for (int i = 0; i < 4; i++) start[i] = p[i], end[i] = p[(i + 1) % 4];
        start[1].x += 8e-7;
        loop = sides(a, start, end, 4);
        m = make_of(a, &loop, 1);
        CHECK((m.tree != NULL) == (w > 8e-7), "1e%d with a joint closed: code %d", e, m.error.code);
        loop = turned_circle(a, vec2(.3, .6), w, 1, true);
        m = make_of(a, &loop, 1);
        CHECK(m.tree && trim_keeps(m.tree, .3, .6) && !trim_keeps(m.tree, .3 + 1.1 * w, .6), "1e%d: a disc", e);
        arena_free(a);
    }
}

static void repeated_points_and_pieces_of_no_length_say_nothing(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 p[9] = { { .2, .2 }, { .2, .2 }, { .2, .8 }, { .8, .8 }, { .8, .8 }, { .8, .8 }, { .8, .2 }, { .2, .2 },
                  { .2, .2 } };
    TrimLoopDesc loop = loop_of(a, p, 9);
    Made m = make_of(a, &loop, 1);
    CHECK(m.tree && m.n_warnings == 0 && trim_piece_count(m.tree) == 4, "%d pieces", trim_piece_count(m.tree));
    arena_free(a);
}

/* A hole joined to the outer loop by a seam that is gone along twice. */
static void a_seam_may_be_used_twice(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (int i = 0; i < 3; i++) {
        double off = (const double[]){ 0, 1e-13, 4e-7 }[i];
        Vec2 p[10] = { { .1, .1 }, { .1, .5 }, { .4, .5 }, { .4, .4 }, { .6, .4 }, { .6, .6 },
                       { .4, .6 }, { .4, .5 + off }, { .1, .5 + off }, { .1, .9 } };
        Vec2 q[12];
        memcpy(q, p, sizeof p);
        q[10] = vec2(.9, .9), q[11] = vec2(.9, .1);
        TrimLoopDesc loop = loop_of(a, q, 12);
        Made m = make_of(a, &loop, 1);
        CHECK(m.tree && m.n_warnings == 0, "off %g: code %d", off, m.error.code);
        CHECK(!trim_keeps(m.tree, .5, .5) && trim_keeps(m.tree, .3, .45) && trim_keeps(m.tree, .3, .55), "off %g", off);
        CHECK(trim_keeps(m.tree, .7, .5) && !trim_keeps(m.tree, .05, .5), "off %g", off);
    }
    arena_free(a);
}

static void a_loop_that_is_there_twice_counts_once(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[3] = { circle(a, vec2(.5, .5), .3, true), circle(a, vec2(.5, .5), .3, true),
                              circle(a, vec2(.5, .5), .1, false) };
    Made m = make_of(a, loops, 3);
    CHECK(m.tree && m.n_warnings == 0, "code %d", m.error.code);
    CHECK(trim_keeps(m.tree, .7, .5) && !trim_keeps(m.tree, .9, .5), "the ring");
    loops[1] = circle(a, vec2(.5, .5), .3, false);
    CHECK(make_of(a, loops, 2).error.code == NURBS_TRIMS_CONFLICT, "both ways round");
    arena_free(a);
}

/* ---- touching ---- */

static void loops_that_touch_in_vertices_and_edges_do_not_cross(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {             /* turned: common edges differ in the last bits */
        Arena *a = arena_new();
        double angle = seed * .0627;
        Vec2 box[4] = { { .3, .3 }, { .3, .7 }, { .7, .7 }, { .7, .3 } };                     /* a region */
        Vec2 in_corner[3] = { { .3, .3 }, { .4, .3 }, { .3, .45 } };                          /* holes: on two edges, */
        Vec2 tip[3] = { { .5, .7 }, { .45, .5 }, { .55, .5 } };                               /* by a vertex, */
        Vec2 across[4] = { { .6, .3 }, { .7, .4 }, { .7, .45 }, { .6, .45 } };                /* from edge to edge */
        Vec2 beside[4] = { { .7, .35 }, { .7, .65 }, { .8, .65 }, { .8, .35 } };              /* a region along an edge */
        Vec2 *all[5] = { box, in_corner, tip, across, beside };
        const int n[5] = { 4, 3, 3, 4, 4 };
        TrimLoopDesc loops[5];
        for (int k = 0; k < 5; k++) {
            for (int i = 0; i < n[k]; i++) all[k][i] = turned(all[k][i], angle, vec2(.5, .5));
            loops[k] = loop_of(a, all[k], n[k]);
        }
        Made m = make_of(a, loops, 5);
        CHECK(m.tree && m.n_warnings == 0, "seed %u: code %d, %d %d", seed, m.error.code, m.error.index, m.error.other);
        CHECK(m.tree->top.n == 2, "seed %u: %d outermost", seed, m.tree->top.n);
        for (int i = 0; i < 2; i++) {
            const TrimNode *t = m.tree->top.trims[i];
            CHECK(t->inner.n == (t->index == 0 ? 3 : 0), "seed %u: trim %d has %d", seed, t->index, t->inner.n);
        }
        arena_free(a);
    }
}

static void curves_that_share_an_arc_do_not_cross(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (unsigned seed = 0; seed < 20; seed++) {              /* the same arc cut elsewhere: other points, the same circle */
        double pi = acos(-1), angle = seed * .0431;
        TrimLoopDesc whole = circle(a, vec2(.5, .5), .35, true);
        Vec2 p[202];
        int n = 0;
        for (int i = 0; i <= 200; i++) {                      /* half a disc with chords of its own, inside the circle */
            double t = angle + pi * i / 200;
            p[n++] = vec2(.5 + .35 * cos(t), .5 + .35 * sin(t));
        }
        TrimLoopDesc loops[2] = { whole, loop_of(a, p, n) };
        Made m = make_of(a, loops, 2);
        CHECK(m.tree && m.n_warnings == 0 && only(&m.tree->top)->inner.n == 1, "seed %u: code %d", seed, m.error.code);
    }
    arena_free(a);
}

static void a_loop_may_touch_itself(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 vertex[6] = { { .1, .1 }, { .5, .5 }, { .1, .9 }, { .9, .9 }, { .5, .5 }, { .9, .1 } };   /* two triangles */
    Vec2 dent[7] = { { .1, .1 }, { .1, .9 }, { .9, .9 }, { .9, .1 }, { .6, .1 }, { .5, .9 }, { .4, .1 } };
    TrimLoopDesc loops[2] = { loop_of(a, vertex, 6), loop_of(a, dent, 7) };
    for (int i = 0; i < 2; i++) {
        Made m = make_of(a, &loops[i], 1);
        CHECK(m.tree && m.n_warnings == 0, "loop %d: code %d", i, m.error.code);
    }
    arena_free(a);
}

/* ---- crossings ---- */

/* Two squares whose corners overlap by d in both directions, turned. */
static Made corners_overlap(Arena *a, double d, double angle, bool is_swapped)
{
    Vec2 p[4] = { { .2, .2 }, { .2, .5 + d }, { .5 + d, .5 + d }, { .5 + d, .2 } };
    Vec2 q[4] = { { .5, .5 }, { .5, .8 }, { .8, .8 }, { .8, .5 } };
    for (int i = 0; i < 4; i++) p[i] = turned(p[i], angle, vec2(.5, .5)), q[i] = turned(q[i], angle, vec2(.5, .5));
    TrimLoopDesc first = loop_of(a, is_swapped ? q : p, 4), second = loop_of(a, is_swapped ? p : q, 4);
    TrimLoopDesc third = rectangle(a, .01, .02, .01, .02, true), fourth = rectangle(a, .03, .04, .01, .02, true);
    TrimLoopDesc loops[4] = { third, first, fourth, second };
    return make_of(a, loops, 4);
}

static void a_crossing_is_a_warning_up_to_1e_4_and_an_error_beyond(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const double depth[] = { 0, 1e-12, 1.9e-6, 2.1e-6, 1e-5, 9.9e-5, 1.02e-4, 1e-3, .1 };
    for (int i = 0; i < 9; i++) {
        for (int turn = 0; turn < 8; turn++) {
            Made m = corners_overlap(a, depth[i], turn * .3, turn % 2);
            int n_warnings = depth[i] > TRIM_CROSSING_SILENT;
            if (depth[i] > 1e-4) {
                CHECK(!m.tree && m.error.code == NURBS_TRIMS_CROSS, "%g: code %d", depth[i], m.error.code);
                CHECK(m.error.index == 1 && m.error.other == 3 && m.error.where == NURBS_IN_TRIM, "%g", depth[i]);
                CHECK_WITHIN(hypot(m.error.u - .5, m.error.v - .5), depth[i] * 1.5, "%g: the place", depth[i]);
                continue;
            }
            CHECK(m.tree && m.n_warnings == n_warnings, "%g: code %d, %d warnings", depth[i], m.error.code, m.n_warnings);
            if (n_warnings == 0) continue;
            NurbsWarning w = m.warnings[0];
            CHECK(w.code == NURBS_WARN_TRIM_CROSSING && w.trim == 1 && w.other == 3, "%g", depth[i]);
            CHECK_WITHIN(fabs(w.value - depth[i]), depth[i] * 1e-2 + 1e-9, "%g: the depth", depth[i]);
            CHECK_WITHIN(hypot(w.u - .5, w.v - .5), depth[i] * 1.5, "%g: the place", depth[i]);
        }
    }
    arena_free(a);
}

/* The place of a deep crossing is a point of both. */
static void a_cross_is_reported_where_it_is(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[2] = { rectangle(a, .1, .9, .4, .6, true), rectangle(a, .3, .35, .05, .95, true) };
    Made m = make_of(a, loops, 2);
    CHECK(m.error.code == NURBS_TRIMS_CROSS && m.error.index == 0 && m.error.other == 1, "code %d", m.error.code);
    double u = fmin(fabs(m.error.u - .3), fabs(m.error.u - .35)), v = fmin(fabs(m.error.v - .4), fabs(m.error.v - .6));
    CHECK_WITHIN(fmax(u, v), 1e-12, "(%g, %g)", m.error.u, m.error.v);
    loops[1] = circle(a, vec2(.9, .5), .05, false);
    m = make_of(a, loops, 2);
    CHECK(m.error.code == NURBS_TRIMS_CROSS, "a circle across an edge: code %d", m.error.code);
    CHECK_WITHIN(fabs(m.error.u - .9), 1e-6, "u");
    CHECK_WITHIN(fabs(fabs(m.error.v - .5) - .05), 1e-6, "v");
    arena_free(a);
}

/* Each of the two is looked at from the other: of the square only a little is in the needle, but the needle goes right
 * through. */
static void a_needle_through_a_square_crosses_it(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[2] = { rectangle(a, .5, .503, .5, .503, true), rectangle(a, .1, .9, .501, .501015, true) };
    Made m = make_of(a, loops, 2);
    CHECK(!m.tree && m.error.code == NURBS_TRIMS_CROSS && m.error.index == 0 && m.error.other == 1, "code %d", m.error.code);
    arena_free(a);
}

/* A square whose ends overshoot at the corner (.2, .2) and close in a small square of side d, gone round the other way. */
static Made overshoot(Arena *a, double d, bool is_reversed)
{
    Vec2 p[6] = { { .2 - d, .2 }, { .8, .2 }, { .8, .8 }, { .2, .8 }, { .2, .2 - d }, { .2 - d, .2 - d } }, q[6];
    for (int i = 0; i < 6; i++) q[i] = p[is_reversed ? 5 - i : i];
    TrimLoopDesc loops[2] = { rectangle(a, .85, .9, .85, .9, is_reversed), loop_of(a, q, 6) };
    return make_of(a, loops, 2);
}

static void a_loop_that_crosses_itself_is_judged_by_the_wrong_region(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const double depth[] = { 1e-9, 1.9e-6, 2.3e-6, 9.9e-5, 1.05e-4, .01 };
    for (int i = 0; i < 6; i++) {
        for (int is_reversed = 0; is_reversed < 2; is_reversed++) {
            Made m = overshoot(a, depth[i], is_reversed);
            if (depth[i] > 1e-4) {
                CHECK(!m.tree && m.error.code == NURBS_TRIMS_CROSS, "%g: code %d", depth[i], m.error.code);
                CHECK(m.error.index == 1 && m.error.other == 1, "%g", depth[i]);
                CHECK_WITHIN(hypot(m.error.u - .2, m.error.v - .2), 1e-9, "%g: the place", depth[i]);
                continue;
            }
            int n_warnings = depth[i] > TRIM_CROSSING_SILENT;
            CHECK(m.tree && m.n_warnings == n_warnings, "%g: code %d, %d warnings", depth[i], m.error.code, m.n_warnings);
            if (n_warnings == 0) continue;
            CHECK(m.warnings[0].code == NURBS_WARN_TRIM_CROSSING && m.warnings[0].trim == 1, "%g", depth[i]);
            CHECK(m.warnings[0].other == 1, "%g", depth[i]);
            CHECK_WITHIN(fabs(m.warnings[0].value - depth[i]), .04 * depth[i], "%g: the depth", depth[i]);
        }
    }
    arena_free(a);
}

static void loops_that_cross_themselves_deeply_are_refused(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Vec2 bow_tie[4] = { { .1, .1 }, { .9, .8 }, { .9, .1 }, { .1, .9 } }, star[5], twice[48];
    for (int i = 0; i < 5; i++) star[i] = vec2(.5 + .4 * cos(.8 * acos(-1) * i), .5 + .4 * sin(.8 * acos(-1) * i));
    for (int i = 0; i < 48; i++) {                            /* round twice, on two circles */
        double t = acos(-1) * i / 12, r = i < 24 ? .4 : .3;
        twice[i] = vec2(.5 + r * cos(t), .5 + r * sin(t));
    }
    Vec2 even[4] = { { .2, .2 }, { .8, .8 }, { .8, .2 }, { .2, .8 } };                  /* its area is 0 */
    TrimLoopDesc loops[4] = { loop_of(a, bow_tie, 4), loop_of(a, star, 5), loop_of(a, twice, 48), loop_of(a, even, 4) };
    for (int i = 0; i < 4; i++) {
        Made m = make_of(a, &loops[i], 1);
        CHECK(!m.tree && m.error.code == NURBS_TRIMS_CROSS && m.error.index == 0 && m.error.other == 0, "loop %d", i);
    }
    arena_free(a);
}

/* Two circles that overlap by d, or one that is in the other but for d: the curves are arcs, the depth is what it is. */
static void curves_that_cross_are_judged_by_their_depth(void **state)
{
    (void)state;
    const double depth[] = { -1e-3, -1e-9, 0, 1e-12, 1.5e-6, 2.6e-6, 5e-5, 9.7e-5, 1.04e-4, .01 };
    for (int i = 0; i < 10; i++) {
        for (int turn = 0; turn < 6; turn++) {
            Arena *a = arena_new();
            bool is_hole = turn % 2;
            double d = depth[i], direction = turn * .7, out = is_hole ? .2 - .1 + d : .2 + .1 - d;
            Vec2 centre = vec2(.5 + out * cos(direction), .5 + out * sin(direction));
            TrimLoopDesc loops[2] = { turned_circle(a, vec2(.5, .5), .2, turn, true),
                                      turned_circle(a, centre, .1, .3, !is_hole) };
            Made m = make_of(a, loops, 2);
            if (d > TRIM_CROSSING) {
                CHECK(m.error.code == NURBS_TRIMS_CROSS, "%g: code %d", d, m.error.code);
                CHECK(m.error.index == 0 && m.error.other == 1, "%g", d);
            } else {
                CHECK(m.tree, "%g: code %d", d, m.error.code);
                CHECK(m.n_warnings == (d > TRIM_CROSSING_SILENT), "%g: %d warnings", d, m.n_warnings);
                CHECK(!is_hole || only(&m.tree->top)->inner.n == 1, "%g: the hole is in the disc", d);
            }
            arena_free(a);
        }
    }
}

/* A cubic that makes a small loop, closed by straight sides. */
static void a_curve_that_crosses_itself_is_refused_or_mentioned(void **state)
{
    (void)state;
    static const double knots[8] = { 0, 0, 0, 0, 1, 1, 1, 1 }, line[4] = { 0, 0, 1, 1 };
    for (int i = 0; i < 3; i++) {
        Arena *a = arena_new();
        double size = (const double[]){ .8, .002, 5e-6 }[i];   /* of the control polygon: a loop of some 1/10 of it */
        Vec3 p[4] = { { .5 - .1 * size, .2, 1 }, { .5 + .5 * size, .2 + .6 * size, 1 },
                      { .5 - .5 * size, .2 + .6 * size, 1 }, { .5 + .1 * size, .2, 1 } };
        Vec3 q[4] = { p[3], { .9, .1, 1 }, { .1, .1, 1 }, p[0] };
        TrimCurveDesc c[4] = { { .order = 4, .n = 4, .knots = knots, .points = p } };
        for (int s = 0; s < 3; s++) c[s + 1] = (TrimCurveDesc){ .order = 2, .n = 2, .knots = line, .points = q + s };
        TrimLoopDesc loop = { .curves = c, .n_curves = 4 };
        Made m = make_of(a, &loop, 1);
        CHECK(i < 2 ? m.error.code == NURBS_TRIMS_CROSS : m.tree && m.n_warnings <= 1, "%g: %d", size, m.error.code);
        if (i == 0) CHECK_WITHIN(fabs(m.error.u - .5), 1e-6, "where it crosses");
        arena_free(a);
    }
}

/* With a shallow crossing the inside is where the winding number is not zero. */
static void inside_of_a_shallow_crossing_is_decided_by_winding(void **state)
{
    (void)state;
    Arena *a = arena_new();
    double d = 9e-5;
    Vec2 curl[8] = { { .2, .2 }, { .8, .2 }, { .8, .8 }, { .2, .8 },                       /* round once, and a bit again: */
                     { .2, .2 }, { .2 + d, .2 }, { .2 + d, .2 + d }, { .2, .2 + d } };     /* twice in the small square */
    TrimLoopDesc loop = loop_of(a, curl, 8);
    Made m = make(a, (TrimInput){ .loops = &loop, .n_loops = 1, .keep_left = true, .domain = unit_square });
    CHECK(m.tree && m.n_warnings == 1, "code %d, %d warnings", m.error.code, m.n_warnings);
    CHECK(trim_keeps(m.tree, .2 + d / 2, .2 + d / 2) && trim_keeps(m.tree, .5, .5) && !trim_keeps(m.tree, .1, .5), "inside");
    Made two = corners_overlap(a, d, 0, false);               /* regions: what is in both is kept */
    CHECK(trim_keeps(two.tree, .5 + d / 2, .5 + d / 2), "both");
    CHECK(trim_keeps(two.tree, .4, .4) && trim_keeps(two.tree, .6, .6), "one of them");
    CHECK(!trim_keeps(two.tree, .4, .6), "neither");
    arena_free(a);
}

/* A hole that reaches over the edge of its region by a little is still its hole. */
static void a_hole_that_crosses_its_region_a_little_stays_in_it(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[2] = { circle(a, vec2(.5, .5), .3, true), circle(a, vec2(.72, .5), .08 + 5e-5, false) };
    Made m = make_of(a, loops, 2);
    CHECK(m.tree && m.n_warnings == 1, "code %d, %d warnings", m.error.code, m.n_warnings);
    CHECK_WITHIN(fabs(m.warnings[0].value - 5e-5), 2e-6, "the depth");
    CHECK(only(&m.tree->top)->index == 0 && only(&m.tree->top)->inner.n == 1, "the hierarchy");
    CHECK(!trim_keeps(m.tree, .75, .5) && trim_keeps(m.tree, .5, .5), "kept");
    arena_free(a);
}

static void warnings_beyond_the_room_for_them_are_counted(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[12];
    for (int i = 0; i < 12; i++) {
        double u = .05 + .07 * i;
        loops[i] = rectangle(a, u, u + .07 + 2e-5, .2, .8, true);
    }
    Made m = make_of(a, loops, 12);
    CHECK(m.tree && m.n_warnings == 11, "%d warnings, code %d", m.n_warnings, m.error.code);
    TrimInput in = { .loops = loops, .n_loops = 12, .domain = unit_square };
    NurbsError error;
    CHECK(trim_tree_new(a, &in, &error, NULL, 0, NULL), "nobody listens");
    arena_free(a);
}

/* Any domain: the same loops, scaled, give the same tree and the same answers. */
static void the_size_of_the_domain_does_not_matter(void **state)
{
    (void)state;
    for (int e = -8; e <= 8; e += 4) {
        Arena *a = arena_new();
        TrimRect domain = { 0, pow(10, e), -pow(10, -e), 0 };
        for (int i = 0; i < 2; i++) {
            double d = i ? 1.1e-4 : .9e-4;
            Vec2 p[4] = { { .2, .2 }, { .2, .5 + d }, { .5 + d, .5 + d }, { .5 + d, .2 } };
            Vec2 q[4] = { { .5, .5 }, { .5, .8 }, { .8, .8 }, { .8, .5 } };
            for (int k = 0; k < 4; k++) p[k] = trim_from_unit(&domain, p[k]), q[k] = trim_from_unit(&domain, q[k]);
            TrimLoopDesc loops[2] = { loop_of(a, p, 4), loop_of(a, q, 4) };
            Made m = make(a, (TrimInput){ .loops = loops, .n_loops = 2, .domain = domain });
            CHECK(i ? m.error.code == NURBS_TRIMS_CROSS : m.tree && m.n_warnings == 1, "1e%d: code %d", e, m.error.code);
            Vec2 at = trim_from_unit(&domain, vec2(.3, .3));
            CHECK(i || trim_keeps(m.tree, at.x, at.y), "1e%d", e);
        }
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trims_nest_by_containment_in_any_order),
        cmocka_unit_test(trims_of_one_list_stay_side_by_side),
        cmocka_unit_test(a_region_keeps_its_inside_and_a_hole_its_outside),
        cmocka_unit_test(holes_alone_leave_the_rest_of_the_domain),
        cmocka_unit_test(a_level_has_one_direction),
        cmocka_unit_test(a_loop_that_is_the_border_is_left_out),
        cmocka_unit_test(a_trim_along_the_border_keeps_the_border),
        cmocka_unit_test(loops_without_area_are_left_out),
        cmocka_unit_test(a_sliver_is_there_if_its_sides_were_not_moved),
        cmocka_unit_test(repeated_points_and_pieces_of_no_length_say_nothing),
        cmocka_unit_test(a_seam_may_be_used_twice),
        cmocka_unit_test(a_loop_that_is_there_twice_counts_once),
        cmocka_unit_test(loops_that_touch_in_vertices_and_edges_do_not_cross),
        cmocka_unit_test(curves_that_share_an_arc_do_not_cross),
        cmocka_unit_test(a_loop_may_touch_itself),
        cmocka_unit_test(a_crossing_is_a_warning_up_to_1e_4_and_an_error_beyond),
        cmocka_unit_test(a_cross_is_reported_where_it_is),
        cmocka_unit_test(a_needle_through_a_square_crosses_it),
        cmocka_unit_test(a_loop_that_crosses_itself_is_judged_by_the_wrong_region),
        cmocka_unit_test(loops_that_cross_themselves_deeply_are_refused),
        cmocka_unit_test(curves_that_cross_are_judged_by_their_depth),
        cmocka_unit_test(a_curve_that_crosses_itself_is_refused_or_mentioned),
        cmocka_unit_test(inside_of_a_shallow_crossing_is_decided_by_winding),
        cmocka_unit_test(a_hole_that_crosses_its_region_a_little_stays_in_it),
        cmocka_unit_test(warnings_beyond_the_room_for_them_are_counted),
        cmocka_unit_test(the_size_of_the_domain_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
