/* A surface's domain cut into cells so small that any triangles within one are near enough to the surface. */
#ifndef TRIMRAY_CELLS_H
#define TRIMRAY_CELLS_H

#include "nurbs/patch.h"
#include "nurbs/trim_thin.h"

typedef struct {
    int i, j;                        /* its span */
    GridPoint low, high;             /* in the span's own grid */
    const GridSegment *segments;     /* of trims, within it; none: wholly kept */
    int n_segments;
} Cell;

/* A vertex at `at` along a grid line. Both in steps from the beginning of the domain. */
typedef struct { int64_t line, at; } GridStop;

typedef struct { GridStop *stops; size_t n, capacity; } GridStops;

typedef struct {
    const Cell *cells;
    size_t n_cells;
    const Patch *patches;            /* of the spans, u fastest */
    const TrimTree *trims;           /* as the segments have them (trim_thin.h); NULL: none */
    GridStops across_u, across_v;    /* vertices on lines of constant u, of constant v, sorted: all on the cells' borders */
    bool is_closed_u, is_closed_v;   /* the surface ends where it begins: the two borders share their stops, at the first */
    bool is_point[4];                /* the borders u = u0, u = u1, v = v0, v = v1 are a point (a pole) */
} Cells;

/* Any triangles whose corners are on the surface over one cell are within chord_error of it, and it of them; trims too are
 * within it. Cells that are trimmed away are left out. */
Cells cells_make(Arena *a, Arena *scratch, const Grid *grid, double chord_error);

/* The stops of a line in [from, to]: the first, and how many. */
const GridStop *cells_stops(const GridStops *s, int64_t line, int64_t from, int64_t to, int *n);

#endif
