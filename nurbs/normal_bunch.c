/* Normals of the hits of a bunch, on one patch after the other. */
#include "nurbs/normal.h"
#include "nurbs/certain_bunch.h"
#include "nurbs/patch_bunch.h"

/* From the homogeneous derivatives, as patch_normal: w S_s = H_s - w_s S. */
ALWAYS_INLINE Vec3x8 tangent(const Vec4x8 *at, const Vec4x8 *by)
{
    V8d w = 1 / at->w, ratio = by->w * w;
    return (Vec3x8){ (by->x - at->x * ratio) * w, (by->y - at->y * ratio) * w, (by->z - at->z * ratio) * w };
}

/* The lanes whose tangents are long enough (normal_limit), which are most; the others are left as they are. */
EVERY_X86
static Lanes find_normals(const Patch *p, const V8d *u, const V8d *v, Vec3x8 *normal)
{
    PatchPoints at = bunch_evaluate(p, (*u - p->u0) / (p->u1 - p->u0), (*v - p->v0) / (p->v1 - p->v0));
    Vec3x8 a = tangent(&at.value, &at.by_s), b = tangent(&at.value, &at.by_t), n = vec8_cross(a, b);
    V8d along_u = v8d_sqrt(vec8_dot(a, a)), along_v = v8d_sqrt(vec8_dot(b, b)), length = v8d_sqrt(vec8_dot(n, n));
    V8d least = v8d_splat(NORMAL_SHARE * p->radius);
    *normal = vec8_normalize(n);
    return v8l_mask(v8d_less(least, along_u) & v8d_less(least, along_v)
                  & v8d_less(NORMAL_SHARE * along_u * along_v, length));
}

/* The lanes whose hits are on patch p. */
static Lanes lanes_on(const TileTree *tree, const Hit hits[], Lanes lanes, const Patch *p)
{
    Lanes on = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        if (tree->tiles[hits[i].leaf].patch == p) on |= 1u << i;
    }
    return on;
}

Lanes certain_normals_bunch(const TileTree *tree, const Hit hits[], Lanes lanes, Vec3 normal[])
{
    Lanes known = 0;
    while (lanes) {
        int first = __builtin_ctz(lanes);
        const Patch *p = tree->tiles[hits[first].leaf].patch;
        Lanes on = lanes_on(tree, hits, lanes, p);
        lanes &= ~on;
        if (lanes_are_few(on)) continue;
        const void *hit[BUNCH_WIDTH];
        Vec3x8 found;
        for (int i = 0; i < BUNCH_WIDTH; i++) hit[i] = &hits[on >> i & 1 ? i : first];
        V8d u = v8d_gather(hit, offsetof(Hit, u)), v = v8d_gather(hit, offsetof(Hit, v));
        on &= find_normals(p, &u, &v, &found);
        known |= on;
        while (on) {
            int i = lanes_next(&on);
            normal[i] = vec8_get(&found, i);
        }
    }
    return known;
}
