/* What the parser makes of scenes: tests/ok must be read without a word, tests/bad with exactly the words that stand beside
 * them, and small scenes must build what POV-Ray's rules, or plain geometry, say. */
#include "nurbs/nurbs.h"
#include "parser/parser.h"
#include "render/hit.h"
#include "tests/test.h"

#include <glob.h>
#include <string.h>
#include <unistd.h>

/* ---- reading ---- */

typedef struct {
    Arena *arena;
    Diag *diag;
    Scene *scene;
    ParseSummary summary;
    bool is_ok;
} Reading;

static Reading read_file(const char *path)
{
    Reading r = { .arena = arena_new() };
    ParseOptions options = { .image_width = 320, .image_height = 240, .quality = 9 };
    r.diag = diag_new(r.arena);
    r.scene = scene_new(r.arena);
    r.is_ok = parse_scene(path, &options, r.arena, r.diag, r.scene, &r.summary);
    return r;
}

static void done(Reading *r)
{
    scene_release(r->scene);
    arena_free(r->arena);
}

/* All messages, each with its source line and caret, as they are printed. */
static char *messages_of(const Reading *r)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    diag_print(r->diag, out);
    fclose(out);
    return text;
}

static Reading read_text_quietly(const char *text)
{
    char path[] = "/tmp/trimray-test-XXXXXX.pov";
    int file = mkstemps(path, 4);
    CHECK(file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text), "%s", path);
    close(file);
    Reading r = read_file(path);
    unlink(path);
    return r;
}

/* A scene that must be read without a message. */
static Reading read_text(const char *text)
{
    Reading r = read_text_quietly(text);
    char *messages = messages_of(&r);
    CHECK(r.is_ok && messages[0] == '\0', "%s\n%s", text, messages);
    free(messages);
    return r;
}

/* ---- looking ---- */

/* The nearest hit of a ray, with the scene prepared on first use. */
static bool look(Reading *r, Vec3 from, Vec3 to, Hit *hit)
{
    Trace t = { .scratch = arena_new() };
    Ray ray = { .origin = from, .dir = vec_sub(to, from) };
    *hit = (Hit){ .t = INFINITY };
    if (!r->scene->tree) scene_prepare(r->scene);
    bool is_hit = scene_hit(r->scene, &ray, RAY_CAMERA, hit, &t);
    arena_free(t.scratch);
    return is_hit;
}

/* The z of the nearest point on the line through (x, y), seen from z = -100; INFINITY: none. */
static double depth_at(Reading *r, double x, double y)
{
    Hit h;
    return look(r, vec(x, y, -100), vec(x, y, -99), &h) ? h.t - 100 : INFINITY;
}

static const Texture *texture_of(const Reading *r, size_t i) { return r->scene->objects[i]->texture; }
static const Layer *top_layer(const Texture *t) { return &t->layers[t->n_layers - 1]; }
static Color solid_color(const Layer *l) { return pigment_color(l->pigment, vec(.1, .2, .3), vec2(0, 0)); }

static void check_vec(Vec3 a, Vec3 b, const char *what)
{
    CHECK_WITHIN(vec_length(vec_sub(a, b)), 1e-12 * (1 + vec_length(b)), "%s: %g %g %g", what, a.x, a.y, a.z);
}

static void check_color(Color a, double red, double green, double blue, const char *what)
{
    double off = fabs(a.r - red) + fabs(a.g - green) + fabs(a.b - blue);
    CHECK_WITHIN(off, 1e-6, "%s: %g %g %g", what, a.r, a.g, a.b);
}

/* ---- files ---- */

static void each_good_scene_is_read_without_a_message(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob("ok/*.pov", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        Reading r = read_file(found.gl_pathv[i]);
        char *messages = messages_of(&r);
        CHECK(r.is_ok && messages[0] == '\0', "%s", messages);
        CHECK(r.scene->n_objects > 0, "%s", found.gl_pathv[i]);
        free(messages);
        done(&r);
    }
    globfree(&found);
}

/* The messages alone: the source lines and carets under them are indented. */
static void keep_messages(char *text)
{
    char *to = text;
    for (char *line = text; *line;) {
        char *end = strchr(line, '\n');
        size_t n = end ? (size_t)(end - line) + 1 : strlen(line);
        if (*line != ' ') memmove(to, line, n), to += n;
        line += n;
    }
    *to = '\0';
}

static char *read_whole(const char *path)
{
    char *text = NULL;
    size_t size = 0;
    FILE *in = fopen(path, "r"), *out = open_memstream(&text, &size);
    CHECK(in != NULL, "%s", path);
    for (int c; (c = getc(in)) != EOF;) putc(c, out);
    fclose(in);
    fclose(out);
    return text;
}

static void check_messages(const char *path)
{
    char expect[256];
    snprintf(expect, sizeof expect, "%.*s.expect", (int)strlen(path) - 4, path);
    Reading r = read_file(path);
    char *found = messages_of(&r), *expected = read_whole(expect);
    keep_messages(found);
    keep_messages(expected);
    CHECK(!r.is_ok, "%s", path);
    CHECK(strcmp(found, expected) == 0, "%s\n--- found\n%s--- expected\n%s", path, found, expected);
    free(found);
    free(expected);
    done(&r);
}

static void each_bad_scene_gives_its_messages(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob("bad/*.pov", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) check_messages(found.gl_pathv[i]);
    globfree(&found);
}

/* ---- objects ---- */

static void transformations_act_in_the_order_they_are_written(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; sphere { 0, 1 translate 3*x scale 2 }"              /* centre <6, 0, 0>, radius 2 */
                          "sphere { 0, 1 scale 2 translate -6*x }"                           /* <-6, 0, 0>, radius 2 */
                          "sphere { 0, 1 translate 5*x rotate 90*z }"                        /* <0, 5, 0> */
                          "sphere { 0, 1 matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -5, 7> }");   /* <0, -5, 7> */
    CHECK_WITHIN(fabs(depth_at(&r, 6, 0) + 2), 1e-9, "scaled after");
    CHECK_WITHIN(fabs(depth_at(&r, -6, 0) + 2), 1e-9, "scaled before");
    CHECK_WITHIN(fabs(depth_at(&r, 0, 5) + 1), 1e-9, "rotated");
    CHECK_WITHIN(fabs(depth_at(&r, 0, -5) - 6), 1e-9, "matrix");
    assert_true(isinf(depth_at(&r, 0, 0)));
    done(&r);
}

static void an_inverted_transform_undoes_the_declared_one(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare M = transform { scale 2 rotate <10, 20, 30> translate <1, 2, 3> }"
                          "sphere { <4, 0, 0>, 1 transform M transform { M inverse } }"
                          "sphere { <-4, 0, 0>, 1 transform { M translate x"
                          " transform { M translate x inverse } inverse } }");
    CHECK_WITHIN(fabs(depth_at(&r, 4, 0) + 1), 1e-9, "M and back");
    CHECK_WITHIN(fabs(depth_at(&r, -4, 0) + 1), 1e-9, "nested");
    done(&r);
}

static void every_primitive_stands_where_it_is_put(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; sphere { <0, 0, 0>, 1 } box { <9, -1, -3>, <11, 1, -1> }"
                          "cylinder { <20, -1, 0>, <20, 1, 0>, .5 } cone { <30, 0, 0>, 2, <30, 2, 0>, 0 }"
                          "torus { 2, .5 rotate 90*x translate 40*x } disc { <50, 0, 4>, z, 2, 1 }"
                          "triangle { <59, -1, 1>, <61, -1, 1>, <60, 1, 1> }"
                          "smooth_triangle { <69, -1, 2>, -z, <71, -1, 2>, -z, <70, 1, 2>, -z } plane { z, 5 }");
    const double expected[8] = { -1, -3, -.5, -1, 5, 5, 1, 2 };   /* the cone at half its height; through torus and disc */
    for (int i = 0; i < 8; i++)
        CHECK_WITHIN(fabs(depth_at(&r, 10 * i, i == 3 ? 1 : 0) - expected[i]), 1e-9, "object %d", i);
    CHECK_WITHIN(fabs(depth_at(&r, 42, 0) + .5), 1e-9, "torus");
    CHECK_WITHIN(fabs(depth_at(&r, 51.5, 0) - 4), 1e-9, "disc");
    assert_int_equal(r.summary.n_objects, 9);
    done(&r);
}

static void a_copy_is_changed_and_the_original_stays(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare Ball = sphere { 0, 1 pigment { rgb x } }"
                          "object { Ball translate 5*x pigment { rgb y } } object { Ball }");
    CHECK_WITHIN(fabs(depth_at(&r, 5, 0) + 1), 1e-9, "copy");
    CHECK_WITHIN(fabs(depth_at(&r, 0, 0) + 1), 1e-9, "original");
    check_color(solid_color(top_layer(texture_of(&r, 0))), 0, 1, 0, "copy");
    check_color(solid_color(top_layer(texture_of(&r, 1))), 1, 0, 0, "original");
    done(&r);
}

static void parts_of_a_union_keep_their_places_and_textures(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; union { sphere { 0, 1 } union { sphere { 5*x, 1 } translate 5*x }"
                          " sphere { -5*x, 1 pigment { rgb x } no_shadow } pigment { rgb y } translate y }");
    CHECK_WITHIN(fabs(depth_at(&r, 10, 1) + 1), 1e-9, "nested");
    Hit h;
    assert_true(look(&r, vec(-5, 1, -9), vec(-5, 1, -8), &h));
    check_color(solid_color(top_layer(hit_textured_object(&h)->texture)), 1, 0, 0, "own");
    assert_true(hit_has_flag_no_shadow(&h));
    assert_true(look(&r, vec(0, 1, -9), vec(0, 1, -8), &h));
    check_color(solid_color(top_layer(hit_textured_object(&h)->texture)), 0, 1, 0, "inherited");
    assert_false(hit_has_flag_no_shadow(&h));
    done(&r);
}

static void modifiers_set_their_flags(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; sphere { 0, 1 uv_mapping no_shadow no_image no_reflection inverse hollow"
                          " double_illuminate } sphere { 0, 1 hollow off inverse inverse }"
                          "sphere { 0, 1 interior { ior 1.5 fade_distance 2 fade_power 3 fade_color rgb x caustics .5 } }");
    const Object *o = r.scene->objects[0], *plain = r.scene->objects[1];
    assert_true(o->has_uv_mapping && o->no_shadow && o->no_image && o->no_reflection && o->is_inverse && o->is_hollow);
    assert_true(o->double_illuminate);
    assert_false(plain->is_hollow || plain->is_inverse || plain->no_shadow);
    const Interior *in = r.scene->objects[2]->interior;
    assert_true(in->ior == 1.5f && in->fade_distance == 2 && in->fade_power == 3 && in->caustics == .5f);
    check_color(in->fade_color, 1, 0, 0, "fade_color");
    done(&r);
}

/* ---- textures ---- */

static void a_texture_on_a_texture_is_a_layer_on_top(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare Ball = sphere { 0, 1 texture { pigment { rgb x } } }"
                          "#declare Two = texture { pigment { rgb x } } texture { pigment { rgb y } }"
                          "object { Ball texture { pigment { rgb z } } } object { Ball pigment { rgb z } }"
                          "sphere { 0, 1 texture { Two } } sphere { 0, 1 texture { Two pigment { rgb z } } }");
    const int n_layers[4] = { 2, 1, 2, 2 };
    for (size_t i = 0; i < 4; i++) assert_int_equal(texture_of(&r, i)->n_layers, n_layers[i]);
    for (size_t i = 0; i < 4; i++) {
        bool is_green = i == 2;
        check_color(solid_color(top_layer(texture_of(&r, i))), 0, is_green, !is_green, "top");
    }
    check_color(solid_color(&texture_of(&r, 0)->layers[0]), 1, 0, 0, "below");
    done(&r);
}

/* The colour at a point of the world of what lies there. */
static Color color_there(Reading *r, double x, double y)
{
    Hit h;
    CHECK(look(r, vec(x, y, -100), vec(x, y, -99), &h), "%g %g", x, y);
    const Object *o = hit_textured_object(&h);
    Vec3 world = vec(x, y, h.t - 100);
    return pigment_color(top_layer(o->texture)->pigment, hit_texture_point(&h, world), vec2(0, 0));
}

static void a_texture_moves_with_what_stands_after_it(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare Check = pigment { checker rgb x rgb y }"
                          "box { 0, <1, 1, 1> pigment { Check } translate 2.5*x }"             /* red from 2.5 to 3.5 */
                          "box { 0, <1, 1, 1> translate 5.5*x pigment { Check } }"             /* changes at 6 */
                          "box { 0, <1, 1, 1> pigment { Check scale .5 translate .5*x } translate 10.5*x }"
                          "object { box { 0, 1 pigment { Check } translate 20.5*x } finish { phong 1 } }");
    check_color(color_there(&r, 2.6, .5), 1, 0, 0, "before");
    check_color(color_there(&r, 3.4, .5), 1, 0, 0, "before");
    check_color(color_there(&r, 5.9, .5), 0, 1, 0, "after: 5 + 0 + 0 is odd");
    check_color(color_there(&r, 6.1, .5), 1, 0, 0, "after: 6 + 0 + 0 is even");
    check_color(color_there(&r, 10.6, .1), 0, 1, 0, "inside: floor -1, 0, 0");
    check_color(color_there(&r, 11.1, .1), 1, 0, 0, "inside: floor 0, 0, 0");
    check_color(color_there(&r, 20.6, .5), 1, 0, 0, "through object");
    check_color(color_there(&r, 21.4, .5), 1, 0, 0, "through object");
    done(&r);
}

/* Measured with POV-Ray 3.7: a pigment or finish starts from the one that it replaces, transformations too. */
static void pigments_and_finishes_start_from_what_was_there(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare T = texture { pigment { checker rgb x rgb y scale 10 translate 5.5 }"
                          " finish { ambient .3 emission .2 } }"
                          "plane { z, .5 texture { T pigment { checker rgb z rgb y } finish { emission .1 } }"
                          " translate <.5, .5, 0> }");
    const Finish *f = &top_layer(texture_of(&r, 0))->finish;
    CHECK_WITHIN(fabs(f->ambient.r - .3) + fabs(f->emission.g - .1), 1e-6, "ambient stays");
    check_color(color_there(&r, 0, 0), 0, 1, 0, "floor of -.6, -.6, -.5: odd");
    done(&r);
}

static void maps_and_waves_are_read(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare Map = color_map { [0 rgb 0] [1 rgb x] }"
                          "box { 0, <2, 1, 1> pigment { gradient 5*x color_map { Map } } }"
                          "box { <10, 0, 0>, <11, 1, 1> pigment { gradient x frequency 2 triangle_wave color_map { Map } } }"
                          "box { <20, 0, 0>, <21, 1, 1> pigment { gradient x color_map { [0, .5 color rgb x color rgb y]"
                          " [.5 1 rgb y rgb z] } } }"
                          "box { <30, 0, 0>, <31, 1, 1> pigment { gradient x pigment_map { [0 checker rgb 1 rgb 0]"
                          " [1 color rgb y] } } }");
    check_color(color_there(&r, .25, .5), .25, 0, 0, "ramp");
    check_color(color_there(&r, 1.25, .5), .25, 0, 0, "the ramp's second period");
    check_color(color_there(&r, 10.125, .5), .5, 0, 0, "triangle: a quarter of a period up");
    check_color(color_there(&r, 10.375, .5), .5, 0, 0, "triangle: a quarter of a period down");
    check_color(color_there(&r, 20.25, .5), .5, .5, 0, "two keys in an entry");
    check_color(color_there(&r, 20.75, .5), 0, .5, .5, "two keys in an entry");
    check_color(color_there(&r, 30.25, .5), .75, 1, .75, "a pigment_map blends pigments");
    done(&r);
}

static void finishes_are_read(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; sphere { 0, 1 finish { ambient rgb <.1, .2, .3> diffuse albedo .5, .25 brilliance 2"
                          " phong .3 phong_size 80 specular albedo .4 roughness .01 metallic conserve_energy"
                          " reflection { .1, rgb <.7, .8, .9> falloff 2 exponent 1.5 metallic .5 } } }"
                          "sphere { 0, 1 finish { reflection { .9 fresnel } } } sphere { 0, 1 finish { reflection .4 } }"
                          "sphere { 0, 1 finish { ambient <.3, .4, .5> reflection 0 } }");
    const Finish *f = &top_layer(texture_of(&r, 0))->finish;
    CHECK_WITHIN(fabs(f->ambient.r - .1) + fabs(f->ambient.b - .3), 1e-6, "ambient");
    assert_true(f->diffuse_albedo && f->diffuse == .5 && f->diffuse_back == .25 && f->brilliance == 2);
    assert_true(!f->phong_albedo && f->phong == .3 && f->phong_size == 80);
    assert_true(f->specular_albedo && f->specular == .4 && f->roughness == .01 && f->metallic == 1 && f->conserve_energy);
    assert_true(f->has_reflection && f->reflection_falloff == 2 && f->reflection_exponent == 1.5);
    assert_true(f->reflection_metallic == .5 && !f->reflection_fresnel);
    CHECK_WITHIN(fabs(f->reflection_min.b - .1) + fabs(f->reflection_max.b - .9), 1e-6, "two colours");
    f = &top_layer(texture_of(&r, 1))->finish;
    assert_true(f->reflection_fresnel && f->reflection_min.r == 0);
    CHECK_WITHIN(fabs(f->reflection_max.r - .9), 1e-6, "one colour is the larger");
    f = &top_layer(texture_of(&r, 2))->finish;
    CHECK_WITHIN(fabs(f->reflection_min.r - .4) + fabs(f->reflection_max.r - .4), 1e-6, "one colour is both");
    f = &top_layer(texture_of(&r, 3))->finish;
    CHECK_WITHIN(fabs(f->ambient.g - .4), 1e-6, "a vector is a colour here");
    assert_false(f->has_reflection);
    done(&r);
}

static void the_default_texture_is_that_of_the_place_in_the_file(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; sphere { 0, 1 } #default { texture { pigment { rgb x } finish { phong .5 } } }"
                          "sphere { 0, 1 } sphere { 0, 1 pigment { rgb y } } #default { finish { ambient .7 } }"
                          "sphere { 0, 1 }");
    const double red[4] = { 0, 1, 0, 1 }, green[4] = { 0, 0, 1, 0 };
    const double phong[4] = { 0, .5, .5, .5 }, ambient[4] = { .1, .1, .1, .7 };
    for (size_t i = 0; i < 4; i++) {
        const Layer *l = top_layer(texture_of(&r, i));
        check_color(solid_color(l), red[i], green[i], 0, "pigment");
        assert_true(l->finish.phong == phong[i]);
        CHECK_WITHIN(fabs(l->finish.ambient.r - ambient[i]), 1e-6, "ambient of %zu", i);
    }
    done(&r);
}

static void what_is_mapped_by_uv_does_not_move_with_the_object(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare P = pigment { uv_mapping gradient x }"
                          "sphere { 0, 1 pigment { P } translate 7*x texture { pigment { gradient x } } }");
    const Texture *t = texture_of(&r, 0);
    Vec3 nowhere = vec(.9, .9, .9);
    check_color(pigment_color(t->layers[0].pigment, nowhere, vec2(.25, .5)), .25, .25, .25, "by uv");
    check_color(pigment_color(t->layers[1].pigment, nowhere, vec2(.25, .5)), .9, .9, .9, "by place");
    done(&r);
}

static void a_default_texture_does_not_move(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #default { pigment { checker rgb x rgb y } } union { box { 0, 1 } translate .5*x }"
                          "box { 0, 1 pigment { checker rgb x rgb y } translate 2.5*x }");
    check_color(color_there(&r, .6, .5), 1, 0, 0, "default");
    check_color(color_there(&r, 1.4, .5), 0, 1, 0, "default");
    check_color(color_there(&r, 3.4, .5), 1, 0, 0, "own");
    done(&r);
}

/* ---- lights, camera, surroundings ---- */

static void transformations_of_a_light_act_on_what_stands_before(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; light_source { <1, 0, 0>, rgb <1, .5, .25> translate y spotlight point_at <2, 3, 4>"
                          " radius 10 falloff 20 tightness 3 area_light x, y, 3, 4 rotate 90*z adaptive 2 circular orient"
                          " fade_distance 6 fade_power 2 } #declare L = light_source { x, 1 } light_source { L translate y }"
                          "light_source { 0, .5 cylinder parallel shadowless } light_source { 0, <1, .5, 0> }"
                          "sphere { 0, 1 }");
    const Light *l = r.scene->lights;
    assert_int_equal(r.scene->n_lights, 4);
    assert_int_equal(r.summary.n_lights, 4);
    check_vec(l->position, vec(-1, 1, 0), "position");
    check_vec(l->point_at, vec(-3, 2, 4), "point_at");
    check_vec(l->area_u, vec(0, 1, 0), "area_u");
    check_vec(l->area_v, vec(-1, 0, 0), "area_v");
    assert_true(l->kind == LIGHT_SPOT && l->radius == 10 && l->falloff == 20 && l->tightness == 3 && l->is_area);
    assert_true(l->area_n_u == 3 && l->area_n_v == 4 && l->area_adaptive == 2 && l->area_circular && l->area_orient);
    assert_true(l->fade_distance == 6 && l->fade_power == 2 && l->color.g == .5 && l->color.b == .25);
    check_vec(l[1].position, vec(1, 1, 0), "declared");
    assert_true(l[2].kind == LIGHT_CYLINDER && l[2].radius == .75 && l[2].falloff == 1 && l[2].is_parallel);
    assert_true(l[2].is_shadowless && l[2].color.r == .5);
    CHECK_WITHIN(fabs(l[3].color.g - .5) + fabs(l[3].color.b), 1e-6, "a vector is a colour here");
    done(&r);
}

static void cameras_are_made_by_the_rules(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; sphere { 0, 1 } #declare C = camera { right 2*x angle 90 location -5*z look_at 0 }"
                          "camera { C rotate 90*y translate <1, 2, 3> }");
    const Camera *c = &r.scene->camera;
    check_vec(c->location, vec(-4, 2, 3), "location: -z turned about y, left-handed, is -x");
    check_vec(c->direction, vec(1, 0, 0), "direction: |right| / (2 tan 45)");
    check_vec(c->right, vec(0, 0, -2), "right");
    check_vec(c->up, vec(0, 1, 0), "up");
    assert_int_equal(r.summary.n_cameras, 1);
    done(&r);
}

static void surroundings_are_read(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; global_settings { assumed_gamma 2.2 max_trace_level 9 adc_bailout .02"
                          " ambient_light rgb <1, .5, .25> } background { rgb <.5, .25, 1> } sphere { 0, 1 }"
                          "sky_sphere { pigment { rgb x } pigment { rgb y } rotate 90*z }"
                          "fog { distance 5 color rgb .5 } fog { fog_type 2 distance 3 fog_offset 1 fog_alt 2"
                          " rgbt <1, 0, 0, .5> }");
    const Scene *s = r.scene;
    assert_true(s->gamma == GAMMA_POWER && s->gamma_power == 2.2 && s->max_trace_level == 9 && s->adc_bailout == .02);
    assert_true(s->ambient_light.g == .5 && s->ambient_light.b == .25);
    check_color(s->background, .5, .25, 1, "background");
    assert_int_equal(s->sky->n_pigments, 2);
    check_color(s->sky->pigments[1]->color, 0, 1, 0, "sky");
    check_vec(xform_point(&s->sky->space, vec(1, 0, 0)), vec(0, 1, 0), "sky");
    assert_int_equal(s->n_fogs, 2);
    assert_true(s->fogs[0].type == 1 && s->fogs[0].distance == 5 && s->fogs[1].type == 2 && s->fogs[1].distance == 3);
    assert_true(s->fogs[1].offset == 1 && s->fogs[1].altitude == 2 && s->fogs[1].color.transmit == .5f);
    done(&r);
}

static void gamma_follows_the_version_where_it_is_not_given(void **state)
{
    (void)state;
    static const struct { const char *text; GammaKind gamma; double power; } cases[] = {
        { "sphere { 0, 1 }", GAMMA_NONE, 0 },
        { "#version 3.6; sphere { 0, 1 }", GAMMA_NONE, 0 },
        { "#version 3.7; sphere { 0, 1 }", GAMMA_POWER, 1 },
        { "#version 3.6; global_settings { assumed_gamma 1.5 } sphere { 0, 1 }", GAMMA_POWER, 1.5 },
        { "global_settings { assumed_gamma srgb } sphere { 0, 1 }", GAMMA_SRGB, 0 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Reading r = read_text(cases[i].text);
        CHECK(r.scene->gamma == cases[i].gamma && r.scene->gamma_power == cases[i].power, "%s", cases[i].text);
        done(&r);
    }
}

/* ---- surfaces ---- */

static Vec3 point_of(const Reading *r, size_t i, double u, double v)
{
    Vec3 s, s_u, s_v;
    CHECK(nurbs_shape_point(r->scene->objects[i]->child, u, v, &s, &s_u, &s_v), "object %zu is no NURBS", i);
    return s;
}

#define SQUARE "order 2, 2 knots_u { 0, 0, 1, 1 } knots_v { 0, 0, 1, 1 } points 2, 2 { <0, 0, 0>, x, y, <1, 1, 0> } "

static void points_of_a_surface_run_along_u_first(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; trimmed_nurbs < order 2, 3 knots_u { 0, 0, 2, 2 } knots_v { 0, 0, 0, 1, 1, 1 }"
                          " points 2, 3 { <0, 0, 0>, <1, 0, 0>, <0, 1, 0, 2>, <1, 1, 1, 2>, <0, 2, 0>, <1, 2, 0> } >"
                          "trimmed_nurbs { points 2, 3 { <0, 0, 0> <1, 0, 0> <0, 1, 0, 2> <1, 1, 1, 2> <0, 2, 0> <1, 2, 0> }"
                          " degree 1, 2 knots_v { 0 0 0 1 1 1 } knots_u { 0 0 2 2 } }"
                          "nurbs { 2, 3, 2, 3, 0, 0, 2, 2, 0, 0, 0, 1, 1, 1, <0, 0, 0, 1>, <1, 0, 0, 1>, <0, 1, 0, 2>,"
                          " <1, 1, 1, 2>, <0, 2, 0, 1>, <1, 2, 0, 1> }");
    for (size_t i = 0; i < 3; i++) {
        check_vec(point_of(&r, i, 2, 0), vec(1, 0, 0), "end of u");
        check_vec(point_of(&r, i, 0, 1), vec(0, 2, 0), "end of v");
        /* rational quadratic at 1/2: weights 1/4, 2/4, 1/4 times 1, 2, 1 */
        check_vec(point_of(&r, i, 2, .5), vec(1, 1, 1 / 1.5), "middle of v");
    }
    assert_int_equal(r.summary.n_nurbs, 3);
    assert_int_equal(r.summary.n_control_points, 18);
    done(&r);
}

static void a_patch_runs_along_v_first(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3"
                          " #for (I, 0, 3) #for (J, 0, 3) <I, 10*J, I*J> #end #end }");
    check_vec(point_of(&r, 0, 1, 0), vec(3, 0, 0), "end of u");
    check_vec(point_of(&r, 0, 0, 1), vec(0, 30, 0), "end of v");
    check_vec(point_of(&r, 0, .5, .5), vec(1.5, 15, 2.25), "middle");
    assert_int_equal(r.summary.n_nurbs, 1);
    done(&r);
}

static void a_trim_cuts_or_keeps_as_its_direction_says(void **state)
{
    (void)state;
    static const char *const loops[2] = { "<.25, .25>, <.75, .25>, <.75, .75>, <.25, .75>",      /* counterclockwise */
                                          "<.25, .25>, <.25, .75>, <.75, .75>, <.75, .25>" };
    for (int clockwise = 0; clockwise < 2; clockwise++)
        for (int left = 0; left < 2; left++) {
            char text[512];
            snprintf(text, sizeof text, "#version 3.7; trimmed_nurbs < " SQUARE "trim { %s } %s >", loops[clockwise],
                     left ? "keep left" : clockwise ? "keep right" : "");
            Reading r = read_text(text);
            bool keeps_middle = clockwise != left;
            CHECK(isfinite(depth_at(&r, .5, .5)) == keeps_middle, "%s", text);
            CHECK(isfinite(depth_at(&r, .1, .1)) == !keeps_middle, "%s", text);
            assert_int_equal(r.summary.n_trims, 1);
            done(&r);
        }
}

/* A circle of radius .3 about (.5, .5) as four rational arcs, walked clockwise: kept inside. */
static void a_trim_of_curves_is_the_curve(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; #declare W = sqrt(.5); #macro Arc(A) #local P = vrotate(.3*x, -A*z);"
                          " #local Q = vrotate(<.3, -.3, 0>, -A*z); #local R = vrotate(-.3*y, -A*z);"
                          " curve { order 3 knots { 0, 0, 0, 1, 1, 1 } points 3 { <.5 + P.x, .5 + P.y>,"
                          " <.5 + Q.x, .5 + Q.y, W>, <.5 + R.x, .5 + R.y> } } #end "
                          "trimmed_nurbs < " SQUARE "trim { Arc(0) Arc(90) Arc(180) Arc(270) } pigment { rgb 1 } >");
    TestRandom random = test_random(7);
    for (int i = 0; i < 2000; i++) {
        double u = test_unit(&random), v = test_unit(&random), rho = hypot(u - .5, v - .5);
        if (fabs(rho - .3) < 1e-4) continue;   /* the chords of the flattened arc */
        CHECK(isfinite(depth_at(&r, u, v)) == (rho < .3), "%g %g", u, v);
    }
    done(&r);
}

static void modifiers_may_stand_in_the_block_of_a_surface(void **state)
{
    (void)state;
    Reading r = read_text("#version 3.7; trimmed_nurbs < " SQUARE "pigment { rgb x } translate <3, 0, 5> rotate <0, 0, 90> >"
                          "#declare S = trimmed_nurbs < " SQUARE ">; object { S translate <9, 0, 1> }");
    CHECK_WITHIN(fabs(depth_at(&r, -.5, 3.5) - 5), 1e-9, "moved, then turned");
    CHECK_WITHIN(fabs(depth_at(&r, 9.5, .5) - 1), 1e-9, "declared");
    done(&r);
}

static void one_bad_surface_gives_all_its_errors_and_the_next_statement_is_read(void **state)
{
    (void)state;
    Reading r = read_text_quietly("#version 3.7; union { trimmed_nurbs < order 1, 2 knots_u { 0, 1, 0, 2 }"
                                  " knots_v { 0, 0, 1 } points 2, 2 { x, <0, 0, 0, -1>, z } trim { <0, 0> } >"
                                  " trimmed_nurbs < > } sphere { 0, 1 }");
    assert_false(r.is_ok);
    assert_int_equal(diag_error_count(r.diag), 7);
    assert_int_equal(r.scene->n_objects, 2);
    done(&r);
}

/* The Utah teapot as POV-Ray's examples give it: Newell's 32 patches. */
static void the_teapot_of_povray_is_read(void **state)
{
    (void)state;
    static const char *const folder = "/usr/share/doc/povray/examples/advanced/teapot";
    if (access(folder, R_OK) != 0) {
        print_message("package povray-examples is not installed: left out\n");
        skip();
    }
    char text[256];
    snprintf(text, sizeof text, "#version 3.7; #declare Teapot_Texture = texture { pigment { rgb 1 } } "
             "#declare Teapot_Orientation = <-110, 20, 0>; #include \"%s/teapot.inc\"", folder);
    Reading r = read_text(text);
    assert_int_equal(r.summary.n_nurbs, 32);
    assert_int_equal(r.summary.n_control_points, 512);
    done(&r);
}

int main(void)
{
    const char *folder = getenv("TRIMRAY_TESTS_DIR");
    if (!folder || chdir(folder) != 0) return fprintf(stderr, "set TRIMRAY_TESTS_DIR to the folder tests\n"), 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_good_scene_is_read_without_a_message),
        cmocka_unit_test(each_bad_scene_gives_its_messages),
        cmocka_unit_test(transformations_act_in_the_order_they_are_written),
        cmocka_unit_test(an_inverted_transform_undoes_the_declared_one),
        cmocka_unit_test(every_primitive_stands_where_it_is_put),
        cmocka_unit_test(a_copy_is_changed_and_the_original_stays),
        cmocka_unit_test(parts_of_a_union_keep_their_places_and_textures),
        cmocka_unit_test(modifiers_set_their_flags),
        cmocka_unit_test(a_texture_on_a_texture_is_a_layer_on_top),
        cmocka_unit_test(a_texture_moves_with_what_stands_after_it),
        cmocka_unit_test(pigments_and_finishes_start_from_what_was_there),
        cmocka_unit_test(maps_and_waves_are_read),
        cmocka_unit_test(finishes_are_read),
        cmocka_unit_test(the_default_texture_is_that_of_the_place_in_the_file),
        cmocka_unit_test(what_is_mapped_by_uv_does_not_move_with_the_object),
        cmocka_unit_test(a_default_texture_does_not_move),
        cmocka_unit_test(transformations_of_a_light_act_on_what_stands_before),
        cmocka_unit_test(cameras_are_made_by_the_rules),
        cmocka_unit_test(surroundings_are_read),
        cmocka_unit_test(gamma_follows_the_version_where_it_is_not_given),
        cmocka_unit_test(points_of_a_surface_run_along_u_first),
        cmocka_unit_test(a_patch_runs_along_v_first),
        cmocka_unit_test(a_trim_cuts_or_keeps_as_its_direction_says),
        cmocka_unit_test(a_trim_of_curves_is_the_curve),
        cmocka_unit_test(modifiers_may_stand_in_the_block_of_a_surface),
        cmocka_unit_test(one_bad_surface_gives_all_its_errors_and_the_next_statement_is_read),
        cmocka_unit_test(the_teapot_of_povray_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
