/* The files of `trimray shoot`: rays in, hits out, as little-endian doubles or as text (files.h says which). */
#ifndef TRIMRAY_SHOT_H
#define TRIMRAY_SHOT_H

#include "render/diag.h"
#include "render/ray.h"

#define SHOT_RAY_NUMBERS 6    /* origin x y z, direction x y z */
#define SHOT_HIT_NUMBERS 8

/* What is written for a ray. A miss: t +inf, index -1, tests as they were, everything else 0. */
typedef struct {
    double t;                 /* distance along the unit direction */
    double u, v;              /* scaled to [0, 1], as uv_mapping sees them */
    Vec3 normal;              /* of the surface, unit, in world space; either side */
    double index;             /* of the primitive in order of the file, from 0 */
    double tests;             /* NURBS leaves tested for this ray */
} ShotHit;

/* Rays with unit directions, t_min 0; text has a ray a line, numbers apart by blanks or commas, # begins a comment. NULL:
 * diag has one error, or (nothing in diag) the file cannot be read and errno says why. */
Ray *shot_read_rays(const char *path, Arena *a, Diag *diag, size_t *n_rays);

/* False: errno says why. */
bool shot_write_hits(const char *path, Arena *a, const ShotHit *hits, size_t n);

#endif
