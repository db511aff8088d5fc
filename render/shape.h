/* The one interface to everything that a ray can hit. A new primitive is one file with one ShapeType; nothing else in
 * render/ knows what shapes there are. */
#ifndef TRIMRAY_SHAPE_H
#define TRIMRAY_SHAPE_H

#include "render/arena.h"
#include "render/blocker.h"
#include "render/box.h"
#include "render/ray.h"
#include "render/stats.h"
#include "render/wide_ray.h"
#include "render/xform.h"

#include <stdatomic.h>
#include <stdbool.h>

typedef struct { const void *patch; double s, t; uint64_t seed; } RayRoot;

/* What a thread carries while it traces. */
typedef struct {
    Arena *scratch;          /* with marks; empty between rays */
    Counters counters;
    unsigned left_out;       /* see shape_tree_blocks */
    bool is_shadow_ray;      /* set by whoever casts the ray: boxes are counted apart */
    bool measures_time;      /* fill counters.nurbs_seconds: costs two clock reads a test */
    uint64_t seed;           /* of this ray: depends only on (pixel, sample); see hash.h */
    bool fetches_ahead;      /* a large tree is being walked: what comes next is worth fetching from memory ahead */
    WideRay wide;            /* the last ray that met a tree of boxes */
    Blockers blockers;
    /* The frame of the last direction, for shapes that see a ray as two planes: unit d, perpendicular unit n1 and n2. */
    struct { Vec3 dir; double length; Vec3 d, n1, n2; } frame;
    /* The last root that was accepted, by its patch: rays that leave from it find their own surface again there, or are sure
     * not to. It counts only while `seed` is the same, so that no pixel depends on another. */
    RayRoot root;
} Trace;

typedef struct HitList HitList;     /* all hits of a ray in order of t, for CSG */
typedef struct MeshSink MeshSink;   /* receives triangles, for export */
typedef struct Sdl Sdl;             /* receives scene text, for export */
typedef struct Bvh Bvh;             /* a tree of boxes */
typedef struct RayBunch RayBunch;   /* rays that are traced together: bunch.h */
typedef struct BunchItems BunchItems;
typedef unsigned Lanes;             /* of a bunch: a bit for each ray */
enum { BUNCH_WIDTH = 8 };

typedef struct ShapeType ShapeType;
struct ShapeType {
    const char *name;   /* the scene's word, and the key in --stats */
    Box  (*bounds)    (const Shape *s);                                       /* contains every hit; pure; before prepare */
    void (*prepare)   (Shape *s, Arena *own, Trace *t);   /* once, when a first ray reaches the bounds; NULL: nothing */
    bool (*hit)       (const Shape *s, const Ray *r, Hit *best, Trace *t);    /* nearest in (r->t_min, best->t) */
    bool (*blocks)    (const Shape *s, const Ray *r, double t_max, Trace *t); /* any in (r->t_min, t_max); NULL: by hit() */
    /* Its own tree of boxes, to be joined with others into the tree of a compound around it, so that a ray walks one tree
     * and not two; prepares it, as shape_prepare_in; NULL: it has none. *lender is the type whose items these are: a
     * shape around another one passes on what that lends. The lender is asked for items one by one, as by hit() and
     * blocks(), and told their number and where they lie (bvh_item): the shape itself need not be in the cache. took() adds
     * what shapes around the lender's have to say of a hit; NULL: nothing. */
    const Bvh *(*lend)(Shape *s, Arena *own, Trace *t, const ShapeType **lender);
    /* Told before s is prepared: a compound of n primitives has it as a part, and may ask it to lend. Of several compounds
     * the largest counts: what is prepared does not depend on which comes first. NULL: it is no matter. */
    void (*be_among)(Shape *s, uint32_t n);
    bool (*hit_item)  (const void *at, uint32_t item, const Ray *r, Hit *best, Trace *t);
    bool (*item_blocks)(const void *at, uint32_t item, const Ray *r, double t_max, Trace *t);
    void (*took)      (const Shape *s, const Ray *r, Hit *best);
    /* hit(), blocks(), hit_item() and item_blocks() for some rays of a bunch, all at once: best[i] and t_max[i] are ray i's;
     * which of them are hit, or blocked. NULL: one by one. */
    Lanes (*hit_bunch)(const Shape *s, RayBunch *b, Lanes lanes, Hit best[], Trace *t);
    Lanes (*blocks_bunch)(const Shape *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t);
    Lanes (*hit_items_bunch)(const BunchItems *items, RayBunch *b, Lanes lanes, Hit best[], Trace *t);
    Lanes (*items_block_bunch)(const BunchItems *items, RayBunch *b, Lanes lanes, const double t_max[], Trace *t);
    const Shape *(*bare)(const Shape *s);   /* what answers blocks() in its place; NULL: itself */
    void (*all_hits)  (const Shape *s, const Ray *r, HitList *out, Trace *t); /* appends, by t; NULL: hit() repeated */
    bool (*inside)    (const Shape *s, Vec3 p);                               /* NULL: a surface without an inside */
    Box  (*inside_bounds)(const Shape *s);                                    /* of all that is inside; NULL: bounds() */
    void (*attributes)(const Shape *s, const Ray *r, const Hit *h, Attributes *out);  /* for the winner only */
    bool (*tessellate)(const Shape *s, double chord_error, MeshSink *out);    /* NULL or false: it has no mesh */
    void (*write)     (const Shape *s, Sdl *out);  /* for POV-Ray: "sphere { <0, 0, 0>, 1", left open; NULL: as a mesh */
    uint32_t (*parts) (const Shape *s, Shape *const **list);   /* what it is made of, in order; NULL: a primitive */
    /* A compound like s, of as many other parts: its own, moved by `moved` (NULL: not). is_inverse: they are inverted, and
     * so is the compound to be (by De Morgan's laws; a union is then what POV-Ray makes of it, without surfaces within). */
    Shape *(*with_parts)(const Shape *s, Arena *a, Shape *const parts[], bool is_inverse, const Xform *moved);
    unsigned (*looks) (const Shape *s);            /* of a primitive's own textures: as object_looks; NULL: it has none */
    void (*release)   (Shape *s);                                             /* NULL: the arenas have it all */
};
/* On a miss hit() returns false and has not touched *best. r->dir need not have length 1; t is in units of r->dir.
 * attributes() gets the ray in the space of the shape, and h as hit() left it there. */

/* Every shape begins with this; struct Sphere { Shape shape; ... }. */
struct Shape {
    const ShapeType *type;
    uint32_t n_primitives;        /* counted for Hit.index: 1, or the sum over a compound's parts */
    _Atomic int state;            /* SHAPE_RAW, being prepared, SHAPE_READY: see shape_prepare */
    uint32_t depth;               /* the most objects between it and a primitive below, itself included; 0: no object */
    Arena *own;                   /* what prepare() filled; freed by shape_release. NULL: it is a compound's */
};
enum { SHAPE_RAW, SHAPE_BUSY, SHAPE_READY };

/* Fills the header of a new shape. A shape without prepare() is ready at once. */
void shape_init(Shape *s, const ShapeType *type);

/* Runs s->type->prepare exactly once, whichever thread comes first; the others wait. Its time goes to
 * t->counters.prep_seconds, less that of shapes prepared within it. */
void shape_prepare(Shape *s, Trace *t);
/* The same in the arena of a compound around it, beside its neighbours there, until the compound is released with all that
 * is in it. */
void shape_prepare_in(Shape *s, Arena *own, Trace *t);
/* For prepare() of `s` in n independent pieces: does work(context, i, own, t) for each, on this thread and on those that
 * wait for `s` meanwhile. Each has an arena of its own, which becomes part of `own`. */
typedef void ShapeWork(void *context, uint32_t i, Arena *own, Trace *t);
void shape_share_work(const Shape *s, Arena *own, uint32_t n, ShapeWork *work, void *context, Trace *t);

/* Did any ray ever reach it? For --stats, too: what was left out. */
static inline bool shape_was_prepared(const Shape *s)
{
    return atomic_load_explicit(&s->state, memory_order_acquire) == SHAPE_READY;
}
void shape_release(Shape *s);                  /* type->release, then the arena of prepare() */

/* The calls through the table: prepare on first use. Preparing is the one change that a shape makes after it was built, and
 * it makes it under a lock: callers may keep their shapes const. */
static inline void shape_be_prepared(const Shape *s, Trace *t)
{
    if (!shape_was_prepared(s)) shape_prepare((Shape *)s, t);
}
static inline bool shape_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    shape_be_prepared(s, t);
    return s->type->hit(s, r, best, t);
}
bool shape_blocks_by_hit(const Shape *s, const Ray *r, double t_max, Trace *t);   /* of a shape without blocks() */
static inline bool shape_blocks(const Shape *s, const Ray *r, double t_max, Trace *t)
{
    shape_be_prepared(s, t);
    return s->type->blocks ? s->type->blocks(s, r, t_max, t) : shape_blocks_by_hit(s, r, t_max, t);
}
static inline const Shape *shape_bare(const Shape *s) { return s->type->bare ? s->type->bare(s) : s; }
static inline Box shape_bounds(const Shape *s) { return s->type->bounds(s); }
static inline bool shape_inside(const Shape *s, Vec3 p) { return s->type->inside && s->type->inside(s, p); }
static inline Box shape_inside_bounds(const Shape *s)
{
    return s->type->inside_bounds ? s->type->inside_bounds(s) : s->type->bounds(s);
}

#endif
