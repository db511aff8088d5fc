/* Preparation: cuts -> Bézier patches of the spans -> cells -> boxes -> tree. See prepare.h.
 *
 * The paper inserts the new knots, closes all knots, and bounds each cell of the refined mesh. The refined mesh of a span
 * depends on the k_u x k_v control points of the span alone, so it is made for one span at a time: close the span (its
 * Bézier patch), then cut that at the new knots, in v and then in u. */
#include "nurbs/prepare.h"

#include "nurbs/bezier.h"
#include "nurbs/flatten.h"
#include "nurbs/knots.h"

#include <string.h>

typedef struct {
    const Surface *s;
    Cuts cuts_u, cuts_v;
    const Piece *pieces_u, *pieces_v;
    double slack;                     /* boxes are widened by this: the rounding of the cells' control points */
    Arena *scratch;
    Leaf *leaves;
    Box *boxes;
    size_t n_leaves, n_boxes, leaves_capacity, boxes_capacity;
    double bend;                      /* of the patch in work, for steps as long as the span */
    uint32_t n_cut, n_untested;
} Preparation;

/* Where a cell lies: the span and cut interval of one direction, and the smooth stretch round it. */
typedef struct { int mu, cut; const Piece *piece; } Slot;

static double share_of_span(const double *tau, const double *cuts, Slot at)
{
    return (cuts[at.cut + 1] - cuts[at.cut]) / (tau[at.mu + 1] - tau[at.mu]);
}

static const Piece *make_pieces(Arena *a, Arena *scratch, int k, int n, const double *tau)
{
    ArenaMark mark = arena_mark(scratch);
    double *at = ARENA_ARRAY(scratch, double, n - k + 2);
    int n_breaks = knots_breaks(k, n, tau, at);
    Piece *pieces = ARENA_ARRAY(a, Piece, n_breaks - 1);
    for (int i = 0; i + 1 < n_breaks; i++) pieces[i] = (Piece){ at[i], at[i + 1] };
    arena_reset(scratch, mark);
    return pieces;
}

/* Rounding of a cell's control points, of the farthest one, u = 2^-53: up to as many cuts as there are, with 9 u for each of k
 * - 1 combinations (3 of its own, and 3 of its share, three roundings that move it by b - a, which is twice as long at most);
 * and closing, twice that (bezier.h). With weights as much again. An evaluated point has (6 (k_u + k_v) - 8) u, and also
 * twice that (surface.c): a cut is less than one and a half of it. The knots' own magnitude does not count: differences of
 * knots are rounded relative to themselves. */
#define CUT_ROUNDING 1.5
static double box_slack(const Surface *s, const Cuts *u, const Cuts *v)
{
    return CUT_ROUNDING * s->rounding * (u->n + v->n + 2);
}

/* In units of half a leaf, as far as it is from the middle: second derivatives are a quarter of those over the leaf. */
static void bound_deviation(Leaf *leaf, BezierSeconds s, double slack)
{
    leaf->turn_u = (s.ss + s.st) / 4, leaf->turn_v = (s.st + s.tt) / 4;
    leaf->bulge = (leaf->turn_u + leaf->turn_v) / 2 + slack;          /* Taylor: (|S_ss| + 2 |S_st| + |S_tt|) / 2 */
}

static void add_leaf(Preparation *p, Slot u, Slot v, const Vec4 *cell)
{
    const Surface *s = p->s;
    Leaf leaf = { .u0 = p->cuts_u.at[u.cut], .u1 = p->cuts_u.at[u.cut + 1], .piece_u = u.piece, .mu_u = u.mu,
                  .v0 = p->cuts_v.at[v.cut], .v1 = p->cuts_v.at[v.cut + 1], .piece_v = v.piece, .mu_v = v.mu };
    TrimRect rect = { leaf.u0, leaf.u1, leaf.v0, leaf.v1 };
    TrimClass class = s->trims ? trim_class(s->trims, rect) : TRIM_KEPT;
    if (class == TRIM_CUT) {
        p->n_cut++;
        return;
    }
    leaf.needs_trim_test = class == TRIM_MIXED;
    p->n_untested += s->trims && !leaf.needs_trim_test;
    Box box = bezier_hull(s->k_u * s->k_v, cell);
    leaf.size = box_diagonal(box);
    double part = fmax(share_of_span(s->tau_u, p->cuts_u.at, u), share_of_span(s->tau_v, p->cuts_v.at, v));
    leaf.bend = p->bend * part * part;
    bound_deviation(&leaf, bezier_seconds(s->k_u, s->k_v, cell), p->slack);
    refine_evaluate(s, u.mu, leaf.u0 + (leaf.u1 - leaf.u0) / 2, v.mu, leaf.v0 + (leaf.v1 - leaf.v0) / 2, &leaf.middle);
    ARENA_PUSH(p->scratch, p->leaves, p->n_leaves, p->leaves_capacity) = leaf;
    ARENA_PUSH(p->scratch, p->boxes, p->n_boxes, p->boxes_capacity) = box_expand(box, p->slack);
}

/* The share of what is left of a span that the cell after cut i takes: 1 for its last cell. */
static double share(const double *cuts, int i, double end) { return (cuts[i + 1] - cuts[i]) / (end - cuts[i]); }

/* Cuts the first cell off `rest`; the last one is `rest` itself. */
static void take_cell(int k, int width, double s, Vec4 *rest, Vec4 *cell)
{
    if (s < 1) bezier_cut(k, width, s, rest, cell);
    else memcpy(cell, rest, (size_t)(k * width) * sizeof *cell);
}

/* A strip is a patch as narrow as its cells in v; its cells along u. */
static void cut_strip(Preparation *p, Slot u, Slot v, Vec4 *strip)
{
    const Surface *s = p->s;
    const double *at = p->cuts_u.at, end = s->tau_u[u.mu + 1];
    Vec4 cell[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    for (; at[u.cut] < end; u.cut++) {
        for (int i = 0; i < s->k_v; i++)
            take_cell(s->k_u, 1, share(at, u.cut, end), strip + i * s->k_u, cell + i * s->k_u);
        add_leaf(p, u, v, cell);
    }
}

static void cut_patch(Preparation *p, Slot u, Slot v, Vec4 *patch)
{
    const double *at = p->cuts_v.at, end = p->s->tau_v[v.mu + 1];
    Vec4 strip[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    for (; at[v.cut] < end; v.cut++) {
        take_cell(p->s->k_v, p->s->k_u, share(at, v.cut, end), patch, strip);
        cut_strip(p, u, v, strip);
    }
}

void prepare_close_span(const Surface *s, int mu_u, int mu_v, Vec4 *patch)
{
    for (int i = 0; i < s->k_v; i++) {
        const Vec4 *row = s->p + (size_t)(mu_v - s->k_v + 1 + i) * (size_t)s->n_u + (mu_u - s->k_u + 1);
        memcpy(patch + i * s->k_u, row, (size_t)s->k_u * sizeof *row);
        bezier_from_span(s->k_u, s->tau_u, mu_u, 1, patch + i * s->k_u);
    }
    bezier_from_span(s->k_v, s->tau_v, mu_v, s->k_u, patch);
}

/* From the span just done to the next one that is not empty; its first cut, and its smooth stretch. */
static bool next_slot(Slot *slot, int n, const double *tau, const Cuts *cuts)
{
    do slot->mu++; while (slot->mu < n && !knots_is_span(tau, slot->mu));
    if (slot->mu >= n) return false;
    while (cuts->at[slot->cut] < tau[slot->mu]) slot->cut++;
    if (tau[slot->mu] >= slot->piece->hi) slot->piece++;
    return true;
}

static void cut_surface(Preparation *p)
{
    const Surface *s = p->s;
    Vec4 patch[NURBS_MAX_ORDER * NURBS_MAX_ORDER];
    Slot v = { s->k_v - 2, 0, p->pieces_v };
    while (next_slot(&v, s->n_v, s->tau_v, &p->cuts_v)) {
        Slot u = { s->k_u - 2, 0, p->pieces_u };
        while (next_slot(&u, s->n_u, s->tau_u, &p->cuts_u)) {
            prepare_close_span(s, u.mu, v.mu, patch);
            p->bend = bezier_bend(s->k_u, s->k_v, patch);
            cut_patch(p, u, v, patch);
        }
    }
}

void prepare_leaves(Arena *a, Arena *scratch, const Surface *s, const NurbsOptions *o, LeafTree *out)
{
    ArenaMark mark = arena_mark(scratch);
    Arena *cuts = arena_new();     /* lists that grow while scratch has marks of its own */
    Preparation p = { .s = s, .scratch = scratch };
    p.cuts_u = flatten_cuts(s, o, FLATTEN_U, cuts, scratch);
    p.cuts_v = flatten_cuts(s, o, FLATTEN_V, cuts, scratch);
    p.pieces_u = make_pieces(a, scratch, s->k_u, s->n_u, s->tau_u);
    p.pieces_v = make_pieces(a, scratch, s->k_v, s->n_v, s->tau_v);
    p.slack = box_slack(s, &p.cuts_u, &p.cuts_v);
    cut_surface(&p);
    *out = (LeafTree){ .leaves = arena_copy(a, p.leaves, p.n_leaves, sizeof *p.leaves), .n_leaves = (uint32_t)p.n_leaves,
                       .bvh = bvh_build(a, p.boxes, (uint32_t)p.n_leaves, BVH_MEDIAN),
                       .n_cut = p.n_cut, .n_untested = p.n_untested };
    arena_free(cuts);
    arena_reset(scratch, mark);
}
