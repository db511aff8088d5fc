/* See oracle_net.h. */
#include "tests/oracle_net.h"

#include <math.h>

/* The blossom at k - 1 - r times tau[mu] and r times tau[mu+1]: de Boor's scheme with an argument of its own at each
 * level. */
void oracle_bezier_point(int k, const double tau[], int mu, int r, arb_ptr d, arb_t out)
{
    arb_t x, lo, hi, f;
    arb_init(x), arb_init(lo), arb_init(hi), arb_init(f);
    for (int level = 1; level < k; level++) {
        arb_set_d(x, level <= r ? tau[mu + 1] : tau[mu]);
        for (int i = k - 1; i >= level; i--) {
            int at = mu - k + 1 + i;
            arb_set_d(lo, tau[at]), arb_set_d(hi, tau[at + k - level]);
            arb_sub(f, x, lo, ORACLE_BITS), arb_sub(hi, hi, lo, ORACLE_BITS), arb_div(f, f, hi, ORACLE_BITS);
            arb_sub(hi, d + i, d + i - 1, ORACLE_BITS);   /* d[i-1] + (d[i] - d[i-1]) f */
            arb_mul(hi, hi, f, ORACLE_BITS), arb_add(d + i, d + i - 1, hi, ORACLE_BITS);
        }
    }
    arb_set(out, d + k - 1);
    arb_clear(x), arb_clear(lo), arb_clear(hi), arb_clear(f);
}

void oracle_span_matrix(int k, const double tau[], int mu, arb_ptr m)
{
    arb_ptr d = _arb_vec_init(k);
    for (int r = 0; r < k; r++)
        for (int unit = 0; unit < k; unit++) {
            for (int i = 0; i < k; i++) arb_set_si(d + i, i == unit);
            oracle_bezier_point(k, tau, mu, r, d, m + r * k + unit);
        }
    _arb_vec_clear(d, k);
}

void oracle_row_halve(arb_ptr c, arb_ptr right, slong stride, int k)
{
    arb_set(right + (k - 1) * stride, c + (k - 1) * stride);
    for (int level = 1; level < k; level++) {
        for (int i = k - 1; i >= level; i--) {
            arb_add(c + i * stride, c + (i - 1) * stride, c + i * stride, ORACLE_BITS);
            arb_mul_2exp_si(c + i * stride, c + i * stride, -1);
        }
        arb_set(right + (k - 1 - level) * stride, c + (k - 1) * stride);
    }
}

double oracle_to_fixed(arb_srcptr c, int n, Fixed *out)
{
    double largest = 0;
    for (int i = 0; i < n; i++) largest = fmax(largest, fabs(oracle_double(c + i)));
    int exponent = ilogb(fmax(largest, 0x1p-900)) + 1 - FIXED_BITS;   /* the unit is to be no subnormal */
    fmpz_t x;
    arf_t scaled;
    fmpz_init(x), arf_init(scaled);
    for (int i = 0; i < n; i++) {
        mp_limb_t hi, lo;
        arf_mul_2exp_si(scaled, arb_midref(c + i), -exponent);
        arf_get_fmpz(x, scaled, ARF_RND_NEAR);
        fmpz_get_signed_uiui(&hi, &lo, x);
        out[i] = (Fixed)(mp_limb_signed_t)hi * 0x10000 * 0x10000 * 0x10000 * 0x10000 + (Fixed)lo;
    }
    fmpz_clear(x), arf_clear(scaled);
    return ldexp(1, exponent);
}

void oracle_fixed_halve(Fixed *c, Fixed *right, int stride, int k)
{
    right[(k - 1) * stride] = c[(k - 1) * stride];
    for (int level = 1; level < k; level++) {
        for (int i = k - 1; i >= level; i--) c[i * stride] = (c[(i - 1) * stride] + c[i * stride]) >> 1;
        right[(k - 1 - level) * stride] = c[(k - 1) * stride];
    }
}

/* a = (1 - x) a + x b */
static void lerp(arb_t a, const arb_t b, const arb_t x, arb_t work)
{
    arb_sub(work, b, a, ORACLE_BITS);
    arb_addmul(a, work, x, ORACLE_BITS);
}

void oracle_row_restrict(arb_ptr c, slong stride, int k, const arb_t x0, const arb_t x1)
{
    arb_t x, y, work;
    arb_init(x), arb_init(y), arb_init(work);
    arb_sub_si(y, x1, 1, ORACLE_BITS), arb_neg(y, y);     /* backwards: towards the point before */
    for (int level = 1; level < k; level++)
        for (int i = k - 1; i >= level; i--) lerp(c + i * stride, c + (i - 1) * stride, y, work);
    arb_div(x, x0, x1, ORACLE_BITS);
    for (int level = 1; level < k; level++)
        for (int i = 0; i < k - level; i++) lerp(c + i * stride, c + (i + 1) * stride, x, work);
    arb_clear(x), arb_clear(y), arb_clear(work);
}

/* Value and derivative at x of k coefficients, which are used up. */
static void row_at(arb_ptr c, int k, const arb_t x, arb_t value, arb_t derivative)
{
    arb_t work;
    arb_init(work);
    for (int level = 1; level < k - 1; level++)
        for (int i = 0; i < k - level; i++) lerp(c + i, c + i + 1, x, work);
    arb_sub(derivative, c + 1, c, ORACLE_BITS);
    arb_mul_si(derivative, derivative, k - 1, ORACLE_BITS);
    lerp(c, c + 1, x, work);
    arb_set(value, c);
    arb_clear(work);
}

void oracle_net_at(arb_srcptr c, int k_u, int k_v, const arb_t s, const arb_t t, arb_t value, arb_t by_s, arb_t by_t)
{
    arb_ptr row = _arb_vec_init(k_u), values = _arb_vec_init(k_v), slopes = _arb_vec_init(k_v);
    arb_t unused;
    arb_init(unused);
    for (int j = 0; j < k_v; j++) {
        _arb_vec_set(row, c + j * k_u, k_u);
        row_at(row, k_u, s, values + j, slopes + j);
    }
    row_at(values, k_v, t, value, by_t);
    row_at(slopes, k_v, t, by_s, unused);
    _arb_vec_clear(row, k_u), _arb_vec_clear(values, k_v), _arb_vec_clear(slopes, k_v);
    arb_clear(unused);
}

double oracle_double(const arb_t x) { return arf_get_d(arb_midref(x), ARF_RND_NEAR); }

double oracle_radius(const arb_t x)
{
    double d = oracle_double(x);   /* off by half a unit in the last place, or as much as the least double */
    return mag_get_d(arb_radref(x)) + 0x1p-52 * (d < 0 ? -d : d) + 0x1p-1074;
}
