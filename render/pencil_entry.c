/* Where rays of a pencil enter a tree: each alone, or those of a bunch together. Why nothing is missed: pencil.c. */
#include "render/hash.h"
#include "render/pencil_cells.h"
#include "render/simd.h"

/* What is shorter has no quotients. */
#define LEAST_WAY 0x1p-900

/* Does the ray, which does not begin there, pass the apex within delta, and end no more than delta beyond it? from: its
 * origin, as seen from the apex. The distance that the cross product says is rounded by 8 u |from| at most, and so is where
 * the ray is nearest to the apex; from as near as FAR times S that is less than delta / 2. (And none of the squares may
 * over- or underflow.) */
#define FAR 0x1p8
ALWAYS_INLINE bool goes_to_apex(const Pencil *p, const Ray *r, double t_max, Vec3 from)
{
    double delta = p->delta, length2 = vec_length2(r->dir), most = 0.25 * delta * delta * length2;
    double distance = vec_max_abs(from);
    bool is_near = vec_length2(vec_cross(from, r->dir)) <= most && most > 0x1p-900 && most < 0x1p900;
    bool ends = t_max * length2 <= 0.25 * delta * vec_max_abs(r->dir) - vec_dot(from, r->dir);
    return is_near && ends && r->t_min >= 0 && distance > LEAST_WAY && distance <= FAR / DELTA * delta;
}

/* The direction of the ray's points from the apex; false: it is none of the pencil. */
ALWAYS_INLINE bool find_way(const Pencil *p, const Ray *r, double t_max, Vec3 *way)
{
    Vec3 from = vec_sub(r->origin, p->apex);
    bool is_from_apex = from.x == 0 && from.y == 0 && from.z == 0;
    *way = is_from_apex ? r->dir : from;
    return is_from_apex ? r->t_min >= 0 && vec_max_abs(r->dir) > LEAST_WAY : goes_to_apex(p, r, t_max, from);
}

/* Lights and trees seldom differ in less than two coordinates and an address. */
static uint64_t hash_of(const WideBvh *tree, Vec3 apex)
{
    uint64_t bits = hash_bits(apex.x) ^ hash_bits(apex.y) << 1 ^ hash_bits(apex.z) << 2;
    return ((uintptr_t)tree >> 6 ^ bits) * 0x9E3779B97F4A7C15u;
}

ALWAYS_INLINE PencilSlot *use_slot(const WideBvh *tree, Trace *t)
{
    Vec3 apex = apex_at(t->apex);
    uint64_t hash = hash_of(tree, apex);
    PencilSlot *s = &t->pencils->of[hash >> 58];
    _Static_assert(N_PENCIL_SLOTS == 1 << (64 - 58), "a slot for each number");
    if (s->tree != tree || !vec_is_same(s->apex, apex))
        *s = (PencilSlot){ .tree = tree, .apex = apex, .pencil = pencil_find(t->pencils->all, hash, tree, t->apex),
                           .place = UINT64_MAX, .mask = UINT64_MAX };
    return s;
}

ALWAYS_INLINE const WideNode *entry_at(PencilSlot *slot, int face, int x, int y)
{
    bool is_of_last_cell = ((place_of(face, x, y) ^ slot->place) & slot->mask) == 0;
    return is_of_last_cell ? slot->entry : pencil_find_cell(slot, face, x, y);
}

/* The largest coordinate says the face, the two others over it the place. (Of numbers that are none, nowhere.) */
ALWAYS_INLINE const WideNode *entry_towards(PencilSlot *slot, Vec3 way)
{
    const double w[5] = { way.x, way.y, way.z, way.x, way.y };
    double x = fabs(way.x), y = fabs(way.y), z = fabs(way.z);
    int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2, face = 2 * axis + (w[axis] < 0);
    const Face *f = &slot->pencil->faces[face];
    double scale = f->scale / fabs(w[axis]);
    double at_x = w[axis + 1] * scale - f->origin[0], at_y = w[axis + 2] * scale - f->origin[1];
    if (!(at_x >= 0 && at_x < PLACES && at_y >= 0 && at_y < PLACES)) return NULL;
    return entry_at(slot, face, (int)at_x, (int)at_y);
}

EVERY_X86
const WideNode *pencil_entry(const WideBvh *tree, const Ray *r, double t_max, Trace *t)
{
    PencilSlot *slot = use_slot(tree, t);
    Vec3 way;
    return find_way(slot->pencil, r, t_max, &way) ? entry_towards(slot, way) : &tree->nodes[0];
}

/* ---- bunches: the same operations, to the last bit ---- */

typedef int V8i __attribute__((vector_size(32)));

ALWAYS_INLINE Vec3x8 select_vectors(V8l truth, const Vec3x8 *a, const Vec3x8 *b)
{
    return (Vec3x8){ v8d_select(truth, a->x, b->x), v8d_select(truth, a->y, b->y), v8d_select(truth, a->z, b->z) };
}

/* As goes_to_apex. */
ALWAYS_INLINE Lanes go_to_apex(const Pencil *p, const RayBunch *b, V8d t_max, Vec3x8 from)
{
    double delta = p->delta;
    Vec3x8 cross = { from.y * b->dir.z - from.z * b->dir.y, from.z * b->dir.x - from.x * b->dir.z,
                     from.x * b->dir.y - from.y * b->dir.x };
    V8d length2 = vec8_dot(b->dir, b->dir), most = 0.25 * delta * delta * length2, distance = vec8_max_abs(from);
    V8l is_near = v8d_at_most(vec8_dot(cross, cross), most) & v8d_less(v8d_splat(0x1p-900), most)
                & v8d_less(most, v8d_splat(0x1p900));
    V8l ends = v8d_at_most(t_max * length2, 0.25 * delta * vec8_max_abs(b->dir) - vec8_dot(from, b->dir));
    V8l begins = v8d_at_most(v8d_splat(0), b->t_min) & v8d_less(v8d_splat(LEAST_WAY), distance);
    return v8l_mask(is_near & ends & begins & v8d_at_most(distance, v8d_splat(FAR / DELTA * delta)));
}

/* As find_way: which of the rays are of the pencil, and their directions from the apex. */
ALWAYS_INLINE Lanes find_ways(const Pencil *p, const RayBunch *b, V8d t_max, Vec3x8 *way)
{
    Vec3x8 from = vec8_sub(b->origin, vec8_splat(p->apex));
    Lanes are_elsewhere = v8l_mask(v8d_differs(from.x, v8d_splat(0)) | v8d_differs(from.y, v8d_splat(0))
                                   | v8d_differs(from.z, v8d_splat(0)));
    V8l leave = v8d_at_most(v8d_splat(0), b->t_min) & v8d_less(v8d_splat(LEAST_WAY), vec8_max_abs(b->dir));
    Lanes of_it = v8l_mask(leave) & ~are_elsewhere;
    *way = b->dir;
    if (!are_elsewhere) return of_it;
    *way = select_vectors(v8l_truth(are_elsewhere), &from, &b->dir);
    return of_it | (go_to_apex(p, b, t_max, from) & are_elsewhere);
}

/* Adds rays to those that enter by the same node; the number of nodes then. NULL: they meet nothing. */
static inline int add_entry(PencilEntry out[], int n, const WideNode *node, Lanes lanes)
{
    int k = 0;
    if (!node) return n;
    while (k < n && out[k].node != node) k++;
    if (k == n) out[n++] = (PencilEntry){ node, 0 };
    out[k].lanes |= lanes;
    return n;
}

/* Rays through one face; w is along its axis, x and y along the next two. As entry_towards. */
ALWAYS_INLINE int enter_face(PencilSlot *slot, int face, Lanes lanes, V8d w, V8d x, V8d y, PencilEntry out[], int n)
{
    const Face *f = &slot->pencil->faces[face];
    V8d zero = v8d_splat(0), end = v8d_splat(PLACES), scale = f->scale / v8d_abs(w);
    V8d at_x = x * scale - f->origin[0], at_y = y * scale - f->origin[1];
    V8l is_within = v8d_at_most(zero, at_x) & v8d_less(at_x, end) & v8d_at_most(zero, at_y) & v8d_less(at_y, end);
    V8i place_x = __builtin_convertvector(v8d_select(is_within, at_x, zero), V8i);
    V8i place_y = __builtin_convertvector(v8d_select(is_within, at_y, zero), V8i);
    V8l places = __builtin_convertvector(place_x << 16 | place_y, V8l);
    lanes &= v8l_mask(is_within);
    while (lanes) {
        int i = __builtin_ctz(lanes);
        const WideNode *entry = entry_at(slot, face, place_x[i], place_y[i]);
        long long mask = (long long)(slot->mask & 0xFFFFFFFFu);      /* of the cell, within the face */
        Lanes together = lanes & v8l_mask(v8l_equals(places & mask, places[i] & mask));
        n = add_entry(out, n, entry, together);
        lanes &= ~together;
    }
    return n;
}

/* The faces that rays go through, one after the other: as entry_towards. */
ALWAYS_INLINE int enter_faces(PencilSlot *slot, Lanes lanes, const Vec3x8 *way, PencilEntry out[], int n)
{
    const V8d w[5] = { way->x, way->y, way->z, way->x, way->y };
    V8d x = v8d_abs(way->x), y = v8d_abs(way->y), z = v8d_abs(way->z);
    Lanes of_axis[3] = { v8l_mask(v8d_at_most(y, x) & v8d_at_most(z, x)), v8l_mask(v8d_at_most(z, y)), ~0u };
    of_axis[1] &= ~of_axis[0], of_axis[2] &= ~(of_axis[0] | of_axis[1]);
    while (lanes) {
        int i = __builtin_ctz(lanes), axis = of_axis[0] >> i & 1 ? 0 : of_axis[1] >> i & 1 ? 1 : 2;
        Lanes negative = v8l_mask(v8d_less(w[axis], v8d_splat(0))), is_negative = negative >> i & 1;
        Lanes together = lanes & of_axis[axis] & (is_negative ? negative : ~negative);
        n = enter_face(slot, 2 * axis + (int)is_negative, together, w[axis], w[axis + 1], w[axis + 2], out, n);
        lanes &= ~together;
    }
    return n;
}

EVERY_X86
int pencil_entries(const WideBvh *tree, const RayBunch *b, Lanes lanes, const double t_max[], Trace *t,
                   PencilEntry out[BUNCH_WIDTH])
{
    PencilSlot *slot = use_slot(tree, t);
    Vec3x8 way;
    Lanes of_it = lanes & find_ways(slot->pencil, b, v8d_load_doubles(t_max), &way);
    int n = of_it == lanes ? 0 : add_entry(out, 0, &tree->nodes[0], lanes & ~of_it);
    return enter_faces(slot, of_it, &way, out, n);
}
