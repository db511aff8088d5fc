/* Flattening: Bézier curves are halved until their control points lie on the chord. See trim_flat.h. */
#include "nurbs/trim_flat.h"

#include "nurbs/bezier.h"

/* Halving a parameter more often than a double has bits yields nothing new. */
#define MAX_HALVINGS 52

void trim_points_add(Arena *a, TrimPoints *list, Vec2 p)
{
    ARENA_PUSH(a, list->p, list->n, list->capacity) = p;
}

static Vec2 project(Vec4 p) { return vec2(p.x / p.w, p.y / p.w); }

static bool is_flat(int k, const Vec4 p[], double chord)
{
    Vec2 a = project(p[0]), b = project(p[k - 1]);
    double worst = 0;
    for (int i = 1; i < k - 1; i++) {
        Vec2 q = project(p[i]);
        worst = fmax(worst, vec2_length(vec2_sub(q, trim_piece_nearest(a, b, q))));
    }
    return worst <= chord;
}

static void flatten(Arena *a, int k, Vec4 p[], double chord, int halvings, TrimPoints *out)
{
    if (halvings < MAX_HALVINGS && !is_flat(k, p, chord)) {
        Vec4 left[NURBS_MAX_ORDER];
        bezier_cut(k, 1, .5, p, left);
        flatten(a, k, left, chord, halvings + 1, out);
        flatten(a, k, p, chord, halvings + 1, out);
    } else {
        trim_points_add(a, out, project(p[k - 1]));
    }
}

void trim_flatten(Arena *a, int k, Vec4 p[], double chord, TrimPoints *out) { flatten(a, k, p, chord, 0, out); }

/* Points that differ from the one before them; the last one is `end`. */
static void add_distinct(Arena *a, TrimPoints *to, const TrimPoints *arc, Vec2 end)
{
    for (size_t i = 0; i < arc->n; i++) {
        Vec2 p = i + 1 < arc->n ? arc->p[i] : end, last = to->p[to->n - 1];
        if (p.x != last.x || p.y != last.y) trim_points_add(a, to, p);
    }
}

TrimChain trim_chain_flatten(Arena *a, const TrimChain *c, double chord)
{
    TrimPoints all = { 0 };
    trim_points_add(a, &all, c->path.p[0]);
    for (int i = 0; i < c->path.n; i++) {
        Vec2 end = c->path.p[i + 1];
        TrimPoints arc = { &end, 1, 1 };
        if (!trim_is_straight(&c->path, i)) {
            Vec4 p[NURBS_MAX_ORDER];
            trim_arc_control(&c->path.arc[i], p);
            arc = (TrimPoints){ 0 };
            trim_flatten(a, c->path.arc[i].segment->k, p, chord, &arc);
        }
        add_distinct(a, &all, &arc, end);
    }
    return trim_chain_make(a, &(TrimPath){ .n = (int)all.n - 1, .p = all.p });
}
