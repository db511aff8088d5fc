/* Tiles and threads. A tile is taken by whichever thread is free; a pixel depends on nothing but its place, so that the
 * picture is the same for every number of threads. */
#include "render/render.h"

#include "render/hash.h"
#include "render/shade.h"

#include <limits.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { TILE = 32 };                                   /* pixels a side where not told otherwise: as POV-Ray's */
static const size_t STACK_BYTES = (size_t)64 << 20;   /* of a thread: address space, for deep recursion through glass */
static const double PROGRESS_SECONDS = .1;

static atomic_bool is_interrupted;

void render_interrupt(void) { atomic_store(&is_interrupted, true); }

/* One rendering, shared by its threads. */
typedef struct {
    const Scene *scene;
    const RenderOptions *options;
    RenderSink *sink;
    void *sink_context;
    int n_across, n_tiles;
    atomic_int next_tile, n_done;
    double start;
    atomic_long next_progress;                        /* in steps of PROGRESS_SECONDS since the start */
} Job;

typedef struct { Job *job; Counters counters; pthread_t thread; } Worker;

RenderOptions render_options_default(int width, int height)
{
    return (RenderOptions){ .width = width, .height = height, .x1 = width, .y1 = height, .quality = 9,
                            .antialias = antialias_default(), .block_size = TILE };
}

/* ---- progress ---- */

static int percent(const Job *job) { return (int)(100. * atomic_load(&job->n_done) / job->n_tiles); }

/* Whoever first finds that the time has come writes. */
static void show_progress(Job *job)
{
    if (!job->options->progress) return;
    long now = (long)((stats_now() - job->start) / PROGRESS_SECONDS), due = atomic_load(&job->next_progress);
    if (now < due || !atomic_compare_exchange_strong(&job->next_progress, &due, now + 1)) return;
    fprintf(job->options->progress, "\rrendering %3d%%", percent(job));
    fflush(job->options->progress);
}

static void end_progress(const Job *job)
{
    if (!job->options->progress) return;
    fprintf(job->options->progress, "\rrendering %3d%%\n", percent(job));
    fflush(job->options->progress);
}

/* ---- pixels, tiles, threads ---- */

/* floor(x + .5), without a call. */
static int64_t rounded(double x)
{
    int64_t i = (int64_t)(x + .5);
    return i - ((double)i > x + .5);
}

/* Seeds depend on the place alone: samples off the middle of their pixel are told apart by where they are. */
static uint64_t seed_at(const RenderOptions *o, double x, double y)
{
    int64_t column = rounded(x), row = rounded(y);
    uint64_t pixel = (uint64_t)row * (uint64_t)o->width + (uint64_t)column;
    uint64_t sample = (uint64_t)(int64_t)((x - (double)column) * 0x1p31) << 32
                    ^ (uint64_t)(int64_t)((y - (double)row) * 0x1p31);
    return hash_combine(hash_mix(pixel), sample);
}

typedef struct { const Job *job; Trace *trace; } Sampler;

static void render_bunch(const Sampler *s, const Vec2 at[], int n, Pixel out[])
{
    const RenderOptions *o = s->job->options;
    const Scene *scene = s->job->scene;
    RayBunch rays;
    BunchLane lane[BUNCH_WIDTH];
    camera_rays(&scene->camera, at, n, o->width, o->height, &rays);
    rays.lane = lane;
    for (int i = 0; i < n; i++) lane[i] = (BunchLane){ .seed = seed_at(o, at[i].x, at[i].y) };
    shade_camera_rays(scene, &rays, o->quality, s->trace, out);
}

static void render_samples(void *context, const Vec2 at[], int n, Pixel out[])
{
    for (int i = 0; i < n; i += BUNCH_WIDTH) render_bunch(context, at + i, int_min(n - i, BUNCH_WIDTH), out + i);
}

static void render_tile(const Job *job, int tile, Trace *t)
{
    blockers_clear(&t->blockers);
    const RenderOptions *o = job->options;
    Sampler sampler = { job, t };
    int x0 = o->x0 + tile % job->n_across * o->block_size, y0 = o->y0 + tile / job->n_across * o->block_size;
    int x1 = int_min(x0 + o->block_size, o->x1), y1 = int_min(y0 + o->block_size, o->y1);
    size_t across = (size_t)(x1 - x0), n = across * (size_t)(y1 - y0);
    ArenaMark mark = arena_mark(t->scratch);
    Pixel *found = ARENA_ARRAY(t->scratch, Pixel, n);
    FilmPixel *pixels = ARENA_ARRAY(t->scratch, FilmPixel, n);
    antialias_block(&o->antialias, x0, y0, x1, y1, render_samples, &sampler, t->scratch, found, across);
    for (size_t i = 0; i < n; i++) pixels[i] = film_pixel(found[i]);
    job->sink(job->sink_context, x0, y0, x1, y1, pixels);
    arena_reset(t->scratch, mark);
}

static void *work(void *context)
{
    Worker *w = context;
    Job *job = w->job;
    Trace t = { .scratch = arena_new(), .measures_time = job->options->measures_time };
    while (!atomic_load(&is_interrupted)) {
        int tile = atomic_fetch_add(&job->next_tile, 1);
        if (tile >= job->n_tiles) break;
        render_tile(job, tile, &t);
        atomic_fetch_add(&job->n_done, 1);
        show_progress(job);
    }
    w->counters = t.counters;
    arena_free(t.scratch);
    return NULL;
}

/* The cores that this process may use. */
static int n_cores(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
    int n = CPU_COUNT(&set);
    return n > 0 ? n : 1;
}

/* Runs the workers to their end; returns how many there were: fewer than asked for if the system refuses, at least one. */
static int run_workers(Worker *workers, int n)
{
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    int n_started = 0;
    while (n_started < n) {
        Worker *w = &workers[n_started];
        if (pthread_create(&w->thread, &attributes, work, w) != 0) break;
        n_started++;
    }
    pthread_attr_destroy(&attributes);
    if (n_started == 0) work(&workers[0]);
    for (int i = 0; i < n_started; i++) pthread_join(workers[i].thread, NULL);
    return n_started > 0 ? n_started : 1;
}

static int tiles(int from, int to, int size) { return to > from ? (to - from + size - 1) / size : 0; }

RenderResult render_tiles(Scene *s, const RenderOptions *o, RenderSink *sink, void *context)
{
    if (!s->tree) scene_prepare(s);
    Job job = { .scene = s, .options = o, .sink = sink, .sink_context = context, .start = stats_now() };
    job.n_across = tiles(o->x0, o->x1, o->block_size);
    job.n_tiles = job.n_across * tiles(o->y0, o->y1, o->block_size);
    int n = int_min(o->n_threads > 0 ? o->n_threads : n_cores(), job.n_tiles > 0 ? job.n_tiles : 1);
    Worker *workers = calloc((size_t)n, sizeof *workers), alone = { 0 };
    if (!workers) n = 1;
    Worker *crew = workers ? workers : &alone;
    for (int i = 0; i < n; i++) crew[i].job = &job;
    RenderResult result = { .n_threads = run_workers(crew, n) };
    for (int i = 0; i < result.n_threads; i++) counters_add(&result.counters, &crew[i].counters);
    free(workers);
    result.trace_seconds = stats_now() - job.start;
    result.interrupted = atomic_load(&job.n_done) < job.n_tiles;
    atomic_store(&is_interrupted, false);
    if (job.n_tiles > 0) end_progress(&job);
    return result;
}

static void fill_film(void *context, int x0, int y0, int x1, int y1, const FilmPixel *pixels)
{
    film_set(context, x0, y0, x1, y1, pixels);
}

RenderResult render_scene(Scene *s, const RenderOptions *o, Film *film) { return render_tiles(s, o, fill_film, film); }
