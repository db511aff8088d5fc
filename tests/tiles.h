/* What tests of single tiles share: random tiles, and roots as they are found. */
#ifndef TRIMRAY_TESTS_TILES_H
#define TRIMRAY_TESTS_TILES_H

#include "nurbs/certify.h"
#include "nurbs/doubt.h"
#include "tests/test.h"

typedef struct { Arena *arena; PatchGroup group; Trace trace; } Fixture;

static inline int set_up(void **state)
{
    static Fixture f;
    f = (Fixture){ .arena = arena_new(), .trace.scratch = arena_new() };
    f.group.arena = f.arena;
    *state = &f;
    return 0;
}

static inline int tear_down(void **state)
{
    Fixture *f = *state;
    arena_free(f->arena);
    arena_free(f->trace.scratch);
    return 0;
}

/* A patch in an arena, of points that may be off by `error`, and the tile that is all of it; p is moved. */
static inline Tile *rounded_tile(Fixture *f, int k_u, int k_v, Vec4 *p, double error)
{
    Patch *patch = ARENA_NEW(f->arena, Patch);
    Tile *tile = ARENA_NEW(f->arena, Tile);
    patch_make(f->arena, k_u, k_v, (WideNet){ p, NULL }, error, (TrimRect){ 0, 1, 0, 1 }, patch);
    patch->group = &f->group;
    tile_make(patch, patch->p, (TilePlace){ 0, 0, 1, 1 }, tile);
    return tile;
}

static inline Tile *new_tile(Fixture *f, int k_u, int k_v, Vec4 *p) { return rounded_tile(f, k_u, k_v, p, 0); }

/* A height field over the unit square, orders 2 to 6, weights within a factor `ratio` of each other, anywhere in space. */
static inline Tile *random_tile(Fixture *f, TestRandom *r, double bump, double ratio)
{
    int k_u = test_int(r, 2, 6), k_v = test_int(r, 2, 6);
    Vec4 p[36];
    Vec3 shift = vec(test_range(r, -5, 5), test_range(r, -5, 5), test_range(r, -5, 5));
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i < k_u; i++) {
            double w = pow(ratio, test_unit(r));
            p[j * k_u + i] = vec4_weighted(vec4(shift.x + i / (k_u - 1.0), shift.y + j / (k_v - 1.0),
                                                shift.z + test_range(r, -bump, bump), w));
        }
    return new_tile(f, k_u, k_v, p);
}

static inline Vec3 point_of(const Tile *f, double s, double t)   /* about the tile's middle */
{
    Vec4 value, by_s, by_t;
    tile_evaluate(f, &s, &t, &value, &by_s, &by_t);
    return vec_sub(vec4_project(value), tile_vec(f->middle));
}

static inline Vec3 middle_of(const Tile *f) { return vec_add(f->patch->origin, tile_vec(f->middle)); }

/* A part of a tile, some halvings down. */
static inline const Tile *random_part(TestRandom *r, const Tile *tile)
{
    for (int n = test_int(r, 0, 4); n > 0 && tile_halves(tile); n--) tile = &tile_halves(tile)->tiles[test_int(r, 0, 1)];
    return tile;
}

static inline Vec3 random_direction(TestRandom *r)
{
    for (;;) {
        Vec3 d = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
        if (vec_length2(d) > 0.01 && vec_length2(d) < 1) return vec_normalize(d);
    }
}

typedef struct { int n; double s[64], t[64], depth[64], error[64]; } Found;

static inline bool collect(void *context, const Tile *p, PatchRay *ray, const Root *root)
{
    Found *f = context;
    (void)p, (void)ray;
    assert_true(f->n < 64);
    f->s[f->n] = root->s, f->t[f->n] = root->t, f->depth[f->n] = root->depth, f->error[f->n++] = root->depth_error;
    return false;
}

static inline bool keep_nearest(void *context, const Tile *p, PatchRay *ray, const Root *root)
{
    double *nearest = context;
    (void)p;
    *nearest = ray->t_max = root->depth;
    return false;
}

static inline bool has_depth(const Found *f, double depth, double slack)
{
    for (int i = 0; i < f->n; i++)
        if (fabs(f->depth[i] - depth) <= f->error[i] + slack) return true;
    return false;
}

/* A ray from about a point of the tile or its margin, a little off it to any side. */
static inline PatchRay random_ray_from(TestRandom *r, const Tile *p)
{
    TilePlace in = tile_place(p);
    double s = in.s0 + test_range(r, -.05, 1.05) * in.ds, t = in.t0 + test_range(r, -.05, 1.05) * in.dt;
    s = double_min(double_max(s, 0), 1), t = double_min(double_max(t, 0), 1);
    Vec3 at = vec_add(middle_of(p), point_of(p, (s - in.s0) / in.ds, (t - in.t0) / in.dt));
    Vec3 start = vec_add(at, vec_scale(random_direction(r), pow(10, test_range(r, -13, 0))));
    double t_min = test_int(r, 0, 2) ? 0 : pow(10, test_range(r, -10, 0));
    PatchRay ray = patch_ray(start, random_direction(r), t_min, INFINITY);
    ray.from = p->patch, ray.from_s = s, ray.from_t = t;
    return ray;
}

#endif
