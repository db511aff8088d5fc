/* Control nets in quadruple precision, and what changes the representation of a surface but not the surface: the same
 * shape in a thousand disguises, each rounded to double once, at the end. */
#ifndef TRIMRAY_STRESS_NET_H
#define TRIMRAY_STRESS_NET_H

#include "nurbs/nurbs.h"
#include "tests/stress/quad.h"

enum { NET_U, NET_V };

typedef struct {
    int k[2], n[2];              /* orders, control points: along u, along v */
    double *knots[2];            /* doubles from the beginning: they are never rounded */
    Quad4 *p;                    /* homogeneous, u fastest */
} Net;

/* A net of n[0] by n[1] points to be filled in, of pieces that join at knots of multiplicity k - 1: n = pieces (k-1) + 1. */
Net net_new(Arena *a, int k_u, int pieces_u, int k_v, int pieces_v);

/* Moves the knots: pieces of the given lengths. */
void net_set_lengths(Net *n, int axis, const double *lengths);

/* Raises the order along an axis; pieces as in net_new. */
void net_raise(Arena *a, Net *n, int axis, int k);

/* Moebius' change of parameter in each piece, turn and turn about: the weights of a piece grow by `ratio` from one end to
 * the other, and shrink again in the next. */
void net_mobius(Net *n, int axis, double ratio);

/* Inserts a knot inside the domain, where its multiplicity is less than k - 1 ([PT97] A5.1). */
void net_insert(Arena *a, Net *n, int axis, double knot);

void net_map(Net *n, const QuadMap *m);

/* The point at (u, v) of the domain. */
Quad3 net_point(const Net *n, double u, double v);

/* As a constructor wants it, rounded. */
SurfaceDesc net_round(Arena *a, const Net *n);

#endif
