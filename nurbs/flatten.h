/* Where the surface is cut into leaves ([MCFS00] section 2.1): the curvature heuristic, and adaptive subdivision. */
#ifndef TRIMRAY_FLATTEN_H
#define TRIMRAY_FLATTEN_H

#include "nurbs/surface.h"

/* The borders of the cells along one direction, ascending: the ends of the domain, every knot between them, and what
 * flattening puts between those. */
typedef struct { double *at; int n; } Cuts;

typedef enum { FLATTEN_U, FLATTEN_V } FlattenDirection;

/* Room for the result is taken from `a`, for the work from `scratch`. */
Cuts flatten_cuts(const Surface *s, const NurbsOptions *o, FlattenDirection d, Arena *a, Arena *scratch);

/* What the heuristic knows of one curve on the span mu, p[0 .. k-1] its Euclidean control points mu-k+1 .. mu:
 *   turn     max|A| (t_{i+1} - t_i) / avg|V|: curvature times length, about the angle in radians that it turns through
 *   length   avg|V| (t_{i+1} - t_i), in units of the scene
 * so that the paper's n = C turn sqrt(length). Both are 0 for a curve that has shrunk to a point. */
typedef struct { double turn, length; } FlattenCurve;
FlattenCurve flatten_curve(int k, const double tau[], int mu, const Vec3 p[]);

#endif
