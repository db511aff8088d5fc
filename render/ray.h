/* A ray, what the search keeps of a hit, and what only the winner needs. */
#ifndef TRIMRAY_RAY_H
#define TRIMRAY_RAY_H

#include "render/vec.h"

#include <stdbool.h>
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
    double t_error;          /* the point at t is within t_error * |dir| of the surface (exact arithmetic at that t) */
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

/* How far along the geometric normal, to the side it leaves for, a new ray must start so that with t_min 0 it does not meet
 * the surface that r hit at h. The point that ray_at computes is within t_error |dir| of the surface, and within 2u (|o| +
 * t |dir|) a coordinate of the exact point at t (two roundings; u = 2^-53; 4u covers three coordinates). The new ray's own
 * hit has an error of that size again: hence twice the sum. */
static inline double hit_offset(const Hit *h, const Ray *r)
{
    double length = vec_length(r->dir);
    return 2 * (h->t_error * length + 4 * 0x1p-53 * (vec_length(r->origin) + h->t * length));
}

typedef struct {
    Vec3 normal;             /* of the surface itself, unit length, in the space of the shape; side as the shape likes */
    Vec3 shading_normal;     /* what light sees: interpolated on smooth triangles, else equal to normal */
    Vec2 uv;                 /* for uv_mapping and `shoot`; NURBS: scaled to [0, 1] over the domain. A shape without any of
                                its own leaves it alone: hit_attributes has put the world's x and y there, as POV-Ray does */
    bool is_without_uv;      /* set by whoever asks: nobody will look at uv, and a shape may spare itself the trouble */
} Attributes;

#endif
