/* A bounding volume hierarchy over boxes. It knows neither shapes nor what a ray is for: scene, unions, meshes and NURBS
 * leaves share it. */
#ifndef TRIMRAY_BVH_H
#define TRIMRAY_BVH_H

#include "render/arena.h"
#include "render/box.h"
#include "render/ray.h"
#include "render/shape.h"

typedef enum {
    BVH_MEDIAN,   /* [MCFS00] section 2.2: sort along the axis of greatest extent, split the boxes in half */
    BVH_SAH       /* binned surface area heuristic, then collapsed to sixteen children a node (bvh_wide.c) */
} BvhSplit;

/* Builds a tree over n boxes (n may be 0; empty boxes are left out), deterministically. Infinite boxes are not allowed:
 * keep unbounded things outside. Leaves hold one box. */
Bvh *bvh_build(Arena *a, const Box *boxes, uint32_t n, BvhSplit split);

/* The same from a tree that is there already: a node is inner (n_items 0; its two children are `first` and first + 1) or
 * holds item `first` (n_items 1). Node 0 is the root; nodes that cannot be reached from it are allowed. */
typedef struct {
    Box box;
    uint32_t first, n_items;
} BvhNode;
Bvh *bvh_from_tree(Arena *a, const BvhNode *nodes, uint32_t n_nodes);

/* One tree in place of a tree over n boxes, some of which have trees within them, by BVH_SAH: parts[i], or NULL where box i
 * is itself an item. The items of part i become first_item[i], first_item[i] + 1, ... */
Bvh *bvh_join(Arena *a, const Box *boxes, const Bvh *const parts[], const uint32_t first_item[], uint32_t n);

/* Where the visitor has its items: to be fetched from memory while others are looked at, in this tree and in those that it
 * is joined to. Known for trees by BVH_SAH. */
typedef struct {
    const void *first;             /* of all items, one after the other, */
    size_t size;                   /* so many bytes each */
    const void *const *behind;     /* what is read with each; most neighbours should have it in common. NULL: nothing */
    size_t behind_size;
} BvhItems;
void bvh_set_items(Bvh *b, const BvhItems *items);
const void *bvh_item(const Bvh *b, uint32_t i);      /* NULL: nowhere */

Box bvh_bounds(const Bvh *b);
uint32_t bvh_node_count(const Bvh *b);
uint32_t bvh_item_count(const Bvh *b);         /* one more than the largest item that it may tell a visitor */

/* Called for item `i` (an index into the boxes given to bvh_build) whose box the ray meets nearer than *t_max. It may lower
 * *t_max. Returns true to end the traversal (an any-hit query that has its answer). */
typedef bool (*BvhVisit)(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t);

/* Visits items nearest box first, culled by *t_max as it shrinks; counts boxes into t. Returns whether a visit ended it. */
bool bvh_traverse(const Bvh *b, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t);

/* The same in any order, for a visitor that leaves *t_max alone and ends at the first answer. */
bool bvh_any(const Bvh *b, const Ray *r, double t_max, BvhVisit visit, void *context, Trace *t);

#endif
