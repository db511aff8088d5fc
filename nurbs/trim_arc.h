/* Arcs: parts of rational Bézier curves in the unit square that are monotone in u and in v, and exact decisions about
 * them.
 *
 * Control points are kept to twice the precision of a double, for the scaling of the domain to the unit square and the
 * closing of knots would otherwise move the curve by as much as the distances that count here. */
#ifndef TRIMRAY_TRIM_ARC_H
#define TRIMRAY_TRIM_ARC_H

#include "nurbs/nurbs.h"
#include "nurbs/wide.h"

typedef struct { Wide x, y; } WidePoint;                 /* in the unit square */
typedef struct { Wide x, y, w; } WideControl;            /* homogeneous {w u, w v, w}, w > 0 */

static inline Vec2 wide_point_round(WidePoint p) { return vec2(p.x.hi, p.y.hi); }
static inline WidePoint wide_point(Vec2 p) { return (WidePoint){ wide(p.x), wide(p.y) }; }

/* A rational Bézier curve over [0, 1]. For h = w (curve - p), p any point of the unit square: */
typedef struct {
    int k;                                               /* order */
    const WideControl *p;
    double size;                                         /* |h| is at most this in either coordinate, */
    double bend;                                         /* and so is |h''| */
} TrimSegment;

TrimSegment trim_segment_make(int k, const WideControl *p);                     /* keeps p */
WidePoint trim_segment_at(const TrimSegment *s, double t);

/* Where x or y turn, ascending in (0, 1): between two of them, or an end, the curve is monotone in both. Room for
 * TRIM_MAX_TURNS. Both are roots of hodographs, found with certainty (bernstein.h) to the last bit of t: the curve
 * returns by less than |h''| 2^-106 of where it turns. */
#define TRIM_MAX_TURNS (4 * NURBS_MAX_ORDER)
int trim_segment_turns(const TrimSegment *s, double t[]);

typedef struct {
    const TrimSegment *segment;                          /* NULL: the piece is straight */
    double t0, t1;
    double w0, w1;                                       /* weights at the ends */
    double bulge;                                        /* the arc is within this of the chord between its ends */
} TrimArc;

TrimArc trim_arc_make(const TrimSegment *s, double t0, double t1);

/* Does the arc from a to b pass the horizontal line through p to the right of p? Requires that one of a and b is above p
 * and the other is not (trim_is_above), and that p is in the unit square. A point on the arc is not to its left. That of
 * exact arithmetic unless p is nearer to the arc than 2^-90 of the domain or so (for orders and weights that are not
 * extreme); such points count as on it. */
bool trim_arc_is_right(const TrimArc *arc, WidePoint a, WidePoint b, WidePoint p);

/* Within the arc's own parameters, t0 < t < t1: where the coordinate (0: u, 1: v) is `value`, to the last bit. */
double trim_arc_find(const TrimArc *arc, int coordinate, double value);

/* The control points of the part in [t0, t1], rounded to doubles: homogeneous {w u, w v, 0, w}. */
void trim_arc_control(const TrimArc *arc, Vec4 out[]);

/* The signed area between the arc and its chord: what it adds to the area of the polygon of chords. */
double trim_arc_area(const TrimArc *arc);

static inline bool trim_is_above(WidePoint a, WidePoint p) { return wide_less(p.y, a.y); }

#endif
