/* Small fixed runs of `certain`, for counting instructions: count.sh runs this under callgrind, which counts within
 * counted_pass alone. The first rays have tiles halved where they are in doubt, for all that come later: all runs but one
 * count what those cost, the last one what the first do.
 *
 *   count NAME     prints how many rays the run has; without NAME: the names
 *   count --built  prints what it was built with: counts of different compilers are not compared */
#include "tests/bench/bench.h"

#include <string.h>

enum { SIZE = 48, RANDOM_RAYS = 2000 };

typedef struct { const char *name, *model, *set; bool is_first; } CountedRun;

static const CountedRun runs[] = {
    { "teapot-camera", "teapot", "camera", false },
    { "torus-random", "torus", "random", false },
    { "sheet-shadow", "sheet", "shadow", false },
    { "sphere-grazing", "sphere", "grazing", false },
    { "sphere-borders", "sphere", "borders", false },
    { "sheet-shadow-first", "sheet", "shadow", true },
};

void counted_pass(Engine *e, const RaySet *set, double *t);
__attribute__((noinline)) void counted_pass(Engine *e, const RaySet *set, double *t) { e->shoot(e, set, 1, t); }

static void run(const CountedRun *r)
{
    Arena *a = arena_new();
    Model m;
    if (!model_make(a, r->model, &m)) exit(1);
    Engine *e = engine_trimray(&(EngineInput){ .model = &m, .method = NURBS_METHOD_CERTAIN });
    if (!e) exit(1);
    RaySet camera = rays_camera(&m, a, SIZE), set = camera;
    double *t = ARENA_ARRAY(a, double, camera.n + RANDOM_RAYS);
    e->shoot(e, &camera, 1, t);
    if (!strcmp(r->set, "random")) set = rays_random(&m, a, RANDOM_RAYS);
    if (!strcmp(r->set, "grazing")) set = rays_grazing(&m, a, RANDOM_RAYS);
    if (!strcmp(r->set, "borders")) set = rays_borders(&m, a, RANDOM_RAYS);
    if (!strcmp(r->set, "shadow")) set = rays_shadow(&m, a, &camera, t);
    if (!r->is_first) e->shoot(e, &set, 1, t);
    counted_pass(e, &set, t);
    printf("%zu\n", set.n);
    e->release(e);
    arena_free(a);
}

int main(int argc, char **argv)
{
    if (argc > 1 && !strcmp(argv[1], "--built")) {
        printf("%s %s\n", BENCH_COMPILER, BENCH_BUILD_TYPE);
        return 0;
    }
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        if (argc < 2) printf("%s\n", runs[i].name);
        else if (!strcmp(argv[1], runs[i].name)) run(&runs[i]);
    }
    return 0;
}
