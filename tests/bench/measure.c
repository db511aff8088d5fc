/* Time and error of an engine's answers. */
#include "tests/bench/bench.h"

#include <string.h>
#include <time.h>

enum { FEW_RAYS = 48, PROBE_RAYS = 512 };

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double cycles_per_second(void)
{
    static double rate;
    if (rate > 0) return rate;
    double begin = stats_now(), end;
    uint64_t cycles = cycles_now();
    while ((end = stats_now()) < begin + 0.05) {}
    return rate = (double)(cycles_now() - cycles) / (end - begin);
}

double processor_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double pass_seconds(Engine *e, const RaySet *set, size_t stride, double *t)
{
    double begin = processor_now();
    e->shoot(e, set, stride, t);
    return processor_now() - begin;
}

/* Average seconds of a leaf test, by the wall's clock, which other load disturbs: hence in chunks, the best of three for
 * each. */
static double test_seconds(Engine *e, const RaySet *set, size_t stride)
{
    enum { CHUNK = 256 };
    double seconds = 0, t[CHUNK];
    uint64_t tests = 0;
    for (size_t i = 0; i < set->n; i += CHUNK * stride) {
        RaySet chunk = { .name = set->name, .rays = set->rays + i, .t_max = set->t_max ? set->t_max + i : NULL };
        chunk.n = set->n - i < CHUNK * stride ? set->n - i : CHUNK * stride;
        double best = INFINITY;
        uint64_t n_tests = 0;
        for (int k = 0; k < 3; k++) best = double_min(best, e->test_seconds(e, &chunk, stride, t, &n_tests));
        seconds += best, tests += n_tests;
    }
    return tests > 0 ? seconds / (double)tests : 0;
}

Speed speed_begin(Engine *e, const RaySet *set, double budget, double *t)
{
    Speed s = { .stride = 1 };
    memset(&e->cost.counters, 0, sizeof e->cost.counters);
    if (set->n == 0) return s;
    size_t few = set->n / FEW_RAYS + 1, probe = set->n / PROBE_RAYS + 1;
    e->shoot(e, set, few, t);     /* takes the set, warms up */
    if (pass_seconds(e, set, few, t) * PROBE_RAYS > budget * FEW_RAYS) probe = few;    /* some take hours for all */
    double guess = pass_seconds(e, set, probe, t), again = pass_seconds(e, set, probe, t);    /* what is lazy is made once */
    guess = double_min(guess, again) * (double)probe;
    if (guess > budget) s.stride = (size_t)ceil(guess / budget);
    if (s.stride > probe) s.stride = probe;
    s.n = (set->n + s.stride - 1) / s.stride;
    memset(&e->cost.counters, 0, sizeof e->cost.counters);
    return s;
}

void speed_pass(Speed *s, Engine *e, const RaySet *set, double *t)
{
    if (set->n > 0 && s->repeats < MAX_REPEATS) s->seconds[s->repeats++] = pass_seconds(e, set, s->stride, t);
}

void speed_end(Speed *s, Engine *e, const RaySet *set)
{
    if (s->repeats == 0) return;
    qsort(s->seconds, (size_t)s->repeats, sizeof *s->seconds, by_size);
    double median = s->seconds[s->repeats / 2];
    s->rays_per_second = (double)s->n / median;
    s->spread = (s->seconds[s->repeats - 1] - s->seconds[0]) / median;
    s->cycles_per_ray = cycles_per_second() / s->rays_per_second;
    Counters counted = e->cost.counters;
    if (e->test_seconds) s->cycles_per_test = cycles_per_second() * test_seconds(e, set, s->stride);
    e->cost.counters = counted;
}

Accuracy measure_accuracy(const Model *m, const RaySet *set, size_t stride, const double *truth, const double *t)
{
    Accuracy a = { 0 };
    double *errors = malloc((set->n + 1) * sizeof *errors), sum = 0;
    size_t n = 0;
    for (size_t i = 0, k = 0; i < set->n; i += stride, k++) {
        bool is_hit = isfinite(t[k]), is_true = isfinite(truth[i]);
        double error = is_hit && is_true ? (t[k] - truth[i]) / m->diagonal : 0;
        a.hits += is_hit;
        a.missed += is_true && (!is_hit || error > OTHER_SHEET);
        a.wrong += is_hit && (!is_true || error < -OTHER_SHEET);
        if (is_hit && is_true && fabs(error) <= OTHER_SHEET) errors[n++] = fabs(error), sum += error * error;
    }
    qsort(errors, n, sizeof *errors, by_size);
    if (n > 0 && !set->t_max) {
        a.largest = errors[n - 1], a.p999 = errors[(size_t)((double)(n - 1) * 0.999)];
        a.rms = sqrt(sum / (double)n);
    }
    free(errors);
    return a;
}
