/* Boxes against a pyramid, eight at a time. In double precision, since an apex may be far off: a light as distant as the sun
 * sees a teapot as one point in single precision.
 *
 * A box misses the pyramid if one of its five planes has all of the box on its far side. With the depth z and the sides'
 * a and b about the apex, a - a1 z is least at the box's least a and, as a1 is positive or not, its largest or least z. The
 * coordinates about the apex are rounded once, by 2^-53 of the largest, and so are product and sum: eight roundings of
 * that size are less than the caller's slack (pencil.c). */
#include "render/pyramid.h"

#include "render/simd.h"

#define WIDTH WIDE_WIDTH

/* An entry in the making. */
typedef struct {
    WideNode *node;
    double area[WIDTH];      /* of children that are nodes and may be opened; 0: no others */
    bool has_nodes;          /* that found no room */
} Draft;

ALWAYS_INLINE V8d column(const WideNode *n, int side, int axis) { return v8d_load(n->side[side][axis]); }

/* lo and hi by which the coordinate along an axis is more than the apex's, or less. */
typedef struct { V8d lo, hi; } Extent;

ALWAYS_INLINE Extent extent_of(const WideNode *n, int axis, double from, bool is_negative)
{
    V8d lo = column(n, 0, axis), hi = column(n, 1, axis);
    return is_negative ? (Extent){ from - hi, from - lo } : (Extent){ lo - from, hi - from };
}

/* Which children of n meet the pyramid: a bit for each. */
EVERY_X86
static unsigned children_within(const Pyramid *p, const WideNode *n)
{
    const double apex[3] = { p->apex.x, p->apex.y, p->apex.z };
    Extent z = extent_of(n, p->axis, apex[p->axis], p->is_negative);
    V8l meets = z.hi >= -p->slack;
    for (int k = 0; k < 2; k++) {
        int axis = (p->axis + 1 + k) % 3;
        Extent x = extent_of(n, axis, apex[axis], false);
        meets &= x.lo - p->hi[k] * (p->hi[k] >= 0 ? z.hi : z.lo) <= p->slack;
        meets &= x.hi - p->lo[k] * (p->lo[k] >= 0 ? z.lo : z.hi) >= -p->slack;
    }
    return v8_mask(__builtin_convertvector(meets, V8c)) & n->exists;
}

static double area_of(const WideNode *n, int i)
{
    Box b;
    for (int k = 0; k < 3; k++) b.lo[k] = n->side[0][k][i], b.hi[k] = n->side[1][k][i];
    return box_area(b);
}

static void copy_child(WideNode *to, uint32_t at, const WideNode *from, int i)
{
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < 3; k++) to->side[s][k][at] = from->side[s][k][i];
    to->child[at] = from->child[i];
}

static void add_children(Draft *d, const WideNode *from, unsigned which)
{
    for (; which != 0; which &= which - 1) {
        int i = __builtin_ctz(which);
        uint32_t at = d->node->n_children++;
        copy_child(d->node, at, from, i);
        d->area[at] = from->child[i] & WIDE_IS_ITEM ? 0 : area_of(from, i);
    }
}

/* The last child takes its place. */
static void remove_child(Draft *d, uint32_t at)
{
    uint32_t last = --d->node->n_children;
    copy_child(d->node, at, d->node, (int)last);
    d->area[at] = d->area[last];
}

/* The one with the largest box; false: none may be opened. */
static bool find_largest(const Draft *d, uint32_t *at)
{
    double most = 0;
    for (uint32_t i = 0; i < d->node->n_children; i++)
        if (d->area[i] > most) most = d->area[i], *at = i;
    return most > 0;
}

static void open_children(Draft *d, const Pyramid *p, const WideNode *tree)
{
    uint32_t at = 0;
    while (find_largest(d, &at)) {
        const WideNode *n = &tree[d->node->child[at]];
        unsigned within = children_within(p, n);
        if (d->node->n_children - 1 + (uint32_t)__builtin_popcount(within) <= WIDTH) {
            remove_child(d, at);
            add_children(d, n, within);
        } else {
            d->area[at] = 0;
            d->has_nodes = true;
        }
    }
}

static void clear_rest(WideNode *n)
{
    for (uint32_t i = n->n_children; i < WIDTH; i++) {
        for (int k = 0; k < 3; k++) n->side[0][k][i] = INFINITY, n->side[1][k][i] = -INFINITY;
        n->child[i] = 0;
    }
    n->exists = (1u << n->n_children) - 1;
}

bool pyramid_entry(const Pyramid *p, const WideNode *tree, const WideNode *from, WideNode *entry)
{
    Draft d = { .node = entry };
    entry->n_children = 0;
    entry->items = 0, entry->behind = NULL;      /* its items are of many nodes */
    add_children(&d, from, children_within(p, from));
    open_children(&d, p, tree);
    clear_rest(entry);
    return d.has_nodes;
}
