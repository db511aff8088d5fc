/* The scenes of the gallery, asked by bunches: each ray of one finds what it finds alone, in the same object, as far off as
 * the errors of both allow. Camera rays, rays that are no neighbours, and shadow rays from what they hit. */
#include "render/bunch.h"
#include "render/pencil.h"
#include "tests/scene_text.h"

static const char *const scenes[] = {
    "goblet", "teapot", "teapot_solid", "spoon", "pencil", "crank1a", "crank", "allblade", "still_life", "mechanical"
};
enum { N_SCENES = sizeof scenes / sizeof *scenes, SIZE = 64 };

typedef struct {
    const Scene *scene;
    const char *name;
    Trace trace;
    Pencils *pencils;
    PencilMemory memory;
    size_t n_hits, n_blocked, n_borders;
} Check;

static Read read_gallery(const char *scene)
{
    static const char *const paths[] = { "../scenes" };
    char text[64];
    snprintf(text, sizeof text, "#include \"%s.pov\"", scene);
    Read r = read_bytes(text, strlen(text), (ParseOptions){
        .image_width = SIZE, .image_height = SIZE, .quality = 9, .nurbs = { .method = NURBS_METHOD_CERTAIN },
        .library_paths = paths, .n_library_paths = 1 });
    CHECK(r.is_ok, "%s\n%s", text, r.messages);
    return r;
}

/* Where two patches or two solids meet in the same place either is right. */
static void check_hit(Check *k, const Ray *r, const Hit *a, const Hit *b)
{
    double apart = fabs(a->t - b->t), allowed = 4 * (a->t_error + b->t_error + 0x1p-50 * (fabs(a->t) + 1));
    CHECK(apart <= allowed, "%s: alone %.17g, in a bunch %.17g, along %.17g %.17g %.17g", k->name, a->t, b->t, r->dir.x,
          r->dir.y, r->dir.z);
    k->n_borders += a->shape != b->shape || a->n_objects != b->n_objects;
}

static void check_shadows(Check *k, const RayBunch *seen, const Hit hits[], Lanes hit)
{
    RayBunch rays;
    BunchLane lane[BUNCH_WIDTH];
    double t_max[BUNCH_WIDTH];
    for (size_t l = 0; l < k->scene->n_lights; l++) {
        Vec3 to = k->scene->lights[l].position;
        Apex apex = apex_make(to);
        rays.n = seen->n, rays.lane = lane;
        for (int i = 0; i < seen->n; i++) {
            Vec3 from = ray_at(&seen->ray[i], hit >> i & 1 ? hits[i].t * (1 - 1e-7) : 1);
            rays.ray[i] = (Ray){ from, vec_normalize(vec_sub(to, from)), 0 };
            t_max[i] = vec_length(vec_sub(to, from)) * (1 - 1e-12);
            lane[i] = seen->lane[i];
        }
        bunch_set_lanes(&rays);
        k->trace.apex = l % 2 ? &apex : NULL;
        Lanes filtered, blocked = scene_blocks_bunch(k->scene, &rays, hit, t_max, &filtered, &k->trace);
        for (Lanes left = hit; left; ) {
            int i = lanes_next(&left);
            bool may_be;
            bunch_begin(seen, i, &k->trace);
            bool alone = scene_blocks(k->scene, &rays.ray[i], t_max[i], &may_be, &k->trace);
            CHECK(alone == (blocked >> i & 1), "%s: a shadow ray, alone %d", k->name, alone);
            CHECK(alone || may_be == (filtered >> i & 1), "%s: a filtered ray, alone %d", k->name, may_be);
            k->n_blocked += alone;
        }
        k->trace.apex = NULL;
    }
}

static void check_rays(Check *k, RayBunch *b, Apex *apex)
{
    Hit together[BUNCH_WIDTH], alone;
    k->trace.apex = apex;
    Lanes hit = scene_hit_bunch(k->scene, b, bunch_all(b), RAY_CAMERA, together, &k->trace);
    for (int i = 0; i < b->n; i++) {
        k->trace.seed = b->lane[i].seed;
        bool is_hit = scene_hit(k->scene, &b->ray[i], RAY_CAMERA, &alone, &k->trace);
        CHECK(is_hit == (hit >> i & 1), "%s: a ray hits alone: %d", k->name, is_hit);
        if (is_hit) check_hit(k, &b->ray[i], &alone, &together[i]), k->n_hits++;
        else assert_true(isinf(together[i].t));
    }
    k->trace.apex = NULL;
    if (hit) check_shadows(k, b, together, hit);
}

/* spread: how far apart the eight are, in pixels. */
static void check_place(Check *k, int x, int y, double spread, uint64_t seed)
{
    RayBunch b;
    BunchLane lane[BUNCH_WIDTH];
    Vec2 at[BUNCH_WIDTH];
    TestRandom random = test_random(seed);
    Apex apex = apex_make(k->scene->camera.location);
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        at[i] = vec2(x + i % 4 * spread + test_range(&random, 0, .3), y + i / 4 * spread);
        lane[i] = (BunchLane){ .seed = seed * BUNCH_WIDTH + (uint64_t)i };
    }
    camera_rays(&k->scene->camera, at, seed % 5 ? BUNCH_WIDTH : (int)(1 + seed % 7), SIZE, SIZE, &b);
    b.lane = lane;
    check_rays(k, &b, seed % 3 && k->scene->camera.kind == CAMERA_PERSPECTIVE ? &apex : NULL);
}

static void check_scene(const char *name)
{
    Read r = read_gallery(name);
    scene_prepare(r.scene);
    Check k = { .scene = r.scene, .name = name, .trace = { .scratch = arena_new() } };
    k.pencils = pencils_new(camera_viewpoint(&r.scene->camera, SIZE * SIZE));
    k.memory.all = k.pencils;
    k.trace.pencils = &k.memory;
    for (int y = 0; y < SIZE; y += 2)
        for (int x = 0; x < SIZE; x += 4) check_place(&k, x, y, 1, (uint64_t)(y * SIZE + x + 1));
    for (uint64_t i = 0; i < 60; i++) check_place(&k, 0, 0, SIZE / 4.5, 100000 + i);
    CHECK(k.n_hits > 1500 && k.n_blocked > 50, "%s: %zu hits, %zu blocked", name, k.n_hits, k.n_blocked);
    CHECK(k.n_borders <= k.n_hits / 100, "%s: %zu of %zu hits differ", name, k.n_borders, k.n_hits);
    pencils_free(k.pencils);
    arena_free(k.trace.scratch);
    read_done(&r);
}

static void rays_find_together_what_they_find_alone(void **state)
{
    (void)state;
    for (int i = 0; i < N_SCENES; i++) check_scene(scenes[i]);
}

int main(void)
{
    const char *folder = getenv("TRIMRAY_TESTS_DIR");
    if (!folder || chdir(folder) != 0) return fprintf(stderr, "set TRIMRAY_TESTS_DIR to the folder tests\n"), 1;
    const struct CMUnitTest tests[] = { cmocka_unit_test(rays_find_together_what_they_find_alone) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
