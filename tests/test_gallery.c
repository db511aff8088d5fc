/* The scenes of the gallery, small: the same bytes from any number of threads, and the same picture at any scale. With a
 * number for an argument the pictures of the second test have that many pixels a side, and all scenes take part. */
#include "render/render.h"
#include "tests/scene_text.h"

static const char *const scenes[] = {
    "goblet", "teapot", "teapot_solid", "spoon", "pencil", "crank1a", "crank", "allblade", "still_life", "mechanical"
};
#define N_SCENES ((int)(sizeof scenes / sizeof *scenes))
static const char *const method_names[2] = { [NURBS_METHOD_PAPER] = "paper", [NURBS_METHOD_CERTAIN] = "certain" };

static int long_size;       /* 0: the short form */

static Read read_gallery(const char *text, int size, NurbsMethod method, double scale)
{
    static const char *const paths[] = { "../scenes" };
    const ParseDeclare declares[] = { { "Test_Scale", scale } };
    Read r = read_bytes(text, strlen(text), (ParseOptions){
        .image_width = size, .image_height = size, .quality = 9, .nurbs = { .method = method },
        .library_paths = paths, .n_library_paths = 1, .declares = declares, .n_declares = 1 });
    CHECK(r.is_ok, "%s\n%s", text, r.messages);
    return r;
}

static Read read_named(const char *scene, int size, NurbsMethod method)
{
    char text[64];
    snprintf(text, sizeof text, "#include \"%s.pov\"", scene);
    return read_gallery(text, size, method, 1);
}

static Film *picture(Scene *s, int size, int n_threads)
{
    RenderOptions o = render_options_default(size, size);
    o.n_threads = n_threads;
    o.block_size = 16;      /* enough tiles for all threads */
    Film *film = film_new(size, size);
    render_scene(s, &o, film);
    return film;
}

/* ---- threads ---- */

static void check_threads(const char *scene, NurbsMethod method)
{
    static const int n_threads[3] = { 5, 2, 1 };
    Film *films[3];
    Read first = read_named(scene, 64, method), again = read_named(scene, 64, method);
    scene_prepare(first.scene), scene_prepare(again.scene);
    films[0] = picture(first.scene, 64, n_threads[0]);      /* five threads prepare the surfaces, as they come to them */
    films[1] = picture(first.scene, 64, n_threads[1]);
    films[2] = picture(again.scene, 64, n_threads[2]);      /* one does */
    for (int i = 0; i < 2; i++)
        CHECK(memcmp(films[i]->pixels, films[2]->pixels, 64 * 64 * sizeof(FilmPixel)) == 0, "%s, %s, %d threads", scene,
              method_names[method], n_threads[i]);
    for (int i = 0; i < 3; i++) film_free(films[i]);
    read_done(&first);
    read_done(&again);
}

static void any_number_of_threads_gives_the_same_bytes(void **state)
{
    (void)state;
    for (int i = 0; i < N_SCENES; i++)
        for (int method = 0; method < 2; method++) check_threads(scenes[i], (NurbsMethod)method);
}

/* ---- scale ---- */

static void scale_lights_and_camera(Scene *s, double k)
{
    s->camera.location = vec_scale(s->camera.location, k);
    for (size_t i = 0; i < s->n_lights; i++) {
        Light *l = &s->lights[i];
        CHECK(l->kind == LIGHT_POINT && !l->is_area && !(l->fade_distance > 0), "light %zu has more to scale than its place", i);
        l->position = vec_scale(l->position, k);
    }
}

/* The scene with its objects enlarged k times from outside. */
static Read read_enlarged(const char *scene, int size, double k)
{
    Read r = read_named(scene, size, NURBS_METHOD_CERTAIN);
    Xform larger = xform_scale(vec(k, k, k));
    for (size_t i = 0; i < r.scene->n_objects; i++) object_transform(r.scene->objects[i], &larger);
    scale_lights_and_camera(r.scene, k);
    return r;
}

/* The scene with control points k times as large. For scenes whose first object is a plane, and whose others are made by
 * Nurbs_Surface and placed by nothing but rotations. */
static Read read_remade(const char *scene, int size, double k)
{
    char text[1024];
    snprintf(text, sizeof text,
             "#include \"nurbs.inc\"\n"
             "#macro Nurbs_Surface(Knots_U, Knots_V, Net)\n"
             "  #local N = dimension_size(Net, 2); #local M = dimension_size(Net, 1);\n"
             "  order dimension_size(Knots_U, 1) - N, dimension_size(Knots_V, 1) - M\n"
             "  knots_u { #for (I, 0, dimension_size(Knots_U, 1) - 1) Knots_U[I], #end }\n"
             "  knots_v { #for (I, 0, dimension_size(Knots_V, 1) - 1) Knots_V[I], #end }\n"
             "  points N, M { #for (J, 0, M - 1) #for (I, 0, N - 1)\n"
             "    Net[J][I] * <Test_Scale, Test_Scale, Test_Scale, 1>, #end #end }\n"
             "#end\n"
             "#include \"%s.pov\"", scene);
    Read r = read_gallery(text, size, NURBS_METHOD_CERTAIN, k);
    Xform larger = xform_scale(vec(k, k, k));
    CHECK(strcmp(r.scene->objects[0]->child->type->name, "plane") == 0, "%s begins with a plane", scene);
    object_transform(r.scene->objects[0], &larger);
    scale_lights_and_camera(r.scene, k);
    return r;
}

typedef Read (*ReadScaled)(const char *scene, int size, double k);

static Film *scaled_picture(ReadScaled read, const char *scene, int size, double k)
{
    Read r = read(scene, size, k);
    scene_prepare(r.scene);
    Film *film = picture(r.scene, size, 2);
    read_done(&r);
    return film;
}

static int worst_of_row(const Film *a, const Film *b, int y, const FilmCurve *curve, int *n_different)
{
    uint16_t rows[2][4 * 1024];
    int worst = 0;
    film_row(a, y, curve, false, rows[0]);
    film_row(b, y, curve, false, rows[1]);
    for (int x = 0; x < a->width; x++) {
        int off = 0;
        for (int c = 0; c < 3; c++) {
            int d = abs(rows[0][3 * x + c] - rows[1][3 * x + c]);
            off = d > off ? d : off;
        }
        *n_different += off > 0;
        worst = off > worst ? off : worst;
    }
    return worst;
}

/* At 1e-6 and 1e6 the samples of 8 bits are those at 1, but that one pixel in a thousand may be off by one: rounding, where
 * the value lies between two. */
static void check_scales(ReadScaled read, const char *what, const char *scene, int size)
{
    static const double scales[2] = { 1e-6, 1e6 };
    FilmCurve curve = film_curve(GAMMA_SRGB, 0, 255);
    Film *plain = scaled_picture(read, scene, size, 1);
    for (int i = 0; i < 2; i++) {
        Film *scaled = scaled_picture(read, scene, size, scales[i]);
        int worst = 0, n_different = 0;
        for (int y = 0; y < size; y++) {
            int off = worst_of_row(plain, scaled, y, &curve, &n_different);
            worst = off > worst ? off : worst;
        }
        bool is_same = worst <= 1 && n_different <= size * size / 1000;
        if (long_size || !is_same)
            print_message("%s %s, scale %g: %d pixels differ, by %d at most\n", scene, what, scales[i], n_different, worst);
        CHECK(is_same, "%s %s, scale %g", scene, what, scales[i]);
        film_free(scaled);
    }
    film_free(plain);
}

static void an_enlarged_scene_has_the_same_picture(void **state)
{
    (void)state;
    static const char *const few[] = { "goblet", "teapot", "crank1a", "still_life" };
    for (int i = 0; i < (long_size ? N_SCENES : 4); i++)
        check_scales(read_enlarged, "enlarged", long_size ? scenes[i] : few[i], long_size ? long_size : 96);
}

static void a_scene_of_larger_control_points_has_the_same_picture(void **state)
{
    (void)state;
    check_scales(read_remade, "remade", "goblet", long_size ? long_size : 96);
    check_scales(read_remade, "remade", "teapot_solid", long_size ? long_size : 96);
}

int main(int argc, char **argv)
{
    const char *folder = getenv("TRIMRAY_TESTS_DIR");
    if (!folder || chdir(folder) != 0) return fprintf(stderr, "set TRIMRAY_TESTS_DIR to the folder tests\n"), 1;
    if (argc > 1) long_size = atoi(argv[1]);
    if (argc > 1 && (long_size < 16 || long_size > 1024)) return fprintf(stderr, "a size from 16 to 1024\n"), 2;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_gives_the_same_bytes),
        cmocka_unit_test(an_enlarged_scene_has_the_same_picture),
        cmocka_unit_test(a_scene_of_larger_control_points_has_the_same_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
