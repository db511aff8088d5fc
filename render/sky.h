/* What a ray meets that hits nothing, and fog. */
#ifndef TRIMRAY_SKY_H
#define TRIMRAY_SKY_H

#include "render/film.h"
#include "render/scene.h"

Pixel sky_color(const Scene *s, Vec3 unit_dir);

/* `seen` as it looks through the scene's fogs from r's origin, t along the ray away; INFINITY: the sky. */
Pixel sky_through_fog(const Scene *s, const Ray *r, double t, Pixel seen);

#endif
