/* How two pictures differ, as they stand in their files. */
#ifndef TRIMRAY_COMPARE_H
#define TRIMRAY_COMPARE_H

#include "render/image.h"

typedef struct {
    double rmse;                 /* over all pixels and channels, of the full range */
    double psnr;                 /* in dB; INFINITY: they are the same */
    double ssim;                 /* of the grey pictures; 1: they are the same */
    double largest;              /* of any channel, of the full range */
    int largest_x, largest_y;    /* where; the first */
    size_t n_pixels, n_over;     /* n_over: pixels with a channel that differs by more than 1/255 */
    size_t n_beyond;             /* ... by more than `within` */
} Comparison;

/* The pictures have the same size. `within` is in steps of 1/255. Alpha is a channel where either has it. */
Comparison compare_images(Arena *scratch, const Image *a, const Image *b, double within);

/* Where they differ, to look at: a dim grey picture of a; on it, blue where the difference is at most `within`, and from
 * yellow to red to white the farther it is beyond. For GAMMA_NONE. NULL: no memory. */
Film *compare_picture(const Image *a, const Image *b, double within);

#endif
