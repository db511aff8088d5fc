/* An engine whose rays go in eights, measured beside the same whose rays go one by one. */
#include "tests/bench/bench.h"

typedef struct { Engine engine, *of; } InEights;

static void shoot_eights(Engine *engine, const RaySet *set, size_t stride, double *t)
{
    Engine *of = ((InEights *)engine)->of;
    Counters one_by_one = of->cost.counters;
    of->cost.counters = engine->cost.counters;
    of->shoot_eights(of, set, stride, t);
    engine->cost.counters = of->cost.counters, of->cost.counters = one_by_one;
}

static void release(Engine *engine)
{
    free(engine);
}

Engine *engine_in_eights(Engine *of)
{
    if (!of || !of->shoot_eights) return NULL;
    InEights *e = calloc(1, sizeof *e);
    e->engine = (Engine){ .shoot = shoot_eights, .release = release, .cost = of->cost };
    e->of = of;
    return &e->engine;
}
