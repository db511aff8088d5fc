/* A tile: a dyadic part of a patch, with what decides most rays at sight. The leaf of `method certain`; 96 bytes, since the
 * control points stay with the patch. A tile that leaves a ray in doubt is halved, once for all rays.
 *
 * Parameters here are local: s, t in [0, 1] over the tile. The frame is in single precision; its bounds hold for the
 * numbers that are stored. */
#ifndef TRIMRAY_TILE_H
#define TRIMRAY_TILE_H

#include "nurbs/patch.h"

#include <stdatomic.h>
#include <stdint.h>

/* How far beyond [0, 1] the frame's bounds still hold: a root that Newton finds just outside the tile proves that there is
 * none inside, if the map is one-to-one on the larger square. A sixteenth is room for an iterate that overshoots, and what
 * varies with the distance varies by an eighth more over the larger square. */
#define TILE_MARGIN PATCH_MARGIN

/* A ray looks at a surface as two planes (certify.h). That their normals are not perpendicular to it, times 2^53: 1 for the
 * direction's coordinates (vec_normalize has two roundings, the first is common to all), 4.5 for those of patch_ray, 9 since
 * it takes the direction for a unit vector, whose length is off by 4.5: 1.5 of the sum of squares, 1 each of the root, the
 * inverse and the product. The depth's are fewer: 4.5 of this, 3.5 of the length that t is in units of, 1 of its own
 * quotient. */
#define VIEW_FRAME_ROUNDINGS 15

/* Two dot products with unit vectors have 3 roundings each, of sums of sizes that Cauchy's inequality bounds by the other
 * vector's length: sqrt 2 times 3. */
#define VIEW_DOT_ROUNDINGS 5

/* What is rounded when a ray looks at the half-vectors, of 2^-53 of their lengths: these, and 2 of a determinant. */
#define TILE_VIEW_ROUNDINGS (VIEW_FRAME_ROUNDINGS + VIEW_DOT_ROUNDINGS + 2)

/* Turn and stretch are at least this (over a sigma of at most 1), and so is the frame's sine. So a contraction proves
 * nothing where the half-vectors' determinant, as the ray sees them, is less than 2^-21 of their lengths' product, and its
 * rounding, TILE_VIEW_ROUNDINGS for each of them, is less than 2^-26 of it. */
#define TILE_LEAST_VARIATION 0x1p-20

/* Halving divides the variation of the derivatives by about two. The preparation halves at most this often in either
 * direction: on smooth surfaces that is enough, and a wild one, of folds and cusps, has a thousand tiles a span at most. */
#define TILE_FIRST_HALVINGS 5

/* A tile is halved at most this often after the preparation, where a ray is in doubt. What bends forever (a pole, a cusp)
 * and what touches a ray for good is left to clip.c, which refines along the ray alone. */
#define TILE_MAX_HALVINGS 10

/* So often a side may be halved in all, and so small is what is left. */
#define TILE_PLACE_UNIT 0x1p-15
_Static_assert(TILE_FIRST_HALVINGS + TILE_MAX_HALVINGS <= 15, "places are whole numbers of their unit");

typedef struct Tile Tile;
typedef struct Halves Halves;
struct Tile {
    const Patch *patch;
    _Atomic(const Halves *) halves;  /* for rays in doubt (doubt.h); NULL: not made yet */
    uint16_t s0, t0, ds, dt;         /* where it lies in the patch's [0, 1], in TILE_PLACE_UNIT: exact */
    float middle[3];                 /* of its parallelogram: near S(1/2, 1/2), about the patch's origin */
    float radius;                    /* |S - middle| <= radius, with the margin */
    /* S(s, t) = middle + (2s-1) half_s + (2t-1) half_t + r, |r| <= deviation on the tile; that has room for
     * TILE_VIEW_ROUNDINGS, and so have turn, stretch and sine. */
    float half_s[3], length_s;       /* length_s >= |half_s| */
    float half_t[3], length_t;
    float deviation;
    /* How far the derivatives of the homogeneous numerator w (S - x), for any x within `radius` of the middle, with the
     * margin, are from 2 w_middle times the half-vectors: out of the plane of these, and along it; of 2 w_middle times their
     * lengths, both together (root of the sum of squares), over the smaller singular value sigma of half_s / length_s,
     * half_t / length_t. INFINITY: no frame. */
    float turn, stretch;
    float sine;                      /* |half_s x half_t| <= sine length_s length_t */
    float w_middle;                  /* the weight at the middle: 1 where the patch is polynomial */
    uint32_t n_halvings : 8;         /* since the preparation */
    uint32_t cone : 24;              /* 1 + index of its cone (pole_cone.h) among its group's; 0: it has none */
};

static inline Vec3 tile_vec(const float x[3]) { return vec(x[0], x[1], x[2]); }

typedef struct { double s0, t0, ds, dt; } TilePlace;
static inline TilePlace tile_place(const Tile *f)
{
    const double unit = TILE_PLACE_UNIT;
    return (TilePlace){ f->s0 * unit, f->t0 * unit, f->ds * unit, f->dt * unit };
}

/* From the net over the tile, k_u * k_v homogeneous points about the patch's origin. */
void tile_make(const Patch *p, const Vec4 *net, TilePlace place, Tile *out);

/* How far such a net may be from where exact arithmetic has it. */
double tile_net_error(const Patch *p);

/* The net of a patch over a place within it. */
void tile_net(const Patch *p, TilePlace place, Vec4 *net);

/* Halves a place and the net over it: `net` becomes that of the second half. */
typedef struct { TilePlace first, second; } TilePlaces;
TilePlaces tile_cut(const Patch *p, TilePlace place, bool along_u, Vec4 *net, Vec4 *first);

/* The homogeneous numerator and its derivatives by s and t of the tile: about the patch's origin. s and t become those that
 * were evaluated: within 2^-53 of the patch's parameters. */
void tile_evaluate(const Tile *tile, double *s, double *t, Vec4 *value, Vec4 *by_s, Vec4 *by_t);

/* Before it is worth a frame: about how much `variation` would be, and the shares of it that halving along u, along v would
 * halve. For k_u * k_v homogeneous points. */
typedef struct { double variation, along_u, along_v; } TileBend;
TileBend tile_bend(int k_u, int k_v, const Vec4 *points);

/* Its interval of the surface's parameters. */
TrimRect tile_rect(const Patch *p, TilePlace place);

#endif
