/* The domain of a surface as an integer grid: 2^30 steps to each span that is not empty, so that knots are grid lines and
 * equality is exact. What tessellation works on. */
#ifndef TRIMRAY_GRID_H
#define TRIMRAY_GRID_H

#include "nurbs/surface.h"
#include "nurbs/triangulate.h"

#define GRID_SPAN ((int64_t)1 << GRID_BITS)

/* One direction. */
typedef struct {
    const double *tau;
    int n;                           /* spans */
    const int *mu;                   /* their knots: [tau[mu], tau[mu+1]] */
    const int *stretch;              /* the number of the smooth stretch that each lies in (knots_breaks) */
    const bool *has_gap;             /* does the surface tear between this span and the one before it? (C^-1) */
} GridAxis;

typedef struct {
    const Surface *s;
    GridAxis u, v;
} Grid;

Grid grid_make(Arena *a, const Surface *s);

/* A span's own point (0 to 2^30) as a parameter: exact at the knots. And back, rounded and clamped to the span. */
double grid_param(const GridAxis *axis, int span, int64_t local);
int64_t grid_local(const GridAxis *axis, int span, double t);
int grid_span(const GridAxis *axis, double t);   /* the last one that begins at t or before */

#endif
