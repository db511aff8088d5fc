/* PNG files, in and out, by libpng. */
#ifndef TRIMRAY_IMAGE_H
#define TRIMRAY_IMAGE_H

#include "render/arena.h"
#include "render/film.h"

/* Writes the film as PNG with the scene's gamma, 8 or 16 bits a channel. path and result: as png_writer_end. */
const char *image_write_png(const char *path, const Film *f, GammaKind gamma, double gamma_power, int bits, bool alpha);

/* A decoded picture: 16-bit RGBA samples as they stand in the file (8-bit ones times 257), row by row. */
typedef struct {
    int width, height, bits;
    bool has_alpha, has_gamma;
    double file_gamma;          /* gAMA as in the file (0.45455), sRGB chunk: -1; 0: none */
    uint16_t *rgba;
} Image;
Image *image_read_png(Arena *a, const char *path, const char **error);   /* NULL: *error says why */

#endif
