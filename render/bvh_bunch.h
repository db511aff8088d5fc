/* Bunches of rays through a tree of boxes. */
#ifndef TRIMRAY_BVH_BUNCH_H
#define TRIMRAY_BVH_BUNCH_H

#include "render/bunch.h"
#include "render/bvh.h"

/* As BvhVisit for rays of a bunch, each with its t_max[i]: those of `lanes` meet the box of the item that they ask for.
 * Returns those of them that have ended. */
typedef Lanes (*BvhBunchVisit)(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t);

/* bvh_traverse and bvh_any for the rays of `lanes`: each visits at least the items whose boxes it meets before t_max[i],
 * once; nearest first as far as the rays agree about that. Boxes are counted once for each ray. Returns the rays that visits
 * ended. t_max has BUNCH_WIDTH numbers, whatever is in those of other rays. */
Lanes bvh_traverse_bunch(const Bvh *tree, RayBunch *b, Lanes lanes, double t_max[], BvhBunchVisit visit, void *context,
                         Trace *t);
Lanes bvh_any_bunch(const Bvh *tree, RayBunch *b, Lanes lanes, const double t_max[], BvhBunchVisit visit, void *context,
                    Trace *t);

#endif
