/* What the walks through a tree of sixteen-wide boxes have in common: of one ray (bvh_wide.c), of a bunch
 * whose rays go together (bvh_bunch.c) or apart (bvh_apart.c). */
#ifndef TRIMRAY_BVH_WALK_H
#define TRIMRAY_BVH_WALK_H

#include "render/bvh_collapse.h"
#include "render/simd.h"

#define WIDTH WIDE_WIDTH
#define IS_ITEM WIDE_IS_ITEM
#define ROW 8            /* children that are looked at together */

/* Children that may wait at once: trees are no deeper than the binary tree, and one within, 64 each. */
#define WIDE_MOST_WAITING (2 * 64 * (WIDTH - 1) + WIDTH)

#define TINY 0x1p-60     /* components of a direction that count as that: see bvh_wide.c */

/* An origin that is no farther away than NEAR times the tree's coordinates stays where it is: the boxes then swell by NEAR
 * 2^-21 of those. */
#define NEAR 16

/* Floats beyond x, by more than it is rounded. Which way that is no branch could foretell. */
#define BEYOND 0x1p-22
#define LEAST_BEYOND 0x1p-126
ALWAYS_INLINE float float_above(double x) { return (float)(x + (fabs(x) * BEYOND + LEAST_BEYOND)); }
ALWAYS_INLINE float float_below(double x) { return (float)(x - (fabs(x) * BEYOND + LEAST_BEYOND)); }

/* What is made of a ray for a tree serves for those within it. */
static inline bool is_within(const Box *a, const Box *b)
{
    bool is = true;
    for (int k = 0; k < 3; k++) is = is && a->lo[k] >= b->lo[k] && a->hi[k] <= b->hi[k];
    return is;
}

/* Where a is no number: b. */
ALWAYS_INLINE V8f v8_max(V8f a, V8f b)
{
    V8f out;
    for (int i = 0; i < ROW; i++) out[i] = a[i] > b[i] ? a[i] : b[i];
    return out;
}

ALWAYS_INLINE V8f v8_min(V8f a, V8f b)
{
    V8f out;
    for (int i = 0; i < ROW; i++) out[i] = a[i] < b[i] ? a[i] : b[i];
    return out;
}

/* ---- what comes from memory ahead ---- */

ALWAYS_INLINE void fetch(const char *from, size_t size)
{
    for (size_t at = 0; at < size; at += 64) __builtin_prefetch(from + at);
}

/* Children that wait on the stack, a bit for each, and all that is read of them later: in a large tree that is what takes
 * the time. None of it has to be read to know where the rest lies. */
ALWAYS_INLINE void fetch_children(const WideBvh *b, const WideNode *n, unsigned which)
{
    bool has_items = false;
    for (; which != 0; which &= which - 1) {
        uint32_t child = n->child[__builtin_ctz(which)], i = child & ~IS_ITEM;
        if (child & IS_ITEM) {
            has_items = true;
            if (b->items) fetch(b->items + i * b->item_size, b->item_size);
            if (n->items) fetch((const char *)(n->items + i * b->lent_size), b->lent_size);
        } else {
            fetch((const char *)&b->nodes[i], sizeof(WideNode));
        }
    }
    if (has_items && n->behind) fetch(n->behind, b->behind_size);
}

#endif
