/* What a ray must meet, may meet and must not meet; and the band between.
 *
 * The band. A surface is given by doubles, and the true shape differs from the given one by their rounding: half a unit
 * in the last place of each coordinate and weight moves a point by up to (sqrt(3)/2 + 1) 2^-52 L, L the largest
 * coordinates in sight (of the control points, plus those of the ray's origin). Whoever works in double adds the
 * roundings of Bezier extraction, evaluation and the plane equations: 2 (k_u + k_v + 8) of 2^-53 L (patch_rounding in
 * nurbs/certify.h); that much is at stake at each end of a decision, and once more for what lies between the two ends. So
 * `band` = BAND_ROUNDINGS (k_u + k_v + 8) 2^-53 L is the distance by which a ray and a surface may pass or miss each
 * other unnoticed:
 *   - a root is sure if it stays, wherever the surface moves by up to the band along its normal, and does not leave the
 *     shape's border by it; all others may be met or not;
 *   - lo and hi say where along the ray it may move to. Where that is more than TRUTH_ERROR L, the ray grazes, and the
 *     hit is held to [lo, hi] instead of to TRUTH_ERROR. */
#ifndef TRIMRAY_STRESS_TRUTH_H
#define TRIMRAY_STRESS_TRUTH_H

#include "tests/stress/form.h"
#include "render/ray.h"

#define BAND_ROUNDINGS 8
#define TRUTH_ERROR 1e-12

typedef struct {
    long double t, lo, hi;       /* in units of the ray's direction; of a cluster t is any place in it */
    bool is_odd;                 /* the number of roots in [lo, hi] is odd: one at least stays */
    bool is_inside;              /* clear of the border */
} TruthRoot;
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
    double extent;               /* largest coordinate of the control points */
    int k_sum;                   /* k_u + k_v */
    TruthKept kept;
    const void *kept_context;
} FormInWorld;

long double truth_length(const FormInWorld *f, const Ray *r);   /* Truth.length */
double truth_band(const FormInWorld *f, const Ray *r);

/* All that the ray's line meets, whatever its t_min. */
void truth_of_form(const FormInWorld *f, const Ray *r, Truth *out);

/* Adds a root where it belongs in order; it overlaps none. */
void truth_add(Truth *t, TruthRoot root);

#endif
