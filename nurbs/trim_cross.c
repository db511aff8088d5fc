/* Crossings of two chains and of a chain with itself. See trim_cross.h.
 *
 * Two chains: the excursion of a to one side of b is the greatest distance from b of a's points on that side. If a
 * crosses b, both excursions are positive, and the lesser one is the depth. They are found by bisecting the pieces of a,
 * with bounds: along a piece the distance to one piece of b is a convex function, so its ends bound the distance to b;
 * runs of pieces that keep clear of b are on one side, and one point of them may be enough.
 *
 * One chain: the places where it meets itself cut it into runs. Beside a run the winding number is constant, on either
 * side. Where it is neither 0 nor that of a simple loop, circles that touch the run on that side are shrunk until no
 * other piece is in them; the centre of one that is still in the wrong region proves a depth of its diameter. */
#include "nurbs/trim_cross.h"

#include <stdlib.h>

/* ---- two chains ---- */

enum { OUTSIDE, INSIDE };

typedef struct {
    const TrimChain *a, *b;
    double far[2];       /* excursions so far, at most TRIM_DEPTH_CAP */
    Vec2 at[2];
    int piece[2];        /* of a, where the excursion was found */
} Excursions;

static int side_of(const TrimChain *b, Vec2 p) { return trim_chain_winding(b, wide_point(p)) != 0 ? INSIDE : OUTSIDE; }

static void note(Excursions *e, int side, double distance, Vec2 at, int piece)
{
    if (distance > e->far[side]) e->far[side] = distance, e->at[side] = at, e->piece[side] = piece;
}

static double distance_to_piece(const TrimChain *c, int piece, Vec2 p)
{
    return vec2_length(vec2_sub(p, trim_piece_nearest(c->path.p[piece], c->path.p[piece + 1], p)));
}

/* Where a-b and c-d meet; for parallel ones an end. */
static Vec2 meeting_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
    Vec2 ab = vec2_sub(b, a), cd = vec2_sub(d, c);
    double det = vec2_cross(ab, cd), s = vec2_cross(vec2_sub(c, a), cd) / det;
    return s >= 0 && s <= 1 ? vec2_add(a, vec2_scale(ab, s)) : trim_piece_nearest(a, b, c);
}

/* A place where the straight piece p-q meets b, if it does. */
static bool meets_chain(Vec2 p, Vec2 q, const TrimChain *b, Vec2 *at)
{
    TrimRect box = trim_rect_of(p, q);
    for (int j = trim_chain_next(b, box, 0); j >= 0; j = trim_chain_next(b, box, j + 1)) {
        if (!trim_pieces_meet(p, q, b->path.p[j], b->path.p[j + 1])) continue;
        *at = meeting_point(p, q, b->path.p[j], b->path.p[j + 1]);
        return true;
    }
    return false;
}

/* The part p-q of a piece. */
static void bisect(Excursions *e, Vec2 p, Vec2 q, int piece)
{
    Vec2 middle = vec2((p.x + q.x) / 2, (p.y + q.y) / 2);
    double half = vec2_length(vec2_sub(q, p)) / 2;
    TrimNearest near = trim_chain_nearest(e->b, middle, TRIM_DEPTH_CAP);
    double most = near.distance + half;
    if (near.piece >= 0) {
        most = fmin(most, fmax(distance_to_piece(e->b, near.piece, p), distance_to_piece(e->b, near.piece, q)));
    }
    most = fmin(most, TRIM_DEPTH_CAP);
    if (most <= TRIM_EPSILON || (e->far[INSIDE] >= most && e->far[OUTSIDE] >= most)) return;
    Vec2 at;
    int side = side_of(e->b, middle);
    note(e, side, near.distance, middle, piece);
    if (half <= TRIM_EPSILON) return;
    if (e->far[side] >= most && !meets_chain(p, q, e->b, &at)) return;
    bisect(e, p, middle, piece);
    bisect(e, middle, q, piece);
}

/* Group g of a and those after it that make the subtree at `level`: is there nothing to be learnt in it? */
static bool is_settled(Excursions *e, int level, int g)
{
    if (trim_chain_meets(e->b, e->a->boxes.box[level][g >> (2 * level)])) return false;
    int first = g * TRIM_GROUP, side = side_of(e->b, e->a->path.p[first]);
    if (e->far[side] >= TRIM_DEPTH_CAP) return true;
    note(e, side, trim_chain_nearest(e->b, e->a->path.p[first], TRIM_DEPTH_CAP).distance, e->a->path.p[first], first);
    return e->far[side] >= TRIM_DEPTH_CAP;
}

static void excursions_below(Excursions *e, int level, int g)
{
    const TrimChain *a = e->a;
    if (is_settled(e, level, g) || (e->far[INSIDE] >= TRIM_DEPTH_CAP && e->far[OUTSIDE] >= TRIM_DEPTH_CAP)) return;
    if (level > 0) {
        int step = 1 << (2 * (level - 1));
        int end = g + TRIM_BOXES_FAN * step;
        for (int h = g; h < end && h < a->boxes.n[0]; h += step) excursions_below(e, level - 1, h);
    } else {
        int first = g * TRIM_GROUP;
        for (int i = first; i < first + TRIM_GROUP && i < a->path.n; i++) bisect(e, a->path.p[i], a->path.p[i + 1], i);
    }
}

static Excursions excursions(const TrimChain *a, const TrimChain *b)
{
    Excursions e = { .a = a, .b = b };
    excursions_below(&e, a->boxes.n_levels - 1, 0);
    return e;
}

/* The lesser excursion, and the crossing through which a went there. */
static TrimCrossing crossing_of(const Excursions *e)
{
    int lesser = e->far[INSIDE] < e->far[OUTSIDE] ? INSIDE : OUTSIDE;
    TrimCrossing c = { e->far[lesser], e->at[lesser] };
    if (c.depth <= TRIM_EPSILON) return c;
    for (int back = 0, i = e->piece[lesser]; back < e->a->path.n; back++, i = (i > 0 ? i : e->a->path.n) - 1) {
        if (meets_chain(e->a->path.p[i], e->a->path.p[i + 1], e->b, &c.at)) break;
    }
    return c;
}

TrimRelation trim_relation(const TrimChain *a, const TrimChain *b)
{
    if (!trim_rects_meet(trim_chain_box(a), trim_chain_box(b))) return (TrimRelation){ 0 };
    if (!trim_chains_meet(a, b, NULL, NULL)) {   /* one point speaks for all */
        return (TrimRelation){ .is_inside = side_of(b, a->path.p[0]) == INSIDE };
    }
    Excursions ab = excursions(a, b);
    TrimRelation r = { ab.far[INSIDE] > ab.far[OUTSIDE], crossing_of(&ab) };
    if (r.crossing.depth > TRIM_EPSILON) {
        Excursions ba = excursions(b, a);
        TrimCrossing other = crossing_of(&ba);
        if (other.depth > r.crossing.depth) r.crossing = other;
    }
    return r;
}

/* ---- a chain with itself ---- */

/* Where the chain is met by itself, as piece number + place on the piece. */
typedef struct { Arena *arena; const TrimChain *chain; double *at; size_t n, capacity; } Cuts;

static void add_cut(Cuts *cuts, int i, Vec2 p)
{
    Vec2 a = cuts->chain->path.p[i], ab = vec2_sub(cuts->chain->path.p[i + 1], a);
    double s = vec2_dot(vec2_sub(p, a), ab) / vec2_dot(ab, ab);
    ARENA_PUSH(cuts->arena, cuts->at, cuts->n, cuts->capacity) = i + fmin(fmax(s, 0), 1);
}

/* Both pieces are cut where the one may meet the other: at a crossing point, or at the ends of a common edge. */
static bool cut_pair(void *context, int i, int j)
{
    Cuts *cuts = context;
    const Vec2 *a = cuts->chain->path.p + i, *b = cuts->chain->path.p + j;
    if (trim_side(a[0], a[1], b[0]) == 0 && trim_side(a[0], a[1], b[1]) == 0) {
        add_cut(cuts, i, b[0]), add_cut(cuts, i, b[1]);
        add_cut(cuts, j, a[0]), add_cut(cuts, j, a[1]);
    } else {
        Vec2 p = meeting_point(a[0], a[1], b[0], b[1]);
        add_cut(cuts, i, p), add_cut(cuts, j, p);
    }
    return false;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static Cuts find_cuts(Arena *scratch, const TrimChain *c)
{
    Cuts cuts = { .arena = scratch, .chain = c };
    (void)trim_chains_meet(c, c, cut_pair, &cuts);
    if (cuts.n > 0) qsort(cuts.at, cuts.n, sizeof *cuts.at, by_value);
    return cuts;
}

typedef struct {
    const TrimChain *chain;
    int winding;             /* of a simple loop in this direction */
    TrimCrossing worst;
    Vec2 start;              /* where the run begins: a crossing point */
} Self;

/* What is in a circle is nearer to the centre than the radius by this share of it: so x, which is on it, is not found in it
 * again, nor is the point through which it was shrunk. Depths need no more. */
#define TOUCHING 1e-6

/* The radius of the largest circle, up to that of TRIM_DEPTH_CAP, that touches the chain at x on the side of the unit normal
 * and has no piece in it; shrunk to pass through the nearest point until none is nearer. */
static double touching_circle(const TrimChain *c, Vec2 x, Vec2 normal)
{
    double r = TRIM_DEPTH_CAP / 2;
    while (r > TRIM_EPSILON) {
        Vec2 centre = vec2_add(x, vec2_scale(normal, r));
        TrimNearest near = trim_chain_nearest(c, centre, r * (1 - TOUCHING));
        if (near.piece < 0) return r;
        Vec2 d = vec2_sub(near.point, x);
        double shrunk = vec2_dot(d, d) / (2 * vec2_dot(d, normal));
        r = shrunk > 0 && shrunk < r * (1 - TOUCHING) ? shrunk : r / 2;
    }
    return 0;
}

/* Looks at both sides of piece i at place s. Is one of them in a wrong region? */
static bool probe(Self *self, int i, double s)
{
    const TrimChain *c = self->chain;
    Vec2 a = c->path.p[i], ab = vec2_sub(c->path.p[i + 1], a), x = vec2_add(a, vec2_scale(ab, s));
    Vec2 left = vec2_scale(vec2(-ab.y, ab.x), 1 / vec2_length(ab));
    bool is_wrong = false;
    for (int side = -1; side <= 1; side += 2) {
        Vec2 normal = vec2_scale(left, side);
        double r = touching_circle(c, x, normal);
        int winding = r > 0 ? trim_chain_winding(c, wide_point(vec2_add(x, vec2_scale(normal, r)))) : 0;
        if (winding == 0 || winding == self->winding) continue;
        is_wrong = true;
        if (2 * r > self->worst.depth) self->worst = (TrimCrossing){ 2 * r, self->start };
    }
    return is_wrong;
}

/* Samples of a run, so many on each of its pieces that there are some dozens in all. */
#define RUN_SAMPLES 32

/* The part of piece i that is in the run, as places on the piece. */
typedef struct { double lo, hi; } Part;
static Part part_of(double from, double to, int i) { return (Part){ fmax(from - i, 0), fmin(to - i, 1) }; }

/* The run from `from` to `to` (piece numbers and places on them; `to` may be beyond the last piece, and goes round). */
static void probe_run(Self *self, double from, double to)
{
    int n = self->chain->path.n, first = (int)from, last = (int)to, per_piece = RUN_SAMPLES / (last - first + 1) + 1;
    int middle = (int)((from + to) / 2);
    Part part = part_of(from, to, middle);
    if (to - from < TRIM_EPSILON || !probe(self, middle % n, (part.lo + part.hi) / 2)) return;
    for (int i = first; i <= last && self->worst.depth <= TRIM_CROSSING; i++) {
        part = part_of(from, to, i);
        for (int j = 0; j < per_piece; j++) {
            probe(self, i % n, part.lo + (part.hi - part.lo) * (j + .5) / per_piece);
        }
    }
}

TrimCrossing trim_self_crossing(Arena *scratch, const TrimChain *c, bool is_ccw)
{
    Cuts cuts = find_cuts(scratch, c);
    Self self = { .chain = c, .winding = is_ccw ? 1 : -1 };
    for (size_t k = 0; k < cuts.n && self.worst.depth <= TRIM_CROSSING; k++) {
        double from = cuts.at[k], to = k + 1 < cuts.n ? cuts.at[k + 1] : cuts.at[0] + c->path.n;
        int i = (int)from % c->path.n;
        self.start = vec2_add(c->path.p[i], vec2_scale(vec2_sub(c->path.p[i + 1], c->path.p[i]), from - floor(from)));
        probe_run(&self, from, to);
    }
    return self.worst;
}
