/* Points and first derivatives by partial refinement of the original mesh ([MCFS00] sections 2.4 and 2.5): the inner loop
 * of `method paper`. */
#ifndef TRIMRAY_REFINE_H
#define TRIMRAY_REFINE_H

#include "nurbs/surface.h"

/* What refinement at one parameter takes from one direction of the mesh: c(t) = sum value[i] P[first+i] and
 * c'(t) = sum slope[i] P[first+i], over `count` homogeneous points. */
typedef struct {
    int first, count;
    double value[NURBS_MAX_ORDER], slope[NURBS_MAX_ORDER];
} RefineRow;

/* t in the span mu or at either end of it (tau[mu] < tau[mu+1]): at its upper end the limit from below. */
void refine_row(int k, const double tau[], int mu, double t, RefineRow *out);

typedef struct { Vec3 point, s_u, s_v; } SurfacePoint;

/* S, S_u and S_v at (u, v), of the spans mu_u and mu_v that it lies in or at an end of. Never divides by zero; the error of
 * the point is at most s->rounding (surface.h). */
void refine_evaluate(const Surface *s, int mu_u, double u, int mu_v, double v, SurfacePoint *out);

#endif
