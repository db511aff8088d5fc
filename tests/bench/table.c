/* What was measured, as Markdown. */
#include "tests/bench/run.h"

#include <string.h>

void print_preparation(const Bench *b)
{
    printf("| engine | leaves or triangles | mesh, s | preparation, s | held, MB | peak, MB |\n"
           "|---|---:|---:|---:|---:|---:|\n");
    for (int i = 0; i < b->n_engines; i++) {
        const EngineCost *c = &b->list[i].engine->cost;
        if (is_in_eights(b->list[i].kind)) continue;
        printf("| %s | ", b->list[i].name);
        if (c->n_triangles) printf("%zu | %.3f | ", c->n_triangles, c->mesh_seconds);
        else if (c->n_leaves) printf("%zu | | ", c->n_leaves);
        else printf("| | ");
        printf("%.5f | %.3f | %.3f |\n", c->prep_seconds, (double)c->held * 1e-6, (double)c->peak * 1e-6);
    }
    printf("\n");
}

static void print_counters(const Counters *c, const Speed *s, const Accuracy *a)
{
    if (c->leaf_tests == 0) {
        printf("| | | | | | |\n");
        return;
    }
    double passes = s->repeats, rays = (double)s->n * passes, tests = (double)c->leaf_tests, hits = (double)a->hits * passes;
    double boxes = (double)(c->bv_intersections + c->light_bv_intersections);
    printf("%.0f | %.2f | %.2f | %.2f | %.2f | %.2f | %.3f |\n", s->cycles_per_test, boxes / rays, tests / rays,
           tests / double_max(hits, 1), s->newton_per_hit,
           (double)c->newton_iterations / tests, (double)c->fallbacks / tests);
}

/* Passes of all engines in turns. */
static void measure_set(Bench *b, int k)
{
    const Options *o = b->options;
    const RaySet *set = &b->sets[k];
    for (Entry *e = b->list; e < b->list + b->n_engines; e++)
        e->speed[k] = speed_begin(e->engine, set, o->budget, b->answers);
    int repeats = o->repeats < 1 ? 1 : o->repeats > MAX_REPEATS ? MAX_REPEATS : o->repeats;
    for (int pass = 1; pass <= repeats; pass++)
        for (Entry *e = b->list; e < b->list + b->n_engines; e++) {
            speed_pass(&e->speed[k], e->engine, set, b->answers);
            if (pass == repeats)
                e->accuracy[k] = measure_accuracy(&b->model, set, e->speed[k].stride, b->truth[k], b->answers);
        }
    for (Entry *e = b->list; e < b->list + b->n_engines; e++) speed_end(&e->speed[k], e->engine, set);
}

static void print_row(Bench *b, int k, Entry *e)
{
    const RaySet *set = &b->sets[k];
    const Accuracy *a = &e->accuracy[k];
    Speed *s = &e->speed[k];
    const Counters *c = &e->engine->cost.counters;
    s->newton_per_hit = (double)c->nurbs_tests / double_max((double)a->hits * s->repeats, 1);
    printf("| %s | %s | %.3f | %.0f %% | %zu | %zu | %zu | %zu | ", set->name, e->name, s->rays_per_second * 1e-6,
           100 * s->spread, s->stride, a->hits, a->missed, a->wrong);
    if (set->t_max) printf("| | | ");
    else printf("%.1e | %.1e | %.1e | ", a->largest, a->rms, a->p999);
    printf("%.0f | ", s->cycles_per_ray);
    print_counters(c, s, a);
}

void print_rays(Bench *b)
{
    printf("| rays | engine | M rays/s | spread | 1/n | hits | missed | false | largest | RMS | 99.9 %% | cycles/ray "
           "| cycles/test | boxes/ray | tests/ray | tests/hit | Newton/hit | steps/test | fallbacks/test |\n"
           "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (int k = 0; k < b->n_sets; k++) {
        if (!is_listed(b->options->sets, b->sets[k].name)) continue;
        measure_set(b, k);
        for (Entry *e = b->list; e < b->list + b->n_engines; e++) print_row(b, k, e);
        fflush(stdout);
    }
    printf("\n");
}

/* ---- ratios: certain over the others, beside what is wanted ---- */

typedef struct { Kind kind; double camera, random, shadow, other, preparation, memory; } Goal;   /* 0: nothing wanted */

static const Goal goals[] = {
    { IS_MESH_P999, 1, 1.5, 1.5, 0, 100, 50 },
    { IS_MESH_RMS, 0.5, 1, 0, 0, 10, 10 },
    { IS_GRID, 0, 0, 0, 0, 0, 0 },
    { IS_PAPER, 8, 8, 8, 8, 0, 0 },
    { IS_SISL, 30, 30, 30, 30, 0, 0 },
    { IS_OCCT, 100, 100, 100, 100, 0, 0 },
};

static void print_ratio(double ratio, double wanted)
{
    if (!isfinite(ratio) || ratio <= 0) printf(" |");
    else if (wanted <= 0) printf(" %.3g |", ratio);
    else printf(" %s%.3g%s (%g) |", ratio < wanted ? "**" : "", ratio, ratio < wanted ? "**" : "", wanted);
}

static double wanted_of(const Goal *g, const char *set)
{
    if (!strcmp(set, "camera")) return g->camera;
    if (!strcmp(set, "random")) return g->random;
    return !strcmp(set, "shadow") ? g->shadow : g->other;
}

static const Goal *goal_of(Kind kind)
{
    for (size_t i = 0; i < sizeof goals / sizeof *goals; i++)
        if (goals[i].kind == kind) return &goals[i];
    return NULL;
}

void print_ratios(const Bench *b)
{
    if (b->n_engines < 2 || b->list[0].kind != IS_CERTAIN) return;
    const Entry *certain = &b->list[0];
    const EngineCost *own = &certain->engine->cost;
    printf("How many times better `certain` is than the others; in brackets what is wanted, in bold what is not reached.\n\n"
           "| against |");
    for (int k = 0; k < b->n_sets; k++) printf(" %s |", b->sets[k].name);
    printf(" preparation | memory held |\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
    for (int i = 1; i < b->n_engines; i++) {
        const Entry *e = &b->list[i];
        const Goal *g = goal_of(e->kind);
        if (!g) continue;
        printf("| %s |", e->name);
        for (int k = 0; k < b->n_sets; k++)
            print_ratio(certain->speed[k].rays_per_second / e->speed[k].rays_per_second, wanted_of(g, b->sets[k].name));
        print_ratio(e->engine->cost.prep_seconds / own->prep_seconds, g->preparation);
        print_ratio((double)e->engine->cost.held / (double)own->held, g->memory);
        printf("\n");
    }
    printf("\n");
}
