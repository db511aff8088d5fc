/* torus { major R, minor r }, about the y axis: with h = sqrt(x^2 + z^2), g = (h - R)^2 + y^2 - r^2 = 0.
 *
 * Squared free of the root: (|p|^2 + R^2 - r^2)^2 = 4 R^2 h^2, a quartic along a line. From the point c of the ray
 * nearest to the centre, with a unit direction e (so c.e = 0) and x the way from there, it is depressed: with G = |c|^2 +
 * R^2 - r^2
 *     x^4 + (2G - 4R^2 (1 - e_y^2)) x^2 + 8R^2 c_y e_y x + G^2 - 4R^2 (c_x^2 + c_z^2) = 0,
 * (c_x e_x + c_z e_z = -c_y e_y). Lengths are in units of R + r; |x| is at most sqrt(1 - |c|^2). The quartic sees the
 * torus with an error of some u R^2/r, much for a thin one; so its roots are polished on g itself (or, inside a spindle
 * torus with r > R, on (h + R)^2 + y^2 - r^2, the quartic's other factor), whose own error is a few u R (R + r), and a
 * distance of that over 2r. Where g stays above that error the quartic's root was a near miss, seen as a touch. */
#include "render/hit_list.h"
#include "render/roots.h"
#include "render/mesh_sink.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct { Shape shape; double major, minor; } Torus;

static const double U = 0x1p-53;

static Box torus_bounds(const Shape *shape)
{
    const Torus *s = (const Torus *)shape;
    double wide = s->major + s->minor;
    return box_around(vec(0, 0, 0), vec(wide, s->minor, wide));
}

/* A line in units of R + r, from its point nearest to the centre. */
typedef struct { Vec3 c, e; double R, r; } Line;

static int quartic_roots(const Line *l, double x[4])
{
    double c2 = vec_length2(l->c), reach2 = 1 - c2, R2 = l->R * l->R;
    if (!(reach2 >= 0)) return 0;
    double G = c2 + (l->R - l->r) * (l->R + l->r);
    const double q[5] = {
        G * G - 4 * R2 * (l->c.x * l->c.x + l->c.z * l->c.z), 8 * R2 * l->c.y * l->e.y,
        2 * G - 4 * R2 * (l->e.x * l->e.x + l->e.z * l->e.z), 0, 1,
    };
    double reach = sqrt(reach2) + sqrt(U);       /* the margin covers the rounding of 1 - |c|^2 near 0 */
    return roots_between(4, q, -reach, reach, x);
}

typedef struct { double g, slope; } Value;

/* g and its derivative along the line; `side` is -1, or 1 for the inner sheet of a spindle. */
static Value torus_value(const Line *l, double x, double side)
{
    Vec3 p = vec_add(l->c, vec_scale(l->e, x));
    double h = sqrt(p.x * p.x + p.z * p.z), w = h + side * l->R;
    double dh = h > 0 ? (p.x * l->e.x + p.z * l->e.z) / h : 0;
    return (Value){ w * w + (p.y - l->r) * (p.y + l->r), 2 * (w * dh + p.y * l->e.y) };
}

/* Newton on g, for as long as |g| falls: two or three steps. *distance gets what is left, as a distance from the surface. */
static double polish(const Line *l, double x, double *distance)
{
    double side = fabs(torus_value(l, x, -1).g) <= fabs(torus_value(l, x, 1).g) ? -1 : 1;
    Value v = torus_value(l, x, side);
    for (int i = 0; i < 8 && v.g != 0 && v.slope != 0; i++) {
        double next = x - v.g / v.slope;
        Value w = torus_value(l, next, side);
        if (!(fabs(w.g) < fabs(v.g))) break;
        x = next, v = w;
    }
    *distance = fabs(v.g) / (2 * l->r);
    return x;
}

/* h, p.y and the line's point are off by a few u (all lengths are at most 1): g by 2r times that, plus u r^2, at the
 * surface. */
static const double POINT_ERROR = 16 * 0x1p-53;

/* The places where the ray's line meets the torus, ascending; *error gets their t_error apart from 4u |t|. */
static int torus_roots(const Torus *s, const Ray *r, double root[4], double *error)
{
    double size = s->major + s->minor, length = vec_length(r->dir);
    double to_centre = -vec_dot(r->origin, r->dir) / (length * length);
    Line l = { vec_scale(ray_at(r, to_centre), 1 / size), vec_scale(r->dir, 1 / length), s->major / size, s->minor / size };
    double x[4];
    int n = quartic_roots(&l, x), n_kept = 0;
    for (int i = 0; i < n; i++) {
        double distance, t = to_centre + polish(&l, x[i], &distance) * size / length;
        if (!(distance > POINT_ERROR)) root[n_kept++] = t;
    }
    *error = POINT_ERROR * (vec_length(r->origin) + 2 * size) / length + 4 * U * fabs(to_centre);
    return n_kept;
}

static bool torus_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    double root[4], error;
    t->counters.primitive_tests++;
    int n = torus_roots((const Torus *)shape, r, root, &error);
    for (int i = 0; i < n; i++) {
        if (!(root[i] > r->t_min && root[i] < best->t)) continue;
        hit_set(best, root[i], error + 4 * U * root[i], 0, 0, shape, 0);
        return true;
    }
    return false;
}

static void torus_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    double root[4], error;
    t->counters.primitive_tests++;
    int n = torus_roots((const Torus *)shape, r, root, &error);
    for (int i = 0; i < n; i++) hit_list_offer(out, r, root[i], error + 4 * U * root[i], shape, 0);
}

static bool torus_inside(const Shape *shape, Vec3 p)
{
    const Torus *s = (const Torus *)shape;
    double w = hypot(p.x, p.z) - s->major;
    return w * w + p.y * p.y <= s->minor * s->minor;
}

/* Away from the circle in the middle of the tube; inside a spindle that is the circle's far side. */
static void torus_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    static const double PI = 3.14159265358979323846;
    const Torus *s = (const Torus *)shape;
    Vec3 p = ray_at(r, h->t);
    double radial = hypot(p.x, p.z);
    double outer = fabs(hypot(radial - s->major, p.y) - s->minor), inner = fabs(hypot(radial + s->major, p.y) - s->minor);
    double w = outer <= inner ? radial - s->major : radial + s->major;
    Vec3 n = radial > 0 ? vec(p.x / radial * w, p.y, p.z / radial * w) : vec(0, p.y, 0);
    out->normal = out->shading_normal = vec_normalize(n);
    if (out->is_without_uv) return;
    out->uv = vec2(1 - (atan2(p.z, p.x) + PI) / (2 * PI), (atan2(p.y, radial - s->major) + PI) / (2 * PI));
}

/* Walked so that the outside is where the normals are; both seams get the same points each time. */
static MeshVertex torus_at(const void *context, double u, double v)
{
    static const double PI = 3.14159265358979323846;
    const Torus *s = context;
    double angle = u < 1 ? 2 * PI * u : 0, turn = v < 1 ? 2 * PI * v : 0;
    Vec3 n = vec(cos(turn) * cos(angle), sin(turn), -cos(turn) * sin(angle));
    double ring = s->major + s->minor * cos(turn);
    return (MeshVertex){ vec(ring * cos(angle), s->minor * sin(turn), -ring * sin(angle)), n, { u, v } };
}

static bool torus_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    static const double PI = 3.14159265358979323846;
    const Torus *s = (const Torus *)shape;
    int n_u = mesh_arc_steps(s->major + s->minor, 2 * PI, chord_error / 2);
    int n_v = mesh_arc_steps(s->minor, 2 * PI, chord_error / 2);
    mesh_sink_grid(out, n_u < 3 ? 3 : n_u, n_v < 3 ? 3 : n_v, torus_at, s);
    return true;
}

static void torus_write(const Shape *shape, Sdl *out)
{
    const Torus *s = (const Torus *)shape;
    sdl_text(out, "torus {");
    sdl_number(out, s->major), sdl_text(out, ","), sdl_number(out, s->minor);
}

static const ShapeType torus_type = {
    .name = "torus", .bounds = torus_bounds, .hit = torus_hit, .all_hits = torus_all_hits,
    .inside = torus_inside, .attributes = torus_attributes, .tessellate = torus_tessellate,
    .write = torus_write,
};

Shape *torus_new(Arena *a, double major, double minor)
{
    if (!(major > 0) || !(minor > 0) || !isfinite(major + minor)) return NULL;
    Torus *s = ARENA_NEW(a, Torus);
    shape_init(&s->shape, &torus_type);
    s->major = major;
    s->minor = minor;
    return &s->shape;
}
