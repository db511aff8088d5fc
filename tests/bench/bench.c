/* Rays per second, preparation, memory and error of trimray's methods and of its peers on the same models and the same
 * rays; prints Markdown. bench.h says what the parts are; run.sh builds and runs all.
 *
 *   bench [--models NAME,...] [--engines NAME,...] [--sets NAME,...] [--size N] [--rays N] [--repeats N] [--budget SECONDS]
 *         [--triangles MILLIONS] [--long]
 *
 * --size       pixels along a side of the camera set        --rays   rays in each of the others
 * --budget     seconds for one pass: slower engines get every n-th ray (column 1/n)
 * --triangles  no larger meshes
 * --long       more models, larger fields, trims and meshes, longer passes
 *
 * The truth is what `certain` answers, which the stress tests hold against closed forms and certified roots; on sphere
 * and torus it is held against the closed form here, too. Where `paper`, SISL and Open CASCADE have no false hits, it
 * missed none. */
#include "tests/bench/run.h"

#include "tests/stress/truth.h"

#include <string.h>

static const Options short_run = {
    .models = "sphere,torus,teapot,sheet,order8,field-16,field-256,field-4096,trims-10,trims-1000,trims-100000",
    .engines = "certain,paper,embree,sisl,occt", .sets = "camera,random,shadow,grazing,borders",
    .size = 512, .repeats = 5, .rays = 100000, .max_triangles = 10000000, .budget = 0.2
};

static const Options long_run = {
    .models = "sphere,torus,teapot,sheet,order8,field-16,field-256,field-4096,field-65536,"
              "trims-10,trims-100,trims-1000,trims-10000,trims-100000,trims-1000000",
    .engines = "certain,paper,embree,sisl,occt", .sets = "camera,random,shadow,grazing,borders",
    .size = 512, .repeats = 5, .rays = 200000, .max_triangles = 24000000, .budget = 1
};

static void set_option(Options *o, const char *name, const char *value)
{
    if (!strcmp(name, "--models")) o->models = value;
    else if (!strcmp(name, "--engines")) o->engines = value;
    else if (!strcmp(name, "--sets")) o->sets = value;
    else if (!strcmp(name, "--size")) o->size = atoi(value);
    else if (!strcmp(name, "--rays")) o->rays = (size_t)atol(value);
    else if (!strcmp(name, "--repeats")) o->repeats = atoi(value);
    else if (!strcmp(name, "--budget")) o->budget = atof(value);
    else if (!strcmp(name, "--triangles")) o->max_triangles = (size_t)(atof(value) * 1e6);
    else fprintf(stderr, "bench: %s?\n", name), exit(2);
}

static Options parse_options(int argc, char **argv)
{
    Options o = short_run;
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--long")) {
            o = long_run;
        } else {
            set_option(&o, argv[i], i + 1 < argc ? argv[i + 1] : "");
            i++;
        }
    }
    return o;
}

bool is_listed(const char *list, const char *name)
{
    size_t n = strlen(name);
    for (const char *at = list; (at = strstr(at, name)) != NULL; at += n)
        if ((at == list || at[-1] == ',') && (at[n] == ',' || at[n] == '\0')) return true;
    return false;
}

void add_entry(Bench *b, Kind kind, const char *name, Engine *e)
{
    if (!e) return;
    Entry *entry = &b->list[b->n_engines++];
    *entry = (Entry){ .kind = kind, .engine = e };
    snprintf(entry->name, sizeof entry->name, "%s", name);
}

/* ---- rays and their truth ---- */

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
    add_set(b, certain, rays_camera(m, m->arena, b->options->size));
    add_set(b, certain, rays_random(m, m->arena, n));
    add_set(b, certain, rays_shadow(m, m->arena, &b->sets[0], b->truth[0]));
    add_set(b, certain, rays_grazing(m, m->arena, n / 5));
    add_set(b, certain, rays_borders(m, m->arena, n / 5));
    size_t largest = 0;
    for (int i = 0; i < b->n_sets; i++) largest = b->sets[i].n > largest ? b->sets[i].n : largest;
    b->answers = ARENA_ARRAY(m->arena, double, largest + 1);
}

/* ---- the closed form ---- */

typedef struct { size_t n, missed, wrong; double largest; } Check;

/* One answer against all roots of the ray's line. A root that rounding may create or remove (truth.h) may be met or not. */
static void check_answer(Check *c, const Truth *truth, double t, double diagonal)
{
    int i = 0;
    while (i < truth->n && truth->root[i].hi < 0) i++;
    while (i < truth->n && !truth_is_sure(&truth->root[i]) && t > (double)truth->root[i].hi) i++;
    const TruthRoot *r = &truth->root[i];
    c->n++;
    if (i == truth->n) c->wrong += isfinite(t);
    else if (t > (double)r->hi + TRUTH_ERROR * diagonal) c->missed++;
    else if (t < (double)r->lo - TRUTH_ERROR * diagonal) c->wrong++;
    else if (truth_is_sure(r) && r->hi - r->lo < 1e-9)
        c->largest = double_max(c->largest, fabs(t - (double)r->t) / diagonal);
}

static void check_closed_form(const Bench *b)
{
    const Model *m = &b->model;
    if (!m->form) return;
    QuadMap one = { .x = { 1, 0, 0 }, .y = { 0, 1, 0 }, .z = { 0, 0, 1 } };
    FormInWorld f = { .form = *m->form, .to_world = one, .to_local = one, .extent = m->diagonal, .diagonal = m->diagonal,
                      .k_sum = 6 };
    Check c = { 0 };
    for (int k = 0; k < b->n_sets; k++) {
        const RaySet *set = &b->sets[k];
        for (size_t i = 0; i < set->n && !set->t_max; i += set->n / 2000 + 1) {
            Truth truth;
            truth_of_form(&f, &set->rays[i], &truth);
            check_answer(&c, &truth, b->truth[k][i], m->diagonal);
        }
    }
    printf("`certain` against the closed form, %zu rays of all sets: %zu missed, %zu false, largest depth error %.1e.\n\n",
           c.n, c.missed, c.wrong, c.largest);
}

/* ---- one model ---- */

static void add_engines(Bench *b, Engine *certain)
{
    const char *names = b->options->engines;
    EngineInput in = { .model = &b->model, .method = NURBS_METHOD_PAPER };
    if (is_listed(names, "certain")) {
        add_entry(b, IS_CERTAIN, "certain", certain);
        add_entry(b, IS_EIGHTS, "certain, in eights", engine_in_eights(certain));
    }
    if (is_listed(names, "paper")) add_entry(b, IS_PAPER, "paper", engine_trimray(&in));
    if (is_listed(names, "embree")) add_meshes(b);
    if (is_listed(names, "sisl")) add_entry(b, IS_SISL, "SISL s1856", engine_sisl(&in));
    if (is_listed(names, "occt")) add_entry(b, IS_OCCT, "Open CASCADE", engine_occt(&in));
}

static int run_model(const Options *o, const char *name)
{
    Arena *a = arena_new();
    Bench b = { .options = o };
    if (!model_make(a, name, &b.model)) return 1;
    Engine *certain = engine_trimray(&(EngineInput){ .model = &b.model, .method = NURBS_METHOD_CERTAIN });
    if (!certain) return 1;
    make_sets(&b, certain);
    add_engines(&b, certain);
    printf("\n### %s: %d surface%s\n\n", name, b.model.n, b.model.n == 1 ? "" : "s");
    check_closed_form(&b);
    if (b.notes[0]) printf("%s\n\n", b.notes);
    print_preparation(&b);
    print_rays(&b);
    print_ratios(&b);
    summary_add(&b);
    for (int i = 0; i < b.n_engines; i++) b.list[i].engine->release(b.list[i].engine);
    arena_free(a);
    return 0;
}

int main(int argc, char **argv)
{
    Options o = parse_options(argc, argv);
    int status = 0;
    cycles_per_second();   /* measured here, once */
    char *names = strdup(o.models);
    for (char *name = strtok(names, ","); name; name = strtok(NULL, ",")) status |= run_model(&o, name);
    free(names);
    print_summary();
    return status;
}
