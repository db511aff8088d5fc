/* Eight rays at one tile, by the proofs of certify_lanes.h: what is known of it is the same for all. */
#include "nurbs/certify_bunch.h"

#include "nurbs/patch_bunch.h"

typedef const Tile *Tiles;
typedef double Fact;
typedef Vec3 FactVec;
#define OF(tile, f) f(tile)
#define LANES(fact) v8d_splat(fact)
#define CROSS(a, b) vec_cross(a, b)

ALWAYS_INLINE void begin_points(Tiles tile, Lanes lanes, LanePoints *own)
{
    if (!is_in_lanes(tile->patch)) set_no_points(lanes, own);
}

ALWAYS_INLINE PatchPoints evaluate_patches(Tiles tile, Lanes lanes, V8d s, V8d t, LanePoints *own)
{
    const Patch *p = tile->patch;
    if (is_in_lanes(p)) return bunch_evaluate(p, s, t);
    while (lanes) {
        int i = lanes_next(&lanes);
        set_lane(own, i, kernel_blend(p, p->k_u, p->k_v, s[i], t[i]));
    }
    return points_in_lanes(own);
}

ALWAYS_INLINE const Tile *tile_of(Tiles tile, int i)
{
    (void)i;
    return tile;
}

#include "nurbs/certify_lanes.h"

/* ---- frames ---- */

/* frame_of_direction. */
ALWAYS_INLINE void set_normals(BunchFrames *f)
{
    V8d x = f->d.x, y = f->d.y, z = f->d.z, sign = (V8d)(((V8l)z & INT64_MIN) | (V8l)v8d_splat(1));
    V8d a = -1 / (sign + z), b = x * y * a;
    f->n1 = (Vec3x8){ 1 + sign * x * x * a, sign * b, -sign * x };
    f->n2 = (Vec3x8){ b, sign + y * y * a, -y };
}

EVERY_X86
static void make_frames(RayBunch *b)
{
    BunchFrames *f = &b->frames;
    V8d none = (b->dir.x * 0 + b->dir.y * 0 + b->dir.z * 0) + (b->origin.x * 0 + b->origin.y * 0 + b->origin.z * 0);
    f->finite = bunch_all(b) & v8l_mask(v8d_less(none, v8d_splat(1)));
    f->length = v8d_sqrt(vec8_dot(b->dir, b->dir)), f->d = vec8_normalize(b->dir);
    set_normals(f);
    b->has_frames = true;
}

void bunch_use_frames(RayBunch *b)
{
    if (!b->has_frames) make_frames(b);
}

EVERY_X86
Lanes tile_roots_bunch(const Tile *tile, const RayBunch *b, Lanes lanes, BunchLimits limits, Roots *out, LanesLeft *left,
                       Trace *trace)
{
    return find_roots(tile, b, lanes, limits, out, left, trace);
}

Root roots_get(const Roots *roots, int i)
{
    return (Root){ .s = roots->s[i], .t = roots->t[i], .depth = roots->depth[i], .depth_error = roots->depth_error[i],
                   .distance = roots->distance[i], .beside = 0.5 * roots->distance[i] };
}
