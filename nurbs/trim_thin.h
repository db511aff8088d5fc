/* Trims for tessellation: the chains with no more points than a chord error asks for, as segments on the grid. */
#ifndef TRIMRAY_TRIM_THIN_H
#define TRIMRAY_TRIM_THIN_H

#include "nurbs/grid.h"

/* In a span's own grid. */
typedef struct { GridPoint a, b; } GridSegment;

typedef struct {
    const GridSegment *segments;
    const uint32_t *first;           /* those of span (i, j) are [first[c], first[c+1]), c = j grid->u.n + i */
    const TrimTree *tree;            /* of the thinned loops: which side of a segment is kept */
} GridTrims;

/* All trims of a surface that has some. The points between two that are kept are within `error` in space of the curve on the
 * surface that the chord is; borders of spans are crossed at vertices. */
GridTrims grid_trims(Arena *a, Arena *scratch, const Grid *grid, double error);

#endif
