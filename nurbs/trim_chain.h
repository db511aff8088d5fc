/* A closed chain of pieces in the unit square, with a tree of bounds over runs of consecutive pieces: what trims are
 * tested by.
 *
 * A piece is monotone in u and in v, so that its box is the box of its ends, and here it is straight. Only the functions
 * trim_piece_* look between the ends. All predicates are exact: chains that share vertices and edges see the same
 * sides. */
#ifndef TRIMRAY_TRIM_CHAIN_H
#define TRIMRAY_TRIM_CHAIN_H

#include "nurbs/trim_tree.h"

/* ---- boxes over things in a row: level 0 holds one box a thing, each level above one for four of the level below ---- */

#define TRIM_BOXES_FAN 4
#define TRIM_BOXES_MAX_LEVELS 17

typedef struct {
    int n_levels;                            /* 0: nothing there */
    int n[TRIM_BOXES_MAX_LEVELS];
    TrimRect *box[TRIM_BOXES_MAX_LEVELS];
} TrimBoxes;

TrimBoxes trim_boxes_make(Arena *a, TrimRect *lowest, int n);    /* keeps `lowest`, which lies in the arena */

/* The first box i >= from of level 0 that meets r (closed against closed); -1: none. Logarithmic where r is small. */
int trim_boxes_next(const TrimBoxes *t, TrimRect r, int from);

TrimRect trim_rect_of(Vec2 a, Vec2 b);                           /* corners in any order */
TrimRect trim_rect_union(TrimRect a, TrimRect b);
static inline bool trim_rects_meet(TrimRect a, TrimRect b)
{
    return a.u0 <= b.u1 && b.u0 <= a.u1 && a.v0 <= b.v1 && b.v0 <= a.v1;
}

/* ---- one piece, from a to b ---- */

/* The sign of the area of the triangle a, b, p: 1 where p is to the left of the line from a to b, -1 to the right, 0 on it.
 * Exact for coordinates that are 0 or of magnitude 1e-140 to 1e140. */
int trim_side(Vec2 a, Vec2 b, Vec2 p);

Vec2 trim_piece_nearest(Vec2 a, Vec2 b, Vec2 p);                 /* the point of the piece that is nearest to p */
bool trim_piece_meets_rect(Vec2 a, Vec2 b, TrimRect r);          /* closed; exact */
bool trim_pieces_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d);           /* cross or touch; exact */

/* ---- the chain ---- */

#define TRIM_GROUP 8   /* pieces in a box of level 0 */

/* Beside its box a run has a strip, a box along the run's own main axis: it parts the needles of a gear, whose boxes overlap
 * by the thousand. lo, hi: along the axis and across it (to its left); widened to contain the run in spite of rounding. */
typedef struct { Vec2 axis; double lo[2], hi[2]; } TrimStrip;

typedef struct {
    int n;                                   /* pieces; i goes from p[i] to p[i+1] */
    const Vec2 *p;                           /* n + 1 points, p[n] equal to p[0] */
    TrimBoxes boxes;                         /* over TRIM_GROUP pieces each */
    TrimStrip *strip[TRIM_BOXES_MAX_LEVELS]; /* one for each box */
} TrimChain;

TrimChain trim_chain_make(Arena *a, const Vec2 *p, int n);       /* copies the n + 1 points */
TrimRect trim_chain_box(const TrimChain *c);

/* How often the chain goes round p, counterclockwise. Points on the chain are taken to be on one side or the other, the same
 * side by all chains that share the edge. O(log n) but
 * for points that are in the boxes and strips of many pieces. */
int trim_chain_winding(const TrimChain *c, Vec2 p);

/* Calls visit for pairs of pieces (i of a, j of b) that meet, cross or touch, until it returns true; returns whether it did.
 * visit NULL: is there any such pair? With a == b: each pair i < j once, neighbours left out. */
typedef bool (*TrimPairVisit)(void *context, int i, int j);
bool trim_chains_meet(const TrimChain *a, const TrimChain *b, TrimPairVisit visit, void *context);

/* The first piece i >= from whose box meets r, less those that are known not to meet it themselves; -1: none. */
int trim_chain_next(const TrimChain *c, TrimRect r, int from);

/* Does a piece meet the closed rectangle? If not, the winding is the same all over it, as trim_chain_winding computes it. */
bool trim_chain_meets(const TrimChain *c, TrimRect r);

/* The distance from p, where it is less than `limit`, and the nearest piece; else `limit` and -1. */
typedef struct { double distance; int piece; Vec2 point; } TrimNearest;
TrimNearest trim_chain_nearest(const TrimChain *c, Vec2 p, double limit);

#endif
