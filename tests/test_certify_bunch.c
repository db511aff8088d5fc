/* Eight rays at a tile: each finds what plain clipping finds of it, and what it finds does not depend on the others. */
#include "tests/tiles.h"

#include "nurbs/certain_bunch.h"
#include "nurbs/clip.h"

#include <string.h>

typedef struct {
    RayBunch b;
    BunchLane lane[BUNCH_WIDTH];
    double t_max[BUNCH_WIDTH];
} Bunch;

static Vec3 nearby(TestRandom *r, Vec3 x, double far) { return vec_add(x, vec_scale(random_direction(r), far)); }

/* Rays towards the tile from some way off: all from one point, and about one direction; or each for itself. */
static void aim_rays(TestRandom *r, const Tile *p, Bunch *k)
{
    double spread = test_int(r, 0, 3) ? p->radius * pow(10, test_range(r, -8, 0)) : INFINITY;
    Vec3 aim = nearby(r, middle_of(p), p->radius * test_unit(r)), from = nearby(r, aim, test_range(r, 0.5, 4));
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        bool is_alone = isinf(spread);
        Vec3 to = nearby(r, is_alone ? middle_of(p) : aim, is_alone ? p->radius * test_unit(r) : spread);
        Vec3 o = is_alone ? nearby(r, to, 3) : from, d = vec_sub(to, o);
        k->b.ray[i] = (Ray){ o, vec_scale(d, pow(10, test_range(r, -3, 3))), 0 };
    }
}

/* Of n rays, which remember nothing. */
static void begin_bunch(TestRandom *r, Bunch *k, int n)
{
    memset(k, 0, sizeof *k);
    k->b.n = n, k->b.lane = k->lane;
    for (int i = 0; i < BUNCH_WIDTH; i++) k->lane[i].seed = test_bits(r);
}

static void set_limits(TestRandom *r, Bunch *k)
{
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        double per_length = 1 / vec_length(k->b.ray[i].dir);
        k->t_max[i] = (test_int(r, 0, 3) ? INFINITY : test_range(r, 0, 5)) * per_length;
        if (!test_int(r, 0, 3)) k->b.ray[i].t_min = test_range(r, -1, 3) * per_length;
    }
    bunch_set_lanes(&k->b);
    bunch_use_frames(&k->b);
}

static Found clipped(Fixture *f, const Tile *p, const Ray *r, double t_max)
{
    double length = vec_length(r->dir);
    PatchRay ray = patch_ray(r->origin, vec_normalize(r->dir), r->t_min * length, t_max * length);
    Found found = { 0 };
    clip_roots(p, &ray, collect, &found, &f->trace);
    return found;
}

/* Are all roots of a ray, but those so near its limits that they may as well be outside, near the one that was found? */
static bool are_all(const Found *truth, const Ray *r, double t_max, bool is_found, double depth, double error)
{
    double length = vec_length(r->dir), lo = r->t_min * length, hi = t_max * length;
    for (int i = 0; i < truth->n; i++) {
        double t = truth->depth[i], e = truth->error[i];
        if (t > lo + 2 * e && t < hi - 2 * e && !(is_found && fabs(t - depth) <= e + error)) return false;
    }
    return true;
}

/* What rays ask for: all for one tile, or each for its own, some of them for the same. */
typedef struct { bool is_one; const Tile *of[BUNCH_WIDTH]; } Tiles;

static const Tile *tile_of(const Tiles *tiles, int i) { return tiles->of[tiles->is_one ? 0 : i]; }

static Tiles one_tile(const Tile *p) { return (Tiles){ true, { p } }; }

static Tiles random_tiles(Fixture *f, TestRandom *r, double bump, double ratio)
{
    Tiles tiles = { false, { NULL } };
    const Tile *whole = random_tile(f, r, bump, ratio);
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        if (i > 0 && test_int(r, 0, 3) == 0) whole = random_tile(f, r, bump, ratio);
        tiles.of[i] = random_part(r, whole);
    }
    return tiles;
}

static Lanes roots_of(const Tiles *tiles, Bunch *k, Lanes lanes, Roots *out, LanesLeft *left, Trace *t)
{
    BunchLimits limits = { k->t_max, 1 };
    return tiles->is_one ? tile_roots_bunch(tiles->of[0], &k->b, lanes, limits, out, left, t)
                         : tiles_roots_bunch(tiles->of, &k->b, lanes, limits, out, left, t);
}

typedef struct { int n_roots, n_lanes, n_undecided; } Tally;

static void compare_with_clipping(Fixture *f, const Tiles *tiles, Bunch *k, Lanes lanes, unsigned seed, Tally *tally)
{
    Roots roots;
    LanesLeft left_over;
    Lanes rooted = roots_of(tiles, k, lanes, &roots, &left_over, &f->trace);
    Lanes undecided = left_over.in_doubt | left_over.alone;
    CHECK(!((rooted | undecided) & ~lanes) && !(rooted & undecided), "seed %u", seed);
    for (Lanes left = lanes & ~undecided; left; ) {
        int i = lanes_next(&left);
        bool is_found = rooted >> i & 1;
        Found truth = clipped(f, tile_of(tiles, i), &k->b.ray[i], k->t_max[i]);
        double depth = is_found ? roots.depth[i] : 0, error = is_found ? roots.depth_error[i] : 0;
        if (is_found) CHECK(has_depth(&truth, depth, error), "seed %u, lane %d: %g", seed, i, depth);
        CHECK(are_all(&truth, &k->b.ray[i], k->t_max[i], is_found, depth, error), "seed %u, lane %d", seed, i);
        tally->n_roots += is_found;
    }
    tally->n_lanes += __builtin_popcount(lanes), tally->n_undecided += __builtin_popcount(undecided);
}

static void lanes_lose_and_invent_nothing(void **state)
{
    Fixture *f = *state;
    Tally tally = { 0 };
    for (unsigned seed = 0; seed < 20000; seed++) {
        TestRandom r = test_random(seed);
        Tiles p = one_tile(random_part(&r, random_tile(f, &r, test_range(&r, 0, 0.1), seed % 2 ? 1 : 4)));
        Bunch k;
        begin_bunch(&r, &k, test_int(&r, 1, BUNCH_WIDTH));
        aim_rays(&r, p.of[0], &k);
        set_limits(&r, &k);
        Lanes lanes = bunch_all(&k.b) & (Lanes)test_int(&r, 1, 255);
        compare_with_clipping(f, &p, &k, lanes, seed, &tally);
    }
    assert_true(tally.n_roots > 8000);
    assert_true(tally.n_undecided < 0.4 * tally.n_lanes);
}

/* Each ray is aimed at its own tile, as the same ray of a bunch at that tile would be. */
static void lanes_of_many_tiles_lose_and_invent_nothing(void **state)
{
    Fixture *f = *state;
    Tally tally = { 0 };
    for (unsigned seed = 0; seed < 20000; seed++) {
        TestRandom r = test_random(seed);
        Tiles p = random_tiles(f, &r, test_range(&r, 0, 0.1), seed % 2 ? 1 : 4);
        Bunch k;
        begin_bunch(&r, &k, test_int(&r, 1, BUNCH_WIDTH));
        for (int i = 0; i < k.b.n; i++) {
            Bunch at_tile;
            aim_rays(&r, p.of[i], &at_tile);
            k.b.ray[i] = at_tile.b.ray[i];
        }
        set_limits(&r, &k);
        Lanes lanes = bunch_all(&k.b) & (Lanes)test_int(&r, 1, 255);
        compare_with_clipping(f, &p, &k, lanes, seed, &tally);
    }
    assert_true(tally.n_roots > 8000);
    assert_true(tally.n_undecided < 0.4 * tally.n_lanes);
}

/* As a_ray_that_knows_where_it_is_from_loses_nothing. */
static void lanes_that_know_where_they_are_from_lose_nothing(void **state)
{
    Fixture *f = *state;
    Tally tally = { 0 };
    for (unsigned seed = 0; seed < 20000; seed++) {
        TestRandom r = test_random(seed);
        double bump = test_range(&r, 0, 0.1), ratio = seed % 2 ? 1 : 4;
        Tiles p = seed % 3 ? one_tile(random_part(&r, random_tile(f, &r, bump, ratio))) : random_tiles(f, &r, bump, ratio);
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        for (int i = 0; i < BUNCH_WIDTH; i++) {
            PatchRay ray = random_ray_from(&r, tile_of(&p, i));
            k.b.ray[i] = (Ray){ ray.origin, ray.d, ray.t_min }, k.t_max[i] = INFINITY;
            if (seed % 4) k.lane[i].root = (RayRoot){ ray.from, ray.from_s, ray.from_t, k.lane[i].seed };
        }
        bunch_set_lanes(&k.b);
        bunch_use_frames(&k.b);
        compare_with_clipping(f, &p, &k, bunch_all(&k.b), seed, &tally);
    }
    assert_true(tally.n_roots > 20000);
}

/* A point of the tile is met at its distance, in lanes or in doubt. */
static void lanes_through_points_of_the_tile_find_them(void **state)
{
    Fixture *f = *state;
    int n_decided = 0;
    for (unsigned seed = 0; seed < 10000; seed++) {
        TestRandom r = test_random(seed);
        double bump = seed % 3 ? 0.05 : 0.4, ratio = seed % 2 ? 1 : 4;
        Tiles p = seed % 5 ? one_tile(random_part(&r, random_tile(f, &r, bump, ratio))) : random_tiles(f, &r, bump, ratio);
        double distance[BUNCH_WIDTH];
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        for (int i = 0; i < BUNCH_WIDTH; i++) {
            double s = i < 2 ? i : test_unit(&r), t = test_unit(&r);    /* two on borders */
            Vec3 d = random_direction(&r), at = vec_add(middle_of(tile_of(&p, i)), point_of(tile_of(&p, i), s, t));
            distance[i] = test_range(&r, 0.5, 4), k.t_max[i] = INFINITY;
            k.b.ray[i] = (Ray){ vec_sub(at, vec_scale(d, distance[i])), d, 0 };
        }
        bunch_set_lanes(&k.b);
        bunch_use_frames(&k.b);
        Roots roots;
        LanesLeft over;
        Lanes all = bunch_all(&k.b);
        Lanes rooted = roots_of(&p, &k, all, &roots, &over, &f->trace);
        for (Lanes left = all & ~over.in_doubt & ~over.alone; left; n_decided++) {
            int i = lanes_next(&left);
            CHECK(rooted >> i & 1, "seed %u, lane %d", seed, i);
            double bound = roots.depth_error[i] + 1e-14 * (distance[i] + 10);
            CHECK_WITHIN(fabs(roots.depth[i] - distance[i]), bound, "seed %u, lane %d", seed, i);
        }
    }
    assert_true(n_decided > 20000);
}

/* ---- the search of a tile and its parts ---- */

static bool is_same_hit(const CertainHits *a, const CertainHits *b, int i)
{
    return a->t[i] == b->t[i] && a->t_error[i] == b->t_error[i] && a->u[i] == b->u[i] && a->v[i] == b->v[i];
}

static BunchItems items_of(const Tiles *p)
{
    BunchItems items = { .is_one = p->is_one };
    for (int i = 0; i < (p->is_one ? 1 : BUNCH_WIDTH); i++) items.at[i] = p->of[i];
    return items;
}

static Lanes nearest_of(Fixture *f, const Tiles *p, Bunch *k, Lanes lanes, CertainHits *out)
{
    double limit[BUNCH_WIDTH];
    BunchItems items = items_of(p);
    memcpy(limit, k->t_max, sizeof limit);
    for (int i = 0; i < BUNCH_WIDTH; i++) k->lane[i].root.patch = NULL;
    return certain_nearest_on_bunch(&items, &k->b, lanes, (BunchLimits){ limit, 1 }, &f->trace, out);
}

static Lanes nearest(Fixture *f, const Tile *p, Bunch *k, Lanes lanes, CertainHits *out)
{
    Tiles one = one_tile(p);
    return nearest_of(f, &one, k, lanes, out);
}

static Lanes any_of(Fixture *f, const Tiles *p, Bunch *k, Lanes lanes)
{
    BunchItems items = items_of(p);
    return certain_any_on_bunch(&items, &k->b, lanes, k->t_max, &f->trace);
}

/* Is a ray hit, at t of its direction, where the nearest of the roots is that clipping finds, and blocked where there is
 * one? Roots so near its limits that they may as well be outside are not judged. */
static void check_nearest(const Found *truth, const Ray *ray, double t_max, bool is_hit, bool is_blocked, double t,
                          unsigned seed)
{
    double length = vec_length(ray->dir), least = INFINITY, error = 0;
    for (int j = 0; j < truth->n; j++) {
        double depth = truth->depth[j], e = 2 * truth->error[j];
        if (depth < ray->t_min * length + e || depth > t_max * length - e) return;
        if (depth < least) least = depth, error = e;
    }
    CHECK(is_hit == (truth->n > 0) && is_blocked == (truth->n > 0), "seed %u", seed);
    if (truth->n) CHECK_WITHIN(fabs(t * length - least), 2 * error, "seed %u", seed);
}

static void a_bunch_hits_the_nearest_root_of_each_ray_and_is_blocked_by_any(void **state)
{
    Fixture *f = *state;
    int n_hits = 0;
    for (unsigned seed = 0; seed < 20000; seed++) {
        TestRandom r = test_random(seed);
        double bump = test_range(&r, 0, 0.7), ratio = seed % 2 ? 1 : 4;
        Tiles p = seed % 4 ? one_tile(random_tile(f, &r, bump, ratio)) : random_tiles(f, &r, bump, ratio);
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        aim_rays(&r, p.of[0], &k);
        set_limits(&r, &k);
        CertainHits hits;
        Lanes all = bunch_all(&k.b), hit = nearest_of(f, &p, &k, all, &hits), blocked = any_of(f, &p, &k, all);
        for (int i = 0; i < BUNCH_WIDTH; i++) {
            Found truth = clipped(f, tile_of(&p, i), &k.b.ray[i], k.t_max[i]);
            check_nearest(&truth, &k.b.ray[i], k.t_max[i], hit >> i & 1, blocked >> i & 1, hits.t[i], seed);
        }
        n_hits += __builtin_popcount(hit);
    }
    assert_true(n_hits > 50000);
}

/* Up to the rounding that is owned up to: tiles of one bunch are evaluated in another way. */
static void a_lane_is_hit_as_near_whether_it_is_alone_at_its_tile_or_not(void **state)
{
    Fixture *f = *state;
    int n_hits = 0;
    for (unsigned seed = 0; seed < 4000; seed++) {
        TestRandom r = test_random(seed);
        Tiles each = random_tiles(f, &r, test_range(&r, 0, 0.3), seed % 2 ? 1 : 4);
        Tiles one = one_tile(each.of[0]);
        for (int i = 0; i < BUNCH_WIDTH; i += 2) each.of[i] = each.of[0];
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        aim_rays(&r, one.of[0], &k);
        for (int i = 0; i < BUNCH_WIDTH; i++) k.t_max[i] = INFINITY;
        bunch_set_lanes(&k.b);
        CertainHits a, b;
        Lanes got_a = nearest_of(f, &one, &k, 0x55, &a), got_b = nearest_of(f, &each, &k, 0xff, &b);
        CHECK(got_a == (got_b & 0x55), "seed %u", seed);
        for (Lanes left = got_a; left; n_hits++) {
            int i = lanes_next(&left);
            CHECK_WITHIN(fabs(a.t[i] - b.t[i]), a.t_error[i] + b.t_error[i], "seed %u, lane %d", seed, i);
        }
    }
    assert_true(n_hits > 1000);
}

/* What a ray of a bunch finds does not depend on the rays beside it: at one tile, and where each has its own. */
static void a_lane_is_hit_the_same_whoever_is_beside_it(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 3000; seed++) {
        TestRandom r = test_random(seed);
        double bump = test_range(&r, 0, 0.3), ratio = seed % 2 ? 1 : 4;
        int i = test_int(&r, 0, BUNCH_WIDTH - 1);
        Tiles a = seed % 3 ? one_tile(random_tile(f, &r, bump, ratio)) : random_tiles(f, &r, bump, ratio), b = a;
        if (!a.is_one) b = random_tiles(f, &r, bump, ratio), b.of[i] = a.of[i];
        Bunch one, other;
        begin_bunch(&r, &one, BUNCH_WIDTH);
        aim_rays(&r, tile_of(&a, i), &one);
        set_limits(&r, &one);
        begin_bunch(&r, &other, BUNCH_WIDTH);
        aim_rays(&r, tile_of(&b, 0), &other);
        set_limits(&r, &other);
        other.b.ray[i] = one.b.ray[i], other.t_max[i] = one.t_max[i];
        bunch_set_lanes(&other.b);
        bunch_use_frames(&other.b);
        CertainHits hits_a, hits_b;
        Lanes lane = 1u << i;
        Lanes got_a = nearest_of(f, &a, &one, lane, &hits_a), got_b = nearest_of(f, &b, &other, 255, &hits_b);
        CHECK(got_a == (got_b & lane), "seed %u", seed);
        if (got_a) CHECK(is_same_hit(&hits_a, &hits_b, i), "seed %u", seed);
    }
}

/* Rays that are none: not a number, infinite, without a direction. */
static void rays_of_no_numbers_hit_nothing_and_disturb_nobody(void **state)
{
    Fixture *f = *state;
    const double odd[] = { NAN, INFINITY, -INFINITY };
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        const Tile *p = random_tile(f, &r, test_range(&r, 0, 0.3), seed % 2 ? 1 : 4);
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        aim_rays(&r, p, &k);
        set_limits(&r, &k);
        CertainHits before, after;
        Lanes hit = nearest(f, p, &k, 0x0f, &before);
        for (int i = 4; i < BUNCH_WIDTH; i++) {
            Ray *ray = &k.b.ray[i];
            double *number[6] = { &ray->origin.x, &ray->origin.y, &ray->origin.z, &ray->dir.x, &ray->dir.y, &ray->dir.z };
            *number[test_int(&r, 0, 5)] = odd[test_int(&r, 0, 2)];
            if (i == 7) *ray = (Ray){ ray->origin, { 0, 0, 0 }, 0 };
        }
        bunch_set_lanes(&k.b);
        CHECK(nearest(f, p, &k, 0x7f, &after) == hit, "seed %u", seed);
        for (int i = 0; i < 4; i++)
            if (hit >> i & 1) CHECK(is_same_hit(&before, &after, i), "seed %u, lane %d", seed, i);
        k.t_max[4] = NAN, k.b.ray[5].t_min = NAN;
        bunch_set_lanes(&k.b);
        CHECK((nearest(f, p, &k, 0xff, &after) & 0x7f) == hit, "seed %u", seed);
        Tiles one = one_tile(p);
        any_of(f, &one, &k, 0xff);
    }
}

/* Directions of any length: what is too long or too short for a square, too. */
static void the_length_of_a_direction_changes_no_hit(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 1000; seed++) {
        TestRandom r = test_random(seed);
        const Tile *p = random_tile(f, &r, test_range(&r, 0, 0.1), 1);
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        aim_rays(&r, p, &k);
        for (int i = 1; i < BUNCH_WIDTH; i++) {
            int e = test_int(&r, -500, 500);
            Vec3 d = k.b.ray[0].dir;
            k.b.ray[i] = (Ray){ k.b.ray[0].origin, vec(ldexp(d.x, e), ldexp(d.y, e), ldexp(d.z, e)), 0 };
        }
        for (int i = 0; i < BUNCH_WIDTH; i++) k.t_max[i] = INFINITY;
        bunch_set_lanes(&k.b);
        CertainHits hits;
        Lanes hit = nearest(f, p, &k, bunch_all(&k.b), &hits);
        CHECK(hit == 0 || hit == bunch_all(&k.b), "seed %u: %x", seed, hit);
        for (int i = 1; i < BUNCH_WIDTH && hit; i++) {
            double t = hits.t[i] * (k.b.ray[i].dir.x / k.b.ray[0].dir.x);
            CHECK_WITHIN(fabs(t - hits.t[0]), 2 * hits.t_error[0] + 1e-12 * hits.t[0], "seed %u, lane %d", seed, i);
        }
    }
}

/* Arrays of what was not asked for stay what they were. */
static void lanes_that_were_not_asked_for_are_left_alone(void **state)
{
    Fixture *f = *state;
    for (unsigned seed = 0; seed < 500; seed++) {
        TestRandom r = test_random(seed);
        const Tile *p = random_tile(f, &r, 0.05, 1);
        Bunch k;
        begin_bunch(&r, &k, BUNCH_WIDTH);
        aim_rays(&r, p, &k);
        set_limits(&r, &k);
        CertainHits hits, same;
        memset(&hits, 0x55, sizeof hits), same = hits;
        Lanes lanes = (Lanes)test_int(&r, 0, 255), hit = nearest(f, p, &k, lanes, &hits);
        CHECK(!(hit & ~lanes), "seed %u", seed);
        for (int i = 0; i < BUNCH_WIDTH; i++)
            if (!(hit >> i & 1)) CHECK(is_same_hit(&hits, &same, i) && !k.lane[i].root.patch, "seed %u, lane %d", seed, i);
            else CHECK(k.lane[i].root.patch == p->patch && k.lane[i].root.seed == k.lane[i].seed, "seed %u", seed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lanes_lose_and_invent_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lanes_of_many_tiles_lose_and_invent_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lanes_that_know_where_they_are_from_lose_nothing, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lanes_through_points_of_the_tile_find_them, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_bunch_hits_the_nearest_root_of_each_ray_and_is_blocked_by_any, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_lane_is_hit_as_near_whether_it_is_alone_at_its_tile_or_not, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_lane_is_hit_the_same_whoever_is_beside_it, set_up, tear_down),
        cmocka_unit_test_setup_teardown(rays_of_no_numbers_hit_nothing_and_disturb_nobody, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_length_of_a_direction_changes_no_hit, set_up, tear_down),
        cmocka_unit_test_setup_teardown(lanes_that_were_not_asked_for_are_left_alone, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
