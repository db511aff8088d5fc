/* Light gathered on the layers of textures: from each light for all layers, and for neighbouring surfaces together. */
#ifndef TRIMRAY_GATHER_H
#define TRIMRAY_GATHER_H

#include "render/layers.h"
#include "render/shadow.h"

/* A surface, and the layers of it that are seen. */
typedef struct {
    Shadow shadow;
    LayerAt *layers;
    int n;
} Gathering;

/* Adds to diffuse and shine, on each of `lanes` (at least one), what each light of the scene gives, as far as +Q wants it.
 * seen_by: the rays that see the surfaces. */
void gather_light_bunch(Gathering *const of[], Lanes lanes, const RayBunch *seen_by, int quality);

#endif
