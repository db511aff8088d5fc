/* trimray SCENE.pov: the picture of a scene. */
#include "render/commands.h"
#include "render/files.h"
#include "render/picture.h"
#include "render/render.h"

#include <string.h>
#include <strings.h>
#include <unistd.h>

/* Where the picture goes, as POV-Ray has it: beside the scene; into a folder that is named; .png where no extension is
 * given. */
static const char *picture_path(const Run *run)
{
    const char *name = run->options->output, *scene = run->path;
    size_t n = strlen(scene);
    if (n > 4 && strcasecmp(scene + n - 4, ".pov") == 0) n -= 4;
    if (!name) return arena_printf(run->arena, "%.*s.png", (int)n, scene);
    if (*name && name[strlen(name) - 1] == '/') {
        const char *slash = strrchr(scene, '/');
        size_t folder = slash ? (size_t)(slash + 1 - scene) : 0;
        return arena_printf(run->arena, "%s%.*s.png", name, (int)(n - folder), scene + folder);
    }
    const char *slash = strrchr(name, '/'), *base = slash ? slash + 1 : name;
    return strcmp(name, "-") == 0 || strchr(base, '.') || strncmp(name, "/dev/", 5) == 0 ? name
         : arena_printf(run->arena, "%s.png", name);
}

static bool render_options(const Run *run, RenderOptions *out)
{
    const Options *o = run->options;
    *out = render_options_default(o->width, o->height);
    out->n_threads = run->n_threads;
    out->quality = o->quality;
    out->block_size = o->block_size;
    out->antialias = o->antialias;
    if (!o->antialias_on) out->antialias.method = 0;
    if (!o->jitter_on) out->antialias.jitter = 0;
    out->measures_time = o->stats != NULL;
    out->progress = !o->is_quiet && isatty(STDERR_FILENO) ? stderr : NULL;
    return options_crop(o->start_column, o->end_column, o->width, &out->x0, &out->x1)
        && options_crop(o->start_row, o->end_row, o->height, &out->y0, &out->y1);
}

static void add_tile(void *picture, int x0, int y0, int x1, int y1, const FilmPixel *pixels)
{
    if (picture) picture_add(picture, x0, y0, x1, y1, pixels);
}

/* picture NULL: nothing is kept. */
static void trace(Run *run, const RenderOptions *o, Picture *picture)
{
    interrupt_defer(render_interrupt);
    RenderResult result = render_tiles(run->scene, o, add_tile, picture);
    interrupt_defer(NULL);
    run->counters = result.counters;
    run->trace_seconds = result.trace_seconds;
    run->n_threads = result.n_threads;
    run->was_interrupted = result.interrupted;
    run->was_traced = true;
}

static Picture *new_picture(const Run *run, const RenderOptions *o)
{
    const Scene *s = run->scene;
    return picture_new(&(PictureFormat){ o->width, o->height, o->x0, o->y0, o->x1, o->y1, s->gamma, s->gamma_power,
                                         run->options->bits, run->options->alpha });
}

/* What is still to be done once all is traced. */
static int write_picture(Run *run, const char *path, Picture *picture)
{
    double begun = stats_now();
    const char *wrong = picture_write(picture, path);
    run->write_seconds = stats_now() - begun;
    return wrong ? run_fail(EXIT_FILE, "cannot write %s: %s", path, wrong) : EXIT_DONE;
}

static void tell(const Run *run, const char *path)
{
    const Options *o = run->options;
    if (run->was_interrupted && !o->is_quiet) fputs("trimray: interrupted: the rest of the picture is black\n", stderr);
    if (!o->is_verbose) return;
    fprintf(stderr, "%s: %zu objects, %zu lights, %zu NURBS surfaces, %zu trims\n", run->path, run->summary.n_objects,
            run->summary.n_lights, run->summary.n_nurbs, run->summary.n_trims);
    fprintf(stderr, "%s: %d x %d, %d threads: read %.3f s, prepared %.3f s, traced %.3f s, written %.3f s; %.0f MB\n",
            o->no_output ? "no file" : path, o->width, o->height, run->n_threads, run->parse_seconds,
            run->prep_seconds + run->counters.prep_seconds, run->trace_seconds, run->write_seconds, stats_peak_mb());
}

/* A picture that cannot be POV-Ray's says so. */
static void warn_of_jitter(const Options *o)
{
    if (o->antialias_on && o->jitter_on && o->antialias.jitter > 0 && !o->is_quiet)
        fputs("trimray: warning: POV-Ray's table of jitter is its own: samples are displaced otherwise (-J: not at all)\n",
              stderr);
}

/* Nothing is rendered that could not be written. */
static int render(Run *run, const RenderOptions *o)
{
    const char *path = picture_path(run);
    bool is_kept = !run->options->no_output;
    int reason = is_kept ? file_cannot_write(path, run->arena) : 0;
    if (reason) return run_fail(EXIT_FILE, "cannot write %s: %s", path, strerror(reason));
    Picture *picture = is_kept ? new_picture(run, o) : NULL;
    if (is_kept && !picture) return run_fail(EXIT_FILE, "no memory for a picture of %d x %d", o->width, o->height);
    warn_of_jitter(run->options);
    trace(run, o, picture);
    int status = is_kept ? write_picture(run, path, picture) : EXIT_DONE;
    picture_free(picture);
    tell(run, path);
    return status;
}

int cmd_render(const Options *options)
{
    Run run;
    RenderOptions o;
    int status = run_begin(&run, options);
    if (status != EXIT_DONE) return status;
    status = render_options(&run, &o) ? render(&run, &o)
           : run_fail(EXIT_USAGE, "the part to render (+SC +EC +SR +ER) is empty or leaves the picture");
    return run_end(&run, status);
}
