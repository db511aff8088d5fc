/* See form.h. Polynomial nets come from monomials: the Bernstein coefficients of x^p on [-1, 1] are its blossom at j ones
 * and n - j minus ones, the mean of their products by p. */
#include "tests/stress/form.h"

static HalfSpace half_space(double x, double y, double z, double at) { return (HalfSpace){ { x, y, z }, at }; }

static Quad binomial(int n, int i)
{
    Quad r = 1;
    for (int j = 0; j < i; j++) r = r * (n - j) / (j + 1);
    return r;
}

/* Coefficient j of x^p, in degree n. */
static Quad monomial(int n, int p, int j)
{
    Quad sum = 0;   /* of z^p in (1 + z)^j (1 - z)^(n-j) */
    for (int i = 0; i <= p; i++) {
        if (i > n - j || p - i > j) continue;
        sum += (i % 2 ? -1 : 1) * binomial(n - j, i) * binomial(j, p - i);
    }
    return sum / binomial(n, p);
}

typedef struct { Quad factor; int p, q; } Term;   /* factor u^p v^q */

static Quad terms_at(const Term *t, int count, const Net *n, int i, int j)
{
    Quad sum = 0;
    for (int m = 0; m < count; m++)
        sum += t[m].factor * monomial(n->k[0] - 1, t[m].p, i) * monomial(n->k[1] - 1, t[m].q, j);
    return sum;
}

/* A polynomial patch of up to two terms a coordinate (factor 0: none). */
static void fill(Arena *a, Net *n, int k_u, int k_v, const Term x[2], const Term y[2], const Term z[2])
{
    *n = net_new(a, k_u, 1, k_v, 1);
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i < k_u; i++)
            n->p[j * k_u + i] = (Quad4){ terms_at(x, 2, n, i, j), terms_at(y, 2, n, i, j), terms_at(z, 2, n, i, j), 1 };
}

/* A surface lies in the hull of its control points. */
static Form reaching(Form f, const Net *n)
{
    for (int i = 0; i < n->n[0] * n->n[1]; i++) {
        Quad4 p = n->p[i];
        f.reach = quad_max(f.reach, quad3_length(quad3(p.x / p.w, p.y / p.w, p.z / p.w)));
    }
    return f;
}

static const Term term_u[2] = { { 1, 1, 0 } }, term_v[2] = { { 1, 0, 1 } };

/* ---- revolution ---- */

/* A profile of m points {r, z, w} of order k, turned about z; u runs round. */
static void revolve(Arena *a, Net *n, int k, int pieces, Quad profile[][3])
{
    static const int x[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, y[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
    Quad half = quad_sqrt((Quad)1 / 2);
    *n = net_new(a, 3, 4, k, pieces);
    for (int j = 0; j < n->n[1]; j++)
        for (int i = 0; i < 9; i++) {
            Quad w = profile[j][2] * (i % 2 ? half : 1);
            n->p[j * 9 + i] = (Quad4){ w * profile[j][0] * x[i], w * profile[j][0] * y[i], w * profile[j][1], w };
        }
}

static Poly square_sum(Poly x, Poly y) { return poly_add(poly_mul(x, x), poly_mul(y, y)); }

static Poly sphere_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)f;
    return poly_add(poly_add(square_sum(x, y), poly_mul(z, z)), poly_constant(-1));
}
static Quad3 sphere_gradient(const Form *f, Quad3 p)
{
    (void)f;
    return quad3_scale(p, 2);
}

Form form_sphere(Arena *a, Net *n)
{
    Quad h = quad_sqrt((Quad)1 / 2);
    Quad profile[5][3] = { { 0, -1, 1 }, { 1, -1, h }, { 1, 0, 1 }, { 1, 1, h }, { 0, 1, 1 } };
    revolve(a, n, 3, 2, profile);
    return reaching((Form){ .name = "sphere", .along = sphere_along, .gradient = sphere_gradient, .hessian = 16 }, n);
}

static Poly torus_along(const Form *f, Poly x, Poly y, Poly z)
{
    Poly ring = square_sum(x, y), g = poly_add(poly_add(ring, poly_mul(z, z)), poly_constant(1 - f->par[0] * f->par[0]));
    return poly_add(poly_mul(g, g), poly_scale(ring, -4));
}
static Quad3 torus_gradient(const Form *f, Quad3 p)
{
    Quad g = quad3_dot(p, p) + 1 - f->par[0] * f->par[0];
    return quad3(4 * p.x * (g - 2), 4 * p.y * (g - 2), 4 * p.z * g);
}

Form form_torus(Arena *a, double minor, Net *n)
{
    static const int x[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 }, y[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
    Quad h = quad_sqrt((Quad)1 / 2), profile[9][3];
    for (int j = 0; j < 9; j++) {
        profile[j][0] = 1 + (Quad)minor * x[j], profile[j][1] = (Quad)minor * y[j];
        profile[j][2] = j % 2 ? h : 1;
    }
    revolve(a, n, 3, 4, profile);
    return reaching((Form){ .name = "torus", .along = torus_along, .gradient = torus_gradient, .hessian = 64,
                            .par = { minor } }, n);
}

static Poly cylinder_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)f, (void)z;
    return poly_add(square_sum(x, y), poly_constant(-1));
}
static Quad3 cylinder_gradient(const Form *f, Quad3 p)
{
    (void)f;
    return quad3(2 * p.x, 2 * p.y, 0);
}

Form form_cylinder(Arena *a, Net *n)
{
    Quad profile[2][3] = { { 1, -1, 1 }, { 1, 1, 1 } };
    revolve(a, n, 2, 1, profile);
    return reaching((Form){ .name = "cylinder", .along = cylinder_along, .gradient = cylinder_gradient, .hessian = 16,
                            .n_sides = 2, .side = { half_space(0, 0, 1, 1), half_space(0, 0, -1, 1) } }, n);
}

static Poly cone_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)f;
    return poly_add(square_sum(x, y), poly_scale(poly_mul(z, z), -1));
}
static Quad3 cone_gradient(const Form *f, Quad3 p)
{
    (void)f;
    return quad3(2 * p.x, 2 * p.y, -2 * p.z);
}

Form form_cone(Arena *a, Net *n)
{
    Quad profile[2][3] = { { 0, 0, 1 }, { 1, 1, 1 } };
    revolve(a, n, 2, 1, profile);
    return reaching((Form){ .name = "cone", .along = cone_along, .gradient = cone_gradient, .hessian = 16, .n_sides = 2,
                            .side = { half_space(0, 0, 1, 0), half_space(0, 0, -1, 1) } }, n);
}

/* ---- graphs over the square ---- */

static Poly plane_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)f, (void)x, (void)y;
    return z;
}
static Quad3 plane_gradient(const Form *f, Quad3 p)
{
    (void)f, (void)p;
    return quad3(0, 0, 1);
}

Form form_triangle(Arena *a, Net *n)
{
    *n = net_new(a, 2, 1, 2, 1);
    n->p[0] = n->p[1] = (Quad4){ 0, 0, 0, 1 };
    n->p[2] = (Quad4){ 1, 0, 0, 1 }, n->p[3] = (Quad4){ 0, 1, 0, 1 };
    double h = sqrt(.5);
    return reaching((Form){ .name = "triangle", .along = plane_along, .gradient = plane_gradient, .hessian = 16,
                            .n_sides = 3, .side = { half_space(1, 0, 0, 0), half_space(0, 1, 0, 0),
                                                    half_space(-h, -h, 0, h) } }, n);
}

static Form on_square(Form f, const Net *n)
{
    f.n_sides = 4;
    for (int i = 0; i < 4; i++) f.side[i] = half_space(i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0, 0, 1);
    return reaching(f, n);
}

static Poly minus_height(const Form *f, Poly z, Poly g) { return poly_add(z, poly_scale(g, -f->par[0])); }

static Poly saddle_along(const Form *f, Poly x, Poly y, Poly z) { return minus_height(f, z, poly_mul(x, y)); }
static Quad3 saddle_gradient(const Form *f, Quad3 p) { return quad3(-f->par[0] * p.y, -f->par[0] * p.x, 1); }

Form form_saddle(Arena *a, double height, Net *n)
{
    const Term z[2] = { { height, 1, 1 } };
    fill(a, n, 2, 2, term_u, term_v, z);
    return on_square((Form){ .name = "saddle", .along = saddle_along, .gradient = saddle_gradient, .hessian = 16,
                             .par = { height } }, n);
}

static Poly paraboloid_along(const Form *f, Poly x, Poly y, Poly z) { return minus_height(f, z, square_sum(x, y)); }
static Quad3 paraboloid_gradient(const Form *f, Quad3 p)
{
    return quad3(-2 * f->par[0] * p.x, -2 * f->par[0] * p.y, 1);
}

Form form_paraboloid(Arena *a, double height, Net *n)
{
    const Term z[2] = { { height, 2, 0 }, { height, 0, 2 } };
    fill(a, n, 3, 3, term_u, term_v, z);
    return on_square((Form){ .name = "paraboloid", .along = paraboloid_along, .gradient = paraboloid_gradient, .hessian = 16,
                             .par = { height } }, n);
}

static Poly monkey_along(const Form *f, Poly x, Poly y, Poly z)
{
    Poly xx = poly_mul(x, x), yy = poly_mul(y, y);
    return minus_height(f, z, poly_mul(x, poly_add(xx, poly_scale(yy, -3))));
}
static Quad3 monkey_gradient(const Form *f, Quad3 p)
{
    Quad h = f->par[0];
    return quad3(-3 * h * (p.x * p.x - p.y * p.y), 6 * h * p.x * p.y, 1);
}

Form form_monkey(Arena *a, double height, Net *n)
{
    const Term z[2] = { { height, 3, 0 }, { -3 * (Quad)height, 1, 2 } };
    fill(a, n, 4, 3, term_u, term_v, z);
    return on_square((Form){ .name = "monkey saddle", .along = monkey_along, .gradient = monkey_gradient, .hessian = 16,
                             .par = { height } }, n);
}

static Poly flat_point_along(const Form *f, Poly x, Poly y, Poly z)
{
    Poly xy = poly_mul(x, y);
    return minus_height(f, z, poly_mul(xy, xy));
}
static Quad3 flat_point_gradient(const Form *f, Quad3 p)
{
    return quad3(-2 * f->par[0] * p.x * p.y * p.y, -2 * f->par[0] * p.x * p.x * p.y, 1);
}

Form form_flat_point(Arena *a, double height, Net *n)
{
    const Term z[2] = { { height, 2, 2 } };
    fill(a, n, 4, 4, term_u, term_v, z);
    return on_square((Form){ .name = "flat point", .along = flat_point_along, .gradient = flat_point_gradient, .hessian = 16,
                             .par = { height } }, n);
}

/* ---- extrusions along z ---- */

/* The conic through (1, 0) and (0, 1) with (0, 0) between them: with f1 = 1 - x - y it is f1^2 = 4 weight^2 x y. The arc
 * is where 0 <= f1 <= 1; beyond are the rest of an ellipse, or the other branch of a hyperbola. */
static Poly bend_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)z;
    Poly f1 = poly_add(poly_constant(1), poly_scale(poly_add(x, y), -1));
    return poly_add(poly_mul(f1, f1), poly_scale(poly_mul(x, y), -4 * f->par[0] * f->par[0]));
}
static Quad3 bend_gradient(const Form *f, Quad3 p)
{
    Quad f1 = 1 - p.x - p.y, w2 = f->par[0] * f->par[0];
    return quad3(-2 * f1 - 4 * w2 * p.y, -2 * f1 - 4 * w2 * p.x, 0);
}

Form form_bend(Arena *a, double weight, Net *n)
{
    *n = net_new(a, 3, 1, 2, 1);
    for (int j = 0; j < 2; j++) {
        Quad z = 2 * j - 1;
        n->p[3 * j] = (Quad4){ 1, 0, z, 1 }, n->p[3 * j + 2] = (Quad4){ 0, 1, z, 1 };
        n->p[3 * j + 1] = (Quad4){ 0, 0, weight * z, weight };
    }
    double h = sqrt(.5);
    return reaching((Form){ .name = "bend", .along = bend_along, .gradient = bend_gradient, .par = { weight },
                            .hessian = 16 * (Quad)weight * weight, .n_sides = 4,
                            .side = { half_space(-h, -h, 0, h), half_space(h, h, 0, 0), half_space(0, 0, 1, 1),
                                      half_space(0, 0, -1, 1) } }, n);
}

/* x^2 = y (y - size)^2, y <= 1 */
static Poly loop_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)z;
    Poly g = poly_add(y, poly_constant(-f->par[0]));
    return poly_add(poly_mul(x, x), poly_scale(poly_mul(y, poly_mul(g, g)), -1));
}
static Quad3 loop_gradient(const Form *f, Quad3 p)
{
    Quad g = p.y - f->par[0];
    return quad3(2 * p.x, -g * g - 2 * p.y * g, 0);
}

Form form_loop(Arena *a, double size, Net *n)
{
    const Term x[2] = { { 1, 3, 0 }, { -(Quad)size, 1, 0 } }, y[2] = { { 1, 2, 0 } };
    fill(a, n, 4, 2, x, y, term_v);
    return reaching((Form){ .name = "loop", .along = loop_along, .gradient = loop_gradient, .hessian = 16, .par = { size },
                            .n_sides = 3, .side = { half_space(0, -1, 0, 1), half_space(0, 0, 1, 1),
                                                    half_space(0, 0, -1, 1) } }, n);
}

static Poly whitney_along(const Form *f, Poly x, Poly y, Poly z)
{
    (void)f;
    Poly g = poly_mul(z, poly_add(poly_mul(z, z), y));
    return poly_add(poly_scale(x, -1), g);
}
static Quad3 whitney_gradient(const Form *f, Quad3 p)
{
    (void)f;
    return quad3(-1, p.z, 3 * p.z * p.z + p.y);
}

Form form_whitney(Arena *a, Net *n)
{
    const Term x[2] = { { 1, 3, 0 }, { 1, 1, 1 } };   /* u = z, v = y */
    fill(a, n, 4, 2, x, term_v, term_u);
    return reaching((Form){ .name = "whitney", .along = whitney_along, .gradient = whitney_gradient, .hessian = 16,
                            .n_sides = 4, .side = { half_space(0, 0, 1, 1), half_space(0, 0, -1, 1), half_space(0, 1, 0, 1),
                                                    half_space(0, -1, 0, 1) } }, n);
}
