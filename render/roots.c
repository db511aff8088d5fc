/* Real roots up to the quartic. Between two neighbouring extrema a polynomial is monotone: it has one root there if its
 * signs at the two ends differ, none if they agree. So the roots of the derivative (found in the same way, down to the
 * quadratic) isolate the roots, and a bracketed Newton iteration finds each of them: no trigonometry, no resolvent, no
 * case that loses digits. Where a value is within its own rounding error it counts as zero, which is how double roots are
 * seen. */
#include "render/roots.h"

#include <math.h>
#include <stdbool.h>

/* Relative to sum |c_i x^i|: Horner's scheme is within 2n u of it, u = 2^-53 ([Hig02], section 5.1); n <= 4. */
static const double EVALUATION_ERROR = 8 * 0x1p-53;

typedef struct { double value, error, slope; } Evaluation;

static Evaluation evaluate(int n, const double *c, double x)
{
    Evaluation e = { c[n], 0, 0 };
    double magnitude = fabs(c[n]), ax = fabs(x);
    for (int i = n - 1; i >= 0; i--) {
        e.slope = e.slope * x + e.value;
        e.value = e.value * x + c[i];
        magnitude = magnitude * ax + fabs(c[i]);
    }
    e.error = EVALUATION_ERROR * magnitude;
    return e;
}

static int sign_at(int n, const double *c, double x)
{
    Evaluation e = evaluate(n, c, x);
    return e.value > e.error ? 1 : e.value < -e.error ? -1 : 0;
}

/* The root in (lo, hi), where the polynomial is monotone and rising if `rises`: Newton's steps while they stay in the
 * bracket and shrink it, halving otherwise; ends when the step no longer moves x. */
static double bracketed_root(int n, const double *c, double lo, double hi, bool rises)
{
    double x = lo + .5 * (hi - lo), before = hi - lo;
    for (int i = 0; i < 200; i++) {                          /* 64 halvings or so suffice even for lo = 0 */
        Evaluation e = evaluate(n, c, x);
        if (e.value == 0) return x;
        if ((e.value > 0) == rises) hi = x;
        else lo = x;
        double next = x - e.value / e.slope;
        if (!(next > lo && next < hi && fabs(next - x) < .5 * before)) next = lo + .5 * (hi - lo);
        before = fabs(next - x);
        if (next == x || next == lo || next == hi) return fabs(e.value) <= e.error ? x : next;
        x = next;
    }
    return x;
}

/* Discriminant b^2 - ac with the product's rounding error recovered by fma, so that a double root is seen as one. */
static double difference_of_products(double b, double a, double c)
{
    double ac = a * c;
    return fma(b, b, -ac) + fma(-a, c, ac);
}

static int linear(const double c[2], double x[1])
{
    if (c[1] == 0) return 0;
    x[0] = -c[0] / c[1];
    return isfinite(x[0]) ? 1 : 0;
}

/* Powers of two, so that no product over- or underflows: the largest coefficient is brought into [1/2, 1). */
static bool scale_coefficients(int n, const double *c, double *out)
{
    double largest = 0;
    for (int i = 0; i <= n; i++) largest = fmax(largest, fabs(c[i]));
    if (!(largest > 0)) return false;
    int exponent;
    (void)frexp(largest, &exponent);
    for (int i = 0; i <= n; i++) out[i] = ldexp(c[i], -exponent);
    return true;
}

int roots_quadratic(const double given[3], double x[2])
{
    double s[3];
    if (!scale_coefficients(2, given, s)) return 0;
    double a = s[2], b = -.5 * s[1], c = s[0];               /* a x^2 - 2 b x + c */
    if (a == 0) return linear(s, x);
    double d = difference_of_products(b, a, c);
    if (fabs(d) <= EVALUATION_ERROR * (b * b + fabs(a * c))) {
        x[0] = x[1] = b / a;
        return isfinite(x[0]) ? 2 : 0;
    }
    if (d < 0) return 0;
    double q = b + copysign(sqrt(d), b), x1 = q / a, x2 = c / q;
    if (!isfinite(x1)) {                                     /* a is negligible: the other root alone is a number */
        x[0] = x2;
        return 1;
    }
    x[0] = fmin(x1, x2);
    x[1] = fmax(x1, x2);
    return 2;
}

/* What the walk from extremum to extremum remembers: the last sign that was not zero, and the points since then that
 * were. */
typedef struct { int sign, n_zeros, n; double zero, *x; } Walk;

/* The next point of the walk: nothing, one crossing, or a touch. */
static void step(Walk *w, int n, const double *c, double from, double to, int sign)
{
    if (sign == 0) {
        if (w->n_zeros++ == 0 || fabs(evaluate(n, c, to).value) < fabs(evaluate(n, c, w->zero).value)) w->zero = to;
        return;
    }
    bool crosses = w->sign != 0 && sign != w->sign;
    if (w->n_zeros > 0) {
        w->x[w->n++] = w->zero;
        if (!crosses && w->sign != 0 && w->n < n) w->x[w->n++] = w->zero;
    } else if (crosses) {
        w->x[w->n++] = bracketed_root(n, c, from, to, sign > 0);
    }
    w->sign = sign;
    w->n_zeros = 0;
}

static int degree_of(int n, const double *c)
{
    while (n > 0 && c[n] == 0) n--;
    return n;
}

static int between(int n, const double *c, double lo, double hi, double *x);

/* The places in (lo, hi) where the derivative vanishes. */
static int extrema(int n, const double *c, double lo, double hi, double *x)
{
    double derivative[ROOTS_MAX_DEGREE] = { 0 };
    for (int i = 1; i <= n; i++) derivative[i - 1] = i * c[i];
    return between(n - 1, derivative, lo, hi, x);
}

static int keep_between(double lo, double hi, int n, double *x)
{
    int kept = 0;
    for (int i = 0; i < n; i++)
        if (x[i] >= lo && x[i] <= hi) x[kept++] = x[i];
    return kept;
}

static int between(int n, const double *c, double lo, double hi, double *x)
{
    n = degree_of(n, c);
    if (n == 0) return 0;
    if (n == 1) return keep_between(lo, hi, linear(c, x), x);
    if (n == 2) return keep_between(lo, hi, roots_quadratic(c, x), x);
    double at[ROOTS_MAX_DEGREE];
    int n_at = extrema(n, c, lo, hi, at);
    Walk w = { .x = x };
    step(&w, n, c, lo, lo, sign_at(n, c, lo));
    for (int i = 0; i < n_at; i++) step(&w, n, c, i > 0 ? at[i - 1] : lo, at[i], sign_at(n, c, at[i]));
    step(&w, n, c, n_at > 0 ? at[n_at - 1] : lo, hi, sign_at(n, c, hi));
    if (w.n_zeros > 0 && w.n < n) x[w.n++] = w.zero;
    return w.n;
}

int roots_between(int n, const double *c, double lo, double hi, double *x)
{
    double scaled[ROOTS_MAX_DEGREE + 1];
    return scale_coefficients(n, c, scaled) ? between(n, scaled, lo, hi, x) : 0;
}

/* Fujiwara's bound: no root is larger than twice the largest |c_i / c_n|^(1/(n-i)). */
static double root_bound(int n, const double *c)
{
    double bound = 0;
    for (int i = 0; i < n; i++)
        if (c[i] != 0) bound = fmax(bound, exp2((log2(fabs(c[i])) - log2(fabs(c[n]))) / (n - i)));
    return 2 * bound;
}

static int all_roots(int n, const double *c, double *x)
{
    double scaled[ROOTS_MAX_DEGREE + 1];
    if (!scale_coefficients(n, c, scaled)) return 0;
    n = degree_of(n, scaled);
    if (n == 0) return 0;
    double bound = fmin(2 * root_bound(n, scaled), 0x1p250);     /* its fourth power is still a number */
    return between(n, scaled, -bound, bound, x);
}

int roots_cubic(const double c[4], double x[3]) { return all_roots(3, c, x); }
int roots_quartic(const double c[5], double x[4]) { return all_roots(4, c, x); }
