/* The interval objects of [MCFS00] section 2.2: what a leaf of the tree of boxes knows. */
#ifndef TRIMRAY_LEAF_H
#define TRIMRAY_LEAF_H

#include "nurbs/refine.h"
#include "render/bvh.h"

/* A smooth stretch of one direction: it ends where the surface may have a corner or a gap (knots_breaks), so that within it
 * one derivative leads to the next. */
typedef struct { double lo, hi; } Piece;

typedef struct {
    double u0, u1, v0, v1;            /* the interval */
    const Piece *piece_u, *piece_v;   /* the smooth stretches that it lies in */
    double size;                      /* diagonal of the box of its control points */
    double bend;                      /* in its spans, a step of s leaves ends within bend s^2 of where S_u and S_v say */
    double bulge;                     /* on the leaf, S is within this of its tangent parallelogram at the middle */
    double turn_u, turn_v;            /* S_u and S_v of the leaf are within these of the middle's, for half a leaf's step */
    SurfacePoint middle;              /* of the interval: the guess that every ray starts from */
    int mu_u, mu_v;                   /* its spans */
    bool needs_trim_test;             /* false: wholly kept */
} Leaf;

typedef struct {
    const Leaf *leaves;
    uint32_t n_leaves;
    const Bvh *bvh;                   /* over the boxes of the leaves, item i is leaves[i] */
    uint32_t n_cut, n_untested;       /* dropped because trimmed away; kept without a trim test on a trimmed surface */
} LeafTree;

#endif
