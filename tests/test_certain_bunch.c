/* Bunches of rays at whole surfaces, as pictures have them, against closed forms: in the middle, at silhouettes, poles and
 * seams, near the origin and far off. */
#include "nurbs/nurbs.h"
#include "render/bunch.h"
#include "tests/closed_forms.h"

typedef struct { Arena *a; Shape *shape; Vec3 at; Trace t; } Fixture;

static Fixture fixture(const Case *c, Vec3 at)
{
    Fixture f = { .a = arena_new(), .at = at };
    Model m;
    c->make(&m);
    for (int i = 0; i < m.n_u * m.n_v; i++)
        m.points[i].x += at.x, m.points[i].y += at.y, m.points[i].z += at.z;
    SurfaceDesc d = model_desc(&m);
    NurbsError e;
    f.shape = nurbs_shape_new(f.a, &d, &(NurbsOptions){ .method = NURBS_METHOD_CERTAIN }, &e, NULL, 0, NULL);
    CHECK(f.shape, "code %d", e.code);
    f.t = (Trace){ .scratch = arena_new() };
    return f;
}

static void done(Fixture *f) { shape_release(f->shape), arena_free(f->t.scratch), arena_free(f->a); }

/* With so few bits that it is exact from far off. */
static double short_number(double x) { return ldexp(round(ldexp(x, 20)), -20); }
static Vec3 short_vec(Vec3 x) { return vec(short_number(x.x), short_number(x.y), short_number(x.z)); }

typedef struct {
    RayBunch b;
    BunchLane lane[BUNCH_WIDTH];
    Hit best[BUNCH_WIDTH];
    double t_max[BUNCH_WIDTH];
} Bunch;

/* Ray i from o, which is about the surface's middle. */
static void set_ray(const Fixture *f, Bunch *k, int i, Vec3 o, Vec3 d)
{
    k->b.ray[i] = (Ray){ vec_add(o, f->at), d, 0 };
    k->lane[i] = (BunchLane){ .seed = f->t.seed + (uint64_t)i };
    k->best[i] = (Hit){ .t = INFINITY }, k->t_max[i] = INFINITY;
}

static Lanes ask(Fixture *f, Bunch *k, Lanes lanes, Lanes *blocked)
{
    BunchLane before[BUNCH_WIDTH];
    memcpy(before, k->lane, sizeof before);
    k->b.lane = k->lane;
    bunch_set_lanes(&k->b);
    *blocked = shape_blocks_bunch(f->shape, &k->b, lanes, k->t_max, &f->t);
    memcpy(k->lane, before, sizeof before);
    return shape_hit_bunch(f->shape, &k->b, lanes, k->best, &f->t);
}

/* Roots nearer together than this are of a silhouette: there the closed form does not tell how far they are. */
#define SILHOUETTE 1e-3

/* The first root, and how far it is to the next one (INFINITY: there is none); of a ray about the middle. */
typedef struct { bool is_hit; double t, gap; } First;

static First first_root(const Case *c, Vec3 o, Vec3 d)
{
    double t[4];
    int n = c->truth(o, d, t), i = 0;
    while (i < n && t[i] <= 0) i++;
    if (i == n) return (First){ false, INFINITY, INFINITY };
    return (First){ true, t[i], i + 1 < n ? t[i + 1] - t[i] : INFINITY };
}

static Vec3 local_origin(const Fixture *f, const Bunch *k, int i) { return vec_sub(k->b.ray[i].origin, f->at); }

/* Rounding of the closed form, far from silhouettes; and the points' own, which are stored about the origin. */
static double slack(const Fixture *f) { return 1e-9 + 0x1p-48 * vec_length(f->at); }

static void check_bunch(const Case *c, Fixture *f, Bunch *k, Lanes lanes, int number, int *n_hits)
{
    Lanes blocked, hit = ask(f, k, lanes, &blocked);
    CHECK(!((hit | blocked) & ~lanes), "%s, bunch %d", c->name, number);
    for (int i = 0; i < k->b.n; i++) {
        First root = first_root(c, local_origin(f, k, i), k->b.ray[i].dir);
        if (!(lanes >> i & 1)) {
            CHECK(isinf(k->best[i].t), "%s, bunch %d, lane %d", c->name, number, i);
            continue;
        }
        if (root.gap < SILHOUETTE) continue;
        bool is_hit = hit >> i & 1;
        CHECK(is_hit == root.is_hit && (blocked >> i & 1) == root.is_hit, "%s, bunch %d, lane %d", c->name, number, i);
        if (is_hit) CHECK_WITHIN(fabs(k->best[i].t - root.t), slack(f), "%s, bunch %d, lane %d", c->name, number, i);
        *n_hits += is_hit;
    }
}

/* Pixels of 4 x 2 of a picture from a random place; from the x axis, too, so that seams lie on the rays of a column. */
static void picture(const Case *c, Vec3 at, unsigned seed)
{
    enum { SIZE = 64 };
    Fixture f = fixture(c, at);
    TestRandom r = test_random(seed);
    Vec3 eye = vec(test_range(&r, -3, 3), test_range(&r, -3, 3), test_range(&r, 1, 3));
    if (seed % 3 == 0) eye.y = 0;
    eye = short_vec(vec_scale(vec_normalize(eye), 4));
    Vec3 w = vec_normalize(vec_neg(eye)), right = vec_normalize(vec_cross(w, vec(0, 0, 1))), up = vec_cross(right, w);
    int n_hits = 0;
    for (int n = 0; n < SIZE * SIZE / BUNCH_WIDTH; n++) {
        Bunch k;
        k.b.n = test_int(&r, 0, 3) ? BUNCH_WIDTH : test_int(&r, 1, BUNCH_WIDTH);
        f.t.seed += BUNCH_WIDTH;
        for (int i = 0; i < k.b.n; i++) {
            double x = 0.5 * (2.0 * (n % (SIZE / 4) * 4 + i % 4) / SIZE - 1);
            double y = 0.5 * (2.0 * (n / (SIZE / 4) * 2 + i / 4) / SIZE - 1);
            set_ray(&f, &k, i, eye, vec_normalize(vec_add(w, vec_add(vec_scale(right, x), vec_scale(up, y)))));
        }
        Lanes lanes = bunch_all(&k.b);
        check_bunch(c, &f, &k, test_int(&r, 0, 3) ? lanes : lanes & (Lanes)test_int(&r, 0, 255), n, &n_hits);
    }
    CHECK(n_hits > 500, "%s: %d hits", c->name, n_hits);
    done(&f);
}

static void pictures_in_bunches_have_no_holes(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 12; seed++)
        for (int i = 0; i < 3; i++) {
            picture(&cases[i], vec(0, 0, 0), seed);
            picture(&cases[i], vec(0x1p20, -0x1p20, 0x1p19), seed);
        }
}

/* Rays that have nothing to do with each other. */
static void random_rays_in_bunches_hit_what_the_closed_form_says(void **state)
{
    (void)state;
    for (int c = 0; c < 3; c++) {
        Fixture f = fixture(&cases[c], vec(0, 0, 0));
        TestRandom r = test_random((uint64_t)c);
        int n_hits = 0;
        for (int n = 0; n < 3000; n++) {
            Bunch k;
            k.b.n = BUNCH_WIDTH, f.t.seed += BUNCH_WIDTH;
            for (int i = 0; i < BUNCH_WIDTH; i++) {
                Vec3 d = vec(test_range(&r, -1, 1), test_range(&r, -1, 1), test_range(&r, -1, 1));
                Vec3 p = vec(test_range(&r, -1.5, 1.5), test_range(&r, -1.5, 1.5), test_range(&r, -1.2, 1.2));
                d = vec_normalize(d);
                set_ray(&f, &k, i, vec_sub(p, vec_scale(d, test_range(&r, 0, 4))), d);
            }
            check_bunch(&cases[c], &f, &k, bunch_all(&k.b), n, &n_hits);
        }
        CHECK(n_hits > 4000, "%s: %d hits", cases[c].name, n_hits);
        done(&f);
    }
}

/* From where rays meet a sphere: to the outside nothing is met, to the inside the other side. */
static void rays_that_leave_a_sphere_in_bunches_meet_its_other_side_or_nothing(void **state)
{
    (void)state;
    Fixture f = fixture(&cases[0], vec(0, 0, 0));
    TestRandom r = test_random(5);
    for (int n = 0; n < 3000; n++) {
        Bunch k;
        Lanes blocked;
        Vec3 eye = vec_scale(vec_normalize(vec(test_range(&r, -1, 1), test_range(&r, -1, 1), test_range(&r, -1, 1))), 3);
        k.b.n = BUNCH_WIDTH, f.t.seed += BUNCH_WIDTH;
        for (int i = 0; i < BUNCH_WIDTH; i++) {
            Vec3 to = vec(test_range(&r, -.3, .3), test_range(&r, -.3, .3), test_range(&r, -.3, .3));
            set_ray(&f, &k, i, eye, vec_normalize(vec_sub(to, eye)));
        }
        Lanes hit = ask(&f, &k, bunch_all(&k.b), &blocked);
        CHECK(hit == bunch_all(&k.b) && blocked == hit, "bunch %d: %x, %x", n, hit, blocked);
        double chord[BUNCH_WIDTH];
        for (int i = 0; i < BUNCH_WIDTH; i++) {
            const Ray old = k.b.ray[i];
            Vec3 p = ray_at(&old, k.best[i].t);
            Vec3 d = vec_normalize(vec(test_range(&r, -1, 1), test_range(&r, -1, 1), test_range(&r, -1, 1)));
            double along = vec_dot(d, vec_normalize(p)), start = hit_offset(&k.best[i], &old);
            chord[i] = -2 * along;
            k.b.ray[i] = (Ray){ vec_add(p, vec_scale(vec_normalize(p), copysign(start, along))), d, 0 };
            k.best[i] = (Hit){ .t = INFINITY };
        }
        hit = ask(&f, &k, bunch_all(&k.b), &blocked);
        for (int i = 0; i < BUNCH_WIDTH; i++) {
            if (fabs(chord[i]) < 1e-6) continue;
            bool is_inside = chord[i] > 0;
            CHECK((hit >> i & 1) == is_inside && (blocked >> i & 1) == is_inside, "bunch %d, lane %d", n, i);
            if (is_inside) CHECK_WITHIN(fabs(k.best[i].t - chord[i]), 1e-12 / chord[i], "bunch %d, lane %d", n, i);
        }
    }
    done(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_in_bunches_have_no_holes),
        cmocka_unit_test(random_rays_in_bunches_hit_what_the_closed_form_says),
        cmocka_unit_test(rays_that_leave_a_sphere_in_bunches_meet_its_other_side_or_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
