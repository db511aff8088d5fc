/* Counters are added field by field, so that a new one is seen to be missing here. */
#include "render/stats.h"

#include <sys/resource.h>
#include <time.h>

void counters_add(Counters *to, const Counters *from)
{
    to->camera_rays += from->camera_rays;
    to->shadow_rays += from->shadow_rays;
    to->reflected_rays += from->reflected_rays;
    to->transmitted_rays += from->transmitted_rays;
    to->bv_intersections += from->bv_intersections;
    to->light_bv_intersections += from->light_bv_intersections;
    to->leaf_tests += from->leaf_tests;
    to->nurbs_tests += from->nurbs_tests;
    to->nurbs_hits += from->nurbs_hits;
    to->reported_hits += from->reported_hits;
    to->newton_iterations += from->newton_iterations;
    to->newton_jitters += from->newton_jitters;
    to->certificates += from->certificates;
    to->fallbacks += from->fallbacks;
    to->trim_tests += from->trim_tests;
    to->primitive_tests += from->primitive_tests;
    to->nurbs_seconds += from->nurbs_seconds;
    to->prep_seconds += from->prep_seconds;
}

double stats_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double stats_peak_mb(void)
{
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#ifdef __APPLE__
    return (double)usage.ru_maxrss / (1024 * 1024);   /* bytes there */
#else
    return (double)usage.ru_maxrss / 1024;            /* kilobytes */
#endif
}
