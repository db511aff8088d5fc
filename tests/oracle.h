/* The truth that intersections are held against: all roots of a ray and a rational B-spline surface, with proof, in ball
 * arithmetic; and where a point lies to a trim. Slow is fine. Shares nothing with nurbs/ but the descriptors of nurbs.h,
 * whose doubles are taken as exact. */
#ifndef TRIMRAY_TESTS_ORACLE_H
#define TRIMRAY_TESTS_ORACLE_H

#include "nurbs/nurbs.h"
#include "render/ray.h"

typedef struct Oracle Oracle;

/* The Bezier patches of a valid surface. No knot inside the domain may come `order` times. */
Oracle *oracle_new(const SurfaceDesc *desc);
void oracle_free(Oracle *o);

/* A root, or a cluster of what cannot be told apart.
 *
 * A root is proved to exist and to be alone in a box about it (Krawczyk's test), and is refined to 1e-30. A cluster is a
 * part of the parameter plane that no test excludes and in which none proves a single root, though it was split down to
 * 2^-45 of a patch (or to what a band leaves to tell): a tangency, a pole that is met, a ray in the surface. There may be
 * roots in it or not. */
typedef struct {
    bool is_cluster;
    double u, v;                         /* the root, rounded; of a cluster some point */
    double u_box[2], v_box[2];           /* contains it (rounded outward) */
    double t, t_tail;                    /* t + t_tail is the ray's t within t_error */
    double t_error;                      /* of a cluster: half the length of its interval of t */
    double residual;                     /* the distance from the ray is at most this; of a root below 1e-30 of its size */
    /* If the ray is moved sideways by up to `band` (see oracle_roots): */
    bool is_sure;                        /* the root stays, and stays clear of the domain's border */
    double t_moves;                      /* by how much t changes at most, to first order (and half more) */
} OracleRoot;

/* All roots on the whole line, t of any sign, ascending by t; returns their number, of which the first `max` are in out.
 * `band` is a distance: besides roots, everything nearer to the ray than that is reported, as roots or clusters. 0: roots
 * only. */
int oracle_roots(const Oracle *o, const Ray *r, double band, OracleRoot *out, int max);

typedef struct OracleTrims OracleTrims;

/* The Bezier segments of valid loops of clamped curves; curves are joined by straight pieces where they leave gaps. */
OracleTrims *oracle_trims_new(const TrimLoopDesc *loops, int n);
void oracle_trims_free(OracleTrims *t);

/* How often a loop goes round (u, v), counterclockwise. If the point is too close to tell, returns false, and it is
 * nearer to the loop than *distance. */
bool oracle_winding(const OracleTrims *t, int loop, double u, double v, int *winding, double *distance);

/* Is (u, v) kept by the loops, which neither cross nor overlap? False: too close to tell, as above. */
bool oracle_keeps(const OracleTrims *t, bool keep_left, double u, double v, bool *is_kept, double *distance);

#endif
