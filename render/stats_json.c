#include "render/stats_json.h"

#include <cjson/cJSON.h>

/* cJSON returns NULL only when memory is exhausted, and then passes NULL on; what remains is checked at the end. */
static void number(cJSON *to, const char *name, double value) { cJSON_AddNumberToObject(to, name, value); }
static void count(cJSON *to, const char *name, uint64_t value) { cJSON_AddNumberToObject(to, name, (double)value); }

static void add_run(cJSON *to, const Run *r)
{
    const Options *o = r->options;
    cJSON_AddStringToObject(to, "scene", r->path);
    count(to, "width", (uint64_t)o->width);
    count(to, "height", (uint64_t)o->height);
    cJSON_AddStringToObject(to, "method", o->nurbs.method == NURBS_METHOD_PAPER ? "paper" : "certain");
    cJSON_AddStringToObject(to, "flattening", o->nurbs.flattening == NURBS_FLATTENING_ADAPTIVE ? "adaptive" : "curvature");
    cJSON_AddBoolToObject(to, "interrupted", r->was_interrupted);
    number(to, "parse_seconds", r->parse_seconds);
    number(to, "prep_seconds", r->prep_seconds + r->counters.prep_seconds);
    number(to, "trace_seconds", r->trace_seconds);
    number(to, "write_seconds", r->write_seconds);
    count(to, "threads", (uint64_t)r->n_threads);
    number(to, "peak_mb", stats_peak_mb());
}

/* "rays" are the paper's: one a pixel. */
static void add_counters(cJSON *to, const Counters *c)
{
    count(to, "rays", c->camera_rays);
    count(to, "shadow_rays", c->shadow_rays);
    count(to, "reflected_rays", c->reflected_rays);
    count(to, "transmitted_rays", c->transmitted_rays);
    count(to, "bv_intersections", c->bv_intersections);
    count(to, "light_bv_intersections", c->light_bv_intersections);
    count(to, "leaf_tests", c->leaf_tests);
    count(to, "nurbs_tests", c->nurbs_tests);
    number(to, "nurbs_seconds", c->nurbs_seconds);
    count(to, "nurbs_hits", c->nurbs_hits);
    count(to, "reported_hits", c->reported_hits);
    count(to, "newton_iterations", c->newton_iterations);
    count(to, "newton_jitters", c->newton_jitters);
    count(to, "certificates", c->certificates);
    count(to, "fallbacks", c->fallbacks);
    count(to, "trim_tests", c->trim_tests);
    count(to, "primitive_tests", c->primitive_tests);
}

/* "surfaces" and "trims" as the paper counts them: instances too; the rest is what is held in memory. */
static void add_inventory(cJSON *to, const Inventory *v)
{
    count(to, "surfaces", v->n_surfaces_seen);
    count(to, "trims", v->n_trims_seen);
    count(to, "distinct_surfaces", v->n_surfaces);
    count(to, "distinct_trims", v->n_trims);
    count(to, "leaves", v->n_leaves);
    count(to, "nurbs_bytes", v->n_bytes);
    cJSON *primitives = cJSON_AddObjectToObject(to, "primitives");
    for (int i = 0; i < v->n_kinds; i++) count(primitives, v->kinds[i].name, v->kinds[i].n_seen);
}

static void add_left_out(cJSON *to, const Inventory *v)
{
    LeftOut list[INVENTORY_MAX_LEFT_OUT];
    int n = inventory_left_out(v, true, list);
    cJSON *array = cJSON_AddArrayToObject(to, "left_out");
    for (int i = 0; i < n; i++) {
        cJSON *entry = cJSON_CreateObject();
        cJSON_AddStringToObject(entry, "what", list[i].what);
        if (list[i].of) count(entry, "count", list[i].count), count(entry, "of", list[i].of);
        cJSON_AddItemToArray(array, entry);
    }
}

const char *stats_json(const Run *run, const Inventory *inventory, Arena *a)
{
    cJSON *root = cJSON_CreateObject();
    add_run(root, run);
    add_inventory(root, inventory);
    add_counters(root, &run->counters);
    add_left_out(root, inventory);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) return NULL;
    const char *copy = arena_printf(a, "%s\n", text);
    cJSON_free(text);
    return copy;
}
