/* See model.h. */
#include "tests/stress/model.h"

#include <string.h>

Model model_new(Arena *a, Form form, Net net)
{
    return (Model){ .arena = a, .at = { .form = form }, .plain = net, .net = net };
}

static void measure(Model *m)
{
    Vec3 lo = { INFINITY, INFINITY, INFINITY }, hi = { -INFINITY, -INFINITY, -INFINITY };
    m->at.extent = 0;
    for (int i = 0; i < m->desc.n_u * m->desc.n_v; i++) {
        Vec4 p = m->desc.points[i];
        lo = vec(fmin(lo.x, p.x), fmin(lo.y, p.y), fmin(lo.z, p.z));
        hi = vec(fmax(hi.x, p.x), fmax(hi.y, p.y), fmax(hi.z, p.z));
        m->at.extent = fmax(m->at.extent, vec_length(vec(p.x, p.y, p.z)));
    }
    m->at.diagonal = vec_length(vec_sub(hi, lo)), m->size = m->at.diagonal / 2;
    m->at.k_sum = m->desc.order_u + m->desc.order_v;
}

void model_place(Model *m, const QuadMap *place)
{
    m->at.to_world = *place, m->at.to_local = quad_map_inverse(place);
    m->plain.p = arena_copy(m->arena, m->plain.p, (size_t)(m->plain.n[0] * m->plain.n[1]), sizeof(Quad4));
    net_map(&m->plain, place);
    net_map(&m->net, place);
    m->desc = net_round(m->arena, &m->net);
    measure(m);
}

void model_finish(Model *m, const QuadMap *place, const TrimLoopDesc *trims, int n_trims)
{
    model_place(m, place);
    m->desc.trims = trims, m->desc.n_trims = n_trims;
    for (int i = 0; i < N_METHODS; i++) {
        NurbsOptions options = { .method = i ? NURBS_METHOD_CERTAIN : NURBS_METHOD_PAPER };
        NurbsError error;
        memset(&error, 0, sizeof error);
        m->shape[i] = nurbs_shape_new(m->arena, &m->desc, &options, &error, NULL, 0, NULL);
        if (m->shape[i]) continue;
        fprintf(stderr, "stress: %s: the surface is refused: code %d, where %d, trim %d, index %d, other %d, %g\n",
                m->at.form.name, error.code, error.where, error.trim, error.index, error.other, error.value);
        exit(1);
    }
}

void model_truth(const Model *m, const Ray *r, Truth *out)
{
    if (m->truth) m->truth(m, r, out);
    else truth_of_form(&m->at, r, out);
}

Quad3 model_normal(const Model *m, Quad3 p)
{
    Quad3 n = m->at.form.gradient(&m->at.form, quad_map_point(&m->at.to_local, p));
    n = quad_map_normal(&m->at.to_local, n);
    Quad length = quad3_length(n);
    return length > 0 ? quad3_scale(n, 1 / length) : quad3(0, 0, 1);
}

Quad3 random_direction(TestRandom *r)
{
    for (;;) {
        Vec3 d = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
        double l = vec_length(d);
        if (l > .1 && l < 1) return quad3_scale(quad3_of(d), 1 / (Quad)l);
    }
}

QuadMap model_rotation(TestRandom *r, double scale)
{
    Quad3 x = random_direction(r), y = quad3_cross(x, random_direction(r));
    x = quad3_scale(x, 1 / quad3_length(x)), y = quad3_scale(y, 1 / quad3_length(y));
    return (QuadMap){ quad3_scale(x, scale), quad3_scale(y, scale), quad3_scale(quad3_cross(x, y), scale), { 0, 0, 0 } };
}

Ray ray_towards(const Model *m, Quad3 target, Quad3 dir, double distance, TestRandom *r)
{
    Quad3 unit = quad3_scale(dir, 1 / quad3_length(dir));
    Ray ray = { .origin = quad3_round(quad3_sub(target, quad3_scale(unit, (Quad)distance * m->size))) };
    Quad3 way = quad3_sub(target, quad3_of(ray.origin));
    ray.dir = quad3_round(quad3_scale(way, pow(10, test_range(r, -2, 2)) / quad3_length(way)));
    return ray;
}

Ray ray_anywhere(const Model *m, double knob, TestRandom *r)
{
    (void)knob;
    const Net *n = &m->plain;
    double u = test_unit(r) * n->knots[0][n->n[0]], v = test_unit(r) * n->knots[1][n->n[1]];
    Quad3 target = net_point(n, u, v);
    if (test_int(r, 0, 4) == 0) target = quad3_add(target, quad3_scale(random_direction(r), m->size * test_unit(r)));
    return ray_towards(m, target, random_direction(r), pow(10, test_range(r, -1, 1)), r);
}
