/* The adapter: a Surface as a Shape (render/shape.h). Its constructor is in nurbs.h. */
#include "nurbs/intersect.h"
#include "nurbs/knots.h"
#include "nurbs/prepare.h"
#include "nurbs/refine.h"
#include "render/shape.h"

typedef struct {
    Shape shape;
    const Surface *surface;
    NurbsOptions options;
    LeafTree tree;               /* after preparation */
    double prep_seconds;
} NurbsShape;

static Box nurbs_bounds(const Shape *s) { return ((const NurbsShape *)s)->surface->box; }

static void nurbs_prepare(Shape *s, Arena *own, Trace *t)
{
    NurbsShape *n = (NurbsShape *)s;
    double begin = stats_now();
    prepare_leaves(own, t->scratch, n->surface, &n->options, &n->tree);
    n->prep_seconds = stats_now() - begin;
}

static bool nurbs_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    SurfaceHit hit;
    if (!intersect_nearest(n->surface, &n->tree, n->options.max_iterations, r, best->t, t, &hit)) return false;
    hit_set(best, hit.root.t, hit.root.t_error, hit.root.u, hit.root.v, s, hit.leaf);
    return true;
}

static bool nurbs_blocks(const Shape *s, const Ray *r, double t_max, Trace *t)
{
    const NurbsShape *n = (const NurbsShape *)s;
    return intersect_any(n->surface, &n->tree, n->options.max_iterations, r, t_max, t);
}

/* Evaluates on the leaf's side of corners and gaps. */
static SurfacePoint evaluate_beside(const Surface *s, const Leaf *l, double u, double v)
{
    SurfacePoint p;
    int mu_u = u < l->piece_u->hi ? knots_span(s->k_u, s->n_u, s->tau_u, u) : knots_span_left(s->k_u, s->n_u, s->tau_u, u);
    int mu_v = v < l->piece_v->hi ? knots_span(s->k_v, s->n_v, s->tau_v, v) : knots_span_left(s->k_v, s->n_v, s->tau_v, v);
    refine_evaluate(s, mu_u, u, mu_v, v, &p);
    return p;
}

/* The normal loses its meaning when S_u x S_v is lost in the rounding of S_u and S_v: if one of them is (its length over the
 * leaf is near s->rounding), or if they are parallel. Half of the bits are asked for. */
static bool is_regular(const Surface *s, const Leaf *l, const SurfacePoint *p, Vec3 normal)
{
    double along_u = vec_length(p->s_u), along_v = vec_length(p->s_v);
    double lost = 0x1p26 * s->rounding;
    return along_u * (l->u1 - l->u0) > lost && along_v * (l->v1 - l->v0) > lost
        && vec_length(normal) > 0x1p-26 * along_u * along_v;
}

/* S_u x S_v; at a pole or on a collapsed side, its limit from inside the leaf: the point is moved towards the middle of the
 * leaf, no farther than it takes. */
static Vec3 normal_at(const Surface *s, const Leaf *l, double u, double v)
{
    double middle_u = l->u0 + (l->u1 - l->u0) / 2, middle_v = l->v0 + (l->v1 - l->v0) / 2;
    Vec3 normal = { 0, 0, 0 };
    for (double inwards = 0; inwards <= 1; inwards = inwards > 0 ? inwards * 16 : 0x1p-20) {
        SurfacePoint p = evaluate_beside(s, l, u + inwards * (middle_u - u), v + inwards * (middle_v - v));
        normal = vec_cross(p.s_u, p.s_v);
        if (is_regular(s, l, &p, normal)) break;
    }
    return normal;
}

static void nurbs_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    const NurbsShape *n = (const NurbsShape *)shape;
    const Surface *s = n->surface;
    (void)r;
    out->normal = vec_normalize(normal_at(s, &n->tree.leaves[h->leaf], h->u, h->v));
    out->shading_normal = out->normal;
    out->uv = vec2((h->u - s->u0) / (s->u1 - s->u0), (h->v - s->v0) / (s->v1 - s->v0));
}

static const ShapeType nurbs_type = {
    .name = "trimmed_nurbs", .bounds = nurbs_bounds, .prepare = nurbs_prepare, .hit = nurbs_hit, .blocks = nurbs_blocks,
    .attributes = nurbs_attributes
};

Shape *nurbs_shape_new(Arena *a, const SurfaceDesc *desc, const NurbsOptions *options, NurbsError *error,
                       NurbsWarning *warnings, int max_warnings, int *n_warnings)
{
    const Surface *s = surface_new(a, desc, error, warnings, max_warnings, n_warnings);
    if (!s) return NULL;
    NurbsShape *n = ARENA_NEW(a, NurbsShape);
    shape_init(&n->shape, &nurbs_type);
    n->surface = s;
    n->options = *options;
    return &n->shape;
}

bool nurbs_shape_info(const Shape *shape, NurbsInfo *out)
{
    if (shape->type != &nurbs_type) return false;
    const NurbsShape *n = (const NurbsShape *)shape;
    const Surface *s = n->surface;
    *out = (NurbsInfo){ .is_polynomial = s->is_polynomial, .has_trims = s->trims != NULL };
    if (s->trims) out->n_trims = trim_loop_count(s->trims), out->n_trim_pieces = trim_piece_count(s->trims);
    out->was_prepared = shape_was_prepared(shape);
    if (!out->was_prepared) return true;
    out->n_leaves = (int)n->tree.n_leaves;
    out->n_leaves_trimmed_away = (int)n->tree.n_cut;
    out->n_leaves_untested = (int)n->tree.n_untested;
    out->prep_seconds = n->prep_seconds;
    out->bytes = arena_bytes(shape->own);
    return true;
}

bool nurbs_shape_point(const Shape *shape, double u, double v, Vec3 *point, Vec3 *s_u, Vec3 *s_v)
{
    if (shape->type != &nurbs_type) return false;
    surface_point(((const NurbsShape *)shape)->surface, u, v, point, s_u, s_v);
    return true;
}
