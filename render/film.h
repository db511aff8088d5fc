/* The picture while it is made: linear colours in the working space, and what becomes of them on the way to a file. */
#ifndef TRIMRAY_FILM_H
#define TRIMRAY_FILM_H

#include "render/color.h"
#include "render/scene.h"

#include <stdbool.h>
#include <stdint.h>

/* Colour as light that arrives (premultiplied, unclipped), and how much of what lies behind the scene shows through. */
typedef struct { double r, g, b, transmit; } Pixel;

typedef struct {
    int width, height;
    Pixel *pixels;              /* row by row from the top left; black and opaque at first */
} Film;

Film *film_new(int width, int height);    /* NULL: no memory */
void film_free(Film *f);

/* Encodes one channel by the scene's gamma (POV-Ray's rule): 0 .. max. */
uint16_t film_sample(double working, GammaKind gamma, double gamma_power, int max);

/* Clamps to [0, 1] and rounds to 0 .. max: alpha, and colour without a transfer curve. NaN becomes 0. */
uint16_t film_quantize(double value, int max);

/* One row as a file wants it: 3 samples a pixel, or 4, not premultiplied, with alpha; returns how many. */
int film_row(const Film *f, int y, GammaKind gamma, double gamma_power, int max, bool alpha, uint16_t *out);

/* Between the working space (assumed_gamma) and linear light, for the colours of pictures and of `srgb`. */
double film_linear(double working, GammaKind gamma, double gamma_power);
double film_working(double linear, GammaKind gamma, double gamma_power);
double film_srgb_decode(double encoded);  /* the sRGB curve: encoded to linear, at least 0 */

#endif
