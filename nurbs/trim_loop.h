/* One trim as read: a closed polyline in the unit square, mended within the tolerances of the scene language.
 *
 * All tolerances are relative to the domain in that direction, but the one in space, which is relative to the surface's
 * size. They come from 47,526 trim curves of real STEP, IGES and Rhino files: 54 % of the joints are not exact, 1.9 % by
 * more than 1e-6 and 0.26 % by more than 1e-4 of the domain; 24 % of the curves leave the domain, 0.23 % by more than
 * 1e-4. */
#ifndef TRIMRAY_TRIM_LOOP_H
#define TRIMRAY_TRIM_LOOP_H

#include "nurbs/trim_curve.h"

#define TRIM_SILENT 1e-6          /* what is mended without a word: joints by their midpoint, points to the border */
#define TRIM_BRIDGE 1e-3          /* a wider joint is bridged by a straight piece */
#define TRIM_BRIDGE_SPACE 1e-4    /* or by one that is this short in space (at a pole only that is) */

/* A loop thinner than this (twice its area over its length) has no sure direction: flattening may turn it over. */
#define TRIM_THIN (2 * TRIM_CHORD)

typedef struct { double value; Vec2 at; } TrimFault;   /* value 0: none */

typedef struct {
    int index;                     /* in TrimInput */
    int n;                         /* pieces; 0: nothing is left of it */
    Vec2 *p;                       /* n + 1 points, p[n] equal to p[0], neighbours differ */
    double area;                   /* signed: counterclockwise is positive (Rokne's sum, [MCFS00] section 3) */
    TrimFault bridged, clamped;    /* the widest bridge, the farthest point outside: beyond TRIM_SILENT only */
} TrimLoop;

/* Reads loop `index` of the input: curves flattened, joints closed or bridged, points outside the domain clamped to it,
 * points within TRIM_SILENT of a border put on it, repeated points left out; what has no area is emptied (n = 0). False:
 * *error says what is beyond the tolerances. The result lies in `a`. */
bool trim_loop_read(Arena *a, const TrimInput *in, int index, TrimLoop *out, NurbsError *error);

/* Does the loop consist of nothing but pieces of the domain's border? */
bool trim_loop_is_border(const TrimLoop *l);

double trim_signed_area(const Vec2 *p, int n);   /* of the closed polygon p[0] .. p[n] = p[0] */

#endif
