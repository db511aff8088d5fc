/* Counters of one thread, merged at the end; the paper's ([MCFS00] Figure 8) under the paper's names. */
#ifndef TRIMRAY_STATS_H
#define TRIMRAY_STATS_H

#include <stdint.h>

typedef struct {
    uint64_t camera_rays, shadow_rays, reflected_rays, transmitted_rays;
    uint64_t bv_intersections, light_bv_intersections;   /* boxes tested for camera and secondary rays; for shadow rays */
    uint64_t leaf_tests;            /* leaves reached; `method certain` decides many of them at sight */
    uint64_t nurbs_tests;           /* numerical surface intersections begun */
    uint64_t nurbs_hits;            /* of these, the ones that converged to a root */
    uint64_t reported_hits;         /* of these, the ones not trimmed away and nearer than what the ray had */
    uint64_t newton_iterations;     /* surface evaluations after the first guess: `method paper` has that in the leaf */
    uint64_t newton_jitters;        /* steps taken because det J vanished */
    uint64_t certificates, fallbacks;
    uint64_t trim_tests;            /* (u, v) that were classified against trims */
    uint64_t primitive_tests;       /* shapes other than NURBS, asked for a hit */
    double nurbs_seconds;           /* time in numerical intersection: only measured when asked for (see Trace) */
    double prep_seconds;            /* accelerators of shapes, whoever asked for them */
} Counters;

void counters_add(Counters *to, const Counters *from);

double stats_now(void);             /* monotonic, in seconds */
double stats_peak_mb(void);         /* largest resident set of the process so far */

#endif
