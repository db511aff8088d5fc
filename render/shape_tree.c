/* Finite parts in a BVH, unbounded ones in a list; ties settled by rank. */
#include "render/shape_tree.h"

#include "render/hit_list.h"
#include "render/shape_tree_parts.h"

/* What stands in a tree for a part with these bounds; empty: they have no end, or there is nothing in them. */
static Box tree_box(Box bounds) { return box_is_finite(bounds) ? bounds : box_empty(); }

ShapeTree *shape_tree_build(Arena *a, Shape *const shapes[], const unsigned char *flags, uint32_t n, bool unbounded_first)
{
    ShapeTree *tree = ARENA_NEW(a, ShapeTree);
    Part *parts = ARENA_ARRAY(a, Part, n);
    uint32_t *unbounded = ARENA_ARRAY(a, uint32_t, n), index = 0;
    Arena *scratch = arena_new();
    Box *boxes = ARENA_ARRAY(scratch, Box, n);
    for (uint32_t i = 0; i < n; i++) {
        parts[i] = (Part){ shapes[i], shape_bare(shapes[i]), index, flags ? flags[i] : 0, shapes[i]->type->took != NULL };
        tree->flags |= parts[i].flags;
        index += shapes[i]->n_primitives;
        Box bounds = shape_bounds(shapes[i]);
        boxes[i] = tree_box(bounds);
        if (!box_is_empty(bounds) && box_is_empty(boxes[i])) unbounded[tree->n_unbounded++] = i;
    }
    tree->parts = parts, tree->n = n;
    tree->lowest_rank = unbounded_first ? n : 0;
    tree->unbounded = unbounded;
    tree->bvh = bvh_build(a, boxes, n, BVH_SAH);
    tree->searched = bvh_node_count(tree->bvh) > 0 ? tree->bvh : NULL;
    arena_free(scratch);
    return tree;
}

/* The tree of each part that lends one, and the boxes of the others. */
typedef struct {
    const ShapeTree *tree;
    const Bvh **lent;
    const ShapeType **lenders;
    Box *boxes;
} Lending;

static void lend_part(void *context, uint32_t i, Arena *own, Trace *t)
{
    const Lending *k = context;
    Shape *s = (Shape *)k->tree->parts[i].shape;    /* preparing it is the one change that is made to a shape */
    k->lent[i] = s->type->lend ? s->type->lend(s, own, t, &k->lenders[i]) : NULL;
    k->boxes[i] = k->lent[i] ? bvh_bounds(k->lent[i]) : tree_box(shape_bounds(s));
}

/* All items of a tree are asked for in the same way: what the first lender's type is. NULL: nobody lends. */
static const ShapeType *choose_lender(const Lending *k)
{
    const ShapeType *lender = NULL;
    for (uint32_t i = 0; i < k->tree->n; i++) {
        if (k->lent[i] && !lender) lender = k->lenders[i];
        if (k->lent[i] && k->lenders[i] != lender) k->lent[i] = NULL;
    }
    return lender;
}

static void join(ShapeTree *tree, Arena *a, const Lending *k, Arena *scratch)
{
    uint32_t *first = ARENA_ARRAY(scratch, uint32_t, tree->n), n_items = 0;
    for (uint32_t i = 0; i < tree->n; i++) first[i] = n_items, n_items += k->lent[i] ? bvh_item_count(k->lent[i]) : 1;
    Item *items = ARENA_ARRAY(a, Item, n_items);
    for (uint32_t i = 0; i < tree->n; i++)
        for (uint32_t item = first[i], end = i + 1 < tree->n ? first[i + 1] : n_items; item < end; item++)
            items[item] = k->lent[i] ? (Item){ i, item - first[i], bvh_item(k->lent[i], item - first[i]) }
                                     : (Item){ i, ALL_OF_IT, tree->parts[i].shape };
    tree->items = items;
    tree->joined = bvh_join(a, k->boxes, k->lent, first, tree->n);
    bvh_set_items(tree->joined, &(BvhItems){ items, sizeof *items, NULL, 0 });
    tree->searched = tree->joined;
}

void shape_tree_join(ShapeTree *tree, const Shape *whole, Arena *a, Trace *t)
{
    Arena *scratch = arena_new();
    Lending k = { tree, ARENA_ARRAY(scratch, const Bvh *, tree->n), ARENA_ARRAY(scratch, const ShapeType *, tree->n),
                  ARENA_ARRAY(scratch, Box, tree->n) };
    shape_share_work(whole, a, tree->n, lend_part, &k, t);
    tree->lender = choose_lender(&k);
    if (tree->lender) join(tree, a, &k, scratch);
    arena_free(scratch);
}

typedef struct {
    const ShapeTree *tree;
    unsigned skip;             /* 0: no part has any of these flags */
    Hit *best;
    int64_t best_rank;         /* -1: *best comes from elsewhere, and keeps ties */
} Search;

static bool hit_item(const ShapeTree *tree, Item i, const Ray *r, Hit *best, Trace *t)
{
    if (i.item == ALL_OF_IT) return shape_hit(tree->parts[i.part].shape, r, best, t);
    if (!tree->lender->hit_item(i.at, i.item, r, best, t)) return false;
    const Part *p = &tree->parts[i.part];
    if (p->has_took) p->shape->type->took(p->shape, r, best);
    return true;
}

/* A part of lower rank is asked for hits up to and including the best so far. Of a part nothing is read without need: in a
 * large tree it is not in the cache. */
static bool meet_nearest(Search *s, Item i, int64_t rank, const Ray *r, double *t_max, Trace *t)
{
    const Part *p = &s->tree->parts[i.part];
    if (s->skip && p->flags & s->skip) return false;
    double before = s->best->t;
    if (rank < s->best_rank) s->best->t = double_neighbour(before, 1);
    if (!hit_item(s->tree, i, r, s->best, t)) {
        s->best->t = before;
        return false;
    }
    s->best->index += p->first_index;
    s->best_rank = rank;
    *t_max = s->best->t;
    return false;
}

static bool visit_nearest(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *s = context;
    Item item = item_at(s->tree, i, t);
    return meet_nearest(s, item, (int64_t)s->tree->lowest_rank + item.part, r, t_max, t);
}

bool shape_tree_hit(const ShapeTree *tree, const Ray *r, unsigned skip, Hit *best, Trace *t)
{
    Search s = { tree, skip & tree->flags, best, -1 };
    double t_max = best->t;
    for (uint32_t i = 0; i < tree->n_unbounded; i++)
        meet_nearest(&s, (Item){ tree->unbounded[i], ALL_OF_IT, NULL }, tree->unbounded[i], r, &t_max, t);
    if (tree->searched) bvh_traverse(tree->searched, r, &t_max, visit_nearest, &s, t);
    return s.best_rank >= 0;
}

typedef struct { const ShapeTree *tree; HitList *out; } Gathering;

static bool visit_all(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    const Gathering *g = context;
    const Part *p = &g->tree->parts[i];
    size_t first = g->out->n;
    (void)t_max;
    shape_all_hits(p->shape, r, g->out, t);
    for (size_t k = first; k < g->out->n; k++) g->out->hits[k].index += p->first_index;
    return false;
}

void shape_tree_all_hits(const ShapeTree *tree, const Ray *r, HitList *out, Trace *t)
{
    Gathering g = { tree, out };
    size_t first = out->n;
    double t_max = out->t_max;
    for (uint32_t i = 0; i < tree->n_unbounded; i++) visit_all(&g, tree->unbounded[i], r, &t_max, t);
    bvh_traverse(tree->bvh, r, &t_max, visit_all, &g, t);
    hit_list_sort(out, first);
}

static bool meet_any(const Search *s, Item i, const Ray *r, const double *t_max, Trace *t)
{
    const Part *p = &s->tree->parts[i.part];
    if (s->skip && p->flags & s->skip) {
        t->left_out |= p->flags;
        return false;
    }
    if (i.item == ALL_OF_IT) return shape_blocks(p->bare, r, *t_max, t);
    return s->tree->lender->item_blocks(i.at, i.item, r, *t_max, t);
}

static bool visit_any(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    const Search *s = context;
    bool blocks = meet_any(s, item_at(s->tree, i, t), r, t_max, t);
    if (blocks) blocker_note(&t->blockers, s->tree, i);
    return blocks;
}

static bool is_still_blocked(const Search *s, const Ray *r, double t_max, Trace *t)
{
    uint32_t i = blocker_recall(&t->blockers, s->tree);
    if (i == UINT32_MAX || i >= bvh_item_count(s->tree->searched)) return false;
    if (meet_any(s, item_at(s->tree, i, t), r, &t_max, t)) return true;
    blocker_forget(&t->blockers, s->tree);
    return false;
}

bool shape_tree_blocks(const ShapeTree *tree, const Ray *r, unsigned skip, double t_max, Trace *t)
{
    Search s = { tree, skip & tree->flags, NULL, -1 };
    if (tree->searched && is_still_blocked(&s, r, t_max, t)) return true;
    for (uint32_t i = 0; i < tree->n_unbounded; i++)
        if (meet_any(&s, (Item){ tree->unbounded[i], ALL_OF_IT, NULL }, r, &t_max, t)) return true;
    return tree->searched && bvh_any(tree->searched, r, t_max, visit_any, &s, t);
}
