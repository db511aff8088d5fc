/* Shapes that are both a control net and an equation f(x, y, z) = 0 of low degree, cut off by half-spaces: all that is known
 * about a ray and such a shape follows from a polynomial in the ray's parameter. */
#ifndef TRIMRAY_STRESS_FORM_H
#define TRIMRAY_STRESS_FORM_H

#include "tests/stress/net.h"

typedef struct { Quad3 normal; Quad at; } HalfSpace;   /* normal.p + at >= 0; the normal is unit */

typedef struct Form Form;
struct Form {
    const char *name;
    Poly (*along)(const Form *f, Poly x, Poly y, Poly z);   /* f on a line */
    Quad3 (*gradient)(const Form *f, Quad3 p);
    Quad par[1];
    Quad hessian;                /* about the largest second derivative of f */
    Quad reach;                  /* no point of the shape is farther from the origin */
    int n_sides;
    HalfSpace side[5];
};

/* |x|, |y| and most |z| are at most 1 or 2. Each fills the net, too. */
Form form_sphere(Arena *a, Net *n);                              /* unit */
Form form_torus(Arena *a, double minor, Net *n);                 /* major radius 1 */
Form form_cylinder(Arena *a, Net *n);                            /* |z| <= 1 */
Form form_cone(Arena *a, Net *n);                                /* apex at the origin, 0 <= z <= 1 */
Form form_triangle(Arena *a, Net *n);                            /* (0,0) (1,0) (0,1): one side of the net is (0,0) */
Form form_saddle(Arena *a, double height, Net *n);               /* z = height x y over |x|, |y| <= 1; 0: a square */
Form form_paraboloid(Arena *a, double height, Net *n);           /* z = height (x^2 + y^2) */
Form form_monkey(Arena *a, double height, Net *n);               /* z = height (x^3 - 3 x y^2): flat at the origin */
Form form_flat_point(Arena *a, double height, Net *n);           /* z = height x^2 y^2: flat along both axes */
Form form_bend(Arena *a, double weight, Net *n);                 /* extruded conic: a corner, radius ~ 1/weight^2 */
Form form_loop(Arena *a, double size, Net *n);                   /* extruded (t^3 - size t, t^2): size 0: a cusp */
Form form_whitney(Arena *a, Net *n);                             /* x = z^3 + y z: a fold that ends, seen along z */

#endif
