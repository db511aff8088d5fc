/* Pairs of pieces. See trim_pairs.h.
 *
 * Pieces are shown to be apart by halving them until the boxes of their parts are: as they are monotone, a part's box is
 * that of its ends. Neighbours go out from their vertex into different quadrants, or the halves next to the vertex are
 * looked at again. So that pieces too short to matter do not stand between neighbours, these may have a few of them
 * between them. */
#include "nurbs/trim_pairs.h"

#include <assert.h>

typedef struct Pairing {
    const TrimChain *a, *b;
    bool (*test)(struct Pairing *p, int i, int j);   /* true: enough */
    TrimPairVisit visit;
    void *context;
    double near;
    int budget;                                      /* tests of boxes left for the pair in hand */
} Pairing;

/* ---- down the trees ---- */

static bool runs_may_meet(const Pairing *p, int level_a, int i, int level_b, int j)
{
    return trim_rects_meet(p->a->boxes.box[level_a][i], p->b->boxes.box[level_b][j])
        && !trim_strips_are_apart(&p->a->strip[level_a][i], &p->b->strip[level_b][j]);
}

static inline int group_end(const TrimChain *c, int group)
{
    return c->path.n < (group + 1) * TRIM_GROUP ? c->path.n : (group + 1) * TRIM_GROUP;
}

static bool groups_pair(Pairing *p, int g, int h)
{
    int end_a = group_end(p->a, g), end_b = group_end(p->b, h);
    for (int i = g * TRIM_GROUP; i < end_a; i++) {
        for (int j = h * TRIM_GROUP; j < end_b; j++) {
            if (!(p->a == p->b && j <= i) && p->test(p, i, j)) return true;
        }
    }
    return false;
}

static inline int children(const TrimChain *c, int level, int i, int *first)
{
    *first = i * TRIM_BOXES_FAN;
    return trim_boxes_below(&c->boxes, level, i);
}

/* Run i of a at its level and run j of b: the higher of the two is opened, or both. */
static bool runs_pair(Pairing *p, int level_a, int i, int level_b, int j)
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

static bool any_pair(Pairing *p) { return runs_pair(p, p->a->boxes.n_levels - 1, 0, p->b->boxes.n_levels - 1, 0); }

/* ---- straight pieces that meet ---- */

static bool straight_pair(Pairing *p, int i, int j)
{
    const Vec2 *a = p->a->path.p + i, *b = p->b->path.p + j;
    bool are_neighbours = p->a == p->b && (j == i + 1 || (i == 0 && j == p->a->path.n - 1));
    if (are_neighbours || !trim_pieces_meet(a[0], a[1], b[0], b[1])) return false;
    return !p->visit || p->visit(p->context, i, j);
}

bool trim_chains_meet(const TrimChain *a, const TrimChain *b, TrimPairVisit visit, void *context)
{
    assert(!a->path.arc && !b->path.arc);
    return any_pair(&(Pairing){ .a = a, .b = b, .test = straight_pair, .visit = visit, .context = context });
}

/* ---- any pieces that are apart ---- */

/* A part of a piece; its ends are rounded. */
typedef struct { Vec2 a, b; const TrimArc *arc; double t0, t1; } Part;

/* Of the domain: what the ends of two parts may be off by, 64 times 2^-54. A point is rounded by 2^-54, and a straight piece's
 * middle is that of ends that are off already: halved 48 times it is as small as this. */
#define PART_MARGIN 0x1p-48

/* Tests of boxes that are worth it for one pair: dozens of halvings near a few places. */
#define PAIR_BUDGET 500

static Part part_of(const TrimPath *path, int i)
{
    Part p = { path->p[i], path->p[i + 1], NULL, 0, 1 };
    if (!trim_is_straight(path, i)) p.arc = &path->arc[i], p.t0 = p.arc->t0, p.t1 = p.arc->t1;
    return p;
}

static double size_of(const Part *p) { return fmax(fabs(p->b.x - p->a.x), fabs(p->b.y - p->a.y)); }

static void halve(const Part *p, Part *first, Part *second)
{
    double t = (p->t0 + p->t1) / 2;
    Vec2 m = vec2((p->a.x + p->b.x) / 2, (p->a.y + p->b.y) / 2);
    if (p->arc) m = wide_point_round(trim_segment_at(p->arc->segment, t));
    *first = *second = *p;
    first->b = second->a = m;
    first->t1 = second->t0 = t;
}

static bool parts_are_apart(Pairing *p, const Part *s, const Part *t)
{
    TrimRect box = trim_rect_of(s->a, s->b), other = trim_rect_of(t->a, t->b);
    box = (TrimRect){ box.u0 - PART_MARGIN, box.u1 + PART_MARGIN, box.v0 - PART_MARGIN, box.v1 + PART_MARGIN };
    if (!trim_rects_meet(box, other)) return true;
    if (--p->budget < 0 || size_of(s) + size_of(t) < PART_MARGIN) return false;
    if (!s->arc && !t->arc) return !trim_pieces_meet(s->a, s->b, t->a, t->b);
    bool splits_s = size_of(s) >= size_of(t);
    const Part *whole = splits_s ? s : t, *rest = splits_s ? t : s;
    Part first, second;
    halve(whole, &first, &second);
    return parts_are_apart(p, &first, rest) && parts_are_apart(p, &second, rest);
}

/* Do they leave their vertex (the end of s, the beginning of t) into quadrants that have only that in common? */
static bool part_ways(const Part *s, const Part *t)
{
    double su = s->a.x - s->b.x, sv = s->a.y - s->b.y, tu = t->b.x - t->a.x, tv = t->b.y - t->a.y;
    bool are_straight = !s->arc && !t->arc && s->b.x == t->a.x && s->b.y == t->a.y;
    if (are_straight && trim_side(s->a, s->b, t->b) != 0) return true;
    return (su > 0 && tu < 0) || (su < 0 && tu > 0) || (sv > 0 && tv < 0) || (sv < 0 && tv > 0)
        || (su == 0 && tv == 0) || (sv == 0 && tu == 0);
}

/* Also where one stays so near to the vertex that its excursions beyond the other do not count. */
static bool neighbours_are_apart(Pairing *p, const Part *s, const Part *t)
{
    if (part_ways(s, t) || fmin(size_of(s), size_of(t)) <= p->near) return true;
    if (--p->budget < 0) return false;
    Part far_s, near_s, near_t, far_t;
    halve(s, &far_s, &near_s);
    halve(t, &near_t, &far_t);
    return parts_are_apart(p, &far_s, &far_t) && parts_are_apart(p, &far_s, &near_t) && parts_are_apart(p, &near_s, &far_t)
        && neighbours_are_apart(p, &near_s, &near_t);
}

/* Is piece j the next but for a few that are shorter than `near` together? */
#define FEW 4
static bool follows(const Pairing *p, int i, int j)
{
    const TrimPath *path = &p->a->path;
    double length = 0;
    int n_between = 0;
    for (int k = (i + 1) % path->n; k != j; k = (k + 1) % path->n) {
        length += vec2_length(vec2_sub(path->p[k + 1], path->p[k]));
        if (++n_between > FEW || length > p->near) return false;
    }
    return true;
}

/* Are the two perhaps not apart? */
static bool doubtful_pair(Pairing *p, int i, int j)
{
    if (!trim_rects_meet(trim_piece_box(&p->a->path, i), trim_piece_box(&p->b->path, j))) return false;
    Part s = part_of(&p->a->path, i), t = part_of(&p->b->path, j);
    p->budget = PAIR_BUDGET;
    if (p->a != p->b) return !parts_are_apart(p, &s, &t);
    bool is_after = follows(p, i, j), is_before = follows(p, j, i);
    if (!is_after && !is_before) return !parts_are_apart(p, &s, &t);
    return (is_after && !neighbours_are_apart(p, &s, &t)) || (is_before && !neighbours_are_apart(p, &t, &s));
}

bool trim_chains_are_apart(const TrimChain *a, const TrimChain *b, double near)
{
    return !any_pair(&(Pairing){ .a = a, .b = b, .test = doubtful_pair, .near = near });
}
