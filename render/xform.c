/* Affine maps, row vectors: p' = p M. Each map carries its inverse, made with it and not by inversion wherever it has a form
 * of its own. */
#include "render/xform.h"

#include <string.h>

static const Affine IDENTITY = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } } };

Xform xform_identity(void) { return (Xform){ IDENTITY, IDENTITY }; }

static Affine affine_translate(Vec3 by)
{
    Affine a = IDENTITY;
    a.m[3][0] = by.x, a.m[3][1] = by.y, a.m[3][2] = by.z;
    return a;
}

static Affine affine_scale(Vec3 by)
{
    Affine a = IDENTITY;
    a.m[0][0] = by.x, a.m[1][1] = by.y, a.m[2][2] = by.z;
    return a;
}

Xform xform_translate(Vec3 by) { return (Xform){ affine_translate(by), affine_translate(vec_neg(by)) }; }

Xform xform_scale(Vec3 by) { return (Xform){ affine_scale(by), affine_scale(vec(1 / by.x, 1 / by.y, 1 / by.z)) }; }

/* first, then second */
static Affine affine_then(const Affine *first, const Affine *second)
{
    Affine out;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            double sum = i == 3 ? second->m[3][k] : 0;
            for (int j = 0; j < 3; j++) sum += first->m[i][j] * second->m[j][k];
            out.m[i][k] = sum;
        }
    return out;
}

/* An orthogonal map's inverse is its transpose. */
static Xform xform_orthogonal(const Affine *a)
{
    Xform x = { *a, IDENTITY };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) x.backward.m[i][k] = a->m[k][i];
    return x;
}

/* Sine and cosine of an angle in degrees, exact at the multiples of a quarter turn: a turned box stays flat. */
static void sin_cos_degrees(double degrees, double *sine, double *cosine)
{
    static const double RADIANS = 0.017453292519943295769;   /* pi / 180 */
    double turned = fmod(degrees, 360);
    int quarter = (int)nearbyint(turned / 90);               /* -4 .. 4 */
    double rest = (turned - 90 * quarter) * RADIANS, s = sin(rest), c = cos(rest);
    switch (quarter & 3) {
    case 0: *sine = s, *cosine = c; break;
    case 1: *sine = c, *cosine = -s; break;
    case 2: *sine = -s, *cosine = -c; break;
    default: *sine = -c, *cosine = s; break;
    }
}

/* About coordinate axis k, left-handed: of the next two axes i and j, i' = i c - j s, j' = i s + j c. */
static Xform rotate_about(int k, double degrees)
{
    int i = (k + 1) % 3, j = (k + 2) % 3;
    double s, c;
    sin_cos_degrees(degrees, &s, &c);
    Affine a = IDENTITY;
    a.m[i][i] = c, a.m[i][j] = s;
    a.m[j][i] = -s, a.m[j][j] = c;
    return xform_orthogonal(&a);
}

Xform xform_rotate(Vec3 degrees)
{
    Xform x = rotate_about(0, degrees.x);
    if (degrees.y != 0) x = xform_then(x, rotate_about(1, degrees.y));
    if (degrees.z != 0) x = xform_then(x, rotate_about(2, degrees.z));
    return x;
}

/* Rodrigues' formula for rows: p' = p c + (n.p)(1 - c) n + s (n x p). */
Xform xform_axis_rotate(Vec3 axis, double degrees)
{
    Vec3 unit = vec_normalize(axis);
    double s, c, n[3] = { unit.x, unit.y, unit.z };
    sin_cos_degrees(degrees, &s, &c);
    Affine a = IDENTITY;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        a.m[i][i] = n[i] * n[i] + c * (1 - n[i] * n[i]);
        a.m[i][j] = n[i] * n[j] * (1 - c) + s * n[k];
        a.m[i][k] = n[i] * n[k] * (1 - c) - s * n[j];
    }
    return xform_orthogonal(&a);
}

/* Each row divided by a power of two, so that its largest element is in [1/2, 1): neither the determinant nor the cofactors
 * over- or underflow. false: a row is zero or not finite. */
static bool normalize_rows(const Affine *a, double rows[3][3], int exponent[3])
{
    for (int i = 0; i < 3; i++) {
        double largest = vec_max_abs(vec(a->m[i][0], a->m[i][1], a->m[i][2]));
        if (!(largest > 0) || !isfinite(a->m[i][0] + a->m[i][1] + a->m[i][2])) return false;
        (void)frexp(largest, &exponent[i]);
        for (int k = 0; k < 3; k++) rows[i][k] = ldexp(a->m[i][k], -exponent[i]);
    }
    return true;
}

/* The determinant of normalized rows has six products of at most 1 and about five roundings in each: below this it may be
 * nothing but rounding. */
static const double DETERMINANT_NOISE = 6 * 5 * 0x1p-53;

static bool invert_linear(const Affine *a, Affine *inverse)
{
    double r[3][3];
    int exponent[3];
    if (!normalize_rows(a, r, exponent)) return false;
    double cofactor[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            cofactor[i][k] = r[i1][k1] * r[i2][k2] - r[i1][k2] * r[i2][k1];
        }
    double det = r[0][0] * cofactor[0][0] + r[0][1] * cofactor[0][1] + r[0][2] * cofactor[0][2];
    if (!(fabs(det) > DETERMINANT_NOISE)) return false;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            inverse->m[k][i] = ldexp(cofactor[i][k] / det, -exponent[i]);
            if (!isfinite(inverse->m[k][i])) return false;
        }
    return true;
}

static Vec3 affine_translation(const Affine *a) { return vec(a->m[3][0], a->m[3][1], a->m[3][2]); }

bool xform_from_matrix(const double m[12], Xform *out)
{
    Xform x = xform_identity();
    memcpy(x.forward.m, m, sizeof x.forward.m);
    Vec3 by = affine_translation(&x.forward);
    if (!isfinite(by.x + by.y + by.z) || !invert_linear(&x.forward, &x.backward)) return false;
    Vec3 back = vec_neg(affine_vector(&x.backward, by));
    if (!isfinite(back.x + back.y + back.z)) return false;
    x.backward.m[3][0] = back.x, x.backward.m[3][1] = back.y, x.backward.m[3][2] = back.z;
    *out = x;
    return true;
}

Xform xform_then(Xform first, Xform second)
{
    return (Xform){ affine_then(&first.forward, &second.forward), affine_then(&second.backward, &first.backward) };
}

Xform xform_inverse(Xform x) { return (Xform){ x.backward, x.forward }; }

bool xform_is_identity(const Xform *x)
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            if (x->forward.m[i][k] != IDENTITY.m[i][k]) return false;
    return true;
}

/* Each side of the image is a sum of extreme products (a corner of b for each output axis, [Arv90]). Added outward: the
 * sum's rounding, at most 4u of the magnitudes, and as much for each of some 15 maps that x may be composed of, because
 * rays go the other way, through an inverse that was composed and rounded apart. */
Box xform_box(const Xform *x, Box b)
{
    static const double ROUNDING = 64 * 0x1p-53;
    if (box_is_empty(b)) return box_empty();
    Box out;
    for (int k = 0; k < 3; k++) {
        double lo = x->forward.m[3][k], hi = lo, lo_size = fabs(lo), hi_size = fabs(hi);
        for (int i = 0; i < 3; i++) {
            double m = x->forward.m[i][k];
            if (m == 0) continue;                              /* also where the side is infinite */
            double from_lo = m * b.lo[i], from_hi = m * b.hi[i];
            double least = fmin(from_lo, from_hi), most = fmax(from_lo, from_hi);
            lo += least, lo_size += fabs(least);
            hi += most, hi_size += fabs(most);
        }
        out.lo[k] = isinf(lo) ? -INFINITY : float_down(lo - ROUNDING * lo_size);
        out.hi[k] = isinf(hi) ? INFINITY : float_up(hi + ROUNDING * hi_size);
    }
    return out;
}
