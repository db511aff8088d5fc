/* Bézier polygons of homogeneous points. A polygon of order k may carry `width` curves at once: k blocks of `width` points,
 * one block for each control point; a patch p[i*k_u + j] is one polygon of width k_u along v, and k_v of width 1 along u. */
#ifndef TRIMRAY_BEZIER_H
#define TRIMRAY_BEZIER_H

#include "nurbs/nurbs.h"
#include "nurbs/wide.h"
#include "render/box.h"

/* Closes the knots about one span: p holds the B-spline control points mu-k+1 .. mu and becomes the Bézier polygon over
 * [tau[mu], tau[mu+1]], as if both knots had been inserted until their multiplicity is k-1 ([MCFS00] section 2.1).
 * Error per coordinate: every new point is 2(k-1) convex combinations deep. A difference of knots has one rounding, relative
 * to itself, however close they are: a share has three. It moves a combination by 3 u |b - a|, the combination's own
 * roundings by 3 u max|p|: in all at most 18 (k-1) u max|p|, u = 2^-53. */
void bezier_from_span(int k, const double tau[], int mu, int width, Vec4 p[]);

/* The same with twice the precision, for blocks of `width` numbers: 2(k-1) combinations, whose shares err by 2^-100. */
void bezier_from_span_wide(int k, const double tau[], int mu, int width, Wide p[]);

/* Cuts at s in [0, 1] by de Casteljau's algorithm ([PT97] A1.5), which is the insertion of k-1 knots: left gets the part
 * before s, p becomes the part after it; they must not overlap. The last block of left equals the first of p, bit for bit.
 * Error per coordinate: at most 3(k-1) u max|p|. */
void bezier_cut(int k, int width, double s, Vec4 p[], Vec4 left[]);

/* The point at s of a single curve (width 1). */
Vec4 bezier_point(int k, const Vec4 p[], double s);

/* Bounds of |S_ss|, |S_st| and |S_tt| over the unit square. */
typedef struct { double ss, st, tt; } BezierSeconds;
BezierSeconds bezier_seconds(int k_u, int k_v, const Vec4 patch[]);

/* How far a patch is from its tangent plane's map: for points x and x + d of the unit square,
 * |S(x + d) - S(x) - S_s(x) d_s - S_t(x) d_t| <= bend max(|d_s|, |d_t|)^2. */
double bezier_bend(int k_u, int k_v, const Vec4 patch[]);

/* A box round n homogeneous points with positive weights, and so round the patch or curve they control. */
Box bezier_hull(int n, const Vec4 p[]);

#endif
