/* Embree's levels: the coarsest meshes whose depth error on the random rays is under 1e-5 of the diagonal, by RMS and for
 * 99.9 % of the hits. The error falls with the chord error, and with the square of the steps of a grid: from one level
 * the next is guessed, and tried. */
#include "tests/bench/mesh.h"
#include "tests/bench/run.h"

#define WANTED 1e-5
#define AIM (0.9 * WANTED)       /* a little finer than the guess, so that it is not missed by a hair */

enum { RANDOM_SET = 1 };

static Accuracy try_engine(Bench *b, Engine *e)
{
    const RaySet *set = &b->sets[RANDOM_SET];
    e->shoot(e, set, 1, b->answers);
    return measure_accuracy(&b->model, set, 1, b->truth[RANDOM_SET], b->answers);
}

/* What to multiply the chord error with to get from an error to the one that is wanted. */
static double finer(double error) { return error > 0 ? double_max(0.01, double_min(0.7, AIM / error)) : 0.5; }

static void add_level(Bench *b, Kind kind, const char *label, Engine *robust, const Mesh *mesh)
{
    char name[48];
    snprintf(name, sizeof name, "Embree robust, %s < 1e-5", label);
    add_entry(b, kind, name, robust);
    if (kind == IS_MESH_P999) {
        snprintf(name, sizeof name, "Embree robust, %s < 1e-5, in eights", label);
        add_entry(b, IS_MESH_EIGHTS, name, engine_in_eights(robust));
    }
    snprintf(name, sizeof name, "Embree, %s < 1e-5", label);
    add_entry(b, IS_OTHER, name, engine_embree(&(EngineInput){ .model = &b->model, .mesh = mesh }));
}

static void say_none(Bench *b)
{
    snprintf(b->notes, sizeof b->notes,
             "No mesh of at most %zu million triangles has 99.9 %% of the depth errors under 1e-5.",
             b->options->max_triangles / 1000000);
}

static void add_triangles(Bench *b)
{
    double chord = 1e-4;
    bool has_rms = false, has_p999 = false;
    while (!has_p999) {
        Arena *a = arena_new();
        Mesh mesh = mesh_make(a, &b->model, chord * b->model.diagonal);
        Engine *e = engine_embree(&(EngineInput){ .model = &b->model, .mesh = &mesh, .is_robust = true });
        Accuracy error = try_engine(b, e);
        fprintf(stderr, "bench: %s: chord error %.1e: %zu triangles, mesh %.2f s, build %.2f s, RMS %.1e, 99.9 %% %.1e\n",
                b->model.name, chord, mesh.n_triangles, mesh.seconds, e->cost.prep_seconds, error.rms, error.p999);
        bool is_rms = !has_rms && error.rms < WANTED;
        has_p999 = error.p999 < WANTED;
        if (is_rms || has_p999) add_level(b, has_p999 ? IS_MESH_P999 : IS_MESH_RMS, has_p999 ? "99.9 %" : "RMS", e, &mesh);
        else e->release(e);
        has_rms = has_rms || is_rms;
        double step = finer(has_rms ? error.p999 : error.rms);
        bool is_too_large = (double)mesh.n_triangles / step > (double)b->options->max_triangles;
        chord *= step;
        arena_free(a);
        if (is_too_large && !has_p999) {
            say_none(b);
            return;
        }
    }
}

static void add_grids(Bench *b)
{
    for (int steps = 32;;) {
        EngineInput in = { .model = &b->model, .grid_steps = steps, .is_robust = true };
        Engine *e = engine_embree_grid(&in);
        if (!e) return;
        Accuracy error = try_engine(b, e);
        if (error.p999 < WANTED) {
            add_entry(b, IS_GRID, "Embree grid robust, 99.9 % < 1e-5", e);
            return;
        }
        double step = finer(error.p999), n = (double)e->cost.n_triangles;
        e->release(e);
        if (n / step > (double)b->options->max_triangles) return;
        steps = (int)ceil(steps / sqrt(step));
    }
}

void add_meshes(Bench *b)
{
    EngineInput none = { .model = &b->model };
    Engine *there = engine_embree(&none);
    if (!there) return;
    there->release(there);
    add_triangles(b);
    add_grids(b);
}
