/* triangle and smooth_triangle.
 *
 * Watertight after [WBW13]: the vertices are moved to the ray's origin and sheared so that the ray is the z axis; the ray
 * passes the triangle if the three edge functions in x, y have one sign. For an edge that two triangles share both compute
 * the same two products, so that no ray slips between them; a ray in the edge hits both.
 *
 * Error: a moved vertex is off by u of its distance, its sheared z by 3u m, m the largest distance of a vertex. An edge
 * function is off by 3u L^2, L the largest x or y after shearing; over the sum of all three, det, that shifts the point
 * where the triangle is evaluated by 3 * 3u L^3/|det|, which counts for slivers. */
#include "render/shapes.h"

typedef struct {
    Shape shape;
    Vec3 p[3], normal;       /* of the face, unit */
    Vec3 n[3];               /* smooth: unit normals at the vertices */
    bool is_smooth;
} Triangle;

static const double POINT_ERROR = 10 * 0x1p-53;   /* of m + L^3 / |det| */

static Box triangle_bounds(const Shape *shape) { return box_of_points(((const Triangle *)shape)->p, 3); }

static double component(Vec3 v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

/* The axes after shearing: z is that of the ray's largest component, x and y follow so that orientation is kept. */
typedef struct { int x, y, z; double shear_x, shear_y, scale; } Shear;

static Shear shear_of(const Ray *r)
{
    Vec3 a = vec(fabs(r->dir.x), fabs(r->dir.y), fabs(r->dir.z));
    int z = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2, x = (z + 1) % 3, y = (z + 2) % 3;
    double dz = component(r->dir, z);
    return (Shear){ x, y, z, component(r->dir, x) / dz, component(r->dir, y) / dz, 1 / dz };
}

/* z is in units of the direction: the vertex's t, if it lay on the ray. */
static Vec3 sheared(const Shear *s, Vec3 v)
{
    double z = component(v, s->z);
    return vec(component(v, s->x) - s->shear_x * z, component(v, s->y) - s->shear_y * z, s->scale * z);
}

static double edge(Vec3 a, Vec3 b) { return a.x * b.y - a.y * b.x; }

/* In units of the direction, for which m is so already. */
static double hit_error(const Vec3 v[3], double det, double scale)
{
    double m = 0, L = 0;
    for (int i = 0; i < 3; i++) {
        m = fmax(m, fabs(v[i].z));
        L = fmax(L, fmax(fabs(v[i].x), fabs(v[i].y)));
    }
    return m + L * L * L / fabs(det) * fabs(scale);
}

static bool triangle_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Triangle *s = (const Triangle *)shape;
    t->counters.primitive_tests++;
    Shear shear = shear_of(r);
    Vec3 v[3];
    for (int i = 0; i < 3; i++) v[i] = sheared(&shear, vec_sub(s->p[i], r->origin));
    double w0 = edge(v[1], v[2]), w1 = edge(v[2], v[0]), w2 = edge(v[0], v[1]), det = w0 + w1 + w2;
    if ((w0 < 0 || w1 < 0 || w2 < 0) && (w0 > 0 || w1 > 0 || w2 > 0)) return false;
    double t_hit = (w0 * v[0].z + w1 * v[1].z + w2 * v[2].z) / det;     /* edge on: 0 / 0, which fails here */
    if (!(t_hit > r->t_min && t_hit < best->t)) return false;
    hit_set(best, t_hit, POINT_ERROR * hit_error(v, det, shear.scale), w1 / det, w2 / det, shape, 0);
    return true;
}

static void triangle_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    const Triangle *s = (const Triangle *)shape;
    (void)r;
    out->normal = out->shading_normal = s->normal;
    if (!s->is_smooth) return;
    Vec3 n = vec_scale(s->n[0], 1 - h->u - h->v);
    n = vec_add(n, vec_add(vec_scale(s->n[1], h->u), vec_scale(s->n[2], h->v)));
    if (vec_max_abs(n) > 0) out->shading_normal = vec_normalize(n);
}

static const ShapeType triangle_type = {
    .name = "triangle", .bounds = triangle_bounds, .hit = triangle_hit, .attributes = triangle_attributes,
};
static const ShapeType smooth_triangle_type = {
    .name = "smooth_triangle", .bounds = triangle_bounds, .hit = triangle_hit, .attributes = triangle_attributes,
};

static Triangle *make(Arena *a, const ShapeType *type, const Vec3 p[3])
{
    Vec3 normal = vec_normalize(vec_cross(vec_sub(p[2], p[0]), vec_sub(p[1], p[0])));
    if (!vec_is_finite(p[0]) || !vec_is_finite(p[1]) || !vec_is_finite(p[2])) return NULL;
    if (!(vec_max_abs(normal) > 0)) return NULL;
    Triangle *s = ARENA_NEW(a, Triangle);
    shape_init(&s->shape, type);
    for (int i = 0; i < 3; i++) s->p[i] = p[i];
    s->normal = normal;
    return s;
}

Shape *triangle_new(Arena *a, const Vec3 p[3])
{
    Triangle *s = make(a, &triangle_type, p);
    return s ? &s->shape : NULL;
}

/* Normals on both sides of the face describe no surface: POV-Ray drops such a triangle. */
static bool normals_agree(const Triangle *s)
{
    int n_front = 0, n_back = 0;
    for (int i = 0; i < 3; i++) {
        double side = vec_dot(s->normal, s->n[i]);
        n_front += side > 0, n_back += side < 0;
    }
    return n_front == 0 || n_back == 0;
}

Shape *smooth_triangle_new(Arena *a, const Vec3 p[3], const Vec3 n[3])
{
    Triangle *s = make(a, &smooth_triangle_type, p);
    if (!s) return NULL;
    for (int i = 0; i < 3; i++) s->n[i] = vec_normalize(n[i]);
    s->is_smooth = true;
    return normals_agree(s) ? &s->shape : NULL;
}
