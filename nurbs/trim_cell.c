/* Cells. See trim_cell.h.
 *
 * Within a rectangle r the winding number of a chain is that of the pieces that meet r and that of the runs between them.
 * A run that keeps clear of r counts the same for all p in r, but for its ends: as p goes up past an end that is to the
 * right of r, that end drops below the ray. So a run from a to b counts [b is right of r and above p] - [a is right of r
 * and above p] + a constant, and the sum of these constants is found once, from the winding number at one point of r. */
#include "nurbs/trim_cell.h"

#include "nurbs/trim_test.h"

/* More pieces than this in one rectangle are left to the chain's own tree: then that is faster than a list, its strips
 * part the needles of a gear, and lists for each of many rectangles would grow without bound. */
#define MAX_PIECES 16

/* An end of a run, to the right of the rectangle: `counts` while it is above p. */
typedef struct { int vertex, counts; } RunEnd;

/* A trim that is neither all round the rectangle nor beside it; or it is all round, and something in it is mixed. */
typedef struct {
    const TrimChain *chain;
    TrimRect box;                    /* the chain's */
    int n_pieces, n_ends;            /* n_pieces < 0: the chain's tree is asked */
    int constant;
    const int *pieces;
    const RunEnd *ends;
    const struct CellList *inner;
} CellTrim;

typedef struct CellList {
    bool keeps_outside;
    int n;                           /* 0: keeps_outside is all there is to say */
    const CellTrim *trims;
} CellList;

struct TrimCell {
    const TrimTree *tree;
    TrimRect r;                      /* in the unit square */
    CellList list;
};

typedef struct { Arena *arena, *scratch; TrimRect r; WidePoint corner; } Maker;

/* ---- the test ---- */

static int local_winding(const CellTrim *t, WidePoint p)
{
    if (t->n_pieces < 0) return trim_chain_winding(t->chain, p);
    const TrimPath *path = &t->chain->path;
    int winding = t->constant;
    for (int i = 0; i < t->n_pieces; i++) winding += trim_piece_winding(path, t->pieces[i], p);
    for (int i = 0; i < t->n_ends; i++)
        if (trim_is_above(trim_vertex(path, t->ends[i].vertex), p)) winding += t->ends[i].counts;
    return winding;
}

static bool list_keeps(const CellList *l, WidePoint p)
{
    TrimRect at = { p.x.hi, p.x.hi, p.y.hi, p.y.hi };
    for (int i = 0; i < l->n; i++) {
        const CellTrim *t = &l->trims[i];
        if (!trim_rects_meet(t->box, at)) continue;
        if (local_winding(t, p) != 0 && list_keeps(t->inner, p) != l->keeps_outside) return !l->keeps_outside;
    }
    return l->keeps_outside;
}

static Wide within(Wide x, double lo, double hi) { return x.hi < lo ? wide(lo) : x.hi > hi ? wide(hi) : x; }

bool trim_cell_keeps(const TrimCell *cell, double u, double v)
{
    WidePoint p = trim_test_point(cell->tree, u, v);
    p.x = within(p.x, cell->r.u0, cell->r.u1), p.y = within(p.y, cell->r.v0, cell->r.v1);
    return list_keeps(&cell->list, p);
}

static bool trim_may_meet(const CellTrim *t, TrimRect r)
{
    if (t->n_pieces < 0) return trim_chain_meets(t->chain, r);
    for (int i = 0; i < t->n_pieces; i++)
        if (trim_rects_meet(trim_piece_box(&t->chain->path, t->pieces[i]), r)) return true;
    return false;
}

static bool list_may_meet(const CellList *l, TrimRect r)
{
    for (int i = 0; i < l->n; i++)
        if (trim_may_meet(&l->trims[i], r) || list_may_meet(l->trims[i].inner, r)) return true;
    return false;
}

bool trim_cell_may_meet(const TrimCell *cell, TrimRect r)
{
    WidePoint lo = trim_test_point(cell->tree, r.u0, r.v0), hi = trim_test_point(cell->tree, r.u1, r.v1);
    TrimRect unit = { lo.x.hi, hi.x.hi, lo.y.hi, hi.y.hi };
    bool is_within = unit.u0 >= cell->r.u0 && unit.u1 <= cell->r.u1 && unit.v0 >= cell->r.v0 && unit.v1 <= cell->r.v1;
    return !is_within || list_may_meet(&cell->list, unit);
}

/* ---- making it ---- */

static bool end_matters(const Maker *m, Vec2 p) { return p.x > m->r.u1 && p.y >= m->r.v0 && p.y <= m->r.v1; }

/* The ends of the runs: where piece i is listed and its neighbour is not. */
static void add_ends(const Maker *m, CellTrim *t)
{
    const TrimPath *path = &t->chain->path;
    RunEnd *ends = ARENA_ARRAY(m->arena, RunEnd, 2 * t->n_pieces);
    for (int k = 0; k < t->n_pieces; k++) {
        int i = t->pieces[k], before = t->pieces[(k > 0 ? k : t->n_pieces) - 1];
        int after = t->pieces[k + 1 < t->n_pieces ? k + 1 : 0];
        bool is_first = before != (i > 0 ? i : path->n) - 1, is_last = after != (i + 1 < path->n ? i + 1 : 0);
        if (is_first && end_matters(m, path->p[i])) ends[t->n_ends++] = (RunEnd){ i, 1 };
        if (is_last && end_matters(m, path->p[i + 1])) ends[t->n_ends++] = (RunEnd){ i + 1, -1 };
    }
    t->ends = ends;
}

/* Lists the pieces that meet r; there are more than MAX_PIECES: -1. */
static void add_pieces(const Maker *m, CellTrim *t)
{
    int pieces[MAX_PIECES];
    for (int i = trim_chain_next(t->chain, m->r, 0); i >= 0; i = trim_chain_next(t->chain, m->r, i + 1)) {
        if (!trim_path_meets(&t->chain->path, i, m->r)) continue;
        if (t->n_pieces == MAX_PIECES) {
            t->n_pieces = -1;
            return;
        }
        pieces[t->n_pieces++] = i;
    }
    t->pieces = arena_copy(m->arena, pieces, (size_t)t->n_pieces, sizeof *pieces);
    add_ends(m, t);
}

static CellTrim local_trim(const Maker *m, const TrimChain *chain)
{
    CellTrim t = { .chain = chain, .box = trim_chain_box(chain) };
    add_pieces(m, &t);
    if (t.n_pieces >= 0) t.constant = trim_chain_winding(chain, m->corner) - local_winding(&t, m->corner);
    return t;
}

static CellList local_list(const Maker *m, const TrimList *l);

/* Appends the trim, unless it has no say in r or the only one: then *settles is true, and the list keeps what is not
 * outside. */
static void add_trim(const Maker *m, const TrimNode *node, bool keeps_outside, CellTrim *list, int *n, bool *settles)
{
    CellTrim t = local_trim(m, &node->chain);
    bool is_all_round = t.n_pieces == 0;
    if (is_all_round && t.constant == 0) return;
    CellList inner = local_list(m, &node->inner);
    bool is_plain = inner.n == 0;
    if (is_plain && inner.keeps_outside == keeps_outside) return;
    *settles = *settles || (is_plain && is_all_round);
    t.inner = arena_copy(m->arena, &inner, 1, sizeof inner);
    list[(*n)++] = t;
}

static CellList local_list(const Maker *m, const TrimList *l)
{
    ArenaMark mark = arena_mark(m->scratch);
    CellTrim *list = ARENA_ARRAY(m->scratch, CellTrim, l->n);
    bool settles = false;
    int n = 0;
    for (int i = trim_boxes_next(&l->boxes, m->r, 0); i >= 0 && !settles; i = trim_boxes_next(&l->boxes, m->r, i + 1)) {
        add_trim(m, l->trims[i], l->keeps_outside, list, &n, &settles);
    }
    CellList out = { settles ? !l->keeps_outside : l->keeps_outside, settles ? 0 : n, NULL };
    if (out.n > 0) out.trims = arena_copy(m->arena, list, (size_t)n, sizeof *list);
    arena_reset(m->scratch, mark);
    return out;
}

TrimClass trim_cell_new(Arena *a, Arena *scratch, const TrimTree *t, TrimRect r, const TrimCell **out)
{
    ArenaMark mark = arena_mark(a);
    WidePoint lo = trim_test_point(t, r.u0, r.v0), hi = trim_test_point(t, r.u1, r.v1);
    Maker m = { a, scratch, { lo.x.hi, hi.x.hi, lo.y.hi, hi.y.hi }, wide_point(wide_point_round(lo)) };
    TrimCell cell = { t, m.r, local_list(&m, &t->top) };
    *out = NULL;
    if (cell.list.n == 0) {
        arena_reset(a, mark);
        return cell.list.keeps_outside ? TRIM_KEPT : TRIM_CUT;
    }
    *out = arena_copy(a, &cell, 1, sizeof cell);
    return TRIM_MIXED;
}
