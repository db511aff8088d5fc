/* Traversal, Newton, trims: what becomes of a leaf that the ray reaches. See intersect.h. */
#include "nurbs/intersect.h"

#include "nurbs/knots.h"
#include "nurbs/normal.h"
#include "nurbs/refine.h"
#include "render/hash.h"

/* How often a leaf that may fold is quartered. Measured on 1024 x 1024 pictures: without it the teapot has specks along its
 * silhouettes; with 2, three of its pixels differ from those of `method certain` (1 of the goblet's, none of the spoon's, 9
 * of allblade's); with 3, the same three. */
#define FOLD_DEPTH 2

typedef struct {
    const Surface *s;
    const LeafTree *tree;
    NewtonRay ray;
    int max_iterations;
    double t_min, *t_max;        /* of the ray; lowered as roots are found */
    bool wants_any;
    bool found;
    SurfaceHit nearest;
} Search;

static bool solve(Search *search, const Leaf *leaf, uint64_t seed, NewtonRoot *root, Trace *t)
{
    bool is_root = newton_solve(search->s, leaf, &search->ray, search->max_iterations, seed, &t->counters,
                                root) == NEWTON_ROOT;
    t->counters.leaf_tests++, t->counters.nurbs_tests++;
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

/* A root that cannot be told from t_min is not beyond it: where a ray leaves this very surface, the point that it left by
 * its own error bound is found again with the error of this root. */
static bool note_root(Search *search, uint32_t i, const Leaf *leaf, const NewtonRoot *root, Trace *t)
{
    if (!(root->t - root->t_error > search->t_min && root->t < *search->t_max)) return false;
    if (!is_kept(search->s, leaf, root, t)) return false;
    t->counters.reported_hits++;
    search->nearest = (SurfaceHit){ *root, i };
    search->found = true;
    *search->t_max = root->t;
    return search->wants_any;
}

/* A leaf, or a part of one. The paper: "we are not so much interested in flatness as in guaranteeing that there are not
 * multiple roots within a leaf [...] this guarantee cannot always be made, particularly for nodes which contain silhouettes
 * according to the ray source". Where it cannot, the leaf is flattened further, for this ray: each quarter has a guess of
 * its own. */
static bool visit_part(Search *search, uint32_t i, const Leaf *part, int depth, Trace *t)
{
    NewtonView view = newton_view(search->s, part, &search->ray);
    if (view == NEWTON_OFF) return false;
    if (view == NEWTON_FOLDED && depth < FOLD_DEPTH) {
        for (int k = 0; k < 4; k++) {
            Leaf quarter = newton_quarter(search->s, part, k);
            if (visit_part(search, i, &quarter, depth + 1, t)) return true;
        }
        return false;
    }
    NewtonRoot root;
    return solve(search, part, hash_combine(t->seed, i), &root, t) && note_root(search, i, part, &root, t);
}

static bool visit_leaf(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *search = context;
    search->t_min = r->t_min, search->t_max = t_max;
    double begin = t->measures_time ? stats_now() : 0;
    bool is_end = visit_part(search, i, &search->tree->leaves[i], 0, t);
    if (t->measures_time) t->counters.nurbs_seconds += stats_now() - begin;
    return is_end;
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

/* ---- the normal of the winner ---- */

/* Evaluates on the leaf's side of corners and gaps. */
static SurfacePoint evaluate_beside(const Surface *s, const Leaf *l, double u, double v)
{
    SurfacePoint p;
    int mu_u = u < l->piece_u->hi ? knots_span(s->k_u, s->n_u, s->tau_u, u) : knots_span_left(s->k_u, s->n_u, s->tau_u, u);
    int mu_v = v < l->piece_v->hi ? knots_span(s->k_v, s->n_v, s->tau_v, v) : knots_span_left(s->k_v, s->n_v, s->tau_v, v);
    refine_evaluate(s, mu_u, u, mu_v, v, &p);
    return p;
}

typedef struct { const Surface *s; const Leaf *leaf; double u, v; } Way;

static NormalTangents tangents_at(const void *context, double inwards)
{
    const Way *k = context;
    const Leaf *l = k->leaf;
    double middle_u = l->u0 + (l->u1 - l->u0) / 2, middle_v = l->v0 + (l->v1 - l->v0) / 2;
    SurfacePoint p = evaluate_beside(k->s, l, k->u + inwards * (middle_u - k->u), k->v + inwards * (middle_v - k->v));
    return (NormalTangents){ vec_scale(p.s_u, l->u1 - l->u0), vec_scale(p.s_v, l->v1 - l->v0) };
}

/* (The size: what derivatives are differences of, that of the surface and its distance from the origin.) */
Vec3 intersect_normal(const Surface *s, const Leaf *leaf, double u, double v, const Ray *r)
{
    return normal_limit(tangents_at, &(Way){ s, leaf, u, v }, s->farthest, vec_neg(r->dir));
}
