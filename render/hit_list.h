/* All hits of a ray, for those who must see more than the nearest: CSG, clipping, counting. A list lives in a thread's
 * scratch arena between a mark and its reset: no memory is asked of the system for a ray. */
#ifndef TRIMRAY_HIT_LIST_H
#define TRIMRAY_HIT_LIST_H

#include "render/shape.h"

struct HitList {
    Arena *arena;
    Hit *hits;                /* whoever fills the list appends a run that ascends in t */
    size_t n, capacity;
    double t_max;             /* what is not nearer is not asked for */
};

static inline HitList hit_list_make(Arena *scratch, double t_max) { return (HitList){ .arena = scratch, .t_max = t_max }; }
static inline Hit *hit_list_add(HitList *l) { return &ARENA_PUSH(l->arena, l->hits, l->n, l->capacity); }

/* Adds a hit of a primitive, if it lies in (r->t_min, l->t_max); as hit_set. */
static inline void hit_list_offer(HitList *l, const Ray *r, double t, double t_error, const Shape *shape, uint32_t leaf)
{
    if (t > r->t_min && t < l->t_max) hit_set(hit_list_add(l), t, t_error, 0, 0, shape, leaf);
}

/* Sorts the hits from `first` on by t; at equal t the one of lower index comes first. */
void hit_list_sort(HitList *l, size_t first);

/* Appends all hits of s in (r->t_min, out->t_max), ascending. Shapes without all_hits() are asked for their nearest hit
 * again and again, each time from beyond the last one by twice its error: found again it would lie within that. */
void shape_all_hits(const Shape *s, const Ray *r, HitList *out, Trace *t);

#endif
