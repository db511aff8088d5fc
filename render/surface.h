/* What shading knows of a hit: where it is, which way it faces, what it looks like; and where rays may leave it. */
#ifndef TRIMRAY_SURFACE_H
#define TRIMRAY_SURFACE_H

#include "render/scene.h"

typedef struct {
    const Ray *ray;
    const Hit *hit;
    Vec3 point;                  /* as computed; rays start at surface_leave, not here */
    Vec3 normal;                 /* unit, for light: turned to the viewer */
    Vec3 geometric;              /* unit, the surface's own: on either side */
    double cos_view;             /* -dir . normal, in [0, 1] */
    const Texture *texture;
    Vec3 texture_point;
    Vec2 uv;
} Surface;

Surface surface_at(const Scene *s, const Ray *r, const Hit *h);

/* Where a ray towards `dir` may start with t_min 0 without meeting this very surface again. */
Vec3 surface_leave(const Surface *at, Vec3 dir);

/* The length of a ray from `from` that ends just before `to`, of which it is `distance` away. */
double surface_stop_before(Vec3 from, Vec3 to, double distance);

/* The same place with one of the textures that its own chooses from (texture_choose). */
Surface surface_with(const Surface *at, const TextureChoice *choice);

/* The colour of one of its layers. */
Color surface_color(const Surface *at, const Layer *layer);

#endif
