/* Rays of a bunch that part at once, through a tree of wide boxes: what bvh_bunch.c leaves to this. */
#ifndef TRIMRAY_BVH_APART_H
#define TRIMRAY_BVH_APART_H

#include "render/bvh_bunch.h"
#include "render/bvh_wide.h"

/* Those of `lanes` that visits end. b->slabs are made for this tree, and all of `lanes` meet its bounds. nearest_first: as
 * bvh_traverse_bunch; else as bvh_any_bunch. */
Lanes bvh_walk_apart(const WideBvh *tree, RayBunch *b, Lanes lanes, double t_max[], BvhBunchVisit visit, void *context,
                     bool nearest_first, Trace *t);

#endif
