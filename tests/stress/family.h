/* Families of surfaces and rays, each with a knob that runs to the extreme. */
#ifndef TRIMRAY_STRESS_FAMILY_H
#define TRIMRAY_STRESS_FAMILY_H

#include "tests/stress/model.h"

typedef struct {
    const char *name, *knob;
    int n;
    double values[16];           /* of the knob */
    Model (*build)(Arena *a, double knob, TestRandom *r);
    Ray (*ray)(const Model *m, double knob, TestRandom *r);
    double share;                /* of the usual number of rays: truths by the oracle are slow */
} Family;

/* families.c: shapes with a closed form; trims.c: with trims; certified.c: held against the oracle. */
extern const Family stress_shapes[], stress_trims[], stress_certified[];
extern const int n_stress_shapes, n_stress_trims, n_stress_certified;

#endif
