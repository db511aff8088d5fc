/* The trims of one surface: loops in the (u, v) plane, their hierarchy by containment and the keep rule ([MCFS00] section
 * 3). Knows the domain, not the surface. */
#ifndef TRIMRAY_TRIM_TREE_H
#define TRIMRAY_TRIM_TREE_H

#include "nurbs/nurbs.h"

typedef struct { double u0, u1, v0, v1; } TrimRect;

/* How far apart two parameter points lie in space, relative to the size of the surface: what a gap between two curves
 * means. NULL in TrimInput: gaps are judged by the domain alone. */
typedef double (*TrimDistance)(const void *surface, Vec2 a, Vec2 b);

typedef struct {
    const TrimLoopDesc *loops;
    int n_loops;
    bool keep_left;
    TrimRect domain;
    TrimDistance distance;
    const void *surface;
} TrimInput;

typedef struct TrimTree TrimTree;

/* Closes joints, clamps to the domain, finds crossings, directions and the hierarchy. Sets error->code and returns NULL on
 * what is beyond the tolerances; warnings as in nurbs_shape_new. If the trims keep the whole domain, returns NULL with
 * error->code NURBS_OK. */
TrimTree *trim_tree_new(Arena *a, const TrimInput *in, NurbsError *error,
                        NurbsWarning *warnings, int max_warnings, int *n_warnings);

typedef enum { TRIM_KEPT, TRIM_CUT, TRIM_MIXED } TrimClass;

/* Is S(u, v) part of the trimmed surface? Procedure Inside of section 3.2. A point on a trim may go either way, but the same
 * way always. */
bool trim_keeps(const TrimTree *t, double u, double v);

/* Procedure IsTrimmed of section 3.1, for a rectangle: wholly kept, wholly cut away, or mixed (it may be conservative:
 * TRIM_MIXED is always allowed). */
TrimClass trim_class(const TrimTree *t, TrimRect r);

int trim_loop_count(const TrimTree *t);
int trim_piece_count(const TrimTree *t);

#endif
