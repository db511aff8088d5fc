/* intersection and merge; a difference is the intersection of its first part with the inverses of the others.
 *
 * All hits of all parts, in order of t. One that stands alone is on the surface of the whole if it is inside all other parts
 * (of a merge: inside none of them); that is asked a little behind it, off the edges of parts that the ray may only touch
 * there. Hits of several parts at one place (faces that coincide, a ray through an
 * edge) would be lost or doubled by that rule, as rounding has it: there the question is whether the whole changes between
 * inside and outside from before the place to behind it. If so, it has one hit, that of the last part (POV-Ray's choice at
 * equal depth); if not, none, but for surfaces that have no inside, which are kept where the parts they touch let them.
 * "Before" and "behind" are half way to the neighbouring hits of the parts concerned, and so as far from all of their
 * surfaces as can be.
 *
 * One place: t_error bounds the distance from the surface, and so the error of t times the cosine of the angle between ray
 * and normal; hits count as together up to SLOPE times their errors, which covers all cosines over 1/SLOPE. What lies that
 * near to the ray's beginning is what the ray has just left. */
#include "render/hit_list.h"
#include "render/object.h"
#include "render/shapes.h"

#include <stdlib.h>

typedef struct {
    Shape shape;
    Shape *const *parts;
    const Box *boxes;          /* of the parts */
    uint32_t n;
    Box bounds, inside_bounds;
    bool is_merge;
} Csg;

static const double SLOPE = 64;

static Box csg_bounds(const Shape *shape) { return ((const Csg *)shape)->bounds; }
static Box csg_inside_bounds(const Shape *shape) { return ((const Csg *)shape)->inside_bounds; }

/* ---- one ray ---- */

typedef struct { double t; uint32_t part, hit; } Candidate;

typedef struct {
    const Csg *csg;
    const Ray *ray;
    HitList hits;              /* of all parts, part by part */
    Candidate *candidates;     /* the same, in order of t, then of the parts */
} Walk;

static int by_place(const void *a, const void *b)
{
    const Candidate *x = a, *y = b;
    if (x->t != y->t) return x->t < y->t ? -1 : 1;
    return x->part != y->part ? (x->part < y->part ? -1 : 1) : (x->hit > y->hit) - (x->hit < y->hit);
}

/* The parts' lists one behind the other; end[i] is where that of part i ends. */
static void ask_parts(Walk *w, size_t *end, Trace *t)
{
    const Csg *c = w->csg;
    BoxRay box = box_ray(w->ray->origin, w->ray->dir);
    uint32_t first_index = 0;
    for (uint32_t i = 0; i < c->n; i++) {
        size_t first = w->hits.n;
        double t_enter;
        if (box_hit(&c->boxes[i], &box, w->ray->t_min, w->hits.t_max, &t_enter))
            shape_all_hits(c->parts[i], w->ray, &w->hits, t);
        for (size_t k = first; k < w->hits.n; k++) w->hits.hits[k].index += first_index;
        first_index += c->parts[i]->n_primitives;
        end[i] = w->hits.n;
    }
}

static void gather(Walk *w, Trace *t)
{
    size_t *end = ARENA_ARRAY(t->scratch, size_t, w->csg->n);
    ask_parts(w, end, t);
    w->candidates = ARENA_ARRAY(t->scratch, Candidate, w->hits.n);
    for (uint32_t i = 0, k = 0; i < w->csg->n; i++)
        for (; k < end[i]; k++) w->candidates[k] = (Candidate){ w->hits.hits[k].t, i, k };
    if (w->hits.n > 1) qsort(w->candidates, w->hits.n, sizeof *w->candidates, by_place);
}

static double reach_of(const Walk *w, size_t i) { return SLOPE * w->hits.hits[w->candidates[i].hit].t_error; }

/* Past the candidates that are at one place with the first. */
static size_t end_of_place(const Walk *w, size_t first)
{
    const Candidate *c = w->candidates;
    size_t end = first + 1;
    while (end < w->hits.n && c[end].t - c[end - 1].t <= reach_of(w, end - 1) + reach_of(w, end)) end++;
    return end;
}

/* ---- one place ---- */

/* A part that has hits there. */
typedef struct { uint32_t part, hit; int n_hits; bool was_inside, is_inside; } Tied;
typedef struct { Tied *parts; size_t n; } Place;

static Tied *find_tied(const Place *p, uint32_t part)
{
    for (size_t i = 0; i < p->n; i++)
        if (p->parts[i].part == part) return &p->parts[i];
    return NULL;
}

static Place tie(const Walk *w, size_t first, size_t end)
{
    Place p = { ARENA_ARRAY(w->hits.arena, Tied, end - first), 0 };
    for (size_t i = first; i < end; i++) {
        const Candidate *c = &w->candidates[i];
        Tied *known = find_tied(&p, c->part);
        if (known) known->n_hits++;
        else p.parts[p.n++] = (Tied){ .part = c->part, .hit = c->hit, .n_hits = 1 };
    }
    return p;
}

/* Do all parts without a hit at this place let the point be on the surface of the whole? */
static bool others_allow(const Walk *w, const Place *p, Vec3 point)
{
    const Csg *c = w->csg;
    for (uint32_t i = 0; i < c->n; i++)
        if (!find_tied(p, i) && shape_inside(c->parts[i], point) == c->is_merge) return false;
    return true;
}

static void find_states(const Walk *w, const Place *p, size_t first, size_t end)
{
    double before = w->ray->t_min, behind = w->hits.t_max, here = w->candidates[first].t, last = w->candidates[end - 1].t;
    for (size_t i = 0; i < first; i++)
        if (find_tied(p, w->candidates[i].part)) before = w->candidates[i].t;
    for (size_t i = w->hits.n; i > end; i--)
        if (find_tied(p, w->candidates[i - 1].part)) behind = w->candidates[i - 1].t;
    if (isinf(behind)) behind = last + 2 * (last - w->ray->t_min);
    Vec3 in_front = ray_at(w->ray, .5 * (before + here)), in_back = ray_at(w->ray, .5 * (last + behind));
    for (size_t i = 0; i < p->n; i++) {
        const Shape *part = w->csg->parts[p->parts[i].part];
        p->parts[i].was_inside = shape_inside(part, in_front);
        p->parts[i].is_inside = shape_inside(part, in_back);
    }
}

/* The last part that has changed, if with it the whole has; else NULL. */
static const Tied *changing(const Csg *c, const Place *p)
{
    bool was_any = false, is_any = false, was_all = true, is_all = true;
    const Tied *last = NULL;
    for (size_t i = 0; i < p->n; i++) {
        const Tied *q = &p->parts[i];
        was_any |= q->was_inside, is_any |= q->is_inside;
        was_all &= q->was_inside, is_all &= q->is_inside;
        if (q->was_inside != q->is_inside && (!last || q->part > last->part)) last = q;
    }
    return (c->is_merge ? was_any != is_any : was_all != is_all) ? last : NULL;
}

/* A surface that nothing changes at, touched by others: an intersection keeps it if it is inside them on one side at
 * least. */
static bool sheet_is_kept(const Csg *c, const Place *p, const Tied *sheet)
{
    if (sheet->n_hits != 1 || sheet->was_inside != sheet->is_inside) return false;
    for (size_t i = 0; i < p->n; i++) {
        const Tied *q = &p->parts[i];
        if (q != sheet && q->was_inside == c->is_merge && q->is_inside == c->is_merge) return false;
    }
    return true;
}

static const Tied *kept_at(const Walk *w, size_t first, size_t end)
{
    Place p = tie(w, first, end);
    double behind = w->candidates[end - 1].t + .5 * reach_of(w, end - 1);
    if (!others_allow(w, &p, ray_at(w->ray, behind))) return NULL;
    if (p.n == 1 && end == first + 1) return &p.parts[0];
    find_states(w, &p, first, end);
    const Tied *kept = changing(w->csg, &p);
    for (size_t i = p.n; i > 0 && !kept; i--)
        if (sheet_is_kept(w->csg, &p, &p.parts[i - 1])) kept = &p.parts[i - 1];
    return kept;
}

/* Appends the hits of the whole, at most `most` of them. */
static void csg_walk(const Csg *c, const Ray *r, HitList *out, size_t most, Trace *t)
{
    Walk w = { .csg = c, .ray = r, .hits = hit_list_make(t->scratch, out->t_max) };
    gather(&w, t);
    for (size_t first = 0, end; first < w.hits.n && most > 0; first = end) {
        end = end_of_place(&w, first);
        if (w.candidates[first].t - r->t_min <= reach_of(&w, first)) continue;
        const Tied *kept = kept_at(&w, first, end);
        if (!kept) continue;
        *hit_list_add(out) = w.hits.hits[kept->hit];
        most--;
    }
}

static bool csg_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    ArenaMark mark = arena_mark(t->scratch);
    HitList found = hit_list_make(t->scratch, best->t);
    csg_walk((const Csg *)shape, r, &found, 1, t);
    if (found.n > 0) *best = found.hits[0];
    arena_reset(t->scratch, mark);
    return found.n > 0;
}

static void csg_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    csg_walk((const Csg *)shape, r, out, SIZE_MAX, t);
}

static bool csg_inside(const Shape *shape, Vec3 p)
{
    const Csg *c = (const Csg *)shape;
    for (uint32_t i = 0; i < c->n; i++)
        if (shape_inside(c->parts[i], p) == c->is_merge) return c->is_merge;
    return !c->is_merge && c->n > 0;
}

/* ---- the table ---- */

static uint32_t csg_parts(const Shape *shape, Shape *const **list)
{
    *list = ((const Csg *)shape)->parts;
    return ((const Csg *)shape)->n;
}

static Shape *csg_with_parts(const Shape *shape, Arena *a, Shape *const parts[], bool is_inverse, const Xform *moved)
{
    const Csg *c = (const Csg *)shape;
    (void)moved;
    return c->is_merge != is_inverse ? merge_new(a, parts, c->n) : intersection_new(a, parts, c->n);
}

static const ShapeType intersection_type = {
    .name = "intersection", .bounds = csg_bounds, .hit = csg_hit, .all_hits = csg_all_hits, .inside = csg_inside,
    .inside_bounds = csg_inside_bounds, .parts = csg_parts, .with_parts = csg_with_parts,
};
static const ShapeType merge_type = {
    .name = "merge", .bounds = csg_bounds, .hit = csg_hit, .all_hits = csg_all_hits, .inside = csg_inside,
    .inside_bounds = csg_inside_bounds, .parts = csg_parts, .with_parts = csg_with_parts,
};

/* A hit of an intersection lies, for each part, on its surface or inside it. */
static void find_bounds(Csg *c)
{
    c->bounds = c->inside_bounds = c->is_merge || c->n == 0 ? box_empty() : box_infinite();
    for (uint32_t i = 0; i < c->n; i++) {
        Box on = c->boxes[i], in = shape_inside_bounds(c->parts[i]);
        if (c->is_merge) {
            c->bounds = box_union(c->bounds, on);
            c->inside_bounds = box_union(c->inside_bounds, in);
        } else {
            c->bounds = box_intersection(c->bounds, box_union(on, in));
            c->inside_bounds = box_intersection(c->inside_bounds, in);
        }
    }
}

static Shape *csg_new(Arena *a, const ShapeType *type, Shape *const parts[], uint32_t n)
{
    Csg *c = ARENA_NEW(a, Csg);
    Box *boxes = ARENA_ARRAY(a, Box, n);
    shape_init(&c->shape, type);
    c->parts = arena_copy(a, parts, n, sizeof *parts);
    c->boxes = boxes;
    c->n = n;
    c->is_merge = type == &merge_type;
    c->shape.n_primitives = 0;
    for (uint32_t i = 0; i < n; i++) {
        boxes[i] = shape_bounds(parts[i]);
        c->shape.n_primitives += parts[i]->n_primitives;
        if (parts[i]->depth > c->shape.depth) c->shape.depth = parts[i]->depth;
    }
    find_bounds(c);
    return &c->shape;
}

Shape *intersection_new(Arena *a, Shape *const parts[], uint32_t n) { return csg_new(a, &intersection_type, parts, n); }
Shape *merge_new(Arena *a, Shape *const parts[], uint32_t n) { return csg_new(a, &merge_type, parts, n); }

Shape *difference_new(Arena *a, Shape *const parts[], uint32_t n)
{
    Shape **signed_parts = ARENA_ARRAY(a, Shape *, n);
    for (uint32_t i = 0; i < n; i++) signed_parts[i] = i == 0 ? parts[i] : shape_inverse(a, parts[i]);
    return intersection_new(a, signed_parts, n);
}
