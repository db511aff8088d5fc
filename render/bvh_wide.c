/* Eight boxes a node in single precision, [WBB08]; collapsed from the binary tree by opening the child of the largest
 * area until there are eight.
 *
 * Nothing that the ray meets in exact arithmetic is turned away. The ray is moved to where it enters the tree, and scaled so
 * that its largest component is 1, both in double precision: its origin o is then as large as the tree's coordinates M. A
 * plane x is met at t = x/d - o/d, computed in single precision as x*inverse + shift: two roundings of the first term, two
 * of the second, one of the sum, each within 2^-24 of (M + |o|)/|d|; twice the sum, 2^-21 of that, is added to the far side
 * and taken from the near side through `shift`. What moving the origin rounds, 2^-52 of the distances in the ray's own
 * units, is added to it. Components under 2^-60 count as that: the slab is then met earlier and left later than any t in the
 * tree. */
#include "render/bvh_wide.h"

#include "render/simd.h"

#include <string.h>

#define WIDTH 8
#define IS_ITEM 0x80000000u
#define STACK_SIZE (64 * (WIDTH - 1) + WIDTH)     /* no deeper than the binary tree: 64 */
#define TINY 0x1p-60

typedef struct {
    float side[2][3][WIDTH];       /* lo and hi by axis; children that do not exist: lo +inf, hi -inf */
    uint32_t child[WIDTH];         /* a node, or IS_ITEM and an item */
    uint32_t n_children;
} WideNode;

struct WideBvh {
    const WideNode *nodes;
    uint32_t n_nodes;
    Box bounds;
    double largest, diagonal;      /* the largest coordinate of the bounds, and their diagonal */
};

/* ---- collapsing ---- */

typedef struct {
    const BvhNode *nodes;
    const uint32_t *items;
    Arena *arena;                  /* of the list alone */
    WideNode *wide;
    size_t n_wide, capacity;
} Collapse;

/* The binary nodes that become the children of one wide node. */
static uint32_t open_children(const Collapse *c, uint32_t from, uint32_t list[WIDTH])
{
    uint32_t n = 1;
    list[0] = from;
    while (n < WIDTH) {
        uint32_t best = n;
        double most = -1;
        for (uint32_t i = 0; i < n; i++) {
            const BvhNode *node = &c->nodes[list[i]];
            double area = node->n_items ? -1 : box_area(node->box);
            if (area > most) most = area, best = i;
        }
        if (best == n) break;      /* items all */
        uint32_t first = c->nodes[list[best]].first;
        list[best] = first, list[n++] = first + 1;
    }
    return n;
}

static void set_child(WideNode *w, uint32_t i, Box b)
{
    for (int k = 0; k < 3; k++) w->side[0][k][i] = b.lo[k], w->side[1][k][i] = b.hi[k];
}

static uint32_t collapse(Collapse *c, uint32_t from)
{
    uint32_t list[WIDTH], n = open_children(c, from, list), at = (uint32_t)c->n_wide;
    WideNode w = { .n_children = n };
    for (uint32_t i = 0; i < WIDTH; i++) set_child(&w, i, i < n ? c->nodes[list[i]].box : box_empty());
    ARENA_PUSH(c->arena, c->wide, c->n_wide, c->capacity) = w;
    for (uint32_t i = 0; i < n; i++) {
        const BvhNode *node = &c->nodes[list[i]];
        uint32_t child = node->n_items ? IS_ITEM | (c->items ? c->items[node->first] : node->first) : collapse(c, list[i]);
        c->wide[at].child[i] = child;
    }
    return at;
}

WideBvh *bvh_wide_build(Arena *a, const BvhNode *nodes, const uint32_t *items)
{
    Collapse c = { .nodes = nodes, .items = items, .arena = arena_new() };
    collapse(&c, 0);
    WideBvh *w = ARENA_NEW(a, WideBvh);
    *w = (WideBvh){ .nodes = arena_copy(a, c.wide, c.n_wide, sizeof *c.wide), .n_nodes = (uint32_t)c.n_wide,
                    .bounds = nodes[0].box, .diagonal = box_diagonal(nodes[0].box) };
    for (int k = 0; k < 3; k++)
        w->largest = double_max(w->largest, double_max(fabs(w->bounds.lo[k]), fabs(w->bounds.hi[k])));
    arena_free(c.arena);
    return w;
}

uint32_t bvh_wide_node_count(const WideBvh *w) { return w->n_nodes; }

/* ---- traversal ---- */

typedef struct {
    float inverse[3], near_shift[3], far_shift[3];
    int near_side[3];              /* which side of a box the ray meets first */
    double start, scale;           /* its own t = (t of the caller - start) * scale */
} WideRay;

/* Fills t->slabs for the ray's direction, unless it is there from the tree before. */
static void use_slabs(const Ray *r, Trace *t)
{
    Vec3 a = r->dir, b = t->slabs.dir;
    if (a.x == b.x && a.y == b.y && a.z == b.z && t->slabs.scale > 0) return;
    t->slabs.dir = a, t->slabs.scale = vec_max_abs(a);
    const double d[3] = { a.x, a.y, a.z };
    for (int k = 0; k < 3; k++) {
        double x = d[k] / t->slabs.scale;
        t->slabs.inverse[k] = 1 / (fabs(x) >= TINY ? x : copysign(TINY, d[k]));
    }
}

static inline void prepare_axis(WideRay *w, int k, double o, double inverse, double largest, double rounding,
                                double diagonal)
{
    double slack = fabs(inverse) * ((fabs(o) + largest) * 0x1p-21 + rounding);
    if (fabs(inverse) >= 1 / TINY) slack += 4 * diagonal;
    w->inverse[k] = (float)inverse;
    w->near_shift[k] = float_down(-o * inverse - slack);
    w->far_shift[k] = float_up(-o * inverse + slack);
    w->near_side[k] = signbit(inverse) != 0;
}

/* Where the ray enters the tree; false: it does not, before t_max. An origin that is no farther away than NEAR times the
 * tree's coordinates stays where it is: the boxes then swell by NEAR 2^-21 of those. */
#define NEAR 16

static bool find_start(const WideBvh *b, const Ray *r, double t_max, double *start)
{
    *start = r->t_min;
    if (vec_max_abs(r->origin) <= NEAR * b->largest && fabs(r->t_min) <= NEAR * b->largest) return true;
    BoxRay box = box_ray(r->origin, r->dir);
    return box_hit(&b->bounds, &box, r->t_min, t_max, start);
}

/* false: the ray does not meet the tree's bounds before t_max. */
static inline bool prepare(const WideBvh *b, const Ray *r, double t_max, Trace *t, WideRay *w)
{
    if (!find_start(b, r, t_max, &w->start)) return false;
    use_slabs(r, t);
    w->scale = t->slabs.scale;
    if (!isfinite(w->start)) w->start = r->t_min;
    Vec3 o = ray_at(r, w->start);
    double far = fabs(w->start) * w->scale;
    prepare_axis(w, 0, o.x, t->slabs.inverse[0], b->largest, 0x1p-52 * (fabs(r->origin.x) + far), b->diagonal);
    prepare_axis(w, 1, o.y, t->slabs.inverse[1], b->largest, 0x1p-52 * (fabs(r->origin.y) + far), b->diagonal);
    prepare_axis(w, 2, o.z, t->slabs.inverse[2], b->largest, 0x1p-52 * (fabs(r->origin.z) + far), b->diagonal);
    return true;
}

typedef struct { uint32_t child; float t; } Waiting;

static inline float float_min(float a, float b) { return a < b ? a : b; }
static inline float float_max(float a, float b) { return a > b ? a : b; }

/* Children of n that the ray meets in [t_min, t_max], the nearest last. */
static inline int meet_children(const WideNode *n, const WideRay *r, float t_min, float t_max, Waiting *out)
{
    float t_near[WIDTH], t_far[WIDTH];
    const float *x0 = n->side[r->near_side[0]][0], *x1 = n->side[!r->near_side[0]][0];
    const float *y0 = n->side[r->near_side[1]][1], *y1 = n->side[!r->near_side[1]][1];
    const float *z0 = n->side[r->near_side[2]][2], *z1 = n->side[!r->near_side[2]][2];
    for (int i = 0; i < WIDTH; i++) {
        float x = x0[i] * r->inverse[0] + r->near_shift[0], y = y0[i] * r->inverse[1] + r->near_shift[1];
        float z = z0[i] * r->inverse[2] + r->near_shift[2];
        t_near[i] = float_max(float_max(x, y), float_max(z, t_min));
        x = x1[i] * r->inverse[0] + r->far_shift[0], y = y1[i] * r->inverse[1] + r->far_shift[1];
        z = z1[i] * r->inverse[2] + r->far_shift[2];
        t_far[i] = float_min(float_min(x, y), float_min(z, t_max));
    }
    int n_met = 0;
    for (uint32_t i = 0; i < n->n_children; i++) {    /* a ray of no numbers would meet those that do not exist */
        if (!(t_near[i] <= t_far[i])) continue;
        int at = n_met++;
        for (; at > 0 && out[at - 1].t < t_near[i]; at--) out[at] = out[at - 1];
        out[at] = (Waiting){ n->child[i], t_near[i] };
    }
    return n_met;
}

EVERY_X86
bool bvh_wide_traverse(const WideBvh *b, const Ray *r, double *t_max, BvhVisit visit, void *context, Trace *t)
{
    WideRay w;
    uint64_t n_boxes = 1;
    bool ended = false;
    Waiting stack[STACK_SIZE];
    int top = 0;
    float limit = 0, t_min = 0;
    if (b->nodes[0].n_children == 1 && b->nodes[0].child[0] & IS_ITEM) {    /* one box needs no tree */
        BoxRay box = box_ray(r->origin, r->dir);
        double t_enter;
        ended = box_hit(&b->bounds, &box, r->t_min, *t_max, &t_enter)
             && visit(context, b->nodes[0].child[0] & ~IS_ITEM, r, t_max, t);
    } else if (prepare(b, r, *t_max, t, &w)) {
        stack[top++] = (Waiting){ 0, -INFINITY };
        limit = float_up((*t_max - w.start) * w.scale), t_min = float_down((r->t_min - w.start) * w.scale);
    }
    while (top > 0 && !ended) {
        Waiting next = stack[--top];
        if (next.t > limit) continue;            /* a hit has come nearer since */
        if (next.child & IS_ITEM) {
            ended = visit(context, next.child & ~IS_ITEM, r, t_max, t);
            limit = float_up((*t_max - w.start) * w.scale);
        } else {
            const WideNode *n = &b->nodes[next.child];
            n_boxes += n->n_children;
            top += meet_children(n, &w, t_min, limit, stack + top);
        }
    }
    *(t->is_shadow_ray ? &t->counters.light_bv_intersections : &t->counters.bv_intersections) += n_boxes;
    return ended;
}
