/* Pictures as pigments: POV-Ray's image_map, over the unit square of the xy plane or wrapped round the origin. */
#ifndef TRIMRAY_IMAGE_MAP_H
#define TRIMRAY_IMAGE_MAP_H

#include "render/film.h"
#include "render/image.h"
#include "render/sdl.h"
#include "render/texture.h"

/* POV-Ray's map_type 0, 1, 2 and 5. */
typedef enum { MAP_PLANAR, MAP_SPHERICAL, MAP_CYLINDRICAL, MAP_TOROIDAL } MapType;

typedef struct {
    MapType type;
    bool once;                   /* outside the unit square: fully transparent; else repeated */
    bool interpolates;           /* interpolate 2: bilinear between pixel centres */
    bool has_gamma;              /* `gamma g` given; else the file says, or sRGB if it does not */
    bool gamma_is_srgb;
    double gamma;                /* decoded = encoded ^ gamma */
    double filter_all, transmit_all;   /* 0: added to what the picture's alpha says */
    const char *path;            /* of the file, for export; borrowed */
} ImageMapOptions;

/* Decodes the picture into the working space of the scene, once. The picture is not needed afterwards. */
ImageMap *image_map_new(Arena *a, const Image *picture, const ImageMapOptions *o, GammaKind gamma, double gamma_power);
Color image_map_color(const ImageMap *m, double x, double y);   /* the picture over the unit square */
Color image_map_at(const ImageMap *m, Vec3 point);              /* wrapped as its type says */
bool image_map_is_opaque(const ImageMap *m);
void image_map_write(const ImageMap *m, Sdl *out);   /* " image_map { ... }" */

#endif
