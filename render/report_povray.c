/* POV-Ray's own trace of a scene whose surfaces are exported as meshes: the export, then the program, in this job. */
#include "render/report.h"

#include "render/export_list.h"
#include "render/export_pov.h"
#include "render/files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

const char *report_find_povray(Arena *a)
{
    const char *path = getenv("PATH");
    while (path && *path) {
        size_t n = strcspn(path, ":");
        const char *program = arena_printf(a, "%.*s/povray", (int)n, path);
        if (access(program, X_OK) == 0) return program;
        path += n + (path[n] == ':');
    }
    return NULL;
}

static int export(Run *run, double chord_error, const char *path)
{
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *file = open_memstream(&text, &n_bytes);
    if (!file) return run_fail(EXIT_FILE, "no memory");
    ExportList list = export_list(run->arena, run->scene, export_pov_is_mesh);
    const char *unsupported = export_pov(file, run->scene, &list, chord_error);
    bool is_good = fclose(file) == 0 && !unsupported && file_write(path, run->arena, text, n_bytes);
    free(text);
    if (unsupported) return run_fail(EXIT_INPUT, "'%s' cannot be exported", unsupported);
    return is_good ? EXIT_DONE : run_fail(EXIT_FILE, "cannot write %s: %s", path, strerror(errno));
}

static void start_povray(Run *run, const char *povray, const char *scene, const char *picture, const char *log)
{
    const Options *o = run->options;
    const char *slash = strrchr(run->path, '/');
    Arena *a = run->arena;
    int said = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (said < 0 || dup2(said, STDOUT_FILENO) < 0 || dup2(said, STDERR_FILENO) < 0) _exit(EXIT_FILE);
    char *const arguments[] = {
        (char *)povray, arena_printf(a, "+I%s", scene), arena_printf(a, "+O%s", picture), arena_printf(a, "+W%d", o->width),
        arena_printf(a, "+H%d", o->height), arena_printf(a, "+WT%d", run->n_threads), arena_printf(a, "+Q%d", o->quality),
        (char *)"+FN16", (char *)"-A", (char *)"-D",
        slash ? arena_printf(a, "+L%.*s", (int)(slash - run->path), run->path) : (char *)"+L.", NULL
    };
    execv(povray, arguments);
    _exit(EXIT_FILE);
}

/* "  Parse Time:       0 hours  0 minutes  0 seconds (0.041 seconds)"; 0: not told. */
static double seconds_after(const char *text, const char *label)
{
    const char *line = strstr(text, label), *open = line ? strchr(line, '(') : NULL;
    return open ? strtod(open + 1, NULL) : 0;
}

static void keep(Run *run, const char *log, double export_seconds, double wall, double peak_mb, double number[])
{
    size_t n;
    const char *text = file_read(log, run->arena, &n);
    if (!text) text = "";
    double bounding = seconds_after(text, "Bounding Time:"), trace = seconds_after(text, "Trace Time:");
    number[REPORT_PARSE] = run->parse_seconds + fmax(wall - bounding - trace, 0);   /* its start and its end are in it */
    number[REPORT_PREPARE] = run->prep_seconds + export_seconds + bounding;
    number[REPORT_TRACE] = trace, number[REPORT_WRITE] = 0;
    number[REPORT_TOTAL] = run->parse_seconds + run->prep_seconds + export_seconds + wall;
    number[REPORT_PEAK_MB] = peak_mb;
}

int report_trace_povray(Run *run, const char *povray, double chord_error, const char *picture, double number[])
{
    const char *scene = arena_printf(run->arena, "%s.pov", picture), *log = arena_printf(run->arena, "%s.log", picture);
    double begun = stats_now();
    int status = export(run, chord_error, scene);
    if (status != EXIT_DONE) return status;
    double exported = stats_now();
    struct rusage usage;
    pid_t pid = fork();
    if (pid == 0) start_povray(run, povray, scene, picture, log);
    if (pid < 0 || wait4(pid, &status, 0, &usage) < 0) return run_fail(EXIT_FILE, "no process: %s", strerror(errno));
    keep(run, log, exported - begun, stats_now() - exported, (double)usage.ru_maxrss / 1024, number);
    if (status != 0) return run_fail(EXIT_INPUT, "POV-Ray makes no picture of %s: see %s", scene, log);
    unlink(scene), unlink(log);
    return EXIT_DONE;
}
