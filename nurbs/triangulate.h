/* A constrained triangulation of a rectangle on an integer grid: given points become vertices, given segments become edges.
 * All decisions are exact. Segments may touch, overlap and cross: crossings become vertices, rounded to the grid. */
#ifndef TRIMRAY_TRIANGULATE_H
#define TRIMRAY_TRIANGULATE_H

#include "render/arena.h"

#include <stdint.h>

#define GRID_BITS 30   /* coordinates are 0 to 2^30, so that twice an area fits 64 bits */

typedef struct { int64_t x, y; } GridPoint;

typedef struct {
    int v[3];                /* counterclockwise */
    int beside[3];           /* the triangle across the edge that is opposite to v[i]; -1: none */
    bool is_wall[3];         /* that edge belongs to a segment */
    int part;                /* triangles with no wall between them are one part */
} GridTriangle;

typedef struct {
    Arena *arena;
    GridPoint *points;
    size_t n_points, points_capacity;
    GridTriangle *triangles;
    size_t n_triangles, triangles_capacity;
    int last;                /* where the last search ended */
} Triangulation;

/* Two triangles; points 0 to 3 are the corners, counterclockwise from `low`. */
Triangulation triangulation_of(Arena *a, GridPoint low, GridPoint high);

/* The number of the vertex at p, which lies in the closed rectangle. */
int triangulation_add(Triangulation *t, GridPoint p);

/* Makes edges of the segment between two vertices. */
void triangulation_join(Triangulation *t, int a, int b);

/* Numbers the parts; returns how many there are. */
int triangulation_parts(Triangulation *t);

/* Twice the area of the triangle a, b, c: positive if it is counterclockwise. */
static inline int64_t grid_area(GridPoint a, GridPoint b, GridPoint c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Where the line through p and q is at x = at, rounded to the grid; p.x < at < q.x or the reverse. Between p.y and q.y. */
int64_t grid_cross(GridPoint p, GridPoint q, int64_t at);

#endif
