/* One model's run: its rays, its engines, what came out. Used by bench.c, contest.c and table.c. */
#ifndef TRIMRAY_BENCH_RUN_H
#define TRIMRAY_BENCH_RUN_H

#include "tests/bench/bench.h"

enum { MAX_SETS = 5, MAX_ENGINES = 12 };

typedef struct {
    const char *models, *engines, *sets;   /* names, separated by commas */
    int size, repeats;
    size_t rays, max_triangles;
    double budget;
} Options;

typedef enum {
    IS_CERTAIN, IS_PAPER, IS_MESH_RMS, IS_MESH_P999, IS_GRID, IS_SISL, IS_OCCT, IS_EIGHTS, IS_MESH_EIGHTS, IS_OTHER
} Kind;

typedef struct {
    Kind kind;
    char name[48];
    Engine *engine;
    Speed speed[MAX_SETS];
    Accuracy accuracy[MAX_SETS];
} Entry;

typedef struct {
    const Options *options;
    Model model;
    RaySet sets[MAX_SETS];
    double *truth[MAX_SETS];
    int n_sets;
    double *answers;             /* room for those of any set */
    Entry list[MAX_ENGINES];
    int n_engines;
    char notes[1024];            /* what there is to say about the model */
} Bench;

/* The same engine as another, with its cost. */
static inline bool is_in_eights(Kind k) { return k == IS_EIGHTS || k == IS_MESH_EIGHTS; }

bool is_listed(const char *list, const char *name);
void add_entry(Bench *b, Kind kind, const char *name, Engine *e);      /* e may be NULL */

/* levels.c: Embree on meshes that are just fine enough. */
void add_meshes(Bench *b);

/* table.c */
void print_preparation(const Bench *b);
void print_rays(Bench *b);       /* measures, too */
void print_ratios(const Bench *b);

/* summary.c: all models side by side. */
void summary_add(const Bench *b);
void print_summary(void);

#endif
