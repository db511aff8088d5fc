/* Procedures Inside and IsTrimmed of [MCFS00] sections 3.1 and 3.2: is a point kept, is a rectangle wholly kept or cut.
 *
 * The paper goes down into the first trim of a list that contains the point. Here all trims that contain it have a say,
 * for real trims of one level may overlap by a hair (a shallow crossing): among regions one that keeps the point is
 * enough, among holes one that cuts it. So the order of the trims does not matter. */
#include "nurbs/trim_test.h"

#include "nurbs/trim_curve.h"

static Wide inset(Wide x)
{
    return x.hi < TRIM_INSET_LOW ? wide(TRIM_INSET_LOW) : x.hi > 1 - TRIM_INSET_HIGH ? wide(1 - TRIM_INSET_HIGH) : x;
}

WidePoint trim_test_point(const TrimTree *t, double u, double v)
{
    WidePoint p = trim_to_unit_wide(&t->domain, vec2(u, v));
    return (WidePoint){ inset(p.x), inset(p.y) };
}

/* The next trim of the list, from number i on, that contains p; -1: none. */
static int next_around(const TrimList *l, WidePoint p, int i)
{
    TrimRect at = { p.x.hi, p.x.hi, p.y.hi, p.y.hi };
    while ((i = trim_boxes_next(&l->boxes, at, i)) >= 0) {
        if (trim_chain_winding(&l->trims[i]->chain, p) != 0) return i;
        i++;
    }
    return -1;
}

static bool list_keeps(const TrimList *l, WidePoint p)
{
    for (int i = next_around(l, p, 0); i >= 0; i = next_around(l, p, i + 1)) {
        if (list_keeps(&l->trims[i]->inner, p) != l->keeps_outside) return !l->keeps_outside;
    }
    return l->keeps_outside;
}

bool trim_keeps(const TrimTree *t, double u, double v) { return list_keeps(&t->top, trim_test_point(t, u, v)); }

/* No piece of a trim that meets r: then r is as its corner is. */
static TrimClass list_class(const TrimList *l, TrimRect r)
{
    bool keeps = l->keeps_outside;
    for (int i = trim_boxes_next(&l->boxes, r, 0); i >= 0; i = trim_boxes_next(&l->boxes, r, i + 1)) {
        const TrimNode *trim = l->trims[i];
        if (trim_chain_meets(&trim->chain, r)) return TRIM_MIXED;
        if (trim_chain_winding(&trim->chain, wide_point(vec2(r.u0, r.v0))) == 0) continue;
        TrimClass inner = list_class(&trim->inner, r);
        if (inner == TRIM_MIXED) return TRIM_MIXED;
        if ((inner == TRIM_KEPT) != l->keeps_outside) keeps = !l->keeps_outside;
    }
    return keeps ? TRIM_KEPT : TRIM_CUT;
}

TrimClass trim_class(const TrimTree *t, TrimRect r)
{
    WidePoint lo = trim_test_point(t, r.u0, r.v0), hi = trim_test_point(t, r.u1, r.v1);
    return list_class(&t->top, (TrimRect){ lo.x.hi, hi.x.hi, lo.y.hi, hi.y.hi });
}

int trim_loop_count(const TrimTree *t) { return t->n_loops; }
int trim_piece_count(const TrimTree *t) { return t->n_pieces; }
