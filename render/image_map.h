/* Pictures as pigments: POV-Ray's image_map with map_type 0, over the unit square of the xy plane. */
#ifndef TRIMRAY_IMAGE_MAP_H
#define TRIMRAY_IMAGE_MAP_H

#include "render/film.h"
#include "render/image.h"
#include "render/texture.h"

typedef struct {
    bool once;                   /* outside the unit square: fully transparent; else repeated */
    bool interpolates;           /* interpolate 2: bilinear between pixel centres */
    bool has_gamma;              /* `gamma g` given; else the file says, or sRGB if it does not */
    bool gamma_is_srgb;
    double gamma;                /* decoded = encoded ^ gamma */
    double filter_all, transmit_all;   /* 0: added to what the picture's alpha says */
} ImageMapOptions;

/* Decodes the picture into the working space of the scene, once. The picture is not needed afterwards. */
ImageMap *image_map_new(Arena *a, const Image *picture, const ImageMapOptions *o, GammaKind gamma, double gamma_power);
Color image_map_color(const ImageMap *m, double x, double y);
bool image_map_is_opaque(const ImageMap *m);

#endif
