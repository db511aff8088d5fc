/* The recurrence of Cox and de Boor as [MCFS00] section 2 and [PT97] (2.5), (2.9) write it:
 *
 *   N_{j,1} = 1 on the span mu, else 0
 *   N_{j,m} = (t - tau_j) / (tau_{j+m-1} - tau_j) N_{j,m-1} + (tau_{j+m} - t) / (tau_{j+m} - tau_{j+1}) N_{j+1,m-1}
 *   N'_{j,m} = (m-1) (N_{j,m-1} / (tau_{j+m-1} - tau_j) - N_{j+1,m-1} / (tau_{j+m} - tau_{j+1}))
 *
 * A term whose N of order m-1 vanishes is 0 whatever its denominator; the others have denominators that span mu, so > 0. */
#include "nurbs/basis.h"

#include "nurbs/nurbs.h"

/* N[j - mu + m - 1] for j = mu-m+1 .. mu holds order m; outside this range functions of order m vanish on the span. */
static double at(const double N[], int m, int mu, int j)
{
    return j < mu - m + 1 || j > mu ? 0 : N[j - mu + m - 1];
}

static double over(double value, double denominator) { return value == 0 ? 0 : value / denominator; }

static void raise_order(const double tau[], int mu, double t, int m, const double below[], double N[])
{
    for (int j = mu - m + 1; j <= mu; j++)
        N[j - mu + m - 1] = over((t - tau[j]) * at(below, m - 1, mu, j), tau[j + m - 1] - tau[j])
                          + over((tau[j + m] - t) * at(below, m - 1, mu, j + 1), tau[j + m] - tau[j + 1]);
}

static void differentiate(const double tau[], int mu, int m, const double below[], double N[])
{
    for (int j = mu - m + 1; j <= mu; j++)
        N[j - mu + m - 1] = (m - 1) * (over(at(below, m - 1, mu, j), tau[j + m - 1] - tau[j])
                                     - over(at(below, m - 1, mu, j + 1), tau[j + m] - tau[j + 1]));
}

void basis_derivative(int k, const double tau[], int mu, double t, int r, double out[])
{
    double below[NURBS_MAX_ORDER];
    out[0] = r < k;
    for (int m = 2; m <= k; m++) {
        for (int i = 0; i < m - 1; i++) below[i] = out[i];
        if (m <= k - r) raise_order(tau, mu, t, m, below, out);
        else differentiate(tau, mu, m, below, out);
    }
}
