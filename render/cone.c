/* cone and cylinder, open or closed.
 *
 * With the unit axis w from the base, z = (p - base).w and q = p - base - z w: the side is |q| = rho(z) = r0 + k z for 0
 * <= z <= height, k = (r1 - r0)/height. A point of the ray inside the infinite cone has |q|^2 - rho^2 <= 0, a quadratic
 * in t. The closed solid is the common part of two intervals of t: that of the slab 0 <= z <= height, and that of the
 * quadratic; so no ray slips through the rim between side and cap. The open one keeps the ends of the second that lie in
 * the first.
 *
 * Far origins and slender shapes: the quadratic is set up at the point of the ray within the slab that is nearest to the
 * axis (t = s + tau). There |q| is at most the larger radius, if the ray hits at all, so that nothing large cancels.
 *
 * Error: base and axis have errors of 3u |o - base|, the step to s of 4u s |dir|, z and rho together of 8u height: each
 * is a distance across the surface, up to the slope of the side, 1 + |k|. The roots of the quadratic are backward stable,
 * which adds a few u times the radii. */
#include "render/hit_list.h"
#include "render/mesh_sink.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct {
    Shape shape;
    Vec3 base, axis;                    /* axis is unit */
    double height, r0, r1, slope;       /* slope: (r1 - r0) / height */
    bool is_open;
} Cone;

enum { SIDE, BASE, CAP };               /* Hit.leaf */

static const double POINT_ERROR = 16 * 0x1p-53;   /* of (|o - base| + t |dir| + height + radius)(1 + |slope|) */

/* The two end circles, as for a disc. */
static Box cone_bounds(const Shape *shape)
{
    const Cone *c = (const Cone *)shape;
    static const double ROUNDING = 1 + 8 * 0x1p-53;
    Vec3 w = c->axis, sine = vec(hypot(w.y, w.z), hypot(w.z, w.x), hypot(w.x, w.y));
    Vec3 cap = vec_add(c->base, vec_scale(w, c->height));
    Box lower = box_around(c->base, vec_scale(sine, c->r0 * ROUNDING));
    return box_union(lower, box_around(cap, vec_scale(sine, c->r1 * ROUNDING)));
}

typedef struct { double lo, hi; } Span;   /* of t */

static const Span NOWHERE = { INFINITY, -INFINITY };

/* The ray along and across the axis. */
typedef struct { double z, dz; Vec3 q, dq; } Split;

static Split split_ray(const Cone *c, const Ray *r)
{
    Vec3 f = vec_sub(r->origin, c->base);
    double z = vec_dot(f, c->axis), dz = vec_dot(r->dir, c->axis);
    return (Split){ z, dz, vec_sub(f, vec_scale(c->axis, z)), vec_sub(r->dir, vec_scale(c->axis, dz)) };
}

static Span slab_span(const Cone *c, const Split *p)
{
    if (p->dz == 0) return p->z >= 0 && p->z <= c->height ? (Span){ -INFINITY, INFINITY } : NOWHERE;
    double a = -p->z / p->dz, b = (c->height - p->z) / p->dz;
    return (Span){ fmin(a, b), fmax(a, b) };
}

/* Where the ray is nearest to the axis, kept within the slab. */
static double nearest_to_axis(const Split *p, Span slab)
{
    double across2 = vec_length2(p->dq), s = across2 > 0 ? -vec_dot(p->q, p->dq) / across2 : 0;
    return fmax(slab.lo, fmin(slab.hi, s));
}

/* Where a tau^2 - 2 b tau + c <= 0, restricted to the half of a double cone that opens along the ray if `opens`, against it
 * otherwise: between the roots where a > 0, beyond one of them where a < 0 (the other bounds the mirror image). */
static Span solid_span(double a, double b, double c, bool opens)
{
    double disc = b * b - a * c;
    if (a == 0 && b == 0) return c <= 0 ? (Span){ -INFINITY, INFINITY } : NOWHERE;
    if (disc < 0) {
        if (a > 0) return NOWHERE;
        disc = 0;                                 /* a < 0: the line meets the cone for certain, at worst in its apex */
    }
    double q = b + copysign(sqrt(disc), b), x1 = q / a, x2 = q != 0 ? c / q : 0;
    if (a > 0) return (Span){ fmin(x1, x2), fmax(x1, x2) };
    if (a == 0) return b > 0 ? (Span){ x2, INFINITY } : (Span){ -INFINITY, x2 };
    return opens ? (Span){ fmax(x1, x2), INFINITY } : (Span){ -INFINITY, fmin(x1, x2) };
}

static Span side_span(const Cone *c, const Split *p, Span slab)
{
    double s = nearest_to_axis(p, slab);
    Vec3 q = vec_add(p->q, vec_scale(p->dq, s));
    double rho = c->r0 + c->slope * (p->z + s * p->dz), d_rho = c->slope * p->dz, distance = vec_length(q);
    Span tau = solid_span(vec_length2(p->dq) - d_rho * d_rho, d_rho * rho - vec_dot(q, p->dq),
                          (distance - rho) * (distance + rho), d_rho > 0);
    return (Span){ s + tau.lo, s + tau.hi };
}

typedef struct { double t; uint32_t face; } Crossing;

/* The two places where the ray may hit, ascending; NaN or infinite: none. */
static void cone_crossings(const Cone *c, const Split *p, Span slab, Span side, Crossing out[2])
{
    uint32_t first = p->dz > 0 ? BASE : CAP, last = p->dz > 0 ? CAP : BASE;
    if (c->is_open) {
        out[0] = (Crossing){ side.lo >= slab.lo && side.lo <= slab.hi ? side.lo : INFINITY, SIDE };
        out[1] = (Crossing){ side.hi >= slab.lo && side.hi <= slab.hi ? side.hi : INFINITY, SIDE };
        return;
    }
    out[0] = side.lo > slab.lo ? (Crossing){ side.lo, SIDE } : (Crossing){ slab.lo, first };
    out[1] = side.hi < slab.hi ? (Crossing){ side.hi, SIDE } : (Crossing){ slab.hi, last };
    if (!(out[0].t <= out[1].t)) out[0].t = out[1].t = INFINITY;
}

static double cone_error(const Cone *c, const Ray *r, double t)
{
    double length = vec_length(r->dir), size = c->height + fmax(c->r0, c->r1);
    double reach = vec_length(vec_sub(r->origin, c->base)) + size;
    return POINT_ERROR * (1 + fabs(c->slope)) * (reach / length + t);
}

/* The crossings of the ray's whole line; false: there are none ahead of it. */
static bool cone_meets(const Cone *c, const Ray *r, Trace *t, Crossing out[2])
{
    t->counters.primitive_tests++;
    Split p = split_ray(c, r);
    Span slab = slab_span(c, &p);
    if (!(slab.lo <= slab.hi && slab.hi > r->t_min)) return false;
    cone_crossings(c, &p, slab, side_span(c, &p, slab), out);
    return true;
}

static bool cone_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Cone *c = (const Cone *)shape;
    Crossing crossing[2];
    if (!cone_meets(c, r, t, crossing)) return false;
    for (int i = 0; i < 2; i++) {
        double t_hit = crossing[i].t;
        if (!(t_hit > r->t_min && t_hit < best->t)) continue;
        hit_set(best, t_hit, cone_error(c, r, t_hit), 0, 0, shape, crossing[i].face);
        return true;
    }
    return false;
}

static void cone_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    const Cone *c = (const Cone *)shape;
    Crossing crossing[2];
    if (!cone_meets(c, r, t, crossing)) return;
    for (int i = 0; i < 2; i++)
        hit_list_offer(out, r, crossing[i].t, cone_error(c, r, crossing[i].t), shape, crossing[i].face);
}

static bool cone_inside(const Shape *shape, Vec3 point)
{
    const Cone *c = (const Cone *)shape;
    Split p = split_ray(c, &(Ray){ .origin = point });
    return p.z >= 0 && p.z <= c->height && vec_length(p.q) <= c->r0 + c->slope * p.z;
}

/* The gradient of |q| - rho; at an apex, where there is none, the axis. */
static void cone_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    const Cone *c = (const Cone *)shape;
    Vec3 n = c->axis;
    if (h->leaf == SIDE) {
        Vec3 q = split_ray(c, &(Ray){ .origin = ray_at(r, h->t) }).q;
        if (vec_max_abs(q) > 0) n = vec_normalize(vec_sub(vec_normalize(q), vec_scale(c->axis, c->slope)));
    }
    out->normal = out->shading_normal = h->leaf == BASE ? vec_neg(n) : n;
}

static Vec3 cap_of(const Cone *c) { return vec_add(c->base, vec_scale(c->axis, c->height)); }

static bool cone_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    static const double PI = 3.14159265358979323846;
    const Cone *c = (const Cone *)shape;
    Vec3 cap = cap_of(c);
    MeshCircle low = mesh_circle(c->base, c->axis, c->r0), high = mesh_circle(cap, c->axis, c->r1);
    int n = mesh_arc_steps(fmax(c->r0, c->r1), 2 * PI, chord_error);
    mesh_sink_strip(out, low, high, n);
    if (c->is_open) return true;
    mesh_sink_strip(out, mesh_circle(c->base, c->axis, 0), low, n);
    mesh_sink_strip(out, high, mesh_circle(cap, c->axis, 0), n);
    return true;
}

static void cone_write(const Shape *shape, Sdl *out)
{
    const Cone *c = (const Cone *)shape;
    sdl_text(out, "cone {");
    sdl_vec(out, c->base), sdl_text(out, ","), sdl_number(out, c->r0), sdl_text(out, ",");
    sdl_vec(out, cap_of(c)), sdl_text(out, ","), sdl_number(out, c->r1);
    if (c->is_open) sdl_text(out, " open");
}

static void cylinder_write(const Shape *shape, Sdl *out)
{
    const Cone *c = (const Cone *)shape;
    sdl_text(out, "cylinder {");
    sdl_vec(out, c->base), sdl_text(out, ","), sdl_vec(out, cap_of(c)), sdl_text(out, ","), sdl_number(out, c->r0);
    if (c->is_open) sdl_text(out, " open");
}

static const ShapeType cone_type = {
    .name = "cone", .bounds = cone_bounds, .hit = cone_hit, .all_hits = cone_all_hits, .inside = cone_inside,
    .attributes = cone_attributes, .tessellate = cone_tessellate, .write = cone_write,
};
static const ShapeType cylinder_type = {
    .name = "cylinder", .bounds = cone_bounds, .hit = cone_hit, .all_hits = cone_all_hits, .inside = cone_inside,
    .attributes = cone_attributes, .tessellate = cone_tessellate, .write = cylinder_write,
};

static Shape *frustum_new(Arena *a, const ShapeType *type, Vec3 base, double r0, Vec3 cap, double r1, bool is_open)
{
    Vec3 along = vec_sub(cap, base), axis = vec_normalize(along);
    double height = vec_dot(along, axis);
    if (!vec_is_finite(base) || !vec_is_finite(cap) || !(height > 0) || !isfinite(height)) return NULL;
    if (!(r0 + r1 > 0) || !isfinite(r0 + r1)) return NULL;
    Cone *c = ARENA_NEW(a, Cone);
    shape_init(&c->shape, type);
    c->base = base, c->axis = axis;
    c->height = height;
    c->r0 = r0, c->r1 = r1, c->slope = (r1 - r0) / height;
    c->is_open = is_open;
    return &c->shape;
}

Shape *cylinder_new(Arena *a, Vec3 base, Vec3 cap, double radius, bool is_open)
{
    return frustum_new(a, &cylinder_type, base, fabs(radius), cap, fabs(radius), is_open);
}

Shape *cone_new(Arena *a, Vec3 base, double base_radius, Vec3 cap, double cap_radius, bool is_open)
{
    return frustum_new(a, &cone_type, base, fabs(base_radius), cap, fabs(cap_radius), is_open);
}
