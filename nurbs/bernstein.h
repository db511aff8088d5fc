/* Polynomials in one variable over [0, 1], in Bernstein form: n coefficients, degree n - 1. */
#ifndef TRIMRAY_BERNSTEIN_H
#define TRIMRAY_BERNSTEIN_H

/* The product of two orders 32 has this many at most. */
#define BERNSTEIN_MAX 63

/* Where the polynomial changes its sign in (0, 1), ascending; returns how many, n - 1 at most. What is not larger than
 * `noise` has no sign. None is missed and none is invented: the number of sign changes among the coefficients is that of
 * the roots or larger by an even number (Descartes' rule in Bernstein's basis), so an interval with none has no root, one
 * with one has one, and others are halved; each place is then bisected to the last bit of s. */
int bernstein_turns(int n, const double c[], double noise, double out[]);

#endif
