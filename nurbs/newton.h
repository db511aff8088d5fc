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

typedef enum {
    NEWTON_OFF,              /* the ray does not meet the leaf */
    NEWTON_PLAIN,            /* det J keeps its sign all over the leaf: seen along the ray, it does not fold */
    NEWTON_FOLDED            /* it may: there may be a silhouette, or a pole, and more than one root */
} NewtonView;

/* What the leaf's middle says, with what the surface may bend away from it: certain, where it is not NEWTON_FOLDED. */
NewtonView newton_view(const Surface *s, const Leaf *leaf, const NewtonRay *ray);

/* One of the leaf's four quarters, 0 to 3, as a leaf of its own. */
Leaf newton_quarter(const Surface *s, const Leaf *leaf, int quarter);

/* Looks for a root from the middle of the leaf. The root may lie outside the leaf, but lies on the leaf's smooth stretch of
 * the domain. `seed` decides the jitter. Counts newton_iterations (evaluations; not that of the
 * guess, which comes with the leaf) and newton_jitters. */
NewtonOutcome newton_solve(const Surface *s, const Leaf *leaf, const NewtonRay *ray, int max_iterations, uint64_t seed,
                           Counters *counters, NewtonRoot *out);

#endif
