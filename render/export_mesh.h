/* A scene's geometry as triangles in the world: Wavefront OBJ and STL. */
#ifndef TRIMRAY_EXPORT_MESH_H
#define TRIMRAY_EXPORT_MESH_H

#include "render/export_list.h"

#include <stdio.h>

typedef struct { const char *name; size_t n; } ExportLeftOut;   /* primitives that have no mesh: planes, for one */
typedef struct { ExportLeftOut *list; size_t n, capacity; size_t n_triangles; } ExportMeshResult;

/* One group for each primitive; with normals and uv. */
ExportMeshResult export_obj(FILE *file, Arena *a, const Scene *s, const ExportList *list, double chord_error);

/* Binary STL, in single precision. */
ExportMeshResult export_stl(FILE *file, Arena *a, const Scene *s, const ExportList *list, double chord_error);

#endif
