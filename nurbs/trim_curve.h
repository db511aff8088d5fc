/* One B-spline curve of a trim: checked, cut into Bézier segments, flattened to points on the curve.
 *
 * Trims live in the unit square: the surface's domain, scaled to [0,1] x [0,1]. "Of the domain" in a tolerance means that
 * unit. A segment is homogeneous {w u, w v, 0, w} with positive weights. */
#ifndef TRIMRAY_TRIM_CURVE_H
#define TRIMRAY_TRIM_CURVE_H

#include "nurbs/trim_tree.h"

/* How far a flattened curve may be from the true one, of the domain: a tenth of what joints are closed by in silence, and
 * a thousandth of a pixel where the surface's whole domain spans 10,000 of them. A circle as large as the domain becomes
 * some 8,000 points; the number grows with 1 / sqrt(TRIM_CHORD). */
#define TRIM_CHORD 1e-7

/* How far a curve may leave the domain at all; what is farther out is not flattened finely. */
#define TRIM_OUTSIDE 1e-2

typedef struct { Vec2 *p; size_t n, capacity; } TrimPoints;   /* a growing polyline in the unit square */

/* Between the domain and the unit square. The first is monotone in each coordinate, rounding included, and takes the
 * domain's borders to 0 and 1 exactly. */
Vec2 trim_to_unit(const TrimRect *domain, Vec2 p);
Vec2 trim_from_unit(const TrimRect *domain, Vec2 p);

/* Order, knots, points and weights as nurbs.h wants them; false: error's code, index, other and value say what is wrong. An
 * interior knot of full multiplicity is legal: the curve then has a joint there. */
bool trim_curve_is_valid(const TrimCurveDesc *c, NurbsError *error);

/* The first span s >= from of the domain that is not empty; -1: no more. Begin with from = 0. Does the curve begin at
 * span s, or again after a knot of full multiplicity? */
int trim_curve_span(const TrimCurveDesc *c, int from);
bool trim_curve_starts_at(const TrimCurveDesc *c, int s);

/* Span s as a Bézier segment of c->order points. A clamped end is met bit for bit. The greatest weight becomes 1. */
void trim_curve_segment(const TrimCurveDesc *c, const TrimRect *domain, int s, Vec4 out[]);

Vec2 trim_segment_start(const Vec4 segment[]);

/* Appends points of the segment after its start, up to and with its end; destroys the segment. Between two of them curve and
 * chord are within TRIM_CHORD of each other: the control points of that part are that near to the chord, and the curve lies
 * in their hull. */
void trim_segment_flatten(Arena *a, int k, Vec4 segment[], TrimPoints *out);

void trim_points_add(Arena *a, TrimPoints *list, Vec2 p);

#endif
