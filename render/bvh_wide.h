/* A tree of boxes with up to sixteen children a node: what BVH_SAH builds are traversed as. Used by bvh.c, and by
 * bvh_bunch.c. */
#ifndef TRIMRAY_BVH_WIDE_H
#define TRIMRAY_BVH_WIDE_H

#include "render/bvh.h"

typedef struct WideBvh WideBvh;

/* From a binary tree of n nodes; the visitor is told items[first] of a leaf, or `first` itself where items is NULL. (These
 * two are in bvh_collapse.c.) */
WideBvh *bvh_wide_build(Arena *a, const BvhNode *nodes, uint32_t n, const uint32_t *items);
/* From a binary tree whose items are trees themselves, parts[i], or items (NULL); they are copied, and their items counted
 * from first_item[i]. */
WideBvh *bvh_wide_join(Arena *a, const BvhNode *nodes, uint32_t n, const uint32_t *items, const WideBvh *const parts[],
                       const uint32_t first_item[]);
void bvh_wide_set_items(WideBvh *w, const BvhItems *items);              /* as bvh_set_items */
const void *bvh_wide_item(const WideBvh *w, uint32_t i);
uint32_t bvh_wide_node_count(const WideBvh *w);
const WideBvh *bvh_wide_of(const Bvh *b);                                /* NULL: there is nothing in it, or it is binary */
bool bvh_wide_any(const WideBvh *w, const Ray *r, double t_max, BvhVisit visit, void *context, Trace *t);
bool bvh_wide_traverse(const WideBvh *w, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t);

#endif
