/* Trims made polylines, for what only needs them within a tolerance. */
#ifndef TRIMRAY_TRIM_FLAT_H
#define TRIMRAY_TRIM_FLAT_H

#include "nurbs/trim_chain.h"

/* How far the polylines are from the trims by which crossings and their depths are judged, of the domain: a tenth of what
 * joints are closed by in silence. A circle as large as the domain becomes some 8,000 points; the number grows with the
 * inverse of the root. Inside tests do not depend on it. */
#define TRIM_CHORD 1e-7

typedef struct { Vec2 *p; size_t n, capacity; } TrimPoints;   /* a growing polyline in the unit square */
void trim_points_add(Arena *a, TrimPoints *list, Vec2 p);

/* Appends points of the Bézier curve {w u, w v, 0, w} after its start, up to and with its end; destroys the control points.
 * Between two of them curve and chord are within `chord` of each other: the control points of that part are that near to the
 * chord, and the curve lies in their hull. */
void trim_flatten(Arena *a, int k, Vec4 p[], double chord, TrimPoints *out);

/* The chain with its arcs flattened; one of straight pieces is copied. */
TrimChain trim_chain_flatten(Arena *a, const TrimChain *c, double chord);

#endif
