/* A ray against a triangle, watertight after [WBW13]: the vertices are moved to the ray's origin and sheared so that the
 * ray is the z axis; the ray passes the triangle if the three edge functions in x, y have one sign. For an edge that two
 * triangles share both compute the same two products, so that no ray slips between them.
 *
 * Error: a moved vertex is off by u of its distance, its sheared z by 3u m, m the largest distance of a vertex. An edge
 * function is off by 3u L^2, L the largest x or y after shearing; over the sum of all three, det, that shifts the point
 * where the triangle is evaluated by 3 * 3u L^3/|det|, which counts for slivers. */
#ifndef TRIMRAY_WATERTIGHT_H
#define TRIMRAY_WATERTIGHT_H

#include "render/ray.h"

#include <stdbool.h>

/* The axes after shearing: z is that of the ray's largest component, x and y follow so that orientation is kept. */
typedef struct { int x, y, z; double shear_x, shear_y, scale; } Shear;

static inline double vec_component(Vec3 v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

static inline Shear shear_of(const Ray *r)
{
    Vec3 a = vec(fabs(r->dir.x), fabs(r->dir.y), fabs(r->dir.z));
    int z = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2, x = (z + 1) % 3, y = (z + 2) % 3;
    double dz = vec_component(r->dir, z);
    return (Shear){ x, y, z, vec_component(r->dir, x) / dz, vec_component(r->dir, y) / dz, 1 / dz };
}

/* z is in units of the direction: the vertex's t, if it lay on the ray. */
static inline Vec3 sheared(const Shear *s, Vec3 v)
{
    double z = vec_component(v, s->z);
    return vec(vec_component(v, s->x) - s->shear_x * z, vec_component(v, s->y) - s->shear_y * z, s->scale * z);
}

static inline double sheared_edge(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }

/* In units of the direction, for which m is so already. */
static inline double sheared_error(const Vec3 v[3], double det, double scale)
{
    static const double ROUNDING = 10 * 0x1p-53;   /* of m + L^3 / |det| */
    double m = 0, L = 0;
    for (int i = 0; i < 3; i++) {
        m = fmax(m, fabs(v[i].z));
        L = fmax(L, fmax(fabs(v[i].x), fabs(v[i].y)));
    }
    return ROUNDING * (m + L * L * L / fabs(det) * fabs(scale));
}

/* t, its error, and the weights u and v of the second and third corner. */
typedef struct { double t, error, u, v; } TriangleHit;

/* A triangle with its corners sheared; false: missed, or edge on. Its edges belong to it: a ray through one that two
 * triangles share hits both. */
static inline bool watertight_hit(const Shear *s, const Vec3 v[3], double t_min, double t_max, TriangleHit *out)
{
    double w0 = sheared_edge(v[1], v[2]), w1 = sheared_edge(v[2], v[0]), w2 = sheared_edge(v[0], v[1]), det = w0 + w1 + w2;
    if ((w0 < 0 || w1 < 0 || w2 < 0) && (w0 > 0 || w1 > 0 || w2 > 0)) return false;
    double t = (w0 * v[0].z + w1 * v[1].z + w2 * v[2].z) / det;     /* edge on: 0 / 0, which fails here */
    if (!(t > t_min && t < t_max)) return false;
    *out = (TriangleHit){ t, sheared_error(v, det, s->scale), w1 / det, w2 / det };
    return true;
}

/* On which side of the edge from a to b does the ray pass? Where it meets the edge, the answer is that for a ray moved by
 * (e, e^2) in x and y, for all small e > 0: so of the triangles round an edge or a vertex as many are passed as by a ray
 * beside it, which keeps counts of crossings right. */
static inline bool sheared_side(Vec3 a, Vec3 b)
{
    double w = sheared_edge(a, b);
    return w != 0 ? w > 0 : a.y != b.y ? a.y > b.y : b.x > a.x;
}

static inline bool watertight_passes(const Vec3 v[3])
{
    bool side = sheared_side(v[0], v[1]);
    return sheared_side(v[1], v[2]) == side && sheared_side(v[2], v[0]) == side;
}

#endif
