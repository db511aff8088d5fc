/* Chains of pieces. See trim_chain.h.
 *
 * The winding number counts the pieces that a ray from p towards +u crosses, upward ones as +1. A run of pieces in a
 * convex set that does not contain p counts as the straight piece between its ends does, for it can be drawn straight
 * without passing p: so only runs whose box and strip contain p are opened. A point level with p counts as below it,
 * which makes each vertex belong to one of its pieces. */
#include "nurbs/trim_chain.h"

#include <assert.h>

/* ---- strips ---- */

/* Coordinates of points near the unit square along an axis err by less than 4 u in all, those of a strip's corners by as
 * much again: four times the sum. */
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
    return vec2_longer_axis(xx, xy, yy);
}

static void widen(TrimStrip *s, Vec2 p, double by)
{
    for (int k = 0; k < 2; k++) {
        double x = along(s, k, p);
        s->lo[k] = double_min(s->lo[k], x - by), s->hi[k] = double_max(s->hi[k], x + by);
    }
}

static TrimStrip strip_round(const Vec2 *p, int n)
{
    TrimStrip s = { main_axis(p, n), { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
    for (int i = 0; i < n; i++) widen(&s, p[i], STRIP_MARGIN);
    return s;
}

/* Round the pieces from vertex `first` to vertex `end`. */
static TrimStrip strip_of(const TrimPath *path, int first, int end)
{
    const Vec2 *p = path->p;
    TrimStrip s = strip_round(p + first, end - first + 1);
    for (int i = first; i < end && path->arc; i++) {
        double bulge = path->arc[i].bulge + STRIP_MARGIN;
        if (trim_is_straight(path, i)) continue;
        widen(&s, p[i], bulge);
        widen(&s, p[i + 1], bulge);
    }
    return s;
}

static Vec2 strip_point(const TrimStrip *s, double x, double y)
{
    return vec2(x * s->axis.x - y * s->axis.y, x * s->axis.y + y * s->axis.x);
}

/* Round strips: their corners say enough, and a level takes a quarter of the time of the one below. */
static TrimStrip strip_of_strips(const TrimStrip *below, int n)
{
    Vec2 corner[4 * TRIM_BOXES_FAN];
    for (int i = 0; i < 4 * n; i++) {
        const TrimStrip *s = &below[i / 4];
        corner[i] = strip_point(s, i & 1 ? s->hi[0] : s->lo[0], i & 2 ? s->hi[1] : s->lo[1]);
    }
    return strip_round(corner, 4 * n);
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
    Vec2 centre = strip_point(t, (t->lo[0] + t->hi[0]) / 2, (t->lo[1] + t->hi[1]) / 2);
    return is_apart(s, centre, vec2((t->hi[0] - t->lo[0]) / 2, (t->hi[1] - t->lo[1]) / 2), t->axis);
}

bool trim_strips_are_apart(const TrimStrip *s, const TrimStrip *t)
{
    return is_apart_from_strip(s, t) || is_apart_from_strip(t, s);
}

/* ---- chains ---- */

static inline int piece_end(const TrimChain *c, int from, int n_pieces)
{
    return c->path.n - from < n_pieces ? c->path.n : from + n_pieces;
}

/* Of level 0 round the pieces of a group, of the others round the strips of the level below. */
static void add_strips(Arena *a, TrimChain *c)
{
    for (int level = 0; level < c->boxes.n_levels; level++) {
        TrimStrip *strip = c->strip[level] = ARENA_ARRAY(a, TrimStrip, c->boxes.n[level]);
        for (int i = 0; i < c->boxes.n[level]; i++) {
            int first = i * (level == 0 ? TRIM_GROUP : TRIM_BOXES_FAN);
            if (level == 0) strip[i] = strip_of(&c->path, first, piece_end(c, first, TRIM_GROUP));
            else strip[i] = strip_of_strips(c->strip[level - 1] + first, trim_boxes_below(&c->boxes, level, i));
        }
    }
}

static void add_boxes(Arena *a, TrimChain *c)
{
    int n_groups = (c->path.n - 1) / TRIM_GROUP + 1;
    TrimRect *box = ARENA_ARRAY(a, TrimRect, n_groups);
    for (int g = 0; g < n_groups; g++) {
        int first = g * TRIM_GROUP;
        box[g] = trim_piece_box(&c->path, first);
        for (int i = first + 1; i < piece_end(c, first, TRIM_GROUP); i++) {
            box[g] = trim_rect_union(box[g], trim_piece_box(&c->path, i));
        }
    }
    c->boxes = trim_boxes_make(a, box, n_groups);
}

/* The arcs of one segment are neighbours: it is copied once. */
static const TrimArc *copy_arcs(Arena *a, const TrimArc *arc, int n)
{
    TrimArc *copy = arena_copy(a, arc, (size_t)n, sizeof *arc);
    for (int i = 0; i < n; i++) {
        const TrimSegment *s = arc[i].segment;
        if (!s) continue;
        if (i > 0 && arc[i - 1].segment == s) {
            copy[i].segment = copy[i - 1].segment;
            continue;
        }
        TrimSegment *own = arena_copy(a, s, 1, sizeof *s);
        own->p = arena_copy(a, s->p, (size_t)s->k, sizeof *s->p);
        copy[i].segment = own;
    }
    return copy;
}

TrimChain trim_chain_make(Arena *a, const TrimPath *path)
{
    TrimChain c = { .path = { .n = path->n } };
    size_t n_points = (size_t)path->n + 1;
    c.path.p = arena_copy(a, path->p, n_points, sizeof *path->p);
    if (path->low) c.path.low = arena_copy(a, path->low, n_points, sizeof *path->low);
    if (path->arc) c.path.arc = copy_arcs(a, path->arc, path->n);
    add_boxes(a, &c);
    add_strips(a, &c);
    return c;
}

TrimRect trim_chain_box(const TrimChain *c) { return c->boxes.box[c->boxes.n_levels - 1][0]; }

/* ---- winding ---- */

/* What a straight piece from vertex i to vertex j counts. */
static int straight_winding(const TrimPath *path, int i, int j, WidePoint p)
{
    int s = trim_run_straddles(path, i, j, p);
    Vec2 a = path->p[i], b = path->p[j];
    if (s == 0 || p.x.hi > double_max(a.x, b.x)) return 0;
    return p.x.hi < double_min(a.x, b.x) || trim_side(a, b, wide_point_round(p)) == s ? s : 0;
}

int trim_piece_winding(const TrimPath *path, int i, WidePoint p)
{
    if (trim_is_straight(path, i)) return straight_winding(path, i, i + 1, p);
    int s = trim_run_straddles(path, i, i + 1, p);
    Vec2 a = path->p[i], b = path->p[i + 1];
    if (s == 0 || p.x.hi > double_max(a.x, b.x)) return 0;
    if (p.x.hi < double_min(a.x, b.x)) return s;
    return trim_arc_is_right(&path->arc[i], trim_vertex(path, i), trim_vertex(path, i + 1), p) ? s : 0;
}

static int group_winding(const TrimChain *c, int first, WidePoint p)
{
    int winding = 0;
    for (int i = first; i < piece_end(c, first, TRIM_GROUP); i++) winding += trim_piece_winding(&c->path, i, p);
    return winding;
}

/* The run at position i of this level: can it be counted without a look inside? */
static inline bool counts_whole(const TrimChain *c, int level, int i, WidePoint p, int *winding)
{
    TrimRect box = c->boxes.box[level][i >> (2 * level)];
    double x = p.x.hi, y = p.y.hi;
    if (y < box.v0 || y > box.v1 || x > box.u1) return true;
    int a = i * TRIM_GROUP, b = piece_end(c, a, trim_boxes_span(level) * TRIM_GROUP);
    if (x < box.u0) *winding += trim_run_straddles(&c->path, a, b, p);
    else if (strip_contains(&c->strip[level][i >> (2 * level)], vec2(x, y))) return false;
    else *winding += straight_winding(&c->path, a, b, p);
    return true;
}

int trim_chain_winding(const TrimChain *c, WidePoint p)
{
    int winding = 0;
    for (int i = 0; i < c->boxes.n[0]; ) {
        int level = trim_boxes_level(&c->boxes, i);
        while (!counts_whole(c, level, i, p, &winding)) {
            if (level == 0) {
                winding += group_winding(c, i * TRIM_GROUP, p);
                break;
            }
            level--;
        }
        i += trim_boxes_span(level);
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
        int level = trim_boxes_level(t, i);
        while (run_may_meet_rect(c, level, i >> (2 * level), r)) {
            if (level == 0) return i;
            level--;
        }
        i += trim_boxes_span(level);
    }
    return -1;
}

int trim_chain_next(const TrimChain *c, TrimRect r, int from)
{
    int i = from, group = from / TRIM_GROUP;
    while (i < c->path.n) {
        if (i % TRIM_GROUP == 0 || i == from) {
            group = next_group(c, r, i / TRIM_GROUP);
            if (group < 0) return -1;
            if (group * TRIM_GROUP > i) i = group * TRIM_GROUP;
        }
        if (trim_rects_meet(trim_piece_box(&c->path, i), r)) return i;
        i++;
    }
    return -1;
}

/* r touches the arc's box from below or from above: at this height the arc is at its end, or, by that vertex's low part,
 * near it or nowhere. */
static bool arc_meets_height(const TrimPath *path, int i, double u0, double u1, double v)
{
    WidePoint from = trim_vertex(path, i), to = trim_vertex(path, i + 1), at = wide_point(vec2(nextafter(u1, 2), v));
    if (trim_run_straddles(path, i, i + 1, at) != 0)
        return !trim_arc_is_right(&path->arc[i], from, to, at)
            && trim_arc_is_right(&path->arc[i], from, to, wide_point(vec2(nextafter(u0, -1), v)));
    WidePoint top = wide_less(from.y, to.y) ? to : from;
    return !trim_is_above(from, at) && !wide_less(top.y, at.y) && top.x.hi >= u0 && top.x.hi <= u1;
}

/* An arc from the lower left to the upper right keeps clear of r if it passes to the right of r's lower right corner or
 * to the left of the upper left one, both cut to the arc's box; other arcs likewise. The box is that of the vertices' high
 * parts: the arc may be within a unit in the last place beside it, and so do the corners go. */
static bool arc_meets_rect(const TrimPath *path, int i, TrimRect r)
{
    Vec2 a = path->p[i], b = path->p[i + 1];
    TrimRect box = trim_rect_of(a, b);
    TrimRect q = { fmax(r.u0, box.u0), fmin(r.u1, box.u1), fmax(r.v0, box.v0), fmin(r.v1, box.v1) };
    if (q.v0 == q.v1 && box.v0 < box.v1) return arc_meets_height(path, i, q.u0, q.u1, q.v0);
    bool leans_right = (b.x > a.x) == (b.y > a.y);
    double left_v = leans_right ? q.v0 : q.v1, right_v = leans_right ? q.v1 : q.v0;
    WidePoint from = trim_vertex(path, i), to = trim_vertex(path, i + 1);
    if (left_v > box.v0 && left_v < box.v1
        && trim_arc_is_right(&path->arc[i], from, to, wide_point(vec2(nextafter(q.u1, 2), left_v)))) return false;
    return !(right_v > box.v0 && right_v < box.v1
             && !trim_arc_is_right(&path->arc[i], from, to, wide_point(vec2(nextafter(q.u0, -1), right_v))));
}

bool trim_path_meets(const TrimPath *path, int i, TrimRect r)
{
    if (trim_is_straight(path, i)) return trim_piece_meets_rect(path->p[i], path->p[i + 1], r);
    return trim_rects_meet(trim_piece_box(path, i), r) && arc_meets_rect(path, i, r);
}

bool trim_chain_meets(const TrimChain *c, TrimRect r)
{
    for (int i = trim_chain_next(c, r, 0); i >= 0; i = trim_chain_next(c, r, i + 1)) {
        if (trim_path_meets(&c->path, i, r)) return true;
    }
    return false;
}

static inline TrimRect around(Vec2 p, double by) { return (TrimRect){ p.x - by, p.x + by, p.y - by, p.y + by }; }

TrimNearest trim_chain_nearest(const TrimChain *c, Vec2 p, double limit)
{
    assert(!c->path.arc);
    TrimNearest best = { limit, -1, p };
    int i = trim_chain_next(c, around(p, limit), 0);
    while (i >= 0) {
        Vec2 q = trim_piece_nearest(c->path.p[i], c->path.p[i + 1], p);
        double d = vec2_length(vec2_sub(p, q));
        if (d < best.distance) best = (TrimNearest){ d, i, q };
        i = trim_chain_next(c, around(p, best.distance), i + 1);
    }
    return best;
}
