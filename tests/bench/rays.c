/* Ray sets: seeded, the same for all engines. */
#include "tests/bench/bench.h"

#define CAMERA_DISTANCE 2.0      /* from the centre, in diagonals */
#define CAMERA_HALF_WIDTH 0.5    /* of what it sees at the centre: the ball round the box fills the picture */
#define GRAZE 1e-5               /* how far a grazing ray may be from its tangent, in diagonals */
#define SHADOW_START 1e-4        /* where shadow rays begin, in diagonals: the errors of the meshes are to fit below it */

static RaySet set_new(Arena *a, const char *name, size_t n)
{
    return (RaySet){ .name = name, .rays = ARENA_ARRAY(a, Ray, n), .n = n };
}

static Vec3 random_unit(TestRandom *r)
{
    for (;;) {
        Vec3 v = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
        if (vec_length2(v) > 1e-4 && vec_length2(v) < 1) return vec_normalize(v);
    }
}

RaySet rays_camera(const Model *m, Arena *a, int size)
{
    RaySet set = set_new(a, "camera", (size_t)size * (size_t)size);
    set.is_coherent = true;
    Vec3 to = vec_normalize(vec(-0.35, -0.6, 0.75)), right = vec_normalize(vec_cross(vec(0, 1, 0), to));
    Vec3 up = vec_cross(to, right), eye = vec_sub(m->centre, vec_scale(to, CAMERA_DISTANCE * m->diagonal));
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            double i = (2 * (x + 0.5) / size - 1) * CAMERA_HALF_WIDTH, j = (1 - 2 * (y + 0.5) / size) * CAMERA_HALF_WIDTH;
            Vec3 d = vec_add(vec_scale(to, CAMERA_DISTANCE), vec_add(vec_scale(right, i), vec_scale(up, j)));
            set.rays[y * size + x] = (Ray){ eye, vec_normalize(d), 0 };
        }
    return set;
}

/* From outside the box through a point. */
static Ray ray_through(const Model *m, Vec3 p, Vec3 d)
{
    return (Ray){ vec_sub(p, vec_scale(d, m->diagonal)), d, 0 };
}

RaySet rays_random(const Model *m, Arena *a, size_t n)
{
    RaySet set = set_new(a, "random", n);
    TestRandom r = test_random(1);
    const float *lo = m->box.lo, *hi = m->box.hi;
    for (size_t i = 0; i < n; i++) {
        Vec3 p = vec(test_range(&r, lo[0], hi[0]), test_range(&r, lo[1], hi[1]), test_range(&r, lo[2], hi[2]));
        set.rays[i] = ray_through(m, p, random_unit(&r));
    }
    return set;
}

RaySet rays_shadow(const Model *m, Arena *a, const RaySet *camera, const double *t)
{
    size_t n = 0;
    for (size_t i = 0; i < camera->n; i++) n += isfinite(t[i]);
    RaySet set = set_new(a, "shadow", n);
    set.t_max = ARENA_ARRAY(a, double, n), set.is_coherent = true;
    for (size_t i = 0, k = 0; i < camera->n; i++) {
        if (!isfinite(t[i])) continue;
        Vec3 p = ray_at(&camera->rays[i], t[i]), to = vec_sub(m->light, p);
        set.rays[k] = (Ray){ p, vec_normalize(to), SHADOW_START * m->diagonal };
        set.t_max[k++] = vec_length(to);
    }
    return set;
}

/* ---- rays at places of the surfaces ---- */

typedef struct { Vec3 point, along, normal; } Place3;

static double random_parameter(TestRandom *r, const double *knots, int k, int n, bool on_knot)
{
    return on_knot ? knots[test_int(r, k - 1, n)] : test_range(r, knots[k - 1], knots[n]);
}

/* A point of a surface, on a knot line where asked for; along: a random tangent. */
static Place3 random_place(const Shape *const *shapes, const Model *m, TestRandom *r, bool on_knot)
{
    int i = test_int(r, 0, m->n - 1);
    const SurfaceDesc *s = &m->surfaces[i];
    bool by_u = test_int(r, 0, 1);
    double u = random_parameter(r, s->knots_u, s->order_u, s->n_u, on_knot && by_u);
    double v = random_parameter(r, s->knots_v, s->order_v, s->n_v, on_knot && !by_u);
    Place3 p;
    Vec3 s_u, s_v;
    nurbs_shape_point(shapes[i], u, v, &p.point, &s_u, &s_v);
    double angle = test_range(r, 0, 2 * M_PI);
    p.normal = vec_normalize(vec_cross(s_u, s_v));
    p.along = vec_normalize(vec_add(vec_scale(vec_normalize(s_u), cos(angle)), vec_scale(vec_normalize(s_v), sin(angle))));
    return p;
}

static const Shape *const *make_shapes(const Model *m, Arena *a)
{
    const Shape **shapes = ARENA_ARRAY(a, const Shape *, m->n);
    NurbsError error;
    for (int i = 0; i < m->n; i++) {
        SurfaceDesc bare = m->surfaces[i];
        bare.n_trims = 0;
        shapes[i] = nurbs_shape_new(a, &bare, &(NurbsOptions){ .method = NURBS_METHOD_CERTAIN }, &error, NULL, 0, NULL);
    }
    return shapes;
}

RaySet rays_grazing(const Model *m, Arena *a, size_t n)
{
    RaySet set = set_new(a, "grazing", n);
    TestRandom r = test_random(2);
    Arena *scratch = arena_new();
    const Shape *const *shapes = make_shapes(m, scratch);
    for (size_t i = 0; i < n; i++) {
        Place3 p = random_place(shapes, m, &r, false);
        Vec3 aside = vec_scale(p.normal, test_range(&r, -GRAZE, GRAZE) * m->diagonal);
        set.rays[i] = ray_through(m, vec_add(p.point, aside), p.along);
    }
    arena_free(scratch);
    return set;
}

RaySet rays_borders(const Model *m, Arena *a, size_t n)
{
    RaySet set = set_new(a, "borders", n);
    TestRandom r = test_random(3);
    Arena *scratch = arena_new();
    const Shape *const *shapes = make_shapes(m, scratch);
    for (size_t i = 0; i < n; i++)
        set.rays[i] = ray_through(m, random_place(shapes, m, &r, true).point, random_unit(&r));
    arena_free(scratch);
    return set;
}
