/* Numbers that the proofs of certify.c stand on: it derives them, and certify_bunch.c proves the same of eight rays. */
#ifndef TRIMRAY_CERTIFY_PROOF_H
#define TRIMRAY_CERTIFY_PROOF_H

#include "nurbs/certify.h"

#include <float.h>

/* From the parallelogram's root or a neighbour's, two steps or three are the rule; within a contraction near 1 the first may
 * go astray. What eight do not bring to an end has clip.c: nothing is lost. */
enum { MAX_STEPS = 8 };

/* The ray's origin is taken about the tree's base and then about the patch's. (What the first rounds beyond u of the
 * distance is in the patch's own: tile_tree.c.) */
#define ROUNDINGS_OF_ORIGIN 2

/* N.(H - w o) over w, of the radius and |o|. The roundings of H and w are relative to the sizes of their terms, and so move
 * the quotient by as much of the radius and of |o|. N.H is a dot product; N.o is one, and its product with w and the sum
 * with N.H are as good as another. */
#define ROUNDINGS_OF_VIEW (VIEW_FRAME_ROUNDINGS + 2 * VIEW_DOT_ROUNDINGS + ROUNDINGS_OF_ORIGIN)
static inline double rounding_share(const Patch *p)
{
    return 0.5 * DBL_EPSILON * (p->roundings + ROUNDINGS_OF_VIEW);
}

static inline double rounding_at(const Patch *p, double distance)
{
    return p->rounding + rounding_share(p) * (p->radius + distance);
}

/* Makes up for the rounding of a bound that is computed by some ten operations, and of what the ray sees of the frame:
 * 2^-26 (see certify.c's head). */
#define ROUNDED_UP 1.0001

/* Roundings of a step by Cramer's rule, relative to it, over the determinant's share of the columns' lengths: 2 each of the
 * determinants and their quotient. */
#define ROUNDINGS_OF_STEP 6

/* What rounding takes from these proofs, and where it does not count. With off = growth w_max rounding / w_middle, q the
 * contraction and lengths those of half the tile:
 *   F at the iterate is `rounding` off, which moves the root that it tells of by J_m^-1 (I + E)^-1 times that: by less than
 *   gain off / (2 (1-q));
 *   J is off by twice (k-1) as much, coefficients of a derivative being differences, and the step by its own rounding, which
 *   both count as part of E, by less than gain (off slopes + 2 ROUNDINGS_OF_STEP u), slopes = (k_u-1) ds / length_s + ...
 * The first must be less than BLUR times what each proof adds it to, of which q (1-q)^2 times the step's length is less than
 * any; the second less than BLUR q: q is at least TILE_LEAST_VARIATION times |C^-1|, so 12 u are less than half of that.
 * Then BLURRED makes up for them. */
#define BLUR 0x1p-10
#define BLURRED (ROUNDED_UP * (1 + 2 * BLUR))

/* The columns of C over their lengths in space are at most 1 long: a determinant below this proves nothing, and squares
 * under it vanish. */
#define NO_ANGLE 0x1p-400

/* A contraction that a few halvings, each of which takes about half of it, bring below 1. What is beyond has clip.c, which
 * refines across the ray alone. */
#define WORTH_HALVING 4096

#endif
