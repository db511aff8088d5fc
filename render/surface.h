/* What shading knows of a hit: where it is, which way it faces, what it looks like; and where rays may leave it. */
#ifndef TRIMRAY_SURFACE_H
#define TRIMRAY_SURFACE_H

#include "render/scene.h"
#include "render/vec8.h"

typedef struct {
    const Ray *ray;
    const Hit *hit;
    Vec3 point;                  /* as computed; rays start at surface_leave, not here */
    Vec3 normal;                 /* unit, for light: turned to the viewer */
    Vec3 geometric;              /* unit, the surface's own: on either side */
    double cos_view;             /* -dir . normal, in [0, 1] */
    double offset;               /* hit_offset's */
    const Texture *texture;
    Vec3 texture_point;          /* this and uv: only of textures that are not the same everywhere */
    Vec2 uv;
} Surface;

void surface_at(const Scene *s, const Ray *r, const Hit *h, Surface *out);

/* Where a ray towards `dir` may start with t_min 0 without meeting this very surface again. */
static inline Vec3 surface_leave(const Surface *at, Vec3 dir)
{
    double side = vec_dot(dir, at->geometric) < 0 ? -1 : 1;
    return vec_add(at->point, vec_scale(at->geometric, side * at->offset));
}

/* The length of a ray from `from` that ends just before `to`, of which it is `distance` away.
 *
 * The end F + d D misses T by at most 8 roundings of a coordinate (u = 2^-53): 5 of T - F and its normalization, 2 of the
 * product and the sum, 1 of d; each of no more than |F_i| + |T_i|. The sum over the coordinates bounds the distance. */
#define STOP_ROUNDING (8 * 0x1p-53)
static inline double surface_stop_before(Vec3 from, Vec3 to, double distance)
{
    double size = fabs(from.x) + fabs(from.y) + fabs(from.z) + fabs(to.x) + fabs(to.y) + fabs(to.z);
    return distance - STOP_ROUNDING * size;
}

/* The same of eight. */
ALWAYS_INLINE V8d surface_stop_before_8(const Vec3x8 *from, const Vec3x8 *to, V8d distance)
{
    V8d size = v8d_abs(from->x) + v8d_abs(from->y) + v8d_abs(from->z) + v8d_abs(to->x) + v8d_abs(to->y) + v8d_abs(to->z);
    return distance - STOP_ROUNDING * size;
}

/* The same place with one of the textures that its own chooses from (texture_choose). */
Surface surface_with(const Surface *at, const TextureChoice *choice);

/* The colour of one of its layers. */
static inline Color surface_color(const Surface *at, const Layer *layer)
{
    return pigment_color(layer->pigment, at->texture_point, at->uv);
}

#endif
