/* The point that many rays go through: where the camera is, or a light. What a thread carries of it while it traces; what
 * is made of it is pencil.h's. */
#ifndef TRIMRAY_APEX_H
#define TRIMRAY_APEX_H

#include "render/xform.h"

#include <stdint.h>

typedef struct Apex Apex;
struct Apex {
    Vec3 at;                       /* in the space of the rays: see apex_at */
    const Xform *placement;        /* within an object that is placed: */
    Apex *outside;                 /* what it is outside */
    bool is_known;                 /* `at` */
};

/* In the world. */
static inline Apex apex_make(Vec3 at) { return (Apex){ .at = at, .is_known = true }; }

/* Rays enter many objects, and few that ask for the apex: it is taken there when one does. */
static inline Apex apex_within(Apex *outside, const Xform *placement)
{
    return (Apex){ .placement = placement, .outside = outside };
}

static inline Vec3 apex_at(Apex *a)
{
    if (!a->is_known) a->at = xform_unpoint(a->placement, apex_at(a->outside)), a->is_known = true;
    return a->at;
}

/* Where the camera is; about how many rays it has in a steradian. */
typedef struct { Vec3 at; double density; } Viewpoint;

typedef struct Pencils Pencils;    /* render/pencil.h */

/* The pencil that a thread last had in this place, and the cell that its last ray fell into: the next ray's, mostly. */
typedef struct {
    const void *tree;
    Vec3 apex;
    const struct Pencil *pencil;
    uint64_t place, mask;          /* places that agree where the mask has ones are in the cell */
    const void *entry;             /* the cell's */
} PencilSlot;

/* What a thread knows of the pencils of a picture. Enough slots for the trees that rays of one tile of it reach, for each of
 * a few lights. */
#define N_PENCIL_SLOTS 64
typedef struct {
    Pencils *all;
    PencilSlot of[N_PENCIL_SLOTS];
} PencilMemory;

#endif
