/* Do trims cross, and how deep? Sharing vertices and edges, touching and near misses are no crossings: what counts is how
 * far a trim gets to the wrong side. All chains here are of straight pieces (trim_flat.h): depths are a matter of
 * tolerance. */
#ifndef TRIMRAY_TRIM_CROSS_H
#define TRIMRAY_TRIM_CROSS_H

#include "nurbs/trim_pairs.h"

/* A deeper crossing is an error, of the domain. In real parts the deepest are 7e-5. */
#define TRIM_CROSSING 1e-4

/* A shallower one may be our own doing, and is not mentioned: each of two curves may have been moved by TRIM_SILENT. */
#define TRIM_CROSSING_SILENT 2e-6

/* The paper's epsilon (section 3.1), of the domain: points nearer to a trim than this are on it. Far above the rounding of
 * points in the unit square, far below TRIM_CHORD. */
#define TRIM_EPSILON 1e-9

/* Depths are measured up to here. */
#define TRIM_DEPTH_CAP (1.01 * TRIM_CROSSING)

typedef struct { double depth; Vec2 at; } TrimCrossing;   /* at: a crossing point, where depth > TRIM_EPSILON */

/* How a stands to b. is_inside: a is contained in b, which is judged by the points of a that are farthest from b.
 * crossing: the depth to which one of them is on both sides of the other: the least distance by which one of its sides
 * would have to be moved back; at most TRIM_DEPTH_CAP. Neither inside nor crossing: apart, or the same. */
typedef struct { bool is_inside; TrimCrossing crossing; } TrimRelation;
TrimRelation trim_relation(const TrimChain *a, const TrimChain *b);

/* How deep a chain crosses itself: twice the greatest distance from the chain of a point that it goes round in the wrong
 * sense, or more than once. is_ccw: the chain's direction as a whole. The distance is sought by circles that touch the
 * chain at samples: a lower bound, near the truth for parts with few pieces or many, and never more than the truth.
 * `scratch` is used. */
TrimCrossing trim_self_crossing(Arena *scratch, const TrimChain *c, bool is_ccw);

#endif
