/* Triangle meshes: POV-Ray's mesh and mesh2. Numbers are kept in single precision, as POV-Ray keeps them. */
#ifndef TRIMRAY_MESH_H
#define TRIMRAY_MESH_H

#include "render/object.h"

typedef struct { float x, y, z; } MeshVector;
typedef struct { float u, v; } MeshUv;
typedef struct { uint32_t corner[3]; } MeshFace;   /* indices of vertices, of normals, of uvs */

#define MESH_NONE UINT32_MAX                       /* no normals: the face is flat; no texture of its own */

/* All arrays are borrowed; indices must be in range. */
typedef struct {
    const MeshVector *vertices, *normals;          /* normals: of any length, not 0 */
    const MeshUv *uvs;
    const MeshFace *faces;                         /* n_faces of each; faces without an area are left out */
    const MeshFace *normal_faces, *uv_faces;       /* NULL: all are flat; none has a uv of its own */
    const uint32_t *textures;                      /* of each face, an index of looks; NULL: all are like the whole */
    const Texture *const *looks;
    uint32_t n_vertices, n_faces, n_looks;
    bool has_inside;                               /* inside: a ray along inside_vector crosses an odd number of faces */
    Vec3 inside_vector;
} MeshDesc;

Shape *mesh_new(Arena *a, const MeshDesc *desc);

/* For export, in mesh_export.c. */
void mesh_desc_write(const MeshDesc *d, Sdl *out);               /* "mesh2 { ...", left open */
void mesh_desc_tessellate(const MeshDesc *d, MeshSink *out);     /* each face with corners of its own */

#endif
