/* Closed solids made of NURBS surfaces: a ray crosses them an even number of times from outside, an odd number from inside,
 * and none slips in through a seam. With a number for an argument that many rays are shot at each solid. */
#include "render/hit_list.h"
#include "tests/scene_text.h"

static long n_rays = 20000;     /* five solids: 1e5 in all */

static double about(double r) { return r * r; }
static bool is_in_sphere(Vec3 p) { return vec_length2(p) < 1; }
static bool is_in_torus(Vec3 p) { return about(hypot(p.x, p.z) - 1) + about(p.y) < about(.375); }

/* The plate and its bore: see its text. */
#define PLATE vec(.7, .3, .6)
static bool is_in_plate(Vec3 p)
{
    return fabs(p.x) < PLATE.x && fabs(p.y) < PLATE.y && fabs(p.z) < PLATE.z && hypot(p.x - .1, p.z + .05) > .25;
}

/* ---- a point on a seam, and a point inside from which the line to the seam leaves the solid there ---- */

typedef struct { Vec3 edge, inner; } Seam;

static Vec3 on_circle(double radius, double y, double angle) { return vec(radius * cos(angle), y, radius * sin(angle)); }
static double any_angle(TestRandom *r) { return test_range(r, 0, 2 * M_PI); }
static double quarter(TestRandom *r) { return .5 * M_PI * test_int(r, 0, 3); }

/* Meridians where patches meet, one of them the seam; the equator; the poles, which take their time. */
static Seam seam_of_sphere(TestRandom *r)
{
    double angle = any_angle(r), inner = test_range(r, 0, .8) / sqrt(3);
    int which = test_int(r, 0, 9);
    Vec3 edge = vec(0, angle < M_PI ? 1 : -1, 0);
    if (which < 5) edge = on_circle(cos(angle), sin(angle), quarter(r));
    else if (which < 9) edge = on_circle(1, 0, angle);
    return (Seam){ edge, vec_scale(vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1)), inner) };
}

static Seam seam_of_torus(TestRandom *r)
{
    double round = any_angle(r), tube = any_angle(r);
    if (test_int(r, 0, 1)) round = quarter(r); else tube = quarter(r);
    return (Seam){ on_circle(1 + .375 * cos(tube), .375 * sin(tube), round),
                   on_circle(1 + test_range(r, -.1, .1), test_range(r, -.1, .1), round + test_range(r, -.05, .05)) };
}

/* Edges of the box, and both rims of the bore. */
static Seam seam_of_plate(TestRandom *r)
{
    double side[3];
    for (int i = 0; i < 3; i++) side[i] = test_int(r, 0, 1) ? 1 : -1;
    if (test_int(r, 0, 1)) {
        double angle = any_angle(r), c = cos(angle), s = sin(angle), deep = .25 + test_range(r, .05, .2);
        return (Seam){ vec(.1 + .25 * c, side[1] * PLATE.y, -.05 + .25 * s), vec(.1 + deep * c, 0, -.05 + deep * s) };
    }
    int along = test_int(r, 0, 2);
    side[along] = test_range(r, -1, 1);
    Vec3 edge = vec_mul(vec(side[0], side[1], side[2]), PLATE);
    return (Seam){ edge, vec_scale(edge, .96) };
}

/* Where the side goes over into the foot, and the foot into the bottom; the seam of the inside. */
static Seam seam_of_vessel(TestRandom *r)
{
    double angle = any_angle(r);
    return test_int(r, 0, 1) ? (Seam){ on_circle(1.42, .12, angle), on_circle(1.36, .2, angle) }
                             : (Seam){ on_circle(1.38, 0, angle), on_circle(1.34, .12, angle) };
}

/* ---- the solids ---- */

typedef struct {
    const char *name, *text;
    double reach;                      /* of a ball round the origin that holds it */
    bool (*is_inside)(Vec3 p);         /* NULL: rays come from outside */
    Seam (*seam)(TestRandom *r);       /* NULL: all its seams are those of its one surface */
    bool counts_at_seams;              /* they lie within one surface: the ray that meets one crosses it once */
} Closed;

#define INCLUDE "#version 3.7; #include \"nurbs.inc\" "
#define FACE(ORIGIN, U, V, HALF_U, HALF_V, MORE) " trimmed_nurbs { Nurbs_Planar(" ORIGIN ", " U ", " V ", <-1, -1>, <1, 1>)"\
    " Trim_Rectangle(-<" HALF_U ", " HALF_V ">, <" HALF_U ", " HALF_V ">, NURBS_REGION) " MORE " }"
#define BORED "Trim_Outline(Bore, NURBS_HOLE)"

static const Closed solids[] = {
    { "sphere", INCLUDE "trimmed_nurbs { Nurbs_Sphere(1) }", 1, is_in_sphere, seam_of_sphere, true },
    { "torus", INCLUDE "trimmed_nurbs { Nurbs_Torus(1, .375) }", 1.375, is_in_torus, seam_of_torus, true },
    { "plate", INCLUDE "#declare Bore = Outline_Circle(<.1, -.05>, .25); union {"
               FACE("-.3*y", "x", "z", ".7", ".6", BORED) FACE(".3*y", "x", "z", ".7", ".6", BORED)
               FACE("-.6*z", "x", "y", ".7", ".3", "") FACE(".6*z", "x", "y", ".7", ".3", "")
               FACE("-.7*x", "z", "y", ".6", ".3", "") FACE(".7*x", "z", "y", ".6", ".3", "")
               " trimmed_nurbs { Nurbs_Wall(Bore, -.3*y, x, z, .6*y) } }", 1, is_in_plate, seam_of_plate, false },
    { "goblet", "#version 3.7; #include \"goblet.inc\" object { Goblet }", 3.5, NULL, NULL, true },
    { "teapot's vessel", "#version 3.7; #include \"teapot_solid.inc\" union {"
               " trimmed_nurbs { Nurbs_Revolution(Ts_Body_Knots, Ts_Body_Points, 360) rotate 45*y }"
               " trimmed_nurbs { Nurbs_Revolution(Curve_Knots(3, 3), Ts_Foot, 360) }"
               " trimmed_nurbs { Nurbs_Disc(<0, 0, 0>, y, 0, 1.38) } }", 3.3, NULL, seam_of_vessel, false },
};
#define N_SOLIDS ((int)(sizeof solids / sizeof *solids))

typedef struct { Read read; Xform turn; const Object *object; Trace trace; } Model;

static Model read_solid(const Closed *c)
{
    static const char *const paths[] = { "../scenes" };
    Model m = { .trace = { .scratch = arena_new() }, .turn = xform_rotate(vec(20, 30, 40)) };
    m.read = read_bytes(c->text, strlen(c->text), (ParseOptions){
        .image_width = 4, .image_height = 4, .library_paths = paths, .n_library_paths = 1,
        .nurbs = { .method = NURBS_METHOD_CERTAIN } });
    CHECK(m.read.is_ok && m.read.scene->n_objects == 1, "%s\n%s", c->text, m.read.messages);
    object_transform(m.read.scene->objects[0], &m.turn);     /* no seam lies along an axis of the rays */
    scene_prepare(m.read.scene);
    m.object = m.read.scene->objects[0];
    return m;
}

static void model_done(Model *m)
{
    arena_free(m->trace.scratch);
    read_done(&m->read);
}

/* The hits of a ray that is given where the solid was written; the nearest. */
static size_t count_hits(Model *m, Vec3 from, Vec3 to, double *nearest)
{
    Ray ray = { .origin = xform_point(&m->turn, from), .dir = vec_normalize(xform_vector(&m->turn, vec_sub(to, from))) };
    ArenaMark mark = arena_mark(m->trace.scratch);
    HitList list = hit_list_make(m->trace.scratch, INFINITY);
    shape_all_hits(&m->object->shape, &ray, &list, &m->trace);
    size_t n = list.n;
    *nearest = n ? list.hits[0].t : INFINITY;
    arena_reset(m->trace.scratch, mark);
    return n;
}

static Vec3 in_ball(TestRandom *r, double radius)
{
    for (;;) {
        Vec3 p = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
        if (vec_length2(p) <= 1 && vec_length2(p) > 0) return vec_scale(p, radius);
    }
}

/* ---- the tests ---- */

static void rays_cross_a_closed_solid_an_even_number_of_times(void **state)
{
    (void)state;
    for (int i = 0; i < N_SOLIDS; i++) {
        const Closed *c = &solids[i];
        Model m = read_solid(c);
        TestRandom random = test_random(100 + (uint64_t)i);
        long n_odd = 0, n_hits = 0;
        double nearest;
        for (long ray = 0; ray < n_rays; ray++) {
            Vec3 from = in_ball(&random, 1.5 * c->reach), to = in_ball(&random, c->reach);
            if (!c->is_inside) from = vec_scale(vec_normalize(from), 2 * c->reach);
            size_t n = count_hits(&m, from, to, &nearest);
            n_hits += (long)n;
            n_odd += (n & 1) != (c->is_inside && c->is_inside(from));
        }
        CHECK(n_odd == 0, "%s: %ld of %ld rays", c->name, n_odd, n_rays);
        CHECK(n_hits > n_rays / 4, "%s: %ld hits", c->name, n_hits);
        model_done(&m);
    }
}

/* A ray from beyond the seam to the point inside. Its own line misses the seam by some units in the last place; leaning by
 * no less than a tenth, it meets the surface within a few more. */
static void no_ray_slips_in_through_a_seam(void **state)
{
    (void)state;
    for (int i = 0; i < N_SOLIDS; i++) {
        const Closed *c = &solids[i];
        if (!c->seam) continue;
        Model m = read_solid(c);
        TestRandom random = test_random(200 + (uint64_t)i);
        long n_leaks = 0, n_odd = 0;
        for (long ray = 0; ray < n_rays; ray++) {
            Seam s = c->seam(&random);
            Vec3 out = vec_sub(s.edge, s.inner);
            double nearest, expected = .25 * vec_length(out);
            size_t n = count_hits(&m, vec_add(s.edge, vec_scale(out, .25)), s.inner, &nearest);
            n_leaks += !(fabs(nearest - expected) <= 1024 * 0x1p-53 * c->reach);
            n_odd += c->counts_at_seams && (n & 1);
        }
        CHECK(n_leaks == 0, "%s: %ld of %ld rays", c->name, n_leaks, n_rays);
        CHECK(n_odd == 0, "%s: %ld of %ld rays crossed the seam twice", c->name, n_odd, n_rays);
        model_done(&m);
    }
}

int main(int argc, char **argv)
{
    const char *folder = getenv("TRIMRAY_TESTS_DIR");
    if (!folder || chdir(folder) != 0) return fprintf(stderr, "set TRIMRAY_TESTS_DIR to the folder tests\n"), 1;
    if (argc > 1) n_rays = atol(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_cross_a_closed_solid_an_even_number_of_times),
        cmocka_unit_test(no_ray_slips_in_through_a_seam),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
