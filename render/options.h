/* The command line: POV-Ray's switches (+W640 -D), its INI keys (Width=640) and long options (--width 640) are three
 * spellings of one table, from which --help is printed as well. */
#ifndef TRIMRAY_OPTIONS_H
#define TRIMRAY_OPTIONS_H

#include "parser/parser.h"
#include "render/antialias.h"

#include <stdio.h>

typedef enum {   /* bits, for the table */
    COMMAND_RENDER = 1, COMMAND_CHECK = 2, COMMAND_SHOOT = 4, COMMAND_EXPORT = 8, COMMAND_COMPARE = 16, COMMAND_REPORT = 32
} Command;

typedef struct {
    Command command;
    bool wants_help, wants_version;
    const char *input;               /* the scene; NULL: none named */
    const char *other;               /* compare: the second picture */
    const char **inputs;             /* report: all scenes */
    size_t n_inputs, inputs_capacity;
    const char *output;              /* NULL: not named; "-": the standard output */
    bool no_output;                  /* -F: nothing is written */
    int width, height;
    int bits;                        /* a channel: 8 or 16 */
    bool alpha;
    int n_threads;                   /* 0: all cores */
    int quality;
    bool antialias_on, jitter_on;    /* +A, -J */
    Antialias antialias;             /* as it is when it is on; jitter: when that is on */
    int block_size;
    double start_column, end_column, start_row, end_row;   /* as POV-Ray reads +SC +EC +SR +ER; 0: not given */
    double clock, version;
    bool clock_on;
    const char **library_paths;
    size_t n_library_paths, library_paths_capacity;
    ParseDeclare *declares;
    size_t n_declares, declares_capacity;
    NurbsOptions nurbs;
    int max_steps;                  /* rounds of loops and calls of macros before giving up; 0: the parser's limit */
    const char *stats;               /* a JSON file for the statistics; NULL: none */
    double chord_error;              /* export; 0: by the scene's size */
    const char *diff;                /* compare: a picture of the differences; NULL: none */
    double within, share;            /* compare: steps of 1/255, share of the pixels */
    const char *rays;                /* shoot: the file of rays */
    bool is_quick;                   /* report */
    int n_runs;                      /* report: of each setting; 0: chosen */
    bool is_verbose, is_quiet;
    const char *error;               /* set when options_read returned false: what is wrong, in one line */
    int n_inis;                      /* INI files that are being read, one from within another */
    Arena *arena;                    /* borrowed: texts lie here or in argv */
} Options;

/* Reads the arguments after the program's name; later settings win. False: o->error says what is wrong. */
bool options_read(int argc, char *const argv[], Arena *a, Options *o);
void options_print_help(FILE *out);

/* The part of the picture to render along one side of n pixels: [*first, *end). from and to are columns or rows counted
 * from 1, or fractions; 0: not given. False: it is empty or not within the picture. */
bool options_crop(double from, double to, int n, int *first, int *end);

#endif
