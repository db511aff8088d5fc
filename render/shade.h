/* Light arriving along a ray: Whitted's recursion with POV-Ray's rules. */
#ifndef TRIMRAY_SHADE_H
#define TRIMRAY_SHADE_H

#include "render/film.h"
#include "render/scene.h"

/* The colour seen along a camera ray, with quality +Q. */
Pixel shade_camera_ray(const Scene *s, Ray *r, int quality, Trace *t);

#endif
