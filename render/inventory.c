#include "render/inventory.h"

#include "nurbs/nurbs.h"

#include <stdlib.h>
#include <string.h>

typedef struct { Arena *arena; const Shape **shapes; size_t n, capacity; } Walk;

/* Geometry may be shared, so the walk meets some primitives several times. */
static void walk(Walk *w, const Shape *s)
{
    Shape *const *parts;
    if (!s->type->parts) {
        ARENA_PUSH(w->arena, w->shapes, w->n, w->capacity) = s;
        return;
    }
    uint32_t n = s->type->parts(s, &parts);
    for (uint32_t i = 0; i < n; i++) walk(w, parts[i]);
}

static int by_address(const void *a, const void *b)
{
    uintptr_t x = (uintptr_t)*(const Shape *const *)a, y = (uintptr_t)*(const Shape *const *)b;
    return (x > y) - (x < y);
}

static InventoryKind *kind_of(Inventory *out, const char *name)
{
    int i = 0;
    while (i < out->n_kinds && strcmp(out->kinds[i].name, name) != 0) i++;
    if (i == INVENTORY_MAX_KINDS) return &out->kinds[i - 1];   /* more kinds than there are */
    if (i == out->n_kinds) out->kinds[out->n_kinds++] = (InventoryKind){ .name = name };
    return &out->kinds[i];
}

static void count_surface(Inventory *out, const NurbsInfo *info)
{
    out->n_surfaces++;
    out->n_polynomial += info->is_polynomial;
    out->n_untrimmed += !info->has_trims;
    out->n_unprepared += !info->was_prepared;
    out->n_trims += (size_t)info->n_trims;
    out->n_trim_pieces += (size_t)info->n_trim_pieces;
    out->n_leaves += (size_t)info->n_leaves;
    out->n_leaves_trimmed_away += (size_t)info->n_leaves_trimmed_away;
    out->n_leaves_untested += (size_t)info->n_leaves_untested;
    out->n_bytes += info->bytes;
}

/* A primitive that the walk met n_seen times. */
static void count_shape(Inventory *out, const Shape *s, size_t n_seen)
{
    InventoryKind *kind = kind_of(out, s->type->name);
    NurbsInfo info;
    kind->n++, kind->n_seen += n_seen, out->n_seen += n_seen;
    if (!nurbs_shape_info(s, &info)) return;
    count_surface(out, &info);
    out->n_surfaces_seen += n_seen;
    out->n_trims_seen += n_seen * (size_t)info.n_trims;
}

Inventory inventory_make(Arena *a, const Scene *s)
{
    Inventory out = { .needs_shadow_rays = s->needs_shadow_rays, .needs_secondary_rays = s->needs_secondary_rays };
    Walk w = { .arena = a };
    for (size_t i = 0; i < s->n_objects; i++) walk(&w, &s->objects[i]->shape);
    if (w.n) qsort(w.shapes, w.n, sizeof *w.shapes, by_address);
    for (size_t i = 0, end; i < w.n; i = end) {
        for (end = i + 1; end < w.n && w.shapes[end] == w.shapes[i]; end++) continue;
        count_shape(&out, w.shapes[i], end - i);
    }
    return out;
}

static void add(LeftOut *list, int *n, const char *what, size_t count, size_t of)
{
    if (count) list[(*n)++] = (LeftOut){ what, count, of };
}

int inventory_left_out(const Inventory *v, bool was_traced, LeftOut list[INVENTORY_MAX_LEFT_OUT])
{
    int n = 0;
    add(list, &n, "NURBS: the scene has no such surface", v->n_surfaces == 0, 0);
    add(list, &n, "trim structure: surfaces without trims", v->n_untrimmed, v->n_surfaces);
    add(list, &n, "division by weights: surfaces that are polynomial", v->n_polynomial, v->n_surfaces);
    add(list, &n, "shadow rays: no light asks for them", !v->needs_shadow_rays, 0);
    add(list, &n, "secondary rays: no texture reflects or transmits", !v->needs_secondary_rays, 0);
    if (!was_traced) return n;
    add(list, &n, "preparation: surfaces that no ray reached", v->n_unprepared, v->n_surfaces);
    add(list, &n, "trimmed away: leaves that were never built", v->n_leaves_trimmed_away,
        v->n_leaves + v->n_leaves_trimmed_away);
    add(list, &n, "trim test: leaves that no trim crosses", v->n_leaves_untested, v->n_leaves);
    return n;
}
