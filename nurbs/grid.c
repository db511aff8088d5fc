#include "nurbs/grid.h"

#include "nurbs/knots.h"

static GridAxis axis_make(Arena *a, int k, int n, const double *tau)
{
    int *mu = ARENA_ARRAY(a, int, n), *stretch = ARENA_ARRAY(a, int, n), n_spans = 0, now = 0;
    bool *has_gap = ARENA_ARRAY(a, bool, n);
    for (int i = k - 1; i < n; i++) {
        if (!knots_is_span(tau, i)) continue;
        int multiplicity = n_spans > 0 ? knots_multiplicity(n + k, tau, tau[i]) : 0;
        if (multiplicity >= k - 1) now++;
        mu[n_spans] = i, stretch[n_spans] = now, has_gap[n_spans] = multiplicity >= k;
        n_spans++;
    }
    return (GridAxis){ tau, n_spans, mu, stretch, has_gap };
}

Grid grid_make(Arena *a, const Surface *s)
{
    return (Grid){ s, axis_make(a, s->k_u, s->n_u, s->tau_u), axis_make(a, s->k_v, s->n_v, s->tau_v) };
}

double grid_param(const GridAxis *axis, int span, int64_t local)
{
    double from = axis->tau[axis->mu[span]], to = axis->tau[axis->mu[span] + 1];
    return local == GRID_SPAN ? to : from + (to - from) * ((double)local / (double)GRID_SPAN);
}

int64_t grid_local(const GridAxis *axis, int span, double t)
{
    double from = axis->tau[axis->mu[span]], to = axis->tau[axis->mu[span] + 1];
    return (int64_t)rint(fmin(fmax((t - from) / (to - from), 0), 1) * (double)GRID_SPAN);
}

int grid_span(const GridAxis *axis, double t)
{
    int lo = 0, hi = axis->n;
    while (hi - lo > 1) {
        int middle = lo + (hi - lo) / 2;
        if (axis->tau[axis->mu[middle]] <= t) lo = middle;
        else hi = middle;
    }
    return lo;
}
