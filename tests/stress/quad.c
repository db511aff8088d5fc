/* See quad.h. Roots are isolated by those of the derivative, recursively, and found by Newton's method kept in a bracket. */
#include "tests/stress/quad.h"

#include <float.h>
#include <math.h>

QuadMap quad_map_inverse(const QuadMap *m)
{
    Quad3 yz = quad3_cross(m->y, m->z), zx = quad3_cross(m->z, m->x), xy = quad3_cross(m->x, m->y);
    Quad d = 1 / quad3_dot(m->x, yz);
    QuadMap r = { quad3(yz.x * d, zx.x * d, xy.x * d), quad3(yz.y * d, zx.y * d, xy.y * d),
                  quad3(yz.z * d, zx.z * d, xy.z * d), { 0, 0, 0 } };
    r.o = quad3_scale(quad_map_vector(&r, m->o), -1);
    return r;
}

Quad3 quad_map_normal(const QuadMap *inverse, Quad3 n)
{
    return quad3(quad3_dot(inverse->x, n), quad3_dot(inverse->y, n), quad3_dot(inverse->z, n));
}

Poly poly_add(Poly a, Poly b)
{
    if (a.n < b.n) return poly_add(b, a);
    for (int i = 0; i <= b.n; i++) a.c[i] += b.c[i];
    return a;
}

Poly poly_scale(Poly a, Quad s)
{
    for (int i = 0; i <= a.n; i++) a.c[i] *= s;
    return a;
}

Poly poly_mul(Poly a, Poly b)
{
    Poly r = { .n = a.n + b.n };
    for (int i = 0; i <= a.n; i++)
        for (int j = 0; j <= b.n; j++) r.c[i + j] += a.c[i] * b.c[j];
    return r;
}

Poly poly_derivative(Poly a)
{
    if (a.n == 0) return poly_constant(0);
    for (int i = 0; i < a.n; i++) a.c[i] = (i + 1) * a.c[i + 1];
    a.n--;
    return a;
}

Quad poly_at(const Poly *a, Quad s)
{
    Quad r = a->c[a->n];
    for (int i = a->n - 1; i >= 0; i--) r = r * s + a->c[i];
    return r;
}

/* About where the root is, to begin from: the same steps with fewer digits. */
static Quad guess_between(const Poly *a, Quad lo_quad, Quad hi_quad, bool is_rising)
{
    long double c[POLY_MAX + 1], lo = (long double)lo_quad, hi = (long double)hi_quad, s = (lo + hi) / 2;
    for (int i = 0; i <= a->n; i++) c[i] = (long double)a->c[i];
    for (int step = 0; step < 100; step++) {
        long double f = c[a->n], slope = 0;
        for (int i = a->n - 1; i >= 0; i--) slope = slope * s + f, f = f * s + c[i];
        if ((f < 0) == is_rising) lo = s;
        else hi = s;
        long double next = s - f / slope;
        if (!(next > lo && next < hi)) next = (lo + hi) / 2;
        if (fabsl(next - s) <= 4 * LDBL_EPSILON * fabsl(s)) return next;
        s = next;
    }
    return s;
}

/* The root between lo and hi, where a has different signs and no critical point. */
static Quad root_between(const Poly *a, Quad lo, Quad hi, Quad at_lo)
{
    Poly d = poly_derivative(*a);
    Quad s = guess_between(a, lo, hi, at_lo < 0);
    if (!(s > lo && s < hi)) s = (lo + hi) / 2;
    for (int step = 0; step < 200; step++) {
        Quad f = poly_at(a, s), slope = poly_at(&d, s);
        if (f == 0) return s;
        if ((f < 0) == (at_lo < 0)) lo = s;
        else hi = s;
        Quad next = slope != 0 ? s - f / slope : lo;
        if (!(next > lo && next < hi)) next = (lo + hi) / 2;
        if (quad_abs(next - s) <= 2 * QUAD_EPSILON * quad_abs(s) || next == lo || next == hi) return next;
        s = next;
    }
    return s;
}

static int quadratic_roots(const Poly *p, Quad lo, Quad hi, Quad out[])
{
    Quad a = p->c[2], b = p->c[1] / 2, c = p->c[0], disc = b * b - a * c;
    if (disc < 0) return 0;
    Quad q = -(b + (b < 0 ? -quad_sqrt(disc) : quad_sqrt(disc)));
    Quad r[2] = { a != 0 ? q / a : lo, q != 0 ? c / q : lo };
    if (r[0] > r[1]) {
        Quad swap = r[0];
        r[0] = r[1], r[1] = swap;
    }
    int n = 0;
    for (int i = 0; i < 2; i++)
        if (r[i] > lo && r[i] < hi && (n == 0 || r[i] != out[0])) out[n++] = r[i];
    return n;
}

int poly_roots_between(const Poly *a, Quad lo, Quad hi, const Quad critical[], int n_critical, Quad out[])
{
    Poly p = *a;
    while (p.n > 0 && p.c[p.n] == 0) p.n--;
    if (p.n == 0) return 0;
    if (p.n == 2) return quadratic_roots(&p, lo, hi, out);
    int n = 0;
    Quad begin = lo, f = poly_at(&p, lo);
    for (int i = 0; i <= n_critical; i++) {
        Quad end = i < n_critical ? critical[i] : hi, g = poly_at(&p, end);
        if (g == 0 && i < n_critical) out[n++] = end;
        else if (f != 0 && g != 0 && (f < 0) != (g < 0)) out[n++] = root_between(&p, begin, end, f);
        begin = end, f = g;
    }
    return n;
}

int poly_roots(const Poly *a, Quad lo, Quad hi, Quad out[])
{
    Quad critical[POLY_MAX];
    if (a->n == 0) return 0;
    Poly d = poly_derivative(*a);
    int n = a->n > 2 ? poly_roots(&d, lo, hi, critical) : 0;
    return poly_roots_between(a, lo, hi, critical, n, out);
}
