/* Meshes of a model, as Embree wants them: single precision. */
#ifndef TRIMRAY_BENCH_MESH_H
#define TRIMRAY_BENCH_MESH_H

#include "tests/bench/bench.h"

/* chord_error in the model's units. By trimray's own tessellation, trims respected. */
typedef struct Mesh {
    float *vertices;             /* 3 each */
    uint32_t *triangles;         /* 3 each */
    size_t n_vertices, n_triangles;
    double seconds;
} Mesh;
Mesh mesh_make(Arena *a, const Model *m, double chord_error);

/* One grid of (steps+1)^2 vertices for each Bézier piece, row by row; trims are not respected. */
typedef struct { float *vertices; size_t n_vertices, n_grids; int steps; double seconds; } GridMesh;
GridMesh mesh_grids(Arena *a, const Model *m, int steps);

#endif
