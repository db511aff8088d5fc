/* The nodes of a tree of sixteen-wide boxes: what bvh_collapse.c makes and bvh_wide.c walks.
 *
 * With eight children a tree has a level more, and each is a line of memory to wait for: of 4096 surfaces a random ray takes
 * 12 % longer; where all is in the cache, 3 %. */
#ifndef TRIMRAY_BVH_COLLAPSE_H
#define TRIMRAY_BVH_COLLAPSE_H

#include "render/bvh_wide.h"

#define WIDE_WIDTH 16
#define WIDE_IS_ITEM 0x80000000u

typedef struct {
    _Alignas(64) float side[2][3][WIDE_WIDTH];  /* lo and hi by axis; children that do not exist: lo +inf, hi -inf */
    uint32_t child[WIDE_WIDTH];    /* a node, or WIDE_IS_ITEM and an item */
    uint32_t n_children, exists;   /* exists: a bit for each */
    uintptr_t items;               /* where item 0 would be if all lay as the node's do, lent_size apart; 0: not known */
    const char *behind;            /* what is read with the node's items; NULL: not known */
} WideNode;

struct WideBvh {
    WideNode *nodes;               /* the root first */
    uint32_t n_nodes;
    Box bounds;
    double largest, diagonal;      /* the largest coordinate of the bounds, and their diagonal */
    bool is_large;                 /* more than a cache of the second level has: what a ray needs next is fetched ahead */
    bool is_single;                /* it has one item alone: */
    uint32_t single;
    const char *items;             /* where the visitor has them, and how large they are; NULL: not known */
    size_t item_size, lent_size;   /* lent_size: of items where the parts have them that were joined */
    size_t behind_size;
};

#endif
