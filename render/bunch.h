/* Neighbouring rays, traced together: eight lanes of vectors, and what they meet is read once for all of them. Rays that
 * part from the others go on alone: whoever has no use for a bunch takes its rays one by one, and a shape that knows nothing
 * of bunches is asked so (shape_hit_bunch). */
#ifndef TRIMRAY_BUNCH_H
#define TRIMRAY_BUNCH_H

#include "render/shape.h"
#include "render/simd.h"

/* Eight vectors, component by component. */
typedef struct { V8d x, y, z; } Vec3x8;

/* As vec_dot and vec_max_abs. */
ALWAYS_INLINE V8d lanes_dot(const Vec3x8 *a, const Vec3x8 *b) { return a->x * b->x + a->y * b->y + a->z * b->z; }
ALWAYS_INLINE V8d lanes_max_abs(const Vec3x8 *a)
{
    return v8d_max(v8d_abs(a->x), v8d_max(v8d_abs(a->y), v8d_max(v8d_abs(a->z), v8d_splat(0))));
}

/* What Trace has of one ray alone: a ray that is traced by itself finds it there (bunch_begin) and leaves it (bunch_end). */
typedef struct {
    uint64_t seed;
    RayRoot root;
    unsigned left_out;
} BunchLane;

/* The rays as a tree of eight-wide boxes sees them (bvh_bunch.c), as WideRay has one; they are made by the first tree that
 * needs them, and serve for those within its bounds. */
typedef struct {
    V8f inverse[3], near_shift[3], far_shift[3], t_min;
    V8d start, scale;
    Lanes negative[3];           /* rays whose direction is, along each axis */
    Lanes meeting;               /* rays that meet the bounds at all */
} BunchSlabs;

struct RayBunch {
    int n;                       /* rays, 1 to BUNCH_WIDTH; lanes from there on repeat the last */
    Ray ray[BUNCH_WIDTH];
    BunchLane *lane;             /* of these, in whichever space they are */
    Vec3x8 origin, dir;          /* the same as `ray` */
    V8d t_min;
    bool has_slabs;
    Box slabs_bounds;
    BunchSlabs slabs;
};

/* Nothing that is made of the rays on first use is known yet. */
static inline void bunch_forget(RayBunch *b) { b->has_slabs = false; }

/* Sets the lanes from ray[0 .. n), and forgets what was made of others. */
void bunch_set_lanes(RayBunch *b);

static inline Lanes bunch_all(const RayBunch *b) { return (1u << b->n) - 1; }

/* The number of the first lane; removes it. */
static inline int lanes_next(Lanes *lanes)
{
    int i = __builtin_ctz(*lanes);
    *lanes &= *lanes - 1;
    return i;
}

/* Before and after ray i goes on alone. */
static inline void bunch_begin(const RayBunch *b, int i, Trace *t)
{
    t->seed = b->lane[i].seed, t->root = b->lane[i].root, t->left_out = 0;
}

static inline void bunch_end(RayBunch *b, int i, const Trace *t)
{
    b->lane[i].root = t->root, b->lane[i].left_out |= t->left_out;
}

/* Each ray of `lanes` as shape_hit and shape_blocks have it, with best[i], t_max[i]: the lanes that were hit, that are
 * blocked. */
Lanes shape_hit_bunch(const Shape *s, RayBunch *b, Lanes lanes, Hit best[], Trace *t);
Lanes shape_blocks_bunch(const Shape *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t);

#endif
