/* A surface's control points about a point near it, and the Bézier patches of its spans, to twice the precision of a double:
 * a point is hi[i] + lo[i]. So each coordinate of a patch is rounded once, at the end, however many knots it takes to close
 * its span and however unevenly they are spaced. */
#ifndef TRIMRAY_WIDE_NET_H
#define TRIMRAY_WIDE_NET_H

#include "nurbs/surface.h"
#include "nurbs/wide.h"

typedef struct { Vec4 *hi, *lo; } WideNet;

/* The error of a point of a closed span that is moved twice (to the base, to the patch's middle), relative to the surface's
 * size. Control points about the base are no longer than that. For orders k up to 32, both directions, and u = 2^-53:
 *   closing's matrix   2 (k-1) combinations deep, each 7 u^2 and two shares of 2^-100 (wide.h): 2 * 62 * 2^-98.7 < 2^-91.7
 *   products by it     4 (k+1) (k+3) u^2 of their sizes (wide_net.c): 2 * 4620 u^2 < 2^-92.8
 *   moving             12 u^2 each
 * together less than 2^-91; and once more for the weights that a point is divided by. */
#define WIDE_NET_ERROR 0x1p-90

/* Homogeneous points about `to`: {wx - w to.x, ...}. */
void wide_net_move(WideNet net, size_t n, Vec3 to);

typedef struct {
    const Surface *s;
    WideNet net;                              /* its points, about the base */
    const Wide *const *closing_u, *const *closing_v;    /* of the span mu: bezier.h; NULL: it is closed already, or empty */
} WideSurface;

/* The result lies in `a`. */
WideSurface wide_surface_make(Arena *a, const Surface *s, Vec3 base);

/* The Bézier patch over the non-empty spans mu_u and mu_v: k_u * k_v points, u fastest. */
void wide_surface_close(const WideSurface *w, int mu_u, int mu_v, WideNet out);

#endif
