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

/* ---- items ---- */

/* The items of the parts' own that rays ask for; ranks: of the parts, see shape_tree.c. */
typedef struct {
    BunchItems items;
    uint32_t part[BUNCH_WIDTH];
} Asked;

/* Those of `lanes` that ask for an item of a part, not for the part itself, and not for one that is to be skipped. */
static Lanes ask_for_items(const Search *s, const BunchItems *items, Lanes lanes, const Trace *t, Asked *out)
{
    Lanes lent = 0;
    out->items.is_one = false;
    for (Lanes left = s->tree->joined ? lanes : 0; left; ) {
        int k = lanes_next(&left);
        Item item = item_at(s->tree, items->item[k], t);
        if (item.item == ALL_OF_IT || (s->skip && s->tree->parts[item.part].flags & s->skip)) continue;
        out->items.item[k] = item.item, out->items.at[k] = item.at, out->part[k] = item.part;
        lent |= 1u << k;
    }
    return lent;
}

static void set_one(BunchItems *items, Item i)
{
    items->is_one = true, items->item[0] = i.item, items->at[0] = i.at;
}

/* ---- the nearest ---- */

static Lanes hit_lent(const ShapeType *lender, const BunchItems *items, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    if (lender->hit_items_bunch) return lender->hit_items_bunch(items, b, lanes, best, t);
    Lanes hit = 0;
    while (lanes) {
        int k = lanes_next(&lanes);
        bunch_begin(b, k, t);
        if (lender->hit_item(bunch_at(items, k), bunch_item(items, k), &b->ray[k], &best[k], t)) hit |= 1u << k;
        bunch_end(b, k, t);
    }
    return hit;
}

static void took(const Part *p, const RayBunch *b, Lanes hit, Hit best[])
{
    for (Lanes left = p->has_took ? hit : 0; left; ) {
        int k = lanes_next(&left);
        p->shape->type->took(p->shape, &b->ray[k], &best[k]);
    }
}

static Lanes hit_item(const ShapeTree *tree, Item i, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    const Part *p = &tree->parts[i.part];
    if (i.item == ALL_OF_IT) return shape_hit_bunch(p->shape, b, lanes, best, t);
    BunchItems items;
    set_one(&items, i);
    Lanes hit = hit_lent(tree->lender, &items, b, lanes, best, t);
    took(p, b, hit, best);
    return hit;
}

/* A part of lower rank is asked for hits up to and including the best so far. Those of `lanes` for which that is so; before:
 * what theirs was. */
static Lanes raise_best(Search *s, Lanes lanes, int64_t rank, double before[])
{
    Lanes raised = 0;
    for (Lanes left = rank < s->highest_rank ? lanes & s->hit : 0; left; ) {
        int k = lanes_next(&left);
        if (rank >= s->best_rank[k]) continue;
        before[k] = s->best[k].t, s->best[k].t = double_neighbour(before[k], 1);
        raised |= 1u << k;
    }
    return raised;
}

static void put_back(Search *s, Lanes raised, const double before[])
{
    while (raised) {
        int k = lanes_next(&raised);
        s->best[k].t = before[k];
    }
}

static void note_hits(Search *s, const Part *p, int64_t rank, Lanes hit, double t_max[])
{
    s->hit |= hit;
    if (hit && rank > s->highest_rank) s->highest_rank = rank;
    while (hit) {
        int k = lanes_next(&hit);
        s->best[k].index += p->first_index, s->best_rank[k] = rank;
        t_max[k] = s->best[k].t;
    }
}

static void meet_nearest(Search *s, Item i, int64_t rank, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    const Part *p = &s->tree->parts[i.part];
    if (s->skip && p->flags & s->skip) return;
    double before[BUNCH_WIDTH];
    Lanes raised = raise_best(s, lanes, rank, before), hit = hit_item(s->tree, i, b, lanes, s->best, t);
    put_back(s, raised & ~hit, before);
    note_hits(s, p, rank, hit, t_max);
}

static int64_t rank_of(const Search *s, uint32_t part) { return (int64_t)s->tree->lowest_rank + part; }

static void meet_nearest_items(Search *s, const Asked *a, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    double before[BUNCH_WIDTH];
    Lanes raised = 0;
    for (Lanes left = lanes; left; ) {
        int k = lanes_next(&left);
        raised |= raise_best(s, 1u << k, rank_of(s, a->part[k]), before);
    }
    Lanes hit = hit_lent(s->tree->lender, &a->items, b, lanes, s->best, t);
    put_back(s, raised & ~hit, before);
    while (hit) {
        int k = lanes_next(&hit);
        const Part *p = &s->tree->parts[a->part[k]];
        took(p, b, 1u << k, s->best);
        note_hits(s, p, rank_of(s, a->part[k]), 1u << k, t_max);
    }
}

static void visit_nearest_one(Search *s, uint32_t i, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    Item item = item_at(s->tree, i, t);
    meet_nearest(s, item, rank_of(s, item.part), b, lanes, t_max, t);
}

static Lanes visit_nearest(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    Search *s = context;
    if (items->is_one) {
        visit_nearest_one(s, items->item[0], b, lanes, t_max, t);
        return 0;
    }
    Asked asked;
    Lanes lent = ask_for_items(s, items, lanes, t, &asked);
    if (lent) meet_nearest_items(s, &asked, b, lent, t_max, t);
    for (lanes &= ~lent; lanes; ) {
        uint32_t i = items->item[__builtin_ctz(lanes)];
        visit_nearest_one(s, i, b, lanes_together(items, &lanes), t_max, t);
    }
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

static Lanes lent_blocks(const ShapeType *lender, const BunchItems *items, RayBunch *b, Lanes lanes, const double t_max[],
                         Trace *t)
{
    if (lender->items_block_bunch) return lender->items_block_bunch(items, b, lanes, t_max, t);
    Lanes blocked = 0;
    while (lanes) {
        int k = lanes_next(&lanes);
        bunch_begin(b, k, t);
        if (lender->item_blocks(bunch_at(items, k), bunch_item(items, k), &b->ray[k], t_max[k], t)) blocked |= 1u << k;
        bunch_end(b, k, t);
    }
    return blocked;
}

static Lanes meet_any(const Search *s, Item i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    const Part *p = &s->tree->parts[i.part];
    if (!(s->skip && p->flags & s->skip)) {
        if (i.item == ALL_OF_IT) return shape_blocks_bunch(p->bare, b, lanes, t_max, t);
        BunchItems items;
        set_one(&items, i);
        return lent_blocks(s->tree->lender, &items, b, lanes, t_max, t);
    }
    while (lanes) b->lane[lanes_next(&lanes)].left_out |= p->flags;
    return 0;
}

static Lanes visit_any_one(const Search *s, uint32_t i, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    Lanes blocked = meet_any(s, item_at(s->tree, i, t), b, lanes, t_max, t);
    if (blocked) blocker_note(&t->blockers, s->tree, i);
    return blocked;
}

static Lanes visit_any(void *context, const BunchItems *items, RayBunch *b, Lanes lanes, double t_max[], Trace *t)
{
    const Search *s = context;
    if (items->is_one) return visit_any_one(s, items->item[0], b, lanes, t_max, t);
    Asked asked;
    Lanes lent = ask_for_items(s, items, lanes, t, &asked);
    Lanes blocked = lent ? lent_blocks(s->tree->lender, &asked.items, b, lent, t_max, t) : 0;
    if (blocked) blocker_note(&t->blockers, s->tree, items->item[__builtin_ctz(blocked)]);
    for (lanes &= ~lent; lanes; ) {
        uint32_t i = items->item[__builtin_ctz(lanes)];
        blocked |= visit_any_one(s, i, b, lanes_together(items, &lanes), t_max, t);
    }
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
