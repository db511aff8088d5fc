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

/* The points of all trims, those on the domain's border left out: there it may be that nothing is open (a seam). */
typedef struct { Vec2 *p; size_t n, capacity; } Points;

static void add_points(Arena *a, const TrimList *l, Points *out)
{
    static const double BORDER = 1e-5;
    for (int i = 0; i < l->n; i++) {
        TrimChain flat = trim_chain_flatten(a, &l->trims[i]->chain, TRIM_CHORD);
        for (int k = 0; k < flat.path.n; k++) {
            Vec2 p = flat.path.p[k];
            bool is_inner = p.x > BORDER && p.x < 1 - BORDER && p.y > BORDER && p.y < 1 - BORDER;
            if (is_inner) ARENA_PUSH(a, out->p, out->n, out->capacity) = p;
        }
        add_points(a, &l->trims[i]->inner, out);
    }
}

/* In space, from an end of an open edge, which lies on a trim but for what thinning moved it. */
static double distance_to_trims(Arena *a, const Surface *s, const TrimList *l, Vec2 uv)
{
    double best = INFINITY;
    for (int i = 0; i < l->n; i++) {
        TrimChain flat = trim_chain_flatten(a, &l->trims[i]->chain, TRIM_CHORD);
        TrimNearest n = trim_chain_nearest(&flat, uv, INFINITY);
        if (n.piece >= 0) best = fmin(best, vec_length(vec_sub(reference(s, n.point), reference(s, uv))));
        best = fmin(best, distance_to_trims(a, s, &l->trims[i]->inner, uv));
    }
    return best;
}

static void check_trims(Arena *a, const Surface *s, const MeshSink *m, double e, uint64_t number)
{
    size_t n, n_open = 0;
    MeshEdge *edge = edges_of(a, m, &n);
    for (size_t i = 0; i < n; i++) {
        if (edge[i].uses % 2 == 0) {
            CHECK(edge[i].balance == 0, "surface %lu", (unsigned long)number);
            continue;
        }
        edge[n_open++] = edge[i];
        if (is_on_border(s, &edge[i])) continue;
        CHECK(s->trims != NULL, "surface %lu: an open edge without trims", (unsigned long)number);
        if (i % 5) continue;
        ArenaMark mark = arena_mark(a);
        CHECK_WITHIN(distance_to_trims(a, s, &s->trims->top, edge[i].uv), e, "surface %lu", (unsigned long)number);
        arena_reset(a, mark);
    }
    Points trims = { 0 };
    if (s->trims) add_points(a, &s->trims->top, &trims);
    for (size_t i = 0; i < trims.n; i += 1 + trims.n / 300) {
        double best = INFINITY;
        Vec3 p = reference(s, trims.p[i]);
        for (size_t k = 0; k < n_open; k++) best = fmin(best, distance_to_edge(p, edge[k].p, edge[k].q));
        CHECK_WITHIN(best, e, "surface %lu, trims", (unsigned long)number);
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
