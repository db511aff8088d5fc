/* For the oracle alone: Bezier nets in ball arithmetic. */
#ifndef TRIMRAY_TESTS_ORACLE_NET_H
#define TRIMRAY_TESTS_ORACLE_NET_H

#include "tests/oracle.h"

#include <arb.h>

#define ORACLE_BITS 320      /* what is lost by cancelling and dividing leaves far more than 1e-30 */

/* Bezier coefficient r of the span mu, from the B-spline coefficients mu - k + 1 ... mu, which are used up. */
void oracle_bezier_point(int k, const double tau[], int mu, int r, arb_ptr coefficients, arb_t out);

/* m[r*k + i]: what of B-spline coefficient mu - k + 1 + i is in Bezier coefficient r. */
void oracle_span_matrix(int k, const double tau[], int mu, arb_ptr m);

/* Coefficients c[0], c[stride], ... c[(k-1) stride] of a Bezier polynomial: */
void oracle_row_halve(arb_ptr c, arb_ptr right, slong stride, int k);              /* c becomes the left half */
void oracle_row_restrict(arb_ptr c, slong stride, int k, const arb_t x0, const arb_t x1);   /* to [x0, x1] of [0, 1] */

/* Fixed point, for nets that are halved again and again: each coefficient a multiple of one unit, which is FIXED_BITS below
 * the largest. */
__extension__ typedef __int128 Fixed;
enum { FIXED_BITS = 120 };
double oracle_to_fixed(arb_srcptr c, int n, Fixed *out);             /* returns the unit; each is off by one at most */
void oracle_fixed_halve(Fixed *c, Fixed *right, int stride, int k);  /* c becomes the left half; (k-1)/2 are added */

/* The value and the derivatives at (s, t) of a net of k_u by k_v coefficients. */
void oracle_net_at(arb_srcptr c, int k_u, int k_v, const arb_t s, const arb_t t, arb_t value, arb_t by_s, arb_t by_t);

double oracle_double(const arb_t x);     /* the nearest, or so */
double oracle_radius(const arb_t x);     /* |x - oracle_double(x)| is at most this */

#endif
