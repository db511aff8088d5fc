/* `method certain`: a surface as a tree of Bézier patches, searched without a miss. */
#ifndef TRIMRAY_CERTAIN_H
#define TRIMRAY_CERTAIN_H

#include "nurbs/certify.h"
#include "nurbs/surface.h"
#include "nurbs/trim_cell.h"
#include "render/bvh.h"

typedef struct {
    Vec3 base;                       /* what is below is about this point: far from the origin nothing is lost */
    const Patch *patches;
    const TrimCell *const *cells;    /* what the trims say in each patch; NULL: it is wholly kept */
    uint32_t n_patches;
    const Bvh *bvh;                  /* item i is patches[i] */
    uint32_t n_cut, n_untested;      /* dropped because trimmed away; kept without a trim test on a trimmed surface */
} PatchTree;

/* The certificate then holds for all rays but those within some asin(0.35) of the patch's tangent planes. */
#define CERTAIN_VARIATION 0.35

/* Cuts the surface into patches whose frames settle most rays, drops those that are trimmed away, and builds the tree. A
 * patch is halved until its derivatives vary by at most `variation` of themselves; 0: CERTAIN_VARIATION. Hits depend on it
 * in their last bits only, time and memory do. The result lies in `a`. Linear in the number of spans. */
void certain_prepare(Arena *a, const Surface *surface, double variation, PatchTree *out);

typedef struct {
    double u, v;                     /* parameters of the surface */
    double t, t_error;               /* in units of the ray's direction; as Hit has them */
    double depth_error;              /* |t - true t| is at most this */
    uint32_t patch;
    signed char before, after;       /* as Root has them */
} CertainHit;

/* The nearest hit in the open interval (r->t_min, t_max) that no trim cuts away; counts into t. */
bool certain_nearest(const Surface *s, const PatchTree *tree, const Ray *r, double t_max, Trace *t, CertainHit *out);

/* Is there any hit in (r->t_min, t_max)? */
bool certain_any(const Surface *s, const PatchTree *tree, const Ray *r, double t_max, Trace *t);

/* All hits in (r->t_min, t_max), ascending, each once, in t->scratch. */
typedef struct { CertainHit *hits; size_t n, capacity; } CertainList;
void certain_all(const Surface *s, const PatchTree *tree, const Ray *r, double t_max, Trace *t, CertainList *out);

/* The unit normal S_u x S_v at (u, v) of patch i; where it vanishes (a pole, a collapsed side), its limit from within. Where
 * the patch is but a curve, the one that faces the ray. */
Vec3 certain_normal(const PatchTree *tree, uint32_t i, double u, double v, const Ray *r);

#endif
