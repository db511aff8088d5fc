/* Traversal, Newton, trims: what becomes of a leaf that the ray reaches. See intersect.h. */
#include "nurbs/intersect.h"

#include "render/hash.h"

typedef struct {
    const Surface *s;
    const LeafTree *tree;
    NewtonRay ray;
    int max_iterations;
    bool wants_any;
    bool found;
    SurfaceHit nearest;
} Search;

static bool solve(Search *search, uint32_t i, NewtonRoot *root, Trace *t)
{
    uint64_t seed = hash_combine(t->seed, i);
    double begin = t->measures_time ? stats_now() : 0;
    bool is_root = newton_solve(search->s, &search->tree->leaves[i], &search->ray, search->max_iterations, seed,
                                &t->counters, root) == NEWTON_ROOT;
    if (t->measures_time) t->counters.nurbs_seconds += stats_now() - begin;
    t->counters.nurbs_tests++;
    t->counters.nurbs_hits += is_root;
    return is_root;
}

/* A root outside the leaf may be where the trims say something else. */
static bool is_kept(const Surface *s, const Leaf *leaf, const NewtonRoot *root, Trace *t)
{
    bool is_inside = leaf->u0 <= root->u && root->u <= leaf->u1 && leaf->v0 <= root->v && root->v <= leaf->v1;
    if (!s->trims || (is_inside && !leaf->needs_trim_test)) return true;
    t->counters.trim_tests++;
    return trim_keeps(s->trims, root->u, root->v);
}

static bool visit_leaf(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *search = context;
    NewtonRoot root;
    if (!solve(search, i, &root, t)) return false;
    if (!(root.t > r->t_min && root.t < *t_max)) return false;
    if (!is_kept(search->s, &search->tree->leaves[i], &root, t)) return false;
    t->counters.reported_hits++;
    search->nearest = (SurfaceHit){ root, i };
    search->found = true;
    *t_max = root.t;
    return search->wants_any;
}

static bool search_leaves(Search *search, const Ray *r, double t_max, Trace *t)
{
    search->ray = newton_ray(r);
    if (search->max_iterations == 0) search->max_iterations = NEWTON_MAX_ITERATIONS;
    bvh_traverse(search->tree->bvh, r, &t_max, visit_leaf, search, t);
    return search->found;
}

bool intersect_nearest(const Surface *s, const LeafTree *tree, int max_iterations, const Ray *r, double t_max, Trace *t,
                       SurfaceHit *out)
{
    Search search = { .s = s, .tree = tree, .max_iterations = max_iterations };
    if (!search_leaves(&search, r, t_max, t)) return false;
    *out = search.nearest;
    return true;
}

bool intersect_any(const Surface *s, const LeafTree *tree, int max_iterations, const Ray *r, double t_max, Trace *t)
{
    Search search = { .s = s, .tree = tree, .max_iterations = max_iterations, .wants_any = true };
    return search_leaves(&search, r, t_max, t);
}
