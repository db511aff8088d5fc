/* Trims at their extremes, on a bilinear surface over the unit square: x = 2u - 1, y = 2v - 1. See family.h. What is kept
 * is known in closed form, as a signed distance to the nearest edge in (x, y). */
#include "tests/stress/family.h"
#include "tests/trims.h"

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

typedef struct { Quad x, y; } Quad2;
static Quad2 quad2(Quad x, Quad y) { return (Quad2){ x, y }; }
static Quad2 quad2_sub(Quad2 a, Quad2 b) { return quad2(a.x - b.x, a.y - b.y); }
static Quad quad2_cross(Quad2 a, Quad2 b) { return a.x * b.y - a.y * b.x; }
static Quad quad2_dot(Quad2 a, Quad2 b) { return a.x * b.x + a.y * b.y; }
static Quad quad2_length(Quad2 a) { return quad_sqrt(quad2_dot(a, a)); }

typedef struct {
    int n_circles;
    Quad2 centre[2];             /* in (x, y) */
    Quad radius[2];              /* negative: what is outside is kept */
    bool is_union;
    const Vec2 *polygon;         /* counterclockwise about `about`, in (u, v), star-shaped from there; or NULL */
    int n;
    Vec2 about;
    bool is_hole;
    Quad2 feature;               /* where the rays go: about so far from it */
    double reach;
} TrimTruth;

static Quad circles_kept(const TrimTruth *t, Quad2 p)
{
    Quad kept = 0;
    for (int i = 0; i < t->n_circles; i++) {
        Quad d = quad2_length(quad2_sub(p, t->centre[i])), r = t->radius[i], inside = r > 0 ? r - d : d + r;
        kept = i == 0 ? inside : t->is_union ? quad_max(kept, inside) : quad_min(kept, inside);
    }
    return kept;
}

static Quad2 corner(const TrimTruth *t, int i)
{
    Vec2 p = t->polygon[((i % t->n) + t->n) % t->n];
    return quad2(2 * (Quad)p.x - 1, 2 * (Quad)p.y - 1);
}

static Quad segment_distance(Quad2 p, Quad2 a, Quad2 b)
{
    Quad2 way = quad2_sub(b, a), q = quad2_sub(p, a);
    Quad s = quad_max(0, quad_min(1, quad2_dot(q, way) / quad2_dot(way, way)));
    return quad2_length(quad2_sub(q, quad2(s * way.x, s * way.y)));
}

/* The corners' angles about the middle ascend: bisection finds the side that faces p. */
static Quad polygon_kept(const TrimTruth *t, Quad2 p)
{
    Quad2 middle = quad2(2 * (Quad)t->about.x - 1, 2 * (Quad)t->about.y - 1), q = quad2_sub(p, middle);
    int lo = 0, hi = t->n;
    Quad2 first = quad2_sub(corner(t, 0), middle);
    bool is_upper = quad2_cross(first, q) >= 0;
    while (hi - lo > 1) {        /* the side lo .. lo + 1 */
        int i = (lo + hi) / 2;
        Quad2 c = quad2_sub(corner(t, i), middle);
        bool c_upper = quad2_cross(first, c) >= 0;
        bool is_after = c_upper == is_upper ? quad2_cross(c, q) >= 0 : c_upper;
        if (is_after) lo = i;
        else hi = i;
    }
    Quad2 a = corner(t, lo), b = corner(t, lo + 1);
    bool is_inside = quad2_cross(quad2_sub(b, a), quad2_sub(p, a)) >= 0;
    Quad distance = segment_distance(p, a, b);
    int near = t->n < 16 ? t->n : 16;   /* of sliver's few sides all, of a round polygon's many the neighbours */
    for (int i = lo - near; i <= lo + near; i++)
        distance = quad_min(distance, segment_distance(p, corner(t, i), corner(t, i + 1)));
    return is_inside != t->is_hole ? distance : -distance;
}

static Quad kept(const void *context, Quad3 p)
{
    const TrimTruth *t = context;
    return t->polygon ? polygon_kept(t, quad2(p.x, p.y)) : circles_kept(t, quad2(p.x, p.y));
}

static Model trimmed(Arena *a, const TrimTruth *t, const TrimLoopDesc *loops, int n, TestRandom *r)
{
    Net net;
    Form f = form_saddle(a, test_int(r, 0, 1) ? .5 : 0, &net);
    Model m = model_new(a, f, net);
    QuadMap place = model_rotation(r, 1);
    m.own = arena_copy(a, t, 1, sizeof *t);
    m.at.kept = kept, m.at.kept_context = m.own;
    model_finish(&m, &place, loops, n);
    return m;
}

/* A circle, given in (u, v), with its truth. By the rule of the right side a clockwise loop keeps its inside. */
static TrimLoopDesc add_circle(Arena *a, TrimTruth *t, Vec2 centre, double radius, bool is_region)
{
    t->centre[t->n_circles] = quad2(2 * (Quad)centre.x - 1, 2 * (Quad)centre.y - 1);
    t->radius[t->n_circles++] = (is_region ? 2 : -2) * (Quad)radius;
    return circle(a, centre, radius, is_region);
}

/* A region with a hole that touches it from within, or two regions that touch, but for the gap. */
static Model build_touching(Arena *a, double gap, TestRandom *r)
{
    TrimTruth t = { .reach = 1 };
    double r0 = test_range(r, .2, .3), r1 = r0 * test_range(r, .3, .8), angle = test_range(r, 0, 6.3);
    Vec2 way = vec2(cos(angle), sin(angle)), c0 = vec2(.5, .5);
    TrimLoopDesc *loops = ARENA_ARRAY(a, TrimLoopDesc, 2);
    t.is_union = test_int(r, 0, 1);
    if (t.is_union) r0 *= .5, r1 *= .5;
    loops[0] = add_circle(a, &t, c0, r0, true);
    Vec2 c1 = vec2_add(c0, vec2_scale(way, t.is_union ? r0 + r1 + gap : r0 - r1 - gap));
    loops[1] = add_circle(a, &t, c1, r1, t.is_union);
    t.feature = quad2(t.centre[0].x + t.radius[0] * way.x, t.centre[0].y + t.radius[0] * way.y);
    return trimmed(a, &t, loops, 2, r);
}

/* A needle, as a hole or as all that is left. */
static Model build_sliver(Arena *a, double width, TestRandom *r)
{
    double angle = test_range(r, 0, 6.3), length = test_range(r, .2, .4), c = cos(angle), s = sin(angle);
    Vec2 *p = ARENA_ARRAY(a, Vec2, 4), *q = ARENA_ARRAY(a, Vec2, 4);
    Vec2 at = vec2(test_range(r, .45, .55), test_range(r, .45, .55));
    p[0] = vec2(at.x + length * c, at.y + length * s), p[1] = vec2(at.x - width / 2 * s, at.y + width / 2 * c);
    p[2] = vec2(at.x - length * c, at.y - length * s), p[3] = vec2(at.x + width / 2 * s, at.y - width / 2 * c);
    bool is_hole = test_int(r, 0, 1);
    for (int i = 0; i < 4; i++) q[i] = p[is_hole ? i : 3 - i];
    TrimLoopDesc *loop = ARENA_NEW(a, TrimLoopDesc);
    *loop = loop_of(a, q, 4);
    TrimTruth t = { .polygon = p, .n = 4, .about = at, .is_hole = is_hole, .reach = width * 4 };
    t.feature = quad2(2 * (Quad)at.x - 1, 2 * (Quad)at.y - 1);
    return trimmed(a, &t, loop, 1, r);
}

/* A polygon of so many sides. */
static Model build_pieces(Arena *a, double pieces, TestRandom *r)
{
    int n = (int)pieces;
    Vec2 *p = ARENA_ARRAY(a, Vec2, n), *q = ARENA_ARRAY(a, Vec2, n), at = vec2(.5, .5);
    double wave = test_range(r, 0, .3), turns = test_int(r, 2, 9);
    for (int i = 0; i < n; i++) {
        double angle = 6.283185307179586 * i / n, radius = .3 * (1 + wave * cos(turns * angle));
        p[i] = vec2(at.x + radius * cos(angle), at.y + radius * sin(angle));
    }
    for (int i = 0; i < n; i++) q[i] = p[n - 1 - i];
    TrimLoopDesc *loop = ARENA_NEW(a, TrimLoopDesc);
    *loop = loop_of(a, q, n);
    TrimTruth t = { .polygon = p, .n = n, .about = at, .reach = 1 };
    int i = test_int(r, 0, n - 1);
    t.feature = quad2(2 * (Quad)p[i].x - 1, 2 * (Quad)p[i].y - 1);
    return trimmed(a, &t, loop, 1, r);
}

/* A third anywhere; the others ever nearer to the feature. */
static Ray ray_at_trim(const Model *m, double knob, TestRandom *r)
{
    (void)knob;
    const TrimTruth *t = m->own;
    if (test_int(r, 0, 2) == 0) return ray_anywhere(m, 0, r);
    double by = t->reach * pow(10, test_range(r, -6, 0));
    Quad x = t->feature.x + by * test_range(r, -1, 1), y = t->feature.y + by * test_range(r, -1, 1);
    Quad3 target = quad_map_point(&m->at.to_world, quad3(x, y, m->at.form.par[0] * x * y));
    return ray_towards(m, target, random_direction(r), pow(10, test_range(r, -1, 1)), r);
}

/* One circle, and rays at its edge. */
static Model build_circle(Arena *a, double by, TestRandom *r)
{
    TrimTruth t = { .reach = by };
    TrimLoopDesc *loop = ARENA_NEW(a, TrimLoopDesc);
    *loop = add_circle(a, &t, vec2(test_range(r, .4, .6), test_range(r, .4, .6)), test_range(r, .1, .4), test_int(r, 0, 1));
    return trimmed(a, &t, loop, 1, r);
}

static Ray ray_at_edge(const Model *m, double by, TestRandom *r)
{
    const TrimTruth *t = m->own;
    double angle = test_int(r, 0, 3) ? test_range(r, 0, 6.3) : test_int(r, 0, 7) * atan(1);
    Quad radius = quad_abs(t->radius[0]) + by * test_range(r, -1, 1);
    Quad x = t->centre[0].x + radius * cos(angle), y = t->centre[0].y + radius * sin(angle);
    Quad3 target = quad_map_point(&m->at.to_world, quad3(x, y, m->at.form.par[0] * x * y));
    return ray_towards(m, target, random_direction(r), pow(10, test_range(r, -1, 1)), r);
}

const Family stress_trims[] = {
    { "trim edge", "distance", 7, { 1e-1, 1e-4, 1e-7, 1e-9, 1e-11, 1e-12, 1e-13 }, build_circle, ray_at_edge, 1 },
    { "trims touching", "gap", 7, { 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 0 }, build_touching, ray_at_trim, 1 },
    { "trim sliver", "width", 6, { 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12 }, build_sliver, ray_at_trim, 1 },
    { "trim pieces", "pieces", 5, { 3, 30, 1e3, 3e4, 1e6 }, build_pieces, ray_at_trim, .5 },
};
const int n_stress_trims = COUNT(stress_trims);
