/* Sixteen boxes a node in single precision, in two rows of eight, [WBB08].
 *
 * Nothing that the ray meets in exact arithmetic is turned away. The ray is moved to where it enters the tree, and scaled so
 * that its largest component is 1, both in double precision: its origin o is then as large as the tree's coordinates M. A
 * plane x is met at t = x/d - o/d, computed in single precision as x*inverse + shift: two roundings of the first term, two
 * of the second, one of the sum, each within 2^-24 of (M + |o|)/|d|; twice the sum, 2^-21 of that, is added to the far side
 * and taken from the near side through `shift`. What moving the origin rounds, 2^-52 of the distances in the ray's own
 * units, is added to it. Components under 2^-60 count as that: the slab is then met earlier and left later than any t in the
 * tree. */
#include "render/bvh_wide.h"

#include "render/bvh_ray.h"

#define ROOM_AHEAD 64    /* beyond so many that wait, no node is opened ahead of its turn */
#define STACK_SIZE (WIDE_MOST_WAITING + ROOM_AHEAD + WIDTH)

/* What is behind the first of a node's items stands for all. */
static void set_behind(WideNode *n, const void *const behind[])
{
    uint32_t k = 0;
    while (k < n->n_children && !(n->child[k] & IS_ITEM)) k++;
    n->behind = k < n->n_children ? behind[n->child[k] & ~IS_ITEM] : NULL;
}

void bvh_wide_set_items(WideBvh *w, const BvhItems *items)
{
    w->items = items->first, w->item_size = items->size;
    if (!items->behind) return;
    w->behind_size = items->behind_size;
    for (uint32_t i = 0; i < w->n_nodes; i++) set_behind(&w->nodes[i], items->behind);
}

const void *bvh_wide_item(const WideBvh *w, uint32_t i) { return w->items ? w->items + i * w->item_size : NULL; }

uint32_t bvh_wide_node_count(const WideBvh *w) { return w->n_nodes; }

/* ---- traversal ---- */

/* Where the ray enters the tree; false: it does not, before t_max. */
static bool find_start(const WideBvh *b, const Ray *r, double t_max, double *start)
{
    *start = r->t_min;
    if (vec_max_abs(r->origin) <= NEAR * b->largest && fabs(r->t_min) <= NEAR * b->largest) return true;
    BoxRay box = box_ray(r->origin, r->dir);
    if (!box_hit(&b->bounds, &box, r->t_min, t_max, start)) return false;
    if (!isfinite(*start)) *start = r->t_min;
    return true;
}

static inline void set_axis(Slabs *w, int k, const WideBvh *b, double o, double d)
{
    bool is_tiny = !(fabs(d) >= TINY * w->scale);
    double inverse = is_tiny ? copysign(1 / TINY, d) : w->scale / d, far = fabs(w->start) * w->scale;
    double at = w->start * d + o;
    double slack = fabs(inverse) * ((fabs(at) + b->largest) * 0x1p-21 + 0x1p-52 * (fabs(o) + far));
    if (is_tiny) slack += 4 * b->diagonal;
    w->inverse[k] = (float)inverse;
    w->near_shift[k] = (float)(-at * inverse - slack);
    w->far_shift[k] = (float)(-at * inverse + slack);
    w->near_side[k] = signbit(d) != 0;
}

static bool is_same_ray(const Ray *a, const Ray *b)
{
    return vec_is_same(a->origin, b->origin) && vec_is_same(a->dir, b->dir) && a->t_min == b->t_min;
}

/* Makes t->wide the ray for this tree; false: it does not meet the tree's bounds before t_max. */
static bool use_wide_ray(const WideBvh *b, const Ray *r, double t_max, Trace *t)
{
    WideRay *w = &t->wide;
    double start;
    if (is_same_ray(&w->ray, r) && is_within(&b->bounds, &w->bounds)) return true;
    if (!find_start(b, r, t_max, &start)) return false;
    w->ray = *r, w->bounds = b->bounds;
    w->slabs.start = start, w->slabs.scale = vec_max_abs(r->dir);
    set_axis(&w->slabs, 0, b, r->origin.x, r->dir.x);
    set_axis(&w->slabs, 1, b, r->origin.y, r->dir.y);
    set_axis(&w->slabs, 2, b, r->origin.z, r->dir.z);
    return true;
}

/* ---- a tree ---- */

/* The only item of a tree needs no tree. */
static bool visit_single(const WideBvh *b, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t)
{
    BoxRay box = box_ray(r->origin, r->dir);
    double t_enter;
    return box_hit(&b->bounds, &box, r->t_min, *t_max, &t_enter) && visit(context, b->single, r, t_max, t);
}

typedef struct { BvhVisit visit; void *context; } Visitor;

/* While the n_new children that were met last come from memory: puts the children of what waits below them in its place, if
 * it is a node. They are what the ray needs next, unless it ends before. Returns by how much the stack grows. */
ALWAYS_INLINE int open_older(const WideBvh *b, Waiting *older, int n_new, const Slabs *r, float t_min, float t_max,
                             bool nearest_first, uint64_t *n_boxes)
{
    if (older->child & IS_ITEM || (nearest_first && older->t > t_max)) return 0;
    const WideNode *n = &b->nodes[older->child];
    Waiting met[WIDTH];
    int n_met = meet_children(b, n, r, t_min, t_max, nearest_first, true, met);
    *n_boxes += n->n_children;
    memmove(older + n_met, older + 1, (size_t)n_new * sizeof *older);
    memcpy(older, met, (size_t)n_met * sizeof *older);
    return n_met - 1;
}

/* nearest_first: none behind *t_max as visits lower it; else the farthest first, and *t_max stays. */
ALWAYS_INLINE bool traverse(const WideBvh *b, const Ray *r, double *t_max, Visitor v, Trace *t, bool nearest_first)
{
    uint64_t *count = t->is_shadow_ray ? &t->counters.light_bv_intersections : &t->counters.bv_intersections;
    ++*count;
    if (b->is_single) return visit_single(b, r, t_max, v.visit, v.context, t);
    if (!use_wide_ray(b, r, *t_max, t)) return false;
    Slabs slabs = t->wide.slabs;     /* the visitor's own trees may need another ray */
    Waiting stack[STACK_SIZE];
    bool was_ahead = t->fetches_ahead, ahead = t->fetches_ahead = was_ahead || b->is_large;
    float limit = limit_of(&slabs, *t_max), t_min = float_below((r->t_min - slabs.start) * slabs.scale);
    int top = meet_children(b, &b->nodes[0], &slabs, t_min, limit, nearest_first, ahead, stack);
    uint64_t n_boxes = b->nodes[0].n_children;
    bool ended = false;
    while (top > 0 && !ended) {
        Waiting next = stack[--top];
        if (nearest_first && next.t > limit) continue;      /* a hit has come nearer since */
        if (next.child & IS_ITEM) {
            ended = v.visit(v.context, next.child & ~IS_ITEM, r, t_max, t);
            if (nearest_first) limit = limit_of(&slabs, *t_max);
        } else {
            const WideNode *n = &b->nodes[next.child];
            n_boxes += n->n_children;
            int n_met = meet_children(b, n, &slabs, t_min, limit, nearest_first, ahead, stack + top);
            if (ahead && n_met > 0 && top > 0 && top <= ROOM_AHEAD)
                top += open_older(b, &stack[top - 1], n_met, &slabs, t_min, limit, nearest_first, &n_boxes);
            top += n_met;
        }
    }
    t->fetches_ahead = was_ahead;
    *count += n_boxes;
    return ended;
}

EVERY_X86
bool bvh_wide_traverse(const WideBvh *b, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t)
{
    return traverse(b, r, t_max, (Visitor){ visit, context }, t, true);
}

EVERY_X86
bool bvh_wide_any(const WideBvh *b, const Ray *r, double t_max, BvhVisit visit, void *context, Trace *t)
{
    return traverse(b, r, &t_max, (Visitor){ visit, context }, t, false);
}
