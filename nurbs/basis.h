/* B-spline basis functions and their derivatives from the definition: clear, slow, the reference for everything else. */
#ifndef TRIMRAY_BASIS_H
#define TRIMRAY_BASIS_H

/* The r-th derivative at t of the k basis functions that do not vanish on the span mu (tau[mu] < tau[mu+1]): out[i] belongs
 * to the control point mu-k+1+i. t is in the span or at either end of it: at its upper end this is the limit from below.
 * r = 0: the values. r >= k: all 0. Error: each value and derivative is a sum of products of the same sign over differences
 * of knots, some 4k roundings deep ([PT97] section 2.5). */
void basis_derivative(int k, const double tau[], int mu, double t, int r, double out[]);

#endif
