/* Neighbouring rays, traced together: eight lanes of vectors, and what they meet is read once for all of them. Rays that
 * part from the others go on alone: whoever has no use for a bunch takes its rays one by one, and a shape that knows nothing
 * of bunches is asked so (shape_hit_bunch). */
#ifndef TRIMRAY_BUNCH_H
#define TRIMRAY_BUNCH_H

#include "render/shape.h"
#include "render/vec8.h"

/* What Trace has of one ray alone: a ray that is traced by itself finds it there (bunch_begin) and leaves it (bunch_end). */
typedef struct {
    uint64_t seed;
    RayRoot root;
    unsigned left_out;
} BunchLane;

/* The rays as a tree of wide boxes sees them (bvh_bunch.c), as WideRay has one; they are made by the first tree that
 * needs them, and serve for those within its bounds. */
typedef struct {
    V8f inverse[3], near_shift[3], far_shift[3], t_min;
    V8d start, scale;
    Lanes negative[3];           /* rays whose direction is, along each axis */
    Lanes meeting;               /* rays that meet the bounds at all */
} BunchSlabs;

/* Rays as planes: unit directions and two unit vectors perpendicular to each and to each other (nurbs/certify.h). */
typedef struct {
    Vec3x8 d, n1, n2;
    V8d length;                  /* of the directions */
    Lanes finite;                /* those that are rays */
} BunchFrames;

struct RayBunch {
    int n;                       /* rays, 1 to BUNCH_WIDTH; lanes from there on repeat the last */
    Ray ray[BUNCH_WIDTH];
    BunchLane *lane;             /* of these, in whichever space they are */
    Vec3x8 origin, dir;          /* the same as `ray` */
    V8d t_min;
    /* Made by the first who asks for them: */
    bool has_frames, has_slabs;
    BunchFrames frames;
    BunchSlabs slabs;
    Box slabs_bounds;
};

/* Sets the lanes from ray[0 .. n), or these from the lanes, and that nothing is known of them yet. */
void bunch_set_lanes(RayBunch *b);
void bunch_set_rays(RayBunch *b);

static inline Lanes bunch_all(const RayBunch *b) { return (1u << b->n) - 1; }

/* So many are better served one by one: eight at once cost about as much. */
enum { FEW_LANES = 2 };
static inline bool lanes_are_few(Lanes lanes) { return __builtin_popcount(lanes) <= FEW_LANES; }

/* Lanes that are not asked for become like one that is. */
void bunch_fill(RayBunch *b, Lanes lanes);

/* The number of the first lane; removes it. */
static inline int lanes_next(Lanes *lanes)
{
    int i = __builtin_ctz(*lanes);
    *lanes &= *lanes - 1;
    return i;
}

/* What rays of a bunch ask for: all for the same, number 0 of these, or each for its own. */
struct BunchItems {
    bool is_one;
    uint32_t item[BUNCH_WIDTH];       /* of some list */
    const void *at[BUNCH_WIDTH];      /* where it lies; a tree of boxes knows nothing of that */
};

static inline uint32_t bunch_item(const BunchItems *items, int i) { return items->item[items->is_one ? 0 : i]; }
static inline const void *bunch_at(const BunchItems *items, int i) { return items->at[items->is_one ? 0 : i]; }

/* Takes from *lanes those that ask for what the first of them asks for. */
static inline Lanes lanes_together(const BunchItems *items, Lanes *lanes)
{
    Lanes all = *lanes, together = 0;
    uint32_t first = items->item[__builtin_ctz(all)];
    for (Lanes left = all; left; ) {
        int i = lanes_next(&left);
        together |= (Lanes)(items->item[i] == first) << i;
    }
    *lanes &= ~together;
    return together;
}

/* Before and after a ray goes on alone. */
static inline void lane_begin(const BunchLane *lane, Trace *t)
{
    t->seed = lane->seed, t->root = lane->root, t->left_out = 0;
}

static inline void lane_end(BunchLane *lane, const Trace *t) { lane->root = t->root, lane->left_out |= t->left_out; }

static inline void bunch_begin(const RayBunch *b, int i, Trace *t) { lane_begin(&b->lane[i], t); }
static inline void bunch_end(const RayBunch *b, int i, const Trace *t) { lane_end(&b->lane[i], t); }

/* Each ray of `lanes` as shape_hit and shape_blocks have it, with best[i], t_max[i]: the lanes that were hit, that are
 * blocked. best and t_max have BUNCH_WIDTH places; in those of other rays there may be anything. */
Lanes shape_hit_bunch(const Shape *s, RayBunch *b, Lanes lanes, Hit best[], Trace *t);
Lanes shape_blocks_bunch(const Shape *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t);

#endif
