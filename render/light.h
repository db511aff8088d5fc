/* Light sources: POV-Ray's kinds. */
#ifndef TRIMRAY_LIGHT_H
#define TRIMRAY_LIGHT_H

#include "render/color.h"
#include "render/shape.h"
#include "render/vec.h"
#include "render/xform.h"

#include <stdbool.h>

typedef enum { LIGHT_POINT, LIGHT_SPOT, LIGHT_CYLINDER } LightKind;

typedef struct {
    LightKind kind;
    Vec3 position, point_at;                /* point_at: <0,0,1> where not given */
    Rgb color;
    bool is_parallel, is_shadowless;        /* as written: see light_is_parallel */
    double radius, falloff, tightness;      /* spot: degrees, 30 45 0; cylinder: lengths, .75 1 0 */
    double fade_distance, fade_power;       /* both > 0: in force */
    bool is_area, area_circular, area_orient, area_illumination;
    Vec3 area_u, area_v;
    int area_n_u, area_n_v, area_adaptive;  /* adaptive: 100 where not given */
    bool is_plain;                          /* known, by scene_prepare, to be a point with shadows that shines to all sides
                                               and far alike; most are */
} Light;

/* Parallel by its kind or by the word: it shines along its axis everywhere. */
static inline bool light_is_parallel(const Light *l) { return l->is_parallel || l->kind == LIGHT_CYLINDER; }

bool light_is_plain(const Light *l);   /* should is_plain be set? */
Light light_default(LightKind kind);   /* of its kind: black, at the origin, without area */
void light_transform(Light *l, const Xform *x);

/* light_shape.c: a light that moves with the union or object that it stands in. No ray meets it. */
Shape *light_shape_new(Arena *a, const Light *l);
const Light *shape_light(const Shape *s);   /* as it stands in its own space; NULL: s is no light */

/* The light that would arrive at a point from `position` (the light's own, or a sample of its area) if nothing were in the
 * way. */
typedef struct {
    Vec3 direction;                     /* unit, to the light; parallel lights: against their axis, everywhere */
    double distance;                    /* along it to where the light is; parallel: may be negative (no blocker then) */
    Rgb color;                          /* with fading and cones; may be black */
} LightAt;
LightAt light_at_any(const Light *l, Vec3 position, Vec3 point);

static inline LightAt light_at(const Light *l, Vec3 position, Vec3 point)
{
    if (!l->is_plain) return light_at_any(l, position, point);
    Vec3 apart = vec_sub(position, point);
    return (LightAt){ vec_normalize(apart), vec_length(apart), l->color };
}

#endif
