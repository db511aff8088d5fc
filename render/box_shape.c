/* box { corner, corner }: six faces; axis k has face 2k (at lo) and 2k + 1 (at hi).
 *
 * The ray's interval in each slab is ((lo - o)/d, (hi - o)/d): two roundings each, so a hit is off by at most 2u t along the
 * ray, whatever the coordinates, and beside a face the sign of t is always right. A ray within a face (0/0 = NaN) belongs to
 * the box: the comparisons pass over a NaN. Of two faces that are met at once, within that error, the one that the ray faces
 * more wins, as in POV-Ray. */
#include "render/hit_list.h"
#include "render/mesh_sink.h"
#include "render/sdl.h"
#include "render/shapes.h"

typedef struct { Shape shape; double lo[3], hi[3]; } BoxShape;

static const double T_ERROR = 4 * 0x1p-53;    /* relative to t; choosing between two faces adds as much again for each */

static Box box_shape_bounds(const Shape *shape)
{
    const BoxShape *b = (const BoxShape *)shape;
    return box_from(vec(b->lo[0], b->lo[1], b->lo[2]), vec(b->hi[0], b->hi[1], b->hi[2]));
}

typedef struct { double t; int face; double facing; } Crossing;    /* facing: |dir| along the face's axis */

/* Is a met clearly after b, or at once with it and faced more? */
static bool is_later(Crossing a, Crossing b)
{
    double error = T_ERROR * (fabs(a.t) + fabs(b.t));
    if (!isfinite(error)) return a.t > b.t;
    return a.t > b.t + error || (a.t >= b.t - error && a.facing > b.facing);
}

static bool is_sooner(Crossing a, Crossing b)
{
    double error = T_ERROR * (fabs(a.t) + fabs(b.t));
    if (!isfinite(error)) return a.t < b.t;
    return a.t < b.t - error || (a.t <= b.t + error && a.facing > b.facing);
}

/* Where the ray's line enters and leaves; false: nowhere. */
static bool box_crossings(const BoxShape *b, const Ray *r, Crossing *enter, Crossing *leave)
{
    const double origin[3] = { r->origin.x, r->origin.y, r->origin.z }, dir[3] = { r->dir.x, r->dir.y, r->dir.z };
    *enter = (Crossing){ -INFINITY, 0, 0 };
    *leave = (Crossing){ INFINITY, 0, 0 };
    for (int k = 0; k < 3; k++) {
        int backward = signbit(dir[k]) != 0;
        Crossing to_lo = { (b->lo[k] - origin[k]) / dir[k], 2 * k, fabs(dir[k]) };
        Crossing to_hi = { (b->hi[k] - origin[k]) / dir[k], 2 * k + 1, fabs(dir[k]) };
        Crossing first = backward ? to_hi : to_lo, last = backward ? to_lo : to_hi;
        if (is_later(first, *enter)) *enter = first;
        if (is_sooner(last, *leave)) *leave = last;
    }
    return enter->t <= leave->t + T_ERROR * fabs(leave->t) && enter->t < INFINITY && leave->t > -INFINITY;
}

static bool box_shape_hit(const Shape *shape, const Ray *r, Hit *best, Trace *t)
{
    Crossing enter, leave;
    t->counters.primitive_tests++;
    if (!box_crossings((const BoxShape *)shape, r, &enter, &leave)) return false;
    Crossing hit = enter.t > r->t_min ? enter : leave;
    if (!(hit.t > r->t_min && hit.t < best->t)) return false;
    hit_set(best, hit.t, 3 * T_ERROR * hit.t, 0, 0, shape, (uint32_t)hit.face);
    return true;
}

static void box_shape_all_hits(const Shape *shape, const Ray *r, HitList *out, Trace *t)
{
    Crossing enter, leave;
    t->counters.primitive_tests++;
    if (!box_crossings((const BoxShape *)shape, r, &enter, &leave)) return;
    hit_list_offer(out, r, fmin(enter.t, leave.t), 3 * T_ERROR * enter.t, shape, (uint32_t)enter.face);
    hit_list_offer(out, r, leave.t, 3 * T_ERROR * leave.t, shape, (uint32_t)leave.face);
}

static bool box_shape_inside(const Shape *shape, Vec3 p)
{
    const BoxShape *b = (const BoxShape *)shape;
    return b->lo[0] <= p.x && p.x <= b->hi[0] && b->lo[1] <= p.y && p.y <= b->hi[1] && b->lo[2] <= p.z && p.z <= b->hi[2];
}

/* POV-Ray's unfolding of the six faces onto a cross; q in [0, 1]^3. */
static Vec2 cross_uv(int face, Vec3 q)
{
    switch (face) {
    case 0: return vec2(q.z / 4, 1. / 3 + q.y / 3);
    case 1: return vec2(3. / 4 - q.z / 4, 1. / 3 + q.y / 3);
    case 2: return vec2(1. / 4 + q.x / 4, q.z / 3);
    case 3: return vec2(1. / 4 + q.x / 4, 1 - q.z / 3);
    case 4: return vec2(1 - q.x / 4, 1. / 3 + q.y / 3);
    default: return vec2(1. / 4 + q.x / 4, 1. / 3 + q.y / 3);
    }
}

static double fraction(double x, double lo, double hi) { return hi > lo ? fmax(0, fmin(1, (x - lo) / (hi - lo))) : 0; }

static void box_shape_attributes(const Shape *shape, const Ray *r, const Hit *h, Attributes *out)
{
    const BoxShape *b = (const BoxShape *)shape;
    Vec3 p = ray_at(r, h->t);
    double n[3] = { 0, 0, 0 };
    n[h->leaf / 2] = h->leaf % 2 ? 1 : -1;
    out->normal = out->shading_normal = vec(n[0], n[1], n[2]);
    out->uv = cross_uv((int)h->leaf, vec(fraction(p.x, b->lo[0], b->hi[0]), fraction(p.y, b->lo[1], b->hi[1]),
                                         fraction(p.z, b->lo[2], b->hi[2])));
}

static bool box_shape_tessellate(const Shape *shape, double chord_error, MeshSink *out)
{
    const BoxShape *b = (const BoxShape *)shape;
    (void)chord_error;
    for (int face = 0; face < 6; face++) {
        int k = face / 2, i = (k + 1) % 3, j = (k + 2) % 3, is_high = face % 2;
        uint32_t v[4];
        for (int corner = 0; corner < 4; corner++) {   /* counterclockwise from outside */
            double p[3], n[3] = { 0 };
            bool far_i = corner == 1 || corner == 2, far_j = corner >= 2;
            p[k] = is_high ? b->hi[k] : b->lo[k], n[k] = is_high ? 1 : -1;
            p[i] = (is_high ? far_i : far_j) ? b->hi[i] : b->lo[i];
            p[j] = (is_high ? far_j : far_i) ? b->hi[j] : b->lo[j];
            MeshVertex vertex = { vec(p[0], p[1], p[2]), vec(n[0], n[1], n[2]), { far_i, far_j } };
            v[corner] = mesh_sink_vertex(out, vertex);
        }
        mesh_sink_triangle(out, v[0], v[1], v[2]);
        mesh_sink_triangle(out, v[0], v[2], v[3]);
    }
    return true;
}

static void box_shape_write(const Shape *shape, Sdl *out)
{
    const BoxShape *b = (const BoxShape *)shape;
    sdl_text(out, "box {");
    sdl_vec(out, vec(b->lo[0], b->lo[1], b->lo[2])), sdl_text(out, ","), sdl_vec(out, vec(b->hi[0], b->hi[1], b->hi[2]));
}

static const ShapeType box_shape_type = {
    .name = "box", .bounds = box_shape_bounds, .hit = box_shape_hit, .all_hits = box_shape_all_hits,
    .inside = box_shape_inside, .attributes = box_shape_attributes,
    .tessellate = box_shape_tessellate, .write = box_shape_write,
};

Shape *box_shape_new(Arena *a, Vec3 corner, Vec3 other)
{
    if (!vec_is_finite(corner) || !vec_is_finite(other)) return NULL;
    BoxShape *b = ARENA_NEW(a, BoxShape);
    shape_init(&b->shape, &box_shape_type);
    const double p[3] = { corner.x, corner.y, corner.z }, q[3] = { other.x, other.y, other.z };
    for (int k = 0; k < 3; k++) b->lo[k] = fmin(p[k], q[k]), b->hi[k] = fmax(p[k], q[k]);
    return &b->shape;
}
