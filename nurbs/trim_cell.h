/* What the trims say within one small rectangle, a leaf of a tree of boxes: its class, and if it is mixed only the pieces
 * that cross it, so that a test there costs the same whether the trims have ten pieces or a million. */
#ifndef TRIMRAY_TRIM_CELL_H
#define TRIMRAY_TRIM_CELL_H

#include "nurbs/trim_tree.h"

typedef struct TrimCell TrimCell;

/* The class of r; if TRIM_MIXED, *out is what trim_cell_keeps asks: it lies in `a` and borrows from t. For TRIM_KEPT and
 * TRIM_CUT nothing is made and *out is NULL. `scratch`, another arena than `a`, is left as it was. */
TrimClass trim_cell_new(Arena *a, Arena *scratch, const TrimTree *t, TrimRect r, const TrimCell **out);

/* trim_keeps(t, u, v), for (u, v) in the closed rectangle; others are taken to its nearest point. */
bool trim_cell_keeps(const TrimCell *cell, double u, double v);

/* May a piece of a trim meet the rectangle? One that is not within the cell's may always be met. */
bool trim_cell_may_meet(const TrimCell *cell, TrimRect r);

#endif
