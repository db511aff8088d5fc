/* Trimmed NURBS surfaces, intersected directly: the library's public header.
 *
 * Conventions, everywhere in nurbs/: the order k is the degree + 1; n control points along a direction have n + k knots;
 * the u index runs fastest, p[j*n_u + i]; points are homogeneous {wx, wy, wz, w} inside and Euclidean {x, y, z, weight} only
 * at this door; knot spans are half open, the last one closed; knots are compared with ==. The domain is
 * [knots_u[k_u-1], knots_u[n_u]] x [knots_v[k_v-1], knots_v[n_v]].
 */
#ifndef TRIMRAY_NURBS_H
#define TRIMRAY_NURBS_H

#include "render/arena.h"
#include "render/vec.h"

#include <stdbool.h>

#define NURBS_MIN_ORDER 2
#define NURBS_MAX_ORDER 32

struct Shape;

/* A B-spline curve in the (u, v) plane: n points {u, v, weight}, n + order knots. */
typedef struct {
    int order, n;
    const double *knots;
    const Vec3 *points;
} TrimCurveDesc;

/* A closed loop: curves end to start. A polyline is one curve of order 2 whose knots are NULL (uniform), closed by joining
 * the last point to the first. */
typedef struct {
    const TrimCurveDesc *curves;
    int n_curves;
    bool is_polyline;
} TrimLoopDesc;

typedef struct {
    int order_u, order_v;
    int n_u, n_v;
    const double *knots_u, *knots_v;
    const Vec4 *points;              /* n_u * n_v, Euclidean, with weight */
    const TrimLoopDesc *trims;
    int n_trims;
    bool keep_left;                  /* the side of a trim that is kept; false: the right, the seed paper's rule */
} SurfaceDesc;

typedef enum {
    NURBS_METHOD_PAPER,              /* [MCFS00], as published: newton.h */
    NURBS_METHOD_CERTAIN             /* never a missed hit: certify.h */
} NurbsMethod;
typedef enum { NURBS_FLATTENING_CURVATURE, NURBS_FLATTENING_ADAPTIVE } NurbsFlattening;

typedef struct {
    NurbsMethod method;
    NurbsFlattening flattening;
    double flatness;                 /* C of [MCFS00] section 2.1, or the chord bound of the adaptive scheme; 0: chosen */
    int max_iterations;              /* MAXITER of section 2.3; 0: the default */
    double leaf_variation;           /* method certain: how much a leaf's derivatives may vary; 0: as tile_tree.h has it */
} NurbsOptions;

typedef enum {
    NURBS_OK,
    NURBS_BAD_ORDER,                 /* index: 0 u, 1 v, or the curve of a trim */
    NURBS_TOO_FEW_POINTS,            /* fewer than the order */
    NURBS_KNOTS_DECREASE,            /* index: the knot that is less than the one before it */
    NURBS_KNOT_NOT_FINITE,
    NURBS_KNOT_MULTIPLICITY,         /* index: the first of the knots that are too many; other: how many are allowed */
    NURBS_EMPTY_DOMAIN,
    NURBS_BAD_WEIGHT,                /* index: the point; zero, negative or not finite */
    NURBS_POINT_NOT_FINITE,          /* index: the point */
    NURBS_TRIM_TOO_SHORT,            /* index: the trim; a polyline of under three points */
    NURBS_TRIM_OPEN,                 /* index: the trim; other: the curve that does not start where the last one ended */
    NURBS_TRIM_OUTSIDE,              /* index: the trim; u, v: how far out, at its worst */
    NURBS_TRIMS_CROSS,               /* index, other: the trims (equal: it crosses itself); u, v: where */
    NURBS_TRIMS_CONFLICT             /* index, other: two trims of one level with different directions */
} NurbsCode;

typedef enum { NURBS_IN_SURFACE_U, NURBS_IN_SURFACE_V, NURBS_IN_SURFACE_POINTS, NURBS_IN_TRIM } NurbsWhere;

/* What is wrong, for the caller to put in words and to give a place. */
typedef struct {
    NurbsCode code;
    NurbsWhere where;
    int trim, curve;                 /* with NURBS_IN_TRIM, and for errors of trims: which; -1: none */
    int index, other;
    double u, v;
    double value;                    /* the offending number, gap or distance, where there is one */
} NurbsError;

/* What was mended: a trim that leaves the domain by more than 1e-6 (clamped), a shallow crossing. */
typedef enum { NURBS_WARN_TRIM_CLAMPED, NURBS_WARN_TRIM_BRIDGED, NURBS_WARN_TRIM_CROSSING } NurbsWarningCode;
typedef struct { NurbsWarningCode code; int trim, other; double u, v, value; } NurbsWarning;

/* A shape (render/shape.h) of the surface, in the arena; everything in `desc` is copied. NULL: *error says why. Warnings (at
 * most max_warnings, room for them given by the caller) are counted in *n_warnings; both may be NULL and 0. */
struct Shape *nurbs_shape_new(Arena *a, const SurfaceDesc *desc, const NurbsOptions *options, NurbsError *error,
                              NurbsWarning *warnings, int max_warnings, int *n_warnings);

/* For `check` and --stats: what this surface does not need. */
typedef struct {
    bool is_polynomial;              /* all weights equal: evaluated without division */
    bool has_trims;                  /* a trim structure exists (one that keeps the whole domain is dropped) */
    int n_trims, n_trim_pieces;
    int n_leaves, n_leaves_trimmed_away, n_leaves_untested;   /* after preparation: kept; never built; without trim test */
    bool was_prepared;
    double prep_seconds;
    size_t bytes;                    /* held after preparation */
} NurbsInfo;
bool nurbs_shape_info(const struct Shape *s, NurbsInfo *out);    /* false: s is not a NURBS shape */

/* The point S(u, v) and its first partial derivatives, by the reference evaluation (slow and clear); u, v are clamped to the
 * domain. */
bool nurbs_shape_point(const struct Shape *s, double u, double v, Vec3 *point, Vec3 *s_u, Vec3 *s_v);

#endif
