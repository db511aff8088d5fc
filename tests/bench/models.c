/* The models, from their names. All but the teapot are made here; sphere and torus are those of the stress tests, whose
 * closed form is known. */
#include "tests/bench/bench.h"

#include <string.h>

static double *clamped_knots(Arena *a, int order, int n)
{
    double *knots = ARENA_ARRAY(a, double, n + order);
    for (int i = 0; i < n + order; i++) {
        int span = i - order + 1, last = n - order + 1;
        knots[i] = span < 0 ? 0 : span > last ? last : span;
    }
    return knots;
}

static SurfaceDesc surface_of(Arena *a, int order, int n, Vec4 *points)
{
    double *knots = clamped_knots(a, order, n);
    return (SurfaceDesc){ .order_u = order, .order_v = order, .n_u = n, .n_v = n, .knots_u = knots, .knots_v = knots,
                          .points = points };
}

SurfaceDesc bicubic_through(Arena *a, BicubicAt at, const void *context)
{
    static const double to_bezier[4][4] = { { 1, 0, 0, 0 }, { -5. / 6, 3, -1.5, 1. / 3 }, { 1. / 3, -1.5, 3, -5. / 6 },
                                            { 0, 0, 0, 1 } };
    Vec4 *p = ARENA_ARRAY(a, Vec4, 16);
    for (int k = 0; k < 16; k++) p[k] = vec4(0, 0, 0, 1);
    for (int k = 0; k < 16; k++) {
        Vec3 s = at(context, (k % 4) / 3., (k / 4) / 3.);
        for (int i = 0; i < 16; i++) {
            double w = to_bezier[i % 4][k % 4] * to_bezier[i / 4][k / 4];
            p[i].x += w * s.x, p[i].y += w * s.y, p[i].z += w * s.z;
        }
    }
    return surface_of(a, 4, 4, p);
}

/* A net over a square of the x-z plane about `at`, heights random, zero on the border. */
static Vec4 *bumpy_net(Arena *a, TestRandom *r, int n, Vec3 at, double side, double height)
{
    Vec4 *p = ARENA_ARRAY(a, Vec4, n * n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            bool is_border = i == 0 || j == 0 || i == n - 1 || j == n - 1;
            double y = is_border ? 0 : test_range(r, -height, height);
            p[j * n + i] = vec4(at.x + side * ((double)i / (n - 1) - 0.5), at.y + y,
                                at.z + side * ((double)j / (n - 1) - 0.5), 1);
        }
    return p;
}

/* ---- trims ---- */

static TrimCurveDesc circle_curve(Arena *a, Vec2 centre, double radius)
{
    static const double x[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, y[9] = { 0, -1, -1, -1, 0, 1, 1, 1, 0 };
    static const double knots[12] = { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 };
    Vec3 *p = ARENA_ARRAY(a, Vec3, 9);
    for (int i = 0; i < 9; i++)
        p[i] = vec(centre.x + radius * x[i], centre.y + radius * y[i], i % 2 ? M_SQRT1_2 : 1);
    return (TrimCurveDesc){ .order = 3, .n = 9, .knots = knots, .points = p };
}

static TrimCurveDesc polygon_curve(Arena *a, Vec2 centre, double radius, int n)
{
    Vec3 *p = ARENA_ARRAY(a, Vec3, n);
    for (int i = 0; i < n; i++) {
        double angle = -2 * M_PI * i / n;
        p[i] = vec(centre.x + radius * cos(angle), centre.y + radius * sin(angle), 1);
    }
    return (TrimCurveDesc){ .order = 2, .n = n, .points = p };
}

/* n_u by n_v holes of the same radius over the whole domain; pieces 0: circles. A loop round a hole runs clockwise or
 * not: the surface is outside all of them whichever way, so that `keep_left` is set to fit. */
static void punch(Arena *a, SurfaceDesc *s, int n_u, int n_v, double radius, int pieces)
{
    TrimLoopDesc *loops = ARENA_ARRAY(a, TrimLoopDesc, n_u * n_v);
    TrimCurveDesc *curves = ARENA_ARRAY(a, TrimCurveDesc, n_u * n_v);
    double size_u = s->knots_u[s->n_u], size_v = s->knots_v[s->n_v];
    for (int k = 0; k < n_u * n_v; k++) {
        Vec2 at = vec2((k % n_u + 0.5) / n_u * size_u, (k / n_u + 0.5) / n_v * size_v);
        curves[k] = pieces ? polygon_curve(a, at, radius, pieces) : circle_curve(a, at, radius);
        loops[k] = (TrimLoopDesc){ &curves[k], 1, pieces > 0 };
    }
    s->trims = loops, s->n_trims = n_u * n_v, s->keep_left = true;
}

/* ---- the models ---- */

static void take_net(Model *m, Arena *a, const Net *net, const Form *form)
{
    SurfaceDesc *s = ARENA_NEW(a, SurfaceDesc);
    *s = net_round(a, net);
    m->surfaces = s, m->n = 1;
    m->form = arena_copy(a, form, 1, sizeof *form);
}

static bool model_sphere(Arena *a, Model *m)
{
    Net net;
    Form form = form_sphere(a, &net);
    take_net(m, a, &net, &form);
    return true;
}

static bool model_torus(Arena *a, Model *m)
{
    Net net;
    Form form = form_torus(a, 0.35, &net);
    take_net(m, a, &net, &form);
    return true;
}

/* 13 x 13 points, so 10 x 10 spans; 4 x 3 holes. */
static bool model_sheet(Arena *a, Model *m)
{
    TestRandom r = test_random(13);
    SurfaceDesc *s = ARENA_NEW(a, SurfaceDesc);
    *s = surface_of(a, 4, 13, bumpy_net(a, &r, 13, vec(0, 0, 0), 10, 1));
    punch(a, s, 4, 3, 0.8, 0);
    m->surfaces = s, m->n = 1;
    return true;
}

static bool model_order8(Arena *a, Model *m)
{
    enum { N = 12 };
    TestRandom r = test_random(8);
    Vec4 *p = bumpy_net(a, &r, N, vec(0, 0, 0), 10, 2);
    for (int i = 0; i < N * N; i++) p[i].w = pow(10, test_range(&r, -2, 2));
    SurfaceDesc *s = ARENA_NEW(a, SurfaceDesc);
    *s = surface_of(a, 8, N, p);
    m->surfaces = s, m->n = 1;
    return true;
}

/* A bicubic patch each, no two alike, side by side on the same hills: the whole is as large, and is hit by as many rays,
 * however many they are. */
static Vec4 *hilly_net(Arena *a, TestRandom *r, Vec3 at, double side)
{
    Vec4 *p = bumpy_net(a, r, 4, at, side, 0.3 * side);
    for (int i = 0; i < 16; i++) p[i].y += sin(0.9 * p[i].x) * cos(0.7 * p[i].z) + test_range(r, 0, 0.05 * side);
    return p;
}

static bool model_field(Arena *a, Model *m, long n)
{
    long rows = lround(sqrt((double)n));
    if (rows < 1 || rows * rows != n) return false;
    TestRandom r = test_random(16);
    SurfaceDesc *s = ARENA_ARRAY(a, SurfaceDesc, n);
    double side = 10. / (double)rows;
    for (long k = 0; k < n; k++) {
        Vec3 at = vec(((double)(k % rows) + 0.5) * side, 0, ((double)(k / rows) + 0.5) * side);
        s[k] = surface_of(a, 4, 4, hilly_net(a, &r, at, side));
    }
    m->surfaces = s, m->n = (int)n;
    return true;
}

/* A third is cut away, by the same four holes of however many pieces: as many rays hit. */
static bool model_trims(Arena *a, Model *m, long n_pieces)
{
    enum { ROWS = 2 };
    long pieces = (n_pieces + ROWS * ROWS - 1) / (ROWS * ROWS);
    if (pieces < 3) return false;
    TestRandom r = test_random(10);
    SurfaceDesc *s = ARENA_NEW(a, SurfaceDesc);
    *s = surface_of(a, 4, 7, bumpy_net(a, &r, 7, vec(0, 0, 0), 10, 1));
    punch(a, s, ROWS, ROWS, sqrt(1 / (3 * M_PI)) * 4 / ROWS, (int)pieces);
    m->surfaces = s, m->n = 1;
    return true;
}

static bool make_surfaces(Arena *a, const char *name, Model *m)
{
    if (!strcmp(name, "sphere")) return model_sphere(a, m);
    if (!strcmp(name, "torus")) return model_torus(a, m);
    if (!strcmp(name, "teapot")) return model_teapot(a, m);
    if (!strcmp(name, "sheet")) return model_sheet(a, m);
    if (!strcmp(name, "order8")) return model_order8(a, m);
    if (!strncmp(name, "field-", 6)) return model_field(a, m, atol(name + 6));
    if (!strncmp(name, "trims-", 6)) return model_trims(a, m, atol(name + 6));
    return false;
}

bool model_make(Arena *a, const char *name, Model *out)
{
    *out = (Model){ .name = name, .arena = a };
    if (!make_surfaces(a, name, out)) {
        fprintf(stderr, "bench: no model %s\n", name);
        return false;
    }
    Box box = box_empty();
    for (int i = 0; i < out->n; i++) {
        const SurfaceDesc *s = &out->surfaces[i];
        for (int k = 0; k < s->n_u * s->n_v; k++)
            box = box_add_point(box, vec(s->points[k].x, s->points[k].y, s->points[k].z));
    }
    out->box = box, out->centre = box_centre(box), out->diagonal = box_diagonal(box);
    out->light = vec_add(out->centre, vec_scale(vec(-1.0, 0.4, -0.6), out->diagonal));
    return true;
}
