/* A closed chain of pieces in the unit square, with a tree of bounds over runs of consecutive pieces: what trims are
 * tested by.
 *
 * A piece is straight or an arc (trim_arc.h). Either way it is monotone in u and in v, so that its box is the box of its
 * ends; only the functions of trim_piece.h and trim_arc.h look between these. All predicates are exact: chains that share
 * vertices and edges see the same sides. */
#ifndef TRIMRAY_TRIM_CHAIN_H
#define TRIMRAY_TRIM_CHAIN_H

#include "nurbs/trim_arc.h"
#include "nurbs/trim_piece.h"

#define TRIM_GROUP 8   /* pieces in a box of level 0 */

/* Beside its box a run has a strip, a box along the run's own main axis: it parts the needles of a gear, whose boxes overlap
 * by the thousand. lo, hi: along the axis and across it (to its left); widened to contain the run in spite of rounding. */
typedef struct { Vec2 axis; double lo[2], hi[2]; } TrimStrip;

bool trim_strips_are_apart(const TrimStrip *s, const TrimStrip *t);   /* true: certainly */

/* n pieces, i goes from p[i] to p[i+1]; n + 1 points, p[n] equal to p[0]. The vertices are p + low, low being what p's
 * rounding left over: 0 but at vertices within a curve. */
typedef struct {
    int n;
    const Vec2 *p;
    const Vec2 *low;                         /* NULL: all 0 */
    const TrimArc *arc;                      /* one for each piece; NULL: all pieces are straight */
} TrimPath;

typedef struct {
    TrimPath path;
    TrimBoxes boxes;                         /* over TRIM_GROUP pieces each */
    TrimStrip *strip[TRIM_BOXES_MAX_LEVELS]; /* one for each box */
} TrimChain;

TrimChain trim_chain_make(Arena *a, const TrimPath *path);       /* copies the path and its segments */
TrimRect trim_chain_box(const TrimChain *c);

static inline WidePoint trim_vertex(const TrimPath *path, int i)
{
    Vec2 p = path->p[i], low = path->low ? path->low[i] : vec2(0, 0);
    return (WidePoint){ { p.x, low.x }, { p.y, low.y } };
}

static inline bool trim_is_straight(const TrimPath *path, int i) { return !path->arc || !path->arc[i].segment; }
static inline TrimRect trim_piece_box(const TrimPath *path, int i) { return trim_rect_of(path->p[i], path->p[i + 1]); }

/* What the run from vertex i to vertex j counts if all of it is to the right of p: 1 upward, -1 downward, 0. */
static inline int trim_run_straddles(const TrimPath *path, int i, int j, WidePoint p)
{
    return trim_is_above(trim_vertex(path, j), p) - trim_is_above(trim_vertex(path, i), p);
}

int trim_piece_winding(const TrimPath *path, int i, WidePoint p);    /* the same for one piece, wherever it is */

/* How often the chain goes round p, counterclockwise. Points on the chain are taken to be on one side or the other, the same
 * side by all chains that share the edge. O(log n) but for points that are in the boxes and strips of many pieces. */
int trim_chain_winding(const TrimChain *c, WidePoint p);

/* The first piece i >= from whose box meets r, less those that are known not to meet it themselves; -1: none. */
int trim_chain_next(const TrimChain *c, TrimRect r, int from);

/* Does piece i meet the closed rectangle? Exact for straight ones; arcs that keep clear of it by less than the spacing of
 * doubles may count as meeting it. */
bool trim_path_meets(const TrimPath *path, int i, TrimRect r);

/* Does a piece meet the closed rectangle? If not, the winding is the same all over it, as trim_chain_winding computes it. */
bool trim_chain_meets(const TrimChain *c, TrimRect r);

/* For chains of straight pieces: the distance from p, where it is less than `limit`, and the nearest piece; else `limit` and
 * -1. */
typedef struct { double distance; int piece; Vec2 point; } TrimNearest;
TrimNearest trim_chain_nearest(const TrimChain *c, Vec2 p, double limit);

#endif
