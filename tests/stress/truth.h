/* What a ray must meet, may meet and must not meet; and the two bands between. With u = 2^-53, E the largest distance of a
 * control point from the origin, O that of the ray's origin, L = E + O (lengths, for the rounding of a dot product with a
 * unit normal is relative to the product of the lengths), D the diagonal of the control points' box:
 *
 * What is given. A surface is given by doubles, so the true shape is moved by half a unit in the last place of each
 * coordinate, u E in space, and of each weight: that moves a point of the surface, a mean of control points, by at most u
 * times the largest distance to one of them, 2 u E. A trim's own points, in domains as large as the surface, add one.
 *     INPUT_ROUNDINGS u E = 4 u E: 2 units in the last place of E.
 * A root that stays wherever the surface moves by this band, and does not leave the shape's border or trims by it, is one of
 * the surface that was given: it must be met.
 *
 * What is computed. A method that works in double knows its equations to some R only. Its patches' points are rounded once
 * (patch.c: 2 u of the radius, u of the middle's distance from the origin, and u E where weights were multiplied in); n more
 * are those of evaluating a patch and of the plane equations (patch_rounding in nurbs/certify.c), at most 4 (k_u + k_v) - 6
 * and 27, relative to the patch's radius, D at most, and the distance of its middle from the ray's origin, L at most. So R =
 * (4 (k_u + k_v) + 23) u (L + D). To miss nothing it must take for a hit what R cannot tell from one, and its numbers are off
 * by R themselves: a ray may pass at 2 R and be met. A quarter of R more is what it needs to decide at all (ON_THE_RAY in
 * nurbs/clip.c). Restricting a patch to boxes adds its own (`lost` in nurbs/view.h), to both, less than R / 9 but where a
 * needle is narrowed often:
 *     BAND_SHARE R = 2.5 (4 (k_u + k_v) + 23) u (L + D): for bicubics 69 units in the last place of L + D.
 * What passes at more must not be met.
 *
 * lo and hi say where along the ray a root may move to by the second band. A hit is held to TRUTH_ERROR L; if the ray
 * grazes, so that they are farther apart, to [lo, hi]. */
#ifndef TRIMRAY_STRESS_TRUTH_H
#define TRIMRAY_STRESS_TRUTH_H

#include "tests/stress/form.h"
#include "render/ray.h"

#define INPUT_ROUNDINGS 4
#define BAND_SHARE 2.5
#define TRUTH_ERROR 1e-12

typedef struct {
    long double t, lo, hi;       /* in units of the ray's direction; of a cluster t is any place in it */
    bool is_odd;                 /* the number of roots in [lo, hi] is odd: one at least stays */
    bool is_inside;              /* clear of the border */
    bool is_must;                /* [lo, hi] has a root that must be met, though what is computed may not tell which */
} TruthRoot;
/* Whoever computes within the band meets this one, and knows it for one root. */
static inline bool truth_is_sure(const TruthRoot *r) { return r->is_odd && r->is_inside; }

#define TRUTH_MAX 64
typedef struct {
    int n;
    TruthRoot root[TRUTH_MAX];   /* ascending */
    long double length;          /* what errors of t are relative to: L in units of the ray's direction */
} Truth;

/* Is the point of the form, given in its own coordinates, kept by a trim: the distance to its edge in these coordinates,
 * negative if not. NULL: no trim. */
typedef Quad (*TruthKept)(const void *context, Quad3 p);

typedef struct {
    Form form;
    QuadMap to_world, to_local;
    double extent, diagonal;     /* E, D */
    int k_sum;                   /* k_u + k_v */
    TruthKept kept;
    const void *kept_context;
} FormInWorld;

long double truth_length(const FormInWorld *f, const Ray *r);   /* Truth.length */
double truth_band(const FormInWorld *f, const Ray *r);          /* what is computed */
double truth_input_band(const FormInWorld *f);                  /* what is given */

/* All that the ray's line meets, whatever its t_min. */
void truth_of_form(const FormInWorld *f, const Ray *r, Truth *out);

/* Adds a root where it belongs in order; it overlaps none. */
void truth_add(Truth *t, TruthRoot root);

/* Is there a root in doubt: sure by the input's band, perhaps, but not by this one? */
bool truth_is_in_doubt(const Truth *t);

/* Notes what must be met, given the truth by the input's band (NULL: nothing is in doubt). */
void truth_note_musts(Truth *t, const Truth *by_input);

#endif
