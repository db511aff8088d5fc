/* Knot vectors: validation, spans, multiplicities ([PT97] section 2.2). See knots.h. */
#include "nurbs/knots.h"

static bool knot_error(NurbsError *error, NurbsCode code, int index, int other, double value)
{
    error->code = code, error->index = index, error->other = other, error->value = value;
    return false;
}

bool knots_are_valid(int k, int n, const double tau[], NurbsError *error)
{
    int run = 0;   /* knots before and including i that equal tau[i] */
    for (int i = 0; i < n + k; i++) {
        if (!isfinite(tau[i])) return knot_error(error, NURBS_KNOT_NOT_FINITE, i, 0, tau[i]);
        if (i > 0 && tau[i] < tau[i - 1]) return knot_error(error, NURBS_KNOTS_DECREASE, i, i - 1, tau[i]);
        run = i > 0 && tau[i] == tau[i - 1] ? run + 1 : 1;
        if (run > k) return knot_error(error, NURBS_KNOT_MULTIPLICITY, i, k, tau[i]);
    }
    if (!(tau[k - 1] < tau[n])) return knot_error(error, NURBS_EMPTY_DOMAIN, k - 1, n, tau[k - 1]);
    return true;
}

int knots_span(int k, int n, const double tau[], double t)
{
    if (!(t < tau[n])) return knots_span_left(k, n, tau, tau[n]);
    int lo = k - 1, hi = n;                /* tau[lo] <= t < tau[hi], once t is in the domain */
    if (t < tau[lo]) t = tau[lo];
    while (hi - lo > 1) {
        int middle = lo + (hi - lo) / 2;
        if (t < tau[middle]) hi = middle; else lo = middle;
    }
    return lo;
}

int knots_span_left(int k, int n, const double tau[], double t)
{
    if (!(t > tau[k - 1])) return knots_span(k, n, tau, tau[k - 1]);
    int lo = k - 1, hi = n;                /* tau[lo] < t <= tau[hi], once t is in the domain */
    if (t > tau[hi]) t = tau[hi];
    while (hi - lo > 1) {
        int middle = lo + (hi - lo) / 2;
        if (tau[middle] < t) lo = middle; else hi = middle;
    }
    return lo;
}

int knots_multiplicity(int count, const double tau[], double t)
{
    int n = 0;
    for (int i = 0; i < count; i++) n += tau[i] == t;
    return n;
}

int knots_breaks(int k, int n, const double tau[], double out[])
{
    int n_breaks = 0;
    out[n_breaks++] = tau[k - 1];
    for (int i = k; i < n; ) {
        int run = 1;
        while (tau[i + run] == tau[i] && i + run < n + k - 1) run++;   /* runs inside the domain lie before tau[n] */
        if (tau[i] > tau[k - 1] && tau[i] < tau[n] && run >= k - 1) out[n_breaks++] = tau[i];
        i += run;
    }
    out[n_breaks++] = tau[n];
    return n_breaks;
}
