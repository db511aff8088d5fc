/* A validated copy of a SurfaceDesc: what the rest of nurbs/ works on. */
#ifndef TRIMRAY_SURFACE_H
#define TRIMRAY_SURFACE_H

#include "nurbs/nurbs.h"
#include "nurbs/trim_tree.h"
#include "render/box.h"

typedef struct {
    int k_u, k_v;                    /* orders */
    int n_u, n_v;                    /* control points along u and v */
    const double *tau_u, *tau_v;     /* knots: n_u + k_u, n_v + k_v */
    const Vec4 *p;                   /* homogeneous {wx, wy, wz, w}, or {x, y, z, 1} where is_polynomial */
    bool is_polynomial;              /* all weights are equal */
    double u0, u1, v0, v1;           /* the domain */
    Box box;                         /* of the control points that matter in the domain */
    double size;                     /* diagonal of the box of these control points */
    double farthest;                 /* of these, from the origin */
    double rounding;                 /* an evaluated point is at most this far from S(u, v): see surface.c */
    const TrimTree *trims;           /* NULL: the whole domain is kept */
} Surface;

/* Copies and validates; NULL: *error says why. */
Surface *surface_new(Arena *a, const SurfaceDesc *desc, NurbsError *error,
                     NurbsWarning *warnings, int max_warnings, int *n_warnings);

/* What a NURBS shape is made of; NULL: it is another shape. In nurbs_shape.c. */
const Surface *surface_of_shape(const struct Shape *s);

/* Reference evaluation by basis functions (basis.c). */
void surface_point(const Surface *s, double u, double v, Vec3 *point, Vec3 *s_u, Vec3 *s_v);

#endif
