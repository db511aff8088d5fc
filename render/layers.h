/* The layers of a texture as a ray sees them, from the top down, for as long as anything comes through. */
#ifndef TRIMRAY_LAYERS_H
#define TRIMRAY_LAYERS_H

#include "render/finish.h"
#include "render/media.h"
#include "render/surface.h"

typedef struct {
    const Finish *finish;
    Rgb pigment;
    Rgb weight;                  /* of its light: what the layers above let through */
    double opacity;
    Rgb reflectivity;
    Rgb diffuse, shine;          /* gathered light: what the pigment scatters, what it does not colour */
} LayerAt;

/* Fills out, which has room for all layers of at->texture, with those that are seen; returns how many. *through: what is
 * left for what lies behind them all. */
int layers_walk(Surroundings *around, const Surface *at, const Medium *media, LayerAt *out, Rgb *through);

/* How much of it that is, in one number. */
static inline double layers_transmit(Rgb through) { return double_min(fabs(rgb_grey(through)), 1); }

/* What they send to the eye of the light that was gathered. */
Rgb layers_light(const LayerAt *layers, int n);

/* Of what they mirror an upper bound, for adc_bailout, and what they make of what is seen there. */
double layers_mirror_weight(const LayerAt *layers, int n);
Rgb layers_mirrored(const LayerAt *layers, int n, Rgb seen);

#endif
