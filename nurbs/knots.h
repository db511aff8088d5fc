/* Knot vectors: n + k knots for n control points of order k. The one place where knots are compared, and that is with ==. */
#ifndef TRIMRAY_KNOTS_H
#define TRIMRAY_KNOTS_H

#include "nurbs/nurbs.h"

/* Are these n + k numbers a knot vector? They must be finite and not decrease, no value may come more than k times (k times
 * inside the domain is a C^-1 break), and the domain [tau[k-1], tau[n]] must not be empty. If not: false, and error's code,
 * index, other and value are set; the rest of *error is left alone. */
bool knots_are_valid(int k, int n, const double tau[], NurbsError *error);

/* The span of t: mu with tau[mu] <= t < tau[mu+1], k-1 <= mu < n. The last span of the domain is closed; t outside the
 * domain is taken to its nearer end. */
int knots_span(int k, int n, const double tau[], double t);

/* The same from the other side: tau[mu] < t <= tau[mu+1], the first span of the domain closed. */
int knots_span_left(int k, int n, const double tau[], double t);

/* Is the span mu not empty? */
static inline bool knots_is_span(const double tau[], int mu) { return tau[mu] < tau[mu + 1]; }

/* How many of the knots equal t? */
int knots_multiplicity(int count, const double tau[], double t);

/* Where a curve over these knots may have a corner or a gap: the ends of the domain, and between them every knot that comes
 * k-1 times or more, each once, ascending. Returns their number, 2 at least; room for n - k + 2 in out. */
int knots_breaks(int k, int n, const double tau[], double out[]);

#endif
