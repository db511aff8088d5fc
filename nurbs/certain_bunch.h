/* The search of `method certain` for the rays of a bunch: as certain.h has it for one. */
#ifndef TRIMRAY_CERTAIN_BUNCH_H
#define TRIMRAY_CERTAIN_BUNCH_H

#include "nurbs/certify_bunch.h"
#include "nurbs/tile_tree.h"

/* Of the lanes that are hit; others stay what they were. */
typedef struct {
    double t[BUNCH_WIDTH], t_error[BUNCH_WIDTH], u[BUNCH_WIDTH], v[BUNCH_WIDTH];
    uint32_t tile[BUNCH_WIDTH];
} CertainHits;

/* The lanes that are hit nearer than their limits, or t_max, which become the hits' t: of a tree, or on the tiles that they
 * ask for, items->at, which are so many of their trees. */
Lanes certain_nearest_bunch(const TileTree *tree, RayBunch *b, Lanes lanes, double t_max[], Trace *t, CertainHits *out);
Lanes certain_nearest_on_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, BunchLimits limits, Trace *t,
                               CertainHits *out);

/* The lanes that are blocked before t_max. */
Lanes certain_any_bunch(const TileTree *tree, RayBunch *b, Lanes lanes, const double t_max[], Trace *t);
Lanes certain_any_on_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, const double t_max[], Trace *t);

#endif
