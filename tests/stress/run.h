/* One part of a stress run: a family at one value of its knob, from one seed. Parts depend on nothing else, so that they can
 * be made in any order and by any process, and each ray can be shot again alone. */
#ifndef TRIMRAY_STRESS_RUN_H
#define TRIMRAY_STRESS_RUN_H

#include "tests/stress/family.h"
#include "tests/stress/judge.h"

typedef struct {
    long rays;                   /* for each part, times the family's share */
    long surface_rays;           /* for each surface */
    long all_hits_every;         /* all hits are asked for with every n-th ray */
    const char *failures;        /* folder for what is wrong, and what is slow; NULL: none */
    int method;                  /* whose failures are written */
    long only_ray;               /* this ray alone, reported on stdout; -1: all */
} RunOptions;

typedef struct { const Family *family; int knob; uint64_t seed; } Part;   /* knob: index of its value */

/* Counts into rows. A ray that takes longer than RUN_PATIENCE seconds of processor time is a failure like the others: it is
 * reported, and the program ends with status 1. */
enum { RUN_PATIENCE = 20 };
void run_part(const RunOptions *o, Part part, Row rows[N_METHODS]);

#endif
