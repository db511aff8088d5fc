/* A tree of boxes with eight children a node, tested together: what BVH_SAH builds are traversed as. Used by bvh.c alone. */
#ifndef TRIMRAY_BVH_WIDE_H
#define TRIMRAY_BVH_WIDE_H

#include "render/bvh.h"

/* A node of the binary tree that is collapsed. */
typedef struct {
    Box box;
    uint32_t first;      /* inner: the first of two children, side by side; leaf: the first of its items */
    uint32_t n_items;    /* 0: an inner node */
} BvhNode;

typedef struct WideBvh WideBvh;

/* From a binary tree whose leaves hold one item each; items[i] is what the visitor is told. */
WideBvh *bvh_wide_build(Arena *a, const BvhNode *nodes, const uint32_t *items);
uint32_t bvh_wide_node_count(const WideBvh *w);
bool bvh_wide_traverse(const WideBvh *w, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t);

#endif
