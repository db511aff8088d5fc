/* A ray, what the search keeps of a hit, and what only the winner needs. */
#ifndef TRIMRAY_RAY_H
#define TRIMRAY_RAY_H

#include "render/vec.h"

#include <stdint.h>

typedef struct Shape Shape;     /* render/shape.h */
typedef struct Object Object;   /* render/object.h: a placed shape with its appearance */

/* dir need not have length 1 (a scaled instance passes on a scaled direction); t is in units of dir. Hits count in the
 * open interval (t_min, best.t). */
typedef struct { Vec3 origin, dir; double t_min; } Ray;

static inline Vec3 ray_at(const Ray *r, double t) { return vec_add(r->origin, vec_scale(r->dir, t)); }

#define HIT_MAX_OBJECTS 8   /* nested placements between a hit and the world; object_new keeps trees within it */

typedef struct {
    double t;                /* INFINITY: nothing yet */
    double t_error;          /* |t - true t| is at most this, in units of dir */
    double u, v;             /* parameters on the shape, if it has any */
    const Shape *shape;      /* the primitive that was hit */
    uint32_t leaf;           /* which part of it (a NURBS leaf, a face of a mesh or box) */
    uint32_t index;          /* the primitive's number in order of the file, counted within what returned this hit */
    int n_objects;           /* placements passed on the way out, the innermost first */
    const Object *objects[HIT_MAX_OBJECTS];
} Hit;

/* Starts a hit of a primitive; the compounds above it add their index and themselves on the way out. */
static inline void hit_set(Hit *h, double t, double t_error, double u, double v, const Shape *shape, uint32_t leaf)
{
    h->t = t, h->t_error = t_error, h->u = u, h->v = v;
    h->shape = shape, h->leaf = leaf, h->index = 0, h->n_objects = 0;
}

typedef struct {
    Vec3 normal;             /* of the surface itself, unit length, in the space of the shape; side as the shape likes */
    Vec3 shading_normal;     /* what light sees: interpolated on smooth triangles, else equal to normal */
    Vec2 uv;                 /* for uv_mapping and `shoot`; NURBS: scaled to [0, 1] over the domain */
} Attributes;

#endif
