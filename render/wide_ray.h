/* A ray as a tree of wide boxes sees it (bvh_wide.c). A thread keeps its last one: trees within trees, in the same
 * space, do not make it again. */
#ifndef TRIMRAY_WIDE_RAY_H
#define TRIMRAY_WIDE_RAY_H

#include "render/box.h"
#include "render/ray.h"

typedef struct {
    float inverse[3], near_shift[3], far_shift[3];
    int near_side[3];              /* which side of a box the ray meets first */
    double start, scale;           /* its own t = (t of the caller - start) * scale */
} Slabs;

typedef struct {
    Ray ray;                       /* which it is; all zero: none */
    Box bounds;                    /* for trees within these */
    Slabs slabs;
} WideRay;

#endif
