/* See clip.h, and view.h for the boxes.
 *
 * Memory comes from the thread's scratch arena, with marks. The recursion ends where a box's image is as small as the
 * rounding error: some 50 halvings of either side away, and as many more as the ratio of the weights has bits. */
#include "nurbs/clip.h"

#include "nurbs/pole.h"

#include <math.h>

/* A box whose coefficients are within so many errors of zero cannot be told from the ray, nor a point. The error itself must
 * be accepted, lest anything be missed; the quarter more is what lets boxes be decided that are no larger than that. */
#define ON_THE_RAY 1.25
/* A box on the ray that is longer than this share of the tile's shorter side is no tangent point (those are some 2^-26
 * long, 2^-17 at a cusp): the ray runs in the surface there, and the hit is where it enters: to 4 roundings, of which the
 * box's ends have two each. But where visitors go on declining, for a trim or since they want all roots, boxes are not cut
 * up without end: from so many on, to this share of the tile's radius. */
#define IN_THE_SURFACE 0x1p-8
#define ENTRY 4
enum { MAX_DECLINED = 64 };
#define PART_OF_DECLINED 0x1p-4
/* Boxes of one search. Tangencies take some hundred, rays along the surface some thousand; a search that goes on is among
 * roots that no visitor takes as the nearest, on a surface that keeps to the ray within a few roundings. Then each box that
 * is left has one point of it reported, or none if Newton's method finds none. */
enum { PATIENCE = 1 << 15 };
/* Halvings one within the other, which end as the head of this file says; were they not to, the search makes do with points
 * before the stack ends. */
enum { MAX_DEPTH = 1000 };
#define MIN_CLIP 0.8         /* what leaves more than this of both sides is followed by a halving: [NSK90], the 20 % rule */

typedef struct {
    View view;
    bool is_certified;       /* at most one root in it, */
    Range strip;             /* which can be told from its neighbourhood only so far: its depth; set with has_strip */
    bool has_strip;
    bool is_in_surface;      /* the ray runs in the surface about here */
    bool is_needle;          /* its image is one: what the ray meets is little of its depth */
    bool has_pole;           /* one of its sides is a point on the ray: */
    PoleSide pole;
} Part;

static void restrict_part(Part *n, bool along_s, Range part)
{
    view_restrict(&n->view, along_s, part);
    if (n->pole.is_t != along_s && (n->pole.is_end ? part.hi < 1 : part.lo > 0)) n->has_pole = false;
}

typedef struct {
    const Tile *tile;
    const Patch *p;          /* the tile's */
    PatchRay *ray;
    RootVisit visit;
    void *context;
    Trace *trace;
    double rounding;         /* of the plane equations over the weight */
    double middle;           /* the depth of the patch's origin */
    double extent;           /* of the depth of what a ray in this direction can meet of the tile; 0: not computed yet */
    int reported;            /* roots, */
    int declined;            /* and those that the visitor did not take as the nearest */
    bool was_halved;         /* counted once as a fallback */
    int depth;               /* halvings one within the other */
    int patience;            /* boxes that may still be looked at before the search makes do with points that Newton finds */
} Search;

/* ---- the point of a box that is looked for ---- */

static double residual2(const ViewPoint *p) { return p->x.value * p->x.value + p->y.value * p->y.value; }

typedef struct { double s, t; } Step;

static Step newton_step(const ViewPoint *p)
{
    double det = p->x.by_s * p->y.by_t - p->x.by_t * p->y.by_s;
    return (Step){ (p->x.by_t * p->y.value - p->y.by_t * p->x.value) / det,
                   (p->y.by_s * p->x.value - p->x.by_s * p->y.value) / det };
}

/* Levenberg's: in directions along which all of the box is within `least` of where it is, it does not move. So it is
 * sensible where the box's image is a needle or a point, and Newton's elsewhere. */
static Step damped_step(const ViewPoint *p, double least)
{
    double xx = p->x.by_s * p->x.by_s + p->x.by_t * p->x.by_t + least * least;
    double yy = p->y.by_s * p->y.by_s + p->y.by_t * p->y.by_t + least * least;
    double xy = p->x.by_s * p->y.by_s + p->x.by_t * p->y.by_t, det = xx * yy - xy * xy;
    double x = (yy * p->x.value - xy * p->y.value) / det, y = (xx * p->y.value - xy * p->x.value) / det;
    return (Step){ -(p->x.by_s * x + p->y.by_s * y), -(p->x.by_t * x + p->y.by_t * y) };
}

/* From the middle of a certified box four or five of Newton's steps find the root to the last bit; if eight do not, the box
 * is cut once more, and nothing is lost. */
enum { MAX_STEPS = 8 };

/* The root of a certified part, if Newton's method ends within it. (That of certify.c may leave the patch by its margin;
 * this one may not leave the certified box.) */
static bool find_root(const Part *n, ViewPoint *root)
{
    *root = view_point(&n->view, 0.5, 0.5);
    for (int i = 0; i < MAX_STEPS; i++) {
        Step by = newton_step(root);
        double s = root->s + by.s, t = root->t + by.t;
        if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return false;
        if (fabs(by.s) < LAST_STEP && fabs(by.t) < LAST_STEP) {
            root->s = s, root->t = t, root->z.value += root->z.by_s * by.s + root->z.by_t * by.t;
            return isfinite(root->z.value);
        }
        *root = view_point(&n->view, s, t);
    }
    return false;
}

static double clamp_to_box(double x) { return double_min(double_max(x, 0), 1); }

/* Half of what ON_THE_RAY leaves for deciding. */
#define DAMPING 0.125

/* The point of the box nearest to the ray, about: downhill from the middle. */
static ViewPoint nearest_point(const Search *k, const Part *n)
{
    ViewPoint best = view_point(&n->view, 0.5, 0.5);
    for (int i = 0; i < MAX_STEPS; i++) {
        Step by = damped_step(&best, DAMPING * k->rounding);
        ViewPoint next = view_point(&n->view, clamp_to_box(best.s + by.s), clamp_to_box(best.t + by.t));
        if (!(residual2(&next) < residual2(&best))) break;
        best = next;
    }
    return best;
}

/* On the ray, as far as the error of the plane equations over the weight can tell. */
static bool is_on_ray(const ViewPoint *at, double error)
{
    return residual2(at) <= ON_THE_RAY * ON_THE_RAY * error * error;
}

static DepthOnRay on_ray(const Search *k, const Part *n)
{
    return view_depth_on_ray(&n->view, ON_THE_RAY * (k->rounding + n->view.lost));
}

static Range range_on_ray(const Search *k, const Part *n)
{
    DepthOnRay depth = on_ray(k, n);
    return (Range){ depth.range.lo - depth.slack, depth.range.hi + depth.slack };
}

static Range depth_of(const Search *k, const Part *n)
{
    return n->is_needle ? range_on_ray(k, n) : view_depth(&n->view);
}

/* ---- reporting ---- */

static Root root_at(const Search *k, const View *v, const ViewPoint *at)
{
    return (Root){ .s = double_min(v->s0 + at->s * v->w_s, 1), .t = double_min(v->t0 + at->t * v->w_t, 1),
                   .depth = k->middle + at->z.value, .distance = 2 * k->rounding, .beside = k->rounding };
}

static bool is_in_reach(const Search *k, const Root *root)
{
    return root->depth > k->ray->t_min && root->depth < k->ray->t_max;
}

static bool visit_root(Search *k, const Root *root)
{
    double t_max = k->ray->t_max;
    bool ended = k->visit(k->context, k->tile, k->ray, root);
    k->reported++;
    k->declined += k->ray->t_max >= t_max;
    return ended;
}

/* A simple root: an error of the plane equations moves it by the inverse Jacobian times that, and its depth with it. */
static bool report_root(Search *k, const Part *n, const ViewPoint *at)
{
    Root root = root_at(k, &n->view, at);
    if (!is_in_reach(k, &root)) return false;
    double det = at->x.by_s * at->y.by_t - at->x.by_t * at->y.by_s;
    double slope = hypot(at->z.by_s * at->y.by_t - at->z.by_t * at->y.by_s,
                         at->z.by_t * at->x.by_s - at->z.by_s * at->x.by_t);
    root.depth_error = k->rounding * (1 + slope / fabs(det)) + n->view.drift * k->p->radius;
    return visit_root(k, &root);
}

/* The cosine of the ray's angle to the normal at the point (s, t) of a box. */
static double cosine_at(const Search *k, const View *v, double s, double t)
{
    return vec_dot(patch_normal(k->p, v->s0 + s * v->w_s, v->t0 + t * v->w_t, vec_neg(k->ray->d)), k->ray->d);
}

static double extent_on_ray(Search *k)
{
    if (k->extent > 0) return k->extent;
    ArenaMark mark = arena_mark(k->trace->scratch);
    View v = view_of_tile(k->trace->scratch, k->tile, k->ray);
    DepthOnRay depth = view_depth_on_ray(&v, k->rounding);
    arena_reset(k->trace->scratch, mark);
    return k->extent = depth.range.hi - depth.range.lo + 2 * depth.slack + k->rounding;
}

/* How far a ray that touches a curve as large as what it can meet of the tile is within the rounding of it: a circle, if
 * the ray sees the other side of the surface then, else a cubic. */
static double touching_length(Search *k, bool turns)
{
    double size = extent_on_ray(k);
    return turns ? sqrt(2 * k->rounding * size) : cbrt(6 * k->rounding * size * size);
}

/* How far the depth moves if the surface moves by the rounding, where the box is too small to have derivatives: by the
 * tangent of that angle; but where the ray touches, no farther than that. */
static double depth_slack(Search *k, double cosine, bool turns)
{
    double across = fabs(cosine), along = sqrt(double_max(1 - across * across, 0)), touching = touching_length(k, turns);
    return k->rounding * along < across * touching ? k->rounding * along / across : touching;
}

static signed char sign_of(double x) { return x < 0 ? -1 : 1; }

/* From which side the ray sees the surface where it comes to the box, and where it leaves it. */
static void set_sides(const Search *k, const View *v, const ViewPoint *at, Root *root)
{
    bool along_s = fabs(at->z.by_s) >= fabs(at->z.by_t), ascends = (along_s ? at->z.by_s : at->z.by_t) > 0;
    double first = along_s ? cosine_at(k, v, 0, at->t) : cosine_at(k, v, at->s, 0);
    double last = along_s ? cosine_at(k, v, 1, at->t) : cosine_at(k, v, at->s, 1);
    root->before = sign_of(ascends ? first : last), root->after = sign_of(ascends ? last : first);
}

/* What is left of a box that cannot be cut any more, or lies on the ray. */
static bool report(Search *k, const Part *n, const ViewPoint *at)
{
    Root root = root_at(k, &n->view, at);
    if (!is_in_reach(k, &root)) return false;
    Range depth = n->has_strip ? n->strip : range_on_ray(k, n);
    if (!n->is_certified) set_sides(k, &n->view, at, &root);
    double slack = depth_slack(k, cosine_at(k, &n->view, at->s, at->t), root.before != root.after);
    double reach = double_max(double_max(depth.hi - at->z.value, at->z.value - depth.lo), 0);
    root.depth_error = reach + slack + k->rounding + n->view.drift * k->p->radius;
    root.distance += sqrt(residual2(at)), root.beside += sqrt(residual2(at));
    return visit_root(k, &root);
}

static bool report_pole(Search *k, const Part *n)
{
    double end = n->pole.is_end;
    ViewPoint at = n->pole.is_t ? view_point(&n->view, 0.5, end) : view_point(&n->view, end, 0.5);
    return report(k, n, &at);
}

/* ---- the search ---- */

static bool settle(Search *k, Part *n);

/* Both halves, the nearer one first, so that what lies behind an accepted root is never looked at. If they have one root at
 * most, and one was reported, it is that. */
static bool halve(Search *k, Part *n, bool along_s)
{
    k->trace->counters.fallbacks += !k->was_halved;
    k->was_halved = true;
    Part other = *n;
    other.view = view_copy(k->trace->scratch, &n->view);
    restrict_part(n, along_s, (Range){ 0, 0.5 });
    restrict_part(&other, along_s, (Range){ 0.5, 1 });
    bool other_first = depth_of(k, &other).lo < depth_of(k, n).lo, is_certified = n->is_certified;
    int reported = k->reported;
    if (settle(k, other_first ? &other : n)) return true;
    if (is_certified && k->reported > reported) return false;
    return settle(k, other_first ? n : &other);
}

/* Across the longer side of the image. */
static bool halve_image(Search *k, Part *n)
{
    Lengths image = view_image(&n->view);
    return halve(k, n, image.by_s >= image.by_t);
}

/* At the middle; of a tile that is a curve there, the one side that it has. */
static double shorter_side(const Tile *f)
{
    double a = 2.0 * f->length_s, b = 2.0 * f->length_t;
    return a > 0 && b > 0 ? double_min(a, b) : double_max(a, b);
}

/* Is a box on the ray to be cut further, to find where the ray enters the surface? */
static bool runs_in_surface(Search *k, Part *n, double length)
{
    if (k->declined >= MAX_DECLINED) return length > PART_OF_DECLINED * k->tile->radius;
    double tangent = double_max(IN_THE_SURFACE * shorter_side(k->tile), touching_length(k, false));
    n->is_in_surface = n->is_in_surface || length > tangent;
    return n->is_in_surface && length > ENTRY * k->rounding;
}

/* A box whose nearest point is `at`, and that is a small one or one with one root at most. */
static bool settle_near_ray(Search *k, Part *n, double error, const ViewPoint *at)
{
    if (is_on_ray(at, error)) return report(k, n, at);
    return k->patience >= 0 && !view_is_off(&n->view, at->x.value, at->y.value, error) && halve_image(k, n);
}

/* A box that cannot be told from the ray, or a needle through it. */
static bool settle_on_ray(Search *k, Part *n, double error, const ViewPoint *at)
{
    DepthOnRay depth = on_ray(k, n);
    if (k->patience < 0 || !is_on_ray(at, error) || !runs_in_surface(k, n, depth.range.hi - depth.range.lo))
        return settle_near_ray(k, n, error, at);
    Lengths depths = view_depths(&n->view, depth.slant);
    return halve(k, n, depths.by_s >= depths.by_t);
}

/* Finds all roots in a box; n is used up. Returns whether a visit ended the search. */
static bool settle_in_scratch(Search *k, Part *n)
{
    for (;;) {
        ViewExtent e = view_extent(&n->view);
        double over_w = k->rounding + n->view.lost, error = over_w * e.w_max, near = ON_THE_RAY * over_w;
        if (e.x.lo > error || e.x.hi < -error || e.y.lo > error || e.y.hi < -error) return false;
        Range depth = depth_of(k, n);
        double slack = k->rounding + n->view.drift * k->p->radius;
        if (k->middle + depth.lo - slack > k->ray->t_max || k->middle + depth.hi + slack < k->ray->t_min) return false;
        k->patience--;
        ViewPoint at;
        if (n->has_pole && pole_has_all(&n->view, n->pole, over_w)) return report_pole(k, n);
        if (n->view.size <= near)
            return at = nearest_point(k, n), settle_on_ray(k, n, over_w, &at);
        if (k->patience < 0) return at = nearest_point(k, n), is_on_ray(&at, over_w) && report(k, n, &at);

        double across;
        ViewPart c = view_narrow(&n->view, error, k->trace->scratch, &n->is_certified, &across);
        if (c.s.lo > c.s.hi || c.t.lo > c.t.hi) return false;
        n->is_needle = across < INFINITY;
        if (n->is_certified && find_root(n, &at)) return report_root(k, n, &at);
        bool is_worth_it = c.s.hi - c.s.lo <= MIN_CLIP || c.t.hi - c.t.lo <= MIN_CLIP;
        if (!is_worth_it && across <= near * e.w_max && (at = nearest_point(k, n), is_on_ray(&at, over_w)))
            return settle_on_ray(k, n, over_w, &at);
        restrict_part(n, true, c.s);
        restrict_part(n, false, c.t);
        if (is_worth_it) continue;
        if (!n->is_certified) return halve_image(k, n);
        /* At most one root, and clipping converges quadratically to it: what stops it is the rounding, unless that is much
         * enlarged by the inverse of a needle: then the root is anywhere in a strip. */
        if (!n->has_strip) n->strip = range_on_ray(k, n), n->has_strip = true;
        return at = nearest_point(k, n), settle_near_ray(k, n, over_w, &at);
    }
}

static bool settle(Search *k, Part *n)
{
    ArenaMark mark = arena_mark(k->trace->scratch);
    if (++k->depth > MAX_DEPTH) k->patience = 0;
    bool ended = settle_in_scratch(k, n);
    k->depth--;
    arena_reset(k->trace->scratch, mark);
    return ended;
}

/* The whole tile; of one with a pole on the ray mostly that alone. */
static bool settle_tile(Search *k)
{
    Part all = { .has_pole = pole_is_met(k->tile, k->ray, &all.pole) };
    if (all.has_pole) {
        all.view = view_of_tile_in_haste(k->trace->scratch, k->tile, k->ray);
        if (pole_has_all(&all.view, all.pole, k->rounding + all.view.lost)) return report_pole(k, &all);
    }
    all.view = view_of_tile(k->trace->scratch, k->tile, k->ray);
    return settle_in_scratch(k, &all);
}

bool clip_roots(const Tile *tile, PatchRay *ray, RootVisit visit, void *context, Trace *trace)
{
    const Patch *p = tile->patch;
    Vec3 o = vec_sub(ray->origin, p->origin);
    Search k = { .tile = tile, .p = p, .ray = ray, .visit = visit, .context = context, .trace = trace,
                 .rounding = patch_rounding(p, o), .middle = -vec_dot(ray->d, o), .patience = PATIENCE };
    ArenaMark mark = arena_mark(trace->scratch);
    bool ended = settle_tile(&k);
    arena_reset(trace->scratch, mark);
    return ended;
}
