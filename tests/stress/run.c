/* See run.h. */
#include "tests/stress/run.h"

#include <signal.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

enum { FAILURES_OF_A_KIND = 5 };   /* in one part */
#define SLOW 0.01   /* seconds: such rays are reported among the failures, though they count as right */

/* What is being shot: for reports, and for the watchdog. */
static struct {
    const RunOptions *options;
    Part part;
    long index;                  /* of the ray in its part */
    const Model *model;
    Ray ray, before[JUDGE_BESIDE];   /* those before it, for bunches */
    Truth truth;
} now;

static void describe(FILE *to, Verdict v)
{
    const Part *p = &now.part;
    fprintf(to, "/* stress --family '%s' --knob %.17g --seed %llu --rays %ld --surface-rays %ld --ray %ld */\n",
            p->family->name, p->family->values[p->knob], (unsigned long long)p->seed, now.options->rays,
            now.options->surface_rays, now.index);
    judge_report(to, now.model, &now.ray, &now.truth, v);
}

static FILE *failure_file(const char *kind, int n)
{
    char path[1024];
    const Part *p = &now.part;
    snprintf(path, sizeof path, "%s/%s-%g-seed%llu-%s-%d.c", now.options->failures, p->family->name,
             p->family->values[p->knob], (unsigned long long)p->seed, kind, n);
    for (char *c = path + strlen(now.options->failures); *c; c++)
        if (*c == ' ') *c = '-';
    return fopen(path, "w");
}

typedef struct { int n[JUDGEMENTS], n_slow; } Reported;

static void report_failure(Reported *count, Verdict v)
{
    bool is_slow = v.judgement <= JUDGED_IN_BAND;
    int n = is_slow ? ++count->n_slow : ++count->n[v.judgement];
    if (!now.options->failures || n > FAILURES_OF_A_KIND) return;
    FILE *to = failure_file(is_slow ? "slow" : judgement_name[v.judgement], n);
    if (!to) return;
    describe(to, v);
    fclose(to);
}

static void bark(int signal_number)
{
    (void)signal_number;   /* not safe in a signal handler, strictly; the program ends here anyway */
    Verdict v = { .judgement = JUDGED_MISSED };
    FILE *to = now.options->failures ? failure_file("endless", 1) : NULL;
    fprintf(stderr, "stress: a ray takes more than %d s\n", RUN_PATIENCE);
    describe(to ? to : stderr, v);
    fflush(NULL);
    _exit(1);
}

/* Processor time, not the clock's: others may want the machine. */
static void watch(int seconds)
{
    struct itimerval t = { .it_value = { .tv_sec = seconds } };
    signal(SIGVTALRM, bark);
    setitimer(ITIMER_VIRTUAL, &t, NULL);
}

/* From before all roots, or from between two of them. */
static void choose_start(Ray *r, const Truth *truth, TestRandom *random)
{
    int i = test_int(random, 0, 7);
    if (i + 1 >= truth->n) return;
    double t = (double)((truth->root[i].hi + truth->root[i + 1].lo) / 2);
    if (t > 0 && isfinite(t)) r->t_min = t;
}

static void shoot(Trace *trace, Row rows[N_METHODS], Reported *failures)
{
    const RunOptions *o = now.options;
    bool wants_all = o->only_ray >= 0 || now.index % o->all_hits_every == 0;
    for (int method = 0; method < N_METHODS; method++) {
        Verdict v = judge_ray(now.model, method, &now.ray, &now.truth, now.before, wants_all, trace, &rows[method]);
        if (method != o->method) continue;
        if (o->only_ray >= 0) describe(stdout, v);
        else if (v.judgement > JUDGED_IN_BAND || v.seconds > SLOW) report_failure(failures, v);
    }
}

/* The next `rays` of the part. */
static void run_model(const Model *m, long rays, TestRandom *random, Row rows[N_METHODS], Reported *failures)
{
    const RunOptions *o = now.options;
    const Family *f = now.part.family;
    Trace trace;
    memset(&trace, 0, sizeof trace);
    trace.scratch = arena_new();
    now.model = m;
    for (long end = now.index + rays; now.index < end; now.index++) {
        bool is_wanted = o->only_ray < 0 || o->only_ray == now.index;
        now.truth.n = 0;
        watch(RUN_PATIENCE);
        now.ray = f->ray(m, f->values[now.part.knob], random);
        if (is_wanted) model_truth(m, &now.ray, &now.truth);
        choose_start(&now.ray, &now.truth, random);
        trace.seed = test_bits(random);
        if (is_wanted) shoot(&trace, rows, failures);
        now.before[now.index % JUDGE_BESIDE] = now.ray;
    }
    watch(0);
    arena_free(trace.scratch);
}

void run_part(const RunOptions *o, Part part, Row rows[N_METHODS])
{
    const Family *f = part.family;
    TestRandom random = test_random(part.seed * 1000003 + (uint64_t)part.knob);
    for (const char *c = f->name; *c; c++) random.state = random.state * 31 + (uint64_t)*c;
    Reported failures = { 0 };
    now.options = o, now.part = part, now.index = 0;
    for (long left = (long)((double)o->rays * f->share); left > 0; left -= o->surface_rays) {
        Arena *a = arena_new();
        Model m = f->build(a, f->values[part.knob], &random);
        run_model(&m, left < o->surface_rays ? left : o->surface_rays, &random, rows, &failures);
        for (int i = 0; i < N_METHODS; i++) shape_release(m.shape[i]);
        if (m.release) m.release(&m);
        arena_free(a);
    }
}
