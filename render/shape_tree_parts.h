/* What a tree of shapes is made of: for its searches, of one ray (shape_tree.c) and of a bunch (shape_tree_bunch.c). */
#ifndef TRIMRAY_SHAPE_TREE_PARTS_H
#define TRIMRAY_SHAPE_TREE_PARTS_H

#include "render/bvh.h"
#include "render/shape_tree.h"

typedef struct {
    const Shape *shape;
    const Shape *bare;         /* what it is to those who only ask whether it blocks */
    uint32_t first_index;      /* primitives of the parts before it */
    unsigned char flags;
    bool has_took;             /* its type has: the shape need not be read for it */
} Part;

/* What the joined tree has: an item of a part, or the part itself. */
typedef struct {
    uint32_t part, item;
    const void *at;            /* where the part has the item; NULL: not known */
} Item;
#define ALL_OF_IT UINT32_MAX

struct ShapeTree {
    const Part *parts;
    uint32_t n;
    unsigned flags;            /* that any of them has */
    uint32_t lowest_rank;      /* of a part in a tree: unbounded ones may come before all others */
    Bvh *bvh;                  /* over all parts; the boxes of unbounded ones were given as empty */
    Bvh *joined;               /* with the trees that parts lend in place of their boxes; NULL: none does */
    const Item *items;         /* of `joined` */
    const Bvh *searched;       /* of the two, for one hit or whether there is any; NULL: there is nothing in it */
    const ShapeType *lender;   /* of all that lend */
    const uint32_t *unbounded;
    uint32_t n_unbounded;
};

/* What an item of the tree that is searched is: it comes from memory while it is looked at. */
static inline Item item_at(const ShapeTree *tree, uint32_t i, const Trace *t)
{
    if (!tree->joined) return (Item){ i, ALL_OF_IT, NULL };
    Item item = tree->items[i];
    if (t->fetches_ahead) {
        __builtin_prefetch(&tree->parts[item.part]);
        if (item.at) __builtin_prefetch(item.at), __builtin_prefetch((const char *)item.at + 64);
    }
    return item;
}

#endif
