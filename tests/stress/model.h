/* A surface under stress: a form in one of its disguises, rounded to double, as a shape of each method. */
#ifndef TRIMRAY_STRESS_MODEL_H
#define TRIMRAY_STRESS_MODEL_H

#include "tests/stress/truth.h"
#include "tests/test.h"
#include "render/shape.h"

enum { N_METHODS = 2 };      /* in the order of NurbsMethod: paper, certain */

typedef struct Model Model;
struct Model {
    Arena *arena;
    FormInWorld at;
    Net plain;               /* the form as it was built, placed in the world: cheap to evaluate */
    Net net;                 /* in disguise */
    double size;             /* half the diagonal of the control points' box */
    SurfaceDesc desc;
    Shape *shape[N_METHODS];
    void (*truth)(const Model *m, const Ray *r, Truth *out);   /* NULL: by the form */
    void (*release)(Model *m);                                 /* NULL: nothing of its own */
    const void *own;         /* of the family */
};

/* Begins with a form about the origin of the world. */
Model model_new(Arena *a, Form form, Net net);

/* Places and rounds: desc, size and at are known, the shapes are not. */
void model_place(Model *m, const QuadMap *place);

/* The same, and makes the shapes. `trims` may be NULL. Exits with a message if the constructor refuses. */
void model_finish(Model *m, const QuadMap *place, const TrimLoopDesc *trims, int n_trims);

void model_truth(const Model *m, const Ray *r, Truth *out);

/* The unit normal of the form at a point of the world. */
Quad3 model_normal(const Model *m, Quad3 p);

/* A random rotation, scaled. */
QuadMap model_rotation(TestRandom *r, double scale);
Quad3 random_direction(TestRandom *r);

/* A ray that passes through the target to the last bits, from `distance` sizes away against `dir`, with a direction of any
 * length. */
Ray ray_towards(const Model *m, Quad3 target, Quad3 dir, double distance, TestRandom *r);

/* Through a random point of the surface (four of five) or near it, from a tenth to ten sizes away. */
Ray ray_anywhere(const Model *m, double knob, TestRandom *r);

#endif
