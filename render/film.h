/* The picture while it is made: linear colours in the working space, and what becomes of them on the way to a file. */
#ifndef TRIMRAY_FILM_H
#define TRIMRAY_FILM_H

#include "render/color.h"
#include "render/scene.h"

#include <stdbool.h>
#include <stdint.h>

/* Colour as light that arrives (premultiplied, unclipped), and how much of what lies behind the scene shows through. */
typedef struct { double r, g, b, transmit; } Pixel;

/* As the film keeps it. Files are made of single precision anyway, and memory that is new costs time. */
typedef struct { float r, g, b, transmit; } FilmPixel;
static inline FilmPixel film_pixel(Pixel p)
{
    return (FilmPixel){ (float)p.r, (float)p.g, (float)p.b, (float)p.transmit };
}

typedef struct {
    int width, height;
    FilmPixel *pixels;          /* row by row from the top left; black and opaque at first */
} Film;

Film *film_new(int width, int height);    /* NULL: no memory */
void film_free(Film *f);
void film_set(Film *f, int x0, int y0, int x1, int y1, const FilmPixel *pixels);   /* [x0, x1) x [y0, y1), row by row */

/* Encodes one channel by the scene's gamma (POV-Ray's rule): 0 .. max. */
uint16_t film_sample(double working, GammaKind gamma, double gamma_power, int max);

/* Clamps to [0, 1] and rounds to 0 .. max: alpha, and colour without a transfer curve. NaN becomes 0. */
uint16_t film_quantize(double value, int max);

/* film_sample for a whole picture. With max 255 its curve, which rises, is the list of the numbers at which it steps: a
 * sample is a look into `first`, and mostly one comparison. */
enum { FILM_FIRST = 114 << 7, FILM_N_FIRST = (13 << 7) + 1 };   /* the leading 16 bits of floats from 2^-13 to 1 */
typedef struct {
    GammaKind gamma;
    double gamma_power;
    int max;
    float step[257];            /* max 255: the least float that becomes i; no float becomes 256 */
    uint8_t first[FILM_N_FIRST];   /* max 255: what the least float with these leading bits becomes; [0]: from 0 on */
} FilmCurve;
FilmCurve film_curve(GammaKind gamma, double gamma_power, int max);
uint16_t film_curve_sample(const FilmCurve *c, double working);   /* film_sample(working, ...) */

/* Pixels, or one row, as a file wants them: 3 samples a pixel, or 4, not premultiplied, with alpha; returns how many. */
int film_encode(const FilmPixel *pixels, int n, const FilmCurve *curve, bool alpha, uint16_t *out);
int film_row(const Film *f, int y, const FilmCurve *curve, bool alpha, uint16_t *out);

/* Between the working space (assumed_gamma) and linear light, for the colours of pictures and of `srgb`. */
double film_linear(double working, GammaKind gamma, double gamma_power);
double film_working(double linear, GammaKind gamma, double gamma_power);
double film_srgb_decode(double encoded);  /* the sRGB curve: encoded to linear, at least 0 */

#endif
