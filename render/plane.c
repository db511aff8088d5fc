/* plane { normal, distance }: the points p with n.p = d, n unit; the inside is where n.p < d.
 *
 * t = (d - n.o) / (n.dir). Error: the numerator is off by at most 4u (|o| + |d|), which is a distance across the plane; the
 * slope by 3u |dir|, which moves the point by 3u t |dir|; two more roundings move it along the ray by 2u t |dir|. */
#include "render/bunch.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct { Shape shape; Vec3 normal; double distance; } Plane;

static const double POINT_ERROR = 8 * 0x1p-53;    /* of |o| + |d| + t |dir| */

/* Infinite, but a plane across an axis bounds that axis no better: it stays outside every tree. */
static Box plane_bounds(const Shape *shape)
{
    (void)shape;
    return box_infinite();
}

static bool plane_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Plane *p = (const Plane *)shape;
    t->counters.primitive_tests++;
    double t_hit = (p->distance - vec_dot(p->normal, r->origin)) / vec_dot(p->normal, r->dir);
    if (!(t_hit > r->t_min && t_hit < best->t)) return false;     /* a parallel ray: infinite or NaN, which fail here */
    double reach = (vec_length(r->origin) + fabs(p->distance)) / vec_length(r->dir);
    hit_set(best, t_hit, POINT_ERROR * (reach + t_hit), 0, 0, shape, 0);
    return true;
}

static bool plane_blocks(const Shape *shape, const Ray *r, double t_max, Trace *t)
{
    const Plane *p = (const Plane *)shape;
    t->counters.primitive_tests++;
    double t_hit = (p->distance - vec_dot(p->normal, r->origin)) / vec_dot(p->normal, r->dir);
    return t_hit > r->t_min && t_hit < t_max;
}

/* ---- bunches: the same operations, to the last bit ---- */

ALWAYS_INLINE V8d dots(Vec3 n, const Vec3x8 *v) { return n.x * v->x + n.y * v->y + n.z * v->z; }
ALWAYS_INLINE V8d lengths(Vec3x8 v) { return v8d_sqrt(vec8_dot(v, v)); }

ALWAYS_INLINE V8d where_met(const Plane *p, const RayBunch *b)
{
    return (p->distance - dots(p->normal, &b->origin)) / dots(p->normal, &b->dir);
}

EVERY_X86
static Lanes plane_hit_bunch(const Shape *shape, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    const Plane *p = (const Plane *)shape;
    t->counters.primitive_tests += (uint64_t)__builtin_popcount(lanes);
    V8d t_hit = where_met(p, b);
    Lanes hit = 0;
    lanes &= v8l_mask(v8d_less(b->t_min, t_hit));
    if (!lanes) return 0;
    V8d t_error = POINT_ERROR * ((lengths(b->origin) + fabs(p->distance)) / lengths(b->dir) + t_hit);
    while (lanes) {
        int i = lanes_next(&lanes);
        if (!(t_hit[i] < best[i].t)) continue;
        hit_set(&best[i], t_hit[i], t_error[i], 0, 0, shape, 0);
        hit |= 1u << i;
    }
    return hit;
}

EVERY_X86
static Lanes plane_blocks_bunch(const Shape *shape, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    t->counters.primitive_tests += (uint64_t)__builtin_popcount(lanes);
    V8d t_hit = where_met((const Plane *)shape, b);
    return lanes & v8l_mask(v8d_less(b->t_min, t_hit) & v8d_less(t_hit, v8d_load_doubles(t_max)));
}

/* The plane itself counts as inside, as it does for POV-Ray. */
static bool plane_inside(const Shape *shape, Vec3 point)
{
    const Plane *p = (const Plane *)shape;
    return vec_dot(p->normal, point) <= p->distance;
}

static void plane_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    (void)r, (void)h;
    out->normal = out->shading_normal = ((const Plane *)shape)->normal;
}

static void plane_write(const Shape *shape, Sdl *out)
{
    const Plane *p = (const Plane *)shape;
    sdl_text(out, "plane {");
    sdl_vec(out, p->normal), sdl_text(out, ","), sdl_number(out, p->distance);
}

static const ShapeType plane_type = {
    .name = "plane", .bounds = plane_bounds, .hit = plane_hit, .blocks = plane_blocks,
    .hit_bunch = plane_hit_bunch, .blocks_bunch = plane_blocks_bunch, .inside = plane_inside,
    .attributes = plane_attributes, .write = plane_write,
};

Shape *plane_new(Arena *a, Vec3 normal, double distance)
{
    if (!(vec_max_abs(normal) > 0) || !vec_is_finite(normal) || !isfinite(distance)) return NULL;
    Plane *p = ARENA_NEW(a, Plane);
    shape_init(&p->shape, &plane_type);
    p->normal = vec_normalize(normal);
    p->distance = distance;
    return &p->shape;
}
