/* Eight rays at once ([WSBW01]) through wide boxes: a ray a lane, and a node's boxes one after the other.
 *
 * What is computed of a ray and a box is what bvh_wide.c computes of them, by the same operations, with its proof that
 * nothing is turned away which the ray meets. Only rays whose directions have the same signs go together, so that they
 * meet the same sides of a box first; others follow. (Where one or two are left, to let each see eight boxes at once makes
 * no difference.) Rays that have little in common go apart (bvh_apart.c), and so do all in a tree that lies in main memory,
 * where those that go together wait for each node together.
 *
 * A child waits with the rays that meet it, and with the least t at which they do. Rays are lanes of a mask: of those that
 * are not in it nothing is changed, whatever numbers stand there. */
#include "render/bvh_bunch.h"

#include "render/bvh_apart.h"
#include "render/bvh_walk.h"

/* ---- rays and the tree's bounds ---- */

ALWAYS_INLINE void enter_axis(float lo, float hi, V8d o, V8d d, V8d *enter, V8d *leave)
{
    V8d inverse = 1 / d, from_lo = (v8d_splat(lo) - o) * inverse, from_hi = (v8d_splat(hi) - o) * inverse;
    V8l is_negative = (V8l)inverse >> 63;
    *enter = v8d_max(v8d_select(is_negative, from_hi, from_lo), *enter);
    *leave = v8d_min(v8d_select(is_negative, from_lo, from_hi), *leave);
}

/* As box_hit, operation by operation: which rays meet the box, and where. */
ALWAYS_INLINE Lanes enter_box(const Box *box, const RayBunch *b, V8d t_max, V8d *t_enter)
{
    V8d enter = v8d_splat(-INFINITY), leave = v8d_splat(INFINITY);
    enter_axis(box->lo[0], box->hi[0], b->origin.x, b->dir.x, &enter, &leave);
    enter_axis(box->lo[1], box->hi[1], b->origin.y, b->dir.y, &enter, &leave);
    enter_axis(box->lo[2], box->hi[2], b->origin.z, b->dir.z, &enter, &leave);
    V8l meets = v8d_less(enter, v8d_splat(INFINITY)) & v8d_less(v8d_splat(-INFINITY), leave);
    enter = v8d_max(enter - v8d_abs(enter) * BOX_WIDEN, b->t_min);
    leave = v8d_min(leave + v8d_abs(leave) * BOX_WIDEN, t_max);
    *t_enter = enter;
    return v8l_mask(meets & v8d_at_most(enter, leave));
}

/* ---- slabs ---- */

/* As find_start. */
ALWAYS_INLINE void find_starts(const WideBvh *tree, const RayBunch *b, BunchSlabs *s)
{
    V8d most = v8d_splat(NEAR * tree->largest), enter;
    V8l is_near = v8d_at_most(vec8_max_abs(b->origin), most) & v8d_at_most(v8d_abs(b->t_min), most);
    s->start = b->t_min, s->meeting = v8l_mask(is_near);
    if (s->meeting == (1u << BUNCH_WIDTH) - 1) return;
    s->meeting |= enter_box(&tree->bounds, b, v8d_splat(INFINITY), &enter);
    V8l moves = ~is_near & v8d_less(v8d_abs(enter), v8d_splat(INFINITY));
    s->start = v8d_select(moves, enter, b->t_min);
}

/* As set_axis there. */
ALWAYS_INLINE void set_axis(BunchSlabs *s, int k, const WideBvh *tree, V8d o, V8d d)
{
    V8l sign = (V8l)d & INT64_MIN, is_tiny = v8d_less(v8d_abs(d), TINY * s->scale);
    V8d inverse = v8d_select(is_tiny, (V8d)((V8l)v8d_splat(1 / TINY) | sign), s->scale / d);
    V8d at = s->start * d + o, far = v8d_abs(s->start) * s->scale;
    V8d slack = v8d_abs(inverse) * ((v8d_abs(at) + tree->largest) * 0x1p-21 + 0x1p-52 * (v8d_abs(o) + far));
    slack = v8d_select(is_tiny, slack + 4 * tree->diagonal, slack);
    s->inverse[k] = __builtin_convertvector(inverse, V8f);
    s->near_shift[k] = __builtin_convertvector(-at * inverse - slack, V8f);
    s->far_shift[k] = __builtin_convertvector(-at * inverse + slack, V8f);
    s->negative[k] = v8l_mask(sign >> 63);
}

/* As float_above, float_below. */
ALWAYS_INLINE V8f floats_above(V8d x) { return __builtin_convertvector(x + (v8d_abs(x) * BEYOND + LEAST_BEYOND), V8f); }
ALWAYS_INLINE V8f floats_below(V8d x) { return __builtin_convertvector(x - (v8d_abs(x) * BEYOND + LEAST_BEYOND), V8f); }

ALWAYS_INLINE V8f limits_of(const BunchSlabs *s, const double t_max[])
{
    return floats_above((v8d_load_doubles(t_max) - s->start) * s->scale);
}

/* Makes b->slabs those for this tree, of all rays, whichever are asked for. */
ALWAYS_INLINE void use_slabs(const WideBvh *tree, RayBunch *b)
{
    if (b->has_slabs && is_within(&tree->bounds, &b->slabs_bounds)) return;
    BunchSlabs *s = &b->slabs;
    find_starts(tree, b, s);
    s->scale = vec8_max_abs(b->dir);
    set_axis(s, 0, tree, b->origin.x, b->dir.x);
    set_axis(s, 1, tree, b->origin.y, b->dir.y);
    set_axis(s, 2, tree, b->origin.z, b->dir.z);
    s->t_min = floats_below((b->t_min - s->start) * s->scale);
    b->slabs_bounds = tree->bounds, b->has_slabs = true;
}

/* ---- a node ---- */

typedef struct { uint32_t child; Lanes lanes; float t; } Waiting;

typedef struct {
    const WideBvh *tree;
    BunchSlabs slabs;              /* the visitor's own trees may need others */
    int side[3];                   /* of a box, which the rays meet first */
    V8f t_min, limit;              /* t_min of rays that do not go along: INFINITY */
    bool nearest_first, ahead;
    uint64_t n_boxes;
    int top;
    Waiting stack[WIDE_MOST_WAITING];
} Walk;

/* Row i of eight bits becomes column i, [War12] 7-3. */
static inline uint64_t transposed(uint64_t x)
{
    uint64_t swap = (x ^ x >> 7) & 0x00AA00AA00AA00AA;
    x ^= swap ^ swap << 7;
    swap = (x ^ x >> 14) & 0x0000CCCC0000CCCC;
    x ^= swap ^ swap << 14;
    swap = (x ^ x >> 28) & 0x00000000F0F0F0F0;
    return x ^ swap ^ swap << 28;
}

ALWAYS_INLINE float v8f_least(V8f a)
{
    a = v8_min(a, __builtin_shufflevector(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
    a = v8_min(a, __builtin_shufflevector(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
    a = v8_min(a, __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6));
    return a[0];
}

/* Of the row of children that begins at `first`. Byte i of what is returned: the rays that meet child i of them; t[i]: where
 * the first of them does. */
ALWAYS_INLINE uint64_t meet_row(const Walk *w, const WideNode *n, uint32_t first, Lanes lanes, float t[ROW])
{
    const BunchSlabs *s = &w->slabs;
    V8f nears[ROW];
    V8i met = { 0 }, bit = (V8i){ 1, 1, 1, 1, 1, 1, 1, 1 };
    uint32_t end = n->n_children - first < ROW ? n->n_children - first : ROW;
    for (uint32_t i = 0; i < end; i++, bit += bit) {
        V8f near = w->t_min, far = w->limit;
        for (int k = 0; k < 3; k++) {
            near = v8_max(v8f_splat(n->side[w->side[k]][k][first + i]) * s->inverse[k] + s->near_shift[k], near);
            far = v8_min(v8f_splat(n->side[!w->side[k]][k][first + i]) * s->inverse[k] + s->far_shift[k], far);
        }
        V8i meets = near <= far;
        nears[i] = v8f_select(meets, near, v8f_splat(INFINITY));
        met |= meets & bit;
    }
    uint64_t all = transposed(v8_bytes(__builtin_convertvector(met, V8c))) & lanes * 0x0101010101010101u;
    for (uint64_t left = all; left; ) {
        int i = __builtin_ctzll(left) / 8;
        t[i] = v8f_least(nears[i]);
        left &= ~((uint64_t)0xFF << 8 * i);
    }
    return all;
}

/* Puts a child above `base`, the nearest last; or the farthest last, where any hit will do. */
ALWAYS_INLINE void push(Walk *w, Waiting child, int base)
{
    int at = w->top++;
    for (; at > base && (w->nearest_first ? w->stack[at - 1].t < child.t : w->stack[at - 1].t > child.t); at--)
        w->stack[at] = w->stack[at - 1];
    w->stack[at] = child;
}

/* The rays go on to the children of n. */
ALWAYS_INLINE void meet_children(Walk *w, const WideNode *n, Lanes lanes)
{
    int base = w->top;
    unsigned children = 0;
    w->n_boxes += (uint64_t)__builtin_popcount(lanes) * n->n_children;
    for (uint32_t first = 0; first < n->n_children; first += ROW) {
        float t[ROW];
        uint64_t met = meet_row(w, n, first, lanes, t);
        while (met) {
            int i = __builtin_ctzll(met) / 8;
            push(w, (Waiting){ n->child[first + i], met >> 8 * i & 0xFF, t[i] }, base);
            met &= ~((uint64_t)0xFF << 8 * i);
            children |= 1u << (first + i);
        }
    }
    if (w->ahead) fetch_children(w->tree, n, children);
}

/* ---- the walk ---- */

typedef struct { BvhBunchVisit visit; void *context; } Visitor;

ALWAYS_INLINE Lanes visit_together(Visitor v, uint32_t item, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    BunchItems items;
    items.is_one = true, items.item[0] = item;
    return v.visit(v.context, &items, b, lanes, t_max, t) & lanes;
}

/* Those of the rays whose directions have the same signs as the first's. */
ALWAYS_INLINE Lanes same_signs(Walk *w, Lanes lanes)
{
    int first = __builtin_ctz(lanes);
    for (int k = 0; k < 3; k++) {
        Lanes negative = w->slabs.negative[k];
        w->side[k] = negative >> first & 1;
        lanes &= w->side[k] ? negative : ~negative;
    }
    return lanes;
}

/* Rays into more octants than this have little in common. */
#define MOST_OCTANTS 2

ALWAYS_INLINE bool are_apart(Walk *w, Lanes lanes)
{
    int octants = 0;
    for (; lanes && octants <= MOST_OCTANTS; octants++) lanes &= ~same_signs(w, lanes);
    return octants > MOST_OCTANTS;
}

ALWAYS_INLINE V8f v8f_only(Lanes lanes, V8f a, V8f otherwise)
{
    V8i bit = { 1, 2, 4, 8, 16, 32, 64, 128 };
    return v8f_select(((int)lanes & bit) == bit, a, otherwise);
}

/* From the root, for rays whose directions have the same signs; those that visits ended. */
ALWAYS_INLINE Lanes walk_down(Walk *w, RayBunch *b, Lanes lanes, double t_max[], Visitor v, Trace *t)
{
    Lanes ended = 0;
    w->t_min = v8f_only(lanes, w->slabs.t_min, v8f_splat(INFINITY));
    w->stack[0] = (Waiting){ 0, lanes, -INFINITY }, w->top = 1;
    while (w->top > 0 && ended != lanes) {
        Waiting next = w->stack[--w->top];
        Lanes going = next.lanes & ~ended;
        if (w->nearest_first)      /* hits have come nearer since */
            going &= v8_mask(__builtin_convertvector(v8f_splat(next.t) <= w->limit, V8c));
        if (!going) continue;
        if (next.child & IS_ITEM) {
            ended |= visit_together(v, next.child & ~IS_ITEM, b, going, t_max, t);
            if (w->nearest_first) w->limit = limits_of(&w->slabs, t_max);
        } else {
            meet_children(w, &w->tree->nodes[next.child], going);
        }
    }
    return ended;
}

ALWAYS_INLINE Lanes visit_single(const WideBvh *tree, RayBunch *b, Lanes lanes, double t_max[], Visitor v, Trace *t)
{
    V8d enter;
    lanes &= enter_box(&tree->bounds, b, v8d_load_doubles(t_max), &enter);
    return lanes ? visit_together(v, tree->single, b, lanes, t_max, t) : 0;
}

ALWAYS_INLINE Lanes walk(const WideBvh *tree, RayBunch *b, Lanes lanes, double t_max[], Visitor v, Trace *t,
                         bool nearest_first)
{
    uint64_t *count = t->is_shadow_ray ? &t->counters.light_bv_intersections : &t->counters.bv_intersections;
    *count += (uint64_t)__builtin_popcount(lanes);
    if (tree->is_single) return visit_single(tree, b, lanes, t_max, v, t);
    use_slabs(tree, b);
    Walk w;
    Lanes ended = 0, left = lanes & b->slabs.meeting;
    bool was_ahead = t->fetches_ahead;
    w.tree = tree, w.slabs = b->slabs, w.nearest_first = nearest_first, w.n_boxes = 0;
    w.ahead = t->fetches_ahead = was_ahead || tree->is_large;
    w.limit = limits_of(&w.slabs, t_max);
    if (w.ahead || are_apart(&w, left)) {
        ended = bvh_walk_apart(tree, b, left, t_max, v.visit, v.context, nearest_first, t);
        left = 0;
    }
    while (left) {
        Lanes together = same_signs(&w, left);
        ended |= walk_down(&w, b, together, t_max, v, t);
        left &= ~together;
    }
    t->fetches_ahead = was_ahead;
    *count += w.n_boxes;
    return ended;
}

/* ---- rays of binary trees go alone ---- */

typedef struct { Visitor v; RayBunch *b; int i; double *t_max; } Alone;

static bool visit_alone(void *context, uint32_t item, const Ray *r, double *t_max, Trace *t)
{
    Alone *a = context;
    (void)r, (void)t_max;      /* which is that of a->t_max */
    return visit_together(a->v, item, a->b, 1u << a->i, a->t_max, t) != 0;
}

static Lanes walk_alone(const Bvh *tree, RayBunch *b, Lanes lanes, double t_max[], Visitor v, Trace *t)
{
    Lanes ended = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        Alone a = { v, b, i, t_max };
        if (bvh_traverse(tree, &b->ray[i], &t_max[i], visit_alone, &a, t)) ended |= 1u << i;
    }
    return ended;
}

EVERY_X86
Lanes bvh_traverse_bunch(const Bvh *tree, RayBunch *b, Lanes lanes, double t_max[], BvhBunchVisit visit, void *context,
                         Trace *t)
{
    const WideBvh *wide = bvh_wide_of(tree);
    Visitor v = { visit, context };
    return wide ? walk(wide, b, lanes, t_max, v, t, true) : walk_alone(tree, b, lanes, t_max, v, t);
}

EVERY_X86
Lanes bvh_any_bunch(const Bvh *tree, RayBunch *b, Lanes lanes, const double t_max[], BvhBunchVisit visit, void *context,
                    Trace *t)
{
    const WideBvh *wide = bvh_wide_of(tree);
    Visitor v = { visit, context };
    double most[BUNCH_WIDTH];
    memcpy(most, t_max, sizeof most);
    return wide ? walk(wide, b, lanes, most, v, t, false) : walk_alone(tree, b, lanes, most, v, t);
}
