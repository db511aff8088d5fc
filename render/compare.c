#include "render/compare.h"

/* Samples of all depths are 0 to 65535 (image.h); 257 of these are 1/255. */
static const double FULL = 65535, STEP = 257;

static double difference(const Image *a, const Image *b, size_t pixel, int channel)
{
    return fabs((double)a->rgba[4 * pixel + (size_t)channel] - (double)b->rgba[4 * pixel + (size_t)channel]);
}

static int channels(const Image *a, const Image *b) { return a->has_alpha || b->has_alpha ? 4 : 3; }

static double largest_difference(const Image *a, const Image *b, size_t pixel)
{
    double most = 0;
    for (int c = 0; c < channels(a, b); c++) most = fmax(most, difference(a, b, pixel, c));
    return most;
}

/* ---- structural similarity: [WBSS04], its window and its constants ---- */

enum { RADIUS = 5 };
static const double SIGMA = 1.5, K1 = .01, K2 = .03;

static double grey(const Image *p, size_t pixel)
{
    const uint16_t *s = p->rgba + 4 * pixel;
    return (.299 * s[0] + .587 * s[1] + .114 * s[2]) / FULL;
}

/* One pass of the window, along rows or columns; at the border, of what there is of it. */
static void blur_pass(const double *in, int width, int height, bool along_rows, double *out)
{
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double sum = 0, weights = 0;
            for (int k = -RADIUS; k <= RADIUS; k++) {
                int i = along_rows ? x + k : x, j = along_rows ? y : y + k;
                if (i < 0 || i >= width || j < 0 || j >= height) continue;
                double w = exp(-k * k / (2 * SIGMA * SIGMA));
                sum += w * in[(size_t)j * (size_t)width + (size_t)i], weights += w;
            }
            out[(size_t)y * (size_t)width + (size_t)x] = sum / weights;
        }
}

/* The window's mean of a product of two grey pictures; NULL stands for 1. */
static double *mean_of(Arena *scratch, const double *a, const double *b, int width, int height)
{
    size_t n = (size_t)width * (size_t)height;
    double *product = ARENA_ARRAY(scratch, double, n), *half = ARENA_ARRAY(scratch, double, n);
    for (size_t i = 0; i < n; i++) product[i] = a[i] * (b ? b[i] : 1);
    blur_pass(product, width, height, true, half);
    blur_pass(half, width, height, false, product);
    return product;
}

static double similarity(Arena *scratch, const Image *p, const Image *q)
{
    int width = p->width, height = p->height;
    size_t n = (size_t)width * (size_t)height;
    double *a = ARENA_ARRAY(scratch, double, n), *b = ARENA_ARRAY(scratch, double, n), sum = 0;
    for (size_t i = 0; i < n; i++) a[i] = grey(p, i), b[i] = grey(q, i);
    const double *m_a = mean_of(scratch, a, NULL, width, height), *m_b = mean_of(scratch, b, NULL, width, height);
    const double *m_aa = mean_of(scratch, a, a, width, height), *m_bb = mean_of(scratch, b, b, width, height);
    const double *m_ab = mean_of(scratch, a, b, width, height), c1 = K1 * K1, c2 = K2 * K2;
    for (size_t i = 0; i < n; i++) {
        double var_a = m_aa[i] - m_a[i] * m_a[i], var_b = m_bb[i] - m_b[i] * m_b[i], cov = m_ab[i] - m_a[i] * m_b[i];
        sum += (2 * m_a[i] * m_b[i] + c1) * (2 * cov + c2)
             / ((m_a[i] * m_a[i] + m_b[i] * m_b[i] + c1) * (var_a + var_b + c2));
    }
    return sum / (double)n;
}

/* ---- all numbers ---- */

Comparison compare_images(Arena *scratch, const Image *a, const Image *b, double within)
{
    ArenaMark mark = arena_mark(scratch);
    Comparison c = { .n_pixels = (size_t)a->width * (size_t)a->height };
    double squares = 0;
    for (size_t i = 0; i < c.n_pixels; i++) {
        double most = largest_difference(a, b, i);
        for (int k = 0; k < channels(a, b); k++) squares += difference(a, b, i, k) * difference(a, b, i, k);
        c.n_over += most > STEP, c.n_beyond += most > within * STEP;
        if (most / FULL <= c.largest) continue;
        c.largest = most / FULL;
        c.largest_x = (int)(i % (size_t)a->width), c.largest_y = (int)(i / (size_t)a->width);
    }
    c.rmse = sqrt(squares / ((double)c.n_pixels * channels(a, b))) / FULL;
    c.psnr = -20 * log10(c.rmse);
    c.ssim = similarity(scratch, a, b);
    arena_reset(scratch, mark);
    return c;
}

/* ---- the picture ---- */

static Pixel blend(Pixel a, Pixel b, double s)
{
    return (Pixel){ (1 - s) * a.r + s * b.r, (1 - s) * a.g + s * b.g, (1 - s) * a.b + s * b.b, 0 };
}

/* Beyond the limit colours go by the logarithm: a difference of 64 times the limit (a quarter of the range, for 1/255) is
 * white. */
static Pixel color_of(double steps, double within, double dim)
{
    static const Pixel blue = { .15, .35, 1, 0 }, yellow = { 1, .9, 0, 0 }, red = { 1, 0, 0, 0 }, white = { 1, 1, 1, 0 };
    Pixel background = { dim, dim, dim, 0 };
    if (steps == 0) return background;
    if (steps <= within) return blend(background, blue, .6);
    double far = fmin(log2(steps / fmax(within, 1)) / 6, 1);
    return far < 0 ? yellow : far < .5 ? blend(yellow, red, 2 * far) : blend(red, white, 2 * far - 1);
}

Film *compare_picture(const Image *a, const Image *b, double within)
{
    Film *f = film_new(a->width, a->height);
    for (size_t i = 0; f && i < (size_t)a->width * (size_t)a->height; i++)
        f->pixels[i] = film_pixel(color_of(largest_difference(a, b, i) / STEP, within, .05 + .25 * grey(a, i)));
    return f;
}
