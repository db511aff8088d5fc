/* Chains of pieces and the implicit trees of boxes over them. See trim_chain.h.
 *
 * A tree is walked without a stack: at position i of level 0 the largest subtree that begins there is tried first (its level
 * is the number of times that 4 divides i), then the first of its children, and so on; what is dismissed is stepped over.
 *
 * The winding number counts the pieces that a ray from p towards +u crosses, upward ones as +1. A run of pieces in a box that
 * lies wholly to the right of p counts by its two ends alone, whatever it does between them: so only boxes that contain p
 * are opened. A point level with p counts as below it, which makes each vertex belong to one of its pieces. */
#include "nurbs/trim_chain.h"

#include <float.h>

/* ---- boxes ---- */

TrimRect trim_rect_of(Vec2 a, Vec2 b)
{
    return (TrimRect){ fmin(a.x, b.x), fmax(a.x, b.x), fmin(a.y, b.y), fmax(a.y, b.y) };
}

TrimRect trim_rect_union(TrimRect a, TrimRect b)
{
    return (TrimRect){ fmin(a.u0, b.u0), fmax(a.u1, b.u1), fmin(a.v0, b.v0), fmax(a.v1, b.v1) };
}

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

/* The level of the largest subtree that begins at position i; position 0 is the root's. */
static inline int level_at(const TrimBoxes *t, int i)
{
    int level = i == 0 ? t->n_levels - 1 : __builtin_ctz((unsigned)i) / 2;
    return level < t->n_levels ? level : t->n_levels - 1;
}

static inline int span_of(int level) { return 1 << (2 * level); }

int trim_boxes_next(const TrimBoxes *t, TrimRect r, int from)
{
    if (t->n_levels == 0) return -1;
    for (int i = from; i < t->n[0]; ) {
        int level = level_at(t, i);
        while (trim_rects_meet(t->box[level][i >> (2 * level)], r)) {
            if (level == 0) return i;
            level--;
        }
        if (level == t->n_levels - 1) return -1;
        i += span_of(level);
    }
    return -1;
}

/* ---- pieces ---- */

/* Adds x to the expansion of n doubles that do not overlap, ascending ([She97] Grow-Expansion); returns n + 1. */
static int grow(double e[], int n, double x)
{
    for (int i = 0; i < n; i++) {
        double sum = x + e[i], part = sum - x;
        e[i] = (x - (sum - part)) + (e[i] - part);
        x = sum;
    }
    e[n] = x;
    return n + 1;
}

static int grow_product(double e[], int n, double x, double y)
{
    double product = x * y;
    n = grow(e, n, fma(x, y, -product));
    return grow(e, n, product);
}

/* a x b + b x p + p x a, without rounding. */
static int side_exact(Vec2 a, Vec2 b, Vec2 p)
{
    double e[12];
    int n = 0;
    n = grow_product(e, n, a.x, b.y), n = grow_product(e, n, -a.y, b.x);
    n = grow_product(e, n, b.x, p.y), n = grow_product(e, n, -b.y, p.x);
    n = grow_product(e, n, p.x, a.y), n = grow_product(e, n, -p.y, a.x);
    for (int i = n - 1; i >= 0; i--) {
        if (e[i] != 0) return e[i] > 0 ? 1 : -1;
    }
    return 0;
}

int trim_side(Vec2 a, Vec2 b, Vec2 p)
{
    const double u = DBL_EPSILON / 2;
    double left = (b.x - a.x) * (p.y - a.y), right = (b.y - a.y) * (p.x - a.x);
    double det = left - right, bound = (3 + 16 * u) * u * (fabs(left) + fabs(right));   /* [She97] ccwerrboundA */
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return side_exact(a, b, p);
}

Vec2 trim_piece_nearest(Vec2 a, Vec2 b, Vec2 p)
{
    Vec2 ab = vec2_sub(b, a);
    double along = vec2_dot(vec2_sub(p, a), ab), length2 = vec2_dot(ab, ab);
    if (!(along > 0)) return a;
    return along < length2 ? vec2_add(a, vec2_scale(ab, along / length2)) : b;
}

bool trim_piece_meets_rect(Vec2 a, Vec2 b, TrimRect r)
{
    if (!trim_rects_meet(trim_rect_of(a, b), r)) return false;
    int s = trim_side(a, b, vec2(r.u0, r.v0));
    return s == 0 || s != trim_side(a, b, vec2(r.u1, r.v0)) || s != trim_side(a, b, vec2(r.u0, r.v1))
        || s != trim_side(a, b, vec2(r.u1, r.v1));
}

bool trim_pieces_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
    return trim_rects_meet(trim_rect_of(a, b), trim_rect_of(c, d))
        && trim_side(a, b, c) * trim_side(a, b, d) <= 0 && trim_side(c, d, a) * trim_side(c, d, b) <= 0;
}

/* ---- chains ---- */

static inline int piece_end(const TrimChain *c, int from, int n_pieces)
{
    return c->n - from < n_pieces ? c->n : from + n_pieces;
}

TrimChain trim_chain_make(Arena *a, const Vec2 *p, int n)
{
    TrimChain c = { .n = n, .p = arena_copy(a, p, (size_t)n + 1, sizeof *p) };
    int n_groups = (n - 1) / TRIM_GROUP + 1;
    TrimRect *box = ARENA_ARRAY(a, TrimRect, n_groups);
    for (int g = 0; g < n_groups; g++) {
        int first = g * TRIM_GROUP, end = piece_end(&c, first, TRIM_GROUP);
        box[g] = trim_rect_of(p[first], p[first + 1]);
        for (int i = first + 1; i < end; i++) box[g] = trim_rect_union(box[g], trim_rect_of(p[i], p[i + 1]));
    }
    c.boxes = trim_boxes_make(a, box, n_groups);
    return c;
}

TrimRect trim_chain_box(const TrimChain *c) { return c->boxes.box[c->boxes.n_levels - 1][0]; }

/* What the run from a to b counts if all of it is to the right of p. */
static inline int straddles(Vec2 a, Vec2 b, Vec2 p) { return (b.y > p.y) - (a.y > p.y); }

static int piece_winding(Vec2 a, Vec2 b, Vec2 p)
{
    int s = straddles(a, b, p);
    if (s == 0 || p.x > fmax(a.x, b.x)) return 0;
    return p.x < fmin(a.x, b.x) || trim_side(a, b, p) == s ? s : 0;
}

static int group_winding(const TrimChain *c, int group, Vec2 p)
{
    int first = group * TRIM_GROUP, end = piece_end(c, first, TRIM_GROUP), winding = 0;
    for (int i = first; i < end; i++) winding += piece_winding(c->p[i], c->p[i + 1], p);
    return winding;
}

/* Position i of this level: can it be counted without a look inside? */
static inline bool counts_whole(const TrimChain *c, int level, int i, Vec2 p, int *winding)
{
    TrimRect box = c->boxes.box[level][i >> (2 * level)];
    if (p.y < box.v0 || p.y >= box.v1 || p.x > box.u1) return true;
    if (!(p.x < box.u0)) return false;
    int first = i * TRIM_GROUP;
    *winding += straddles(c->p[first], c->p[piece_end(c, first, span_of(level) * TRIM_GROUP)], p);
    return true;
}

int trim_chain_winding(const TrimChain *c, Vec2 p)
{
    int winding = 0;
    for (int i = 0; i < c->boxes.n[0]; ) {
        int level = level_at(&c->boxes, i);
        while (!counts_whole(c, level, i, p, &winding)) {
            if (level == 0) {
                winding += group_winding(c, i, p);
                break;
            }
            level--;
        }
        i += span_of(level);
    }
    return winding;
}

bool trim_chain_meets(const TrimChain *c, TrimRect r)
{
    for (int g = trim_boxes_next(&c->boxes, r, 0); g >= 0; g = trim_boxes_next(&c->boxes, r, g + 1)) {
        int first = g * TRIM_GROUP, end = piece_end(c, first, TRIM_GROUP);
        for (int i = first; i < end; i++) {
            if (trim_piece_meets_rect(c->p[i], c->p[i + 1], r)) return true;
        }
    }
    return false;
}

static inline TrimRect around(Vec2 p, double by) { return (TrimRect){ p.x - by, p.x + by, p.y - by, p.y + by }; }

TrimNearest trim_chain_nearest(const TrimChain *c, Vec2 p, double limit)
{
    TrimNearest best = { limit, -1, p };
    int g = trim_boxes_next(&c->boxes, around(p, limit), 0);
    while (g >= 0) {
        int first = g * TRIM_GROUP, end = piece_end(c, first, TRIM_GROUP);
        for (int i = first; i < end; i++) {
            Vec2 q = trim_piece_nearest(c->p[i], c->p[i + 1], p);
            double d = vec2_length(vec2_sub(p, q));
            if (d < best.distance) best = (TrimNearest){ d, i, q };
        }
        g = trim_boxes_next(&c->boxes, around(p, best.distance), g + 1);
    }
    return best;
}
