/* Shapes with a closed form in all disguises, and the rays that find their weak places. See family.h. */
#include "tests/stress/family.h"

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

/* ---- what is common ---- */

static Form any_form(Arena *a, TestRandom *r, Net *n)
{
    switch (test_int(r, 0, 8)) {
    case 0: return form_sphere(a, n);
    case 1: return form_torus(a, test_range(r, .05, .9), n);
    case 2: return form_cylinder(a, n);
    case 3: return form_cone(a, n);
    case 4: return form_paraboloid(a, test_range(r, -2, 2), n);
    case 5: return form_saddle(a, test_range(r, -2, 2), n);
    case 6: return form_monkey(a, test_range(r, -1, 1), n);
    case 7: return form_flat_point(a, test_range(r, -2, 2), n);
    default: return form_whitney(a, n);
    }
}

/* Turned and moved a little: nothing is exact by accident. */
static Model finished(Model m, double size, TestRandom *r)
{
    QuadMap place = model_rotation(r, size);
    place.o = quad3_scale(random_direction(r), size * test_unit(r));
    model_finish(&m, &place, NULL, 0);
    return m;
}

static Model any_model(Arena *a, TestRandom *r)
{
    Net n;
    Form f = any_form(a, r, &n);
    return model_new(a, f, n);
}

/* ---- disguises ---- */

static Model build_mobius(Arena *a, double ratio, TestRandom *r)
{
    Model m = any_model(a, r);
    int which = test_int(r, 1, 3);
    double turned = test_int(r, 0, 1) ? ratio : 1 / ratio;
    if (which == 3) turned = sqrt(turned);
    if (which & 1) net_mobius(&m.net, NET_U, turned);
    if (which & 2) net_mobius(&m.net, NET_V, turned);
    return finished(m, 1, r);
}

static Model build_degree(Arena *a, double order, TestRandom *r)
{
    Model m = any_model(a, r);
    int which = test_int(r, 1, 3);
    for (int axis = 0; axis < 2; axis++)
        if ((which >> axis & 1) && m.net.k[axis] < order) net_raise(a, &m.net, axis, (int)order);
    return finished(m, 1, r);
}

static double domain_end(const Net *n, int axis) { return n->knots[axis][n->n[axis]]; }

/* Spans whose lengths differ by up to the ratio: the pieces', and those that inserted knots make. */
static Model build_spacing(Arena *a, double ratio, TestRandom *r)
{
    Model m = any_model(a, r);
    for (int axis = 0; axis < 2; axis++) {
        double lengths[64];
        for (int i = 0; i < 64; i++) lengths[i] = i % 2 ? pow(ratio, -test_unit(r)) : 1;
        if (test_int(r, 0, 1)) net_set_lengths(&m.net, axis, lengths);
        for (int i = 0; i < 5; i++) {
            double t = domain_end(&m.net, axis) * pow(ratio, -test_unit(r)) * test_range(r, .5, .9);
            net_insert(a, &m.net, axis, t);
        }
    }
    return finished(m, 1, r);
}

/* Pairs of knots so close together; 0: neighbouring doubles. */
static Model build_coincident(Arena *a, double gap, TestRandom *r)
{
    Model m = any_model(a, r);
    for (int axis = 0; axis < 2; axis++)
        for (int i = 0; i < 3; i++) {
            double t = domain_end(&m.net, axis) * test_range(r, .01, .99), next = nextafter(t, INFINITY);
            net_insert(a, &m.net, axis, t);
            net_insert(a, &m.net, axis, fmax(next, t * (1 + gap)));
        }
    return finished(m, 1, r);
}

static Model build_aspect(Arena *a, double aspect, TestRandom *r)
{
    Model m = any_model(a, r);
    QuadMap first = model_rotation(r, 1), place = model_rotation(r, 1);
    double squeeze[3] = { 1, pow(aspect, test_int(r, 0, 1) ? -1 : -test_unit(r)), 1 / aspect };
    Quad3 *columns[3] = { &first.x, &first.y, &first.z };
    for (int i = 0; i < 3; i++) {   /* place * squeeze * first */
        Quad3 c = *columns[i];
        *columns[i] = quad_map_vector(&place, quad3(c.x * squeeze[0], c.y * squeeze[1], c.z * squeeze[2]));
    }
    model_finish(&m, &first, NULL, 0);
    return m;
}

static Model build_size(Arena *a, double size, TestRandom *r) { return finished(any_model(a, r), size, r); }

static Model build_offset(Arena *a, double offset, TestRandom *r)
{
    Model m = any_model(a, r);
    QuadMap place = model_rotation(r, 1);
    place.o = quad3_scale(random_direction(r), offset);
    if (test_int(r, 0, 2) == 0) place.o.x = 0;
    model_finish(&m, &place, NULL, 0);
    return m;
}

static Model build_any(Arena *a, double knob, TestRandom *r)
{
    (void)knob;
    return finished(any_model(a, r), 1, r);
}

static Ray ray_from_far(const Model *m, double knob, TestRandom *r)
{
    Ray ray = ray_anywhere(m, knob, r);
    Quad3 d = quad3_of(ray.dir);
    Quad back = knob * m->size / quad3_length(d);
    ray.origin = quad3_round(quad3_sub(quad3_of(ray.origin), quad3_scale(d, back)));
    return ray;
}

/* ---- stiff, flat, folded ---- */

static Model build_bend(Arena *a, double radius, TestRandom *r)
{
    Net n;
    Form f = form_bend(a, 1 / sqrt(radius), &n);
    return finished(model_new(a, f, n), 1, r);
}

/* Half of the rays go to the bend itself. */
static Ray ray_at_bend(const Model *m, double radius, TestRandom *r)
{
    if (test_int(r, 0, 1)) return ray_anywhere(m, radius, r);
    double z = test_range(r, -1, 1), by = radius * test_range(r, -10, 10);
    Quad corner = 1 / (2 + 2 * m->at.form.par[0]);   /* x = y at the shoulder of the conic */
    Quad3 target = quad_map_point(&m->at.to_world, quad3(corner + by * test_unit(r), corner - by * test_unit(r), z));
    return ray_towards(m, target, random_direction(r), pow(10, test_range(r, -1, 1)), r);
}

static Model build_flat(Arena *a, double height, TestRandom *r)
{
    Net n;
    Form f;
    switch (test_int(r, 0, 3)) {
    case 0: f = form_saddle(a, height, &n); break;
    case 1: f = form_paraboloid(a, height, &n); break;
    case 2: f = form_monkey(a, height, &n); break;
    default: f = form_flat_point(a, height, &n); break;
    }
    return finished(model_new(a, f, n), 1, r);
}

/* From all sides, and along the surface. */
static Ray ray_along_flat(const Model *m, double height, TestRandom *r)
{
    if (test_int(r, 0, 1)) return ray_anywhere(m, height, r);
    Quad3 target = quad_map_point(&m->at.to_world, quad3(test_range(r, -1, 1), test_range(r, -1, 1), 0));
    Quad3 dir = quad3(test_range(r, -1, 1), test_range(r, -1, 1), height * test_range(r, -4, 4));
    return ray_towards(m, target, quad_map_vector(&m->at.to_world, dir), 2, r);
}

static Model build_loop(Arena *a, double size, TestRandom *r)
{
    Net n;
    Form f = form_loop(a, size, &n);
    return finished(model_new(a, f, n), 1, r);
}

static Ray ray_at_loop(const Model *m, double size, TestRandom *r)
{
    if (test_int(r, 0, 1)) return ray_anywhere(m, size, r);
    double by = pow(10, test_range(r, -16, 0));
    Quad3 target = quad3(by * test_range(r, -1, 1), size * test_unit(r) + by * test_range(r, -1, 1), test_range(r, -1, 1));
    return ray_towards(m, quad_map_point(&m->at.to_world, target), random_direction(r), pow(10, test_range(r, -1, 1)), r);
}

static Model build_whitney(Arena *a, double by, TestRandom *r)
{
    (void)by;
    Net n;
    Form f = form_whitney(a, &n);
    return finished(model_new(a, f, n), 1, r);
}

/* Along z, beside the cusp of the contour: x^2 = -4/27 y^3. */
static Ray ray_at_cusp(const Model *m, double by, TestRandom *r)
{
    double y = -pow(10, test_range(r, -8, 0)) * test_int(r, 0, 1), contour = sqrt(4 / 27. * -y * y * y);
    Quad3 target = quad3(contour * (2 * test_int(r, 0, 1) - 1) + by * test_range(r, -1, 1), y, 0);
    Quad3 dir = quad3(by * test_range(r, -1, 1), by * test_range(r, -1, 1), 2 * test_int(r, 0, 1) - 1);
    return ray_towards(m, quad_map_point(&m->at.to_world, target), quad_map_vector(&m->at.to_world, dir), 1, r);
}

/* ---- poles, tangents, borders ---- */

static Model build_pole(Arena *a, double by, TestRandom *r)
{
    (void)by;
    Net n;
    Form f;
    switch (test_int(r, 0, 2)) {
    case 0: f = form_sphere(a, &n); break;
    case 1: f = form_cone(a, &n); break;
    default: f = form_triangle(a, &n); break;
    }
    Model m = model_new(a, f, n);
    if (test_int(r, 0, 1)) net_raise(a, &m.net, NET_V, test_int(r, 3, 5));
    return finished(m, 1, r);
}

static Ray ray_at_pole(const Model *m, double by, TestRandom *r)
{
    const Net *n = &m->plain;
    double v = test_int(r, 0, 1) ? 0 : domain_end(n, NET_V);
    Quad3 target = net_point(n, test_unit(r) * domain_end(n, NET_U), v);
    target = quad3_add(target, quad3_scale(random_direction(r), by * m->size));
    return ray_towards(m, target, random_direction(r), pow(10, test_range(r, -1, 1)), r);
}

static Model build_round(Arena *a, double by, TestRandom *r)
{
    (void)by;
    Net n;
    Form f;
    switch (test_int(r, 0, 5)) {
    case 0: f = form_sphere(a, &n); break;
    case 1: f = form_torus(a, test_range(r, .1, .6), &n); break;
    case 2: f = form_cylinder(a, &n); break;
    case 3: f = form_paraboloid(a, 1, &n); break;
    case 4: f = form_monkey(a, 1, &n); break;
    default: f = form_saddle(a, 1, &n); break;
    }
    return finished(model_new(a, f, n), 1, r);
}

/* Along a tangent, raised above or sunk below the surface by `by` sizes. */
static Ray ray_grazing(const Model *m, double by, TestRandom *r)
{
    const Net *n = &m->plain;
    Quad3 p = net_point(n, test_unit(r) * domain_end(n, 0), test_unit(r) * domain_end(n, 1)), normal = model_normal(m, p);
    Quad3 tangent = quad3_cross(normal, random_direction(r));
    Quad3 target = quad3_add(p, quad3_scale(normal, by * m->size * (2 * test_int(r, 0, 1) - 1)));
    return ray_towards(m, target, tangent, pow(10, test_range(r, -.5, 1)), r);
}

/* From a point on the surface, into any direction; `by` sizes off it. */
static Ray ray_starting_on(const Model *m, double by, TestRandom *r)
{
    const Net *n = &m->plain;
    Quad3 p = net_point(n, test_unit(r) * domain_end(n, 0), test_unit(r) * domain_end(n, 1)), normal = model_normal(m, p);
    Ray ray = ray_towards(m, p, random_direction(r), 1, r);
    ray.origin = quad3_round(quad3_add(p, quad3_scale(normal, by * m->size * (2 * test_int(r, 0, 1) - 1))));
    return ray;
}

static Model build_ruled(Arena *a, double by, TestRandom *r)
{
    (void)by;
    Net n;
    Form f;
    switch (test_int(r, 0, 4)) {
    case 0: f = form_cylinder(a, &n); break;
    case 1: f = form_cone(a, &n); break;
    case 2: f = form_saddle(a, 1, &n); break;
    case 3: f = form_saddle(a, 0, &n); break;
    default: f = form_triangle(a, &n); break;
    }
    return finished(model_new(a, f, n), 1, r);
}

/* Along a ruling, `by` sizes beside it. */
static Ray ray_in_surface(const Model *m, double by, TestRandom *r)
{
    const Net *n = &m->plain;
    double u = test_unit(r) * domain_end(n, 0);
    Quad3 p = net_point(n, u, 0), q = net_point(n, u, domain_end(n, 1));
    Quad3 side = quad3_scale(random_direction(r), by * m->size);
    Ray ray = ray_towards(m, quad3_add(p, side), quad3_sub(q, p), test_int(r, 0, 3) ? test_range(r, .1, 4) : 0, r);
    if (vec_length(ray.dir) > 0) return ray;
    ray.dir = quad3_round(quad3_sub(q, p));
    return ray;
}

static Model build_knotty(Arena *a, double by, TestRandom *r)
{
    (void)by;
    Model m = any_model(a, r);
    for (int axis = 0; axis < 2; axis++)
        for (int i = test_int(r, 0, 3); i > 0; i--)
            net_insert(a, &m.net, axis, domain_end(&m.net, axis) * test_range(r, .05, .95));
    return finished(m, 1, r);
}

static double any_knot(const Net *n, int axis, TestRandom *r)
{
    return n->knots[axis][test_int(r, n->k[axis] - 1, n->n[axis])];
}

/* At a knot line, or where two of them cross: borders, corners, poles and seams among them; `by` sizes beside. */
static Ray ray_at_knot(const Model *m, double by, TestRandom *r)
{
    const Net *n = &m->net;
    int which = test_int(r, 1, 3);
    double u = which & 1 ? any_knot(n, 0, r) : test_unit(r) * domain_end(n, 0);
    double v = which & 2 ? any_knot(n, 1, r) : test_unit(r) * domain_end(n, 1);
    Quad3 target = quad3_add(net_point(n, u, v), quad3_scale(random_direction(r), by * m->size));
    return ray_towards(m, target, random_direction(r), pow(10, test_range(r, -1, 1)), r);
}

/* ---- special directions ---- */

/* Not turned, at the origin or at a round place. */
static Model build_upright(Arena *a, double tiny, TestRandom *r)
{
    (void)tiny;
    Model m = any_model(a, r);
    QuadMap place = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } };
    if (test_int(r, 0, 1)) place.o = quad3(test_int(r, -2, 2), test_int(r, -2, 2), test_int(r, -2, 2));
    model_finish(&m, &place, NULL, 0);
    return m;
}

/* Along an axis; the other components are +-tiny, one of them +-1 sometimes. */
static Ray ray_along_axis(const Model *m, double tiny, TestRandom *r)
{
    double d[3], o[3];
    int axis = test_int(r, 0, 2), other = test_int(r, 0, 5);
    Quad3 c = m->at.to_world.o;
    const double centre[3] = { (double)c.x, (double)c.y, (double)c.z };
    for (int i = 0; i < 3; i++) {
        d[i] = i == axis || i == other ? 1 : tiny;
        if (test_int(r, 0, 1)) d[i] = -d[i];
        double at[4] = { 0, test_range(r, -1, 1), .5, copysign(0, test_range(r, -1, 1)) };
        o[i] = centre[i] + at[test_int(r, 0, 3)] - 3 * (i == axis || i == other ? d[i] : 0);
    }
    return (Ray){ vec(o[0], o[1], o[2]), vec(d[0], d[1], d[2]), 0 };
}

#define FALLING 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-15, 0

const Family stress_shapes[] = {
    { "mobius", "ratio of the weights", 5, { 1, 1e3, 1e6, 1e9, 1e12 }, build_mobius, ray_anywhere, 1 },
    { "degree", "order", 7, { 4, 6, 8, 12, 16, 24, 32 }, build_degree, ray_anywhere, .5 },
    { "spacing", "ratio of the spans", 5, { 1, 1e3, 1e6, 1e9, 1e12 }, build_spacing, ray_anywhere, 1 },
    { "coincident", "gap between knots", 5, { 1e-3, 1e-6, 1e-9, 1e-12, 0 }, build_coincident, ray_anywhere, 1 },
    { "aspect", "aspect", 5, { 1e1, 1e2, 1e4, 1e6, 1e8 }, build_aspect, ray_anywhere, 1 },
    { "size", "size", 5, { 1e-8, 1e-4, 1, 1e4, 1e8 }, build_size, ray_anywhere, 1 },
    { "offset", "distance from the origin", 5, { 0, 1e2, 1e4, 1e6, 1e8 }, build_offset, ray_anywhere, 1 },
    { "far", "distance of the ray's origin", 4, { 1e2, 1e4, 1e6, 1e8 }, build_any, ray_from_far, 1 },
    { "bend", "radius", 8, { 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8 }, build_bend, ray_at_bend, 1 },
    { "flat", "height", 7, { 1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-16, 0 }, build_flat, ray_along_flat, 1 },
    { "loop", "size of the loop", 7, { .5, 1e-1, 1e-2, 1e-4, 1e-8, 1e-12, 0 }, build_loop, ray_at_loop, 1 },
    { "cusp", "distance", 12, { FALLING }, build_whitney, ray_at_cusp, .5 },
    { "pole", "distance", 12, { FALLING }, build_pole, ray_at_pole, .5 },
    { "graze", "distance", 12, { FALLING }, build_round, ray_grazing, 1 },
    { "start", "distance", 12, { FALLING }, build_round, ray_starting_on, .5 },
    { "ruling", "distance", 12, { FALLING }, build_ruled, ray_in_surface, .5 },
    { "knot", "distance", 12, { FALLING }, build_knotty, ray_at_knot, .5 },
    { "axis", "other components", 6, { 0, 5e-324, 1e-300, 1e-100, 1e-20, 1e-8 }, build_upright, ray_along_axis, 1 },
};
const int n_stress_shapes = COUNT(stress_shapes);

int family_count(void) { return n_stress_shapes + n_stress_trims + n_stress_certified; }

const Family *family_at(int i)
{
    if (i < n_stress_shapes) return &stress_shapes[i];
    i -= n_stress_shapes;
    return i < n_stress_trims ? &stress_trims[i] : &stress_certified[i - n_stress_trims];
}
