#include "render/report.h"

#include <ctype.h>
#include <string.h>

/* Chord errors are in units of the scene's size. POV-Ray is spared the finest: it reads meshes as text. */
static const double variations[] = { 1.4, 1, .7, .5, .35, .25, .15, .1, 0 }, quick_variations[] = { 1, .25, .1, 0 };
static const double flatnesses[] = { .1, .3, 1, 3, 10, 0 }, quick_flatnesses[] = { .3, 3, 0 };
static const double iterations[] = { 2, 3, 4, 6, 8, 10, 15, 0 }, quick_iterations[] = { 3, 10, 0 };
static const double chords[] = { 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 0 };
static const double quick_chords[] = { 4e-3, 1e-3, 2.5e-4, 6.25e-5, 0 };
static const double povray_chords[] = { 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 0 };
static const double quick_povray_chords[] = { 4e-3, 1e-3, 2.5e-4, 0 };

const ReportMethod report_methods[REPORT_N_SERIES] = {
    [REPORT_CERTAIN] = { "certain", "certain", "leaf variation", "certain", variations, quick_variations, .25 },
    [REPORT_PAPER_FLATNESS] = { "paper-flatness", "paper", "flatness C", "paper, flatness",
                                flatnesses, quick_flatnesses, 0 },
    [REPORT_PAPER_ITERATIONS] = { "paper-iterations", "paper", "iterations", "paper, iterations",
                                  iterations, quick_iterations, 10 },
    [REPORT_MESH] = { "mesh", "mesh", "chord error", "mesh", chords, quick_chords, 0 },
    [REPORT_POVRAY] = { "povray", "povray", "chord error", "mesh, POV-Ray", povray_chords, quick_povray_chords, 0 },
};

/* The file's name without folder and ending, and a number where two scenes share it. */
static const char *name_of(const Report *r, size_t i)
{
    const char *path = r->scenes[i].path, *slash = strrchr(path, '/');
    char *name = arena_strdup(r->arena, slash ? slash + 1 : path), *dot = strrchr(name, '.');
    if (dot && dot > name) *dot = '\0';
    for (char *c = name; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '-') *c = '_';
    for (size_t j = 0; j < i; j++)
        if (strcmp(r->scenes[j].name, name) == 0) return arena_printf(r->arena, "%s_%zu", name, i + 1);
    return name;
}

static size_t count(const double *settings)
{
    size_t n = 0;
    while (settings[n] > 0) n++;
    return n;
}

static const double *settings_of(const Report *r, int series)
{
    return r->options->is_quick ? report_methods[series].quick_settings : report_methods[series].settings;
}

static bool has_series(const Report *r, int series) { return series != REPORT_POVRAY || r->povray; }

static ReportSample sample_of(const Report *r, const ReportScene *scene, ReportSeries series, int round)
{
    ReportSample s = { .scene = scene, .series = series, .round = round };
    double setting = settings_of(r, series)[round];
    for (int i = 0; i < REPORT_N_NUMBERS; i++) s.number[i] = NAN;
    s.number[REPORT_SETTING] = setting;
    s.number[REPORT_IS_DEFAULT] = setting == report_methods[series].default_setting;
    const char *stem = arena_printf(r->arena, "%s/%s-%s-%g", r->folder, scene->name, report_methods[series].word, setting);
    s.picture = arena_printf(r->arena, "%s.png", stem);
    s.difference = arena_printf(r->arena, "%s-difference.png", stem);
    return s;
}

void report_plan(Report *r)
{
    const Options *o = r->options;
    r->n_scenes = o->n_inputs;
    r->scenes = arena_zalloc(r->arena, r->n_scenes, sizeof *r->scenes);
    size_t n_each = 0;
    for (int k = 0; k < REPORT_N_SERIES; k++) n_each += has_series(r, k) ? count(settings_of(r, k)) : 0;
    r->samples = ARENA_ARRAY(r->arena, ReportSample, n_each * r->n_scenes + 1);
    for (size_t i = 0; i < r->n_scenes; i++) {
        ReportScene *s = &r->scenes[i];
        s->path = o->inputs[i];
        s->name = name_of(r, i);
        s->picture = arena_printf(r->arena, "%s/%s.png", r->folder, s->name);
        s->hits = arena_printf(r->arena, "%s/%s.hits", r->folder, s->name);
        for (int k = 0; k < REPORT_N_SERIES; k++)
            for (size_t j = 0; has_series(r, k) && settings_of(r, k)[j] > 0; j++)
                r->samples[r->n_samples++] = sample_of(r, s, (ReportSeries)k, (int)j);
    }
}

const char *report_command(const Report *r)
{
    const char *line = "trimray report";
    for (size_t i = 0; i < r->n_scenes; i++) line = arena_printf(r->arena, "%s %s", line, r->scenes[i].path);
    const char *quick = r->options->is_quick ? " --quick" : "";
    return arena_printf(r->arena, "%s -o %s%s +W%d +H%d +WT%d --runs %d", line, r->folder, quick, r->width, r->height,
                        r->n_threads, r->n_runs);
}
