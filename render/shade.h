/* Light arriving along a ray: Whitted's recursion with POV-Ray's rules. */
#ifndef TRIMRAY_SHADE_H
#define TRIMRAY_SHADE_H

#include "render/film.h"
#include "render/scene.h"

/* The colours seen along n neighbouring camera rays, 1 to BUNCH_WIDTH, with quality +Q. seeds: of the rays, as Trace has
 * them. */
void shade_camera_rays(const Scene *s, const Ray rays[], const uint64_t seeds[], int n, int quality, Trace *t, Pixel out[]);

#endif
