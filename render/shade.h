/* Light arriving along a ray: Whitted's recursion with POV-Ray's rules. */
#ifndef TRIMRAY_SHADE_H
#define TRIMRAY_SHADE_H

#include "render/film.h"
#include "render/scene.h"

/* The colours seen along the rays of a bunch, which are neighbours and come from the camera, with quality +Q. */
void shade_camera_rays(const Scene *s, RayBunch *rays, int quality, Trace *t, Pixel out[]);

#endif
