/* What came out of all models, side by side: the tables of the README. */
#include "tests/bench/run.h"

#include <string.h>

enum { MAX_MODELS = 32, MAX_KINDS = IS_OTHER + 1 };

typedef struct { double set[MAX_SETS], preparation, memory; } Ratios;    /* 0: not measured */

typedef struct {
    char name[32];
    int n_surfaces;
    EngineCost cost;                  /* of `certain` */
    double rays[MAX_SETS], in_eights[MAX_SETS], cycles_per_test, newton_per_hit;
    Ratios eights_ratio;              /* in eights, to the mesh in eights */
    Ratios ratio[MAX_KINDS];
} Row;

static Row rows[MAX_MODELS];
static int n_rows;
static const char *set_names[MAX_SETS];
static char kind_names[MAX_KINDS][48];

static Ratios ratios_of(const Bench *b, const Entry *own, const Entry *e)
{
    Ratios r = { .preparation = e->engine->cost.prep_seconds / own->engine->cost.prep_seconds,
                 .memory = (double)e->engine->cost.held / (double)own->engine->cost.held };
    for (int k = 0; k < b->n_sets; k++)
        if (e->speed[k].rays_per_second > 0) r.set[k] = own->speed[k].rays_per_second / e->speed[k].rays_per_second;
    return r;
}

void summary_add(const Bench *b)
{
    if (n_rows == MAX_MODELS || b->n_engines == 0 || b->list[0].kind != IS_CERTAIN) return;
    Row *row = &rows[n_rows++];
    const Entry *own = &b->list[0];
    snprintf(row->name, sizeof row->name, "%s", b->model.name);
    row->n_surfaces = b->model.n, row->cost = own->engine->cost;
    row->cycles_per_test = own->speed[0].cycles_per_test;
    row->newton_per_hit = own->speed[0].newton_per_hit;
    for (int k = 0; k < b->n_sets; k++) set_names[k] = b->sets[k].name, row->rays[k] = own->speed[k].rays_per_second;
    const Entry *eights = NULL;
    for (int i = 1; i < b->n_engines; i++) {
        const Entry *e = &b->list[i];
        snprintf(kind_names[e->kind], sizeof kind_names[e->kind], "%s", e->name);
        row->ratio[e->kind] = ratios_of(b, own, e);
        if (e->kind == IS_EIGHTS) eights = e;
        if (e->kind == IS_MESH_EIGHTS && eights) row->eights_ratio = ratios_of(b, eights, e);
    }
    for (int k = 0; k < b->n_sets && eights; k++) row->in_eights[k] = eights->speed[k].rays_per_second;
}

static void print_number(double x, double scale, int digits)
{
    if (x > 0 && isfinite(x)) printf(" %.*f |", digits, x * scale);
    else printf(" |");
}

static void print_own(void)
{
    printf("`certain`: rays in millions a second; cycles of a leaf test and Newton tests of a hit, for camera rays.\n\n"
           "| model | surfaces | leaves | preparation, ms | held, MB |");
    for (int k = 0; k < MAX_SETS && set_names[k]; k++) printf(" %s |", set_names[k]);
    printf(" cycles a test | Newton tests a hit |\n|---|---:|---:|---:|---:|---:|---:|");
    for (int k = 0; k < MAX_SETS && set_names[k]; k++) printf("---:|");
    printf("\n");
    for (int i = 0; i < n_rows; i++) {
        const Row *r = &rows[i];
        printf("| %s | %d | %zu |", r->name, r->n_surfaces, r->cost.n_leaves);
        print_number(r->cost.prep_seconds, 1e3, 2);
        print_number((double)r->cost.held, 1e-6, 2);
        for (int k = 0; k < MAX_SETS && set_names[k]; k++) print_number(r->rays[k], 1e-6, 2);
        print_number(r->cycles_per_test, 1, 0);
        print_number(r->newton_per_hit, 1, 2);
        printf("\n");
    }
    printf("\n");
}

static void print_against(Kind kind)
{
    printf("How many times better than %s.\n\n| model |", kind_names[kind]);
    for (int k = 0; k < MAX_SETS && set_names[k]; k++) printf(" %s |", set_names[k]);
    printf(" preparation | memory |\n|---|---:|---:|");
    for (int k = 0; k < MAX_SETS && set_names[k]; k++) printf("---:|");
    printf("\n");
    for (int i = 0; i < n_rows; i++) {
        const Ratios *r = &rows[i].ratio[kind];
        if (!(r->preparation > 0)) continue;
        printf("| %s |", rows[i].name);
        for (int k = 0; k < MAX_SETS && set_names[k]; k++) print_number(r->set[k], 1, 2);
        print_number(r->preparation, 1, 1);
        print_number(r->memory, 1, 1);
        printf("\n");
    }
    printf("\n");
}

/* Of rays that go in eights: their number, and how many times that of rays one by one; and of the mesh's in eights. */
static void print_eights(void)
{
    printf("`certain`, eight rays together: millions a second (times as many as one by one; times as many as %s).\n\n| model |",
           kind_names[IS_MESH_EIGHTS][0] ? kind_names[IS_MESH_EIGHTS] : "a mesh");
    for (int k = 0; k < MAX_SETS && set_names[k]; k++) printf(" %s |", set_names[k]);
    printf("\n|---|");
    for (int k = 0; k < MAX_SETS && set_names[k]; k++) printf("---:|");
    printf("\n");
    for (int i = 0; i < n_rows; i++) {
        const Row *r = &rows[i];
        printf("| %s |", r->name);
        for (int k = 0; k < MAX_SETS && set_names[k]; k++) {
            printf(" %.2f (%.2f", r->in_eights[k] * 1e-6, r->in_eights[k] / r->rays[k]);
            if (r->eights_ratio.set[k] > 0) printf("; %.2f", r->eights_ratio.set[k]);
            printf(") |");
        }
        printf("\n");
    }
    printf("\n");
}

void print_summary(void)
{
    if (n_rows < 2) return;
    printf("\n### All models\n\n");
    print_own();
    print_eights();
    for (Kind kind = IS_PAPER; kind < IS_EIGHTS; kind++)
        if (kind_names[kind][0]) print_against(kind);
}
