/* The exact predicates, winding numbers, trim_keeps and trim_class against references that share no code with them. */
#include "tests/test.h"

#include "nurbs/trim_test.h"
#include "tests/trims.h"

/* ---- predicates ---- */

__extension__ typedef __int128 Integer;

static int sign_of(Integer x) { return (x > 0) - (x < 0); }

/* Coordinates that are multiples of 2^-53 in [0, 1]: the area is an integer of less than 120 bits. */
static void the_side_of_a_line_is_exact(void **state)
{
    (void)state;
    const double one = 0x1p53;
    int on_line = 0;
    for (unsigned seed = 0; seed < 100000; seed++) {
        TestRandom r = test_random(seed);
        Vec2 a = vec2(test_unit(&r), test_unit(&r)), b = vec2(test_unit(&r), test_unit(&r));
        double s = test_int(&r, 0, 4) / 4., tiny = 0x1p-53;
        Vec2 p = vec2(floor(((1 - s) * a.x + s * b.x) * one) / one, floor(((1 - s) * a.y + s * b.y) * one) / one);
        p = vec2(p.x + test_int(&r, -1, 1) * tiny, p.y + test_int(&r, -1, 1) * tiny);
        Integer ax = (Integer)(a.x * one), ay = (Integer)(a.y * one), bx = (Integer)(b.x * one), by = (Integer)(b.y * one);
        Integer px = (Integer)(p.x * one), py = (Integer)(p.y * one);
        int truth = sign_of((bx - ax) * (py - ay) - (by - ay) * (px - ax));
        CHECK(trim_side(a, b, p) == truth && trim_side(b, a, p) == -truth && trim_side(p, a, b) == truth, "seed %u", seed);
        on_line += truth == 0;
    }
    CHECK(on_line > 1000, "only %d on the line", on_line);
}

static void pieces_meet_where_the_lattice_says_so(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 20000; seed++) {           /* on a lattice of 5 x 5 touches and overlaps are common */
        TestRandom r = test_random(seed);
        Vec2 p[4];
        for (int i = 0; i < 4; i++) p[i] = vec2(test_int(&r, 0, 4) / 4., test_int(&r, 0, 4) / 4.);
        if ((p[0].x == p[1].x && p[0].y == p[1].y) || (p[2].x == p[3].x && p[2].y == p[3].y)) continue;
        double d = INFINITY;                                  /* sampled; pieces that do not meet are .04 apart */
        for (int i = 0; i <= 240; i++) {
            Vec2 q = vec2_add(vec2_scale(p[0], 1 - i / 240.), vec2_scale(p[1], i / 240.));
            d = fmin(d, vec2_length(vec2_sub(q, trim_piece_nearest(p[2], p[3], q))));
        }
        bool meet = trim_pieces_meet(p[0], p[1], p[2], p[3]);
        CHECK(meet ? d < .01 : d > .01, "seed %u: distance %g", seed, d);
    }
}

static Vec2 *random_polygon(TestRandom *r, Arena *a, int n)
{
    Vec2 *p = ARENA_ARRAY(a, Vec2, n + 1);
    for (int i = 0; i < n; i++) p[i] = vec2(test_int(r, 0, 12) / 12., test_int(r, 0, 12) / 12.);
    p[n] = p[0];
    return p;
}

/* The sum of the angles: any polygon, crossing itself as it likes. */
static int winding_by_angles(const Vec2 *p, int n, Vec2 q)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        Vec2 a = vec2_sub(p[i], q), b = vec2_sub(p[i + 1], q);
        sum += atan2(vec2_cross(a, b), vec2_dot(a, b));
    }
    return (int)lround(sum / (2 * acos(-1)));
}

static void the_winding_number_is_the_sum_of_the_angles(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 100; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        int n = test_int(&r, 3, 300);
        Vec2 *p = random_polygon(&r, a, n);
        TrimChain c = trim_chain_make(a, &(TrimPath){ .n = n, .p = p });
        for (int i = 0; i < 200; i++) {
            Vec2 q = vec2(test_range(&r, -.1, 1.1), test_range(&r, -.1, 1.1));
            if (i % 2) q.y = test_int(&r, 0, 12) / 12.;       /* level with vertices */
            if (trim_chain_nearest(&c, q, 1).distance < 1e-9) continue;
            CHECK(trim_chain_winding(&c, wide_point(q)) == winding_by_angles(p, n, q), "seed %u", seed);
        }
        arena_free(a);
    }
}

static void the_nearest_piece_is_that_of_a_search_through_all(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 60; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        int n = test_int(&r, 3, 200);
        Vec2 *p = random_polygon(&r, a, n), q = vec2(test_unit(&r), test_unit(&r));
        TrimChain c = trim_chain_make(a, &(TrimPath){ .n = n, .p = p });
        double best = INFINITY, limit = pow(10, test_range(&r, -4, 0));
        for (int i = 0; i < n; i++) {
            for (int k = 0; k <= 1000; k++) {
                Vec2 x = vec2_add(vec2_scale(p[i], 1 - k / 1000.), vec2_scale(p[i + 1], k / 1000.));
                best = fmin(best, vec2_length(vec2_sub(x, q)));
            }
        }
        TrimNearest near = trim_chain_nearest(&c, q, limit);
        CHECK(near.piece >= 0 ? near.distance <= best : near.distance == limit && best > limit - 1e-3, "seed %u", seed);
        CHECK_WITHIN(fmin(best, limit) - near.distance, 1e-3, "seed %u", seed);
        arena_free(a);
    }
}

/* ---- trim_keeps ---- */

#define MAX_LOOPS 400

/* A random forest of loops: polygons round a centre, each inside the disc that its parent leaves free. */
typedef struct {
    TestRandom random;
    Arena *arena;
    TrimLoopDesc loops[MAX_LOOPS];
    int n_points[MAX_LOOPS], depth[MAX_LOOPS];
    Vec2 *points[MAX_LOOPS];
    int n;
    bool level_is_clockwise[8];
} Forest;

static void plant(Forest *f, Vec2 centre, double radius, int depth)
{
    TestRandom *r = &f->random;
    if (f->n == MAX_LOOPS || depth == 6) return;
    int n = test_int(r, 3, 40), me = f->n++;
    double free_radius = radius, phase = test_unit(r);
    Vec2 *p = ARENA_ARRAY(f->arena, Vec2, n + 1);
    for (int i = 0; i < n; i++) {
        double angle = 2 * acos(-1) * (i + phase) / n * (f->level_is_clockwise[depth] ? -1 : 1);
        double reach = radius * test_range(r, .6, 1);
        p[i] = vec2(centre.x + reach * cos(angle), centre.y + reach * sin(angle));
        free_radius = fmin(free_radius, reach);
    }
    p[n] = p[0];
    free_radius *= cos(acos(-1) / n);
    f->loops[me] = loop_of(f->arena, p, n), f->points[me] = p, f->n_points[me] = n, f->depth[me] = depth;
    int n_children = test_int(r, 0, 4);
    for (int i = 0; i < n_children; i++) {                    /* side by side in a ring; one alone in the middle */
        double angle = 2 * acos(-1) * i / n_children, s = sin(acos(-1) / n_children);
        double out = n_children == 1 ? 0 : free_radius / (1 + s);
        double room = n_children == 1 ? free_radius : out * s;
        plant(f, vec2(centre.x + out * cos(angle), centre.y + out * sin(angle)), room * test_range(r, .3, 1), depth + 1);
    }
}

static void plant_forest(Forest *f, unsigned seed, Arena *a, bool alternates)
{
    f->random = test_random(seed), f->arena = a, f->n = 0;
    for (int d = 0; d < 8; d++) {
        f->level_is_clockwise[d] = alternates ? (d + (int)seed) % 2 : test_int(&f->random, 0, 1);
    }
    for (int i = 0; i < 9; i++) plant(f, vec2((i % 3 + .5) / 3, (i / 3 + .5) / 3), 1 / 6., 0);
}

/* How many loops go round q; the deepest in *deepest (-1: none). By the textbook's even-odd crossing test. */
static int loops_around(const Forest *f, Vec2 q, int *deepest)
{
    int count = 0;
    *deepest = -1;
    for (int k = 0; k < f->n; k++) {
        bool is_inside = false;
        const Vec2 *p = f->points[k];
        for (int i = 0; i < f->n_points[k]; i++) {
            Vec2 a = p[i], b = p[i + 1];
            if ((a.y > q.y) != (b.y > q.y) && q.x < a.x + (b.x - a.x) * (q.y - a.y) / (b.y - a.y)) is_inside = !is_inside;
        }
        if (!is_inside) continue;
        count++;
        if (*deepest < 0 || f->depth[k] > f->depth[*deepest]) *deepest = k;
    }
    return count;
}

static void loops_that_alternate_keep_by_even_and_odd(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 40; seed++) {
        Arena *a = arena_new();
        Forest f;
        plant_forest(&f, seed, a, true);
        Made m = make_of(a, f.loops, f.n);
        CHECK(m.tree && m.n_warnings == 0 && trim_loop_count(m.tree) == f.n, "seed %u: code %d", seed, m.error.code);
        for (int i = 0; i < 3000; i++) {
            Vec2 q = vec2(test_unit(&f.random), test_unit(&f.random));
            int deepest, count = loops_around(&f, q, &deepest);
            bool truth = f.level_is_clockwise[0] ? count % 2 == 1 : count % 2 == 0;
            CHECK(trim_keeps(m.tree, q.x, q.y) == truth, "seed %u (%.17g, %.17g)", seed, q.x, q.y);
        }
        arena_free(a);
    }
}

/* A point is on one side of the loops of the level below the innermost loop round it, if there are any: outside them, which
 * is kept if they are holes; else inside the innermost loop, which is kept if that is a region. */
static bool kept_by_rule(const Forest *f, Vec2 q, bool keep_left)
{
    int deepest;
    (void)loops_around(f, q, &deepest);
    int level = deepest < 0 ? 0 : f->depth[deepest] + 1;
    bool has_inner = deepest < 0;
    for (int k = deepest + 1; deepest >= 0 && k < f->n && f->depth[k] >= level; k++) has_inner = true;
    if (has_inner) return f->level_is_clockwise[level] == keep_left;
    return f->level_is_clockwise[f->depth[deepest]] != keep_left;
}

static void any_directions_keep_by_the_rule_and_left_is_the_reverse(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 40; seed++) {
        Arena *a = arena_new();
        Forest f;
        plant_forest(&f, seed, a, false);
        for (int keep_left = 0; keep_left < 2; keep_left++) {
            Made m = make(a, (TrimInput){ .loops = f.loops, .n_loops = f.n, .keep_left = keep_left, .domain = unit_square });
            CHECK(m.tree, "seed %u: code %d", seed, m.error.code);
            for (int i = 0; i < 2000; i++) {
                Vec2 q = vec2(test_unit(&f.random), test_unit(&f.random));
                CHECK(trim_keeps(m.tree, q.x, q.y) == kept_by_rule(&f, q, keep_left), "seed %u", seed);
            }
        }
        arena_free(a);
    }
}

static void shuffle(TestRandom *r, TrimLoopDesc *loops, int n)
{
    for (int i = n - 1; i > 0; i--) {
        int j = test_int(r, 0, i);
        TrimLoopDesc swap = loops[i];
        loops[i] = loops[j], loops[j] = swap;
    }
}

static void the_order_of_the_loops_does_not_matter(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 20; seed++) {
        Arena *a = arena_new();
        Forest f;
        plant_forest(&f, seed, a, false);
        Made m = make_of(a, f.loops, f.n);
        shuffle(&f.random, f.loops, f.n);
        Made other = make_of(a, f.loops, f.n);
        for (int i = 0; i < 2000; i++) {
            Vec2 q = vec2(test_unit(&f.random), test_unit(&f.random));
            if (i % 2) {                                      /* a vertex */
                int k = test_int(&f.random, 0, f.n - 1);
                q = f.points[k][test_int(&f.random, 0, f.n_points[k])];
            }
            CHECK(trim_keeps(m.tree, q.x, q.y) == trim_keeps(other.tree, q.x, q.y), "seed %u", seed);
        }
        arena_free(a);
    }
}

/* ---- touching and edge-sharing loops ---- */

/* Rectangles of a lattice, cut at random into rectangles that fill them, down to some depth; those of odd depth go the
 * other way. They share edges, parts of edges and vertices with parents, brothers and cousins. Turned by an angle, the
 * edges are no longer the same to the last bit. */
typedef struct { int u0, u1, v0, v1; } Cell;
typedef struct {
    TestRandom random;
    Arena *arena;
    TrimLoopDesc loops[MAX_LOOPS];
    Cell cells[MAX_LOOPS];
    int n;
    double angle;
} Tiling;
#define LATTICE 32

static Vec2 lattice_point(double u, double v, double angle)
{
    return turned(vec2(.2 + .6 * u / LATTICE, .2 + .6 * v / LATTICE), angle, vec2(.5, .5));
}

static void tile(Tiling *t, Cell c, int depth)
{
    TestRandom *r = &t->random;
    int du = c.u1 - c.u0, dv = c.v1 - c.v0;
    if (t->n == MAX_LOOPS) return;
    Vec2 cw[4] = { lattice_point(c.u0, c.v0, t->angle), lattice_point(c.u0, c.v1, t->angle),
                   lattice_point(c.u1, c.v1, t->angle), lattice_point(c.u1, c.v0, t->angle) };
    Vec2 ccw[4] = { cw[0], cw[3], cw[2], cw[1] };
    t->cells[t->n] = c;
    t->loops[t->n++] = loop_of(t->arena, depth % 2 ? ccw : cw, 4);
    if (depth == 4 || du < 2 || dv < 2) return;
    bool along_u = test_int(r, 0, 1);
    int cut = along_u ? test_int(r, c.u0 + 1, c.u1 - 1) : test_int(r, c.v0 + 1, c.v1 - 1);
    Cell low = c, high = c;
    if (along_u) low.u1 = high.u0 = cut; else low.v1 = high.v0 = cut;
    if (test_int(r, 0, 3)) tile(t, low, depth + 1);
    if (test_int(r, 0, 3)) tile(t, high, depth + 1);
}

static void loops_that_share_edges_and_vertices_keep_by_even_and_odd(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 400; seed++) {
        Tiling t = { .random = test_random(seed), .arena = arena_new(), .angle = seed % 4 ? seed * .1 : 0 };
        for (int i = 0; i < 4; i++) {
            int half = LATTICE / 2, u = i % 2 * half, v = i / 2 * half;
            tile(&t, (Cell){ u, u + half, v, v + half }, 0);
        }
        Made m = make_of(t.arena, t.loops, t.n);
        CHECK(m.tree && m.n_warnings == 0 && m.error.code == NURBS_OK, "seed %u: code %d", seed, m.error.code);
        for (int i = 0; i < LATTICE * LATTICE; i++) {
            double u = i % LATTICE + .5, v = i / LATTICE + .5;
            int count = 0;
            for (int k = 0; k < t.n; k++) {
                Cell c = t.cells[k];
                count += u > c.u0 && u < c.u1 && v > c.v0 && v < c.v1;
            }
            Vec2 q = lattice_point(u, v, t.angle);
            CHECK(trim_keeps(m.tree, q.x, q.y) == (count % 2 == 1), "seed %u (%g, %g)", seed, u, v);
        }
        arena_free(t.arena);
    }
}

/* Two regions side by side: a point on the common edge is in one of them. */
static void no_point_falls_between_two_regions(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (unsigned seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        Vec2 s = vec2(.5, test_range(&r, .1, .4)), t = vec2(test_range(&r, .3, .7), test_range(&r, .6, .9));
        Vec2 left[4] = { s, { .1, .1 }, { .1, .9 }, t }, right[4] = { t, { .9, .9 }, { .9, .1 }, s };
        TrimLoopDesc loops[2] = { loop_of(a, left, 4), loop_of(a, right, 4) };
        Made m = make_of(a, loops, 2);
        for (int i = 0; i < 1000; i++) {
            double x = test_unit(&r);
            Vec2 q = vec2_add(vec2_scale(s, 1 - x), vec2_scale(t, x));
            CHECK(trim_keeps(m.tree, q.x, q.y), "seed %u: (%.17g, %.17g)", seed, q.x, q.y);
        }
    }
    arena_free(a);
}

/* ---- trim_class ---- */

static void a_class_agrees_with_all_points_of_the_rectangle(void **state)
{
    (void)state;
    int count[3] = { 0 };
    for (unsigned seed = 0; seed < 30; seed++) {
        Arena *a = arena_new();
        Forest f;
        plant_forest(&f, seed, a, seed % 2);
        Made m = make_of(a, f.loops, f.n);
        for (int i = 0; i < 3000; i++) {
            double w = pow(10, test_range(&f.random, -4, 0)), h = pow(10, test_range(&f.random, -4, 0));
            double u = test_range(&f.random, 0, 1 - w), v = test_range(&f.random, 0, 1 - h);
            TrimRect rect = { u, u + w, v, v + h };
            TrimClass class = trim_class(m.tree, rect);
            count[class]++;
            for (int j = 0; j < 20 && class != TRIM_MIXED; j++) {
                double x = j < 4 ? (j % 2 ? rect.u1 : rect.u0) : test_range(&f.random, rect.u0, rect.u1);
                double y = j < 4 ? (j / 2 ? rect.v1 : rect.v0) : test_range(&f.random, rect.v0, rect.v1);
                CHECK(trim_keeps(m.tree, x, y) == (class == TRIM_KEPT), "seed %u", seed);
            }
        }
        arena_free(a);
    }
    CHECK(count[TRIM_KEPT] > 10000 && count[TRIM_CUT] > 10000, "%d kept, %d cut", count[TRIM_KEPT], count[TRIM_CUT]);
}

/* Mixed is always allowed, but not where no trim is near. */
static void a_rectangle_that_no_trim_meets_is_not_mixed(void **state)
{
    (void)state;
    Arena *a = arena_new();
    TrimLoopDesc loops[2] = { circle(a, vec2(.5, .5), .4, true), circle(a, vec2(.5, .5), .2, false) };
    Made m = make_of(a, loops, 2);
    TestRandom r = test_random(1);
    for (int i = 0; i < 50000; i++) {
        double w = test_range(&r, 0, .1), u = test_range(&r, 0, 1 - w), v = test_range(&r, 0, 1 - w);
        double x = fmax(fabs(u + w / 2 - .5) - w / 2, 0), y = fmax(fabs(v + w / 2 - .5) - w / 2, 0);
        double near = hypot(x, y), far = hypot(fabs(u + w / 2 - .5) + w / 2, fabs(v + w / 2 - .5) + w / 2);
        TrimClass class = trim_class(m.tree, (TrimRect){ u, u + w, v, v + w });
        if (far < .2 - 1e-6 || near > .4 + 1e-6) CHECK(class == TRIM_CUT, "(%g, %g) %g", u, v, w);
        if (near > .2 + 1e-6 && far < .4 - 1e-6) CHECK(class == TRIM_KEPT, "(%g, %g) %g", u, v, w);
        if (near < .2 - 1e-6 && far > .2 + 1e-6) CHECK(class == TRIM_MIXED, "(%g, %g) %g", u, v, w);
    }
    arena_free(a);
}

/* ---- curves, and large loops ---- */

/* Roundings of the circle's points and of the tested ones are some 1e-16; closer in, test_trim_arc.c has the truth. */
static void a_circle_keeps_what_the_circle_encloses(void **state)
{
    (void)state;
    for (int e = 0; e < 6; e++) {
        Arena *a = arena_new();
        double radius = .45 * pow(10, -e);
        TrimLoopDesc loop = circle(a, vec2(.5, .5), radius, true);
        Made m = make_of(a, &loop, 1);
        TestRandom r = test_random((uint64_t)e);
        for (int i = 0; i < 20000; i++) {
            double angle = test_range(&r, 0, 7), s = radius * test_range(&r, 0, 1.1);
            if (i % 2) s = radius + (i % 4 > 1 ? 1e-15 : -1e-15);
            CHECK(trim_keeps(m.tree, .5 + s * cos(angle), .5 + s * sin(angle)) == (s < radius), "radius %g, %g", radius, s);
        }
        arena_free(a);
    }
}

static void a_polyline_is_the_same_as_its_sides_as_curves(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 20; seed++) {
        Arena *a = arena_new();
        Forest f;
        plant_forest(&f, seed, a, false);
        TrimLoopDesc curves[MAX_LOOPS];
        for (int k = 0; k < f.n; k++) curves[k] = sides(a, f.points[k], f.points[k] + 1, f.n_points[k]);
        Made m = make_of(a, f.loops, f.n), c = make_of(a, curves, f.n);
        CHECK(trim_piece_count(m.tree) == trim_piece_count(c.tree), "seed %u", seed);
        for (int i = 0; i < 5000; i++) {
            Vec2 q = vec2(test_unit(&f.random), test_unit(&f.random));
            CHECK(trim_keeps(m.tree, q.x, q.y) == trim_keeps(c.tree, q.x, q.y), "seed %u", seed);
        }
        arena_free(a);
    }
}

/* A gear with a million sides: radius alternates with the point's number, so a point's sector tells its fate. */
static void a_loop_of_a_million_pieces_is_tested_as_any_other(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const int n = 1000000;
    const double step = 2 * acos(-1) / n;
    Vec2 *p = ARENA_ARRAY(a, Vec2, n);
    for (int i = 0; i < n; i++) {
        double radius = i % 2 ? .49 : .25;
        p[i] = vec2(.5 + radius * cos(i * step), .5 + radius * sin(i * step));
    }
    TrimLoopDesc loop = loop_of(a, p, n);
    Made m = make_of(a, &loop, 1);
    CHECK(m.tree && trim_piece_count(m.tree) == n, "code %d", m.error.code);
    TestRandom r = test_random(1);
    for (int i = 0; i < 50000; i++) {
        int k = test_int(&r, 0, n - 2);
        double s = test_range(&r, .2, .53), angle = (k + test_unit(&r)) * step;
        Vec2 q = vec2(.5 + s * cos(angle), .5 + s * sin(angle));
        k = (int)(angle / step);
        double side = vec2_cross(vec2_sub(p[k + 1], p[k]), vec2_sub(q, p[k]));
        if (fabs(side) < 1e-15) continue;
        CHECK(trim_keeps(m.tree, q.x, q.y) == (side < 0), "point %d", i);    /* counterclockwise: a hole */
    }
    arena_free(a);
}

/* Rectangles that end at the height of one of the circle's extreme points, where the arcs' boxes do. */
static void a_rectangle_beside_an_arcs_end_is_not_mixed(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 2000; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new();
        Vec2 c = vec2(test_range(&r, .3, .7), test_range(&r, .3, .7));
        double radius = test_range(&r, .05, .25);
        TrimLoopDesc loop = circle(a, c, radius, seed & 1);
        Made m = make_of(a, &loop, 1);
        for (int i = 0; i < 20; i++) {
            const double heights[] = { c.y - radius, c.y, c.y + radius };
            double h = heights[test_int(&r, 0, 2)] + test_int(&r, -1, 1) * 0x1p-53, w = pow(10, test_range(&r, -16, -9));
            double away = pow(10, test_range(&r, -7, -1.5)) * (2 * test_int(&r, 0, 1) - 1);
            double u = c.x + (fabs(h - c.y) < radius / 2 ? radius * (2 * test_int(&r, 0, 1) - 1) : 0) + away;
            bool is_below = test_int(&r, 0, 1);
            TrimRect rect = { u, u + w, is_below ? h - w : h, is_below ? h : h + w };
            double x = u - c.x, y = h - c.y, beyond = (x * x + y * y - radius * radius) / (2 * radius);
            if (fabs(beyond) < 4 * w + 1e-15) continue;
            TrimClass class = trim_class(m.tree, rect), truth = (beyond < 0) == (seed & 1) ? TRIM_KEPT : TRIM_CUT;
            CHECK(class == truth, "seed %u: class %d, %g from the edge, w %g", seed, class, beyond, w);
        }
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_side_of_a_line_is_exact),
        cmocka_unit_test(pieces_meet_where_the_lattice_says_so),
        cmocka_unit_test(the_winding_number_is_the_sum_of_the_angles),
        cmocka_unit_test(the_nearest_piece_is_that_of_a_search_through_all),
        cmocka_unit_test(loops_that_alternate_keep_by_even_and_odd),
        cmocka_unit_test(any_directions_keep_by_the_rule_and_left_is_the_reverse),
        cmocka_unit_test(the_order_of_the_loops_does_not_matter),
        cmocka_unit_test(loops_that_share_edges_and_vertices_keep_by_even_and_odd),
        cmocka_unit_test(no_point_falls_between_two_regions),
        cmocka_unit_test(a_class_agrees_with_all_points_of_the_rectangle),
        cmocka_unit_test(a_rectangle_that_no_trim_meets_is_not_mixed),
        cmocka_unit_test(a_rectangle_beside_an_arcs_end_is_not_mixed),
        cmocka_unit_test(a_circle_keeps_what_the_circle_encloses),
        cmocka_unit_test(a_polyline_is_the_same_as_its_sides_as_curves),
        cmocka_unit_test(a_loop_of_a_million_pieces_is_tested_as_any_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
