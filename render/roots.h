/* Real roots of polynomials up to degree 4: found between the extrema, which are the roots of the derivative, as in
 * [Yuk22]; the quadratic in closed form without cancellation ([Gol91], section 1.4).
 *
 * Coefficients are in ascending order: c[0] + c[1] x + ... + c[n] x^n. Leading coefficients may be 0: the polynomial is
 * then of a lower degree. Coefficients must be finite. Results are ascending. A simple root is listed once; a point where
 * the polynomial touches zero without crossing is listed twice (so that the parity of the count is that of the
 * crossings); an inflection on the axis once. Touching is judged by the rounding error of evaluating the polynomial
 * there: at each listed x there are coefficients within a relative 2^-49 of those given for which x is a root. The zero
 * polynomial has no roots here. */
#ifndef TRIMRAY_ROOTS_H
#define TRIMRAY_ROOTS_H

#define ROOTS_MAX_DEGREE 4

int roots_quadratic(const double c[3], double x[2]);
int roots_cubic(const double c[4], double x[3]);
int roots_quartic(const double c[5], double x[4]);

/* The roots in [lo, hi] only, both finite; n is the degree, 1 to ROOTS_MAX_DEGREE. */
int roots_between(int n, const double *c, double lo, double hi, double *x);

#endif
