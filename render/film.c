/* The picture in memory, and the transfer curve to a file. POV-Ray evaluates the curve in single precision, and so do we:
 * the integers are the same. */
#include "render/film.h"

#include "render/pages.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

Film *film_new(int width, int height)
{
    assert(width > 0 && height > 0);
    Film *f = malloc(sizeof *f);
    FilmPixel *pixels = calloc((size_t)width * (size_t)height, sizeof *pixels);
    if (!f || !pixels) {
        free(f);
        free(pixels);
        return NULL;
    }
    pages_ask_large(pixels, (size_t)width * (size_t)height * sizeof *pixels);
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

/* ---- the curve as a table ---- */

static float float_of(uint32_t bits)
{
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static uint32_t bits_of(float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits;
}

/* The least float in [0, 1] that becomes `level`. Floats from 0 on ascend as their bits do. */
static float find_step(const FilmCurve *c, int level, float from)
{
    uint32_t low = bits_of(from), high = bits_of(1);
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (film_sample((double)float_of(middle), c->gamma, c->gamma_power, c->max) >= level) high = middle;
        else low = middle + 1;
    }
    return float_of(low);
}

FilmCurve film_curve(GammaKind gamma, double gamma_power, int max)
{
    FilmCurve c = { .gamma = gamma, .gamma_power = gamma_power, .max = max };
    if (max != 255) return c;
    for (int i = 1; i < 256; i++) c.step[i] = find_step(&c, i, c.step[i - 1]);
    c.step[256] = INFINITY;
    uint32_t level = 0;
    for (uint32_t i = 1; i < FILM_N_FIRST; i++) {
        while (c.step[level + 1] <= float_of((FILM_FIRST + i) << 16)) level++;
        c.first[i] = (uint8_t)level;
    }
    return c;
}

uint16_t film_curve_sample(const FilmCurve *c, double working)
{
    float v = (float)working;
    if (c->max != 255) return film_sample(working, c->gamma, c->gamma_power, c->max);
    v = v > 0 ? v : 0;                    /* NaN becomes 0, too */
    v = v < 1 ? v : 1;
    uint32_t at = bits_of(v) >> 16;
    int level = c->first[at > FILM_FIRST ? at - FILM_FIRST : 0];
    while (v >= c->step[level + 1]) level++;
    return (uint16_t)level;
}

/* ---- pixels ---- */

/* Straight (not premultiplied) colour and alpha, linear in the working space. What is brighter than its alpha allows (a
 * highlight on glass) gets more alpha, as POV-Ray does. */
static Pixel unpremultiplied(const FilmPixel *p, double *alpha)
{
    static const double NO_ALPHA = 1e-6;   /* POV-Ray's divisor where alpha is 0 */
    double a = 1 - (double)p->transmit, grey = rgb_grey(rgb(p->r, p->g, p->b));
    if (grey > a) a = fmin(1, grey);
    double by = 1 / (a == 0 ? NO_ALPHA : a);
    *alpha = a;
    return (Pixel){ p->r * by, p->g * by, p->b * by, (double)p->transmit };
}

int film_encode(const FilmPixel *pixels, int n, const FilmCurve *curve, bool alpha, uint16_t *out)
{
    uint16_t *start = out;
    for (int i = 0; i < n; i++) {
        double a = 1;
        Pixel p = alpha ? unpremultiplied(&pixels[i], &a) : (Pixel){ pixels[i].r, pixels[i].g, pixels[i].b, 0 };
        *out++ = film_curve_sample(curve, p.r);
        *out++ = film_curve_sample(curve, p.g);
        *out++ = film_curve_sample(curve, p.b);
        if (alpha) *out++ = film_quantize(a, curve->max);
    }
    return (int)(out - start);
}

int film_row(const Film *f, int y, const FilmCurve *curve, bool alpha, uint16_t *out)
{
    return film_encode(f->pixels + (size_t)y * (size_t)f->width, f->width, curve, alpha, out);
}

void film_set(Film *f, int x0, int y0, int x1, int y1, const FilmPixel *pixels)
{
    size_t across = (size_t)(x1 - x0);
    for (int y = y0; y < y1; y++, pixels += across)
        memcpy(f->pixels + (size_t)y * (size_t)f->width + (size_t)x0, pixels, across * sizeof *pixels);
}
