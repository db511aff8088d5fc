/* Random boxes with a tree over them, rays that go to a point and astray, and the truth about which boxes a ray meets. */
#ifndef TRIMRAY_TESTS_BOX_SCENES_H
#define TRIMRAY_TESTS_BOX_SCENES_H

#include "render/bvh.h"
#include "tests/test.h"

/* Truth: slabs in quadruple precision, which lose 2^-110 or so of what counts here. */
typedef __float128 Quad;

typedef struct { Quad near, far; } Interval;

static inline void cut(Interval *i, Quad lo, Quad hi, Quad o, Quad d)
{
    if (d == 0) {
        if (o < lo || o > hi) i->far = i->near - 1;
        return;
    }
    Quad a = (lo - o) / d, b = (hi - o) / d;
    if (a > b) {
        Quad c = a;
        a = b, b = c;
    }
    if (a > i->near) i->near = a;
    if (b < i->far) i->far = b;
}

/* sure: by more than the truth may be off. */
static inline bool meets(const Box *b, const Ray *r, double t_max, bool sure, double *t)
{
    const double o[3] = { r->origin.x, r->origin.y, r->origin.z }, d[3] = { r->dir.x, r->dir.y, r->dir.z };
    Interval i = { r->t_min, t_max };
    for (int k = 0; k < 3; k++) cut(&i, b->lo[k], b->hi[k], o[k], d[k]);
    *t = (double)i.near;
    Quad size = (i.near < 0 ? -i.near : i.near) + (i.far < 0 ? -i.far : i.far);
    return i.near <= i.far - (sure ? size * (Quad)0x1p-100 : 0);
}

/* ---- scenes ---- */

enum { MOST = 900 };

typedef struct {
    Arena *arena;
    uint32_t n;
    Box boxes[MOST];
    Bvh *tree;
    Vec3 apex;
    double size;                 /* about that of the tree */
} Scene;

static inline Vec3 any_vector(TestRandom *r, double size)
{
    double x = test_range(r, -size, size), y = test_range(r, -size, size);
    return vec(x, y, test_range(r, -size, size));
}

static inline Vec3 whole_vector(TestRandom *r, int size)
{
    int x = test_int(r, -size, size), y = test_int(r, -size, size);
    return vec(x, y, test_int(r, -size, size));
}

/* A point within, on a side, on an edge or a corner. */
static inline Vec3 point_of(TestRandom *r, const Box *b)
{
    double c[3];
    for (int k = 0; k < 3; k++) {
        int where = test_int(r, 0, 3);
        c[k] = where == 0 ? b->lo[k] : where == 1 ? b->hi[k] : b->lo[k] + test_unit(r) * ((double)b->hi[k] - b->lo[k]);
        if (c[k] > b->hi[k]) c[k] = b->hi[k];
    }
    return vec(c[0], c[1], c[2]);
}

/* Among the boxes, on one of them, about them, far off. */
static inline Vec3 any_apex(TestRandom *r, const Scene *s, Vec3 middle)
{
    switch (test_int(r, 0, 4)) {
    case 0: return vec_add(middle, any_vector(r, s->size));
    case 1: return point_of(r, &s->boxes[test_int(r, 0, (int)s->n - 1)]);
    case 2: return vec_add(middle, any_vector(r, 4 * s->size));
    case 3: return vec_add(middle, vec_scale(any_vector(r, s->size), exp2(test_range(r, 0, 40))));
    default: return vec_add(middle, vec(0, 0, -3 * s->size));
    }
}

/* Boxes of whole numbers, many of them flat, stand side by side: rays touch their sides. */
static inline Scene any_scene(TestRandom *r, bool is_whole)
{
    Scene s = { .arena = arena_new(), .n = (uint32_t)test_int(r, 30, MOST) };
    s.size = is_whole ? 16 : exp2(test_range(r, -30, 30));
    double off = is_whole || test_int(r, 0, 1) ? 0 : exp2(test_range(r, 0, 12));
    Vec3 middle = vec_scale(any_vector(r, s.size), off);
    double share = exp2(test_range(r, -6, -1));
    for (uint32_t i = 0; i < s.n; i++) {
        Vec3 c = is_whole ? whole_vector(r, 16) : vec_add(middle, any_vector(r, s.size));
        Vec3 to = is_whole ? vec_add(c, whole_vector(r, 2)) : vec_add(c, any_vector(r, share * s.size));
        s.boxes[i] = box_from(c, to);
    }
    s.tree = bvh_build(s.arena, s.boxes, s.n, BVH_SAH);
    s.apex = is_whole ? whole_vector(r, 40) : any_apex(r, &s, middle);
    return s;
}

static inline void free_scene(Scene *s)
{
    arena_free(s->arena);
}

/* Along an axis, an edge or a diagonal of the cube of faces; to a box; anywhere. */
static inline Vec3 any_way(TestRandom *r, const Scene *s)
{
    Vec3 way = whole_vector(r, 1);
    switch (test_int(r, 0, 3)) {
    case 0: return vec_max_abs(way) > 0 ? way : vec(0, -0., 1);
    case 1: return any_vector(r, 1);
    default: break;
    }
    way = vec_sub(point_of(r, &s->boxes[test_int(r, 0, (int)s->n - 1)]), s->apex);
    return vec_max_abs(way) > 0 ? way : vec(1, 0, 0);
}

typedef struct { Ray ray; double t_max; } Query;

static inline Query from_apex(TestRandom *r, const Scene *s)
{
    Vec3 way = any_way(r, s);
    if (test_int(r, 0, 1)) way = vec_normalize(way);
    double t_min = test_int(r, 0, 3) ? 0 : s->size * test_unit(r) / vec_length(way);
    return (Query){ { s->apex, way, t_min }, INFINITY };
}

/* Ends just before the apex, as shadow rays do (surface.h), and begins as far off as it may. */
static inline Query to_apex(TestRandom *r, const Scene *s)
{
    Vec3 way = any_way(r, s), origin = vec_add(s->apex, vec_scale(way, exp2(test_range(r, -4, 6))));
    Vec3 back = vec_sub(s->apex, origin), dir = vec_normalize(back);
    double reach = vec_dot(back, dir), size = vec_max_abs(origin) + vec_max_abs(s->apex);
    return (Query){ { origin, dir, 0 }, reach - 24 * 0x1p-53 * size };
}

/* Near the apex, but not through it; or through it and beyond. */
static inline Query astray(TestRandom *r, const Scene *s)
{
    Query q = test_int(r, 0, 1) ? from_apex(r, s) : to_apex(r, s);
    if (test_int(r, 0, 2) == 0) q.t_max = INFINITY;
    else q.ray.origin = vec_add(q.ray.origin, vec_scale(any_vector(r, s->size), exp2(test_range(r, -50, 0))));
    if (test_int(r, 0, 3) == 0) q.ray.t_min = -s->size;
    return q;
}

static inline Query any_query(TestRandom *r, const Scene *s)
{
    int kind = test_int(r, 0, 4);
    return kind == 0 ? astray(r, s) : kind % 2 ? from_apex(r, s) : to_apex(r, s);
}

#endif
