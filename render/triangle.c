/* triangle and smooth_triangle. The intersection and its error are those of watertight.h. */
#include "render/mesh_sink.h"
#include "render/sdl.h"
#include "render/shapes.h"
#include "render/watertight.h"

typedef struct {
    Shape shape;
    Vec3 p[3], normal;       /* of the face, unit */
    Vec3 n[3];               /* smooth: normals at the vertices; their lengths are their weights */
    bool is_smooth;
} Triangle;

static Box triangle_bounds(const Shape *shape) { return box_of_points(((const Triangle *)shape)->p, 3); }

static bool triangle_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Triangle *s = (const Triangle *)shape;
    t->counters.primitive_tests++;
    Shear shear = shear_of(r);
    Vec3 v[3];
    TriangleHit hit;
    for (int i = 0; i < 3; i++) v[i] = sheared(&shear, vec_sub(s->p[i], r->origin));
    if (!watertight_hit(&shear, v, r->t_min, best->t, &hit)) return false;
    hit_set(best, hit.t, hit.error, hit.u, hit.v, shape, 0);
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

/* Seen from the side of its normal, p[0], p[2], p[1] go counterclockwise. */
static bool triangle_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    const Triangle *s = (const Triangle *)shape;
    uint32_t v[3];
    (void)chord_error;
    for (int i = 0; i < 3; i++) {
        Vec3 n = s->is_smooth ? vec_normalize(s->n[i]) : s->normal;
        v[i] = mesh_sink_vertex(out, (MeshVertex){ s->p[i], n, { s->p[i].x, s->p[i].y } });
    }
    mesh_sink_triangle(out, v[0], v[2], v[1]);
    return true;
}

/* POV-Ray makes normals unit as it reads them. Those that were made unit after a scaling are so where that has been applied:
 * there the triangle is written, already placed. */
static bool is_weighted(const Triangle *s)
{
    static const double ROUNDING = 1e-12;   /* of lengths that are 1 */
    for (int i = 0; s->is_smooth && i < 3; i++)
        if (fabs(vec_length(s->n[i]) - 1) > ROUNDING) return true;
    return false;
}

static void triangle_write(const Shape *shape, Sdl *out)
{
    const Triangle *s = (const Triangle *)shape;
    Xform none = xform_identity();
    out->is_placed = out->placement && is_weighted(s);
    const Xform *x = out->is_placed ? out->placement : &none;
    sdl_text(out, "%s {", shape->type->name);
    for (int i = 0; i < 3; i++) {
        if (i > 0) sdl_text(out, ",");
        sdl_vec(out, xform_point(x, s->p[i]));
        if (s->is_smooth) sdl_text(out, ","), sdl_vec(out, xform_normal(x, s->n[i]));
    }
}

static const ShapeType triangle_type = {
    .name = "triangle", .bounds = triangle_bounds, .hit = triangle_hit, .attributes = triangle_attributes,
    .tessellate = triangle_tessellate, .write = triangle_write,
};
static const ShapeType smooth_triangle_type = {
    .name = "smooth_triangle", .bounds = triangle_bounds, .hit = triangle_hit, .attributes = triangle_attributes,
    .tessellate = triangle_tessellate, .write = triangle_write,
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

Shape *smooth_triangle_scaled(Arena *a, Shape *s, const Xform *placement)
{
    if (s->type != &smooth_triangle_type) return s;
    Triangle *scaled = make(a, s->type, ((const Triangle *)s)->p);
    scaled->is_smooth = true;
    for (int i = 0; i < 3; i++) {
        Vec3 n = ((const Triangle *)s)->n[i];
        double length = vec_length(xform_normal(placement, n));
        scaled->n[i] = length > 0 ? vec_scale(n, 1 / length) : n;
    }
    return &scaled->shape;
}
