/* trimray's own two methods, through render/shape.h. */
#include "tests/bench/bench.h"

#include "render/bunch.h"
#include "render/shapes.h"

typedef struct {
    Engine engine;
    Arena *arena;
    Shape **parts;
    int n;
    Shape *whole;
    Trace trace;
} Trimray;

static void trimray_shoot(Engine *engine, const RaySet *set, size_t stride, double *t)
{
    Trimray *e = (Trimray *)engine;
    e->trace.counters = engine->cost.counters;
    e->trace.is_shadow_ray = set->t_max != NULL;
    Hit best;
    for (size_t i = 0; i < set->n; i += stride, t++) {
        e->trace.seed = i + 1;
        if (set->t_max) {
            *t = shape_blocks(e->whole, &set->rays[i], set->t_max[i], &e->trace) ? 0 : INFINITY;
        } else {
            best.t = INFINITY;
            shape_hit(e->whole, &set->rays[i], &best, &e->trace);
            *t = best.t;
        }
    }
    engine->cost.counters = e->trace.counters;
}

typedef struct {
    RayBunch b;
    BunchLane lane[BUNCH_WIDTH];
    double t_max[BUNCH_WIDTH];
    Hit best[BUNCH_WIDTH];
} Bunch;

static void set_ray(Bunch *k, const RaySet *set, size_t i)
{
    int n = k->b.n++;
    k->b.ray[n] = set->rays[i];
    k->lane[n] = (BunchLane){ .seed = i + 1 };
    k->best[n].t = INFINITY;
    if (set->t_max) k->t_max[n] = set->t_max[i];
}

static double *shoot_bunch(Trimray *e, Bunch *k, bool any, double *t)
{
    Lanes all = bunch_all(&k->b);
    bunch_set_lanes(&k->b);
    if (any) {
        Lanes blocked = shape_blocks_bunch(e->whole, &k->b, all, k->t_max, &e->trace);
        for (int i = 0; i < k->b.n; i++) *t++ = blocked >> i & 1 ? 0 : INFINITY;
    } else {
        shape_hit_bunch(e->whole, &k->b, all, k->best, &e->trace);
        for (int i = 0; i < k->b.n; i++) *t++ = k->best[i].t;
    }
    return t;
}

static void trimray_shoot_eights(Engine *engine, const RaySet *set, size_t stride, double *t)
{
    Trimray *e = (Trimray *)engine;
    Bunch k;
    e->trace.counters = engine->cost.counters;
    e->trace.is_shadow_ray = set->t_max != NULL;
    k.b.lane = k.lane;
    for (size_t i = 0; i < set->n; ) {
        for (k.b.n = 0; i < set->n && k.b.n < BUNCH_WIDTH; i += stride) set_ray(&k, set, i);
        t = shoot_bunch(e, &k, set->t_max != NULL, t);
    }
    engine->cost.counters = e->trace.counters;
}

/* What two readings of the clock one after the other are apart: the best of some averages. */
static double clock_seconds(void)
{
    enum { READINGS = 1000, AVERAGES = 20 };
    double best = INFINITY;
    for (int k = 0; k < AVERAGES; k++) {
        double sum = 0;
        for (int i = 0; i < READINGS; i++) sum -= stats_now(), sum += stats_now();
        best = double_min(best, sum / READINGS);
    }
    return best;
}

static double trimray_test_seconds(Engine *engine, const RaySet *set, size_t stride, double *t, uint64_t *n_tests)
{
    static double reading = -1;
    Trimray *e = (Trimray *)engine;
    if (reading < 0) reading = clock_seconds();
    engine->cost.counters = (Counters){ 0 };
    e->trace.measures_time = true;
    trimray_shoot(engine, set, stride, t);
    e->trace.measures_time = false;
    const Counters *c = &engine->cost.counters;
    *n_tests = c->leaf_tests;
    return c->nurbs_seconds - (double)c->leaf_tests * reading;
}

static void trimray_release(Engine *engine)
{
    Trimray *e = (Trimray *)engine;
    for (int i = 0; i < e->n; i++) shape_release(e->parts[i]);
    if (e->n > 1) shape_release(e->whole);
    arena_free(e->trace.scratch);
    arena_free(e->arena);
    free(e);
}

static bool make_parts(Trimray *e, const EngineInput *in)
{
    NurbsError error;
    e->parts = ARENA_ARRAY(e->arena, Shape *, in->model->n);
    for (e->n = 0; e->n < in->model->n; e->n++) {
        Shape *s = nurbs_shape_new(e->arena, &in->model->surfaces[e->n], &(NurbsOptions){ .method = in->method }, &error,
                                   NULL, 0, NULL);
        if (!s) {
            fprintf(stderr, "bench: surface %d of %s is refused: code %d, index %d, value %g\n", e->n, in->model->name,
                    error.code, error.index, error.value);
            return false;
        }
        e->parts[e->n] = s;
    }
    return true;
}

static size_t count_leaves(const Trimray *e)
{
    size_t n = 0;
    NurbsInfo info;
    for (int i = 0; i < e->n; i++)
        if (nurbs_shape_info(e->parts[i], &info)) n += (size_t)info.n_leaves;
    return n;
}

static Trimray *build(const EngineInput *in)
{
    Trimray *e = calloc(1, sizeof *e);
    size_t before = memory_now();
    memory_reset_peak();
    double begin = processor_now();
    e->engine = (Engine){ .shoot = trimray_shoot, .shoot_eights = trimray_shoot_eights,
                          .test_seconds = trimray_test_seconds, .release = trimray_release };
    e->arena = arena_new(), e->trace.scratch = arena_new();
    if (!make_parts(e, in)) {
        e->n = 0;
        trimray_release(&e->engine);
        return NULL;
    }
    e->whole = e->n == 1 ? e->parts[0] : union_new(e->arena, e->parts, (uint32_t)e->n);
    shape_prepare(e->whole, &e->trace);
    for (int i = 0; i < e->n; i++) shape_prepare(e->parts[i], &e->trace);
    EngineCost *cost = &e->engine.cost;
    cost->prep_seconds = processor_now() - begin;
    cost->held = memory_now() - before, cost->peak = memory_peak() - before;
    cost->n_leaves = count_leaves(e);
    return e;
}

Engine *engine_trimray(const EngineInput *in)
{
    Trimray *e = build(in);
    if (!e) return NULL;
    double best = e->engine.cost.prep_seconds;
    for (int i = 0; i < 4 && best < 0.1; i++) {   /* what is short is built again: the first time pays for new pages */
        Trimray *again = build(in);
        best = double_min(best, again->engine.cost.prep_seconds);
        trimray_release(&again->engine);
    }
    e->engine.cost.prep_seconds = best;
    return &e->engine;
}
