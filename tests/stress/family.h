/* Families of surfaces and rays, each with a knob that runs to the extreme. */
#ifndef TRIMRAY_STRESS_FAMILY_H
#define TRIMRAY_STRESS_FAMILY_H

#include "tests/stress/model.h"

enum { FAMILY_VALUES = 16 };

typedef struct {
    const char *name, *knob;
    int n;
    double values[FAMILY_VALUES];    /* of the knob */
    Model (*build)(Arena *a, double knob, TestRandom *r);
    Ray (*ray)(const Model *m, double knob, TestRandom *r);
    double share;                /* of the usual number of rays: truths by the oracle are slow */
} Family;

/* families.c: shapes with a closed form; trims.c: with trims; certified.c: held against the oracle. */
extern const Family stress_shapes[], stress_trims[], stress_certified[];
extern const int n_stress_shapes, n_stress_trims, n_stress_certified;

/* All of them, in this order. */
int family_count(void);
const Family *family_at(int i);

#endif
