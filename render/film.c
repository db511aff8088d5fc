/* The picture in memory, and the transfer curve to a file. POV-Ray evaluates the curve in single precision, and so do we:
 * the integers are the same. */
#include "render/film.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

Film *film_new(int width, int height)
{
    assert(width > 0 && height > 0);
    Film *f = malloc(sizeof *f);
    Pixel *pixels = calloc((size_t)width * (size_t)height, sizeof *pixels);
    if (!f || !pixels) {
        free(f);
        free(pixels);
        return NULL;
    }
    *f = (Film){ width, height, pixels };
    return f;
}

void film_free(Film *f)
{
    if (!f) return;
    free(f->pixels);
    free(f);
}

/* POV-Ray takes an assumed_gamma this near to 1 for 1. */
static const double GAMMA_NEUTRAL = .01;

static float srgb_encode(float t)
{
    return t <= .0031308f ? 12.92f * t : 1.055f * powf(t, 1 / 2.4f) - .055f;
}

static float srgb_decode(float t)
{
    return t <= .04045f ? t / 12.92f : powf((t + .055f) / 1.055f, 2.4f);
}

double film_linear(double working, GammaKind gamma, double gamma_power)
{
    float c = fmaxf((float)working, 0);
    if (gamma == GAMMA_SRGB) return srgb_decode(c);
    if (gamma == GAMMA_NONE || fabs(gamma_power - 1) <= GAMMA_NEUTRAL) return working;
    return powf(c, (float)gamma_power);
}

double film_working(double linear, GammaKind gamma, double gamma_power)
{
    float c = fmaxf((float)linear, 0);
    if (gamma == GAMMA_SRGB) return srgb_encode(c);
    if (gamma == GAMMA_NONE || fabs(gamma_power - 1) <= GAMMA_NEUTRAL) return linear;
    return powf(c, (float)(1 / gamma_power));
}

double film_srgb_decode(double encoded) { return srgb_decode((float)encoded); }

uint16_t film_quantize(double value, int max)
{
    float clamped = fminf(fmaxf((float)value, 0), 1);   /* NaN becomes 0 */
    return (uint16_t)floorf(clamped * (float)max + .5f);
}

uint16_t film_sample(double working, GammaKind gamma, double gamma_power, int max)
{
    if (gamma == GAMMA_NONE || gamma == GAMMA_SRGB) return film_quantize(working, max);   /* as the file wants it */
    return film_quantize(srgb_encode(fmaxf((float)film_linear(working, gamma, gamma_power), 0)), max);
}

/* Straight (not premultiplied) colour and alpha, linear in the working space. What is brighter than its alpha allows (a
 * highlight on glass) gets more alpha, as POV-Ray does. */
static Pixel unpremultiplied(const Pixel *p, double *alpha)
{
    static const double NO_ALPHA = 1e-6;   /* POV-Ray's divisor where alpha is 0 */
    double a = 1 - p->transmit, grey = rgb_grey(rgb(p->r, p->g, p->b));
    if (grey > a) a = fmin(1, grey);
    double by = 1 / (a == 0 ? NO_ALPHA : a);
    *alpha = a;
    return (Pixel){ p->r * by, p->g * by, p->b * by, p->transmit };
}

int film_row(const Film *f, int y, GammaKind gamma, double gamma_power, int max, bool alpha, uint16_t *out)
{
    const Pixel *row = f->pixels + (size_t)y * (size_t)f->width;
    uint16_t *start = out;
    for (int x = 0; x < f->width; x++) {
        double a = 1;
        Pixel p = alpha ? unpremultiplied(&row[x], &a) : row[x];
        *out++ = film_sample(p.r, gamma, gamma_power, max);
        *out++ = film_sample(p.g, gamma, gamma_power, max);
        *out++ = film_sample(p.b, gamma, gamma_power, max);
        if (alpha) *out++ = film_quantize(a, max);
    }
    return (int)(out - start);
}
