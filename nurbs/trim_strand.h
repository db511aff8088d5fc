/* The curves of a trim one after the other, their joints closed. */
#ifndef TRIMRAY_TRIM_STRAND_H
#define TRIMRAY_TRIM_STRAND_H

#include "nurbs/trim_curve.h"

#define TRIM_SILENT 1e-6          /* what is mended without a word: joints by their midpoint, points to the border */
#define TRIM_BRIDGE 1e-3          /* a wider joint is bridged by a straight piece */
#define TRIM_BRIDGE_SPACE 1e-4    /* or by one that is this short in space (at a pole only that is) */

typedef struct { double value; Vec2 at; } TrimFault;   /* value 0: none */

/* From p to the p of the next step (the last: to the first): straight, or a Bézier curve with k control points. The ends of
 * straight steps are doubles, and those of strands (maximal runs without a joint) that were moved. */
typedef struct {
    WidePoint p;
    int k;
    WideControl *control;         /* NULL: straight */
} TrimStep;

typedef struct {
    TrimStep *step;
    size_t n, capacity;
    double moved;                 /* the farthest that an end was moved by, at most TRIM_SILENT */
} TrimSteps;

/* Reads loop `index` of the input. Ends of strands within TRIM_SILENT of a border are put on it; joints are closed by
 * their midpoint or bridged, the curves' ends moved with them. The widest bridge goes to *bridged. False: *error says
 * why; its place in the input is set by the caller, but for the curve. */
bool trim_steps_read(Arena *a, const TrimInput *in, int index, TrimSteps *out, TrimFault *bridged, NurbsError *error);

#endif
