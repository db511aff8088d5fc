/* Boxes over things in a row: level 0 holds one box a thing, each level above one for four of the level below. */
#ifndef TRIMRAY_TRIM_BOXES_H
#define TRIMRAY_TRIM_BOXES_H

#include "nurbs/trim_tree.h"

#define TRIM_BOXES_FAN 4
#define TRIM_BOXES_MAX_LEVELS 17

typedef struct {
    int n_levels;                            /* 0: nothing there */
    int n[TRIM_BOXES_MAX_LEVELS];
    TrimRect *box[TRIM_BOXES_MAX_LEVELS];
} TrimBoxes;

/* How many of the level below box i of a level holds, from box i * TRIM_BOXES_FAN on. */
static inline int trim_boxes_below(const TrimBoxes *t, int level, int i)
{
    int left = t->n[level - 1] - i * TRIM_BOXES_FAN;
    return left < TRIM_BOXES_FAN ? left : TRIM_BOXES_FAN;
}

TrimBoxes trim_boxes_make(Arena *a, TrimRect *lowest, int n);    /* keeps `lowest`, which lies in the arena */

/* The first box i >= from of level 0 that meets r (closed against closed); -1: none. Logarithmic where r is small. */
int trim_boxes_next(const TrimBoxes *t, TrimRect r, int from);

static inline TrimRect trim_rect_of(Vec2 a, Vec2 b)               /* corners in any order */
{
    return (TrimRect){ double_min(a.x, b.x), double_max(a.x, b.x), double_min(a.y, b.y), double_max(a.y, b.y) };
}

static inline TrimRect trim_rect_union(TrimRect a, TrimRect b)
{
    return (TrimRect){ double_min(a.u0, b.u0), double_max(a.u1, b.u1), double_min(a.v0, b.v0), double_max(a.v1, b.v1) };
}

static inline bool trim_rects_meet(TrimRect a, TrimRect b)
{
    return a.u0 <= b.u1 && b.u0 <= a.u1 && a.v0 <= b.v1 && b.v0 <= a.v1;
}

/* The tree is walked without a stack: at position i of level 0 the largest subtree that begins there is tried first (its
 * level says how often 4 divides i; position 0 is the root's), then the first of its children, and so on; what is
 * dismissed is stepped over. */
static inline int trim_boxes_level(const TrimBoxes *t, int i)
{
    int level = i == 0 ? t->n_levels - 1 : __builtin_ctz((unsigned)i) / 2;
    return level < t->n_levels ? level : t->n_levels - 1;
}

static inline int trim_boxes_span(int level) { return 1 << (2 * level); }   /* things in a box of this level */

#endif
