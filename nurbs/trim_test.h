/* The tests against a finished hierarchy of trims, and what they work on. trim_keeps and trim_class, the public ones, are
 * declared in trim_tree.h. */
#ifndef TRIMRAY_TRIM_TEST_H
#define TRIMRAY_TRIM_TEST_H

#include "nurbs/trim_chain.h"

typedef struct TrimNode TrimNode;

/* Trims of one level under one parent. They share one direction, and what is outside all of them shares one fate:
 * cut away if they are regions, kept if they are holes. An empty list has the fate of its parent's inside. */
typedef struct {
    bool keeps_outside;
    int n;
    TrimNode **trims;            /* neighbours in the list are neighbours in the plane */
    TrimBoxes boxes;             /* of the trims, one each; the topmost is the list's box */
} TrimList;

struct TrimNode {
    TrimChain chain;
    int index;                   /* in TrimInput */
    bool is_region;              /* keeps what it encloses; false: a hole */
    TrimList inner;              /* the trims directly inside it */
};

struct TrimTree {
    TrimRect domain;
    TrimList top;
    int n_loops, n_pieces;
    bool keep_left;              /* as TrimInput had it */
};

/* The domain's border is met by points a hair inside it, so that trims that run along the border let the border be. This
 * is how far inside, of the domain: at the upper ends the least that a double can tell, at the lower ends so little that
 * no curve is between, and enough that products do not underflow. */
#define TRIM_INSET_LOW 0x1p-100
#define TRIM_INSET_HIGH 0x1p-53

/* The parameters as all tests take them: in the unit square, inset. */
WidePoint trim_test_point(const TrimTree *t, double u, double v);

#endif
