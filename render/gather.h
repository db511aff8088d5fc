/* Light gathered on the layers of a texture: from each light for all layers, and for neighbouring surfaces together. */
#ifndef TRIMRAY_GATHER_H
#define TRIMRAY_GATHER_H

#include "render/finish.h"
#include "render/shadow.h"

typedef struct {
    const Finish *finish;
    Rgb pigment;
    Rgb weight;                  /* of its light: what the layers above let through */
    double opacity;
    Rgb reflectivity;
    Rgb diffuse, shine;          /* gathered light: what the pigment scatters, what it does not colour */
} LayerAt;

/* A surface, and the layers of it that are seen. */
typedef struct {
    Shadow shadow;
    LayerAt *layers;
    int n;
} Gathering;

/* Adds to diffuse and shine what each light of the scene gives, as far as +Q wants it. */
void gather_light(Gathering *g, int quality);

/* The same for those of the surfaces that a bunch of camera rays sees which are in `lanes`, at least one. */
void gather_light_bunch(Gathering *const of[], Lanes lanes, const RayBunch *seen_by, int quality);

/* What the layers send to the eye of the light that was gathered. */
Rgb gathered_light(const Gathering *g);

#endif
