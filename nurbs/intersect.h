/* A ray and a prepared surface: nearest hit, and any hit. */
#ifndef TRIMRAY_INTERSECT_H
#define TRIMRAY_INTERSECT_H

#include "nurbs/newton.h"

typedef struct { NewtonRoot root; uint32_t leaf; } SurfaceHit;

/* The nearest hit in the open interval (r->t_min, t_max) that no trim cuts away, surely beyond r->t_min: by more than its
 * t_error. Counts into t. */
bool intersect_nearest(const Surface *s, const LeafTree *tree, int max_iterations, const Ray *r, double t_max, Trace *t,
                       SurfaceHit *out);

/* Is there any hit in (r->t_min, t_max)? */
bool intersect_any(const Surface *s, const LeafTree *tree, int max_iterations, const Ray *r, double t_max, Trace *t);

/* The unit normal S_u x S_v of a hit on this leaf; at a pole or on a collapsed side its limit from inside the leaf; where
 * the leaf is but a curve, the one that faces the ray. */
Vec3 intersect_normal(const Surface *s, const Leaf *leaf, double u, double v, const Ray *r);

#endif
