/* Where tessellation puts its triangles: lists that grow, in the arena of whoever exports. */
#ifndef TRIMRAY_MESH_SINK_H
#define TRIMRAY_MESH_SINK_H

#include "render/shape.h"

typedef struct {
    Vec3 point;              /* on the surface */
    Vec3 normal;             /* the surface's own there, unit */
    Vec2 uv;                 /* as Attributes.uv has it */
} MeshVertex;

typedef struct { uint32_t v[3]; } MeshTriangle;   /* counterclockwise seen from the side that the normals point to */

struct MeshSink {
    Arena *arena;            /* the lists lie here */
    MeshVertex *vertices;
    size_t n_vertices, vertices_capacity;
    MeshTriangle *triangles;
    size_t n_triangles, triangles_capacity;
};

static inline MeshSink mesh_sink(Arena *a) { return (MeshSink){ .arena = a }; }

/* The number of the new vertex. */
uint32_t mesh_sink_vertex(MeshSink *m, MeshVertex v);

/* Left out if two of its corners are at the same point. */
void mesh_sink_triangle(MeshSink *m, uint32_t a, uint32_t b, uint32_t c);

/* A grid of n_u by n_v cells of two triangles over the unit square; at(context, u, v) makes its vertices. */
typedef MeshVertex (*MeshAt)(const void *context, double u, double v);
void mesh_sink_grid(MeshSink *m, int n_u, int n_v, MeshAt at, const void *context);

/* A circle about an axis, for strips. It has no direction that a scene could see. */
typedef struct { Vec3 centre, x, y; double radius; } MeshCircle;   /* x, y: unit, x cross y along the axis */
MeshCircle mesh_circle(Vec3 centre, Vec3 unit_axis, double radius);

/* The strip between two circles with the same x and y, either of which may be a point: the side of a cone, a disc. Seen from
 * the side that the normals point to, b is above a, and x to y goes to the right. uv is x and y, as POV-Ray has it. */
void mesh_sink_strip(MeshSink *m, MeshCircle a, MeshCircle b, int n);

/* Into how many chords an arc of `angle` radians must be divided that each stays within `error` of it; 1 at least. */
int mesh_arc_steps(double radius, double angle, double error);

#endif
