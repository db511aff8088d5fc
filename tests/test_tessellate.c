/* Meshes of surfaces. Truths: reference evaluation for points, trims with a closed form, counting edges, areas that must add
 * up. */
#include "tests/test.h"

#include "nurbs/tessellate.h"
#include "nurbs/triangulate.h"
#include "tests/mesh_checks.h"
#include "tests/models.h"
#include "tests/trims.h"

/* ---- the triangulation of a cell ---- */

static GridPoint random_grid_point(TestRandom *r, int64_t size)
{
    int x = test_int(r, 0, (int)size), y = test_int(r, 0, (int)size);
    return (GridPoint){ x, y };
}

static void check_triangulation(const Triangulation *t, int64_t size, uint64_t seed)
{
    int64_t sum = 0;
    for (size_t f = 0; f < t->n_triangles; f++) {
        const GridTriangle *g = &t->triangles[f];
        int64_t area = grid_area(t->points[g->v[0]], t->points[g->v[1]], t->points[g->v[2]]);
        CHECK(area > 0, "seed %lu, triangle %zu", (unsigned long)seed, f);
        sum += area;
        for (int i = 0; i < 3; i++) {
            if (g->beside[i] < 0) continue;
            const GridTriangle *h = &t->triangles[g->beside[i]];
            int j = h->beside[0] == (int)f ? 0 : h->beside[1] == (int)f ? 1 : 2;
            CHECK(h->beside[j] == (int)f && h->is_wall[j] == g->is_wall[i], "seed %lu", (unsigned long)seed);
            CHECK(h->v[(j + 1) % 3] == g->v[(i + 2) % 3] && h->v[(j + 2) % 3] == g->v[(i + 1) % 3], "seed %lu",
                  (unsigned long)seed);
        }
    }
    CHECK(sum == 2 * size * size, "seed %lu", (unsigned long)seed);
}

/* Random segments, touching, overlapping and crossing (on a coarse grid nearly always): it stays a triangulation. */
static void segments_of_every_kind_leave_a_triangulation(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (uint64_t seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        int64_t size = (int64_t)1 << test_int(&r, 2, GRID_BITS);
        Triangulation t = triangulation_of(a, (GridPoint){ 0, 0 }, (GridPoint){ size, size });
        for (int i = test_int(&r, 1, 25); i > 0; i--) {
            int p = triangulation_add(&t, random_grid_point(&r, size));
            triangulation_join(&t, p, triangulation_add(&t, random_grid_point(&r, size)));
        }
        check_triangulation(&t, size, seed);
    }
    arena_free(a);
}

/* A closed polygon in order of the angle round a middle: all of its area, and no other, is parted from the corners'. */
static void a_polygon_parts_its_inside(void **state)
{
    (void)state;
    Arena *a = arena_new();
    const int64_t size = 1 << 20;
    for (uint64_t seed = 0; seed < 100; seed++) {
        TestRandom r = test_random(seed);
        int n = test_int(&r, 3, 40), v[40];
        Triangulation t = triangulation_of(a, (GridPoint){ 0, 0 }, (GridPoint){ size, size });
        int64_t area = 0, inside = 0;
        GridPoint p[40];
        for (int i = 0; i < n; i++) {
            double angle = 2 * M_PI * i / n, radius = test_range(&r, .1, .45) * size;
            p[i] = (GridPoint){ (int64_t)(size / 2. + radius * cos(angle)), (int64_t)(size / 2. + radius * sin(angle)) };
            v[i] = triangulation_add(&t, p[i]);
        }
        for (int i = 0; i < n; i++) {
            triangulation_join(&t, v[i], v[(i + 1) % n]);
            area += p[i].x * p[(i + 1) % n].y - p[i].y * p[(i + 1) % n].x;
        }
        CHECK(triangulation_parts(&t) == 2, "seed %lu", (unsigned long)seed);
        int outside = 0;
        for (size_t f = 0; f < t.n_triangles; f++)
            for (int i = 0; i < 3; i++) if (t.triangles[f].v[i] == 0) outside = t.triangles[f].part;
        for (size_t f = 0; f < t.n_triangles; f++) {
            const int *c = t.triangles[f].v;
            if (t.triangles[f].part != outside) inside += grid_area(t.points[c[0]], t.points[c[1]], t.points[c[2]]);
        }
        CHECK(inside == area, "seed %lu", (unsigned long)seed);
    }
    arena_free(a);
}

/* ---- trims with a closed form ---- */

typedef struct { int n; Vec2 corner[8]; Vec2 centre; double radius; } Loop;   /* n = 0: a circle; in the unit square */

static Vec2 loop_point(const Loop *l, double t)
{
    if (l->n == 0) return vec2(l->centre.x + l->radius * cos(2 * M_PI * t), l->centre.y + l->radius * sin(2 * M_PI * t));
    int i = (int)fmin(floor(t * l->n), l->n - 1);
    double share = t * l->n - i;
    return vec2_add(vec2_scale(l->corner[i], 1 - share), vec2_scale(l->corner[(i + 1) % l->n], share));
}

typedef struct { Model model; Loop loops[8]; int n_loops; } Part;

/* A circle in the unit square, as it must be written in the domain: points scale with it. */
static TrimLoopDesc loop_desc(Arena *a, const SurfaceDesc *d, const Loop *l, bool is_clockwise)
{
    double u0 = d->knots_u[d->order_u - 1], u1 = d->knots_u[d->n_u];
    double v0 = d->knots_v[d->order_v - 1], v1 = d->knots_v[d->n_v];
    TrimLoopDesc out = l->n == 0 ? circle(a, l->centre, l->radius, is_clockwise) : loop_of(a, l->corner, l->n);
    Vec3 *p = (Vec3 *)(uintptr_t)out.curves->points;
    for (int i = 0; i < out.curves->n; i++) p[i].x = u0 + p[i].x * (u1 - u0), p[i].y = v0 + p[i].y * (v1 - v0);
    return out;
}

static Surface *part_surface(Arena *a, const Part *p)
{
    TrimLoopDesc loops[8];
    NurbsError error;
    SurfaceDesc d = model_desc(&p->model);
    for (int i = 0; i < p->n_loops; i++) loops[i] = loop_desc(a, &d, &p->loops[i], false);
    d.trims = loops, d.n_trims = p->n_loops;
    Surface *s = surface_new(a, &d, &error, NULL, 0, NULL);
    CHECK(s != NULL, "error %d", error.code);
    return s;
}

/* ---- edges ---- */

enum { TRIM_SAMPLES = 840 };   /* corners of up to 8 are among them */

/* The images of a loop's points at multiples of 1 / TRIM_SAMPLES. */
static Vec3 *loop_image(Arena *a, const Surface *s, const Loop *l)
{
    Vec3 *image = ARENA_ARRAY(a, Vec3, TRIM_SAMPLES + 1);
    for (int i = 0; i <= TRIM_SAMPLES; i++)
        image[i] = reference(s, loop_point(l, (double)(i % TRIM_SAMPLES) / TRIM_SAMPLES));
    return image;
}

static double distance_to_chord(Vec3 p, Vec3 a, Vec3 b)
{
    return compare_points(a, b) != 0 ? distance_to_edge(p, a, b) : INFINITY;
}

/* From a point to a loop's image by chords between its samples, and near the nearest of these by finer ones. */
static double distance_to_loop(const Loop *l, const Surface *s, const Vec3 *image, Vec3 p)
{
    enum { FINE = 32 };
    double best = INFINITY;
    int nearest = 0;
    for (int i = 0; i < TRIM_SAMPLES; i++) {
        double d = distance_to_chord(p, image[i], image[i + 1]);
        if (d < best) best = d, nearest = i;
    }
    for (int i = 0; i < 3 * FINE; i++) {
        double from = (nearest - 1 + (double)i / FINE) / TRIM_SAMPLES, to = from + 1. / FINE / TRIM_SAMPLES;
        best = fmin(best, distance_to_chord(p, reference(s, loop_point(l, from - floor(from))),
                                            reference(s, loop_point(l, to - floor(to)))));
    }
    return best;
}

static double distance_to_loops(const Part *part, const Surface *s, Vec3 *const images[], Vec3 p)
{
    double best = INFINITY;
    for (int k = 0; k < part->n_loops; k++) best = fmin(best, distance_to_loop(&part->loops[k], s, images[k], p));
    return best;
}

/* Every edge is between two triangles that agree in their sense, but at trims and the domain's border; trims and open edges
 * are within e of each other. */
static void check_edges(Arena *a, const Part *part, const Surface *s, const MeshSink *m, double e, uint64_t seed)
{
    size_t n, n_open = 0;
    double slack = 1e-3 * e;   /* of the truth: chords between its samples */
    MeshEdge *edge = edges_of(a, m, &n), *open = ARENA_ARRAY(a, MeshEdge, n);
    Vec3 *images[8];
    for (int k = 0; k < part->n_loops; k++) images[k] = loop_image(a, s, &part->loops[k]);
    for (size_t i = 0; i < n; i++) {
        CHECK(edge[i].uses <= 2, "seed %lu, edge %zu of %d", (unsigned long)seed, i, edge[i].uses);
        CHECK(edge[i].balance == (edge[i].uses == 1 ? edge[i].balance : 0), "seed %lu, edge %zu", (unsigned long)seed, i);
        if (edge[i].uses == 1 && !is_on_border(s, &edge[i])) open[n_open++] = edge[i];
    }
    for (size_t i = 0; i < n_open; i += 1 + n_open / 100) {
        Vec3 middle = vec_scale(vec_add(open[i].p, open[i].q), .5);
        double at_middle = distance_to_loops(part, s, images, middle);
        double at_end = distance_to_loops(part, s, images, open[i].p);
        CHECK_WITHIN(fmax(at_middle, at_end), e + slack, "seed %lu, open edge %zu", (unsigned long)seed, i);
    }
    for (int k = 0; k < part->n_loops; k++)
        for (int i = 0; i < 60; i++) {
            Vec3 p = reference(s, loop_point(&part->loops[k], (i + .37) / 60));
            double best = INFINITY;
            for (size_t j = 0; j < n_open; j++) best = fmin(best, distance_to_edge(p, open[j].p, open[j].q));
            CHECK_WITHIN(best, e, "seed %lu, loop %d at %d", (unsigned long)seed, k, i);
        }
}

static double uv_area(const MeshSink *m)
{
    double sum = 0;
    for (size_t f = 0; f < m->n_triangles; f++) {
        const uint32_t *v = m->triangles[f].v;
        Vec2 p = m->vertices[v[0]].uv, q = m->vertices[v[1]].uv, r = m->vertices[v[2]].uv;
        sum += vec2_cross(vec2_sub(q, p), vec2_sub(r, p)) / 2;
    }
    return sum;
}

static MeshSink check_part(Arena *a, const Part *part, double relative, uint64_t seed)
{
    TestRandom r = test_random(seed + 1000);
    MeshSink m = mesh_sink(a);
    Surface *s = part_surface(a, part);
    double e = relative * s->size;
    tessellate_surface(s, e, &m);
    check_vertices(s, &m, seed);
    check_distance(s, &m, e, &r, seed);
    check_edges(a, part, s, &m, e, seed);
    return m;
}

/* ---- surfaces ---- */

static void random_part(TestRandom *r, Part *p, double weights)
{
    Model *m = &p->model;
    m->k_u = test_int(r, 2, 6), m->k_v = test_int(r, 2, 6);
    m->n_u = model_random_knots(r, m->k_u, test_int(r, 1, 4), m->k_u - 1, m->knots_u);
    m->n_v = model_random_knots(r, m->k_v, test_int(r, 1, 4), m->k_v - 1, m->knots_v);
    model_random_points(r, m, weights);
    p->n_loops = 0;
}

/* Untrimmed: the triangles are the whole domain. */
static void random_surfaces_are_kept_within_the_error(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        Part *p = ARENA_NEW(a, Part);
        random_part(&r, p, seed % 2 ? 20 : 1);
        MeshSink m = check_part(a, p, pow(10, test_range(&r, -3, -1)), seed);
        CHECK_WITHIN(fabs(uv_area(&m) - 1), 1e-9, "seed %lu", (unsigned long)seed);
        arena_free(a);
    }
}

/* Holes that do not touch: one in each quarter of the domain, circles and quadrangles. */
static void add_holes(TestRandom *r, Part *p)
{
    for (int i = 0; i < 4; i++) {
        if (test_int(r, 0, 3) == 0) continue;
        Loop *l = &p->loops[p->n_loops++];
        *l = (Loop){ .n = test_int(r, 0, 1) ? 0 : test_int(r, 3, 8), .radius = test_range(r, .02, .24) };
        l->centre = vec2(.25 + .5 * (i % 2), .25 + .5 * (i / 2));
        for (int k = 0; k < l->n; k++) {
            double angle = 2 * M_PI * k / l->n, radius = l->radius * test_range(r, .3, 1);
            l->corner[k] = vec2_add(l->centre, vec2(radius * cos(angle), radius * sin(angle)));
        }
    }
}

static double loop_area(const Loop *l)
{
    double sum = 0;
    if (l->n == 0) return M_PI * l->radius * l->radius;
    for (int k = 0; k < l->n; k++) sum += vec2_cross(l->corner[k], l->corner[(k + 1) % l->n]) / 2;
    return sum;
}

static void random_trims_are_kept_within_the_error(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 60; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        Part *p = ARENA_NEW(a, Part);
        random_part(&r, p, seed % 2 ? 20 : 1);
        add_holes(&r, p);
        double relative = pow(10, test_range(&r, -3, -1.5)), holes = 0;
        MeshSink m = check_part(a, p, relative, seed);
        for (int i = 0; i < p->n_loops; i++) holes += loop_area(&p->loops[i]);
        CHECK_WITHIN(fabs(uv_area(&m) - (1 - holes)), .2, "seed %lu", (unsigned long)seed);   /* e is of space, not of uv */
        arena_free(a);
    }
}

static const double line_knots[4] = { 0, 0, 1, 1 };

/* A square in the plane, bilinear. */
static void plane_part(Part *p)
{
    Model *m = &p->model;
    *m = (Model){ .k_u = 2, .k_v = 2, .n_u = 2, .n_v = 2 };
    memcpy(m->knots_u, line_knots, sizeof line_knots), memcpy(m->knots_v, line_knots, sizeof line_knots);
    for (int i = 0; i < 4; i++) m->points[i] = vec4(i % 2, i / 2, 0, 1);
    p->n_loops = 0;
}

/* In the plane the area cut away is that of the holes, but for at most their lengths times the error. */
static void holes_in_a_plane_have_their_area(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 30; seed++) {
        Arena *a = arena_new();
        TestRandom r = test_random(seed);
        Part *p = ARENA_NEW(a, Part);
        plane_part(p);
        add_holes(&r, p);
        double holes = 0;
        for (int i = 0; i < p->n_loops; i++) holes += loop_area(&p->loops[i]);
        MeshSink m = check_part(a, p, 1e-4, seed);
        CHECK_WITHIN(fabs(uv_area(&m) - (1 - holes)), 8 * 1.5 * 1.5 * 1e-4, "seed %lu", (unsigned long)seed);
        arena_free(a);
    }
}

/* Nine by nine points: a circle turned about an axis. offset 0: a half circle, the poles on the axis: a sphere. */
static void turned_part(Part *p, double offset)
{
    Model *m = &p->model;
    bool is_sphere = offset == 0;
    *m = (Model){ .k_u = 3, .k_v = 3, .n_u = 9, .n_v = is_sphere ? 5 : 9 };
    memcpy(m->knots_u, model_circle_knots, sizeof model_circle_knots);
    memcpy(m->knots_v, model_circle_knots, sizeof model_circle_knots);
    for (int i = 0; is_sphere && i < 3; i++) m->knots_v[5 + i] = 2;
    for (int j = 0; j < m->n_v; j++)
        for (int i = 0; i < 9; i++) {
            Vec3 c = model_circle(i), d = model_circle(is_sphere ? j + 6 : j);
            double radius = fmax(offset + d.x, 0);
            m->points[j * 9 + i] = vec4(radius * c.x, radius * c.y, d.y, c.z * d.z);
        }
    p->n_loops = 0;
}

static size_t open_edges(Arena *a, const MeshSink *m)
{
    size_t n, n_open = 0;
    MeshEdge *e = edges_of(a, m, &n);
    for (size_t i = 0; i < n; i++) n_open += e[i].uses == 1;
    return n_open;
}

static void spheres_and_tori_are_closed(void **state)
{
    (void)state;
    Arena *a = arena_new();
    for (int is_torus = 0; is_torus < 2; is_torus++) {
        Part *p = ARENA_NEW(a, Part);
        turned_part(p, is_torus ? 3 : 0);
        MeshSink m = check_part(a, p, 1e-3, (uint64_t)is_torus);
        CHECK(m.n_triangles > 100, "%zu", m.n_triangles);
        assert_int_equal(open_edges(a, &m), 0);
        for (size_t i = 0; i < m.n_vertices; i++) {
            Vec3 q = m.vertices[i].point;
            double rho = hypot(q.x, q.y) - (is_torus ? 3 : 0);
            CHECK_WITHIN(fabs(hypot(rho, q.z) - 1), 1e-14, "vertex %zu", i);
            Vec3 out = vec(q.x / hypot(q.x, q.y) * rho, q.y / hypot(q.x, q.y) * rho, q.z);
            if (hypot(q.x, q.y) > 1e-6)   /* at the poles x and y are noise */
                CHECK_WITHIN(vec_length(vec_cross(out, m.vertices[i].normal)), 1e-9, "vertex %zu", i);
        }
    }
    arena_free(a);
}

/* A trim across the seam and round the poles of a sphere. */
static void trims_may_use_seams_and_poles(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Part *p = ARENA_NEW(a, Part);
    turned_part(p, 0);
    p->loops[0] = (Loop){ .n = 4, .corner = { { 0, .3 }, { .4, .35 }, { .4, .6 }, { 0, .7 } } };   /* along the seam */
    p->loops[1] = (Loop){ .n = 4, .corner = { { .6, .5 }, { 1, .55 }, { 1, 1 }, { .6, 1 } } };     /* along the pole */
    p->n_loops = 2;
    Surface *s = part_surface(a, p);
    MeshSink m = mesh_sink(a);
    tessellate_surface(s, 1e-3 * s->size, &m);
    check_vertices(s, &m, 0);
    double cut = loop_area(&p->loops[0]) + loop_area(&p->loops[1]);
    CHECK_WITHIN(fabs(uv_area(&m) - (1 - cut)), .01, "area");
    arena_free(a);
}

/* Two planes that meet along a knot of multiplicity order - 1: each side has its own normals. */
static void creases_stay_sharp(void **state)
{
    (void)state;
    static const double knots[5] = { 0, 0, .5, 1, 1 };
    Arena *a = arena_new();
    Part *p = ARENA_NEW(a, Part);
    p->model = (Model){ .k_u = 2, .k_v = 2, .n_u = 3, .n_v = 2 };
    memcpy(p->model.knots_u, knots, sizeof knots), memcpy(p->model.knots_v, line_knots, sizeof line_knots);
    for (int i = 0; i < 6; i++) p->model.points[i] = vec4(i % 3, i / 3, i % 3 == 1, 1);
    MeshSink m = check_part(a, p, 1e-3, 0);
    assert_int_equal(m.n_triangles, 4);
    assert_int_equal(m.n_vertices, 8);
    for (size_t i = 0; i < m.n_triangles; i++)
        for (int k = 0; k < 3; k++) {
            double x = m.vertices[m.triangles[i].v[0]].normal.x;
            assert_true(m.vertices[m.triangles[i].v[k]].normal.x == x && fabs(fabs(x) - sqrt(.5)) < 1e-15);
        }
    arena_free(a);
}

/* Within a smooth stretch no two vertices are at one point. */
static void smooth_faces_share_their_vertices(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Part *p = ARENA_NEW(a, Part);
    TestRandom r = test_random(5);
    Model *m = &p->model;
    m->k_u = m->k_v = 4;
    m->n_u = model_random_knots(&r, 4, 5, 2, m->knots_u), m->n_v = model_random_knots(&r, 4, 5, 2, m->knots_v);
    model_random_points(&r, m, 1);
    add_holes(&r, p);
    MeshSink mesh = check_part(a, p, 3e-3, 5);
    MeshEdge *points = ARENA_ARRAY(a, MeshEdge, mesh.n_vertices);
    for (size_t i = 0; i < mesh.n_vertices; i++) points[i] = (MeshEdge){ .p = mesh.vertices[i].point };
    qsort(points, mesh.n_vertices, sizeof *points, compare_edges);
    for (size_t i = 1; i < mesh.n_vertices; i++) assert_true(compare_edges(&points[i - 1], &points[i]) != 0);
    arena_free(a);
}

/* An error a quarter as large takes about four times the triangles: the bound is not wasteful. */
static void triangles_grow_with_one_over_the_error(void **state)
{
    (void)state;
    Arena *a = arena_new();
    Part *p = ARENA_NEW(a, Part);
    turned_part(p, 3);
    MeshSink coarse = check_part(a, p, 1e-3, 0), fine = check_part(a, p, 1e-3 / 16, 0);
    double ratio = (double)fine.n_triangles / (double)coarse.n_triangles;
    CHECK(ratio > 8 && ratio < 32, "%g", ratio);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_of_every_kind_leave_a_triangulation),
        cmocka_unit_test(a_polygon_parts_its_inside),
        cmocka_unit_test(random_surfaces_are_kept_within_the_error),
        cmocka_unit_test(random_trims_are_kept_within_the_error),
        cmocka_unit_test(holes_in_a_plane_have_their_area),
        cmocka_unit_test(spheres_and_tori_are_closed),
        cmocka_unit_test(trims_may_use_seams_and_poles),
        cmocka_unit_test(creases_stay_sharp),
        cmocka_unit_test(smooth_faces_share_their_vertices),
        cmocka_unit_test(triangles_grow_with_one_over_the_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
