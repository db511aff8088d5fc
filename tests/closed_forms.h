/* Surfaces of revolution as NURBS, and where rays meet them by closed forms. */
#ifndef TRIMRAY_TESTS_CLOSED_FORMS_H
#define TRIMRAY_TESTS_CLOSED_FORMS_H

#include "render/roots.h"
#include "tests/models.h"

#define MINOR 0.4      /* of the torus */

/* The roots along a ray with a unit direction, ascending. */
typedef int (*Truth)(Vec3 o, Vec3 d, double *t);

static inline int sphere_truth(Vec3 o, Vec3 d, double *t)
{
    return roots_quadratic((const double[3]){ vec_length2(o) - 1, 2 * vec_dot(o, d), 1 }, t);
}

static inline int cylinder_truth(Vec3 o, Vec3 d, double *t)
{
    double all[2], c[3] = { o.x * o.x + o.y * o.y - 1, 2 * (o.x * d.x + o.y * d.y), d.x * d.x + d.y * d.y };
    int n = roots_quadratic(c, all), kept = 0;
    for (int i = 0; i < n; i++)
        if (fabs(o.z + all[i] * d.z) <= 1) t[kept++] = all[i];
    return kept;
}

/* From the point of the ray that is nearest to the middle: the coefficients stay small. */
static inline int torus_truth(Vec3 origin, Vec3 d, double *t)
{
    double shift = -vec_dot(origin, d);
    Vec3 o = vec_add(origin, vec_scale(d, shift));
    double k = vec_length2(o) + 1 - MINOR * MINOR, b = vec_dot(o, d);
    double xx = o.x * o.x + o.y * o.y, xd = o.x * d.x + o.y * d.y, dd = d.x * d.x + d.y * d.y;
    double c[5] = { k * k - 4 * xx, 4 * b * k - 8 * xd, 2 * k + 4 * b * b - 4 * dd, 4 * b, 1 };
    int n = roots_quartic(c, t);
    for (int i = 0; i < n; i++) t[i] += shift;
    return n;
}

typedef struct { const char *name; void (*make)(Model *m); Truth truth; } Case;
static inline void make_torus(Model *m) { model_torus(m, MINOR); }
static const Case cases[3] = { { "sphere", model_sphere, sphere_truth }, { "torus", make_torus, torus_truth },
                               { "cylinder", model_cylinder, cylinder_truth } };

#endif
