/* How a finish answers light: POV-Ray's terms, one function each. Directions are unit vectors; cosines are of the shading
 * normal, which is on the viewer's side. */
#ifndef TRIMRAY_FINISH_H
#define TRIMRAY_FINISH_H

#include "render/texture.h"

/* kd |N.L|^brilliance: to be multiplied by opacity, pigment and light. is_back: the light is behind the surface. An albedo
 * is the share of all light that is sent back; the factor makes the lobe's integral that share. */
static inline double finish_diffuse(const Finish *f, double cos_light, bool is_back)
{
    double kd = is_back ? f->diffuse_back : f->diffuse;
    if (f->diffuse_albedo) kd *= (f->brilliance + 1) / 2;
    double c = fabs(cos_light);
    return kd * (f->brilliance == 1 ? c : pow(c, f->brilliance));
}

static inline bool finish_shines(const Finish *f) { return f->phong > 0 || f->specular > 0; }

/* Phong and specular highlights of light of one colour from `to_light`, on a surface with normal n seen along `dir`. */
Rgb finish_highlights(const Finish *f, Rgb pigment, Vec3 n, Vec3 dir, Vec3 to_light, Rgb light);

/* The reflectivity per channel. cos_view = -dir.n; ior_ratio = ior behind the surface / ior before it. */
Rgb finish_reflectivity(const Finish *f, Rgb pigment, double cos_view, double ior_ratio);

/* Fresnel's reflectivity of unpolarised light at a dielectric; 1 where all of it is reflected. */
double finish_fresnel(double cos_view, double ior_ratio);

#endif
