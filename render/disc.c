/* disc { centre, normal, radius [, hole radius] }: the points of a plane with hole <= distance from the centre <= radius.
 *
 * t = n.(c - o) / (n.dir). Error: c - o has a relative error of u, the product with n adds 3u of its length, across the
 * plane; the slope is off by 3u |dir|, which moves the point by 3u t |dir|; two more roundings by 2u t |dir|.
 *
 * A new primitive may begin as a copy of this file: the struct begins with its Shape, the functions of the table come in the
 * table's order, and the constructor refuses what describes no shape. */
#include "render/mesh_sink.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct { Shape shape; Vec3 centre, normal; double radius, hole; } Disc;

static const double POINT_ERROR = 8 * 0x1p-53;    /* of |c - o| + t |dir| */

/* A circle's extent along axis k is the radius times the sine of the angle between the normal and that axis. */
static Box disc_bounds(const Shape *shape)
{
    const Disc *d = (const Disc *)shape;
    static const double ROUNDING = 1 + 8 * 0x1p-53;         /* of the normal, hypot and the product */
    Vec3 n = d->normal, sine = vec(hypot(n.y, n.z), hypot(n.z, n.x), hypot(n.x, n.y));
    return box_around(d->centre, vec_scale(sine, d->radius * ROUNDING));
}

static bool disc_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    const Disc *d = (const Disc *)shape;
    t->counters.primitive_tests++;
    Vec3 to_centre = vec_sub(d->centre, r->origin);
    double t_hit = vec_dot(d->normal, to_centre) / vec_dot(d->normal, r->dir);    /* edge on: infinite or NaN, */
    if (!(t_hit > r->t_min && t_hit < best->t)) return false;                     /* which fail here */
    double r2 = vec_length2(vec_sub(vec_scale(r->dir, t_hit), to_centre));
    if (!(r2 <= d->radius * d->radius && r2 >= d->hole * d->hole)) return false;
    hit_set(best, t_hit, POINT_ERROR * (vec_length(to_centre) / vec_length(r->dir) + t_hit), 0, 0, shape, 0);
    return true;
}

/* Below its plane, however far out, as it is for POV-Ray. */
static bool disc_inside(const Shape *shape, Vec3 p)
{
    const Disc *d = (const Disc *)shape;
    return vec_dot(d->normal, vec_sub(p, d->centre)) < 0;
}

static Box disc_inside_bounds(const Shape *shape)
{
    (void)shape;
    return box_infinite();
}

static void disc_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    (void)r, (void)h;
    out->normal = out->shading_normal = ((const Disc *)shape)->normal;
}

static bool disc_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    static const double PI = 3.14159265358979323846;
    const Disc *d = (const Disc *)shape;
    int n = mesh_arc_steps(d->radius, 2 * PI, chord_error);
    mesh_sink_strip(out, mesh_circle(d->centre, d->normal, d->radius), mesh_circle(d->centre, d->normal, d->hole), n);
    return true;
}

static void disc_write(const Shape *shape, Sdl *out)
{
    const Disc *d = (const Disc *)shape;
    sdl_text(out, "disc {");
    sdl_vec(out, d->centre), sdl_text(out, ","), sdl_vec(out, d->normal), sdl_text(out, ","), sdl_number(out, d->radius);
    if (d->hole > 0) sdl_text(out, ","), sdl_number(out, d->hole);
}

static const ShapeType disc_type = {
    .name = "disc", .bounds = disc_bounds, .hit = disc_hit, .inside = disc_inside,
    .inside_bounds = disc_inside_bounds, .attributes = disc_attributes,
    .tessellate = disc_tessellate, .write = disc_write,
};

Shape *disc_new(Arena *a, Vec3 centre, Vec3 normal, double radius, double hole_radius)
{
    if (!(vec_max_abs(normal) > 0) || !vec_is_finite(normal) || !vec_is_finite(centre)) return NULL;
    if (!(fabs(radius) > 0) || !isfinite(radius) || !isfinite(hole_radius)) return NULL;
    Disc *d = ARENA_NEW(a, Disc);
    shape_init(&d->shape, &disc_type);
    d->centre = centre;
    d->normal = vec_normalize(normal);
    d->radius = fabs(radius);
    d->hole = fabs(hole_radius);
    return &d->shape;
}
