/* One ray at a node of sixteen boxes: for walks of one ray (bvh_wide.c, whose head proves that nothing is turned away which
 * the ray meets), and of several in turns (bvh_apart.c). */
#ifndef TRIMRAY_BVH_RAY_H
#define TRIMRAY_BVH_RAY_H

#include "render/bvh_walk.h"

typedef struct { uint32_t child; float t; } Waiting;

/* Of the row of children that begins at `first`, those that a ray meets in [t_min, t_max], a bit for each, and where. */
ALWAYS_INLINE unsigned meet_row(const WideNode *n, int first, const Slabs *r, float t_min, float t_max, V8f *t)
{
    V8f near = v8f_splat(t_min), far = v8f_splat(t_max);
    for (int k = 0; k < 3; k++) {
        V8f inverse = v8f_splat(r->inverse[k]);
        near = v8_max(v8f_load(n->side[r->near_side[k]][k] + first) * inverse + v8f_splat(r->near_shift[k]), near);
        far = v8_min(v8f_load(n->side[!r->near_side[k]][k] + first) * inverse + v8f_splat(r->far_shift[k]), far);
    }
    *t = near;
    /* a ray of no numbers would meet children that do not exist */
    return v8_mask(__builtin_convertvector(near <= far, V8c)) & n->exists >> first;
}

/* Children of n that the ray meets in [t_min, t_max], the nearest last; or the farthest last, where any hit will do: what is
 * near a shadow ray's origin is mostly the surface that it comes from. */
ALWAYS_INLINE int meet_children(const WideBvh *b, const WideNode *n, const Slabs *r, float t_min, float t_max,
                                bool nearest_first, bool ahead, Waiting *out)
{
    int n_met = 0;
    V8f near[WIDTH / ROW];
    unsigned met = meet_row(n, 0, r, t_min, t_max, &near[0]);
    if (n->n_children > ROW) met |= meet_row(n, ROW, r, t_min, t_max, &near[1]) << ROW;
    if (ahead) fetch_children(b, n, met);
    for (; met != 0; met &= met - 1) {
        int i = __builtin_ctz(met), at = n_met++;
        float t = ((const float *)near)[i];
        for (; at > 0 && (nearest_first ? out[at - 1].t < t : out[at - 1].t > t); at--) out[at] = out[at - 1];
        out[at] = (Waiting){ n->child[i], t };
    }
    return n_met;
}

ALWAYS_INLINE float limit_of(const Slabs *s, double t_max) { return float_above((t_max - s->start) * s->scale); }

#endif
