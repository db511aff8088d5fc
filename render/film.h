/* The picture while it is made: linear colours in the working space, and what becomes of them on the way to a file. */
#ifndef TRIMRAY_FILM_H
#define TRIMRAY_FILM_H

#include "render/color.h"
#include "render/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct { double r, g, b, transmit; } Pixel;

typedef struct {
    int width, height;
    Pixel *pixels;              /* row by row from the top left; black and opaque at first */
} Film;

Film *film_new(int width, int height);    /* NULL: no memory */
void film_free(Film *f);

/* Encodes one channel by the scene's gamma (povray-facts section 2): 0 .. max. */
uint16_t film_sample(double linear, GammaKind gamma, double gamma_power, int max);

#endif
