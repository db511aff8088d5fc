/* trimray report SCENE.pov... -o FOLDER: error against run time, measured. See report.h for who does what. */
#include "render/commands.h"
#include "render/files.h"
#include "render/report.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* --quick: what does not fit is left out. The rest of the minute is for the report's own files. */
static const double QUICK_SECONDS = 50;
static const char QUICK_IS_OVER[] = "settings that do not fit in the time of --quick: the table shows which were measured";
static const double MOST_SECONDS = 900;      /* for one setting, where there is no hurry */

static void note(Report *r, const char *text)
{
    for (size_t i = 0; i < r->n_notes; i++)
        if (strcmp(r->notes[i], text) == 0) return;
    ARENA_PUSH(r->arena, r->notes, r->n_notes, r->notes_capacity) = text;
    if (!r->options->is_quiet) fprintf(stderr, "trimray: left out: %s\n", text);
}

/* ---- progress ---- */

typedef struct { double begun, deadline; size_t n_taken; bool is_shown; } Progress;   /* deadline: of this scene */

static void show_progress(const Progress *p, const Report *r, const char *what)
{
    enum { WIDTH = 30 };
    if (!p->is_shown) return;
    size_t n_new = r->n_done - p->n_taken, n_left = r->n_samples - r->n_done;
    double left = n_new ? (stats_now() - p->begun) / (double)n_new * (double)n_left : 0;
    int filled = r->n_samples ? (int)(WIDTH * r->n_done / r->n_samples) : WIDTH;
    fprintf(stderr, "\r[%.*s%.*s] %zu/%zu", filled, "##############################", WIDTH - filled,
            "..............................", r->n_done, r->n_samples);
    if (n_new) fprintf(stderr, ", about %d:%02d left", (int)left / 60, (int)left % 60);
    fprintf(stderr, "  %s\033[K", what);
    fflush(stderr);
}

static void end_progress(const Progress *p)
{
    if (p->is_shown) fputs("\r\033[K", stderr);
}

/* ---- measuring ---- */

static double seconds_left(const Report *r, const Progress *p)
{
    return r->options->is_quick ? p->deadline - stats_now() : MOST_SECONDS;
}

/* Each of the scenes to come gets its share of what is left. */
static void set_deadline(const Report *r, Progress *p, size_t scene)
{
    double now = stats_now(), left = QUICK_SECONDS - (now - p->begun);
    p->deadline = now + left / (double)(r->n_scenes - scene);
}

/* Messages of the scene's own begin with its name. */
static void tell_failure(const Progress *p, const char *what, const char *failure)
{
    end_progress(p);
    fprintf(stderr, "trimray: error: %s: %s\n", what, failure);
}

static void count_done(Report *r, const ReportScene *s)
{
    for (size_t i = 0; i < r->n_samples; i++) r->n_done += r->samples[i].scene == s && r->samples[i].is_done;
}

static void make_reference(Report *r, Progress *p, ReportScene *s)
{
    show_progress(p, r, arena_printf(r->arena, "%s: reference", s->name));
    s->failure = report_reference(r, s, seconds_left(r, p));
    if (interrupt_came()) return;
    if (s->failure && seconds_left(r, p) <= 0) note(r, QUICK_IS_OVER);
    else if (s->failure) tell_failure(p, s->path, s->failure);
    if (s->failure) return;
    const char *wrong = report_read(r, s);
    if (wrong) note(r, arena_printf(r->arena, "what was measured before cannot be read: %s", wrong));
    size_t before = r->n_done;
    count_done(r, s);
    p->n_taken += r->n_done - before;
}

static void measure(Report *r, const Progress *p, ReportSample *s)
{
    const char *name = arena_printf(r->arena, "%s: %s", s->scene->name, report_sample_name(r->arena, s));
    double seconds = seconds_left(r, p);
    if (!(seconds > 0)) {
        note(r, QUICK_IS_OVER);
        return;
    }
    show_progress(p, r, name);
    s->failure = report_measure(r, s, seconds);
    if (interrupt_came()) return;
    s->is_done = true;
    r->n_done++;
    if (s->failure && seconds_left(r, p) <= 0) {
        s->is_done = false, s->failure = NULL;
        note(r, QUICK_IS_OVER);
    } else if (s->failure) {
        tell_failure(p, name, s->failure);
    } else if (!report_append(r, s)) {
        note(r, arena_printf(r->arena, "continuing: %s/measured.jsonl cannot be written", r->folder));
    }
}

/* Coarse settings of all methods first: what --quick leaves out is the finest. */
static void measure_scene(Report *r, Progress *p, ReportScene *scene)
{
    make_reference(r, p, scene);
    for (int round = 0; round < REPORT_MOST_SETTINGS; round++)
        for (size_t i = 0; i < r->n_samples && !interrupt_came(); i++) {
            ReportSample *s = &r->samples[i];
            if (s->scene != scene || s->round != round) continue;
            if (scene->failure) r->n_done++;
            else if (!s->is_done) measure(r, p, s);
        }
    unlink(scene->hits);
}

static bool has_failures(const Report *r)
{
    for (size_t i = 0; i < r->n_scenes; i++)
        if (r->scenes[i].failure) return true;
    for (size_t i = 0; i < r->n_samples; i++)
        if (r->samples[i].failure) return true;
    return false;
}

/* ---- the command ---- */

static int write_all(const Report *r)
{
    if (report_write_csv(r) && report_write_json(r) && report_write_plots(r) && report_write_page(r)) {
        if (!r->options->is_quiet) fprintf(stderr, "%s/index.html, report.csv, report.json\n", r->folder);
        return EXIT_DONE;
    }
    return run_fail(EXIT_FILE, "cannot write %s: %s", r->folder, strerror(errno));
}

static int report(Report *r)
{
    Progress p = { .begun = stats_now(), .is_shown = !r->options->is_quiet && isatty(STDERR_FILENO) };
    interrupt_defer(NULL);
    report_plan(r);
    if (!r->povray) note(r, "POV-Ray's own traces of the exported meshes: povray is not installed");
    for (size_t i = 0; i < r->n_scenes && !interrupt_came(); i++) {
        set_deadline(r, &p, i);
        measure_scene(r, &p, &r->scenes[i]);
    }
    end_progress(&p);
    r->was_interrupted = interrupt_came();
    if (r->was_interrupted) note(r, "what was not measured yet: interrupted; the same command continues");
    int status = write_all(r);
    if (status != EXIT_DONE) return status;
    return r->was_interrupted ? EXIT_INTERRUPTED : has_failures(r) ? EXIT_INPUT : EXIT_DONE;
}

/* 0, or why the folder cannot be written to; it is made if it is not there. */
static int open_folder(const char *folder, Arena *a)
{
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) return errno;
    struct stat there;
    if (stat(folder, &there) != 0) return errno;
    if (!S_ISDIR(there.st_mode)) return ENOTDIR;
    return file_cannot_write(arena_printf(a, "%s/report.csv", folder), a);
}

int cmd_report(const Options *o)
{
    Arena *arena = arena_new();
    Report r = { .options = o, .arena = arena, .povray = report_find_povray(arena) };
    char *folder = arena_strdup(arena, o->output);
    size_t n = strlen(folder);
    while (n > 1 && folder[n - 1] == '/') folder[--n] = '\0';
    r.folder = folder;
    if (getloadavg(&r.load, 1) != 1) r.load = NAN;
    r.width = o->width ? o->width : o->is_quick ? 256 : 512;
    r.height = o->height ? o->height : r.width * 3 / 4;
    r.n_runs = o->n_runs ? o->n_runs : o->is_quick ? 3 : 5;
    r.n_threads = o->n_threads ? o->n_threads : 1;
    int reason = open_folder(folder, arena);
    int status = reason ? run_fail(EXIT_FILE, "cannot write %s: %s", folder, strerror(reason)) : report(&r);
    arena_free(arena);
    return status;
}
