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

Box xform_box(const Xform *x, Box b);           /* contains the image of b; infinite and empty stay so */

/* Every ray goes through some of these. */
static inline Vec3 affine_vector(const Affine *a, Vec3 v)
{
    return vec(v.x * a->m[0][0] + v.y * a->m[1][0] + v.z * a->m[2][0],
               v.x * a->m[0][1] + v.y * a->m[1][1] + v.z * a->m[2][1],
               v.x * a->m[0][2] + v.y * a->m[1][2] + v.z * a->m[2][2]);
}
static inline Vec3 affine_point(const Affine *a, Vec3 p)
{
    return vec_add(affine_vector(a, p), vec(a->m[3][0], a->m[3][1], a->m[3][2]));
}
/* n' = n M^-T: the transpose of the inverse, so that n' . v' = n . v for every direction v. */
static inline Vec3 affine_normal(const Affine *inverse, Vec3 n)
{
    const double (*m)[3] = inverse->m;
    return vec(n.x * m[0][0] + n.y * m[0][1] + n.z * m[0][2],
               n.x * m[1][0] + n.y * m[1][1] + n.z * m[1][2],
               n.x * m[2][0] + n.y * m[2][1] + n.z * m[2][2]);
}
static inline Vec3 xform_point(const Xform *x, Vec3 p) { return affine_point(&x->forward, p); }
static inline Vec3 xform_vector(const Xform *x, Vec3 v) { return affine_vector(&x->forward, v); }   /* without translation */
static inline Vec3 xform_normal(const Xform *x, Vec3 n) { return affine_normal(&x->backward, n); }  /* length is not kept */
/* The same three through the inverse. */
static inline Vec3 xform_unpoint(const Xform *x, Vec3 p) { return affine_point(&x->backward, p); }
static inline Vec3 xform_unvector(const Xform *x, Vec3 v) { return affine_vector(&x->backward, v); }
static inline Vec3 xform_unnormal(const Xform *x, Vec3 n) { return affine_normal(&x->forward, n); }

#endif
