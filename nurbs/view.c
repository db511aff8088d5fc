/* Boxes of a patch in the frame of a ray: making, restricting, evaluating. See view.h. */
#include "nurbs/view.h"

#include "nurbs/patch_kernel.h"
#include "nurbs/restrict.h"

#include <float.h>
#include <math.h>
#include <string.h>

View view_of(Arena *scratch, const Patch *p, const PatchRay *r)
{
    Vec3 o = vec_sub(r->origin, p->origin);
    double q1 = vec_dot(r->n1, o), q2 = vec_dot(r->n2, o);
    View v = { .k_u = p->k_u, .k_v = p->k_v, .p = ARENA_ARRAY(scratch, Vec4, p->k_u * p->k_v), .w_s = 1, .w_t = 1,
               .is_polynomial = p->is_polynomial };
    for (int i = 0; i < p->k_u * p->k_v; i++) {
        Vec4 h = p->p[i];
        Vec3 x = vec(h.x, h.y, h.z);
        v.p[i] = vec4(vec_dot(r->n1, x) - h.w * q1, vec_dot(r->n2, x) - h.w * q2, vec_dot(r->d, x), h.w);
    }
    return v;
}

View view_copy(Arena *scratch, const View *v)
{
    View copy = *v;
    copy.p = arena_copy(scratch, v->p, (size_t)(v->k_u * v->k_v), sizeof *v->p);
    return copy;
}

/* ---- restricting ---- */

EVERY_X86
static void restrict_points(View *v, bool along_s, Range part)
{
    if (v->k_u == 4 && v->k_v == 4) restrict_net(v->p, 4, 4, along_s, part.lo, part.hi);    /* unrolled */
    else restrict_net(v->p, v->k_u, v->k_v, along_s, part.lo, part.hi);
}

/* Of a combination (restrict.h); where both ends move, the second one's shares have two of their own each, and the end moves
 * by as much. */
static int roundings(Range part)
{
    int before = part.hi < 1 ? part.hi == 0.5 ? 1 : 3 : 0, after = part.lo > 0 ? part.hi == 1 && part.lo == 0.5 ? 1 : 3 : 0;
    return before + after + (before && after ? 2 : 0);
}

/* k - 1 combinations; and as many of the weight, if it is not 1. The error of (x, y) is that of both. */
void view_restrict(View *v, bool along_s, Range part)
{
    if (part.lo <= 0 && part.hi >= 1) return;
    restrict_points(v, along_s, part);
    double *start = along_s ? &v->s0 : &v->t0, *width = along_s ? &v->w_s : &v->w_t;
    *start += part.lo * *width, *width *= part.hi - part.lo;
    int n = roundings(part) * ((along_s ? v->k_u : v->k_v) - 1) * (v->is_polynomial ? 1 : 2);
    v->lost += M_SQRT2 * 0.5 * DBL_EPSILON * n * v->size, v->drift += 0.5 * DBL_EPSILON * n;
}

/* A half has an eighth of the roundings of other parts, and takes half the time. */
#define FEW_HALVINGS 0x1p-5

/* To a dyadic part: by halvings, unless there are many. */
static void restrict_to(View *v, bool along_s, double from, double width)
{
    const double *at = along_s ? &v->s0 : &v->t0, *wide = along_s ? &v->w_s : &v->w_t;
    if (width < FEW_HALVINGS) view_restrict(v, along_s, (Range){ from, from + width });
    while (*wide > width) {
        bool is_second = from >= *at + 0.5 * *wide;
        view_restrict(v, along_s, is_second ? (Range){ 0.5, 1 } : (Range){ 0, 0.5 });
    }
}

View view_of_tile(Arena *scratch, const Tile *f, const PatchRay *r)
{
    View v = view_of(scratch, f->patch, r);
    TilePlace at = tile_place(f);
    view_extent(&v);
    restrict_to(&v, true, at.s0, at.ds);
    restrict_to(&v, false, at.t0, at.dt);
    return v;
}

View view_of_tile_in_haste(Arena *scratch, const Tile *f, const PatchRay *r)
{
    View v = view_of(scratch, f->patch, r);
    TilePlace at = tile_place(f);
    view_extent(&v);
    view_restrict(&v, true, (Range){ at.s0, at.s0 + at.ds });
    view_restrict(&v, false, (Range){ at.t0, at.t0 + at.dt });
    return v;
}

/* ---- bounds ---- */

static double size_over_weight(const View *v)
{
    double size = 0;
    for (int i = 0; i < v->k_u * v->k_v; i++)
        size = double_max(size, double_max(fabs(v->p[i].x), fabs(v->p[i].y)) / v->p[i].w);
    return size;
}

EVERY_X86
ViewExtent view_extent(View *v)
{
    ViewExtent e = { { v->p->x, v->p->x }, { v->p->y, v->p->y }, v->p->w };
    double w_min = v->p->w;
    for (int i = 1; i < v->k_u * v->k_v; i++) {
        const Vec4 *p = &v->p[i];
        e.x.lo = double_min(p->x, e.x.lo), e.x.hi = double_max(p->x, e.x.hi);
        e.y.lo = double_min(p->y, e.y.lo), e.y.hi = double_max(p->y, e.y.hi);
        e.w_max = double_max(p->w, e.w_max), w_min = double_min(p->w, w_min);
    }
    double most = double_max(double_max(e.x.hi, -e.x.lo), double_max(e.y.hi, -e.y.lo));
    v->size = e.w_max <= 2 * w_min ? most / w_min : size_over_weight(v);
    return e;
}

bool view_is_off(const View *v, double x, double y, double error)
{
    double far = error * hypot(x, y);
    for (int i = 0; i < v->k_u * v->k_v; i++)
        if (!(x * v->p[i].x + y * v->p[i].y > far * v->p[i].w)) return false;
    return true;
}

/* A quotient of convex combinations lies between the extreme quotients of the coefficients. */
Range view_depth(const View *v)
{
    Range r = { INFINITY, -INFINITY };
    for (int i = 0; i < v->k_u * v->k_v; i++) {
        double d = v->p[i].z / v->p[i].w;
        r.lo = double_min(r.lo, d), r.hi = double_max(r.hi, d);
    }
    return r;
}

/* ---- points ---- */

ALWAYS_INLINE Jet jet_of(double value, double by_s, double by_t, double w_s, double w_t, double over_w)
{
    double x = value * over_w;
    return (Jet){ x, (by_s - x * w_s) * over_w, (by_t - x * w_t) * over_w };
}

ViewPoint view_point(const View *v, double s, double t)
{
    Patch patch = { .k_u = v->k_u, .k_v = v->k_v, .p = v->p };
    Vec4 h, h_s, h_t;
    patch_evaluate(&patch, s, t, &h, &h_s, &h_t);
    double over_w = 1 / h.w;
    return (ViewPoint){ s, t, jet_of(h.x, h_s.x, h_t.x, h_s.w, h_t.w, over_w),
                        jet_of(h.y, h_s.y, h_t.y, h_s.w, h_t.w, over_w), jet_of(h.z, h_s.z, h_t.z, h_s.w, h_t.w, over_w) };
}

/* ---- the depth on the ray ---- */

/* Over the weight, as all depths. */
static double slanted(const Vec4 *p, Vec2 slant) { return (p->z - slant.x * p->x - slant.y * p->y) / p->w; }

/* Along the longer axis of the ellipse that the Jacobian at the middle makes of a circle. */
static Vec2 best_slant(const View *v)
{
    ViewPoint m = view_point(v, 0.5, 0.5);
    double xx = m.x.by_s * m.x.by_s + m.x.by_t * m.x.by_t, yy = m.y.by_s * m.y.by_s + m.y.by_t * m.y.by_t;
    Vec2 axis = vec2_longer_axis(xx, m.x.by_s * m.y.by_s + m.x.by_t * m.y.by_t, yy);
    double by_s = axis.x * m.x.by_s + axis.y * m.y.by_s, by_t = axis.x * m.x.by_t + axis.y * m.y.by_t;
    return vec2_scale(axis, (by_s * m.z.by_s + by_t * m.z.by_t) / (by_s * by_s + by_t * by_t));
}

static double length_of(Range r) { return r.hi - r.lo; }

DepthOnRay view_depth_on_ray(const View *v, double error)
{
    DepthOnRay plain = { .range = view_depth(v) }, out = { .range = { INFINITY, -INFINITY }, .slant = best_slant(v) };
    out.slack = vec2_length(out.slant) * error;
    for (int i = 0; i < v->k_u * v->k_v; i++) {
        double d = slanted(&v->p[i], out.slant);
        out.range.lo = double_min(out.range.lo, d), out.range.hi = double_max(out.range.hi, d);
    }
    return length_of(out.range) + 2 * out.slack < length_of(plain.range) ? out : plain;
}

/* ---- which side is longer ---- */

Lengths view_image(const View *v)
{
    Lengths most = { 0, 0 };
    for (int j = 0; j < v->k_v; j++)
        for (int i = 0; i < v->k_u; i++) {
            const Vec4 *p = v->p + j * v->k_u + i, *next = p + 1, *above = p + v->k_u;
            if (i + 1 < v->k_u) most.by_s = double_max(most.by_s, double_max(fabs(next->x - p->x), fabs(next->y - p->y)));
            if (j + 1 < v->k_v) most.by_t = double_max(most.by_t, double_max(fabs(above->x - p->x), fabs(above->y - p->y)));
        }
    return (Lengths){ (v->k_u - 1) * most.by_s, (v->k_v - 1) * most.by_t };
}

Lengths view_depths(const View *v, Vec2 slant)
{
    Lengths most = { 0, 0 };
    for (int j = 0; j < v->k_v; j++)
        for (int i = 0; i < v->k_u; i++) {
            const Vec4 *p = v->p + j * v->k_u + i;
            double depth = slanted(p, slant);
            if (i + 1 < v->k_u) most.by_s = double_max(most.by_s, fabs(slanted(p + 1, slant) - depth));
            if (j + 1 < v->k_v) most.by_t = double_max(most.by_t, fabs(slanted(p + v->k_u, slant) - depth));
        }
    return (Lengths){ (v->k_u - 1) * most.by_s, (v->k_v - 1) * most.by_t };
}
