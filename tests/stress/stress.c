/* Runs the families of stress and prints what each method misses, as a table in Markdown.
 *
 *   stress [--rays N] [--surface-rays N] [--rounds N] [--seed S] [--family NAME] [--knob X] [--all-hits-every N] [--hits]
 *          [--jobs N] [--log FILE] [--failures DIR] [--of METHOD] [--knobs] [--ray N]
 *   stress --sum LOG... [--knobs] [--hits]
 *
 * What is shot: N rays (times the family's share) for each family and each value of its knob, with a new surface after
 * every --surface-rays of them, in rounds of the seeds S, S + 1, ...; all hits of a ray are compared too, or those of every
 * n-th ray.
 *
 * How: --jobs processes share the work. What is done is kept in --log, part by part: the same command with the same log
 * goes on where an interrupted one stopped, and --sum prints what logs hold together. --failures writes the first surfaces
 * and rays of each part and kind that a method (`certain`, if no other is named) gets wrong into files, slow ones too; each
 * begins with the options, --ray among them, that shoot this ray again, alone.
 *
 * The long run, 10^7 rays in some 20 minutes of one processor:
 *   stress --hits --rays 8000 --surface-rays 1000 --all-hits-every 16 --rounds 9 --log FILE --failures DIR
 *
 * --knobs prints a row for each value of the knob. The exit status is 1 if `certain` got one wrong: missed, false, t wrong
 * by more than 1e-12 outside the band (truth.h says what that is), or a root that is not found just once among all hits.
 * With --hits only the first two count: what remains of the others is known (weights of ratio 1e9 and collapsed patches;
 * poles, cusps and tangents), and the table shows it. */
#include "tests/stress/table.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SHORT_RAYS = 800, SURFACE_RAYS = 100, MAX_JOBS = 64 };

typedef struct {
    RunOptions run;
    const char *family, *log;
    double knob;                 /* NaN: all */
    uint64_t seed;
    long rounds;
    int jobs;
    bool by_knob, only_hits, is_sum;
    int first_log;               /* of argv, where it is a sum */
} Options;

/* ---- the parts of a run, and who makes them ---- */

typedef struct {
    const Options *o;
    Part *parts;                 /* of one round; round r has the seed o->seed + r */
    long n, n_all;
    bool *is_done;               /* by an earlier run; n_all of them */
    int log;
} Work;

static bool is_chosen(const Options *o, const Family *f, int knob)
{
    return (!o->family || !strcmp(o->family, f->name)) && (isnan(o->knob) || o->knob == f->values[knob]);
}

static Work work_new(const Options *o)
{
    Work w = { .o = o, .parts = calloc((size_t)family_count() * FAMILY_VALUES, sizeof *w.parts) };
    if (!w.parts) abort();
    for (int i = 0; i < family_count(); i++)
        for (int knob = 0; knob < family_at(i)->n; knob++)
            if (is_chosen(o, family_at(i), knob)) w.parts[w.n++] = (Part){ family_at(i), knob, o->seed };
    w.n_all = w.n * o->rounds;
    w.is_done = calloc((size_t)w.n_all + 1, sizeof *w.is_done);
    if (!w.is_done) abort();
    return w;
}

static void note_done(void *context, Part part)
{
    Work *w = context;
    for (long i = 0; i < w->n; i++) {
        const Part *p = &w->parts[i];
        if (p->family != part.family || p->knob != part.knob || part.seed - p->seed >= (uint64_t)w->o->rounds) continue;
        w->is_done[(long)(part.seed - p->seed) * w->n + i] = true;
    }
}

/* Takes one part after the other, until all are taken. */
static void run_parts(const Work *w, atomic_long *next)
{
    for (long i = (*next)++; i < w->n_all; i = (*next)++) {
        Part part = w->parts[i % w->n];
        part.seed += (uint64_t)(i / w->n);
        if (w->is_done[i]) continue;
        if (part.knob == 0) fprintf(stderr, "stress: part %ld of %ld: %s\n", i + 1, w->n_all, part.family->name);
        Row rows[N_METHODS] = { 0 };
        run_part(&w->o->run, part, rows);
        if (!log_add(w->log, part, rows)) fprintf(stderr, "stress: the log: %s\n", strerror(errno));
    }
}

static pid_t jobs[MAX_JOBS];     /* for the signal handler; 0: it has ended */
static volatile sig_atomic_t is_interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    is_interrupted = 1;
    for (int i = 0; i < MAX_JOBS; i++)
        if (jobs[i] > 0) kill(jobs[i], SIGKILL);
}

static void start_job(const Work *w, int i, atomic_long *next)
{
    fflush(NULL);
    jobs[i] = fork();
    if (jobs[i] != 0) return;
    signal(SIGINT, SIG_DFL), signal(SIGTERM, SIG_DFL);
    run_parts(w, next);
    exit(0);
}

/* Returns whether every job came to its end. */
static bool run_jobs(const Work *w)
{
    atomic_long *next = mmap(NULL, sizeof *next, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (next == MAP_FAILED) return false;
    signal(SIGINT, interrupt), signal(SIGTERM, interrupt);
    bool ok = true;
    for (int i = 0; i < w->o->jobs; i++) start_job(w, i, next);
    for (int i = 0; i < w->o->jobs; i++) {
        int status = 0;
        while (jobs[i] > 0 && waitpid(jobs[i], &status, 0) < 0 && errno == EINTR) {}
        ok = ok && jobs[i] > 0 && status == 0;
        jobs[i] = 0;
    }
    munmap(next, sizeof *next);
    return ok;
}

/* ---- the command ---- */

static bool read_value(Options *o, const char *name, const char *value)
{
    if (!strcmp(name, "--rays")) return (o->run.rays = atol(value)) > 0;
    if (!strcmp(name, "--surface-rays")) return (o->run.surface_rays = atol(value)) > 0;
    if (!strcmp(name, "--all-hits-every")) return (o->run.all_hits_every = atol(value)) > 0;
    if (!strcmp(name, "--rounds")) return (o->rounds = atol(value)) > 0;
    if (!strcmp(name, "--jobs")) return (o->jobs = atoi(value)) > 0 && o->jobs <= MAX_JOBS;
    if (!strcmp(name, "--ray")) return (o->run.only_ray = atol(value)) >= 0;
    if (!strcmp(name, "--seed")) o->seed = strtoull(value, NULL, 10);
    else if (!strcmp(name, "--family")) o->family = value;
    else if (!strcmp(name, "--knob")) o->knob = strtod(value, NULL);
    else if (!strcmp(name, "--log")) o->log = value;
    else if (!strcmp(name, "--failures")) o->run.failures = value;
    else if (!strcmp(name, "--of")) o->run.method = !strcmp(value, "paper") ? NURBS_METHOD_PAPER : NURBS_METHOD_CERTAIN;
    else return false;
    return true;
}

static bool read_options(int argc, char **argv, Options *o)
{
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--knobs")) o->by_knob = true;
        else if (!strcmp(argv[i], "--hits")) o->only_hits = true;
        else if (!strcmp(argv[i], "--sum")) o->is_sum = true, o->first_log = i + 1;
        else if (o->is_sum && argv[i][0] != '-') continue;
        else if (i + 1 < argc && read_value(o, argv[i], argv[i + 1])) i++;
        else return false;
    }
    return true;
}

static bool is_wrong(const Options *o, const Table *t)
{
    Row certain = table_total(t, NURBS_METHOD_CERTAIN);
    return certain.missed + certain.false_hits > 0 || (!o->only_hits && certain.inexact + certain.not_once > 0);
}

static int print_sum(const Options *o, int argc, char **argv)
{
    Table t = table_new();
    for (int i = o->first_log; i < argc && argv[i][0] != '-'; i++) {
        int fd = open(argv[i], O_RDONLY);
        if (fd < 0) fprintf(stderr, "stress: %s: %s\n", argv[i], strerror(errno));
        if (fd < 0) return 2;
        log_read(fd, &t, NULL, NULL);
        close(fd);
    }
    table_print(&t, o->by_knob);
    int status = is_wrong(o, &t);
    table_free(&t);
    return status;
}

static int open_log(const Options *o)
{
    FILE *unnamed = o->log ? NULL : tmpfile();
    int fd = o->log ? open(o->log, O_RDWR | O_APPEND | O_CREAT, 0666) : unnamed ? dup(fileno(unnamed)) : -1;
    if (unnamed) fclose(unnamed), fcntl(fd, F_SETFL, O_APPEND);
    const RunOptions *r = &o->run;
    if (fd >= 0 && log_begin(fd, (LogHead){ r->rays, r->surface_rays, r->all_hits_every })) return fd;
    fprintf(stderr, "stress: %s: it cannot be written, or its rays were shot with other options\n", o->log ? o->log : "log");
    return -1;
}

static int run(const Options *o)
{
    Work w = work_new(o);
    w.log = open_log(o);
    if (w.log < 0) return 2;
    Table before = table_new(), t = table_new();
    log_read(w.log, &before, note_done, &w);
    bool is_complete = run_jobs(&w);
    log_read(w.log, &t, NULL, NULL);
    table_print(&t, o->by_knob);
    bool wrong = is_wrong(o, &t);
    table_free(&before), table_free(&t);
    close(w.log);
    free(w.parts), free(w.is_done);
    return is_interrupted ? 130 : !is_complete || wrong;
}

/* One ray again. */
static int run_ray(const Options *o)
{
    Work w = work_new(o);
    for (long i = 0; i < w.n; i++) {
        Row rows[N_METHODS] = { 0 };
        run_part(&o->run, w.parts[i], rows);
    }
    free(w.parts), free(w.is_done);
    return 0;
}

int main(int argc, char **argv)
{
    Options o = { .run = { .rays = SHORT_RAYS, .surface_rays = SURFACE_RAYS, .all_hits_every = 1,
                           .method = NURBS_METHOD_CERTAIN, .only_ray = -1 },
                  .knob = NAN, .seed = 1, .rounds = 1, .jobs = 1 };
    if (!read_options(argc, argv, &o)) {
        fprintf(stderr, "usage: stress [--rays N] [--surface-rays N] [--rounds N] [--seed S] [--family NAME] [--knob X]\n"
                        "              [--all-hits-every N] [--hits] [--jobs N] [--log FILE] [--failures DIR]\n"
                        "              [--of METHOD] [--knobs] [--ray N]\n"
                        "       stress --sum LOG... [--knobs] [--hits]\n");
        return 2;
    }
    if (o.is_sum) return print_sum(&o, argc, argv);
    return o.run.only_ray >= 0 ? run_ray(&o) : run(&o);
}
