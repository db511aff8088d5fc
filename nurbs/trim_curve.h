/* One B-spline curve of a trim: checked, cut into Bézier segments.
 *
 * Trims live in the unit square: the surface's domain, scaled to [0,1] x [0,1]. "Of the domain" in a tolerance means that
 * unit. */
#ifndef TRIMRAY_TRIM_CURVE_H
#define TRIMRAY_TRIM_CURVE_H

#include "nurbs/trim_arc.h"
#include "nurbs/trim_tree.h"

/* How far a curve may leave the domain at all; beyond that is an error. */
#define TRIM_OUTSIDE 1e-2

/* Between the domain and the unit square. The first is monotone in each coordinate, rounding included, and takes the
 * domain's borders to 0 and 1 exactly. */
Vec2 trim_to_unit(const TrimRect *domain, Vec2 p);
WidePoint trim_to_unit_wide(const TrimRect *domain, Vec2 p);   /* what the first is rounded from */
Vec2 trim_from_unit(const TrimRect *domain, Vec2 p);

/* Order, knots, points and weights as nurbs.h wants them; false: error's code, index, other and value say what is wrong. An
 * interior knot of full multiplicity is legal: the curve then has a joint there. */
bool trim_curve_is_valid(const TrimCurveDesc *c, NurbsError *error);

/* The first span s >= from of the domain that is not empty; -1: no more. Begin with from = 0. Does the curve begin at
 * span s, or again after a knot of full multiplicity? */
int trim_curve_span(const TrimCurveDesc *c, int from);
bool trim_curve_starts_at(const TrimCurveDesc *c, int s);

/* Span s as a Bézier segment of c->order points, to twice the precision of a double. A clamped end is met as exactly as the
 * point itself. The greatest weight of the span's points becomes 1/2 or more, and less than 1. */
void trim_curve_segment(const TrimCurveDesc *c, const TrimRect *domain, int s, WideControl out[]);

#endif
