/* Preparation and search of `method certain`. See certain.h, and certify.h for what happens within a patch. */
#include "nurbs/certain.h"

#include "nurbs/bezier.h"
#include "nurbs/knots.h"
#include "nurbs/prepare.h"

#include <float.h>
#include <string.h>

/* A patch is halved until its derivatives vary by less than this share of themselves: then the certificate holds for all rays
 * but those within some asin(0.25) of its tangent planes. Halving divides the variation by about two. */
#define VARIATION_WANTED 0.25
/* What bends forever (a pole, a cusp) is left to clip.c, which refines along the ray alone. */
#define MAX_HALVINGS 8

/* ---- preparation ---- */

typedef struct {
    const Surface *s;
    Arena *own, *scratch;
    Patch *patches;
    bool *needs_trim_test;
    Box *boxes;
    size_t n_patches, n_flags, n_boxes, patches_capacity, flags_capacity, boxes_capacity;
    uint32_t n_cut, n_untested;
} Preparation;

static void keep_patch(Preparation *k, const Vec4 *points, TrimRect r, bool is_mixed)
{
    const Surface *s = k->s;
    Patch p;
    patch_make(k->own, s->k_u, s->k_v, points, r.u0, r.u1, r.v0, r.v1, &p);
    k->n_untested += s->trims && !is_mixed;
    Box box = bezier_hull(s->k_u * s->k_v, points);
    ARENA_PUSH(k->scratch, k->patches, k->n_patches, k->patches_capacity) = p;
    ARENA_PUSH(k->scratch, k->needs_trim_test, k->n_flags, k->flags_capacity) = is_mixed;
    ARENA_PUSH(k->scratch, k->boxes, k->n_boxes, k->boxes_capacity) = box_expand(box, s->rounding);
}

/* Cuts the points over an interval until each part is worth a frame; `points` is used up. */
static void cut_patch(Preparation *k, Vec4 *points, TrimRect r, int halvings_u, int halvings_v)
{
    const Surface *s = k->s;
    TrimClass class = s->trims ? trim_class(s->trims, r) : TRIM_KEPT;
    if (class == TRIM_CUT) {
        k->n_cut++;
        return;
    }
    PatchBend bend = patch_bend(s->k_u, s->k_v, points);
    bool can_u = halvings_u > 0, can_v = halvings_v > 0, along_u = bend.along_u >= bend.along_v ? can_u : !can_v;
    if (bend.variation <= VARIATION_WANTED || (!can_u && !can_v)) {
        keep_patch(k, points, r, class == TRIM_MIXED);
        return;
    }
    Vec4 left[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    TrimRect a = r, b = r;
    if (along_u) {
        a.u1 = b.u0 = r.u0 + 0.5 * (r.u1 - r.u0);
        for (int j = 0; j < s->k_v; j++) bezier_cut(s->k_u, 1, 0.5, points + j * s->k_u, left + j * s->k_u);
    } else {
        a.v1 = b.v0 = r.v0 + 0.5 * (r.v1 - r.v0);
        bezier_cut(s->k_v, s->k_u, 0.5, points, left);
    }
    cut_patch(k, left, a, halvings_u - along_u, halvings_v - !along_u);
    cut_patch(k, points, b, halvings_u - along_u, halvings_v - !along_u);
}

void certain_prepare(Arena *a, Arena *scratch, const Surface *s, PatchTree *out)
{
    ArenaMark mark = arena_mark(scratch);
    Arena *lists = arena_new();
    Preparation k = { .s = s, .own = a, .scratch = lists };
    Vec4 points[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    for (int j = s->k_v - 1; j < s->n_v; j++)
        for (int i = s->k_u - 1; i < s->n_u; i++) {
            if (!knots_is_span(s->tau_u, i) || !knots_is_span(s->tau_v, j)) continue;
            prepare_close_span(s, i, j, points);
            TrimRect r = { s->tau_u[i], s->tau_u[i + 1], s->tau_v[j], s->tau_v[j + 1] };
            cut_patch(&k, points, r, MAX_HALVINGS, MAX_HALVINGS);
        }
    *out = (PatchTree){ .patches = arena_copy(a, k.patches, k.n_patches, sizeof *k.patches),
                        .needs_trim_test = arena_copy(a, k.needs_trim_test, k.n_flags, sizeof *k.needs_trim_test),
                        .n_patches = (uint32_t)k.n_patches,
                        .bvh = bvh_build(a, k.boxes, (uint32_t)k.n_patches, BVH_SAH),
                        .n_cut = k.n_cut, .n_untested = k.n_untested };
    arena_free(lists);
    arena_reset(scratch, mark);
}

/* ---- search ---- */

typedef struct {
    const Surface *s;
    const PatchTree *tree;
    PatchRay ray;
    double *t_max;            /* the traversal's, in units of the ray's direction */
    double length;            /* of that direction */
    uint32_t patch;           /* being solved */
    Trace *trace;
    bool wants_any, found;
    CertainHit nearest;
} Search;

static double lerp(double a, double b, double x) { return x >= 1 ? b : a + x * (b - a); }

static bool accept_root(void *context, const Patch *p, PatchRay *ray, const Root *root)
{
    Search *k = context;
    Counters *count = &k->trace->counters;
    count->nurbs_hits++;
    double u = lerp(p->u0, p->u1, root->s), v = lerp(p->v0, p->v1, root->t);
    if (k->tree->needs_trim_test[k->patch]) {
        count->trim_tests++;
        if (!trim_keeps(k->s->trims, u, v)) return false;
    }
    count->reported_hits++;
    ray->t_max = root->depth;
    k->trace->root.leaf = p, k->trace->root.s = root->s, k->trace->root.t = root->t, k->trace->root.seed = k->trace->seed;
    k->nearest = (CertainHit){ u, v, root->depth / k->length, root->distance / k->length, k->patch };
    k->found = true;
    *k->t_max = k->nearest.t;
    return k->wants_any;
}

static bool visit_patch(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *k = context;
    (void)r;
    k->t_max = t_max, k->patch = i, k->trace = t;
    t->counters.nurbs_tests++;
    double begin = t->measures_time ? stats_now() : 0;
    bool ended = patch_roots(&k->tree->patches[i], &k->ray, accept_root, k, t);
    if (t->measures_time) t->counters.nurbs_seconds += stats_now() - begin;
    return ended;
}

static bool search_patches(Search *k, const Ray *r, double t_max, Trace *t)
{
    k->length = vec_length(r->dir);
    k->ray = patch_ray(r->origin, vec_normalize(r->dir), r->t_min * k->length, t_max * k->length);
    if (t->root.seed == t->seed) k->ray.guess = t->root.leaf, k->ray.guess_s = t->root.s, k->ray.guess_t = t->root.t;
    bvh_traverse(k->tree->bvh, r, &t_max, visit_patch, k, t);
    return k->found;
}

bool certain_nearest(const Surface *s, const PatchTree *tree, const Ray *r, double t_max, Trace *t, CertainHit *out)
{
    Search k = { .s = s, .tree = tree };
    if (!search_patches(&k, r, t_max, t)) return false;
    *out = k.nearest;
    return true;
}

bool certain_any(const Surface *s, const PatchTree *tree, const Ray *r, double t_max, Trace *t)
{
    Search k = { .s = s, .tree = tree, .wants_any = true };
    return search_patches(&k, r, t_max, t);
}

Vec3 certain_normal(const PatchTree *tree, uint32_t i, double u, double v)
{
    const Patch *p = &tree->patches[i];
    return patch_normal(p, (u - p->u0) / (p->u1 - p->u0), (v - p->v0) / (p->v1 - p->v0));
}
