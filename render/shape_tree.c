/* Finite parts in a BVH, unbounded ones in a list; ties settled by rank. */
#include "render/shape_tree.h"

#include "render/bvh.h"
#include "render/hit_list.h"

typedef struct {
    const Shape *shape;
    uint32_t first_index;      /* primitives of the parts before it */
    uint32_t rank;             /* of two hits at the same t the one of lower rank wins */
    unsigned flags;
} Part;

struct ShapeTree {
    const Part *parts;
    Bvh *bvh;                  /* over all parts; the boxes of unbounded ones were given as empty */
    const uint32_t *unbounded;
    uint32_t n_unbounded;
};

static void rank_parts(Part *parts, uint32_t n, const uint32_t *unbounded, uint32_t n_unbounded, bool unbounded_first)
{
    uint32_t next = unbounded_first ? n_unbounded : 0;
    for (uint32_t i = 0, k = 0; i < n; i++) {
        bool is_unbounded = k < n_unbounded && unbounded[k] == i;
        parts[i].rank = unbounded_first && is_unbounded ? k : next++;
        k += is_unbounded;
    }
}

ShapeTree *shape_tree_build(Arena *a, Shape *const shapes[], const unsigned char *flags, uint32_t n, bool unbounded_first)
{
    ShapeTree *tree = ARENA_NEW(a, ShapeTree);
    Part *parts = ARENA_ARRAY(a, Part, n);
    uint32_t *unbounded = ARENA_ARRAY(a, uint32_t, n), index = 0;
    Arena *scratch = arena_new();
    Box *boxes = ARENA_ARRAY(scratch, Box, n);
    for (uint32_t i = 0; i < n; i++) {
        parts[i] = (Part){ shapes[i], index, 0, flags ? flags[i] : 0 };
        index += shapes[i]->n_primitives;
        boxes[i] = shape_bounds(shapes[i]);
        if (box_is_empty(boxes[i]) || box_is_finite(boxes[i])) continue;
        boxes[i] = box_empty();
        unbounded[tree->n_unbounded++] = i;
    }
    rank_parts(parts, n, unbounded, tree->n_unbounded, unbounded_first);
    tree->parts = parts;
    tree->unbounded = unbounded;
    tree->bvh = bvh_build(a, boxes, n, BVH_SAH);
    arena_free(scratch);
    return tree;
}

typedef struct {
    const ShapeTree *tree;
    unsigned skip;
    Hit *best;
    int64_t best_rank;         /* -1: *best comes from elsewhere, and keeps ties */
} Search;

/* A part of lower rank is asked for hits up to and including the best so far. */
static bool visit_nearest(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *s = context;
    const Part *p = &s->tree->parts[i];
    if (p->flags & s->skip) return false;
    double before = s->best->t;
    if (p->rank < s->best_rank) s->best->t = nextafter(before, INFINITY);
    if (!shape_hit(p->shape, r, s->best, t)) {
        s->best->t = before;
        return false;
    }
    s->best->index += p->first_index;
    s->best_rank = p->rank;
    *t_max = s->best->t;
    return false;
}

bool shape_tree_hit(const ShapeTree *tree, const Ray *r, unsigned skip, Hit *best, Trace *t)
{
    Search s = { tree, skip, best, -1 };
    double t_max = best->t;
    for (uint32_t i = 0; i < tree->n_unbounded; i++) visit_nearest(&s, tree->unbounded[i], r, &t_max, t);
    bvh_traverse(tree->bvh, r, &t_max, visit_nearest, &s, t);
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

static bool visit_any(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    const Search *s = context;
    const Part *p = &s->tree->parts[i];
    return !(p->flags & s->skip) && shape_blocks(p->shape, r, *t_max, t);
}

bool shape_tree_blocks(const ShapeTree *tree, const Ray *r, unsigned skip, double t_max, Trace *t)
{
    Search s = { tree, skip, NULL, -1 };
    for (uint32_t i = 0; i < tree->n_unbounded; i++)
        if (visit_any(&s, tree->unbounded[i], r, &t_max, t)) return true;
    return bvh_traverse(tree->bvh, r, &t_max, visit_any, &s, t);
}
