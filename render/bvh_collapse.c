/* From two children a node to sixteen, as [YKL17] do it.
 *
 * A ray comes to a node about as often as its box has area ([WBB08]), and then tests all of its children at once. So the
 * binary nodes that remain as wide ones are chosen for the least sum of their areas. Let cost(n, j) be the least for the
 * tree below binary node n in place of which j children stand; those of an inner node come from both of its own:
 *     cost(n, j) = min over i of cost(first, i) + cost(second, j - i),     cost(n, 1) = area(n) + cost(n, 8),
 * and 0 where an item stands. */
#include "render/bvh_collapse.h"

#include <math.h>

#define WIDTH WIDE_WIDTH
#define IS_ITEM WIDE_IS_ITEM

typedef struct {
    float cost[WIDTH + 1];         /* by the number of children at most */
    uint8_t of_first[WIDTH + 1];   /* how many of them come from the node's first child; 0: none, it is a child itself */
    uint8_t own;                   /* the same of the children that it has as a wide node */
} Cut;

typedef struct {
    const BvhNode *nodes;
    const uint32_t *items;
    const WideBvh *const *parts;   /* of bvh_wide_join; NULL: all items are items */
    const uint32_t *first_item;
    Cut *cuts;                     /* of the binary nodes */
    Arena *arena;                  /* of these lists alone */
    WideNode *wide;
    size_t n_wide, capacity;
    size_t lent_size, behind_size; /* of the parts' items, which are all of one kind */
} Collapse;

/* A child to be: a binary node, or one of the children of the root of the part that stands there. */
typedef struct { uint32_t node; int of_part; } Child;
#define ALL_OF_IT (-1)

static uint32_t item_of(const Collapse *c, const BvhNode *leaf) { return c->items ? c->items[leaf->first] : leaf->first; }

static const WideBvh *part_of(const Collapse *c, const BvhNode *n)
{
    return c->parts && n->n_items ? c->parts[item_of(c, n)] : NULL;
}

/* ---- choosing ---- */

/* Of a leaf: an item costs nothing; a part costs its root, unless that has no more children than may stand there. */
static void cut_leaf(const WideBvh *part, float area, Cut *out)
{
    bool has_root = part && !part->is_single;
    for (uint32_t j = 1; j <= WIDTH; j++) {
        bool is_opened = has_root && part->nodes[0].n_children <= j;
        out->cost[j] = has_root && !is_opened ? area : 0;
        out->of_first[j] = is_opened;
    }
}

static void find_cuts(Collapse *c, uint32_t at)
{
    const BvhNode *n = &c->nodes[at];
    Cut *cut = &c->cuts[at];
    float area = (float)box_area(n->box);
    if (n->n_items) {
        cut_leaf(part_of(c, n), area, cut);
        return;
    }
    find_cuts(c, n->first);
    find_cuts(c, n->first + 1);
    const Cut *a = &c->cuts[n->first], *b = a + 1;
    for (uint8_t j = 2; j <= WIDTH; j++) {
        cut->cost[j] = INFINITY;
        for (uint8_t i = 1; i < j; i++) {
            float cost = a->cost[i] + b->cost[j - i];
            if (cost < cut->cost[j] || i == 1) cut->cost[j] = cost, cut->of_first[j] = i;
        }
    }
    cut->own = cut->of_first[WIDTH];
    cut->cost[1] = area + cut->cost[WIDTH], cut->of_first[1] = 0;
    for (uint8_t j = 2; j <= WIDTH; j++)
        if (cut->cost[j] > cut->cost[1]) cut->cost[j] = cut->cost[1], cut->of_first[j] = 0;
}

static uint32_t list_split(const Collapse *c, uint32_t at, uint32_t of_first, uint32_t of_second, Child *list, uint32_t n);

/* What stands in place of node `at`, where j children may; appended to the list of n. */
static uint32_t list_children(const Collapse *c, uint32_t at, uint32_t j, Child *list, uint32_t n)
{
    const BvhNode *node = &c->nodes[at];
    uint32_t of_first = c->cuts[at].of_first[j];
    if (of_first == 0) return list[n] = (Child){ at, ALL_OF_IT }, n + 1;
    if (!node->n_items) return list_split(c, at, of_first, j - of_first, list, n);
    for (uint32_t i = 0; i < part_of(c, node)->nodes[0].n_children; i++) list[n++] = (Child){ at, (int)i };
    return n;
}

static uint32_t list_split(const Collapse *c, uint32_t at, uint32_t of_first, uint32_t of_second, Child *list, uint32_t n)
{
    n = list_children(c, c->nodes[at].first, of_first, list, n);
    return list_children(c, c->nodes[at].first + 1, of_second, list, n);
}

/* The children of a wide node in place of node `at`: the root may be a leaf. */
static uint32_t list_own(const Collapse *c, uint32_t at, Child list[WIDTH])
{
    if (c->nodes[at].n_items) return list[0] = (Child){ at, ALL_OF_IT }, 1;
    return list_split(c, at, c->cuts[at].own, WIDTH - c->cuts[at].own, list, 0);
}

/* ---- making ---- */

/* A reference within a part whose node 0 is at `at` here (its root may not be here: then it is not referred to). */
static uint32_t moved(uint32_t child, uint32_t at, uint32_t first_item)
{
    return child + (child & IS_ITEM ? first_item : at);
}

/* Copies the part's nodes from `from` on; where its node 0 would be. */
static uint32_t copy_part(Collapse *c, const WideBvh *part, uint32_t from, uint32_t first_item)
{
    uint32_t at = (uint32_t)c->n_wide - from;
    c->lent_size = part->item_size, c->behind_size = part->behind_size;
    for (uint32_t i = from; i < part->n_nodes; i++) {
        WideNode *n = &ARENA_PUSH(c->arena, c->wide, c->n_wide, c->capacity);
        *n = part->nodes[i];
        if (part->items) n->items = (uintptr_t)part->items - (uintptr_t)first_item * part->item_size;
        for (uint32_t k = 0; k < n->n_children; k++) n->child[k] = moved(n->child[k], at, first_item);
    }
    return at;
}

static uint32_t item_child(Collapse *c, const BvhNode *n)
{
    uint32_t i = item_of(c, n);
    if (!c->parts) return IS_ITEM | i;
    const WideBvh *part = c->parts[i];
    if (!part) return IS_ITEM | c->first_item[i];
    if (part->is_single) return IS_ITEM | (c->first_item[i] + part->single);
    return copy_part(c, part, 0, c->first_item[i]);
}

static void set_box(WideNode *w, uint32_t i, Box b)
{
    for (int k = 0; k < 3; k++) w->side[0][k][i] = b.lo[k], w->side[1][k][i] = b.hi[k];
}

/* The box of child k of the root of a part. */
static void take_box(WideNode *w, uint32_t i, const WideNode *root, int k)
{
    for (int s = 0; s < 2; s++)
        for (int axis = 0; axis < 3; axis++) w->side[s][axis][i] = root->side[s][axis][k];
}

static uint32_t collapse(Collapse *c, uint32_t from);

/* Sets children i ... of c->wide[at], as many as the part at list[i] has in its root; how many these are. */
static uint32_t open_part(Collapse *c, uint32_t at, uint32_t i, const BvhNode *n)
{
    const WideBvh *part = part_of(c, n);
    uint32_t first_item = c->first_item[item_of(c, n)], base = copy_part(c, part, 1, first_item);
    const WideNode *root = &part->nodes[0];
    for (uint32_t k = 0; k < root->n_children; k++) {
        take_box(&c->wide[at], i + k, root, (int)k);
        c->wide[at].child[i + k] = moved(root->child[k], base, first_item);
    }
    return root->n_children;
}

static uint32_t collapse(Collapse *c, uint32_t from)
{
    Child list[WIDTH];
    uint32_t n = list_own(c, from, list), at = (uint32_t)c->n_wide;
    WideNode w = { .n_children = n, .exists = (1u << n) - 1 };
    for (uint32_t i = 0; i < WIDTH; i++) set_box(&w, i, i < n ? c->nodes[list[i].node].box : box_empty());
    ARENA_PUSH(c->arena, c->wide, c->n_wide, c->capacity) = w;
    for (uint32_t i = 0; i < n; ) {
        const BvhNode *node = &c->nodes[list[i].node];
        if (list[i].of_part != ALL_OF_IT) {
            i += open_part(c, at, i, node);
            continue;
        }
        uint32_t child = node->n_items ? item_child(c, node) : collapse(c, list[i].node);
        c->wide[at].child[i++] = child;
    }
    return at;
}

/* Room for all nodes of the parts, and one in place of each binary node above them: a list that grows would for a moment
 * take three times the memory of all. */
static void make_room(Collapse *c, uint32_t n_nodes)
{
    for (uint32_t i = 0; i < n_nodes; i++) {
        const WideBvh *part = part_of(c, &c->nodes[i]);
        c->capacity += part ? part->n_nodes : 1;
    }
    c->wide = ARENA_ARRAY(c->arena, WideNode, c->capacity);
}

/* Bytes of nodes. What they lead to is as large again, or more. */
#define SMALL_TREE ((size_t)1 << 19)

static WideBvh *build(Arena *a, Collapse c, uint32_t n_nodes)
{
    const BvhNode *nodes = c.nodes;
    c.arena = arena_new();
    c.cuts = ARENA_ARRAY(c.arena, Cut, n_nodes);
    if (c.parts) make_room(&c, n_nodes);
    find_cuts(&c, 0);
    collapse(&c, 0);
    WideBvh *w = ARENA_NEW(a, WideBvh);
    *w = (WideBvh){ .nodes = arena_copy(a, c.wide, c.n_wide, sizeof *c.wide), .n_nodes = (uint32_t)c.n_wide,
                    .bounds = nodes[0].box, .diagonal = box_diagonal(nodes[0].box) };
    for (int k = 0; k < 3; k++)
        w->largest = double_max(w->largest, double_max(fabs(w->bounds.lo[k]), fabs(w->bounds.hi[k])));
    w->lent_size = c.lent_size, w->behind_size = c.behind_size;
    w->is_large = c.n_wide * sizeof *c.wide > SMALL_TREE;
    w->is_single = nodes[0].n_items > 0 && w->nodes[0].child[0] & IS_ITEM;
    w->single = w->nodes[0].child[0] & ~IS_ITEM;
    arena_free(c.arena);
    return w;
}

WideBvh *bvh_wide_build(Arena *a, const BvhNode *nodes, uint32_t n, const uint32_t *items)
{
    return build(a, (Collapse){ .nodes = nodes, .items = items }, n);
}

WideBvh *bvh_wide_join(Arena *a, const BvhNode *nodes, uint32_t n, const uint32_t *items, const WideBvh *const parts[],
                       const uint32_t first_item[])
{
    return build(a, (Collapse){ .nodes = nodes, .items = items, .parts = parts, .first_item = first_item }, n);
}
