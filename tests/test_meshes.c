/* The meshes of the gallery's scenes, at the chord error that export takes by itself: on their surfaces, within that error
 * of them and of their trims, closed but at trims and borders.
 *   test_meshes SCENES_FOLDER */
#include "parser/parser.h"
#include "nurbs/trim_flat.h"
#include "nurbs/trim_test.h"
#include "render/export_list.h"
#include "render/export_pov.h"
#include "tests/mesh_checks.h"

static const char *folder;

static Scene *read_scene(Arena *a, const char *name)
{
    Diag *diag = diag_new(a);
    Scene *scene = scene_new(a);
    ParseSummary summary;
    ParseOptions options = { .library_paths = &folder, .n_library_paths = 1, .image_width = 64, .image_height = 64,
                             .quality = 9 };
    bool is_read = parse_scene(arena_printf(a, "%s/%s.pov", folder, name), &options, a, diag, scene, &summary);
    if (!is_read) diag_print(diag, stderr);
    CHECK(is_read, "%s", name);
    return scene;
}

/* A trim in space: the images of points close together; is_inner: not on the domain's border, where it may be that nothing
 * is open (a seam). */
typedef struct { Vec3 p; bool is_inner, is_last; } TrimPoint;
typedef struct { TrimPoint *points; size_t n, capacity; } TrimPoints3;

static void add_point(Arena *a, const Surface *s, Vec2 uv, bool is_last, TrimPoints3 *out)
{
    static const double BORDER = 1e-5;
    bool is_inner = uv.x > BORDER && uv.x < 1 - BORDER && uv.y > BORDER && uv.y < 1 - BORDER;
    ARENA_PUSH(a, out->points, out->n, out->capacity) = (TrimPoint){ reference(s, uv), is_inner, is_last };
}

static void add_trims(Arena *a, const Surface *s, const TrimList *l, TrimPoints3 *out)
{
    static const double STEP = 1. / 500;   /* of the domain: straight pieces have bent images */
    for (int i = 0; i < l->n; i++) {
        TrimChain flat = trim_chain_flatten(a, &l->trims[i]->chain, TRIM_CHORD);
        for (int k = 0; k < flat.path.n; k++) {
            Vec2 p = flat.path.p[k], along = vec2_sub(flat.path.p[k + 1], p);
            int n = (int)ceil(vec2_length(along) / STEP);
            for (int m = 0; m < n; m++) add_point(a, s, vec2_add(p, vec2_scale(along, (double)m / n)), false, out);
        }
        add_point(a, s, flat.path.p[0], true, out);
        add_trims(a, s, &l->trims[i]->inner, out);
    }
}

static double distance_to_trims(const TrimPoints3 *t, Vec3 p)
{
    double best = INFINITY;
    for (size_t i = 0; i + 1 < t->n; i++) {
        Vec3 a = t->points[i].p, b = t->points[i + 1].p;
        if (!t->points[i].is_last && compare_points(a, b) != 0) best = fmin(best, distance_to_edge(p, a, b));
    }
    return best;
}

/* Edges that are open, but at the domain's border, lie along trims; and trims along open edges. */
static void check_trims(Arena *a, const Surface *s, const MeshSink *m, double e, uint64_t number)
{
    size_t n, n_open = 0;
    MeshEdge *edge = edges_of(a, m, &n);
    TrimPoints3 trims = { 0 };
    if (s->trims) add_trims(a, s, &s->trims->top, &trims);
    for (size_t i = 0; i < n; i++) {
        CHECK(edge[i].uses % 2 == 1 || edge[i].balance == 0, "surface %lu", (unsigned long)number);
        if (edge[i].uses % 2 == 1) edge[n_open++] = edge[i];
    }
    for (size_t i = 0; i < n_open; i += 1 + n_open / 200)
        if (!is_on_border(s, &edge[i]))
            CHECK_WITHIN(distance_to_trims(&trims, vec_scale(vec_add(edge[i].p, edge[i].q), .5)), e, "surface %lu",
                         (unsigned long)number);
    for (size_t i = 0; i < trims.n; i += 1 + trims.n / 300) {
        double best = INFINITY;
        for (size_t k = 0; trims.points[i].is_inner && k < n_open; k++)
            best = fmin(best, distance_to_edge(trims.points[i].p, edge[k].p, edge[k].q));
        if (trims.points[i].is_inner) CHECK_WITHIN(best, e, "surface %lu, trims", (unsigned long)number);
    }
}

static void check_shape(const ExportShape *shape, double chord_error, uint64_t number)
{
    Arena *a = arena_new();
    MeshSink m = mesh_sink(a);
    TestRandom r = test_random(number);
    const Surface *s = surface_of_shape(shape->shape);
    double e = chord_error / shape->stretch;
    assert_true(shape->shape->type->tessellate(shape->shape, e, &m));
    check_vertices(s, &m, number);
    check_distance(s, &m, e, &r, number);
    check_trims(a, s, &m, e, number);
    arena_free(a);
}

static void check_scene(const char *name)
{
    Arena *a = arena_new();
    ExportList list = export_list(a, read_scene(a, name), export_pov_is_mesh);
    double e = export_default_error(&list);
    size_t n = 0;
    for (size_t i = 0; i < list.n; i++)
        if (surface_of_shape(list.shapes[i].shape)) check_shape(&list.shapes[i], e, n++);
    CHECK(n > 0, "%s", name);
    arena_free(a);
}

#define SCENE(name) static void name(void **state) { (void)state; check_scene(#name); }
SCENE(teapot)
SCENE(teapot_solid)
SCENE(spoon)
SCENE(pencil)
SCENE(goblet)
SCENE(crank1a)
SCENE(crank)
SCENE(allblade)
SCENE(mechanical)
SCENE(still_life)

int main(int argc, char *argv[])
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(teapot), cmocka_unit_test(teapot_solid), cmocka_unit_test(spoon), cmocka_unit_test(pencil),
        cmocka_unit_test(goblet), cmocka_unit_test(crank1a), cmocka_unit_test(crank), cmocka_unit_test(allblade),
        cmocka_unit_test(mechanical), cmocka_unit_test(still_life),
    };
    if (argc != 2) return 2;
    folder = argv[1];
    return cmocka_run_group_tests(tests, NULL, NULL);
}
