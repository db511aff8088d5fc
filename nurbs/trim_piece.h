/* Straight pieces from a to b: exact predicates, so that all that share vertices and edges see the same sides. */
#ifndef TRIMRAY_TRIM_PIECE_H
#define TRIMRAY_TRIM_PIECE_H

#include "nurbs/trim_boxes.h"

/* The sign of the area of the triangle a, b, p: 1 where p is to the left of the line from a to b, -1 to the right, 0 on it.
 * Exact for coordinates that are 0 or of magnitude 1e-140 to 1e140. */
int trim_side(Vec2 a, Vec2 b, Vec2 p);

Vec2 trim_piece_nearest(Vec2 a, Vec2 b, Vec2 p);                 /* the point of the piece that is nearest to p */
bool trim_piece_meets_rect(Vec2 a, Vec2 b, TrimRect r);          /* closed; exact */
bool trim_pieces_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d);           /* cross or touch; exact */

#endif
