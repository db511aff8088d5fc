#include "render/commands.h"

#include "render/files.h"
#include "render/stats_json.h"

#include <errno.h>
#include <sched.h>
#include <string.h>
#include <unistd.h>

int run_fail(int status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("trimray: error: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return status;
}

int run_thread_count(const Options *o)
{
    cpu_set_t cores;
    if (o->n_threads) return o->n_threads;
    return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

/* As POV-Ray finds it: the name as it stands, else with .pov. */
static const char *find_scene(const char *name, Arena *a)
{
    const char *longer = arena_printf(a, "%s.pov", name);
    return access(name, F_OK) != 0 && access(longer, F_OK) == 0 ? longer : name;
}

/* Those of +L, then the scene's own folder (where POV-Ray, started from elsewhere, does not look). */
static const char *const *library_paths(const Run *run)
{
    const Options *o = run->options;
    const char *slash = strrchr(run->path, '/');
    const char **paths = ARENA_ARRAY(run->arena, const char *, o->n_library_paths + 1);
    for (size_t i = 0; i < o->n_library_paths; i++) paths[i] = o->library_paths[i];
    int length = slash ? (int)(slash - run->path) + (slash == run->path) : 0;
    paths[o->n_library_paths] = slash ? arena_printf(run->arena, "%.*s", length, run->path) : ".";
    return paths;
}

static ParseOptions parse_options(const Run *run)
{
    const Options *o = run->options;
    return (ParseOptions){
        .library_paths = library_paths(run), .n_library_paths = (int)o->n_library_paths + 1,
        .declares = o->declares, .n_declares = (int)o->n_declares,
        .version = o->version, .clock = o->clock, .clock_on = o->clock_on,
        .image_width = o->width, .image_height = o->height, .quality = o->quality, .nurbs = o->nurbs,
        .max_steps = o->max_steps,
    };
}

static bool read_scene(Run *run)
{
    Diag *diag = diag_new(run->arena);
    ParseOptions options = parse_options(run);
    run->scene = scene_new(run->arena);
    bool is_right = parse_scene(run->path, &options, run->arena, diag, run->scene, &run->summary);
    if (!is_right || !run->options->is_quiet) diag_print(diag, stderr);
    return is_right;
}

int run_begin(Run *run, const Options *o)
{
    *run = (Run){ .options = o, .arena = arena_new(), .n_threads = run_thread_count(o) };
    run->path = find_scene(o->input, run->arena);
    FILE *there = fopen(run->path, "rb");
    bool is_readable = there && (fgetc(there) != EOF || !ferror(there));
    int reason = errno;
    if (there) fclose(there);
    if (!is_readable) return run_end(run, run_fail(EXIT_FILE, "cannot read %s: %s", run->path, strerror(reason)));
    double begun = stats_now();
    if (!read_scene(run)) return run_end(run, EXIT_INPUT);
    double parsed = stats_now();
    scene_prepare(run->scene);
    run->parse_seconds = parsed - begun;
    run->prep_seconds = stats_now() - parsed;
    return EXIT_DONE;
}

static bool write_stats(Run *run)
{
    const char *path = run->options->stats;
    Inventory inventory = inventory_make(run->arena, run->scene);
    const char *text = stats_json(run, &inventory, run->arena);
    if (!text) errno = ENOMEM;
    return text && file_write(path, run->arena, text, strlen(text));
}

int run_end(Run *run, int status)
{
    if (run->was_traced && run->options->stats && !write_stats(run))
        status = run_fail(EXIT_FILE, "cannot write %s: %s", run->options->stats, strerror(errno));
    if (run->scene) scene_release(run->scene);
    arena_free(run->arena);
    return status == EXIT_DONE && run->was_interrupted ? EXIT_INTERRUPTED : status;
}
