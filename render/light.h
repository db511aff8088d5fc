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
} Light;

/* Parallel by its kind or by the word: it shines along its axis everywhere. */
static inline bool light_is_parallel(const Light *l) { return l->is_parallel || l->kind == LIGHT_CYLINDER; }

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
/* Its shares: of a light with an axis, whose direction and distance are set, too, if it is parallel; of one that fades. */
double light_along_axis(const Light *l, Vec3 apart, LightAt *at);
double light_faded(const Light *l, double distance);

static inline LightAt light_at(const Light *l, Vec3 position, Vec3 point)
{
    Vec3 apart = vec_sub(position, point);
    LightAt at = { .direction = vec_normalize(apart), .distance = vec_length(apart), .color = l->color };
    double share = l->kind == LIGHT_POINT && !l->is_parallel ? 1 : light_along_axis(l, apart, &at);
    if (l->fade_distance > 0 && l->fade_power > 0) share *= light_faded(l, at.distance);
    if (share != 1) at.color = rgb_scale(at.color, share);
    return at;
}

#endif
