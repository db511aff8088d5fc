/* See normal.h. */
#include "nurbs/normal.h"

#include <stdbool.h>

/* A tangent is known to u = 2^-53 of the patch's size, a cross product to u of both lengths. The share of either that must
 * be left: half of the bits, so that as many of the normal's are right; or, where no point of the way has these, so many
 * that it still points to the right side. */
#define HALF_OF_THE_BITS 0x1p-26
#define SOME_BITS 0x1p-44

/* The first step inwards: where one derivative vanishes to first order only, 2^-20 of the way has six bits more than half of
 * them, and the normal turns by no more than 2^-20 of what it does on the whole way. Each further one goes 16 times as far,
 * the last to the middle. */
#define FIRST_STEP 0x1p-20
#define LONGER 16

static bool is_regular(NormalTangents t, double size, double share, Vec3 *normal)
{
    double along_u = vec_length(t.along_u), along_v = vec_length(t.along_v);
    *normal = vec_cross(t.along_u, t.along_v);
    return along_u > share * size && along_v > share * size && vec_length(*normal) > share * along_u * along_v;
}

/* Perpendicular to `along` (of any length, or zero), nearest to `towards`. */
static Vec3 perpendicular(Vec3 along, Vec3 towards)
{
    Vec3 a = vec_normalize(along), t = vec_normalize(towards), beside = vec_cross(a, t);
    if (!(vec_length2(a) > 0)) return t;
    if (vec_length(beside) > HALF_OF_THE_BITS) return vec_normalize(vec_cross(vec_normalize(beside), a));
    bool x_is_least = fabs(a.x) <= fabs(a.y) && fabs(a.x) <= fabs(a.z);
    return vec_normalize(x_is_least ? vec(0, a.z, -a.y) : fabs(a.y) <= fabs(a.z) ? vec(-a.z, 0, a.x) : vec(a.y, -a.x, 0));
}

Vec3 normal_limit(NormalWay way, const void *context, double size, Vec3 towards)
{
    static const double shares[] = { HALF_OF_THE_BITS, SOME_BITS };
    Vec3 normal;
    for (int i = 0; i < 2; i++)
        for (double inwards = 0; inwards <= 1; inwards = inwards > 0 ? inwards * LONGER : FIRST_STEP)
            if (is_regular(way(context, inwards), size, shares[i], &normal)) return vec_normalize(normal);
    NormalTangents t = way(context, 0);
    bool u_is_longer = vec_length2(t.along_u) >= vec_length2(t.along_v);
    return perpendicular(u_is_longer ? t.along_u : t.along_v, towards);
}
