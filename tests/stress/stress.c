/* Runs the families of stress and prints what each method misses, as tables in Markdown.
 *
 *   stress [--rays N] [--family NAME] [--seed S] [--knobs] [--hits] [--failures DIR] [--of METHOD]
 *
 * N rays for each family and each value of its knob; --knobs prints a row for each of these; --failures writes the first
 * surfaces and rays that a method (`certain`, if no other is named) gets wrong into files, slow ones too. The exit status
 * is 1 if `certain` got one wrong: missed, false, t wrong by more than 1e-12 outside the band (truth.h says what that is), or a
 * root that is not found just once among all hits. With --hits only the first two count: what remains of the others is known
 * (weights of ratio 1e9 and collapsed patches; poles, cusps and tangents), and the table shows it. */
#include "tests/stress/family.h"
#include "tests/stress/judge.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

enum { SHORT_RAYS = 800, RAYS_PER_MODEL = 100, FAILURES_PER_FAMILY = 5, PATIENCE = 20 /* seconds for one ray */ };
#define SLOW 0.01   /* seconds: such rays are reported among the failures, though they count as right */

typedef struct {
    long rays;
    const char *family, *failures;
    uint64_t seed;
    bool by_knob, only_hits;
    int method;                  /* whose failures are written */
} Options;

/* What is being shot, for the watchdog: a ray that never ends is a failure like the others. */
static struct { const Family *family; double knob; const Model *model; const Ray *ray; const Truth *truth; } now;

static void bark(int signal_number)
{
    (void)signal_number;   /* not safe in a signal handler, strictly; the program ends here anyway */
    printf("\nstress: family %s, knob %g: a ray takes more than %d s\n", now.family->name, now.knob, PATIENCE);
    judge_report(stdout, now.model, now.ray, now.truth, (Verdict){ .judgement = JUDGED_MISSED });
    fflush(stdout);
    _exit(1);
}

static const char *const method_name[N_METHODS] = { "paper", "certain" };

typedef struct { int wrong, slow; } Reported;

static void report_failure(const Options *o, const Family *f, double knob, Reported *count, const Model *m, const Ray *r,
                           const Truth *truth, Verdict v)
{
    bool is_slow = v.judgement <= JUDGED_IN_BAND;
    int n = is_slow ? ++count->slow : ++count->wrong;
    if (!o->failures || n > FAILURES_PER_FAMILY) return;
    char path[1024];
    snprintf(path, sizeof path, "%s/%s-%g-%s%d.c", o->failures, f->name, knob, is_slow ? "slow-" : "", n);
    for (char *c = path + strlen(o->failures); *c; c++)
        if (*c == ' ') *c = '-';
    FILE *to = fopen(path, "w");
    if (!to) return;
    judge_report(to, m, r, truth, v);
    fclose(to);
}

/* From before all roots, or from between two of them. */
static void choose_start(Ray *r, const Truth *truth, TestRandom *random)
{
    int i = test_int(random, 0, 7);
    if (i + 1 >= truth->n) return;
    double t = (double)((truth->root[i].hi + truth->root[i + 1].lo) / 2);
    if (t > 0 && isfinite(t)) r->t_min = t;
}

static void run_model(const Options *o, const Family *f, double knob, const Model *m, int rays, TestRandom *random,
                      Row rows[N_METHODS], Reported *failures)
{
    Trace trace;
    memset(&trace, 0, sizeof trace);
    trace.scratch = arena_new();
    for (int i = 0; i < rays; i++) {
        Ray r = f->ray(m, knob, random);
        Truth truth;
        model_truth(m, &r, &truth);
        choose_start(&r, &truth, random);
        trace.seed = test_bits(random);
        now.family = f, now.knob = knob, now.model = m, now.ray = &r, now.truth = &truth;
        alarm(PATIENCE);
        for (int method = 0; method < N_METHODS; method++) {
            Verdict v = judge_ray(m, method, &r, &truth, &trace, &rows[method]);
            if (method == o->method && (v.judgement > JUDGED_IN_BAND || v.seconds > SLOW))
                report_failure(o, f, knob, failures, m, &r, &truth, v);
        }
    }
    alarm(0);
    arena_free(trace.scratch);
}

static void run_knob(const Options *o, const Family *f, int which, Row rows[N_METHODS])
{
    TestRandom random = test_random(o->seed * 1000003 + (uint64_t)which);
    for (const char *c = f->name; *c; c++) random.state = random.state * 31 + (uint64_t)*c;
    Reported failures = { 0, 0 };
    for (long left = (long)(o->rays * f->share); left > 0; left -= RAYS_PER_MODEL) {
        Arena *a = arena_new();
        Model m = f->build(a, f->values[which], &random);
        run_model(o, f, f->values[which], &m, (int)(left < RAYS_PER_MODEL ? left : RAYS_PER_MODEL), &random, rows,
                  &failures);
        for (int i = 0; i < N_METHODS; i++) shape_release(m.shape[i]);
        if (m.release) m.release(&m);
        arena_free(a);
    }
}

static void print_row(const char *name, const char *knob, int method, const Row *r)
{
    printf("| %s | %s | %s | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %.1e | %.2f %% | %.0f | %.0f |\n", name, knob,
           method_name[method], (unsigned long long)r->rays, (unsigned long long)r->hits, (unsigned long long)r->in_band,
           (unsigned long long)r->missed, (unsigned long long)r->false_hits, (unsigned long long)r->inexact,
           (unsigned long long)r->not_once, r->worst,
           r->tests ? 100.0 * (double)r->fallbacks / (double)r->tests : 0, r->rays ? 1e9 * r->seconds / (double)r->rays : 0,
           1e6 * r->slowest);
    fflush(stdout);
}

static void run_family(const Options *o, const Family *f, Row total[N_METHODS])
{
    Row sum[N_METHODS] = { 0 };
    for (int i = 0; i < f->n; i++) {
        Row rows[N_METHODS] = { 0 };
        run_knob(o, f, i, rows);
        char knob[64];
        snprintf(knob, sizeof knob, "%s %g", f->knob, f->values[i]);
        for (int method = 0; method < N_METHODS; method++) {
            if (o->by_knob) print_row(f->name, knob, method, &rows[method]);
            row_add(&sum[method], &rows[method]);
        }
    }
    for (int method = 0; method < N_METHODS; method++) {
        char knob[80];
        snprintf(knob, sizeof knob, "%s: %g … %g", f->knob, f->values[0], f->values[f->n - 1]);
        if (!o->by_knob) print_row(f->name, knob, method, &sum[method]);
        row_add(&total[method], &sum[method]);
    }
}

static void run_families(const Options *o, const Family *list, int n, Row total[N_METHODS])
{
    for (int i = 0; i < n; i++)
        if (!o->family || !strcmp(o->family, list[i].name)) run_family(o, &list[i], total);
}

static bool read_options(int argc, char **argv, Options *o)
{
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (!strcmp(argv[i], "--knobs")) {
            o->by_knob = true;
            continue;
        }
        if (!strcmp(argv[i], "--hits")) {
            o->only_hits = true;
            continue;
        }
        if (!value) return false;
        if (!strcmp(argv[i], "--rays")) o->rays = atol(value);
        else if (!strcmp(argv[i], "--family")) o->family = value;
        else if (!strcmp(argv[i], "--seed")) o->seed = strtoull(value, NULL, 10);
        else if (!strcmp(argv[i], "--failures")) o->failures = value;
        else if (!strcmp(argv[i], "--of")) o->method = !strcmp(value, "paper") ? NURBS_METHOD_PAPER : NURBS_METHOD_CERTAIN;
        else return false;
        i++;
    }
    return o->rays > 0;
}

int main(int argc, char **argv)
{
    Options o = { .rays = SHORT_RAYS, .seed = 1, .method = NURBS_METHOD_CERTAIN };
    if (!read_options(argc, argv, &o)) {
        fprintf(stderr, "usage: stress [--rays N] [--family NAME] [--seed S] [--knobs] [--hits] [--failures DIR] "
                        "[--of METHOD]\n");
        return 2;
    }
    printf("| family | knob | method | rays | hits | in the band | missed | false | inexact | not once | largest t error "
           "| fallbacks | ns a ray | slowest, µs |\n"
           "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    signal(SIGALRM, bark);
    Row total[N_METHODS] = { 0 };
    run_families(&o, stress_shapes, n_stress_shapes, total);
    run_families(&o, stress_trims, n_stress_trims, total);
    run_families(&o, stress_certified, n_stress_certified, total);
    for (int method = 0; method < N_METHODS; method++) print_row("all", "", method, &total[method]);
    const Row *certain = &total[NURBS_METHOD_CERTAIN];
    if (certain->missed + certain->false_hits > 0) return 1;
    return !o.only_hits && certain->inexact + certain->not_once > 0;
}
