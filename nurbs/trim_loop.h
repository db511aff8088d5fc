/* One trim as read: a closed path of straight pieces and arcs in the unit square, mended within the tolerances of the scene
 * language.
 *
 * All tolerances are relative to the domain in that direction, but the one in space, which is relative to the surface's
 * size. They come from 47,526 trim curves of real STEP, IGES and Rhino files: 54 % of the joints are not exact, 1.9 % by
 * more than 1e-6 and 0.26 % by more than 1e-4 of the domain; 24 % of the curves leave the domain, 0.23 % by more than
 * 1e-4. */
#ifndef TRIMRAY_TRIM_LOOP_H
#define TRIMRAY_TRIM_LOOP_H

#include "nurbs/trim_chain.h"
#include "nurbs/trim_strand.h"

/* A loop thinner than this (twice its area over its length, of the domain) has no sure direction. In units of 2^-53: the way
 * to the unit square and rounding there move a vertex by 4 in each coordinate, which makes 2 sqrt 2 times as much of twice
 * the area over the length; the polygon's terms have 6 (trim_signed_area), of the loop's diameter, sqrt 2 at most. The
 * control points of an arc of order k have 16 k (trim_arc_control, as BULGE_ROUNDINGS has it), its area 8 more (AREA_ERROR):
 * 2 sqrt 2 times both. That is 20 for polygons, and under 1500 of these 2048 for the highest order, 32. Nor has one thinner
 * than what mending moved. */
#define TRIM_THIN 0x1p-42

typedef struct {
    int index;                     /* in TrimInput */
    TrimPath path;                 /* neighbours differ; n = 0: nothing is left of it */
    double area;                   /* signed: counterclockwise is positive (Rokne's sum, [MCFS00] section 3) */
    bool is_thin;                  /* it says nothing, unless it crosses itself: then its parts cancel */
    TrimFault bridged, clamped;    /* the widest bridge, the farthest point outside: beyond TRIM_SILENT only */
} TrimLoop;

/* Reads loop `index` of the input: curves cut into monotone arcs, joints closed or bridged, what is outside the domain
 * clamped to it, straight pieces' ends and arcs within TRIM_SILENT of a border put on it, repeated points left out.
 * False: *error says what is beyond the tolerances. The result lies in `a`. */
bool trim_loop_read(Arena *a, const TrimInput *in, int index, TrimLoop *out, NurbsError *error);

/* Does the loop consist of nothing but pieces of the domain's border? */
bool trim_loop_is_border(const TrimLoop *l);

double trim_signed_area(const Vec2 *p, int n);   /* of the closed polygon p[0] .. p[n] = p[0] */

#endif
