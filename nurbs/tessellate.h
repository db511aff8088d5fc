/* A trimmed surface as triangles within a chord error. */
#ifndef TRIMRAY_TESSELLATE_H
#define TRIMRAY_TESSELLATE_H

#include "nurbs/surface.h"
#include "render/mesh_sink.h"

/* Appends to `out`. Every vertex is on the surface; mesh and trimmed surface are within chord_error of each other, the
 * mesh's borders and the trims too, down to the size in space of TRIM_CHORD (trim_flat.h), which is how exact trims are at
 * all. All triangles that meet share their vertices: no gaps, no vertex on an edge of another triangle. (Where trims cross
 * each other at a cell's border, within the tolerances of trim_cross.h, a gap of 2^-30 of a span may be left.) Where the
 * surface may have a corner (a knot of multiplicity order - 1, the ends of a closed direction, a pole) there is a vertex, at
 * the same point, for each side, with its own normal. */
void tessellate_surface(const Surface *s, double chord_error, MeshSink *out);

#endif
