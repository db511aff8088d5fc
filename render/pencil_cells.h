/* What a pencil is: made by pencil.c, looked up by pencil_entry.c. */
#ifndef TRIMRAY_PENCIL_CELLS_H
#define TRIMRAY_PENCIL_CELLS_H

#include "render/pencil.h"

#include <stdatomic.h>

/* See pencil.c: how far beside the apex a ray may pass, over the sum of its largest coordinate and the tree's. */
#define DELTA 0x1p-40

/* A place in a window is a number of so many bits along either side. */
#define PLACE_BITS 16
#define PLACES 0x1p16

typedef struct Cell Cell;
struct Cell {
    const WideNode *entry;           /* NULL: there is nothing to be met */
    _Atomic(Cell *) parts;           /* its four quarters; NULL: it is not quartered; one of nobody: nothing is
                                        known yet */
};

typedef struct {
    double lo[2], side;              /* the window, a square */
    double scale, origin[2];         /* places on a unit of the face, and before the window; of a face through which nothing
                                        of the tree is seen 0 and 1: no ray is at a place that counts */
    Cell cell;                       /* all of it */
} Face;

typedef struct Pencil Pencil;
struct Pencil {
    const WideBvh *tree;
    Vec3 apex;
    double delta, density;           /* density: rays that are to be expected on a unit of a face, or in a steradian */
    Pencils *all;
    Face faces[6];                   /* of axis k: 2k towards it, 2k + 1 away */
    Pencil *older;                   /* in its bucket */
};

/* The pencil of an apex and a tree, whose hash this is; made on first use. */
const Pencil *pencil_find(Pencils *all, uint64_t hash, const WideBvh *tree, const Apex *apex);

/* The face, x and y in one number. */
static inline uint64_t place_of(int face, int x, int y) { return (uint64_t)face << 32 | (uint64_t)x << 16 | (uint64_t)y; }

/* Walks down to the cell of a place, and remembers it in the slot; its entry. */
const WideNode *pencil_find_cell(PencilSlot *slot, int face, int x, int y);

#endif
