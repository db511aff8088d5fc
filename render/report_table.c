/* The numbers of a report as CSV and as JSON, and the file from which it is continued: JSON, a line for each setting. */
#include "render/report.h"

#include "render/files.h"
#include "render/hash.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

const ReportColumn report_columns[REPORT_N_NUMBERS] = {
    [REPORT_SETTING] = { "setting", "", "the knob's value; chord errors in units of the size: the box's diagonal" },
    [REPORT_IS_DEFAULT] = { "is_default", "", "1 where trimray would choose this setting itself" },
    [REPORT_RUNS] = { "runs", "", "how often it was timed, from the scene's file to the picture's; times are medians" },
    [REPORT_PARSE] = { "parse_seconds", "s", "reading the scene; POV-Ray: the exported one, its start and its end" },
    [REPORT_PREPARE] = { "prepare_seconds", "s", "leaves and trees; triangles and trees; POV-Ray: export and bounding" },
    [REPORT_TRACE] = { "trace_seconds", "s", "rays and shading, without what they made to be prepared" },
    [REPORT_WRITE] = { "write_seconds", "s", "the picture's file, 16 bits a channel" },
    [REPORT_TOTAL] = { "total_seconds", "s", "all of it" },
    [REPORT_TOTAL_LEAST] = { "total_least", "s", "the fastest run" },
    [REPORT_TOTAL_MOST] = { "total_most", "s", "the slowest run" },
    [REPORT_PEAK_MB] = { "peak_mb", "MB", "the most memory that the process had resident" },
    [REPORT_GEOMETRY_MB] = { "geometry_mb", "MB", "leaves and their trees; vertices, triangles and their trees" },
    [REPORT_PIECES] = { "pieces", "", "leaves, or triangles" },
    [REPORT_SEEN] = { "seen", "rays", "camera rays, one a pixel, whose first hit is on a surface" },
    [REPORT_MISSED] = { "missed", "rays", "... that find no surface" },
    [REPORT_FALSE] = { "false", "rays", "rays that find a surface where there is none" },
    [REPORT_OTHER] = { "other", "rays", "rays that find another surface" },
    [REPORT_COVERAGE] = { "coverage_error", "", "missed, false and other, as a share of seen" },
    [REPORT_DEPTH_MEDIAN] = { "depth_median", "of the size", "error of the distance, where both find the same surface" },
    [REPORT_DEPTH_P99] = { "depth_p99", "of the size", "the same: 99 % of the rays are better" },
    [REPORT_DEPTH_LARGEST] = { "depth_largest", "of the size", "the same: the worst ray; beside edges maybe another sheet" },
    [REPORT_NORMAL_MEDIAN] = { "normal_median", "degrees", "angle between the normals that light sees" },
    [REPORT_NORMAL_P99] = { "normal_p99", "degrees", "the same: 99 % of the rays are better" },
    [REPORT_NORMAL_LARGEST] = { "normal_largest", "degrees", "the same: the worst ray" },
    [REPORT_RMSE] = { "picture_rmse", "", "root of the mean square difference of all channels, of the full range" },
    [REPORT_LARGEST] = { "picture_largest", "", "the largest difference of any channel, of the full range" },
    [REPORT_OVER] = { "picture_over", "", "share of the pixels that differ by more than 1/255" },
    [REPORT_SURFACES] = { "surfaces", "", "[MCFS00] Figure 8: surfaces" },
    [REPORT_TRIMS] = { "trims", "", "... trims" },
    [REPORT_RAYS] = { "rays", "", "... camera rays" },
    [REPORT_BV] = { "bv_intersections", "", "... boxes tested for them" },
    [REPORT_LIGHT_BV] = { "light_bv_intersections", "", "... and for shadow rays" },
    [REPORT_TESTS] = { "nurbs_tests", "", "... numerical surface intersections begun" },
    [REPORT_TEST_SECONDS] = { "nurbs_test_seconds", "s", "... time of one, on average; taken in a run of its own" },
    [REPORT_HITS] = { "nurbs_hits", "", "... of which converged to a root" },
    [REPORT_REPORTED] = { "reported_hits", "", "... of which were nearest so far and not trimmed away" },
    [REPORT_ITERATIONS] = { "newton_iterations", "", "... steps of Newton's method a test" },
};

/* ---- words ---- */

const char *report_sample_name(Arena *a, const ReportSample *s)
{
    const ReportMethod *m = &report_methods[s->series];
    return arena_printf(a, "%s, %s %g", m->method, m->knob, s->number[REPORT_SETTING]);
}

const char *report_build(void)
{
#ifdef __clang__
    return "trimray " TRIMRAY_VERSION " (" TRIMRAY_COMMIT "), clang " __clang_version__;
#else
    return "trimray " TRIMRAY_VERSION " (" TRIMRAY_COMMIT "), gcc " __VERSION__;
#endif
}

/* The processor's name, as Linux tells it. */
static const char *processor(Arena *a)
{
    size_t n;
    const char *text = file_read("/proc/cpuinfo", a, &n), *name = text ? strstr(text, "model name") : NULL;
    const char *colon = name ? strchr(name, ':') : NULL;
    return colon ? arena_printf(a, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2) : "processor unknown";
}

const char *report_machine(Arena *a)
{
    struct utsname u;
    return uname(&u) == 0 ? arena_printf(a, "%s, %s %s %s", processor(a), u.sysname, u.release, u.machine) : processor(a);
}

/* ---- CSV ---- */

static void write_text_field(FILE *f, const char *text)
{
    fputc('"', f);
    for (; text && *text; text++) {
        if (*text == '"') fputc('"', f);
        fputc(*text == '\n' ? ' ' : *text, f);
    }
    fputc('"', f);
}

/* The shortest form with the first 15 digits, as cJSON writes numbers. */
static void write_number(FILE *f, double x)
{
    char text[32];
    for (int digits = 6; digits <= 15; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    fputs(text, f);
}

static void write_row(FILE *f, const ReportSample *s)
{
    const ReportMethod *m = &report_methods[s->series];
    write_text_field(f, s->scene->name);
    fprintf(f, ",%s,%s", m->method, m->knob);
    for (int i = 0; i < REPORT_N_NUMBERS; i++) {
        fputc(',', f);
        if (!isnan(s->number[i])) write_number(f, s->number[i]);
    }
    fputc(',', f);
    if (s->failure) write_text_field(f, s->failure);
    fputc('\n', f);
}

bool report_write_file(const Report *r, const char *name, ReportWriter write, const void *context)
{
    char *text = NULL;
    size_t n = 0;
    FILE *f = open_memstream(&text, &n);
    if (!f) return false;
    write(f, r, context);
    bool is_good = fclose(f) == 0 && file_write(arena_printf(r->arena, "%s/%s", r->folder, name), r->arena, text, n);
    int reason = errno;
    free(text);
    errno = reason;
    return is_good;
}

static void write_csv(FILE *f, const Report *r, const void *context)
{
    (void)context;
    fputs("scene,method,knob", f);
    for (int i = 0; i < REPORT_N_NUMBERS; i++) fprintf(f, ",%s", report_columns[i].name);
    fputs(",failure\n", f);
    for (size_t i = 0; i < r->n_samples; i++)
        if (r->samples[i].is_done) write_row(f, &r->samples[i]);
}

bool report_write_csv(const Report *r) { return report_write_file(r, "report.csv", write_csv, NULL); }

/* ---- JSON ---- */

/* cJSON has no NAN: what was not measured is null. */
static cJSON *sample_json(const ReportSample *s)
{
    const ReportMethod *m = &report_methods[s->series];
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "scene", s->scene->name);
    cJSON_AddStringToObject(o, "method", m->method);
    cJSON_AddStringToObject(o, "knob", m->knob);
    for (int i = 0; i < REPORT_N_NUMBERS; i++)
        if (isnan(s->number[i])) cJSON_AddNullToObject(o, report_columns[i].name);
        else cJSON_AddNumberToObject(o, report_columns[i].name, s->number[i]);
    if (s->failure) cJSON_AddStringToObject(o, "failure", s->failure);
    return o;
}

static cJSON *columns_json(void)
{
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < REPORT_N_NUMBERS; i++) {
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", report_columns[i].name);
        cJSON_AddStringToObject(o, "unit", report_columns[i].unit);
        cJSON_AddStringToObject(o, "meaning", report_columns[i].help);
        cJSON_AddItemToArray(list, o);
    }
    return list;
}

static cJSON *scenes_json(const Report *r)
{
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < r->n_scenes; i++) {
        const ReportScene *s = &r->scenes[i];
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", s->name);
        cJSON_AddStringToObject(o, "path", s->path);
        if (s->failure) cJSON_AddStringToObject(o, "failure", s->failure);
        else cJSON_AddNumberToObject(o, "size", s->size);
        cJSON_AddItemToArray(list, o);
    }
    return list;
}

static void write_json(FILE *f, const Report *r, const void *context)
{
    (void)context;
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "command", report_command(r));
    cJSON_AddStringToObject(root, "machine", report_machine(r->arena));
    cJSON_AddStringToObject(root, "build", report_build());
    cJSON_AddNumberToObject(root, "width", r->width);
    cJSON_AddNumberToObject(root, "height", r->height);
    cJSON_AddNumberToObject(root, "threads", r->n_threads);
    cJSON_AddNumberToObject(root, "load_before", r->load);
    cJSON_AddBoolToObject(root, "interrupted", r->was_interrupted);
    cJSON *notes = cJSON_AddArrayToObject(root, "left_out");
    for (size_t i = 0; i < r->n_notes; i++) cJSON_AddItemToArray(notes, cJSON_CreateString(r->notes[i]));
    cJSON_AddItemToObject(root, "columns", columns_json());
    cJSON_AddItemToObject(root, "scenes", scenes_json(r));
    cJSON *samples = cJSON_AddArrayToObject(root, "samples");
    for (size_t i = 0; i < r->n_samples; i++)
        if (r->samples[i].is_done) cJSON_AddItemToArray(samples, sample_json(&r->samples[i]));
    char *text = cJSON_Print(root);
    if (text) fprintf(f, "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(root);
}

bool report_write_json(const Report *r) { return report_write_file(r, "report.json", write_json, NULL); }

/* ---- continuing ---- */

static const char *measured_path(const Report *r) { return arena_printf(r->arena, "%s/measured.jsonl", r->folder); }

/* All that a sample's numbers depend on. The fingerprint stands for the scene and all its files. */
static const char *key_of(const Report *r, const ReportSample *s)
{
    return arena_printf(r->arena, "%s %016llx %s %.17g %dx%d %d runs %d threads %s", s->scene->name,
                        (unsigned long long)s->scene->fingerprint, report_methods[s->series].word, s->number[REPORT_SETTING],
                        r->width, r->height, r->n_runs, r->n_threads, report_build());
}

bool report_append(const Report *r, const ReportSample *s)
{
    cJSON *o = sample_json(s);
    cJSON_AddStringToObject(o, "key", s->key);
    char *text = cJSON_PrintUnformatted(o);
    cJSON_Delete(o);
    FILE *f = fopen(measured_path(r), "a");
    bool is_good = text && f && fprintf(f, "%s\n", text) > 0;
    if (f) is_good = fclose(f) == 0 && is_good;
    cJSON_free(text);
    return is_good;
}

static void take_sample(ReportSample *s, const cJSON *o)
{
    for (int i = 0; i < REPORT_N_NUMBERS; i++) {
        const cJSON *number = cJSON_GetObjectItemCaseSensitive(o, report_columns[i].name);
        s->number[i] = cJSON_IsNumber(number) ? number->valuedouble : NAN;
    }
    s->is_done = true;
}

static bool is_as_measured(const ReportSample *s, const char *key)
{
    return s->key && strcmp(s->key, key) == 0 && access(s->picture, R_OK) == 0 && access(s->difference, R_OK) == 0;
}

/* A line that was cut short by the end of an earlier run is left alone. */
static void take_line(Report *r, const char *line)
{
    cJSON *o = cJSON_Parse(line);
    const cJSON *key = o ? cJSON_GetObjectItemCaseSensitive(o, "key") : NULL;
    for (size_t i = 0; cJSON_IsString(key) && i < r->n_samples; i++)
        if (is_as_measured(&r->samples[i], key->valuestring)) take_sample(&r->samples[i], o);
    cJSON_Delete(o);
}

const char *report_read(Report *r, const ReportScene *s)
{
    size_t n;
    for (size_t i = 0; i < r->n_samples; i++)
        if (r->samples[i].scene == s) r->samples[i].key = key_of(r, &r->samples[i]);
    errno = 0;
    char *text = file_read(measured_path(r), r->arena, &n), *rest = text;
    if (!text) return errno == ENOENT ? NULL : strerror(errno);
    for (char *line; (line = strsep(&rest, "\n")) != NULL;)
        if (*line) take_line(r, line);
    return NULL;
}
