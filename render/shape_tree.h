/* Several shapes under one tree: what a union and a scene are made of. Finite parts stand in a BVH, unbounded ones in a list
 * beside it. */
#ifndef TRIMRAY_SHAPE_TREE_H
#define TRIMRAY_SHAPE_TREE_H

#include "render/shape.h"

typedef struct ShapeTree ShapeTree;

/* Parts and flags are borrowed. flags: one byte for each part (NULL: all 0). Of hits at exactly the same t, that of the
 * earlier part wins, whatever the order of the search; with unbounded_first, unbounded parts count as earlier than all
 * others. */
ShapeTree *shape_tree_build(Arena *a, Shape *const parts[], const unsigned char *flags, uint32_t n, bool unbounded_first);

/* Joins the trees that parts lend (shape.h) with the tree over the parts; prepares these parts, for the preparation of
 * `whole`. */
void shape_tree_join(ShapeTree *tree, const Shape *whole, Arena *a, Trace *t);

/* As hit() and blocks() of a shape, over the parts none of whose flags is in `skip`. Hit.index is offset by the
 * primitives of the parts before the one that was hit. */
bool shape_tree_hit(const ShapeTree *tree, const Ray *r, unsigned skip, Hit *best, Trace *t);
void shape_tree_all_hits(const ShapeTree *tree, const Ray *r, HitList *out, Trace *t);   /* of all parts */
/* Adds to t->left_out the flags of parts that are left out: if nothing blocks, of all whose boxes the ray meets. */
bool shape_tree_blocks(const ShapeTree *tree, const Ray *r, unsigned skip, double t_max, Trace *t);
/* The same for rays of a bunch: those that were hit, that are blocked; what is left out is added to lane[i].left_out. */
Lanes shape_tree_hit_bunch(const ShapeTree *tree, RayBunch *b, Lanes lanes, unsigned skip, Hit best[], Trace *t);
Lanes shape_tree_blocks_bunch(const ShapeTree *tree, RayBunch *b, Lanes lanes, unsigned skip, const double t_max[],
                              Trace *t);

#endif
