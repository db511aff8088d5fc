/* Bounding volume hierarchy: built top down in one array, two children side by side; traversed with a stack.
 *
 * Two ways to split: [MCFS00] section 2.2 (sort the boxes along the axis of greatest extent, split them in half), and the
 * surface area heuristic over bins ([Wal07]). Both halve at the latest below SAH_MAX_DEPTH, which bounds the depth of
 * every tree, and so the traversal's stack, whatever the boxes are. Ties are broken by index: the tree depends on the
 * boxes alone. */
#include "render/bvh_wide.h"

#include <assert.h>

#define N_BINS 16
#define SAH_MAX_DEPTH 32                      /* beyond it the boxes are halved: */
#define MAX_DEPTH (SAH_MAX_DEPTH + 32)        /* at most 32 more levels, since there are fewer than 2^32 boxes */

typedef struct { Box box; uint32_t index; } Item;

struct Bvh {
    WideBvh *wide;              /* BVH_SAH: this is what is traversed; nodes and items are NULL */
    const BvhNode *nodes;
    uint32_t n_nodes;
    const uint32_t *items;      /* indices of boxes, leaf by leaf: one each */
    uint32_t n_items;           /* one more than the largest of them */
    Box bounds;
};

/* ---- building ---- */

typedef struct {
    Item *items;
    BvhNode *nodes;
    uint32_t n_nodes;
    BvhSplit split;
    Arena *scratch;
} Builder;

static double centre(const Item *i, int axis) { return .5 * ((double)i->box.lo[axis] + i->box.hi[axis]); }

static Box bounds_of(const Item *items, uint32_t n)
{
    Box b = box_empty();
    for (uint32_t i = 0; i < n; i++) b = box_union(b, items[i].box);
    return b;
}

static int longest_axis(Box b)
{
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if ((double)b.hi[k] - b.lo[k] > (double)b.hi[axis] - b.lo[axis]) axis = k;
    return axis;
}

static bool is_before(const Item *a, const Item *b, int axis)
{
    double ca = centre(a, axis), cb = centre(b, axis);
    return ca < cb || (ca == cb && a->index < b->index);
}

static void swap_items(Item *a, Item *b)
{
    Item t = *a;
    *a = *b;
    *b = t;
}

/* Moves the middle of three candidates to items[0], as the pivot: sorted input does not make the selection slow. */
static void pivot_to_front(Item *items, uint32_t n, int axis)
{
    Item *a = &items[0], *b = &items[n / 2], *c = &items[n - 1];
    Item *middle = is_before(a, b, axis) ? (is_before(b, c, axis) ? b : is_before(a, c, axis) ? c : a)
                                         : (is_before(a, c, axis) ? a : is_before(b, c, axis) ? c : b);
    swap_items(a, middle);
}

/* Hoare's selection: afterwards the `half` items that sort first stand first. */
static void select_half(Item *items, uint32_t n, uint32_t half, int axis)
{
    while (n > 1 && half > 0 && half < n) {
        pivot_to_front(items, n, axis);
        uint32_t last = 0;                                    /* items[1 .. last] sort before the pivot */
        for (uint32_t i = 1; i < n; i++)
            if (is_before(&items[i], &items[0], axis)) swap_items(&items[i], &items[++last]);
        swap_items(&items[0], &items[last]);
        if (half <= last) {
            n = last;
        } else {
            items += last + 1, n -= last + 1, half -= last + 1;
        }
    }
}

static uint32_t split_in_half(Item *items, uint32_t n, Box bounds)
{
    select_half(items, n, n / 2, longest_axis(bounds));
    return n / 2;
}

typedef struct { Box box; uint32_t n; } Bin;
typedef struct { int axis, bin; double cost, lo, scale; } Split;     /* items of bins 0 .. bin go left */

static int bin_of(const Item *i, int axis, double lo, double scale)
{
    int bin = (int)((centre(i, axis) - lo) * scale);
    return bin < 0 ? 0 : bin >= N_BINS ? N_BINS - 1 : bin;
}

/* The cheapest split of bins: sum over both sides of area times count. */
static void best_of_bins(const Bin bins[N_BINS], Split *candidate)
{
    double right_cost[N_BINS];
    Bin side = { box_empty(), 0 };
    for (int i = N_BINS - 1; i > 0; i--) {
        side.box = box_union(side.box, bins[i].box);
        side.n += bins[i].n;
        right_cost[i] = side.n ? box_area(side.box) * side.n : INFINITY;
    }
    side = (Bin){ box_empty(), 0 };
    for (int i = 0; i < N_BINS - 1; i++) {
        side.box = box_union(side.box, bins[i].box);
        side.n += bins[i].n;
        double cost = side.n ? box_area(side.box) * side.n + right_cost[i + 1] : INFINITY;
        if (cost < candidate->cost) candidate->cost = cost, candidate->bin = i;
    }
}

/* cost INFINITY: the centres coincide, or areas overflow. */
static Split find_split(const Item *items, uint32_t n)
{
    Split best = { .cost = INFINITY };
    for (int axis = 0; axis < 3; axis++) {
        double lo = INFINITY, hi = -INFINITY;
        for (uint32_t i = 0; i < n; i++) {
            lo = fmin(lo, centre(&items[i], axis));
            hi = fmax(hi, centre(&items[i], axis));
        }
        Split candidate = { .axis = axis, .cost = INFINITY, .lo = lo, .scale = N_BINS / (hi - lo) };
        if (!(hi > lo) || !isfinite(candidate.scale)) continue;
        Bin bins[N_BINS];
        for (int i = 0; i < N_BINS; i++) bins[i] = (Bin){ box_empty(), 0 };
        for (uint32_t i = 0; i < n; i++) {
            Bin *b = &bins[bin_of(&items[i], axis, lo, candidate.scale)];
            b->box = box_union(b->box, items[i].box);
            b->n++;
        }
        best_of_bins(bins, &candidate);
        if (candidate.cost < best.cost) best = candidate;
    }
    return best;
}

static uint32_t partition(Item *items, uint32_t n, const Split *s)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < n; i++)
        if (bin_of(&items[i], s->axis, s->lo, s->scale) <= s->bin) swap_items(&items[i], &items[left++]);
    return left;
}

/* How many of the items go to the left child; 0: a leaf, of one item. */
static uint32_t split_items(const Builder *b, Item *items, uint32_t n, Box bounds, int depth)
{
    if (n == 1) return 0;
    if (b->split == BVH_MEDIAN || depth >= SAH_MAX_DEPTH) return split_in_half(items, n, bounds);
    Split s = find_split(items, n);
    return s.cost < INFINITY ? partition(items, n, &s) : split_in_half(items, n, bounds);
}

static void build_node(Builder *b, uint32_t at, uint32_t first, uint32_t n, int depth)
{
    assert(depth <= MAX_DEPTH);
    Item *items = b->items + first;
    Box bounds = bounds_of(items, n);
    uint32_t left = split_items(b, items, n, bounds, depth);
    if (left == 0) {
        b->nodes[at] = (BvhNode){ bounds, first, n };
        return;
    }
    uint32_t child = b->n_nodes;
    b->n_nodes += 2;
    b->nodes[at] = (BvhNode){ bounds, child, 0 };
    build_node(b, child, first, left, depth + 1);
    build_node(b, child + 1, first + left, n - left, depth + 1);
}

static uint32_t gather(const Box *boxes, uint32_t n, Item *items)
{
    uint32_t n_items = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (box_is_empty(boxes[i])) continue;
        assert(box_is_finite(boxes[i]));
        items[n_items++] = (Item){ boxes[i], i };
    }
    return n_items;
}

static Bvh *new_wide(Arena *a, WideBvh *wide, Box bounds, uint32_t n_items)
{
    Bvh *out = ARENA_NEW(a, Bvh);
    *out = (Bvh){ .bounds = bounds, .wide = wide, .n_items = n_items, .n_nodes = wide ? bvh_wide_node_count(wide) : 0 };
    return out;
}

static uint32_t *item_indices(Arena *a, const Builder *b, uint32_t n_items)
{
    uint32_t *indices = ARENA_ARRAY(a, uint32_t, n_items);
    for (uint32_t i = 0; i < n_items; i++) indices[i] = b->items[i].index;
    return indices;
}

static Bvh *new_binary(Arena *a, const Builder *b, uint32_t n_items, uint32_t n_boxes)
{
    Bvh *out = ARENA_NEW(a, Bvh);
    *out = (Bvh){ .bounds = b->nodes[0].box, .n_items = n_boxes, .items = item_indices(a, b, n_items), .n_nodes = b->n_nodes,
                  .nodes = arena_copy(a, b->nodes, b->n_nodes, sizeof(BvhNode)) };
    return out;
}

/* The binary tree, in scratch memory; the number of items. */
static uint32_t build_binary(Builder *b, const Box *boxes, uint32_t n)
{
    b->items = ARENA_ARRAY(b->scratch, Item, n);
    b->nodes = ARENA_ARRAY(b->scratch, BvhNode, 2 * (size_t)n);
    uint32_t n_items = gather(boxes, n, b->items);
    if (n_items == 0) return 0;
    b->n_nodes = 1;
    build_node(b, 0, 0, n_items, 0);
    return n_items;
}

Bvh *bvh_build(Arena *a, const Box *boxes, uint32_t n, BvhSplit split)
{
    Builder b = { .split = split, .scratch = arena_new() };     /* freed here: the tree itself lies close together in a */
    uint32_t n_items = build_binary(&b, boxes, n);
    Bvh *out;
    if (n_items == 0) out = new_wide(a, NULL, box_empty(), 0);
    else if (split == BVH_MEDIAN) out = new_binary(a, &b, n_items, n);
    else out = new_wide(a, bvh_wide_build(a, b.nodes, b.n_nodes, item_indices(b.scratch, &b, n_items)), b.nodes[0].box, n);
    arena_free(b.scratch);
    return out;
}

Bvh *bvh_join(Arena *a, const Box *boxes, const Bvh *const parts[], const uint32_t first_item[], uint32_t n)
{
    Builder b = { .split = BVH_SAH, .scratch = arena_new() };
    uint32_t n_items = build_binary(&b, boxes, n);
    const WideBvh **wide = ARENA_ARRAY(b.scratch, const WideBvh *, n);
    for (uint32_t i = 0; i < n; i++) {
        wide[i] = parts[i] ? parts[i]->wide : NULL;
        assert(box_is_empty(boxes[i]) || !parts[i] || wide[i]);
    }
    const uint32_t *items = item_indices(b.scratch, &b, n_items);
    WideBvh *joined = n_items ? bvh_wide_join(a, b.nodes, b.n_nodes, items, wide, first_item) : NULL;
    uint32_t last = n ? n - 1 : 0, end = n ? first_item[last] + (parts[last] ? bvh_item_count(parts[last]) : 1) : 0;
    Bvh *out = new_wide(a, joined, n_items ? b.nodes[0].box : box_empty(), end);
    arena_free(b.scratch);
    return out;
}

Bvh *bvh_from_tree(Arena *a, const BvhNode *nodes, uint32_t n_nodes)
{
    uint32_t n_items = 0;
    if (n_nodes == 0) return new_wide(a, NULL, box_empty(), 0);
    for (uint32_t i = 0; i < n_nodes; i++)
        if (nodes[i].n_items > 0 && nodes[i].first >= n_items) n_items = nodes[i].first + 1;
    return new_wide(a, bvh_wide_build(a, nodes, n_nodes, NULL), nodes[0].box, n_items);
}

void bvh_set_items(Bvh *b, const BvhItems *items)
{
    if (b->wide) bvh_wide_set_items(b->wide, items);
}

const void *bvh_item(const Bvh *b, uint32_t i) { return b->wide ? bvh_wide_item(b->wide, i) : NULL; }

const WideBvh *bvh_wide_of(const Bvh *b) { return b->wide; }

Box bvh_bounds(const Bvh *b) { return b->bounds; }
uint32_t bvh_node_count(const Bvh *b) { return b->n_nodes; }
uint32_t bvh_item_count(const Bvh *b) { return b->n_items; }

/* ---- traversal ---- */

typedef struct {
    const Bvh *bvh;
    BoxRay box_ray;
    const Ray *ray;
    double *t_max;
    uint64_t *n_boxes;
} Walk;

static bool meets(const Walk *w, const Box *b, double *t_enter)
{
    ++*w->n_boxes;
    return box_hit(b, &w->box_ray, w->ray->t_min, *w->t_max, t_enter);
}

typedef struct { uint32_t node; double t_enter; } Waiting;

/* Children that the ray meets go onto the stack, the nearer one on top. */
static int push_children(const Walk *w, const BvhNode *n, Waiting *stack, int top)
{
    Waiting a = { n->first, 0 }, b = { n->first + 1, 0 };
    bool meets_a = meets(w, &w->bvh->nodes[a.node].box, &a.t_enter);
    bool meets_b = meets(w, &w->bvh->nodes[b.node].box, &b.t_enter);
    bool a_first = a.t_enter <= b.t_enter;
    if (meets_a && (!meets_b || !a_first)) stack[top++] = a;
    if (meets_b) stack[top++] = b;
    if (meets_a && meets_b && a_first) stack[top++] = a;
    return top;
}

bool bvh_traverse(const Bvh *b, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t)
{
    if (b->n_nodes == 0) return false;
    if (b->wide) return bvh_wide_traverse(b->wide, r, t_max, visit, context, t);
    Walk w = { b, box_ray(r->origin, r->dir), r, t_max,
               t->is_shadow_ray ? &t->counters.light_bv_intersections : &t->counters.bv_intersections };
    Waiting stack[MAX_DEPTH + 1];                 /* one sibling waits for each level, and two at the last */
    int top = 0;
    stack[0].node = 0;
    if (meets(&w, &b->nodes[0].box, &stack[0].t_enter)) top = 1;
    while (top > 0) {
        Waiting next = stack[--top];
        if (next.t_enter > *t_max) continue;      /* a hit has come nearer since */
        const BvhNode *n = &b->nodes[next.node];
        if (n->n_items == 0) top = push_children(&w, n, stack, top);
        else if (visit(context, b->items[n->first], r, t_max, t)) return true;
    }
    return false;
}

bool bvh_any(const Bvh *b, const Ray *r, double t_max, BvhVisit visit, void *context, Trace *t)
{
    if (b->wide) return bvh_wide_any(b->wide, r, t_max, visit, context, t);
    return bvh_traverse(b, r, &t_max, visit, context, t);
}
