/* A rational Bézier patch about its own origin: one span of a surface.
 *
 * Parameters here are local: s, t in [0, 1] over the patch. Points are homogeneous {w(x - ox), w(y - oy), w(z - oz), w}
 * about origin = S(1/2, 1/2), so that nothing cancels later when the patch lies far from the origin of the scene. */
#ifndef TRIMRAY_PATCH_H
#define TRIMRAY_PATCH_H

#include "nurbs/trim_tree.h"
#include "nurbs/wide_net.h"
#include "render/arena.h"
#include "render/vec.h"

#include <stdbool.h>

/* How far beyond [0, 1] it is evaluated. */
#define PATCH_MARGIN 0.0625

typedef struct PoleCone PoleCone;

/* What all patches of a surface share, but rays seldom ask for. */
typedef struct {
    Arena *arena;                 /* for parts of the patches that rays ask for later (tile.c) */
    const PoleCone *cones;        /* of tiles at poles (pole_cone.h) */
} PatchGroup;

typedef struct {
    /* What rays ask for, in one line of the cache: */
    unsigned char k_u, k_v;       /* orders */
    bool is_polynomial : 1;       /* every w is 1 */
    bool is_trimmed : 1;          /* trims may cut away a root */
    unsigned char collapsed;      /* bits for the sides s = 0, s = 1, t = 0, t = 1 that are one point, within the rounding */
    float roundings;              /* of 2^-53 in a coordinate of patch_evaluate, relative to the sum of its terms' sizes, */
    float growth;                 /* and by what that sum grows up to PATCH_MARGIN beyond the patch */
    float w_max;                  /* no weight is larger */
    Vec3 origin;
    const Vec4 *p;                /* k_u * k_v points, u fastest */
    double rounding;              /* how far S(s, t) may be from where exact arithmetic has it, wherever s and t are */
    double radius;                /* |S(s, t) - origin| <= radius */
    /* and in another one: */
    Vec3 base;                    /* what its surface's tree is about, which the origin and the points are added to */
    double u0, u1, v0, v1;        /* its interval of the surface's parameters */
    const PatchGroup *group;      /* NULL: none; no parts are made */
} Patch;

/* Fills *out from k_u * k_v homogeneous points {wx, wy, wz, w} of positive weight, u fastest, which move to the patch's own
 * middle; net.hi is copied then. `error` is that of the points: patches that share a border agree within theirs, and no ray
 * passes between. */
void patch_make(Arena *a, int k_u, int k_v, WideNet net, double error, TrimRect interval, Patch *out);

/* Moves a net (k_u * k_v points) to its own middle, which becomes p->origin; net.hi becomes p->p. net.lo may be NULL: 0. */
void patch_move_origin(Patch *p, WideNet net);

/* A point about `to`: one rounding a coordinate. */
static inline Vec4 patch_point_about(Vec4 p, Vec3 to)
{
    return vec4(fma(-p.w, to.x, p.x), fma(-p.w, to.y, p.y), fma(-p.w, to.z, p.z), p.w);
}

/* The surface's parameters of a place in the patch: monotone, and exact at the ends. */
static inline double patch_u(const Patch *p, double s) { return s >= 1 ? p->u1 : p->u0 + s * (p->u1 - p->u0); }
static inline double patch_v(const Patch *p, double t) { return t >= 1 ? p->v1 : p->v0 + t * (p->v1 - p->v0); }

/* Bernstein polynomials of order k and their derivatives at x (any real number): b and d have room for k. */
void bernstein(int k, double x, double b[], double d[]);

/* The homogeneous numerator and its derivatives by s and t: about the patch's origin. */
void patch_evaluate(const Patch *p, double s, double t, Vec4 *value, Vec4 *by_s, Vec4 *by_t);

/* The unit normal S_s x S_t at (s, t); where it vanishes, its limit from the side of the middle; where all of the patch is a
 * curve or a point, what is perpendicular to it and nearest to `towards`. */
Vec3 patch_normal(const Patch *p, double s, double t, Vec3 towards);

#endif
