/* Random shapes with a truth beside them: their distance function and their inside, in extended precision, from the numbers
 * that the constructor was given. Sizes are log-uniform over 16 decades; places up to a thousand sizes from the origin. */
#ifndef TRIMRAY_TESTS_SOLIDS_H
#define TRIMRAY_TESTS_SOLIDS_H

#include "tests/test.h"

#include "render/shapes.h"

#include <math.h>

typedef long double Real;
typedef struct { Real x, y, z; } Real3;

static inline Real3 real3(Vec3 a) { return (Real3){ a.x, a.y, a.z }; }
static inline Real3 real_add(Real3 a, Real3 b) { return (Real3){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static inline Real3 real_sub(Real3 a, Real3 b) { return (Real3){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static inline Real3 real_scale(Real3 a, Real s) { return (Real3){ a.x * s, a.y * s, a.z * s }; }
static inline Real real_dot(Real3 a, Real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Real real_length(Real3 a) { return sqrtl(real_dot(a, a)); }
static inline Real3 real_at(const Ray *r, Real t) { return real_add(real3(r->origin), real_scale(real3(r->dir), t)); }

typedef enum {
    SPHERE, BOX, CYLINDER, OPEN_CYLINDER, CONE, OPEN_CONE, SHARP_CONE, DISC, TORUS, SPINDLE, THIN_TORUS, TRIANGLE,
    PLANE, N_SOLIDS
} SolidKind;

static const char *const solid_names[N_SOLIDS] = {
    "sphere", "box", "cylinder", "open cylinder", "cone", "open cone", "sharp cone", "disc", "torus", "spindle",
    "thin torus", "triangle", "plane"
};

/* All but box, triangle and plane are turned about an axis: a profile in (distance from the axis, height). */
typedef struct {
    SolidKind kind;
    Shape *shape;
    double size;                 /* radius of a ball round the centre that holds the shape */
    Vec3 centre;
    Real3 base, axis;            /* origin and direction of the profile's height */
    Real profile[4][2];          /* cone: (r0, 0) (r1, h); disc: (hole, 0) (radius, 0) */
    Real3 corner[3];             /* box: lo, hi; triangle */
    Real radius, major, height;
} Solid;

static inline double any_size(TestRandom *r, double decades) { return pow(10, test_range(r, -decades, decades)); }

/* In the unit ball. */
static inline Vec3 any_point(TestRandom *r)
{
    for (;;) {
        double x = test_range(r, -1, 1), y = test_range(r, -1, 1), z = test_range(r, -1, 1);
        if (x * x + y * y + z * z <= 1) return vec(x, y, z);
    }
}

static inline Real segment_distance(Real px, Real py, const Real a[2], const Real b[2])
{
    Real dx = b[0] - a[0], dy = b[1] - a[1], l2 = dx * dx + dy * dy;
    Real s = l2 > 0 ? ((px - a[0]) * dx + (py - a[1]) * dy) / l2 : 0;
    s = fmaxl(0, fminl(1, s));
    return hypotl(px - a[0] - s * dx, py - a[1] - s * dy);
}

static inline void in_profile(const Solid *s, Real3 p, Real *rho, Real *height)
{
    Real3 q = real_sub(p, s->base);
    *height = real_dot(q, s->axis);
    *rho = real_length(real_sub(q, real_scale(s->axis, *height)));
}

static inline Real box_distance(const Solid *s, Real3 p)
{
    const Real lo[3] = { s->corner[0].x, s->corner[0].y, s->corner[0].z };
    const Real hi[3] = { s->corner[1].x, s->corner[1].y, s->corner[1].z }, c[3] = { p.x, p.y, p.z };
    Real outside2 = 0, inside = INFINITY;
    for (int k = 0; k < 3; k++) {
        Real out = fmaxl(0, fmaxl(lo[k] - c[k], c[k] - hi[k]));
        outside2 += out * out;
        inside = fminl(inside, fminl(c[k] - lo[k], hi[k] - c[k]));
    }
    return outside2 > 0 ? sqrtl(outside2) : inside;
}

static inline Real3 real_cross(Real3 a, Real3 b)
{
    return (Real3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* In the plane of the triangle if the foot lies inside, else from the nearest edge. */
static inline Real triangle_distance(const Solid *s, Real3 p)
{
    const Real3 *c = s->corner;
    Real3 n = real_cross(real_sub(c[1], c[0]), real_sub(c[2], c[0]));
    Real to_edges = INFINITY;
    bool is_over = true;
    for (int i = 0; i < 3; i++) {
        Real3 a = c[i], e = real_sub(c[(i + 1) % 3], a), q = real_sub(p, a);
        is_over &= real_dot(real_cross(e, q), n) >= 0;
        Real f = fmaxl(0, fminl(1, real_dot(q, e) / real_dot(e, e)));
        to_edges = fminl(to_edges, real_length(real_sub(q, real_scale(e, f))));
    }
    return is_over ? fabsl(real_dot(real_sub(p, c[0]), n)) / real_length(n) : to_edges;
}

static inline Real cone_distance(const Solid *s, Real rho, Real z)
{
    Real d = segment_distance(rho, z, s->profile[0], s->profile[1]);
    if (s->kind == OPEN_CONE || s->kind == OPEN_CYLINDER) return d;
    const Real foot[2] = { 0, 0 }, top[2] = { 0, s->height };
    d = fminl(d, segment_distance(rho, z, foot, s->profile[0]));
    return fminl(d, segment_distance(rho, z, top, s->profile[1]));
}

/* From the nearest point of the surface. */
static inline Real solid_distance(const Solid *s, Real3 p)
{
    Real rho, z;
    in_profile(s, p, &rho, &z);
    switch (s->kind) {
    case SPHERE: return fabsl(real_length(real_sub(p, s->base)) - s->radius);
    case BOX: return box_distance(s, p);
    case TRIANGLE: return triangle_distance(s, p);
    case PLANE: return fabsl(z);
    case DISC: return segment_distance(rho, z, s->profile[0], s->profile[1]);
    case TORUS: case SPINDLE: case THIN_TORUS:
        return fminl(fabsl(hypotl(rho - s->major, z) - s->radius), fabsl(hypotl(rho + s->major, z) - s->radius));
    default: return cone_distance(s, rho, z);
    }
}

static inline bool solid_has_inside(const Solid *s)
{
    return s->kind == SPHERE || s->kind == BOX || s->kind == CYLINDER || s->kind == CONE || s->kind == SHARP_CONE ||
           s->kind == TORUS || s->kind == SPINDLE || s->kind == THIN_TORUS || s->kind == PLANE;
}

/* How often a way from far outside to p must cross the surface, modulo 2; for a spindle the sheet within counts too. */
static inline bool solid_inside(const Solid *s, Real3 p)
{
    Real rho, z;
    in_profile(s, p, &rho, &z);
    switch (s->kind) {
    case SPHERE: return real_length(real_sub(p, s->base)) < s->radius;
    case BOX:
        return p.x > s->corner[0].x && p.y > s->corner[0].y && p.z > s->corner[0].z && p.x < s->corner[1].x &&
               p.y < s->corner[1].y && p.z < s->corner[1].z;
    case PLANE: return z < 0;
    case TORUS: case SPINDLE: case THIN_TORUS:
        return (hypotl(rho - s->major, z) < s->radius) != (hypotl(rho + s->major, z) < s->radius);
    default:
        return z > 0 && z < s->height && rho < s->profile[0][0] + (s->profile[1][0] - s->profile[0][0]) * z / s->height;
    }
}

static inline void make_frustum(Arena *a, TestRandom *r, Solid *s)
{
    double slender = any_size(r, 2), r0 = s->size / (1 + slender), r1 = r0 * test_range(r, .1, 2);
    Vec3 along = vec_scale(vec_normalize(any_point(r)), s->size * slender / (1 + slender));
    if (test_int(r, 0, 3) == 0) along = vec(0, along.y, 0);
    Vec3 base = vec_sub(s->centre, vec_scale(along, .5)), cap = vec_add(base, along);
    if (s->kind == SHARP_CONE) r1 = 0;
    if (s->kind == CYLINDER || s->kind == OPEN_CYLINDER) r1 = r0;
    s->shape = r1 == r0 ? cylinder_new(a, base, cap, r0, s->kind == OPEN_CYLINDER)
                        : cone_new(a, base, r0, cap, r1, s->kind == OPEN_CONE);
    Real3 axis = real_sub(real3(cap), real3(base));
    s->base = real3(base);
    s->height = real_length(axis);
    s->axis = real_scale(axis, 1 / s->height);
    s->profile[0][0] = r0, s->profile[1][0] = r1, s->profile[1][1] = s->height;
    s->size = 2 * s->size;
}

static inline void make_flat(Arena *a, TestRandom *r, Solid *s)
{
    Vec3 n = any_point(r);
    if (test_int(r, 0, 3) == 0) n = vec(0, n.y, 0);
    s->axis = real_scale(real3(n), 1 / real_length(real3(n)));
    if (s->kind == DISC) {
        double hole = test_int(r, 0, 1) ? s->size * test_range(r, .1, .9) : 0;
        s->shape = disc_new(a, s->centre, n, s->size, hole);
        s->base = real3(s->centre);
        s->profile[0][0] = hole, s->profile[1][0] = s->size;
    } else {
        double d = vec_dot(s->centre, vec_normalize(n));
        s->shape = plane_new(a, n, d);
        s->base = real_scale(s->axis, d);
    }
}

static inline void make_torus(Arena *a, TestRandom *r, Solid *s)
{
    double minor = s->kind == TORUS ? test_range(r, .1, .5) : test_range(r, .5, .9);
    if (s->kind == THIN_TORUS) minor = any_size(r, 1) * 1e-2;
    s->shape = torus_new(a, s->size * (1 - minor), s->size * minor);
    s->major = s->size * (1 - minor), s->radius = s->size * minor;
    s->centre = vec(0, 0, 0);
    s->base = (Real3){ 0, 0, 0 };
    s->axis = (Real3){ 0, 1, 0 };
}

static inline Solid any_solid(Arena *a, TestRandom *r, SolidKind kind, double decades)
{
    Solid s = { .kind = kind, .size = any_size(r, decades) };
    s.centre = vec_scale(any_point(r), test_int(r, 0, 2) ? s.size * pow(10, test_range(r, -1, 3)) : 0);
    s.base = real3(s.centre);
    s.axis = (Real3){ 0, 0, 1 };
    Vec3 p[3];
    for (int i = 0; i < 3; i++) p[i] = vec_add(s.centre, vec_scale(any_point(r), s.size));
    switch (kind) {
    case SPHERE:
        s.shape = sphere_new(a, s.centre, s.size);
        s.radius = s.size;
        break;
    case BOX:
        s.shape = box_shape_new(a, p[0], p[1]);
        s.corner[0] = (Real3){ fmin(p[0].x, p[1].x), fmin(p[0].y, p[1].y), fmin(p[0].z, p[1].z) };
        s.corner[1] = (Real3){ fmax(p[0].x, p[1].x), fmax(p[0].y, p[1].y), fmax(p[0].z, p[1].z) };
        break;
    case TRIANGLE:
        s.shape = triangle_new(a, p);
        for (int i = 0; i < 3; i++) s.corner[i] = real3(p[i]);
        break;
    case DISC: case PLANE: make_flat(a, r, &s); break;
    case TORUS: case SPINDLE: case THIN_TORUS: make_torus(a, r, &s); break;
    default: make_frustum(a, r, &s);
    }
    return s;
}

/* A ray that passes near the solid, from within to a thousand sizes away; its direction has any length. */
static inline Ray any_ray_at(TestRandom *r, const Solid *s)
{
    Vec3 target = vec_add(s->centre, vec_scale(any_point(r), s->size));
    Vec3 origin = vec_add(s->centre, vec_scale(any_point(r), s->size * pow(10, test_range(r, -.3, 3))));
    Vec3 dir = vec_sub(target, origin);
    if (test_int(r, 0, 7) == 0) dir.x = 0, dir.y = test_int(r, 0, 1) ? dir.y : 0;
    return (Ray){ origin, vec_scale(dir, any_size(r, 3) / vec_length(dir)), 0 };
}

#endif
