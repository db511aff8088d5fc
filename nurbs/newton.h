/* Root finding of `method paper` ([MCFS00] section 2.3): Newton's iteration on the ray's two planes. */
#ifndef TRIMRAY_NEWTON_H
#define TRIMRAY_NEWTON_H

#include "nurbs/leaf.h"

#define NEWTON_MAX_ITERATIONS 10   /* the default of MAXITER; see newton.c */

/* A ray as the line where two planes meet; made once for each ray and surface. */
typedef struct {
    Vec3 origin;
    Vec3 d;                  /* the unit direction */
    Vec3 N1, N2;             /* unit, perpendicular to d and to each other: F is a distance */
    double length;           /* of the ray's own direction: t along d over this is the ray's t */
} NewtonRay;

NewtonRay newton_ray(const Ray *r);

typedef struct {
    double u, v;
    double t, t_error;       /* in units of the ray's direction: the true root has |t - true t| <= t_error */
} NewtonRoot;

typedef enum {
    NEWTON_ROOT,
    NEWTON_WORSE,            /* a step led away from the root (criterion 2) */
    NEWTON_OUTSIDE,          /* out of the domain (criterion 3) */
    NEWTON_UNFINISHED        /* MAXITER (criterion 4) */
} NewtonOutcome;

/* May the ray meet the leaf? False only if it does not: its middle's tangent parallelogram, widened by what the surface may
 * bend away from it, is off the ray. */
bool newton_may_reach(const Surface *s, const Leaf *leaf, const NewtonRay *ray);

/* Looks for a root from the middle of the leaf. The root may lie outside the leaf, but lies on the leaf's smooth stretch of the
 * domain. `seed` decides the jitter. Counts newton_iterations (evaluations; that of the middle was
 * made once and for all) and newton_jitters. */
NewtonOutcome newton_solve(const Surface *s, const Leaf *leaf, const NewtonRay *ray, int max_iterations, uint64_t seed,
                           Counters *counters, NewtonRoot *out);

#endif
