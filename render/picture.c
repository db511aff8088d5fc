/* Bands of rows, as the file has them. Whoever gives the last pixel of the band that is next compresses it, and those below
 * that are whole by then, while the others go on; so the file is in order, and nobody waits. */
#include "render/picture.h"

#include "render/png_writer.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { BAND = 32 };              /* rows: those of a tile */
enum { RUN = 64 };               /* pixels encoded at a time */

typedef struct {
    unsigned char *rows;         /* NULL: nothing of it was given yet */
    size_t n_missing;            /* pixels that will still be given */
} Band;

/* The memory of a band that is written, to be used again. */
typedef struct Spare Spare;
struct Spare { Spare *next; };

struct Picture {
    PictureFormat format;
    FilmCurve curve;
    PngWriter *out;
    size_t pixel_bytes, row_bytes;
    int n_bands;
    pthread_mutex_t lock;        /* of all that follows, but for the bytes of the rows */
    Band *bands;
    Spare *spare;
    int n_written;
    bool is_writing, is_short_of_memory;
};

static int n_rows(const Picture *p, int band) { return int_min(BAND, p->format.height - band * BAND); }

static void expect_pixels(Picture *p)
{
    const PictureFormat *f = &p->format;
    for (int i = 0; i < p->n_bands; i++) {
        int rows = int_min(f->y1, i * BAND + n_rows(p, i)) - int_max(f->y0, i * BAND);
        p->bands[i].n_missing = rows > 0 && f->x1 > f->x0 ? (size_t)rows * (size_t)(f->x1 - f->x0) : 0;
    }
}

Picture *picture_new(const PictureFormat *format)
{
    Picture *p = calloc(1, sizeof *p);
    if (!p) return NULL;
    p->format = *format;
    p->n_bands = format->height / BAND + (format->height % BAND != 0);
    p->pixel_bytes = (size_t)(format->alpha ? 4 : 3) * (size_t)(format->bits / 8);
    p->row_bytes = (size_t)format->width * p->pixel_bytes;
    p->curve = film_curve(format->gamma, format->gamma_power, format->bits == 16 ? 65535 : 255);
    pthread_mutex_init(&p->lock, NULL);
    p->bands = calloc((size_t)p->n_bands, sizeof *p->bands);
    p->out = png_writer_new(format->width, format->height, format->bits, format->alpha);
    if (!p->bands || !p->out) {
        picture_free(p);
        return NULL;
    }
    expect_pixels(p);
    return p;
}

void picture_free(Picture *p)
{
    if (!p) return;
    for (int i = 0; p->bands && i < p->n_bands; i++) free(p->bands[i].rows);
    for (Spare *s = p->spare, *next; s; s = next) {
        next = s->next;
        free(s);
    }
    free(p->bands);
    png_writer_free(p->out);
    pthread_mutex_destroy(&p->lock);
    free(p);
}

/* ---- encoding ---- */

/* Bytes, or big-endian pairs. */
static void pack(const uint16_t *samples, int n, int bits, unsigned char *out)
{
    for (int i = 0; i < n; i++) {
        if (bits == 16) *out++ = (unsigned char)(samples[i] >> 8);
        *out++ = (unsigned char)samples[i];
    }
}

static void encode(const Picture *p, const FilmPixel *pixels, int n, unsigned char *out)
{
    uint16_t samples[4 * RUN];
    for (int x = 0; x < n; x += RUN) {
        int n_samples = film_encode(pixels + x, int_min(RUN, n - x), &p->curve, p->format.alpha, samples);
        pack(samples, n_samples, p->format.bits, out + (size_t)x * p->pixel_bytes);
    }
}

static void blacken(const Picture *p, unsigned char *rows, size_t n_bytes)
{
    static const FilmPixel black = { 0 };
    memset(rows, 0, n_bytes);
    for (size_t at = 0; p->format.alpha && at < n_bytes; at += p->pixel_bytes) encode(p, &black, 1, rows + at);
}

/* The lock is held. NULL: no memory. */
static unsigned char *rows_of(Picture *p, int band)
{
    if (p->bands[band].rows) return p->bands[band].rows;
    size_t n_bytes = (size_t)int_min(BAND, p->format.height) * p->row_bytes;
    unsigned char *rows = (unsigned char *)p->spare;
    if (rows) p->spare = p->spare->next;
    else rows = malloc(n_bytes > sizeof(Spare) ? n_bytes : sizeof(Spare));
    if (rows) blacken(p, rows, n_bytes);
    else p->is_short_of_memory = true;
    return p->bands[band].rows = rows;
}

/* ---- compressing ---- */

static void give_back(Picture *p, unsigned char *rows)
{
    Spare *spare = (Spare *)(void *)rows;
    spare->next = p->spare;
    p->spare = spare;
}

/* The lock is held, but for the work itself. */
static void compress_what_is_whole(Picture *p)
{
    p->is_writing = true;
    while (p->n_written < p->n_bands && p->bands[p->n_written].n_missing == 0) {
        int band = p->n_written;
        unsigned char *rows = rows_of(p, band);
        pthread_mutex_unlock(&p->lock);
        if (rows) png_writer_rows(p->out, rows, n_rows(p, band));
        pthread_mutex_lock(&p->lock);
        if (rows) give_back(p, rows);
        p->bands[band].rows = NULL;
        p->n_written++;
    }
    p->is_writing = false;
}

/* Rows [y0, y1) of a tile, all in one band. */
static void add_to_band(Picture *p, int x0, int y0, int x1, int y1, const FilmPixel *pixels)
{
    int band = y0 / BAND, across = x1 - x0;
    pthread_mutex_lock(&p->lock);
    unsigned char *rows = rows_of(p, band);
    pthread_mutex_unlock(&p->lock);
    for (int y = y0; rows && y < y1; y++)
        encode(p, pixels + (size_t)(y - y0) * (size_t)across, across,
               rows + (size_t)(y % BAND) * p->row_bytes + (size_t)x0 * p->pixel_bytes);
    pthread_mutex_lock(&p->lock);
    p->bands[band].n_missing -= (size_t)across * (size_t)(y1 - y0);
    if (!p->is_writing) compress_what_is_whole(p);
    pthread_mutex_unlock(&p->lock);
}

void picture_add(Picture *p, int x0, int y0, int x1, int y1, const FilmPixel *pixels)
{
    for (int y = y0, next; y < y1; y = next) {
        next = int_min(y1, (y / BAND + 1) * BAND);
        add_to_band(p, x0, y, x1, next, pixels + (size_t)(y - y0) * (size_t)(x1 - x0));
    }
}

const char *picture_write(Picture *p, const char *path)
{
    pthread_mutex_lock(&p->lock);
    for (int i = p->n_written; i < p->n_bands; i++) p->bands[i].n_missing = 0;
    compress_what_is_whole(p);
    pthread_mutex_unlock(&p->lock);
    return p->is_short_of_memory ? "out of memory" : png_writer_end(p->out, path);
}
