/* The paraboloid of a tile: that it is as near as it says, nearer by an order than the frame, and that what it lets rays
 * pass is not on them. The truth are points of the tile, rays made to go through them, and a bump of a known height. */
#include "test.h"

#include "nurbs/certify.h"
#include "nurbs/doubt.h"
#include "nurbs/paraboloid_kernel.h"

typedef struct { Arena *arena; PatchGroup group; } Fixture;

static int set_up(void **state)
{
    static Fixture f;
    f = (Fixture){ .arena = arena_new() };
    f.group.arena = f.arena;
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    arena_free(((Fixture *)*state)->arena);
    return 0;
}

static Vec3 random_direction(TestRandom *r)
{
    for (;;) {
        Vec3 d = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
        if (vec_length2(d) > 0.01 && vec_length2(d) < 1) return vec_normalize(d);
    }
}

/* All of a patch over the unit square, of heights up to `bump`, weights within a factor `ratio`. */
static Tile *random_tile(Fixture *f, TestRandom *r, int least_order, double bump, double ratio)
{
    int k_u = test_int(r, least_order, 6), k_v = test_int(r, least_order, 6);
    Vec4 p[36];
    Vec3 shift = vec(test_range(r, -5, 5), test_range(r, -5, 5), test_range(r, -5, 5));
    for (int j = 0; j < k_v; j++)
        for (int i = 0; i < k_u; i++) {
            Vec3 at = vec(i / (k_u - 1.0), j / (k_v - 1.0), test_range(r, -bump, bump));
            p[j * k_u + i] = vec4_weighted(vec4(shift.x + at.x, shift.y + at.y, shift.z + at.z, pow(ratio, test_unit(r))));
        }
    Patch *patch = ARENA_NEW(f->arena, Patch);
    Tile *tile = ARENA_NEW(f->arena, Tile);
    patch_make(f->arena, k_u, k_v, (WideNet){ p, NULL }, 0, (TrimRect){ 0, 1, 0, 1 }, patch);
    patch->group = &f->group;
    tile_make(patch, patch->p, (TilePlace){ 0, 0, 1, 1 }, tile);
    return tile;
}

typedef struct { const Tile *tile; const Paraboloid *paraboloid; } Half;

static Half half_of(const Tile *tile, int i)
{
    const Halves *h = tile_halves(tile);
    assert_non_null(h);
    return (Half){ &h->tiles[i], &h->paraboloids[i] };
}

static Half random_half(TestRandom *r, const Tile *tile)
{
    Half h = half_of(tile, test_int(r, 0, 1));
    for (int n = test_int(r, 0, 6); n > 0 && tile_halves(h.tile); n--) h = half_of(h.tile, test_int(r, 0, 1));
    return h;
}

static Vec3 point_at(const Tile *f, double s, double t)    /* about the patch's origin */
{
    Vec4 value, by_s, by_t;
    tile_evaluate(f, &s, &t, &value, &by_s, &by_t);
    return vec4_project(value);
}

static Vec3 paraboloid_at(Half h, double s, double t)
{
    double x = 2 * s - 1, y = 2 * t - 1;
    Vec3 sum = vec_add(tile_vec(h.tile->middle), tile_vec(h.paraboloid->at));
    sum = vec_add(sum, vec_add(vec_scale(tile_vec(h.tile->half_s), x), vec_scale(tile_vec(h.tile->half_t), y)));
    sum = vec_add(sum, vec_add(vec_scale(tile_vec(h.paraboloid->ss), x * x), vec_scale(tile_vec(h.paraboloid->tt), y * y)));
    return vec_add(sum, vec_scale(tile_vec(h.paraboloid->st), x * y));
}

static void the_paraboloid_is_as_near_as_it_says(void **state)
{
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        const Tile *tile = random_tile(*state, &r, 2, seed % 3 ? 0.5 : 1e-2, seed % 2 ? 1 : 30);
        if (!tile_halves(tile)) continue;    /* flat */
        Half h = random_half(&r, tile);
        for (int n = 0; n < 100; n++) {
            bool on_border = n % 4 == 0;
            double s = on_border ? test_int(&r, 0, 1) : test_unit(&r), t = test_unit(&r);
            double off = vec_length(vec_sub(point_at(h.tile, s, t), paraboloid_at(h, s, t)));
            CHECK_WITHIN(off, h.paraboloid->deviation, "seed %u", seed);
        }
    }
}

/* Two halvings, one in each direction mostly, leave an eighth of it, where the frame's deviation becomes a quarter. */
static void what_it_leaves_is_of_the_third_order(void **state)
{
    double sum = 0;
    int n = 0;
    for (unsigned seed = 0; seed < 300; seed++) {
        TestRandom r = test_random(seed);
        const Tile *tile = random_tile(*state, &r, 3, 0.3, seed % 2 ? 1 : 2);
        Half large = half_of(half_of(tile, 0).tile, 1), small = half_of(half_of(large.tile, 1).tile, 0);
        sum += log2(large.paraboloid->deviation / small.paraboloid->deviation), n++;
    }
    CHECK(sum / n > 2.7, "%g halvings of the deviation", sum / n);
}

static SeenTile seen_tile(const PatchRay *r, const Tile *f)
{
    Vec3 o = vec_sub(vec_sub(r->origin, f->patch->origin), tile_vec(f->middle));
    Vec3 a = tile_vec(f->half_s), b = tile_vec(f->half_t);
    SeenTile k = { .n1 = r->n1, .n2 = r->n2, .q1 = vec_dot(r->n1, o), .q2 = vec_dot(r->n2, o), .c11 = vec_dot(r->n1, a),
                   .c12 = vec_dot(r->n1, b), .c21 = vec_dot(r->n2, a), .c22 = vec_dot(r->n2, b) };
    k.det = k.c11 * k.c22 - k.c12 * k.c21;
    k.rounding = patch_rounding(f->patch, vec_sub(r->origin, f->patch->origin));
    return k;
}

/* Whatever its direction; tangents, too. */
static void a_ray_through_a_point_of_the_tile_does_not_miss_it(void **state)
{
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        Half h = random_half(&r, random_tile(*state, &r, 2, 0.5, seed % 2 ? 1 : 30));    /* none is flat */
        for (int n = 0; n < 50; n++) {
            double s = n % 5 ? test_unit(&r) : test_int(&r, 0, 1), t = test_unit(&r);
            Vec3 d = random_direction(&r), at = vec_add(point_at(h.tile, s, t), h.tile->patch->origin);
            if (n % 2) {
                Vec4 value, by_s, by_t;
                tile_evaluate(h.tile, &s, &t, &value, &by_s, &by_t);
                Vec3 p = vec4_project(value), along = vec(by_s.x - p.x * by_s.w, by_s.y - p.y * by_s.w, by_s.z - p.z * by_s.w);
                d = vec_normalize(vec_add(vec_normalize(along), vec_scale(d, pow(10, -test_range(&r, 1, 16)))));
            }
            PatchRay ray = patch_ray(vec_sub(at, vec_scale(d, test_range(&r, 0, 3))), d, 0, INFINITY);
            SeenTile seen = seen_tile(&ray, h.tile);
            CHECK(!paraboloid_is_missed(h.paraboloid, &seen), "seed %u, ray %d", seed, n);
        }
    }
}

/* z = -(x^2 + y^2) / 2 over [-1, 1]^2: horizontal rays h above its top, in the middle of a half, miss it; 1e-6 below not. */
static void a_ray_over_a_bump_misses_it(void **state)
{
    Fixture *f = *state;
    Vec4 p[9];
    for (int i = 0; i < 9; i++) {
        double x = i % 3 - 1, y = i / 3 - 1;
        p[i] = vec4(x, y, -.5 * ((x == 0 ? -1 : 1) + (y == 0 ? -1 : 1)), 1);
    }
    Patch *patch = ARENA_NEW(f->arena, Patch);
    Tile *tile = ARENA_NEW(f->arena, Tile);
    patch_make(f->arena, 3, 3, (WideNet){ p, NULL }, 0, (TrimRect){ 0, 1, 0, 1 }, patch);
    patch->group = &f->group;
    tile_make(patch, patch->p, (TilePlace){ 0, 0, 1, 1 }, tile);
    TestRandom r = test_random(1);
    for (int n = 0; n < 1000; n++) {
        double angle = test_range(&r, 0, 2 * M_PI);
        Vec3 d = vec(cos(angle), sin(angle), 0);
        for (int i = 0; i < 2; i++) {
            PatchRay over = patch_ray(vec_sub(vec(0, 0, 1e-6), vec_scale(d, 3)), d, 0, INFINITY);
            PatchRay below = patch_ray(vec_sub(vec(0, 0, -1e-6), vec_scale(d, 3)), d, 0, INFINITY);
            Half h = half_of(tile, i);
            SeenTile seen_over = seen_tile(&over, h.tile), seen_below = seen_tile(&below, h.tile);
            CHECK(paraboloid_is_missed(h.paraboloid, &seen_over), "angle %g, half %d", angle, i);
            CHECK(!paraboloid_is_missed(h.paraboloid, &seen_below), "angle %g, half %d", angle, i);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_paraboloid_is_as_near_as_it_says, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_it_leaves_is_of_the_third_order, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ray_through_a_point_of_the_tile_does_not_miss_it, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_ray_over_a_bump_misses_it, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
