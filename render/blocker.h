/* What blocked the last ray: neighbouring shadow rays mostly meet the same thing, and whether anything is met at all does
 * not depend on what is asked first. A thread remembers one item for each tree and each light, as long as it blocks. */
#ifndef TRIMRAY_BLOCKER_H
#define TRIMRAY_BLOCKER_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define N_BLOCKERS 16

typedef struct {
    const void *aim;         /* what the rays go to: a light, or NULL */
    struct { const void *tree, *aim; uint32_t item; } of[N_BLOCKERS];
} Blockers;

static inline uint32_t blocker_slot(const Blockers *b, const void *tree)
{
    return (uint32_t)(((uintptr_t)tree >> 6) ^ ((uintptr_t)b->aim >> 3)) % N_BLOCKERS;
}

/* The item of the tree that blocked the last ray to the same aim; UINT32_MAX: none did. A tree that is gone may have
 * had the same address: the item may be one that this tree does not have. */
static inline uint32_t blocker_recall(const Blockers *b, const void *tree)
{
    uint32_t i = blocker_slot(b, tree);
    return b->of[i].tree == tree && b->of[i].aim == b->aim ? b->of[i].item : UINT32_MAX;
}

static inline void blocker_note(Blockers *b, const void *tree, uint32_t item)
{
    uint32_t i = blocker_slot(b, tree);
    b->of[i].tree = tree, b->of[i].aim = b->aim, b->of[i].item = item;
}

static inline void blocker_forget(Blockers *b, const void *tree) { b->of[blocker_slot(b, tree)].tree = NULL; }

/* So that what is counted does not depend on which thread has which part of a picture. */
static inline void blockers_clear(Blockers *b) { memset(b, 0, sizeof *b); }

#endif
