/* Chains of pieces and the implicit trees of boxes over them. See trim_chain.h.
 *
 * A tree is walked without a stack: at position i of level 0 the largest subtree that begins there is tried first (its
 * level says how often 4 divides i), then the first of its children, and so on; what is dismissed is stepped over.
 *
 * The winding number counts the pieces that a ray from p towards +u crosses, upward ones as +1. A run of pieces in a
 * convex set that does not contain p counts as the straight piece between its ends does, for it can be drawn straight
 * without passing p: so only runs whose box and strip contain p are opened. A point level with p counts as below it,
 * which makes each vertex belong to one of its pieces. */
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

/* ---- strips ---- */

/* Coordinates of points near the unit square along an axis err by less than 4 u in all; twice that, and to spare. */
#define STRIP_MARGIN 0x1p-48

static inline double along(const TrimStrip *s, int k, Vec2 p)
{
    return k == 0 ? vec2_dot(s->axis, p) : vec2_cross(s->axis, p);
}

/* The direction in which the points spread most: the greater eigenvector of their covariance. */
static Vec2 main_axis(const Vec2 *p, int n)
{
    double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (int i = 0; i < n; i++) x += p[i].x - p[0].x, y += p[i].y - p[0].y;
    x = p[0].x + x / n, y = p[0].y + y / n;
    for (int i = 0; i < n; i++) {
        double dx = p[i].x - x, dy = p[i].y - y;
        xx += dx * dx, xy += dx * dy, yy += dy * dy;
    }
    double angle = atan2(2 * xy, xx - yy) / 2;
    return vec2(cos(angle), sin(angle));
}

static TrimStrip strip_of(const Vec2 *p, int n)
{
    TrimStrip s = { main_axis(p, n), { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < 2; k++) {
            double x = along(&s, k, p[i]);
            s.lo[k] = fmin(s.lo[k], x - STRIP_MARGIN), s.hi[k] = fmax(s.hi[k], x + STRIP_MARGIN);
        }
    }
    return s;
}

static bool strip_contains(const TrimStrip *s, Vec2 p)
{
    double x = along(s, 0, p), y = along(s, 1, p);
    return x >= s->lo[0] && x <= s->hi[0] && y >= s->lo[1] && y <= s->hi[1];
}

/* Are they apart along an axis of s? The other one: its centre, half its sides, and the direction of the first. */
static bool is_apart(const TrimStrip *s, Vec2 centre, Vec2 half, Vec2 direction)
{
    double c = fabs(vec2_dot(s->axis, direction)), d = fabs(vec2_cross(s->axis, direction));
    double reach[2] = { half.x * c + half.y * d, half.x * d + half.y * c };
    for (int k = 0; k < 2; k++) {
        double x = along(s, k, centre), r = reach[k] + STRIP_MARGIN;
        if (x - r > s->hi[k] || x + r < s->lo[k]) return true;
    }
    return false;
}

static bool strip_meets_rect(const TrimStrip *s, TrimRect r)
{
    return !is_apart(s, vec2((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2), vec2((r.u1 - r.u0) / 2, (r.v1 - r.v0) / 2), vec2(1, 0));
}

static bool is_apart_from_strip(const TrimStrip *s, const TrimStrip *t)
{
    double x = (t->lo[0] + t->hi[0]) / 2, y = (t->lo[1] + t->hi[1]) / 2;
    Vec2 centre = vec2(x * t->axis.x - y * t->axis.y, x * t->axis.y + y * t->axis.x);
    return is_apart(s, centre, vec2((t->hi[0] - t->lo[0]) / 2, (t->hi[1] - t->lo[1]) / 2), t->axis);
}

/* ---- chains ---- */

static inline int piece_end(const TrimChain *c, int from, int n_pieces)
{
    return c->n - from < n_pieces ? c->n : from + n_pieces;
}

static void add_strips(Arena *a, TrimChain *c)
{
    for (int level = 0; level < c->boxes.n_levels; level++) {
        int n_pieces = span_of(level) * TRIM_GROUP;
        c->strip[level] = ARENA_ARRAY(a, TrimStrip, c->boxes.n[level]);
        for (int i = 0; i < c->boxes.n[level]; i++) {
            int first = i * n_pieces;
            c->strip[level][i] = strip_of(c->p + first, piece_end(c, first, n_pieces) - first + 1);
        }
    }
}

TrimChain trim_chain_make(Arena *a, const Vec2 *p, int n)
{
    TrimChain c = { .n = n, .p = arena_copy(a, p, (size_t)n + 1, sizeof *p) };
    int n_groups = (n - 1) / TRIM_GROUP + 1;
    TrimRect *box = ARENA_ARRAY(a, TrimRect, n_groups);
    for (int g = 0; g < n_groups; g++) {
        int first = g * TRIM_GROUP;
        box[g] = trim_rect_of(p[first], p[first + 1]);
        for (int i = first + 1; i < piece_end(&c, first, TRIM_GROUP); i++) box[g] = trim_rect_union(box[g], trim_rect_of(p[i], p[i + 1]));
    }
    c.boxes = trim_boxes_make(a, box, n_groups);
    add_strips(a, &c);
    return c;
}

TrimRect trim_chain_box(const TrimChain *c) { return c->boxes.box[c->boxes.n_levels - 1][0]; }

/* ---- winding ---- */

/* What the run from a to b counts if all of it is to the right of p. */
static inline int straddles(Vec2 a, Vec2 b, Vec2 p) { return (b.y > p.y) - (a.y > p.y); }

static int piece_winding(Vec2 a, Vec2 b, Vec2 p)
{
    int s = straddles(a, b, p);
    if (s == 0 || p.x > fmax(a.x, b.x)) return 0;
    return p.x < fmin(a.x, b.x) || trim_side(a, b, p) == s ? s : 0;
}

static int group_winding(const TrimChain *c, int first, Vec2 p)
{
    int winding = 0;
    for (int i = first; i < piece_end(c, first, TRIM_GROUP); i++) winding += piece_winding(c->p[i], c->p[i + 1], p);
    return winding;
}

/* The run at position i of this level: can it be counted without a look inside? */
static inline bool counts_whole(const TrimChain *c, int level, int i, Vec2 p, int *winding)
{
    TrimRect box = c->boxes.box[level][i >> (2 * level)];
    if (p.y < box.v0 || p.y >= box.v1 || p.x > box.u1) return true;
    Vec2 a = c->p[i * TRIM_GROUP], b = c->p[piece_end(c, i * TRIM_GROUP, span_of(level) * TRIM_GROUP)];
    if (p.x < box.u0) *winding += straddles(a, b, p);
    else if (!strip_contains(&c->strip[level][i >> (2 * level)], p)) *winding += piece_winding(a, b, p);
    else return false;
    return true;
}

int trim_chain_winding(const TrimChain *c, Vec2 p)
{
    int winding = 0;
    for (int i = 0; i < c->boxes.n[0]; ) {
        int level = level_at(&c->boxes, i);
        while (!counts_whole(c, level, i, p, &winding)) {
            if (level == 0) {
                winding += group_winding(c, i * TRIM_GROUP, p);
                break;
            }
            level--;
        }
        i += span_of(level);
    }
    return winding;
}

/* ---- what is near ---- */

static inline bool run_may_meet_rect(const TrimChain *c, int level, int i, TrimRect r)
{
    return trim_rects_meet(c->boxes.box[level][i], r) && strip_meets_rect(&c->strip[level][i], r);
}

/* The first group from `from` on whose box and strip meet r; -1: none. */
static int next_group(const TrimChain *c, TrimRect r, int from)
{
    const TrimBoxes *t = &c->boxes;
    for (int i = from; i < t->n[0]; ) {
        int level = level_at(t, i);
        while (run_may_meet_rect(c, level, i >> (2 * level), r)) {
            if (level == 0) return i;
            level--;
        }
        i += span_of(level);
    }
    return -1;
}

int trim_chain_next(const TrimChain *c, TrimRect r, int from)
{
    int i = from, group = from / TRIM_GROUP;
    while (i < c->n) {
        if (i % TRIM_GROUP == 0 || i == from) {
            group = next_group(c, r, i / TRIM_GROUP);
            if (group < 0) return -1;
            if (group * TRIM_GROUP > i) i = group * TRIM_GROUP;
        }
        if (trim_rects_meet(trim_rect_of(c->p[i], c->p[i + 1]), r)) return i;
        i++;
    }
    return -1;
}

bool trim_chain_meets(const TrimChain *c, TrimRect r)
{
    for (int i = trim_chain_next(c, r, 0); i >= 0; i = trim_chain_next(c, r, i + 1)) {
        if (trim_piece_meets_rect(c->p[i], c->p[i + 1], r)) return true;
    }
    return false;
}

static inline TrimRect around(Vec2 p, double by) { return (TrimRect){ p.x - by, p.x + by, p.y - by, p.y + by }; }
TrimNearest trim_chain_nearest(const TrimChain *c, Vec2 p, double limit)
{
    TrimNearest best = { limit, -1, p };
    int i = trim_chain_next(c, around(p, limit), 0);
    while (i >= 0) {
        Vec2 q = trim_piece_nearest(c->p[i], c->p[i + 1], p);
        double d = vec2_length(vec2_sub(p, q));
        if (d < best.distance) best = (TrimNearest){ d, i, q };
        i = trim_chain_next(c, around(p, best.distance), i + 1);
    }
    return best;
}

/* ---- two chains, or one against itself ---- */

typedef struct { const TrimChain *a, *b; TrimPairVisit visit; void *context; } Pairing;

static bool runs_may_meet(const Pairing *p, int level_a, int i, int level_b, int j)
{
    const TrimStrip *s = &p->a->strip[level_a][i], *t = &p->b->strip[level_b][j];
    return trim_rects_meet(p->a->boxes.box[level_a][i], p->b->boxes.box[level_b][j])
        && !is_apart_from_strip(s, t) && !is_apart_from_strip(t, s);
}

static bool pieces_pair(const Pairing *p, int i, int j)
{
    const TrimChain *a = p->a, *b = p->b;
    if (a == b && (j <= i + 1 || (i == 0 && j == a->n - 1))) return false;
    if (!trim_pieces_meet(a->p[i], a->p[i + 1], b->p[j], b->p[j + 1])) return false;
    return !p->visit || p->visit(p->context, i, j);
}

static bool groups_pair(const Pairing *p, int g, int h)
{
    int end_a = piece_end(p->a, g * TRIM_GROUP, TRIM_GROUP), end_b = piece_end(p->b, h * TRIM_GROUP, TRIM_GROUP);
    for (int i = g * TRIM_GROUP; i < end_a; i++) {
        for (int j = h * TRIM_GROUP; j < end_b; j++) {
            if (pieces_pair(p, i, j)) return true;
        }
    }
    return false;
}

static inline int children(const TrimChain *c, int level, int i, int *first)
{
    *first = i * TRIM_BOXES_FAN;
    return (int)fmin(c->boxes.n[level - 1] - *first, TRIM_BOXES_FAN);
}

/* Run i of a at its level and run j of b: the higher of the two is opened, or both. */
static bool runs_pair(const Pairing *p, int level_a, int i, int level_b, int j)
{
    bool is_same = p->a == p->b && level_a == level_b && i == j;
    if (!is_same && !runs_may_meet(p, level_a, i, level_b, j)) return false;
    if (level_a == 0 && level_b == 0) return groups_pair(p, i, j);
    int first_a = i, n_a = 1, first_b = j, n_b = 1, below_a = level_a, below_b = level_b;
    if (level_a >= level_b) n_a = children(p->a, level_a, i, &first_a), below_a--;
    if (level_b >= level_a) n_b = children(p->b, level_b, j, &first_b), below_b--;
    for (int s = first_a; s < first_a + n_a; s++) {
        for (int t = first_b; t < first_b + n_b; t++) {
            if (p->a == p->b && s > t) continue;
            if (runs_pair(p, below_a, s, below_b, t)) return true;
        }
    }
    return false;
}

bool trim_chains_meet(const TrimChain *a, const TrimChain *b, TrimPairVisit visit, void *context)
{
    return runs_pair(&(Pairing){ a, b, visit, context }, a->boxes.n_levels - 1, 0, b->boxes.n_levels - 1, 0);
}
