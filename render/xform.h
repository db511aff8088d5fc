/* Affine maps with their inverse. POV-Ray's convention: points are rows, p' = p * M, so that composing reads left to right
 * in the order in which a scene writes its transformations. */
#ifndef TRIMRAY_XFORM_H
#define TRIMRAY_XFORM_H

#include "render/box.h"
#include "render/vec.h"

#include <stdbool.h>

typedef struct { double m[4][3]; } Affine;            /* x' = x m[0][0] + y m[1][0] + z m[2][0] + m[3][0], ... */
typedef struct { Affine forward, backward; } Xform;   /* backward is the inverse of forward */

Xform xform_identity(void);
Xform xform_translate(Vec3 by);
Xform xform_scale(Vec3 by);                     /* no component may be 0 (the parser replaces 0 by 1 with a warning) */
Xform xform_rotate(Vec3 degrees);               /* about x, then y, then z, each left-handed */
Xform xform_axis_rotate(Vec3 axis, double degrees);
bool xform_from_matrix(const double m[12], Xform *out);   /* m00 m01 m02 m10 ... m32; false: singular or not finite */
Xform xform_then(Xform first, Xform second);    /* p' = (p * first) * second */
Xform xform_inverse(Xform x);
bool xform_is_identity(const Xform *x);

Vec3 xform_point(const Xform *x, Vec3 p);
Vec3 xform_vector(const Xform *x, Vec3 v);      /* a direction: no translation */
Vec3 xform_normal(const Xform *x, Vec3 n);      /* by the inverse transpose; length is not kept */
Vec3 xform_unpoint(const Xform *x, Vec3 p);     /* the same three through the inverse */
Vec3 xform_unvector(const Xform *x, Vec3 v);
Vec3 xform_unnormal(const Xform *x, Vec3 n);
Box xform_box(const Xform *x, Box b);           /* contains the image of b; infinite and empty stay so */

#endif
