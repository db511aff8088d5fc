/* Several samples a pixel, where neighbours differ: POV-Ray's two ways (+AM1, +AM2). */
#ifndef TRIMRAY_ANTIALIAS_H
#define TRIMRAY_ANTIALIAS_H

#include "render/film.h"

typedef struct {
    int method;                  /* 0: one sample a pixel; 1: all or one; 2: as many as it takes */
    double threshold;            /* colours this far apart are different */
    int depth;                   /* 1: depth^2 samples more; 2: a pixel is halved up to depth - 1 times */
    double jitter;               /* how far samples are displaced, in units of their distance: 0 to 1 */
    double gamma;                /* colours are compared as they look: c^(1/gamma) */
} Antialias;

enum { ANTIALIAS_MAX_DEPTH = 9, ANTIALIAS_MIN_BLOCK = 4 };

/* POV-Ray's, but off and without jitter. */
static inline Antialias antialias_default(void) { return (Antialias){ .threshold = .3, .depth = 3, .gamma = 2.5 }; }

/* Samples of the picture, into out[0 .. n); pixel centres are at integers. Must depend on nothing but their places; places
 * that are asked for together are neighbours. */
typedef void (*AntialiasSample)(void *context, const Vec2 at[], int n, Pixel out[]);

/* The pixels [x0, x1) x [y0, y1), row by row into out, whose rows are `stride` pixels apart. For method 1 the result depends
 * on the block, as in POV-Ray: the row above it and the column left of it are looked at, but not refined. */
void antialias_block(const Antialias *a, int x0, int y0, int x1, int y1, AntialiasSample sample, void *context,
                     Arena *scratch, Pixel *out, size_t stride);

#endif
