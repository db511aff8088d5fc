/* `trimray report`: error against run time. What is measured of one scene by one method at one setting, and who does what:
 *
 *   report_plan.c      which settings
 *   report_job.c       a piece of work in a process of its own
 *   report_measure.c   times, memory and counts of one setting
 *   report_mesh.c      the scene with meshes in place of its surfaces
 *   report_povray.c    POV-Ray on the exported scene
 *   report_error.c     hits of camera rays, and how they differ from the reference
 *   report_table.c     CSV, JSON, and the file from which a report is continued
 *   report_page.c      the page; report_plot.c its plots; report_text.c its style and script */
#ifndef TRIMRAY_REPORT_H
#define TRIMRAY_REPORT_H

#include "render/commands.h"

/* The numbers of a sample; NAN: not measured. Their names and meanings are in report_table.c. */
typedef enum {
    REPORT_SETTING, REPORT_IS_DEFAULT, REPORT_RUNS,
    REPORT_PARSE, REPORT_PREPARE, REPORT_TRACE, REPORT_WRITE, REPORT_TOTAL, REPORT_TOTAL_LEAST, REPORT_TOTAL_MOST,
    REPORT_PEAK_MB, REPORT_GEOMETRY_MB, REPORT_PIECES,
    REPORT_SEEN, REPORT_MISSED, REPORT_FALSE, REPORT_OTHER, REPORT_COVERAGE,
    REPORT_DEPTH_MEDIAN, REPORT_DEPTH_P99, REPORT_DEPTH_LARGEST,
    REPORT_NORMAL_MEDIAN, REPORT_NORMAL_P99, REPORT_NORMAL_LARGEST,
    REPORT_RMSE, REPORT_LARGEST, REPORT_OVER,
    REPORT_SURFACES, REPORT_TRIMS, REPORT_RAYS, REPORT_BV, REPORT_LIGHT_BV, REPORT_TESTS, REPORT_TEST_SECONDS, REPORT_HITS,
    REPORT_REPORTED, REPORT_ITERATIONS,
    REPORT_N_NUMBERS
} ReportNumber;

#define REPORT_MOST_SETTINGS 16      /* of a series */

typedef struct { const char *name, *unit, *help; } ReportColumn;
extern const ReportColumn report_columns[REPORT_N_NUMBERS];

/* A method and the knob that is turned: one line of the plots. */
typedef enum {
    REPORT_CERTAIN, REPORT_PAPER_FLATNESS, REPORT_PAPER_ITERATIONS, REPORT_MESH, REPORT_POVRAY, REPORT_N_SERIES
} ReportSeries;
typedef struct {
    const char *word;                /* in file names and keys */
    const char *method, *knob, *title;
    const double *settings, *quick_settings;   /* coarse to fine, ended by 0 */
    double default_setting;          /* what is traced when nothing is said */
} ReportMethod;
extern const ReportMethod report_methods[REPORT_N_SERIES];

typedef struct {
    const char *path;                /* as named */
    const char *name;                /* of its files in the report's folder: unique, made of letters, digits, - and _ */
    const char *failure;             /* NULL: its reference was made */
    const char *picture, *hits;      /* the reference's files */
    double size;                     /* diagonal of the box of all surfaces */
    uint64_t fingerprint;            /* of the reference: what was measured belongs to it */
} ReportScene;

typedef struct {
    const ReportScene *scene;
    ReportSeries series;
    double number[REPORT_N_NUMBERS];
    const char *failure;             /* NULL: measured */
    const char *picture, *difference;   /* files */
    const char *key;                 /* all that its numbers depend on; NULL: the reference is not made yet */
    int round;                       /* its place among the settings of its series */
    bool is_done;
} ReportSample;

typedef struct {
    const Options *options;
    Arena *arena;
    const char *folder;
    int width, height, n_runs, n_threads;
    const char *povray;              /* the program; NULL: not installed */
    double load;                     /* of the machine, before: processes that wanted a core in the last minute */
    ReportScene *scenes;
    size_t n_scenes;
    ReportSample *samples;           /* by scene, by series, coarse to fine */
    size_t n_samples, n_done;
    const char **notes;              /* what was left out */
    size_t n_notes, notes_capacity;
    bool was_interrupted;
} Report;

/* ---- report_plan.c ---- */
void report_plan(Report *r);                             /* scenes, and an empty sample for each setting */
const char *report_command(const Report *r);             /* the command line that repeats it */

/* ---- report_job.c ---- */
/* Runs work(context) in a process of its own and waits; what it leaves for us must lie in memory from report_shared. NULL,
 * or why it failed: what it said, a signal, more than `seconds`. A signal to stop ends it at once. */
const char *report_job(Arena *a, double seconds, int (*work)(void *context), void *context);
void *report_shared(size_t n_bytes);                     /* cleared; NULL: no memory. Never given back */

/* ---- report_measure.c ---- */
const char *report_reference(const Report *r, ReportScene *s, double seconds);    /* NULL, or why not: in jobs */
const char *report_measure(const Report *r, ReportSample *s, double seconds);

/* Options as they are for one scene and setting. */
Options report_options(const Report *r, const ReportScene *s, ReportSeries series, double setting);

/* ---- report_mesh.c ---- */
typedef struct { size_t n_triangles, n_vertices, n_bytes; const Shape **meshes; size_t n_meshes; } ReportMesh;
double report_scene_size(Arena *a, const Scene *s);      /* diagonal of the box of all NURBS surfaces; 0: there are none */
Scene *report_mesh_scene(Arena *a, const Scene *s, double chord_error, ReportMesh *out);
size_t report_mesh_bytes(const ReportMesh *m);           /* with their trees, after tracing */

/* ---- report_povray.c ---- */
const char *report_find_povray(Arena *a);                /* NULL: not installed */
/* Exports and traces; the picture goes to `picture` (a PNG of 16 bits), times and memory to number[]. An exit status. */
int report_trace_povray(Run *run, const char *povray, double chord_error, const char *picture, double number[]);

/* ---- report_error.c ---- */
typedef struct { double t; Vec3 normal; int64_t index; } ReportHit;   /* t INFINITY, index -1: a miss */
ReportHit *report_hits(Arena *a, const Scene *s, int width, int height);          /* of one camera ray a pixel */
bool *report_surfaces(Arena *a, const Scene *s, size_t *n);                       /* by index: is it a NURBS surface? */
void report_compare_hits(Arena *a, const ReportHit *truth, const ReportHit *found, size_t n_rays, const bool *is_surface,
                         double size, double number[]);

/* ---- report_table.c ---- */
/* Takes what was measured before of a scene whose reference is made. NULL, or what is wrong. */
const char *report_read(Report *r, const ReportScene *s);
bool report_append(const Report *r, const ReportSample *s);
/* Writes what `write` makes into a file of the report's folder; false: errno says why, as below. */
typedef void (*ReportWriter)(FILE *f, const Report *r, const void *context);
bool report_write_file(const Report *r, const char *name, ReportWriter write, const void *context);
bool report_write_csv(const Report *r);
bool report_write_json(const Report *r);
const char *report_sample_name(Arena *a, const ReportSample *s);   /* "mesh, chord error 0.001" */
const char *report_machine(Arena *a);
const char *report_build(void);                          /* "trimray 0.1 (commit), compiler" */

/* ---- report_page.c, report_plot.c, report_text.c ---- */
bool report_write_page(const Report *r);
bool report_write_plots(const Report *r);                /* each also as an SVG file of its own */
typedef struct { ReportNumber x, y; const char *title, *x_title, *y_title; } ReportPlot;
/* is_file: with its style, to stand alone. */
void report_plot(FILE *f, const Report *r, const ReportScene *s, const ReportPlot *p, bool is_file);
void report_escape(FILE *f, const char *text);           /* for HTML */
extern const char *const report_style[], *const report_script[];   /* lines, ended by NULL */

#endif
