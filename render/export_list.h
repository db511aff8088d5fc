/* What of a scene has to be written, and how finely: its shapes, each once, however many objects share it. */
#ifndef TRIMRAY_EXPORT_LIST_H
#define TRIMRAY_EXPORT_LIST_H

#include "render/scene.h"

typedef struct {
    const Shape *shape;      /* not an object */
    double stretch;          /* at most by how much any of its placements stretches it */
    int n_uses;
    int number;              /* of its declaration in what is written; 0: none yet */
} ExportShape;

typedef struct {
    Arena *arena;
    ExportShape *shapes;     /* primitives and compounds, parts before wholes */
    size_t n, capacity;
    int *slots;              /* by address: 1 + the place in shapes, 0: free */
    size_t n_slots;
    Box meshes;              /* round all that will be a mesh, in the world */
} ExportList;

/* Of all objects. is_mesh: which primitives become meshes. */
ExportList export_list(Arena *a, const Scene *s, bool (*is_mesh)(const Shape *s));

ExportShape *export_find(const ExportList *l, const Shape *s);   /* NULL: not in the list */

/* The chord error where none is asked for: a 2000th of the diagonal of all that becomes a mesh. A picture of it that is 1000
 * pixels wide has no pixel half of which is wrong. */
double export_default_error(const ExportList *l);

#endif
