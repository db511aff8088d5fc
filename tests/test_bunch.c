/* Rays traced together find what each finds alone: the same hits to the last bit, since shapes do the same operations. */
#include "tests/test.h"

#include "render/bunch.h"
#include "render/bvh.h"
#include "render/hit_list.h"
#include "render/scene.h"

#include <string.h>

static Vec3 any_vector(TestRandom *r, double size)
{
    double x = test_range(r, -size, size), y = test_range(r, -size, size);
    return vec(x, y, test_range(r, -size, size));
}

/* ---- a shape that lends its tree: some spheres ---- */

enum { MOST_BALLS = 12 };

typedef struct { Shape *sphere; } Ball;

typedef struct {
    Shape shape;
    uint32_t n;
    Ball balls[MOST_BALLS];
    Box boxes[MOST_BALLS];
    Bvh *tree;
} Balls;

static Box balls_bounds(const Shape *s)
{
    const Balls *b = (const Balls *)s;
    Box box = box_empty();
    for (uint32_t i = 0; i < b->n; i++) box = box_union(box, b->boxes[i]);
    return box;
}

static void balls_prepare(Shape *s, Arena *own, Trace *t)
{
    Balls *b = (Balls *)s;
    (void)t;
    b->tree = bvh_build(own, b->boxes, b->n, BVH_SAH);
    bvh_set_items(b->tree, &(BvhItems){ b->balls, sizeof *b->balls, NULL, 0 });
}

static bool ball_hit(const void *at, uint32_t item, const Ray *r, Hit *best, Trace *t)
{
    (void)item;
    return shape_hit(((const Ball *)at)->sphere, r, best, t);
}

static bool ball_blocks(const void *at, uint32_t item, const Ray *r, double t_max, Trace *t)
{
    (void)item;
    return shape_blocks(((const Ball *)at)->sphere, r, t_max, t);
}

static bool balls_hit(const Shape *s, const Ray *r, Hit *best, Trace *t)
{
    const Balls *b = (const Balls *)s;
    bool is_hit = false;
    for (uint32_t i = 0; i < b->n; i++) is_hit |= ball_hit(&b->balls[i], i, r, best, t);
    return is_hit;
}

static const Bvh *balls_lend(Shape *s, Arena *own, Trace *t, const ShapeType **lender)
{
    *lender = s->type;
    shape_prepare_in(s, own, t);
    return ((Balls *)s)->tree;
}

static Lanes balls_hit_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    Lanes hit = 0;
    while (lanes) {
        const Ball *ball = items->at[items->is_one ? 0 : __builtin_ctz(lanes)];
        Lanes together = items->is_one ? lanes : lanes_together(items, &lanes);
        hit |= shape_hit_bunch(ball->sphere, b, together, best, t);
        lanes &= ~together;
    }
    return hit;
}

static Lanes balls_block_bunch(const BunchItems *items, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    Lanes blocked = 0;
    for (; lanes; lanes &= lanes - 1) {
        int i = __builtin_ctz(lanes);
        const Ball *ball = items->at[items->is_one ? 0 : i];
        blocked |= shape_blocks_bunch(ball->sphere, b, 1u << i, t_max, t);
    }
    return blocked;
}

/* Of two kinds: one knows bunches. */
static const ShapeType balls_types[2] = {
    { .name = "balls", .bounds = balls_bounds, .prepare = balls_prepare, .hit = balls_hit, .lend = balls_lend,
      .hit_item = ball_hit, .item_blocks = ball_blocks },
    { .name = "balls", .bounds = balls_bounds, .prepare = balls_prepare, .hit = balls_hit, .lend = balls_lend,
      .hit_item = ball_hit, .item_blocks = ball_blocks, .hit_items_bunch = balls_hit_bunch,
      .items_block_bunch = balls_block_bunch },
};

static Shape *balls_new(Arena *a, TestRandom *r, int kind)
{
    Balls *b = ARENA_NEW(a, Balls);
    shape_init(&b->shape, &balls_types[kind]);
    b->n = (uint32_t)test_int(r, 1, MOST_BALLS);
    for (uint32_t i = 0; i < b->n; i++) {
        b->balls[i].sphere = sphere_new(a, any_vector(r, 2), test_range(r, .05, .4));
        b->boxes[i] = shape_bounds(b->balls[i].sphere);
    }
    return &b->shape;
}

/* ---- random scenes ---- */

typedef struct { Arena *a; TestRandom *r; int kind; } Maker;

static Shape *any_primitive(const Maker *m)
{
    Vec3 at = any_vector(m->r, 2), size = vec_add(any_vector(m->r, .2), vec(.3, .3, .3));
    switch (test_int(m->r, 0, 6)) {
    case 0: return box_shape_new(m->a, vec_sub(at, size), vec_add(at, size));
    case 1: return torus_new(m->a, 1 + size.x, size.y);
    case 2: return cylinder_new(m->a, at, vec_add(at, size), size.x, test_int(m->r, 0, 1));
    case 3: return test_int(m->r, 0, 3) ? sphere_new(m->a, at, 1) : plane_new(m->a, any_vector(m->r, 1), 2);
    case 4: case 5: return balls_new(m->a, m->r, m->kind);
    default: return sphere_new(m->a, at, size.x);
    }
}

static const Texture *any_texture(const Maker *m)
{
    Pigment *pigment = ARENA_NEW(m->a, Pigment);
    Layer *layer = ARENA_NEW(m->a, Layer);
    Texture *texture = ARENA_NEW(m->a, Texture);
    *pigment = pigment_solid((Color){ 1, 1, 1, 0, test_int(m->r, 0, 2) ? 0 : .5f });
    *layer = (Layer){ pigment, finish_default() };
    *texture = (Texture){ .layers = layer, .n_layers = 1 };
    return texture;
}

static Object *any_object(const Maker *m, int depth);

/* In a union some parts stand twice in the same place. */
static Shape *any_compound(const Maker *m, int depth)
{
    Shape *parts[8];
    uint32_t n = (uint32_t)test_int(m->r, 1, 8);
    bool is_union = test_int(m->r, 0, 4);
    for (uint32_t i = 0; i < n; i++)
        parts[i] = is_union && i > 0 && test_int(m->r, 0, 3) == 0 ? parts[i - 1] : &any_object(m, depth - 1)->shape;
    return is_union ? union_new(m->a, parts, n) : merge_new(m->a, parts, n);
}

static Object *any_object(const Maker *m, int depth)
{
    Object *o = object_new(m->a, depth > 0 && test_int(m->r, 0, 2) ? any_compound(m, depth) : any_primitive(m));
    if (test_int(m->r, 0, 2) == 0) {
        Xform x = xform_then(xform_scale(vec(1, -.8, 1.2)), xform_rotate(any_vector(m->r, 90)));
        x = xform_then(x, xform_translate(any_vector(m->r, 1)));
        object_transform(o, &x);
    }
    if (test_int(m->r, 0, 3) == 0) o->texture = any_texture(m);
    o->no_image = test_int(m->r, 0, 9) == 0, o->no_reflection = test_int(m->r, 0, 9) == 0;
    o->no_shadow = test_int(m->r, 0, 9) == 0;
    return o;
}

static Scene *any_scene(Arena *a, TestRandom *r)
{
    Scene *s = scene_new(a);
    Maker m = { a, r, test_int(r, 0, 1) };
    int n = test_int(r, 1, 12);
    for (int i = 0; i < n; i++) {
        Object *o = any_object(&m, 3);
        scene_add_object(s, o);
        if (test_int(r, 0, 5) == 0) scene_add_object(s, object_copy(a, o));
    }
    scene_prepare(s);
    return s;
}

/* ---- random bunches ---- */

typedef struct { RayBunch b; BunchLane lane[BUNCH_WIDTH]; } Bunch;

/* From a point, or to it: t at 1 is there. Beside each other, more or less, or each where it likes. */
static void any_bunch(TestRandom *r, Bunch *out)
{
    bool is_from_apex = test_int(r, 0, 1);
    double by = test_int(r, 0, 3) ? exp2(test_range(r, -12, -2)) : 4;
    Vec3 to = any_vector(r, 2), apex = any_vector(r, 8);
    out->b.n = test_int(r, 0, 3) ? BUNCH_WIDTH : test_int(r, 1, BUNCH_WIDTH);
    out->b.lane = out->lane;
    for (int i = 0; i < out->b.n; i++) {
        Vec3 other = vec_add(to, any_vector(r, by));
        Vec3 origin = is_from_apex ? apex : other, end = is_from_apex ? other : apex;
        out->lane[i] = (BunchLane){ .seed = test_bits(r) };
        out->b.ray[i] = (Ray){ origin, vec_sub(end, origin), 0 };
    }
    if (test_int(r, 0, 9) == 0) out->b.ray[test_int(r, 0, out->b.n - 1)].dir.y = NAN;
    if (test_int(r, 0, 9) == 0) out->b.ray[test_int(r, 0, out->b.n - 1)].dir = vec(0, 0, 0);
    bunch_set_lanes(&out->b);
}

/* ---- hits ---- */

static void check_same_hit(const Hit *h, const Hit *alone, unsigned seed, int k, int i)
{
    CHECK(h->t == alone->t && h->t_error == alone->t_error, "seed %u, bunch %d, ray %d: %.17g, not %.17g", seed, k, i, h->t,
          alone->t);
    CHECK(h->index == alone->index && h->shape == alone->shape && h->leaf == alone->leaf, "seed %u, bunch %d, ray %d: %u, "
          "not %u", seed, k, i, h->index, alone->index);
    CHECK(h->u == alone->u && h->v == alone->v, "seed %u, bunch %d, ray %d", seed, k, i);
    CHECK(h->n_objects == alone->n_objects, "seed %u, bunch %d, ray %d", seed, k, i);
    for (int j = 0; j < h->n_objects; j++)
        CHECK(h->objects[j] == alone->objects[j], "seed %u, bunch %d, ray %d, object %d", seed, k, i, j);
}

static void check_hits(const Scene *s, Bunch *q, RayKind kind, Trace *together, unsigned seed, int k)
{
    Hit best[BUNCH_WIDTH] = { 0 };
    Trace alone = { .scratch = together->scratch };
    Lanes hit = scene_hit_bunch(s, &q->b, bunch_all(&q->b), kind, best, together);
    for (int i = 0; i < q->b.n; i++) {
        Hit h;
        if (!vec_is_finite(q->b.ray[i].dir)) continue;
        alone.seed = q->lane[i].seed;
        bool is_hit = scene_hit(s, &q->b.ray[i], kind, &h, &alone);
        CHECK(is_hit == (hit >> i & 1), "seed %u, bunch %d, ray %d: hit %d", seed, k, i, is_hit);
        if (is_hit) check_same_hit(&best[i], &h, seed, k, i);
        else CHECK(best[i].t == INFINITY, "seed %u, bunch %d, ray %d: touched", seed, k, i);
    }
}

/* ---- shadows ---- */

static bool is_filtered(const Scene *s, const Ray *r, double t_max, Arena *scratch)
{
    Trace t = { .scratch = scratch };
    HitList list = hit_list_make(scratch, t_max);
    scene_filters(s, r, &list, &t);
    return list.n > 0;
}

static void check_shadows(const Scene *s, Bunch *q, Trace *together, unsigned seed, int k)
{
    double t_max[BUNCH_WIDTH];
    for (int i = 0; i < BUNCH_WIDTH; i++) t_max[i] = .999;
    Lanes lanes = bunch_all(&q->b) & (k % 4 ? 255u : 0x5Au), may_be_filtered;
    Trace alone = { .scratch = together->scratch };
    for (int i = 0; i < q->b.n; i++) q->lane[i].left_out = 7;
    Lanes blocked = scene_blocks_bunch(s, &q->b, lanes, t_max, &may_be_filtered, together);
    CHECK(!(blocked & ~lanes) && !(may_be_filtered & ~lanes), "seed %u, bunch %d: %x of %x", seed, k, blocked, lanes);
    for (int i = 0; i < q->b.n; i++) {
        const Ray *r = &q->b.ray[i];
        bool may_be;
        if (!vec_is_finite(r->dir)) continue;
        if (!(lanes >> i & 1)) {
            CHECK(q->lane[i].left_out == 7, "seed %u, bunch %d, ray %d: touched", seed, k, i);
            continue;
        }
        bool is_blocked = scene_blocks(s, r, t_max[i], &may_be, &alone);
        CHECK(is_blocked == (blocked >> i & 1), "seed %u, bunch %d, ray %d: blocked %d", seed, k, i, is_blocked);
        if (!is_blocked && is_filtered(s, r, t_max[i], together->scratch))
            CHECK(may_be_filtered >> i & 1, "seed %u, bunch %d, ray %d: not filtered", seed, k, i);
    }
}

static void a_bunch_finds_what_its_rays_find_alone(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 250; seed++) {
        TestRandom r = test_random(seed);
        Arena *a = arena_new(), *scratch = arena_new();
        Scene *s = any_scene(a, &r);
        Trace together = { .scratch = scratch };
        for (int k = 0; k < 60; k++) {
            static Bunch q;
            any_bunch(&r, &q);
            check_hits(s, &q, k % 2 ? RAY_REFLECTED : RAY_CAMERA, &together, seed, k);
            check_shadows(s, &q, &together, seed, k);
        }
        scene_release(s);
        arena_free(scratch);
        arena_free(a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(a_bunch_finds_what_its_rays_find_alone) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
