/* trimray shoot SCENE.pov --rays R.bin --out H.bin: the hits of given rays, for tools and for measurement. */
#include "render/commands.h"
#include "render/files.h"
#include "render/hash.h"
#include "render/hit.h"
#include "render/shot.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#define BLOCK 256     /* rays that a thread takes at a time */

typedef struct {
    Scene *scene;
    const Ray *rays;
    ShotHit *hits;
    size_t n;
    bool measures_time;
    atomic_size_t next;              /* the first ray that no thread has taken */
} Volley;

typedef struct { Volley *volley; pthread_t thread; Counters counters; } Shooter;

static ShotHit shoot(const Scene *s, const Ray *ray, Trace *t)
{
    Hit hit = { .t = INFINITY };
    uint64_t tests = t->counters.nurbs_tests;
    bool is_hit = scene_hit(s, ray, RAY_CAMERA, &hit, t);
    ShotHit out = { .t = INFINITY, .index = -1, .tests = (double)(t->counters.nurbs_tests - tests) };
    if (!is_hit) return out;
    Attributes at;
    hit_attributes(&hit, ray, &at);
    out.t = hit.t, out.u = at.uv.x, out.v = at.uv.y, out.normal = at.normal, out.index = hit.index;
    return out;
}

/* Blocks are taken in order and each one that was taken is finished, so what is done after an interrupt is a beginning. */
static void *shooter_run(void *context)
{
    Shooter *me = context;
    Volley *v = me->volley;
    Trace t = { .scratch = arena_new(), .measures_time = v->measures_time };
    while (!interrupt_came()) {
        size_t first = atomic_fetch_add(&v->next, BLOCK);
        if (first >= v->n) break;
        for (size_t i = first; i < first + BLOCK && i < v->n; i++) {
            t.seed = hash_mix(i);
            t.counters.camera_rays++;
            v->hits[i] = shoot(v->scene, &v->rays[i], &t);
        }
    }
    me->counters = t.counters;
    arena_free(t.scratch);
    return NULL;
}

/* Returns how many rays, from the first, have their hits. A thread that cannot be started is done without. */
static size_t shoot_all(Run *run, Volley *v)
{
    Shooter *shooters = arena_zalloc(run->arena, (size_t)run->n_threads, sizeof *shooters);
    int n_started = 0;
    interrupt_defer(NULL);
    double begun = stats_now();
    for (int i = 0; i < run->n_threads; i++) shooters[i].volley = v;
    while (n_started < run->n_threads - 1
           && pthread_create(&shooters[n_started].thread, NULL, shooter_run, &shooters[n_started]) == 0) n_started++;
    shooter_run(&shooters[n_started]);
    for (int i = 0; i < n_started; i++) pthread_join(shooters[i].thread, NULL);
    run->trace_seconds = stats_now() - begun;
    for (int i = 0; i <= n_started; i++) counters_add(&run->counters, &shooters[i].counters);
    run->n_threads = n_started + 1;
    size_t n_done = atomic_load(&v->next);
    run->was_interrupted = n_done < v->n;
    run->was_traced = true;
    return n_done < v->n ? n_done : v->n;
}

static int write_hits(Run *run, const char *path, const ShotHit *hits, size_t n)
{
    double begun = stats_now();
    bool is_written = shot_write_hits(path, run->arena, hits, n);
    run->write_seconds = stats_now() - begun;
    if (!is_written) return run_fail(EXIT_FILE, "cannot write %s: %s", path, strerror(errno));
    if (run->was_interrupted) fprintf(stderr, "trimray: interrupted: %s has the first %zu rays\n", path, n);
    if (run->options->is_verbose)
        fprintf(stderr, "%s: %zu rays, %d threads: read %.3f s, prepared %.3f s, traced %.3f s\n", path, n, run->n_threads,
                run->parse_seconds, run->prep_seconds + run->counters.prep_seconds, run->trace_seconds);
    return EXIT_DONE;
}

static int shoot_file(Run *run)
{
    const Options *o = run->options;
    const char *path = o->output ? o->output : "-";
    Diag *diag = diag_new(run->arena);
    Volley volley = { .scene = run->scene, .measures_time = o->stats != NULL };
    volley.rays = shot_read_rays(o->rays, run->arena, diag, &volley.n);
    diag_print(diag, stderr);
    if (diag_error_count(diag)) return EXIT_INPUT;
    if (!volley.rays) return run_fail(EXIT_FILE, "cannot read %s: %s", o->rays, strerror(errno));
    int reason = file_cannot_write(path, run->arena);
    if (reason) return run_fail(EXIT_FILE, "cannot write %s: %s", path, strerror(reason));
    volley.hits = ARENA_ARRAY(run->arena, ShotHit, volley.n + 1);
    size_t n_done = shoot_all(run, &volley);
    return write_hits(run, path, volley.hits, n_done);
}

int cmd_shoot(const Options *options)
{
    Run run;
    int status = run_begin(&run, options);
    return status == EXIT_DONE ? run_end(&run, shoot_file(&run)) : status;
}
