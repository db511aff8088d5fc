/* Entry points for rays through a common point: the light buffer ([HG86]), by which a shadow ray finds what may block it
 * from its direction alone, joined with entry points into a tree ([RSH05]): a cell of directions holds the nodes and items
 * that its pyramid meets, and the traversal begins with them in place of the root.
 *
 * Directions from the apex are seen on the six faces of a cube about it. Of each face there is a window, as large as the
 * tree is seen through it, and a quadtree of cells in that, made as rays fall into them. A cell's entry (pyramid.c) is made
 * of the entry of the cell around it. A cell is quartered as long as there are nodes among its children, and enough rays are
 * to be expected: so memory stays in proportion to the pixels, a node's 256 bytes for RAYS_IN_CELL of them. What a ray sees
 * and counts depends on the tree and the apex alone, not on the rays before it or on who made the cell.
 *
 * Nothing that a ray meets is missed. Let S be the sum of the largest coordinates of apex and tree, u = 2^-53, and
 * delta = 2^-40 S.
 * 1. The ray begins at the apex; or its line passes within delta of it, which is computed here (pencil_entry.c), and the
 *    ray ends no more than delta beyond the place nearest to it. Then each of its points is within 2 delta of the line from
 *    the apex to its origin: the whole segment is, since both of its ends are within delta, and what is beyond is within
 *    2 delta of the apex.
 * 2. Where the ray is in the tree that line is no more than 4 S long. Its direction is rounded by u (a difference), its
 *    place on the face by 5 u (two quotients, a difference, and their product), a cell's sides by 4 u: less than 16 u of the
 *    depth, 64 u S, are what a point may be outside of its cell's pyramid.
 * 3. So the function that says on which side of a plane of the pyramid a point is, a - a1 z, is wrong by less than 2 sqrt 2
 *    delta + 64 u S, and by 8 u S for what pyramid.c rounds: 4 delta are enough. The window is that of the tree's bounds as
 *    much wider, and its own roundings are covered by WINDOW_ROUNDING. */
#include "render/pencil_cells.h"

#include "render/pyramid.h"

#include <pthread.h>

#define SLACK 4
#define WINDOW_ROUNDING 0x1p-48

/* Rays that are to be expected in a cell, at least. To make one takes as long as some thirty steps through a node, the first
 * rays to come there wait for it from memory, and neighbours that go together part where it ends: with a quarter as many,
 * pictures take 2 % longer; with many more they are as fast. */
#define RAYS_IN_CELL 512

static Cell not_made;

struct Pencils {
    Viewpoint camera;
    Arena *arena;
    pthread_mutex_t lock;            /* held for microseconds, where something is made */
    uint64_t n_buckets;              /* a power of two */
    _Atomic(Pencil *) *buckets;
};

/* ---- all pencils ---- */

/* More trees than that do not have more than one cell each, since they are not seen by so many rays. */
#define MOST_BUCKETS ((uint64_t)1 << 24)
static uint64_t bucket_count(double n_rays)
{
    uint64_t n = N_PENCIL_SLOTS;
    while ((double)n < n_rays / RAYS_IN_CELL && n < MOST_BUCKETS) n *= 2;
    return n;
}

Pencils *pencils_new(Viewpoint camera)
{
    Arena *a = arena_new();
    Pencils *p = ARENA_NEW(a, Pencils);
    p->arena = a;
    p->camera = camera;
    p->n_buckets = bucket_count(camera.density);
    p->buckets = arena_zalloc(a, p->n_buckets, sizeof *p->buckets);
    pthread_mutex_init(&p->lock, NULL);
    return p;
}

void pencils_free(Pencils *p)
{
    if (!p) return;
    pthread_mutex_destroy(&p->lock);
    arena_free(p->arena);
}

static const Pencil *find(const Pencils *p, uint64_t hash, const WideBvh *tree, Vec3 apex)
{
    const Pencil *at = atomic_load_explicit(&p->buckets[hash >> 20 & (p->n_buckets - 1)], memory_order_acquire);
    while (at && !(at->tree == tree && vec_is_same(at->apex, apex))) at = at->older;
    return at;
}

/* ---- windows ---- */

typedef struct { double lo, hi; } Range;

static Range along(const WideBvh *tree, int axis, double from, double slack)
{
    return (Range){ tree->bounds.lo[axis] - from - slack, tree->bounds.hi[axis] - from + slack };
}

/* What x / z may be, as far as it is within a face. */
static Range projected(Range x, Range z)
{
    if (!(z.lo > 0)) return (Range){ -1, 1 };
    double lo = x.lo / (x.lo > 0 ? z.hi : z.lo), hi = x.hi / (x.hi > 0 ? z.lo : z.hi);
    return (Range){ double_max(lo - WINDOW_ROUNDING * fabs(lo), -1), double_min(hi + WINDOW_ROUNDING * fabs(hi), 1) };
}

static void set_window(const Pencil *p, int face, Face *f)
{
    const double apex[3] = { p->apex.x, p->apex.y, p->apex.z };
    int axis = face / 2;
    double slack = SLACK * p->delta;
    Range z = along(p->tree, axis, apex[axis], slack);
    if (face % 2) z = (Range){ -z.hi, -z.lo };
    f->scale = 0, f->origin[0] = f->origin[1] = 1;
    atomic_init(&f->cell.parts, &not_made);
    if (!(z.hi >= 0)) return;
    double side = WINDOW_ROUNDING;
    for (int k = 0; k < 2; k++) {
        int other = (axis + 1 + k) % 3;
        Range x = projected(along(p->tree, other, apex[other], slack), z);
        if (!(x.lo <= x.hi)) return;
        f->lo[k] = x.lo - WINDOW_ROUNDING;
        side = double_max(side, x.hi - x.lo + 4 * WINDOW_ROUNDING);
    }
    f->side = side;
    f->scale = PLACES / side;
    for (int k = 0; k < 2; k++) f->origin[k] = f->lo[k] * f->scale;
}

/* ---- how many rays are to be expected ---- */

static Vec3 camera_within(const Apex *apex, Vec3 camera)
{
    return apex->outside ? xform_unpoint(apex->placement, camera_within(apex->outside, camera)) : camera;
}

/* As many rays go to a light from what the camera sees of the tree as go there from the camera. */
static double density_of(const WideBvh *tree, const Apex *apex, Viewpoint camera)
{
    Vec3 centre = box_centre(tree->bounds);
    double least = 0.5 * tree->diagonal;
    double to_apex = double_max(vec_length(vec_sub(apex->at, centre)), least);
    double to_camera = double_max(vec_length(vec_sub(camera_within(apex, camera.at), centre)), least);
    double nearer = to_apex / to_camera;
    return camera.density * nearer * nearer;
}

static Pencil *pencil_new(Pencils *all, const WideBvh *tree, const Apex *apex)
{
    Pencil *p = ARENA_NEW(all->arena, Pencil);
    p->tree = tree;
    p->apex = apex->at;
    p->all = all;
    p->delta = DELTA * (vec_max_abs(apex->at) + tree->largest);
    p->density = density_of(tree, apex, all->camera);
    for (int i = 0; i < 6; i++) set_window(p, i, &p->faces[i]);
    return p;
}

const Pencil *pencil_find(Pencils *all, uint64_t hash, const WideBvh *tree, const Apex *apex)
{
    const Pencil *found = find(all, hash, tree, apex->at);
    if (found) return found;
    _Atomic(Pencil *) *bucket = &all->buckets[hash >> 20 & (all->n_buckets - 1)];
    pthread_mutex_lock(&all->lock);
    found = find(all, hash, tree, apex->at);
    if (!found) {
        Pencil *p = pencil_new(all, tree, apex);
        p->older = atomic_load_explicit(bucket, memory_order_relaxed);
        atomic_store_explicit(bucket, p, memory_order_release);
        found = p;
    }
    pthread_mutex_unlock(&all->lock);
    return found;
}

/* ---- cells ---- */

/* Where a cell is: the cell of a place in the window after so many halvings. */
typedef struct { int face, level, x, y; } Square;

static int part_at(int bit, int x, int y) { return (x >> bit & 1) | (y >> bit & 1) << 1; }

static Pyramid pyramid_of(const Pencil *p, Square s)
{
    const Face *f = &p->faces[s.face];
    Pyramid out = { .apex = p->apex, .axis = s.face / 2, .is_negative = s.face % 2, .slack = SLACK * p->delta };
    double size = ldexp(f->side, -s.level);
    const int at[2] = { s.x >> (PLACE_BITS - s.level), s.y >> (PLACE_BITS - s.level) };
    for (int k = 0; k < 2; k++) out.lo[k] = f->lo[k] + at[k] * size, out.hi[k] = f->lo[k] + (at[k] + 1) * size;
    return out;
}

static bool is_worth_quartering(const Pencil *p, Square s)
{
    double side = ldexp(p->faces[s.face].side, -s.level);
    return s.level < PLACE_BITS && p->density * side * side >= 4 * RAYS_IN_CELL;
}

static bool is_same_entry(const WideNode *a, const WideNode *b)
{
    bool is = a->n_children == b->n_children;
    for (uint32_t i = 0; is && i < a->n_children; i++) is = a->child[i] == b->child[i];
    return is;
}

/* The entry of a cell within another, whose entry is `around`. */
static const WideNode *kept_entry(Arena *a, const WideNode *around, const WideNode *entry)
{
    if (entry->n_children == 0) return NULL;
    return is_same_entry(around, entry) ? around : arena_copy(a, entry, 1, sizeof *entry);
}

static void make_cell(const Pencil *p, Square s, const WideNode *around, Cell *c)
{
    Pyramid pyramid = pyramid_of(p, s);
    WideNode entry;
    Cell *parts = NULL;
    bool has_nodes = pyramid_entry(&pyramid, p->tree->nodes, around, &entry);
    c->entry = kept_entry(p->all->arena, around, &entry);
    if (has_nodes && is_worth_quartering(p, s)) {
        parts = ARENA_ARRAY(p->all->arena, Cell, 4);
        for (int i = 0; i < 4; i++) atomic_init(&parts[i].parts, &not_made);
    }
    atomic_store_explicit(&c->parts, parts, memory_order_release);
}

/* Makes what is not yet made of the way down to the cell of a place. */
static void make_way(const Pencil *p, int face, int x, int y)
{
    Cell *c = (Cell *)&p->faces[face].cell, *parts;       /* what changes in a cell is atomic, or changed once, here */
    const WideNode *around = &p->tree->nodes[0];
    pthread_mutex_lock(&p->all->lock);
    for (int level = 0; ; level++) {
        if (atomic_load_explicit(&c->parts, memory_order_relaxed) == &not_made)
            make_cell(p, (Square){ face, level, x, y }, around, c);
        parts = atomic_load_explicit(&c->parts, memory_order_relaxed);
        if (!parts) break;
        around = c->entry;
        c = &parts[part_at(PLACE_BITS - 1 - level, x, y)];
    }
    pthread_mutex_unlock(&p->all->lock);
}

/* What places in one cell after so many halvings have in common. */
static uint64_t mask_of(int level)
{
    uint64_t m = (0xFFFFu << (PLACE_BITS - level)) & 0xFFFFu;
    return (uint64_t)7 << 32 | m << 16 | m;
}

/* Walks down to the cell of a place, and remembers it. */
const WideNode *pencil_find_cell(PencilSlot *slot, int face, int x, int y)
{
    const Pencil *p = slot->pencil;
    const Cell *c = &p->faces[face].cell, *parts;
    int bit = PLACE_BITS;
    while ((parts = atomic_load_explicit(&c->parts, memory_order_acquire)) != NULL) {
        if (parts == &not_made) {
            make_way(p, face, x, y);
            continue;
        }
        c = &parts[part_at(--bit, x, y)];
    }
    slot->place = place_of(face, x, y);
    slot->mask = mask_of(PLACE_BITS - bit);
    return slot->entry = c->entry;
}
