/* Searches of a tree of shapes for bunches of rays: as shape_tree.c has them for one ray, each step of them. */
#include "render/bunch.h"
#include "render/bvh_bunch.h"
#include "render/shape_tree_parts.h"

typedef struct {
    const ShapeTree *tree;
    unsigned skip;             /* 0: no part has any of these flags */
    Lanes hit;                 /* the rays that have found one here */
    Hit *best;                 /* of each ray */
    int64_t best_rank[BUNCH_WIDTH], highest_rank;   /* of those that are hit: see shape_tree.c */
} Search;

/* ---- the nearest ---- */

static Lanes hit_lent(const ShapeType *lender, Item i, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    if (lender->hit_item_bunch) return lender->hit_item_bunch(i.at, i.item, b, lanes, best, t);
    Lanes hit = 0;
    while (lanes) {
        int k = lanes_next(&lanes);
        bunch_begin(b, k, t);
        if (lender->hit_item(i.at, i.item, &b->ray[k], &best[k], t)) hit |= 1u << k;
        bunch_end(b, k, t);
    }
    return hit;
}

static Lanes hit_item(const ShapeTree *tree, Item i, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    const Part *p = &tree->parts[i.part];
    if (i.item == ALL_OF_IT) return shape_hit_bunch(p->shape, b, lanes, best, t);
    Lanes hit = hit_lent(tree->lender, i, b, lanes, best, t);
    for (Lanes left = p->has_took ? hit : 0; left; ) {
        int k = lanes_next(&left);
        p->shape->type->took(p->shape, &b->ray[k], &best[k]);
    }
    return hit;
}

static void meet_nearest(Search *s, Item i, int64_t rank, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    const Part *p = &s->tree->parts[i.part];
    if (s->skip && p->flags & s->skip) return;
    Lanes raised = 0;
    double before[BUNCH_WIDTH];
    for (Lanes left = rank < s->highest_rank ? lanes & s->hit : 0; left; ) {
        int k = lanes_next(&left);
        if (rank >= s->best_rank[k]) continue;
        before[k] = s->best[k].t, s->best[k].t = double_neighbour(before[k], 1);
        raised |= 1u << k;
    }
    Lanes hit = hit_item(s->tree, i, b, lanes, s->best, t);
    for (Lanes left = raised & ~hit; left; ) {
        int k = lanes_next(&left);
        s->best[k].t = before[k];
    }
    s->hit |= hit;
    if (hit && rank > s->highest_rank) s->highest_rank = rank;
    while (hit) {
        int k = lanes_next(&hit);
        s->best[k].index += p->first_index, s->best_rank[k] = rank;
        t_max[k] = s->best[k].t;
    }
}

static Lanes visit_nearest(void *context, uint32_t i, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    Search *s = context;
    Item item = item_at(s->tree, i, t);
    meet_nearest(s, item, (int64_t)s->tree->lowest_rank + item.part, b, lanes, t_max, t);
    return 0;
}

Lanes shape_tree_hit_bunch(const ShapeTree *tree, RayBunch *b, Lanes lanes, unsigned skip, Hit best[], Trace *t)
{
    Search s = { .tree = tree, .skip = skip & tree->flags, .best = best };
    double t_max[BUNCH_WIDTH];
    for (int k = 0; k < BUNCH_WIDTH; k++) t_max[k] = best[k].t;
    for (uint32_t i = 0; i < tree->n_unbounded; i++)
        meet_nearest(&s, (Item){ tree->unbounded[i], ALL_OF_IT, NULL }, tree->unbounded[i], b, lanes, t_max, t);
    if (tree->searched) bvh_traverse_bunch(tree->searched, b, lanes, t_max, visit_nearest, &s, t);
    return s.hit;
}

/* ---- any ---- */

static Lanes lent_blocks(const ShapeType *lender, Item i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    if (lender->item_blocks_bunch) return lender->item_blocks_bunch(i.at, i.item, b, lanes, t_max, t);
    Lanes blocked = 0;
    while (lanes) {
        int k = lanes_next(&lanes);
        bunch_begin(b, k, t);
        if (lender->item_blocks(i.at, i.item, &b->ray[k], t_max[k], t)) blocked |= 1u << k;
        bunch_end(b, k, t);
    }
    return blocked;
}

static Lanes meet_any(const Search *s, Item i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    const Part *p = &s->tree->parts[i.part];
    if (!(s->skip && p->flags & s->skip))
        return i.item == ALL_OF_IT ? shape_blocks_bunch(p->bare, b, lanes, t_max, t)
                                   : lent_blocks(s->tree->lender, i, b, lanes, t_max, t);
    while (lanes) b->lane[lanes_next(&lanes)].left_out |= p->flags;
    return 0;
}

static Lanes visit_any(void *context, uint32_t i, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    const Search *s = context;
    Lanes blocked = meet_any(s, item_at(s->tree, i, t), b, lanes, t_max, t);
    if (blocked) blocker_note(&t->blockers, s->tree, i);
    return blocked;
}

static Lanes still_blocked(const Search *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    uint32_t i = blocker_recall(&t->blockers, s->tree);
    if (i == UINT32_MAX || i >= bvh_item_count(s->tree->searched)) return 0;
    Lanes blocked = meet_any(s, item_at(s->tree, i, t), b, lanes, t_max, t);
    if (!blocked) blocker_forget(&t->blockers, s->tree);
    return blocked;
}

Lanes shape_tree_blocks_bunch(const ShapeTree *tree, RayBunch *b, Lanes lanes, unsigned skip, const double t_max[],
                              Trace *t)
{
    Search s = { .tree = tree, .skip = skip & tree->flags };
    Lanes left = lanes;
    if (tree->searched) left &= ~still_blocked(&s, b, left, t_max, t);
    for (uint32_t i = 0; i < tree->n_unbounded && left; i++)
        left &= ~meet_any(&s, (Item){ tree->unbounded[i], ALL_OF_IT, NULL }, b, left, t_max, t);
    if (tree->searched && left) left &= ~bvh_any_bunch(tree->searched, b, left, t_max, visit_any, &s, t);
    return lanes & ~left;
}
