/* What of a tree of boxes may be met within a pyramid: as one node to enter the tree by. */
#ifndef TRIMRAY_PYRAMID_H
#define TRIMRAY_PYRAMID_H

#include "render/bvh_collapse.h"

/* All points A + z (e + a f + b g), z >= 0, lo[0] <= a <= hi[0], lo[1] <= b <= hi[1], where e is a coordinate's direction or
 * its opposite, f and g are those of the next two coordinates; |a|, |b| at most 1. */
typedef struct {
    Vec3 apex;
    int axis;                /* of e */
    bool is_negative;        /* e points that coordinate's opposite way */
    double lo[2], hi[2];
    double slack;            /* points as far away as this count as within */
} Pyramid;

/* Makes *entry of those children of `from`, a node that leads into the tree, that the pyramid may meet, and opens those of
 * them that are nodes themselves, the largest first, as long as what it meets of their children finds room. Returns whether
 * nodes are left among them: a narrower pyramid may then have fewer. */
bool pyramid_entry(const Pyramid *p, const WideNode *tree, const WideNode *from, WideNode *entry);

#endif
