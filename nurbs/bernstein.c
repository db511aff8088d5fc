/* Sign changes of polynomials by subdivision. See bernstein.h. */
#include "nurbs/bernstein.h"

#include <string.h>

/* Deeper than this an interval is as short as the spacing of its ends. */
#define MAX_HALVINGS 52

typedef struct { int n; const double *c; double noise; double *out; int n_out; } Search;

static int sign_of(const Search *s, double x) { return (x > s->noise) - (x < -s->noise); }

/* What has no sign is passed over; first and last: of those that have, 0 if none has. */
typedef struct { int first, last, changes; } Signs;

static Signs signs_of(const Search *s, const double c[])
{
    Signs found = { 0, 0, 0 };
    for (int i = 0; i < s->n; i++) {
        int sign = sign_of(s, c[i]);
        if (sign == 0) continue;
        if (found.first == 0) found.first = sign;
        else found.changes += sign != found.last;
        found.last = sign;
    }
    return found;
}

static double value_at(const Search *s, double t)
{
    double c[BERNSTEIN_MAX];
    memcpy(c, s->c, (size_t)s->n * sizeof *c);
    for (int q = 1; q < s->n; q++)
        for (int i = 0; i < s->n - q; i++) c[i] = (1 - t) * c[i] + t * c[i + 1];
    return c[0];
}

static void add(Search *s, double t)
{
    if (t < 1 && s->n_out < s->n - 1) s->out[s->n_out++] = t;
}

/* The sign is `before` at lo and another at hi. */
static void bisect(Search *s, double lo, double hi, int before)
{
    for (;;) {
        double middle = lo + (hi - lo) / 2;
        if (!(middle > lo && middle < hi)) break;
        double value = value_at(s, middle);
        if ((value > 0) - (value < 0) == before) lo = middle;
        else hi = middle;
    }
    add(s, hi);
}

static void halve(int n, double c[], double left[])
{
    for (int q = 0; q < n; q++) {
        left[q] = c[0];
        for (int i = 0; i < n - 1 - q; i++) c[i] = (c[i] + c[i + 1]) / 2;
    }
}

/* c: the coefficients over [lo, hi]; destroyed. */
static void search(Search *s, double c[], double lo, double hi, int halvings)
{
    Signs signs = signs_of(s, c);
    if (signs.changes == 0) return;
    double middle = (lo + hi) / 2;
    if (signs.changes == 1) {
        bisect(s, lo, hi, signs.first);
    } else if (halvings == MAX_HALVINGS) {
        if (signs.first != signs.last) add(s, middle);
    } else {
        double left[BERNSTEIN_MAX];
        halve(s->n, c, left);
        int before = signs_of(s, left).last, after = signs_of(s, c).first;
        search(s, left, lo, middle, halvings + 1);
        if (before * after < 0) add(s, middle);   /* the root is at the middle: neither half sees it */
        search(s, c, middle, hi, halvings + 1);
    }
}

int bernstein_turns(int n, const double c[], double noise, double out[])
{
    double copy[BERNSTEIN_MAX];
    Search s = { n, c, noise, out, 0 };
    memcpy(copy, c, (size_t)n * sizeof *copy);
    search(&s, copy, 0, 1, 0);
    return s.n_out;
}
