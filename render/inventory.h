/* What a scene is made of and what it did without: for `check` and --stats. */
#ifndef TRIMRAY_INVENTORY_H
#define TRIMRAY_INVENTORY_H

#include "render/scene.h"

#define INVENTORY_MAX_KINDS 64
#define INVENTORY_MAX_LEFT_OUT 8

/* "sphere", 2, 12: two of them, one or both shared by several objects, and a ray sees twelve. */
typedef struct { const char *name; size_t n, n_seen; } InventoryKind;

typedef struct {
    InventoryKind kinds[INVENTORY_MAX_KINDS];   /* primitives only, in order of first appearance */
    int n_kinds;
    size_t n_seen, n_surfaces_seen, n_trims_seen;   /* shared geometry counts each time, as the paper's tables count */
    /* of NURBS surfaces, each counted once; the leaves are those of surfaces that were prepared */
    size_t n_surfaces, n_polynomial, n_untrimmed, n_unprepared;
    size_t n_trims, n_trim_pieces, n_leaves, n_leaves_trimmed_away, n_leaves_untested, n_bytes;
    bool needs_shadow_rays, needs_secondary_rays;
} Inventory;

/* Walks the scene, which scene_prepare has seen. */
Inventory inventory_make(Arena *a, const Scene *s);

/* One thing that was left out: `count` of `of`; of 0: all of it, by the scene as a whole. */
typedef struct { const char *what; size_t count, of; } LeftOut;

/* Lists what was left out; returns how many entries of `list` were filled. Preparation and leaves are only spoken of after
 * tracing: `was_traced`. */
int inventory_left_out(const Inventory *inventory, bool was_traced, LeftOut list[INVENTORY_MAX_LEFT_OUT]);

#endif
