/* What the parts of the benchmark share: models, rays, engines, and what is measured of them. See bench.c. */
#ifndef TRIMRAY_BENCH_H
#define TRIMRAY_BENCH_H

#include "nurbs/nurbs.h"
#include "render/shape.h"
#include "tests/stress/form.h"
#include "tests/test.h"

/* ---- models ---- */

typedef struct {
    const char *name;
    Arena *arena;
    const SurfaceDesc *surfaces;
    int n;
    Box box;                     /* of the control points */
    Vec3 centre;
    double diagonal;             /* of the box: depth errors are relative to it */
    Vec3 light;
    const Form *form;            /* the closed form, in the model's own coordinates; NULL: none */
} Model;

/* The model of this name, in the arena; false: there is none, or its scene cannot be read (a message is on stderr).
 * Names: sphere, torus, teapot, sheet, order8, field-N (N a square), trims-N (N pieces in all). */
bool model_make(Arena *a, const char *name, Model *out);

/* The net of a bicubic patch S: 16 points of S at thirds of the domain determine it. */
typedef Vec3 (*BicubicAt)(const void *context, double u, double v);
SurfaceDesc bicubic_through(Arena *a, BicubicAt at, const void *context);

/* model_teapot.c: the patches of scenes/teapot.inc, read by the parser. */
bool model_teapot(Arena *a, Model *m);

/* ---- rays ---- */

typedef struct {
    const char *name;
    Ray *rays;                   /* unit directions */
    double *t_max;               /* any hit before it is asked for; NULL: the nearest hit */
    bool is_coherent;            /* neighbours have about the same way */
    size_t n;
} RaySet;

RaySet rays_camera(const Model *m, Arena *a, int size);              /* size x size pixels, row by row */
RaySet rays_random(const Model *m, Arena *a, size_t n);              /* through the box */
RaySet rays_shadow(const Model *m, Arena *a, const RaySet *camera, const double *t);   /* from its hits to the light */
RaySet rays_grazing(const Model *m, Arena *a, size_t n);             /* tangents, moved by up to 1e-5 of the diagonal */
RaySet rays_borders(const Model *m, Arena *a, size_t n);             /* through points on knot lines */

/* ---- engines ---- */

typedef struct {
    const Model *model;
    NurbsMethod method;          /* trimray */
    const struct Mesh *mesh;     /* Embree (mesh.h) */
    bool is_robust;
    int grid_steps;
} EngineInput;

typedef struct {
    double prep_seconds, mesh_seconds;   /* building; making the mesh that is built from */
    size_t held, peak;           /* bytes, after and during preparation; without the mesh that was given */
    size_t n_triangles;          /* 0: no mesh */
    size_t n_leaves;             /* of trimray's own tree */
    Counters counters;           /* since it was built or measured */
} EngineCost;

typedef struct Engine Engine;
struct Engine {
    /* Every stride-th ray of the set: t[0], t[1], ...: the depth, INFINITY for a miss; with t_max: 0 blocked, INFINITY
     * free. */
    void (*shoot)(Engine *e, const RaySet *set, size_t stride, double *t);
    /* The same, eight rays together, one after the other in the set. NULL: it has none. */
    void (*shoot_eights)(Engine *e, const RaySet *set, size_t stride, double *t);
    /* The same; seconds of all leaf tests, and how many they were. NULL: it has none. */
    double (*test_seconds)(Engine *e, const RaySet *set, size_t stride, double *t, uint64_t *n_tests);
    void (*release)(Engine *e);
    EngineCost cost;
};

/* `e`, whose rays go in eights. NULL: it is NULL, or has none. It does not own e. */
Engine *engine_in_eights(Engine *e);

/* NULL: this engine cannot do the model (or is not compiled in). */
Engine *engine_trimray(const EngineInput *in);
Engine *engine_embree(const EngineInput *in);
Engine *engine_embree_grid(const EngineInput *in);
Engine *engine_sisl(const EngineInput *in);
Engine *engine_occt(const EngineInput *in);

/* ---- memory: what malloc holds, counted by replacing it ---- */

size_t memory_now(void);
size_t memory_peak(void);            /* since the last reset */
void memory_reset_peak(void);

/* ---- measures ---- */

enum { MAX_REPEATS = 15 };

typedef struct {
    double seconds[MAX_REPEATS]; /* of each pass */
    double rays_per_second, spread;
    size_t n, stride;            /* rays of a pass */
    int repeats;                 /* passes made */
    double cycles_per_ray, cycles_per_test;   /* the latter 0: not known */
    double newton_per_hit;       /* numerical intersections begun, over hits reported */
} Speed;

/* The speed is the median of some passes, MAX_REPEATS at most; spread: (slowest - fastest) / median. Engines that are to be
 * compared make theirs in turns, since a machine's speed changes while one is measured. Slow engines get every stride-th
 * ray, so that a pass takes about `budget` seconds. t has room for set->n; it gets the answers. */
Speed speed_begin(Engine *e, const RaySet *set, double budget, double *t);
void speed_pass(Speed *s, Engine *e, const RaySet *set, double *t);
void speed_end(Speed *s, Engine *e, const RaySet *set);

typedef struct { size_t hits, missed, wrong; double largest, rms, p999; } Accuracy;

/* A hit farther than the true one by more than this share of the diagonal is a miss (of the right sheet), a nearer one is
 * false; neither counts in the depth errors. */
#define OTHER_SHEET 1e-2
Accuracy measure_accuracy(const Model *m, const RaySet *set, size_t stride, const double *truth, const double *t);

/* Seconds of the processor that this process has had: other load on the machine does not count. One thread: wall time. */
double processor_now(void);

double cycles_per_second(void);      /* of the counter behind cycles_now */
static inline uint64_t cycles_now(void)
{
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return (uint64_t)(stats_now() * 1e9);
#endif
}

#endif
