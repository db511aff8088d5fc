/* Numbers of twice the precision of a double: the unevaluated sum of two, |lo| <= ulp(hi) / 2. For the few places where a
 * decision must be that of exact arithmetic. [JMP17] M. Joldes, J.-M. Muller, V. Popescu, Tight and Rigorous Error Bounds
 * for Basic Building Blocks of Double-Word Arithmetic, ACM TOMS 44(2), 2017.
 *
 * Sums and products err by less than 2^-103 of themselves (their algorithms 6 and 12: 3 u^2 and 5 u^2, u = 2^-53), as
 * long as nothing under- or overflows. Not for files that are compiled with contraction. */
#ifndef TRIMRAY_WIDE_H
#define TRIMRAY_WIDE_H

#include <math.h>
#include <stdbool.h>

typedef struct { double hi, lo; } Wide;

#define WIDE_UNIT 0x1p-103

static inline Wide wide(double x) { return (Wide){ x, 0 }; }

static inline Wide wide_sum(double a, double b)                     /* exact */
{
    double s = a + b, t = s - a;
    return (Wide){ s, (a - (s - t)) + (b - t) };
}

static inline Wide wide_fast_sum(double a, double b)                /* exact where |a| >= |b| */
{
    double s = a + b;
    return (Wide){ s, b - (s - a) };
}

static inline Wide wide_product(double a, double b)                 /* exact */
{
    double p = a * b;
    return (Wide){ p, fma(a, b, -p) };
}

static inline Wide wide_neg(Wide a) { return (Wide){ -a.hi, -a.lo }; }

static inline Wide wide_add(Wide a, Wide b)                         /* [JMP17] AccurateDWPlusDW */
{
    Wide s = wide_sum(a.hi, b.hi), t = wide_sum(a.lo, b.lo), v = wide_fast_sum(s.hi, s.lo + t.hi);
    return wide_fast_sum(v.hi, t.lo + v.lo);
}

static inline Wide wide_sub(Wide a, Wide b) { return wide_add(a, wide_neg(b)); }

static inline Wide wide_mul(Wide a, Wide b)                         /* [JMP17] DWTimesDW3 */
{
    Wide c = wide_product(a.hi, b.hi);
    double t = fma(a.lo, b.hi, fma(a.hi, b.lo, a.lo * b.lo));
    return wide_fast_sum(c.hi, c.lo + t);
}

/* The quotient of the first parts, corrected once; the rest is exact but for 2 roundings of its smaller part. Errs by
 * less than 2^-100 of itself. */
static inline Wide wide_div(Wide a, Wide b)
{
    double q = a.hi / b.hi, rest = fma(-q, b.hi, a.hi) + (a.lo - q * b.lo);
    return isfinite(q) ? wide_fast_sum(q, rest / b.hi) : wide(q);
}

static inline bool wide_less(Wide a, Wide b) { return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo); }

static inline Wide wide_lerp(Wide a, Wide b, Wide s)                /* exact at s = 0 and s = 1 */
{
    return wide_add(wide_mul(wide_sub(wide(1), s), a), wide_mul(s, b));
}

#endif
