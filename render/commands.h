/* The subcommands, and what they share: a scene that is read, what it cost, how the command ended. */
#ifndef TRIMRAY_COMMANDS_H
#define TRIMRAY_COMMANDS_H

#include "render/interrupt.h"
#include "render/options.h"

/* Exit status of the program, beside EXIT_INTERRUPTED. */
enum { EXIT_DONE = 0, EXIT_INPUT = 1, EXIT_USAGE = 2, EXIT_FILE = 3 };

typedef struct {
    const Options *options;          /* borrowed */
    Arena *arena;
    const char *path;                /* of the scene, as found */
    Scene *scene;                    /* prepared: ready to be traced */
    ParseSummary summary;
    double parse_seconds, prep_seconds, trace_seconds, write_seconds;   /* prep: without what rays made shapes prepare */
    int n_threads;
    Counters counters;
    bool was_traced, was_interrupted;
} Run;

/* Reads and prepares the scene; says what is wrong with it. Returns an exit status: unless it is EXIT_DONE the command
 * ends. */
int run_begin(Run *run, const Options *o);
/* Writes the statistics, if asked for and if the command got as far as tracing, and frees everything. Returns the exit
 * status of the command: `status`, unless that was EXIT_DONE and something went wrong or the run was interrupted. */
int run_end(Run *run, int status);
/* Tells of an error that has no place in a source: "trimray: error: ..."; returns `status`. */
int run_fail(int status, const char *format, ...) __attribute__((format(printf, 2, 3)));
int run_thread_count(const Options *o);     /* that asked for, or the cores that this process may use */

int cmd_render(const Options *o);
int cmd_check(const Options *o);
int cmd_shoot(const Options *o);
int cmd_export(const Options *o);
int cmd_compare(const Options *o);
int cmd_report(const Options *o);

#endif
