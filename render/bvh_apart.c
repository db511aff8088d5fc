/* Each ray walks by itself, as bvh_wide.c has it, and takes a node when its turn comes: what it waits for comes from memory
 * while the others take theirs. A ray that has come to an item waits there until all have, and then they visit their items
 * together. */
#include "render/bvh_apart.h"

#include "render/bvh_ray.h"

typedef struct {
    Slabs slabs;
    float t_min, limit;
    int top;
    Waiting *stack;
} Walk;

static Slabs slabs_of(const BunchSlabs *s, int i)
{
    Slabs out = { .start = s->start[i], .scale = s->scale[i] };
    for (int k = 0; k < 3; k++) {
        out.inverse[k] = s->inverse[k][i], out.near_shift[k] = s->near_shift[k][i], out.far_shift[k] = s->far_shift[k][i];
        out.near_side[k] = s->negative[k] >> i & 1;
    }
    return out;
}

static void begin(const RayBunch *b, Lanes lanes, const double t_max[], Arena *scratch, Walk w[])
{
    while (lanes) {
        int i = lanes_next(&lanes);
        w[i].slabs = slabs_of(&b->slabs, i);
        w[i].t_min = b->slabs.t_min[i], w[i].limit = limit_of(&w[i].slabs, t_max[i]);
        w[i].stack = ARENA_ARRAY(scratch, Waiting, WIDE_MOST_WAITING);
        w[i].stack[0] = (Waiting){ 0, -INFINITY }, w[i].top = 1;
    }
}

typedef struct {
    const WideBvh *tree;
    bool nearest_first, ahead;
    uint64_t n_boxes;
} Kind;

typedef enum { WALKS_ON, IS_AT_ITEM, IS_DONE } Step;

/* One node more, or to an item: its number. */
ALWAYS_INLINE Step step(Walk *w, Kind *k, uint32_t *item)
{
    while (k->nearest_first && w->top > 0 && w->stack[w->top - 1].t > w->limit) w->top--;    /* a hit came nearer since */
    if (w->top == 0) return IS_DONE;
    uint32_t child = w->stack[--w->top].child;
    *item = child & ~WIDE_IS_ITEM;
    if (child & WIDE_IS_ITEM) return IS_AT_ITEM;
    const WideNode *n = &k->tree->nodes[child];
    k->n_boxes += n->n_children;
    w->top += meet_children(k->tree, n, &w->slabs, w->t_min, w->limit, k->nearest_first, k->ahead, w->stack + w->top);
    return WALKS_ON;
}

/* Until all have come to an item, or to the end; those that have come to an item. */
ALWAYS_INLINE Lanes walk_to_items(Walk w[], Lanes lanes, Kind *k, BunchItems *items)
{
    Lanes arrived = 0;
    while (lanes)
        for (Lanes turns = lanes; turns; ) {
            int i = lanes_next(&turns);
            Step is = step(&w[i], k, &items->item[i]);
            arrived |= (Lanes)(is == IS_AT_ITEM) << i, lanes &= ~((Lanes)(is != WALKS_ON) << i);
        }
    return arrived;
}

EVERY_X86
Lanes bvh_walk_apart(const WideBvh *tree, RayBunch *b, Lanes lanes, double t_max[], BvhBunchVisit visit, void *context,
                     bool nearest_first, Trace *t)
{
    ArenaMark mark = arena_mark(t->scratch);
    Kind k = { tree, nearest_first, t->fetches_ahead, 0 };
    Walk w[BUNCH_WIDTH];
    BunchItems items = { .is_one = false };
    Lanes ended = 0;
    begin(b, lanes, t_max, t->scratch, w);
    while ((lanes = walk_to_items(w, lanes, &k, &items))) {
        Lanes ends = visit(context, &items, b, lanes, t_max, t) & lanes;
        ended |= ends, lanes &= ~ends;
        for (Lanes left = nearest_first ? lanes : 0; left; ) {
            int i = lanes_next(&left);
            w[i].limit = limit_of(&w[i].slabs, t_max[i]);
        }
    }
    *(t->is_shadow_ray ? &t->counters.light_bv_intersections : &t->counters.bv_intersections) += k.n_boxes;
    arena_reset(t->scratch, mark);
    return ended;
}
