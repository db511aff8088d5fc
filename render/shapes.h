/* The constructors of all primitives and compounds. Each returns a shape in the arena, or NULL for input that describes
 * none (zero radius where POV-Ray refuses it, ...); the parser says so with a place. */
#ifndef TRIMRAY_SHAPES_H
#define TRIMRAY_SHAPES_H

#include "render/shape.h"
#include "render/xform.h"

Shape *sphere_new(Arena *a, Vec3 centre, double radius);
Shape *plane_new(Arena *a, Vec3 normal, double distance);      /* n . p = d with n normalized; inside is below */
Shape *box_shape_new(Arena *a, Vec3 corner, Vec3 other);       /* corners in any order */
Shape *cylinder_new(Arena *a, Vec3 base, Vec3 cap, double radius, bool is_open);
Shape *cone_new(Arena *a, Vec3 base, double base_radius, Vec3 cap, double cap_radius, bool is_open);
Shape *disc_new(Arena *a, Vec3 centre, Vec3 normal, double radius, double hole_radius);
Shape *torus_new(Arena *a, double major, double minor);        /* about the y axis */
Shape *triangle_new(Arena *a, const Vec3 p[3]);
Shape *smooth_triangle_new(Arena *a, const Vec3 p[3], const Vec3 n[3]);
/* s, but a smooth triangle's normals blend as if they had unit length outside of `placement`: so they do in POV-Ray from a
 * `scale` on, and after no other transformation. */
Shape *smooth_triangle_scaled(Arena *a, Shape *s, const Xform *placement);

/* All surfaces of its parts, in their order; the parts are borrowed and must be in their final place, the list is copied. */
Shape *union_new(Arena *a, Shape *const parts[], uint32_t n);

/* What is inside all parts; what is inside any of them, without the surfaces within. Parts as for unions. A part without an
 * inside contributes what of its surface lies inside (of a merge: outside) all others. */
Shape *intersection_new(Arena *a, Shape *const parts[], uint32_t n);
Shape *merge_new(Arena *a, Shape *const parts[], uint32_t n);
Shape *difference_new(Arena *a, Shape *const parts[], uint32_t n);   /* of the first and the inverses of the others */

/* The surface of s inside all of the clips, left open where it is cut; parts and list as for unions. */
Shape *clipped_new(Arena *a, Shape *s, Shape *const clips[], uint32_t n);

#endif
