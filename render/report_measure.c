/* One setting, measured from the scene's file to the picture's, as often as asked; then its errors. Everything here runs in
 * jobs (report_job.c) but the functions at the end, which start them. */
#include "render/report.h"

#include "render/compare.h"
#include "render/files.h"
#include "render/hash.h"
#include "render/image.h"
#include "render/inventory.h"
#include "render/render.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The reference's leaves: far smaller than anyone would want for speed. */
static const double REFERENCE_VARIATION = .05;

typedef struct {
    const Report *report;
    ReportScene *scene;
    ReportSample *sample;            /* NULL: the reference */
    struct { double number[REPORT_N_NUMBERS], size; uint64_t fingerprint; } *shared;   /* what comes back from the job */
} Task;

Options report_options(const Report *r, const ReportScene *s, ReportSeries series, double setting)
{
    Options o = *r->options;
    bool is_paper = series == REPORT_PAPER_FLATNESS || series == REPORT_PAPER_ITERATIONS;
    o.input = s->path, o.width = r->width, o.height = r->height, o.n_threads = r->n_threads;
    o.is_quiet = true, o.stats = NULL;
    o.nurbs = (NurbsOptions){ .method = is_paper ? NURBS_METHOD_PAPER : NURBS_METHOD_CERTAIN };
    if (series == REPORT_CERTAIN) o.nurbs.leaf_variation = setting;
    if (series == REPORT_PAPER_FLATNESS) o.nurbs.flatness = setting;
    if (series == REPORT_PAPER_ITERATIONS) o.nurbs.max_iterations = (int)setting;
    return o;
}

/* ---- one run ---- */

static int trace(Run *run, bool measures_time, const char *path)
{
    const Options *o = run->options;
    RenderOptions options = render_options_default(o->width, o->height);
    options.n_threads = run->n_threads, options.quality = o->quality, options.measures_time = measures_time;
    options.antialias.method = 0;
    Film *film = film_new(o->width, o->height);
    if (!film) return run_fail(EXIT_FILE, "no memory for a picture of %d x %d", o->width, o->height);
    RenderResult result = render_scene(run->scene, &options, film);
    run->counters = result.counters, run->trace_seconds = result.trace_seconds, run->n_threads = result.n_threads;
    double begun = stats_now();
    const char *wrong = image_write_png(path, film, run->scene->gamma, run->scene->gamma_power, 16, false);
    run->write_seconds = stats_now() - begun;
    film_free(film);
    return wrong ? run_fail(EXIT_FILE, "cannot write %s: %s", path, wrong) : EXIT_DONE;
}

/* What rays made shapes prepare happened while they were traced: on several threads, side by side. */
static void keep_times(const Run *run, double number[])
{
    double lazy = run->counters.prep_seconds / run->n_threads;
    number[REPORT_PARSE] = run->parse_seconds;
    number[REPORT_PREPARE] = run->prep_seconds + lazy;
    number[REPORT_TRACE] = fmax(run->trace_seconds - lazy, 0);
    number[REPORT_WRITE] = run->write_seconds;
    number[REPORT_TOTAL] = run->parse_seconds + run->prep_seconds + run->trace_seconds + run->write_seconds;
}

static void make_meshes(Run *run, double chord_error, ReportMesh *mesh)
{
    double begun = stats_now();
    run->scene = report_mesh_scene(run->arena, run->scene, chord_error, mesh);
    run->prep_seconds = stats_now() - begun;
}

static void keep_counts(const Run *run, double number[])
{
    const Counters *c = &run->counters;
    Inventory v = inventory_make(run->arena, run->scene);
    number[REPORT_PIECES] = (double)v.n_leaves, number[REPORT_GEOMETRY_MB] = (double)v.n_bytes / 1e6;
    number[REPORT_SURFACES] = (double)v.n_surfaces_seen, number[REPORT_TRIMS] = (double)v.n_trims_seen;
    number[REPORT_RAYS] = (double)c->camera_rays, number[REPORT_BV] = (double)c->bv_intersections;
    number[REPORT_LIGHT_BV] = (double)c->light_bv_intersections, number[REPORT_TESTS] = (double)c->nurbs_tests;
    number[REPORT_HITS] = (double)c->nurbs_hits, number[REPORT_REPORTED] = (double)c->reported_hits;
    number[REPORT_ITERATIONS] = c->nurbs_tests ? (double)c->newton_iterations / (double)c->nurbs_tests : NAN;
}

static void keep_memory(const Run *run, const ReportMesh *mesh, double number[])
{
    keep_counts(run, number);
    number[REPORT_PEAK_MB] = stats_peak_mb();
    if (!mesh) return;
    number[REPORT_PIECES] = (double)mesh->n_triangles;
    number[REPORT_GEOMETRY_MB] = (double)report_mesh_bytes(mesh) / 1e6;
    for (int i = REPORT_TESTS; i <= REPORT_ITERATIONS; i++) number[i] = NAN;
}

/* ---- errors ---- */

static const ReportHit *read_hits(const Task *k, Arena *a, size_t n)
{
    size_t n_bytes;
    const char *bytes = file_read(k->scene->hits, a, &n_bytes);
    return bytes && n_bytes == n * sizeof(ReportHit) ? arena_copy(a, bytes, n, sizeof(ReportHit)) : NULL;
}

static int compare_hits(const Task *k, Run *run, const bool *is_surface, double number[])
{
    int width = run->options->width, height = run->options->height;
    size_t n = (size_t)width * (size_t)height;
    const ReportHit *truth = read_hits(k, run->arena, n), *found = report_hits(run->arena, run->scene, width, height);
    if (!truth) return run_fail(EXIT_FILE, "cannot read %s", k->scene->hits);
    report_compare_hits(run->arena, truth, found, n, is_surface, k->scene->size, number);
    return EXIT_DONE;
}

/* The picture as the page has it: 8 bits. */
static const char *write_8_bits(const char *path, const Image *p)
{
    Film *f = film_new(p->width, p->height);
    for (size_t i = 0; f && i < (size_t)p->width * (size_t)p->height; i++) {
        const uint16_t *s = p->rgba + 4 * i;
        f->pixels[i] = film_pixel((Pixel){ s[0] / 65535., s[1] / 65535., s[2] / 65535., 0 });
    }
    const char *wrong = f ? image_write_png(path, f, GAMMA_NONE, 0, 8, false) : "no memory";
    film_free(f);
    return wrong;
}

static int compare_pictures(const Task *k, double number[])
{
    const char *wrong = NULL;
    Arena *a = arena_new();
    const Image *truth = image_read_png(a, k->scene->picture, &wrong);
    const Image *found = truth ? image_read_png(a, k->sample->picture, &wrong) : NULL;
    if (found) {
        Comparison c = compare_images(a, truth, found, 1);
        number[REPORT_RMSE] = c.rmse, number[REPORT_LARGEST] = c.largest;
        number[REPORT_OVER] = (double)c.n_over / (double)c.n_pixels;
        Film *f = compare_picture(truth, found, 1);
        wrong = f ? image_write_png(k->sample->difference, f, GAMMA_NONE, 0, 8, false) : "no memory";
        film_free(f);
        if (!wrong) wrong = write_8_bits(k->sample->picture, found);
    }
    arena_free(a);
    return wrong ? run_fail(EXIT_FILE, "%s: %s", k->sample->picture, wrong) : EXIT_DONE;
}

/* ---- a setting ---- */

typedef struct { bool is_last, measures_time; } Turn;

/* number[]: of this run alone; on the last, with all but the times' medians. */
static int run_once(const Task *k, const Options *o, Turn turn, double number[])
{
    const ReportSample *s = k->sample;
    Run run;
    ReportMesh mesh;
    bool is_mesh = s->series == REPORT_MESH, *is_surface;
    size_t n;
    int status = run_begin(&run, o);
    if (status != EXIT_DONE) return status;
    double chord_error = s->number[REPORT_SETTING] * k->scene->size;
    if (s->series == REPORT_POVRAY) {
        status = report_trace_povray(&run, k->report->povray, chord_error, s->picture, number);
        if (turn.is_last) report_mesh_scene(run.arena, run.scene, chord_error, &mesh);
        if (turn.is_last) number[REPORT_PIECES] = (double)mesh.n_triangles;
        return run_end(&run, status);
    }
    is_surface = report_surfaces(run.arena, run.scene, &n);
    if (is_mesh) make_meshes(&run, chord_error, &mesh);
    status = trace(&run, turn.measures_time, s->picture);
    keep_times(&run, number);
    number[REPORT_TEST_SECONDS] = run.counters.nurbs_seconds / (double)run.counters.nurbs_tests;
    if (turn.is_last) keep_memory(&run, is_mesh ? &mesh : NULL, number);
    if (turn.is_last && status == EXIT_DONE) status = compare_hits(k, &run, is_surface, number);
    return run_end(&run, status);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int n)
{
    qsort(values, (size_t)n, sizeof *values, ascending);
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

static void keep_medians(double (*runs)[REPORT_N_NUMBERS], int n, double number[])
{
    double *values = calloc((size_t)n, sizeof *values);
    for (int i = REPORT_PARSE; values && i <= REPORT_TOTAL; i++) {
        for (int j = 0; j < n; j++) values[j] = runs[j][i];
        number[i] = median(values, n);
    }
    if (values) number[REPORT_TOTAL_LEAST] = values[0], number[REPORT_TOTAL_MOST] = values[n - 1];   /* totals came last */
    number[REPORT_RUNS] = n;
    free(values);
}

/* The time of a test is taken apart: reading the clock that often costs time of its own. */
static int measure_tests(const Task *k, const Options *o, double number[])
{
    double alone[REPORT_N_NUMBERS];
    int status = run_once(k, o, (Turn){ .measures_time = true }, alone);
    number[REPORT_TEST_SECONDS] = alone[REPORT_TEST_SECONDS];
    return status;
}

static int measure(void *context)
{
    const Task *k = context;
    const ReportSample *s = k->sample;
    double *number = k->shared->number;
    int n = k->report->n_runs, status = EXIT_DONE;
    double (*runs)[REPORT_N_NUMBERS] = calloc((size_t)n, sizeof *runs);
    if (!runs) return run_fail(EXIT_FILE, "no memory");
    Options o = report_options(k->report, k->scene, s->series, s->number[REPORT_SETTING]);
    bool wants_tests = s->number[REPORT_IS_DEFAULT] && (s->series == REPORT_CERTAIN || s->series == REPORT_PAPER_ITERATIONS);
    if (wants_tests) status = measure_tests(k, &o, number);
    double test_seconds = number[REPORT_TEST_SECONDS];
    for (int i = 0; i < n && status == EXIT_DONE; i++) {
        for (int j = 0; j < REPORT_N_NUMBERS; j++) runs[i][j] = s->number[j];
        status = run_once(k, &o, (Turn){ .is_last = i == n - 1 }, runs[i]);
    }
    memcpy(number, runs[n - 1], sizeof runs[n - 1]);
    number[REPORT_TEST_SECONDS] = wants_tests ? test_seconds : NAN;
    if (status == EXIT_DONE) keep_medians(runs, n, number);
    free(runs);
    return status == EXIT_DONE ? compare_pictures(k, number) : status;
}

const char *report_measure(const Report *r, ReportSample *s, double seconds)
{
    Task k = { .report = r, .scene = (ReportScene *)s->scene, .sample = s, .shared = report_shared(sizeof *k.shared) };
    if (!k.shared) return "no memory";
    const char *failure = report_job(r->arena, seconds, measure, &k);
    if (!failure) memcpy(s->number, k.shared->number, sizeof s->number);
    return failure;
}

/* ---- the reference ---- */

static uint64_t fingerprint(const ReportHit *hits, size_t n)
{
    uint64_t h = n;
    for (size_t i = 0; i < n * sizeof *hits / sizeof(uint64_t); i++) {
        uint64_t word;
        memcpy(&word, (const char *)hits + i * sizeof word, sizeof word);
        h = hash_combine(h, word);
    }
    return h;
}

static int trace_reference(Task *k, Run *run)
{
    const Options *o = run->options;
    size_t n = (size_t)o->width * (size_t)o->height;
    k->shared->size = report_scene_size(run->arena, run->scene);
    if (!(k->shared->size > 0)) return run_fail(EXIT_INPUT, "%s: there is no NURBS surface in it", run->path);
    int status = trace(run, false, k->scene->picture);
    if (status != EXIT_DONE) return status;
    const ReportHit *hits = report_hits(run->arena, run->scene, o->width, o->height);
    k->shared->fingerprint = fingerprint(hits, n);
    return file_write(k->scene->hits, run->arena, hits, n * sizeof *hits) ? EXIT_DONE
         : run_fail(EXIT_FILE, "cannot write %s: %s", k->scene->hits, strerror(errno));
}

static int make_reference(void *context)
{
    Task *k = context;
    Run run;
    Options o = report_options(k->report, k->scene, REPORT_CERTAIN, REFERENCE_VARIATION);
    int status = run_begin(&run, &o);
    return status == EXIT_DONE ? run_end(&run, trace_reference(k, &run)) : status;
}

const char *report_reference(const Report *r, ReportScene *s, double seconds)
{
    Task k = { .report = r, .scene = s, .shared = report_shared(sizeof *k.shared) };
    if (!k.shared) return "no memory";
    const char *failure = report_job(r->arena, seconds, make_reference, &k);
    s->size = k.shared->size, s->fingerprint = k.shared->fingerprint;
    return failure;
}
