/* How much of a light reaches a hit, past what blocks and what filters it. */
#ifndef TRIMRAY_SHADOW_H
#define TRIMRAY_SHADOW_H

#include "render/bunch.h"
#include "render/media.h"
#include "render/surface.h"

typedef struct {
    const Surface *at;
    const Medium *media;         /* of the ray that found the surface */
    Surroundings *around;
    bool has_areas;              /* area lights are sampled; else they are points */
    Trace *trace;
} Shadow;

/* Leaves in lit->color (of light_at for the light's own position) what arrives: less what the blockers take. For area lights
 * the mean over the samples, taken adaptively as POV-Ray does. false: surely nothing. */
bool shadow_light(const Shadow *q, const Light *l, LightAt *lit);

/* The same for the surfaces that a bunch of camera rays sees, and a light with is_plain: which of `lanes` it may reach.
 * direction: to the light; color: in and out. */
typedef struct { Vec3x8 point, geometric; V8d offset; } SurfaceLanes;    /* of Surface */
Lanes shadow_light_bunch(const Shadow *const q[], Lanes lanes, const RayBunch *seen_by, const SurfaceLanes *at,
                         const Light *l, const Vec3x8 *direction, Rgb color[]);

/* Where sample (i, j) of an area light is, seen from `point`; i < l->area_n_u, j < l->area_n_v. */
Vec3 shadow_area_sample(const Light *l, Vec3 point, int i, int j);

#endif
