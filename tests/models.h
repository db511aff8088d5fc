/* NURBS surfaces for tests: random ones over random knots, and ones with a closed form. */
#ifndef TRIMRAY_MODELS_H
#define TRIMRAY_MODELS_H

#include "nurbs/nurbs.h"
#include "tests/test.h"

#include <string.h>

#define MODEL_MAX_KNOTS 96
#define MODEL_MAX_POINTS 1600

/* A SurfaceDesc with its arrays; model_desc() points the one at the others. */
typedef struct {
    int k_u, k_v, n_u, n_v;
    double knots_u[MODEL_MAX_KNOTS], knots_v[MODEL_MAX_KNOTS];
    Vec4 points[MODEL_MAX_POINTS];
} Model;

static inline SurfaceDesc model_desc(const Model *m)
{
    return (SurfaceDesc){ .order_u = m->k_u, .order_v = m->k_v, .n_u = m->n_u, .n_v = m->n_v,
                          .knots_u = m->knots_u, .knots_v = m->knots_v, .points = m->points };
}

/* Knots of order k with every kind of multiplicity from 1 to `most`, at the ends up to k: clamped ends, unclamped ones and
 * what lies between. Spans are log-uniform over four decades. Returns n, the number of control points. */
static inline int model_random_knots(TestRandom *r, int k, int n_spans, int most, double *knots)
{
    double t = test_range(r, -1, 1);
    int count = 0, before = test_int(r, 0, k - 1);
    for (int i = 0; i < before; i++) knots[count++] = t - test_unit(r) * (before - i > 1);   /* knots before the domain */
    for (int i = 1; i < before; i++) if (knots[i] < knots[i - 1]) knots[i] = knots[i - 1];
    for (int i = 0; i < k - before; i++) knots[count++] = t;
    for (int span = 0; span < n_spans; span++) {
        t += pow(10, test_range(r, -3, 1));
        int run = span == n_spans - 1 ? 1 : test_int(r, 1, most);
        for (int i = 0; i < run; i++) knots[count++] = t;
    }
    int n = count - 1, clamped = test_int(r, 0, k - 1);                /* knots[n] ends the domain */
    for (int i = 1; i < k; i++) knots[count++] = i <= clamped ? t : (t += test_unit(r));
    return n;
}

static inline void model_random_points(TestRandom *r, Model *m, double weight_ratio)
{
    for (int i = 0; i < m->n_u * m->n_v; i++) {
        double w = weight_ratio > 1 ? exp(test_range(r, 0, log(weight_ratio))) : 1;
        m->points[i] = vec4(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1), w);
    }
}

static const double model_circle_knots[12] = { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 };

/* Point i of 9 of the unit circle as four rational quadratic arcs: {x, y, weight}. */
static inline Vec3 model_circle(int i)
{
    static const int corner[8][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 }, { -1, 0 }, { -1, -1 }, { 0, -1 }, { 1, -1 } };
    return vec(corner[i % 8][0], corner[i % 8][1], i % 2 ? sqrt(0.5) : 1);
}

/* The profile (r, z, weight) turned about the z axis, u round the axis. */
static inline void model_revolve(Model *m, int k_v, int n_v, const double *knots_v, const Vec3 *profile)
{
    *m = (Model){ .k_u = 3, .k_v = k_v, .n_u = 9, .n_v = n_v };
    memcpy(m->knots_u, model_circle_knots, sizeof model_circle_knots);
    memcpy(m->knots_v, knots_v, (size_t)(n_v + k_v) * sizeof *knots_v);
    for (int j = 0; j < n_v; j++)
        for (int i = 0; i < 9; i++) {
            Vec3 c = model_circle(i);
            m->points[j * 9 + i] = vec4(c.x * profile[j].x, c.y * profile[j].x, profile[j].y, c.z * profile[j].z);
        }
}

static inline void model_sphere(Model *m)      /* radius 1, poles on the z axis */
{
    static const double knots[8] = { 0, 0, 0, 1, 1, 2, 2, 2 };
    const Vec3 profile[5] = { { 0, -1, 1 }, { 1, -1, sqrt(0.5) }, { 1, 0, 1 }, { 1, 1, sqrt(0.5) }, { 0, 1, 1 } };
    model_revolve(m, 3, 5, knots, profile);
}

static inline void model_cylinder(Model *m)    /* radius 1, |z| <= 1, open */
{
    static const double knots[4] = { 0, 0, 1, 1 };
    static const Vec3 profile[2] = { { 1, -1, 1 }, { 1, 1, 1 } };
    model_revolve(m, 2, 2, knots, profile);
}

static inline void model_torus(Model *m, double minor)      /* major radius 1 */
{
    Vec3 profile[9];
    for (int i = 0; i < 9; i++) {
        Vec3 c = model_circle(i);
        profile[i] = vec(1 + minor * c.x, minor * c.y, c.z);
    }
    model_revolve(m, 3, 9, model_circle_knots, profile);
}

static inline void model_scale(Model *m, double s)
{
    for (int i = 0; i < m->n_u * m->n_v; i++) m->points[i].x *= s, m->points[i].y *= s, m->points[i].z *= s;
}

#endif
