/* A picture on its way to a file. Its pixels come in tiles, in any order and from any thread; a band of rows is encoded and
 * compressed as soon as it and all above it are whole, and its memory serves another band: neither the film nor the file is
 * ever there as a whole, but for what was compressed. */
#ifndef TRIMRAY_PICTURE_H
#define TRIMRAY_PICTURE_H

#include "render/film.h"

typedef struct {
    int width, height;
    int x0, y0, x1, y1;         /* the part that will be given: [x0, x1) x [y0, y1); the rest is black and opaque */
    GammaKind gamma;
    double gamma_power;
    int bits;                   /* a channel: 8 or 16 */
    bool alpha;
} PictureFormat;

typedef struct Picture Picture;

Picture *picture_new(const PictureFormat *format);   /* NULL: no memory */
void picture_free(Picture *p);

/* The pixels [x0, x1) x [y0, y1), row by row, each of them once. */
void picture_add(Picture *p, int x0, int y0, int x1, int y1, const FilmPixel *pixels);

/* Writes the file, on which all other threads are done: what was not given is black. path and result: as png_writer_end. */
const char *picture_write(Picture *p, const char *path);

#endif
