/* From loops to the hierarchy of trims: [MCFS00] section 3.1.
 *
 * The paper inserts trims one by one; the same tree is had by giving each trim the smallest of those that contain it as
 * parent, and that does not depend on the order. As in the paper containment is judged by points of the one that are
 * clear of the other, so shared vertices and edges do no harm; the pairs to judge are those whose boxes meet. */
#include "nurbs/trim_tree.h"

#include "nurbs/trim_cross.h"
#include "nurbs/trim_flat.h"
#include "nurbs/trim_loop.h"
#include "nurbs/trim_pairs.h"
#include "nurbs/trim_test.h"

#include <stdlib.h>

typedef struct {
    TrimNode *node;
    TrimRect box;
    double area;             /* signed */
    int parent;              /* in Builder.trims; -1: none */
    TrimChain *flat;         /* of straight pieces; NULL: not asked for yet */
} Trim;

typedef struct {
    Arena *arena, *scratch;
    const TrimInput *in;
    NurbsError *error;
    NurbsWarning *warnings;
    int max_warnings, n_warnings;
    Trim *trims;             /* neighbours are neighbours in the plane */
    int n;
    TrimBoxes boxes;
} Builder;

/* ---- messages ---- */

static void warn(Builder *b, NurbsWarningCode code, int trim, int other, TrimFault f)
{
    Vec2 at = trim_from_unit(&b->in->domain, f.at);
    if (b->n_warnings < b->max_warnings) {
        b->warnings[b->n_warnings] = (NurbsWarning){ code, trim, other, at.x, at.y, f.value };
    }
    b->n_warnings++;
}

static bool refuse(Builder *b, NurbsCode code, int trim, int other, Vec2 at, double value)
{
    at = trim_from_unit(&b->in->domain, at);
    *b->error = (NurbsError){ .code = code, .where = NURBS_IN_TRIM, .trim = trim, .curve = -1, .index = trim, .other = other,
                              .u = at.x, .v = at.y, .value = value };
    return false;
}

/* What is to be said of a crossing of two trims, in order of their numbers, or of one with itself. */
static bool judge(Builder *b, int trim, int other, TrimCrossing c)
{
    int first = trim < other ? trim : other, second = trim < other ? other : trim;
    if (c.depth > TRIM_CROSSING) return refuse(b, NURBS_TRIMS_CROSS, first, second, c.at, c.depth);
    if (c.depth > TRIM_CROSSING_SILENT) {
        warn(b, NURBS_WARN_TRIM_CROSSING, first, second, (TrimFault){ c.depth, c.at });
    }
    return true;
}

/* ---- the trims one by one ---- */

static bool keeps_what_it_encloses(const Builder *b, double area) { return (area < 0) != b->in->keep_left; }

/* What neither is a region nor a hole; or keeps what it encloses and encloses all: what lies in it decides without it. */
static bool says_nothing(const Builder *b, const TrimLoop *l)
{
    return l->path.n == 0 || l->is_thin || (keeps_what_it_encloses(b, l->area) && trim_loop_is_border(l));
}

/* Crossings are looked for with polylines, where it is not plain that there are none. */
static TrimCrossing self_crossing(Builder *b, const TrimChain *c, bool is_ccw)
{
    if (!c->path.arc) return trim_self_crossing(b->scratch, c, is_ccw);
    if (trim_chains_are_apart(c, c, TRIM_CROSSING_SILENT / 4)) return (TrimCrossing){ 0 };
    TrimChain flat = trim_chain_flatten(b->scratch, c, TRIM_CHORD);
    return trim_self_crossing(b->scratch, &flat, is_ccw);
}

static bool add_trim(Builder *b, const TrimLoop *l)
{
    TrimNode *node = ARENA_NEW(b->arena, TrimNode);
    node->chain = trim_chain_make(b->arena, &l->path);
    node->index = l->index;
    node->is_region = keeps_what_it_encloses(b, l->area);
    b->trims[b->n++] = (Trim){ node, trim_chain_box(&node->chain), l->area, -1, NULL };
    return judge(b, l->index, l->index, self_crossing(b, &node->chain, l->area > 0));
}

/* A loop that goes round nothing says nothing, but for one whose parts cancel: whichever direction is taken for its own,
 * some are wrong. */
static bool check_thin(Builder *b, const TrimLoop *l)
{
    TrimChain chain = trim_chain_make(b->scratch, &l->path);
    TrimCrossing as_ccw = self_crossing(b, &chain, true), as_cw = self_crossing(b, &chain, false);
    TrimCrossing lesser = as_ccw.depth < as_cw.depth ? as_ccw : as_cw;
    return lesser.depth <= TRIM_CROSSING || judge(b, l->index, l->index, lesser);
}

static bool read_trim(Builder *b, int index)
{
    ArenaMark mark = arena_mark(b->scratch);
    TrimLoop l;
    if (!trim_loop_read(b->scratch, b->in, index, &l, b->error)) return false;
    if (l.bridged.value > 0) warn(b, NURBS_WARN_TRIM_BRIDGED, index, -1, l.bridged);
    if (l.clamped.value > 0) warn(b, NURBS_WARN_TRIM_CLAMPED, index, -1, l.clamped);
    bool is_good = says_nothing(b, &l) ? !l.is_thin || check_thin(b, &l) : add_trim(b, &l);
    arena_reset(b->scratch, mark);
    return is_good;
}

static bool read_trims(Builder *b)
{
    b->trims = ARENA_ARRAY(b->scratch, Trim, b->in->n_loops);
    for (int i = 0; i < b->in->n_loops; i++) {
        if (!read_trim(b, i)) return false;
    }
    return true;
}

/* ---- their order in the plane ---- */

static int by_u(const void *a, const void *b)
{
    const Trim *s = a, *t = b;
    double d = (s->box.u0 + s->box.u1) - (t->box.u0 + t->box.u1);
    return d != 0 ? (d > 0) - (d < 0) : s->node->index - t->node->index;
}

static int by_v(const void *a, const void *b)
{
    const Trim *s = a, *t = b;
    double d = (s->box.v0 + s->box.v1) - (t->box.v0 + t->box.v1);
    return d != 0 ? (d > 0) - (d < 0) : s->node->index - t->node->index;
}

/* Halves by turns along u and v. */
static void sort_in_plane(Trim *t, int n, bool along_u)
{
    if (n <= 2) return;
    qsort(t, (size_t)n, sizeof *t, along_u ? by_u : by_v);
    sort_in_plane(t, n / 2, !along_u);
    sort_in_plane(t + n / 2, n - n / 2, !along_u);
}

static TrimBoxes boxes_of(Arena *a, const Trim *t, const int *which, int n)
{
    TrimRect *box = ARENA_ARRAY(a, TrimRect, n);
    for (int i = 0; i < n; i++) box[i] = t[which ? which[i] : i].box;
    return trim_boxes_make(a, box, n);
}

/* ---- containment ---- */

static const TrimChain *flat_of(Builder *b, Trim *t)
{
    if (!t->node->chain.path.arc) return &t->node->chain;
    if (!t->flat) {
        t->flat = ARENA_NEW(b->scratch, TrimChain);
        *t->flat = trim_chain_flatten(b->scratch, &t->node->chain, TRIM_CHORD);
    }
    return t->flat;
}

static TrimRelation relation_of(Builder *b, Trim *small, Trim *large)
{
    const TrimChain *s = &small->node->chain, *l = &large->node->chain;
    if (!trim_chains_are_apart(s, l, 0)) return trim_relation(flat_of(b, small), flat_of(b, large));
    return (TrimRelation){ .is_inside = trim_chain_winding(l, trim_vertex(&s->path, 0)) != 0 };
}

/* i has the lesser area. */
static bool relate(Builder *b, int i, int j)
{
    Trim *small = &b->trims[i], *large = &b->trims[j];
    TrimRelation r = relation_of(b, small, large);
    if (!judge(b, small->node->index, large->node->index, r.crossing)) return false;
    if (r.is_inside && (small->parent < 0 || fabs(large->area) < fabs(b->trims[small->parent].area))) small->parent = j;
    return true;
}

static bool find_parents(Builder *b)
{
    for (int i = 0; i < b->n; i++) {
        TrimRect box = b->trims[i].box;
        for (int j = trim_boxes_next(&b->boxes, box, i + 1); j >= 0; j = trim_boxes_next(&b->boxes, box, j + 1)) {
            bool is_less = fabs(b->trims[i].area) < fabs(b->trims[j].area);
            if (!relate(b, is_less ? i : j, is_less ? j : i)) return false;
        }
    }
    return true;
}

/* ---- the tree ---- */

/* Two trims of one list must agree. */
static bool check_directions(Builder *b, const TrimList *l)
{
    for (int i = 1; i < l->n; i++) {
        const TrimNode *s = l->trims[0], *t = l->trims[i];
        if (s->is_region == t->is_region) continue;
        return refuse(b, NURBS_TRIMS_CONFLICT, s->index < t->index ? s->index : t->index,
                      s->index < t->index ? t->index : s->index, t->chain.path.p[0], 0);
    }
    return true;
}

/* Fills a list with the trims `which`; what an empty one keeps is set already. */
static bool fill_list(Builder *b, TrimList *l, const int *which, int n)
{
    l->n = n;
    l->trims = ARENA_ARRAY(b->arena, TrimNode *, n);
    for (int i = 0; i < n; i++) l->trims[i] = b->trims[which[i]].node;
    l->boxes = boxes_of(b->arena, b->trims, which, n);
    if (n > 0) l->keeps_outside = !l->trims[0]->is_region;
    return check_directions(b, l);
}

/* The trims sorted by parent, in order of the plane within one: those of parent p (-1 first) are order[first[p+1]] and
 * on. */
static void sort_by_parent(const Builder *b, int *order, int *first)
{
    for (int p = 0; p <= b->n + 1; p++) first[p] = 0;
    for (int i = 0; i < b->n; i++) first[b->trims[i].parent + 2]++;
    for (int p = 1; p <= b->n + 1; p++) first[p] += first[p - 1];
    for (int i = 0; i < b->n; i++) order[first[b->trims[i].parent + 1]++] = i;
    for (int p = b->n + 1; p > 0; p--) first[p] = first[p - 1];
    first[0] = 0;
}

static bool fill_lists(Builder *b, TrimList *top)
{
    int *order = ARENA_ARRAY(b->scratch, int, b->n), *first = ARENA_ARRAY(b->scratch, int, b->n + 2);
    sort_by_parent(b, order, first);
    for (int p = -1; p < b->n; p++) {
        TrimList *l = p < 0 ? top : &b->trims[p].node->inner;
        l->keeps_outside = p < 0 || b->trims[p].node->is_region;
        if (!fill_list(b, l, order + first[p + 1], first[p + 2] - first[p + 1])) return false;
    }
    return true;
}

static TrimTree *build(Builder *b)
{
    if (!read_trims(b) || b->n == 0) return NULL;
    sort_in_plane(b->trims, b->n, true);
    b->boxes = boxes_of(b->scratch, b->trims, NULL, b->n);
    TrimTree *t = ARENA_NEW(b->arena, TrimTree);
    t->domain = b->in->domain, t->keep_left = b->in->keep_left, t->n_loops = b->n;
    for (int i = 0; i < b->n; i++) t->n_pieces += b->trims[i].node->chain.path.n;
    return find_parents(b) && fill_lists(b, &t->top) ? t : NULL;
}

TrimTree *trim_tree_new(Arena *a, const TrimInput *in, NurbsError *error,
                        NurbsWarning *warnings, int max_warnings, int *n_warnings)
{
    *error = (NurbsError){ .code = NURBS_OK, .where = NURBS_IN_TRIM, .trim = -1, .curve = -1 };
    Builder b = { .arena = a, .scratch = arena_new(), .in = in, .error = error,
                  .warnings = warnings, .max_warnings = max_warnings };
    TrimTree *t = build(&b);
    if (n_warnings) *n_warnings = b.n_warnings;
    arena_free(b.scratch);
    return t;
}
