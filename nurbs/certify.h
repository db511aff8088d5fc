/* `method certain`: all roots of a ray and a Bézier patch, with proof.
 *
 * Three steps, each only where the one before leaves a doubt:
 *   1. the patch's frame decides: certainly no root, or at most one (some forty operations);
 *   2. where there is at most one, Newton finds it, or shows that it lies outside;
 *   3. else clip.h: the Bernstein hull of the two plane equations is clipped and split until each piece is settled. */
#ifndef TRIMRAY_CERTIFY_H
#define TRIMRAY_CERTIFY_H

#include "nurbs/tile.h"
#include "render/shape.h"

/* A ray as two planes and a direction: an orthonormal frame, made once per ray and surface. */
typedef struct {
    Vec3 origin, d;          /* d: unit */
    Vec3 n1, n2;             /* unit, perpendicular to d and to each other */
    double t_min, t_max;     /* along d; t_max shrinks as roots are accepted */
    const Patch *from;       /* the ray may start near, or be near, the point (from_s, from_t) of it; NULL: of none */
    double from_s, from_t;
} PatchRay;

/* A norm that proves one root must be below 1; this leaves room for its own rounding, which is below 2^-13, and for a useful
 * bound on the way there. */
#define CONTRACTION 0.98

/* Newton's step that is shorter than this share of the patch or box is the last: the next error is about its square. */
#define LAST_STEP 0x1p-26

/* Two unit vectors perpendicular to the unit vector d and to each other, with no special direction but the sign of z:
 * [DBC17]. */
static inline void frame_of_direction(Vec3 d, Vec3 *n1, Vec3 *n2)
{
    double sign = copysign(1, d.z), a = -1 / (sign + d.z), b = d.x * d.y * a;
    *n1 = vec(1 + sign * d.x * d.x * a, sign * b, -sign * d.x);
    *n2 = vec(b, sign + d.y * d.y * a, -d.y);
}

PatchRay patch_ray(Vec3 origin, Vec3 dir, double t_min, double t_max);    /* dir: unit */

typedef struct {
    double s, t;             /* parameters of the patch, in [0, 1] */
    double depth;            /* along the unit direction */
    double depth_error;      /* |depth - true depth| is at most this */
    double distance;         /* the point of the ray at depth is at most this far from the surface, */
    double beside;           /* and that of the surface at (s, t) this far from the ray */
    /* Of several roots closer together than the arithmetic can tell: the signs of (S_s x S_t).d where the ray comes among
     * them and where it leaves them; if they differ, the roots are even in number. 0, 0: a simple root. */
    signed char before, after;
} Root;

/* Called for each root in (t_min, t_max), in no order. It may lower ray->t_max. Returns true to end the search. */
typedef bool (*RootVisit)(void *context, const Tile *tile, PatchRay *ray, const Root *root);

/* All roots on the closed tile; one on a border may also be found on the neighbour. The visitor is told the tile, or the
 * part of it, that it was found on. Returns whether a visit ended it. Counts certificates, fallbacks and iterations
 * into t. */
bool tile_roots(const Tile *tile, PatchRay *ray, RootVisit visit, void *context, Trace *t);

/* Rounding error of the plane equations over the weight, and of the depth: for S on the patch the computed (N1.(S - o),
 * N2.(S - o)), o = offset, are within this distance of the true ones, but for a factor near 1. */
double patch_rounding(const Patch *p, Vec3 offset);

#endif
