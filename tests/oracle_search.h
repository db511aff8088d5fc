/* For the oracle alone: a surface as Bezier nets, what a search for roots knows, and the proof of a root. */
#ifndef TRIMRAY_TESTS_ORACLE_SEARCH_H
#define TRIMRAY_TESTS_ORACLE_SEARCH_H

#include "tests/oracle_net.h"

#include <math.h>

enum { A, B, T, W, NETS };       /* nets of a ray: the two planes, the numerator of t, the weight */

typedef struct { Vec3 centre; double radius; } Ball;

struct Oracle {
    int k[2], spans[2], n;       /* n: coefficients of a patch */
    double *breaks[2];           /* spans + 1 each */
    arb_ptr *patch;              /* for each span (u fastest): n of wx, then of wy, wz, w */
    Ball *ball;                  /* of each span: contains it */
};

typedef struct { double lo[2], hi[2]; } Area;           /* of the parameter plane */

/* There is no other root in `alone`. counts: on the domain, and not found before. */
typedef struct { Area alone; OracleRoot root; bool counts; } Found;

typedef struct {
    const Oracle *o;
    double band;
    double speed;            /* |d|: how much longer the ray is than t */
    double enough;           /* boxes of that size are not split, if there is a band */
    arb_ptr rows;            /* n1, n2 and d / d.d: the rows that make nets of patches */
    arb_ptr origin;
    arb_ptr *net;            /* of each span, NETS * n, or NULL: not needed yet */
    Found *found;
    OracleRoot *clusters;
    int n_found, n_clusters, n_boxes;
} Search;

void oracle_begin_search(Search *k, const Oracle *o, const Ray *r, double band);
void oracle_end_search(Search *k);
arb_srcptr oracle_net_of(Search *k, int span);   /* NETS * n coefficients */

/* Is the span's ball farther from the ray than the band? */
bool oracle_is_far(const Oracle *o, int span, const Ray *r, double band);

/* ---- nets in double ---- */

typedef struct { double *c, margin; } Rounded;          /* NETS * n coefficients; the components are off by margin at most */
void oracle_round_net(const Oracle *o, arb_srcptr net, double *room, Rounded *out);

typedef struct { double lo, hi; } Range;
static inline Range range_add(Range r, double x) { return (Range){ fmin(r.lo, x), fmax(r.hi, x) }; }
static const Range range_empty = { INFINITY, -INFINITY };

/* The derivative's coefficients along an axis, over a box of unit length. */
Range oracle_derivative_range(const Oracle *o, const double *c, int axis);

typedef struct { double j[2][2]; } Matrix;              /* j[component][axis] */

/* ---- proof ---- */

/* Looks for an area about this one that has exactly one root, and notes it in k->found. Returns whether there is one; it
 * covers this one. `net` is the box's: where Newton's method begins. */
bool oracle_certify(Search *k, const Area *box, const Rounded *net);

/* Makes room for one more element: every time that n is a power of two, the list doubles. */
void *oracle_grow(void *list, int n, size_t size);

#endif
