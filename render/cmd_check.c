/* trimray check SCENE.pov: reads and validates; says what the scene has, and what it does without. */
#include "render/commands.h"
#include "render/inventory.h"

static void print_count(const char *name, size_t n) { printf("  %-24s %zu\n", name, n); }

static void print_kind(const InventoryKind *k)
{
    printf("    %-22s %zu", k->name, k->n_seen);
    if (k->n < k->n_seen) printf(" (of %zu distinct)", k->n);
    putchar('\n');
}

static void print_contents(const Run *run, const Inventory *v)
{
    printf("%s:\n", run->path);
    print_count("files read", run->summary.n_files);
    print_count("bytes read", run->summary.n_bytes);
    print_count("objects", run->summary.n_objects);
    print_count("lights", run->summary.n_lights);
    print_count("primitives", v->n_seen);
    for (int i = 0; i < v->n_kinds; i++) print_kind(&v->kinds[i]);
    print_count("trims", v->n_trims_seen);
    print_count("trim pieces", v->n_trim_pieces);
    print_count("control points", run->summary.n_control_points);
}

static void print_left_out(const Inventory *v)
{
    LeftOut list[INVENTORY_MAX_LEFT_OUT];
    int n = inventory_left_out(v, false, list);
    puts("left out:");
    for (int i = 0; i < n; i++) {
        printf("  %s", list[i].what);
        if (list[i].of) printf(" (%zu of %zu)", list[i].count, list[i].of);
        putchar('\n');
    }
    if (n == 0) puts("  nothing");
}

int cmd_check(const Options *options)
{
    Run run;
    int status = run_begin(&run, options);
    if (status != EXIT_DONE) return status;
    Inventory inventory = inventory_make(run.arena, run.scene);
    print_contents(&run, &inventory);
    print_left_out(&inventory);
    if (fflush(stdout) != 0) status = run_fail(EXIT_FILE, "cannot write to the standard output");
    return run_end(&run, status);
}
