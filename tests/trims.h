/* Loops for the tests of trims, and the tree made of them in one call. */
#ifndef TRIMRAY_TESTS_TRIMS_H
#define TRIMRAY_TESTS_TRIMS_H

#include "nurbs/trim_tree.h"

#include <math.h>
#include <string.h>

static const TrimRect unit_square = { 0, 1, 0, 1 };

/* A polyline of n points {u, v}. */
static inline TrimLoopDesc loop_of(Arena *a, const Vec2 *p, int n)
{
    Vec3 *points = ARENA_ARRAY(a, Vec3, n + 1);
    for (int i = 0; i < n; i++) points[i] = vec(p[i].x, p[i].y, 1);
    TrimCurveDesc *c = ARENA_NEW(a, TrimCurveDesc);
    *c = (TrimCurveDesc){ .order = 2, .n = n, .points = points };
    return (TrimLoopDesc){ .curves = c, .n_curves = 1, .is_polyline = true };
}

static inline Vec2 turned(Vec2 p, double angle, Vec2 about)
{
    Vec2 d = vec2_sub(p, about);
    return vec2(about.x + d.x * cos(angle) - d.y * sin(angle), about.y + d.x * sin(angle) + d.y * cos(angle));
}

static inline TrimLoopDesc rectangle(Arena *a, double u0, double u1, double v0, double v1, bool is_clockwise)
{
    Vec2 ccw[4] = { { u0, v0 }, { u1, v0 }, { u1, v1 }, { u0, v1 } }, cw[4] = { ccw[0], ccw[3], ccw[2], ccw[1] };
    return loop_of(a, is_clockwise ? cw : ccw, 4);
}

/* A circle as the usual rational B-spline of order 3 with nine points (one closed curve), its first point turned. */
static inline TrimLoopDesc turned_circle(Arena *a, Vec2 centre, double radius, double angle, bool is_clockwise)
{
    static const double knots[12] = { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 };
    static const double x[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, y[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
    Vec3 *points = ARENA_ARRAY(a, Vec3, 9);
    for (int i = 0; i < 9; i++) {
        int j = is_clockwise ? 8 - i : i;
        Vec2 p = turned(vec2(centre.x + radius * x[j], centre.y + radius * y[j]), angle, centre);
        points[i] = vec(p.x, p.y, i % 2 ? sqrt(.5) : 1);
    }
    TrimCurveDesc *c = ARENA_NEW(a, TrimCurveDesc);
    *c = (TrimCurveDesc){ .order = 3, .n = 9, .knots = knots, .points = points };
    return (TrimLoopDesc){ .curves = c, .n_curves = 1 };
}

static inline TrimLoopDesc circle(Arena *a, Vec2 centre, double radius, bool is_clockwise)
{
    return turned_circle(a, centre, radius, 0, is_clockwise);
}

/* What trim_tree_new said. */
typedef struct {
    TrimTree *tree;
    NurbsError error;
    NurbsWarning warnings[8];
    int n_warnings;
} Made;

static inline Made make(Arena *a, TrimInput in)
{
    Made m;
    memset(&m, 0, sizeof m);
    m.tree = trim_tree_new(a, &in, &m.error, m.warnings, 8, &m.n_warnings);
    return m;
}

static inline Made make_of(Arena *a, const TrimLoopDesc *loops, int n)
{
    return make(a, (TrimInput){ .loops = loops, .n_loops = n, .domain = unit_square });
}

/* A loop of order-2 curves, one for each side of the polygon, whose side i begins at start[i] and ends at end[i]. */
static inline TrimLoopDesc sides(Arena *a, const Vec2 *start, const Vec2 *end, int n)
{
    static const double knots[4] = { 0, 0, 1, 1 };
    TrimCurveDesc *c = ARENA_ARRAY(a, TrimCurveDesc, n);
    for (int i = 0; i < n; i++) {
        Vec3 *points = ARENA_ARRAY(a, Vec3, 2);
        points[0] = vec(start[i].x, start[i].y, 1), points[1] = vec(end[i].x, end[i].y, 1);
        c[i] = (TrimCurveDesc){ .order = 2, .n = 2, .knots = knots, .points = points };
    }
    return (TrimLoopDesc){ .curves = c, .n_curves = n };
}

#endif
