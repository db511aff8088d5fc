/* sphere { centre, radius }
 *
 * With f = origin - centre, |f + t d|^2 = r^2 is a t^2 - 2 b t + c = 0 with a = d.d, b = -f.d, c = |f|^2 - r^2. The
 * discriminant b^2 - ac loses all digits for an origin far away; it equals a (r^2 - |foot|^2), where foot = f + (b/a) d is
 * the point of the ray nearest to the centre, and that does not ([Hai19]). c is (|f| - r)(|f| + r); the roots are q/a and
 * c/q with q = b +- sqrt(a disc), which do not cancel.
 *
 * Error: f and its length have relative errors of 2u, so the foot is off by at most 4u|f|, disc by 2r 4u|f| + 4u r^2, which
 * moves the point by at most 4u|f| + 2u r across the surface. Beside the surface (|f| <= 2r) c is off by 2u|f| 3r, which is
 * 3u|f| across it; farther out c has a relative error of at most 6u, q and the division add 4u: 10u (|f| + r) along the ray.
 * 16u (|f| + r) covers the sum. */
#include "render/hit_list.h"
#include "render/mesh_sink.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct { Shape shape; Vec3 centre; double radius; } Sphere;

static const double POINT_ERROR = 16 * 0x1p-53;

static Box sphere_bounds(const Shape *shape)
{
    const Sphere *s = (const Sphere *)shape;
    return box_around(s->centre, vec(s->radius, s->radius, s->radius));
}

/* Both roots, ascending; false: the ray's line misses. */
static bool sphere_roots(const Sphere *s, const Ray *r, Vec3 f, double root[2])
{
    double a = vec_length2(r->dir), b = -vec_dot(f, r->dir), distance = vec_length(f);
    Vec3 foot = vec_add(f, vec_scale(r->dir, b / a));
    double disc = s->radius * s->radius - vec_length2(foot);
    if (!(disc >= 0)) return false;
    double c = (distance - s->radius) * (distance + s->radius);
    double q = b + copysign(sqrt(a * disc), b), x1 = q / a, x2 = c / q;
    root[0] = fmin(x1, x2);           /* q = 0: a tangent at the origin itself; fmin passes over the NaN of 0/0 */
    root[1] = fmax(x1, x2);
    return true;
}

static double sphere_error(const Sphere *s, const Ray *r, Vec3 f)
{
    return POINT_ERROR * (vec_length(f) + s->radius) / vec_length(r->dir);
}

static bool sphere_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Sphere *s = (const Sphere *)shape;
    double root[2];
    t->counters.primitive_tests++;
    Vec3 f = vec_sub(r->origin, s->centre);
    if (!sphere_roots(s, r, f, root)) return false;
    double t_hit = root[0] > r->t_min ? root[0] : root[1];
    if (!(t_hit > r->t_min && t_hit < best->t)) return false;
    hit_set(best, t_hit, sphere_error(s, r, f), 0, 0, shape, 0);
    return true;
}

static void sphere_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    const Sphere *s = (const Sphere *)shape;
    double root[2];
    t->counters.primitive_tests++;
    Vec3 f = vec_sub(r->origin, s->centre);
    if (!sphere_roots(s, r, f, root)) return;
    for (int i = 0; i < 2; i++) hit_list_offer(out, r, root[i], sphere_error(s, r, f), shape, 0);
}

static bool sphere_inside(const Shape *shape, Vec3 p)
{
    const Sphere *s = (const Sphere *)shape;
    return vec_length2(vec_sub(p, s->centre)) < s->radius * s->radius;
}

static void sphere_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    static const double PI = 3.14159265358979323846;
    const Sphere *s = (const Sphere *)shape;
    Vec3 n = vec_normalize(vec_sub(ray_at(r, h->t), s->centre));
    out->normal = out->shading_normal = n;
    if (out->is_without_uv) return;
    double u = atan2(n.z, n.x) / (2 * PI);
    out->uv = vec2(u < 0 ? u + 1 : u, .5 + asin(fmax(-1, fmin(1, n.y))) / PI);
}

/* The poles and the seam get the same point each time. */
static MeshVertex sphere_at(const void *context, double u, double v)
{
    static const double PI = 3.14159265358979323846;
    const Sphere *s = context;
    double angle = u < 1 ? 2 * PI * u : 0, height = PI * (v - .5), ring = v > 0 && v < 1 ? cos(height) : 0;
    Vec3 n = vec(ring * cos(angle), sin(height), ring * sin(angle));
    return (MeshVertex){ vec_add(s->centre, vec_scale(n, s->radius)), n, { u, v } };
}

/* Half of the error for each direction. Walked from z to x, so that the outside is where the normals are. */
static MeshVertex sphere_turned(const void *context, double u, double v) { return sphere_at(context, 1 - u, v); }

static bool sphere_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    static const double PI = 3.14159265358979323846;
    const Sphere *s = (const Sphere *)shape;
    int n_u = mesh_arc_steps(s->radius, 2 * PI, chord_error / 2), n_v = mesh_arc_steps(s->radius, PI, chord_error / 2);
    mesh_sink_grid(out, n_u < 3 ? 3 : n_u, n_v < 2 ? 2 : n_v, sphere_turned, s);
    return true;
}

static void sphere_write(const Shape *shape, Sdl *out)
{
    const Sphere *s = (const Sphere *)shape;
    sdl_text(out, "sphere {");
    sdl_vec(out, s->centre), sdl_text(out, ","), sdl_number(out, s->radius);
}

static const ShapeType sphere_type = {
    .name = "sphere", .bounds = sphere_bounds, .hit = sphere_hit, .all_hits = sphere_all_hits,
    .inside = sphere_inside, .attributes = sphere_attributes, .tessellate = sphere_tessellate,
    .write = sphere_write,
};

Shape *sphere_new(Arena *a, Vec3 centre, double radius)
{
    if (!(fabs(radius) > 0) || !isfinite(radius) || !vec_is_finite(centre)) return NULL;
    Sphere *s = ARENA_NEW(a, Sphere);
    shape_init(&s->shape, &sphere_type);
    s->centre = centre;
    s->radius = fabs(radius);
    return &s->shape;
}
