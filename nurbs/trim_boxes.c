/* Implicit trees of boxes. See trim_boxes.h. */
#include "nurbs/trim_boxes.h"

TrimBoxes trim_boxes_make(Arena *a, TrimRect *lowest, int n)
{
    TrimBoxes t = { .n_levels = n > 0, .n = { n }, .box = { lowest } };
    while (n > 1) {
        const TrimRect *below = t.box[t.n_levels - 1];
        int n_above = (n - 1) / TRIM_BOXES_FAN + 1;
        TrimRect *above = ARENA_ARRAY(a, TrimRect, n_above);
        for (int i = 0; i < n; i++) {
            int j = i / TRIM_BOXES_FAN;
            above[j] = i % TRIM_BOXES_FAN == 0 ? below[i] : trim_rect_union(above[j], below[i]);
        }
        t.box[t.n_levels] = above, t.n[t.n_levels] = n = n_above;
        t.n_levels++;
    }
    return t;
}

int trim_boxes_next(const TrimBoxes *t, TrimRect r, int from)
{
    if (t->n_levels == 0) return -1;
    for (int i = from; i < t->n[0]; ) {
        int level = trim_boxes_level(t, i);
        while (trim_rects_meet(t->box[level][i >> (2 * level)], r)) {
            if (level == 0) return i;
            level--;
        }
        if (level == t->n_levels - 1) return -1;
        i += trim_boxes_span(level);
    }
    return -1;
}
