/* Rays per second, preparation, memory and error of trimray's methods and of its peers on the same models and the same rays; prints
 * Markdown. bench.h says what the parts are; run.sh builds and runs all.
 *
 *   bench [--models NAME,...] [--engines NAME,...] [--sets NAME,...] [--size N] [--rays N] [--repeats N] [--budget SECONDS] [--long]
 *
 * --size    pixels along a side of the camera set        --rays    rays in each of the others
 * --budget  seconds for one pass: slower engines get every n-th ray (column 1/n)
 * --long    the large fields and trims, and meshes of up to 20 million triangles
 *
 * The truth is what `certain` answers, which the stress tests hold against closed forms and certified roots; on sphere and torus
 * it is held against the closed form here, too. */
#include "tests/bench/bench.h"

#include "tests/stress/truth.h"

#include <string.h>

enum { MAX_SETS = 5, MAX_ENGINES = 12, MAX_LEVELS = 12 };

typedef struct {
    char *models, *engines, *sets;
    int size, repeats;
    size_t rays, max_triangles;
    double budget;
} Options;

static Options parse_options(int argc, char **argv)
{
    Options o = { .models = "sphere,torus,teapot,sheet,order8,field-16,field-256,field-4096,trims-10,trims-1000,trims-100000",
                  .engines = "certain,paper,embree,sisl,occt", .sets = "camera,random,shadow,grazing,borders", .size = 512, .repeats = 5, .rays = 100000,
                  .max_triangles = 3000000, .budget = 0.3 };
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (!strcmp(argv[i], "--long")) {
            o.models = "sphere,torus,teapot,sheet,order8,field-16,field-256,field-4096,field-65536,"
                       "trims-10,trims-100,trims-1000,trims-10000,trims-100000,trims-1000000";
            o.max_triangles = 20000000, o.budget = 2;
            continue;
        }
        if (!strcmp(argv[i], "--models")) o.models = argv[++i];
        else if (!strcmp(argv[i], "--engines")) o.engines = argv[++i];
        else if (!strcmp(argv[i], "--sets")) o.sets = argv[++i];
        else if (!strcmp(argv[i], "--size")) o.size = atoi(value), i++;
        else if (!strcmp(argv[i], "--rays")) o.rays = (size_t)atol(value), i++;
        else if (!strcmp(argv[i], "--repeats")) o.repeats = atoi(value), i++;
        else if (!strcmp(argv[i], "--budget")) o.budget = atof(value), i++;
        else fprintf(stderr, "bench: %s?\n", argv[i]), exit(2);
    }
    return o;
}

static bool is_listed(const char *list, const char *name)
{
    size_t n = strlen(name);
    for (const char *at = list; (at = strstr(at, name)) != NULL; at += n)
        if ((at == list || at[-1] == ',') && (at[n] == ',' || at[n] == '\0')) return true;
    return false;
}

/* ---- one model ---- */

typedef struct {
    const Options *options;
    Model model;
    RaySet sets[MAX_SETS];
    double *truth[MAX_SETS];
    int n_sets;
    double *answers;
} Bench;

typedef struct { char name[80]; Engine *engine; } Entry;

static void add_set(Bench *b, Engine *certain, RaySet set)
{
    int i = b->n_sets++;
    b->sets[i] = set;
    b->truth[i] = ARENA_ARRAY(b->model.arena, double, set.n + 1);
    certain->shoot(certain, &b->sets[i], 1, b->truth[i]);
}

static void make_sets(Bench *b, Engine *certain)
{
    Model *m = &b->model;
    size_t n = b->options->rays;
    b->n_sets = 0;
    add_set(b, certain, rays_camera(m, m->arena, b->options->size));
    add_set(b, certain, rays_random(m, m->arena, n));
    add_set(b, certain, rays_shadow(m, m->arena, &b->sets[0], b->truth[0]));
    add_set(b, certain, rays_grazing(m, m->arena, n / 5));
    add_set(b, certain, rays_borders(m, m->arena, n / 5));
    size_t largest = 0;
    for (int i = 0; i < b->n_sets; i++) largest = b->sets[i].n > largest ? b->sets[i].n : largest;
    b->answers = ARENA_ARRAY(m->arena, double, largest + 1);
}

/* The largest difference of the truth from the closed form, in diagonals, and how often they disagree beyond what rounding of the
 * surface may do (truth.h). */
static void check_closed_form(const Bench *b)
{
    const Model *m = &b->model;
    if (!m->form) return;
    QuadMap one = { .x = { 1, 0, 0 }, .y = { 0, 1, 0 }, .z = { 0, 0, 1 } };
    FormInWorld f = { *m->form, one, one, box_diagonal(m->box), 6, NULL, NULL };
    size_t n = 0, missed = 0, wrong = 0;
    double largest = 0;
    for (int k = 0; k < b->n_sets; k++) {
        const RaySet *set = &b->sets[k];
        if (set->t_max) continue;
        for (size_t i = 0; i < set->n; i += set->n / 2000 + 1, n++) {
            Truth truth;
            truth_of_form(&f, &set->rays[i], &truth);
            double t = b->truth[k][i];
            int first = 0;
            while (first < truth.n && truth.root[first].hi < 0) first++;
            while (first < truth.n && !truth_is_sure(&truth.root[first]) && t > (double)truth.root[first].hi) first++;
            if (first == truth.n) wrong += isfinite(t);
            else if (t > (double)truth.root[first].hi + 1e-12) missed++;
            else if (t < (double)truth.root[first].lo - 1e-12) wrong++;
            else if (truth_is_sure(&truth.root[first]) && truth.root[first].hi - truth.root[first].lo < 1e-9)
                largest = fmax(largest, fabs(t - (double)truth.root[first].t) / m->diagonal);
        }
    }
    printf("`certain` against the closed form, %zu rays of all sets: %zu missed, %zu false, largest depth error %.1e.\n\n", n,
           missed, wrong, largest);
}

/* ---- meshes: which chord error is asked for ---- */

/* The coarsest meshes whose error on the random rays is under 1e-5: by RMS, by 99.9 % of the hits. 0: none. */
typedef struct { double rms, p999; } Levels;

static Levels find_levels(Bench *b)
{
    Levels found = { 0, 0 };
    RaySet some = b->sets[1];
    if (some.n > 20000) some.n = 20000;
    double chord = 1e-4;
    size_t n_triangles = 0;
    while (found.p999 == 0 && 2 * n_triangles <= b->options->max_triangles) {
        Engine *e = engine_embree(&(EngineInput){ .model = &b->model, .is_robust = true, .chord_error = chord });
        if (!e) break;
        n_triangles = e->cost.n_triangles;
        e->shoot(e, &some, 1, b->answers);
        Accuracy a = measure_accuracy(&b->model, &some, 1, b->truth[1], b->answers);
        fprintf(stderr, "bench: %s: chord error %.1e: %zu triangles, mesh %.2f s, build %.2f s, RMS %.1e, 99.9 %% %.1e\n",
                b->model.name, chord, n_triangles, e->cost.mesh_seconds, e->cost.prep_seconds, a.rms, a.p999);
        e->release(e);
        if (found.rms == 0 && a.rms < 1e-5) found.rms = chord;
        if (a.p999 < 1e-5) found.p999 = chord;
        chord /= 2;
    }
    return found;
}

/* ---- tables ---- */

static void print_prep_head(const Bench *b)
{
    printf("\n### %s: %d surfaces\n\n", b->model.name, b->model.n);
}

static void print_prep(const Entry *e, int n)
{
    printf("| engine | triangles | mesh, s | preparation, s | held, MB | peak, MB |\n|---|---:|---:|---:|---:|---:|\n");
    for (int i = 0; i < n; i++) {
        const EngineCost *c = &e[i].engine->cost;
        printf("| %s | ", e[i].name);
        if (c->n_triangles) printf("%zu | %.3f | ", c->n_triangles, c->mesh_seconds);
        else printf(" | | ");
        printf("%.5f | %.3f | %.3f |\n", c->prep_seconds, (double)c->held * 1e-6, (double)c->peak * 1e-6);
    }
    printf("\n");
}

static void print_row(const Bench *b, const RaySet *set, const double *truth, const Entry *e)
{
    const Options *o = b->options;
    Speed s = measure_speed(e->engine, set, o->repeats, o->budget, b->answers);
    Accuracy a = measure_accuracy(&b->model, set, s.stride, truth, b->answers);
    const Counters *c = &e->engine->cost.counters;
    printf("| %s | %s | %.3f | %.0f %% | %zu | %zu | %zu | %zu | ", set->name, e->name, s.rays_per_second * 1e-6, 100 * s.spread,
           s.stride, a.hits, a.missed, a.wrong);
    if (set->t_max) printf("| | | ");
    else printf("%.1e | %.1e | %.1e | ", a.largest, a.rms, a.p999);
    printf("%.0f | ", s.cycles_per_ray);
    if (c->nurbs_tests > 0) {
        double rays = (double)(s.n * (size_t)o->repeats), tests = (double)c->nurbs_tests, boxes;
        boxes = (double)(c->bv_intersections + c->light_bv_intersections);
        printf("%.2f | %.2f | %.2f | %.2f | %.3f |\n", boxes / rays, tests / rays, tests / fmax((double)a.hits * o->repeats, 1),
               (double)c->newton_iterations / tests, (double)c->fallbacks / tests);
    } else {
        printf("| | | | |\n");
    }
    fflush(stdout);
}

static void print_rays(const Bench *b, const Entry *e, int n)
{
    printf("| rays | engine | M rays/s | spread | 1/n | hits | missed | false | largest | RMS | 99.9 %% | cycles/ray | boxes/ray "
           "| tests/ray | tests/hit | steps/test | fallbacks/test |\n"
           "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (int k = 0; k < b->n_sets; k++)
        for (int i = 0; i < n && is_listed(b->options->sets, b->sets[k].name); i++) print_row(b, &b->sets[k], b->truth[k], &e[i]);
    printf("\n");
}

static void add_entry(Entry *list, int *n, const char *name, Engine *e)
{
    if (!e) return;
    snprintf(list[*n].name, sizeof list[*n].name, "%s", name);
    list[(*n)++].engine = e;
}

static void add_meshes(Bench *b, Entry *list, int *n)
{
    Levels found = find_levels(b);
    double chords[2] = { found.rms, found.p999 };
    static const char *const names[2] = { "RMS", "99.9 %" };
    for (int k = 0; k < 2; k++)
        for (int robust = 1; robust >= 0; robust--) {
            if (chords[k] == 0 || (k == 1 && chords[1] == chords[0])) continue;
            char name[80];
            snprintf(name, sizeof name, "Embree%s, %s < 1e-5", robust ? " robust" : "", names[k]);
            EngineInput in = { .model = &b->model, .is_robust = robust != 0, .chord_error = chords[k] };
            add_entry(list, n, name, engine_embree(&in));
        }
}

static void run_model(const Options *o, const char *name)
{
    Arena *a = arena_new();
    Bench b = { .options = o };
    Entry list[MAX_ENGINES];
    int n = 0;
    if (!model_make(a, name, &b.model)) exit(1);
    EngineInput in = { .model = &b.model, .method = NURBS_METHOD_CERTAIN };
    Engine *certain = engine_trimray(&in);
    if (!certain) exit(1);
    make_sets(&b, certain);
    if (is_listed(o->engines, "certain")) add_entry(list, &n, "certain", certain);
    in.method = NURBS_METHOD_PAPER;
    if (is_listed(o->engines, "paper")) add_entry(list, &n, "paper", engine_trimray(&in));
    if (is_listed(o->engines, "embree")) add_meshes(&b, list, &n);
    if (is_listed(o->engines, "sisl")) add_entry(list, &n, "SISL s1856", engine_sisl(&in));
    if (is_listed(o->engines, "occt")) add_entry(list, &n, "Open CASCADE", engine_occt(&in));
    print_prep_head(&b);
    check_closed_form(&b);
    print_prep(list, n);
    print_rays(&b, list, n);
    for (int i = 0; i < n; i++) list[i].engine->release(list[i].engine);
    arena_free(a);
}

int main(int argc, char **argv)
{
    Options o = parse_options(argc, argv);
    char *names = strdup(o.models);
    cycles_per_second();   /* measured here once */
    for (char *name = strtok(names, ","); name; name = strtok(NULL, ",")) run_model(&o, name);
    free(names);
    return 0;
}
