/* The macros of scenes/nurbs.inc: what has a closed form, against the plain primitive along random rays; what interpolates,
 * against what it must pass through. */
#include "nurbs/nurbs.h"
#include "render/hit.h"
#include "tests/scene_text.h"

#define RAYS 2000

static Read read_macros(const char *body)
{
    static const char *const paths[] = { "../scenes" };
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fprintf(out, "#version 3.7; #include \"nurbs.inc\"\n%s", body);
    fclose(out);
    Read r = read_bytes(text, size, (ParseOptions){ .image_width = 4, .image_height = 4, .library_paths = paths,
                                                    .n_library_paths = 1, .nurbs = { .method = NURBS_METHOD_CERTAIN } });
    free(text);
    CHECK(r.is_ok && r.messages[0] == '\0', "%s\n%s", body, r.messages);
    scene_prepare(r.scene);
    return r;
}

/* ---- the plain primitive is the truth ---- */

/* From the sphere of radius 4 to somewhere in the box of +-1.3: what is looked at lies about there. */
static Ray any_ray(TestRandom *r)
{
    Vec3 from = vec(0, 0, 0);
    while (vec_length2(from) < .01 || vec_length2(from) > 1)
        from = vec(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1));
    from = vec_scale(vec_normalize(from), 4);
    Vec3 to = vec(test_range(r, -1.3, 1.3), test_range(r, -1.3, 1.3), test_range(r, -1.3, 1.3));
    return (Ray){ .origin = from, .dir = vec_normalize(vec_sub(to, from)) };
}

typedef struct { double t; Vec3 normal; } Seen;

static Seen look(const Read *r, const Ray *ray, Trace *t)
{
    Hit h = { .t = INFINITY };
    Attributes at = { .normal = vec(0, 0, 0) };
    if (scene_hit(r->scene, ray, RAY_CAMERA, &h, t)) hit_attributes(&h, ray, &at);
    return (Seen){ h.t, at.normal };
}

/* Both scenes hit and miss together; the points lie within the bound of each other's tangent plane, with the same line for a
 * normal. */
static void check_same_within(double bound, const char *macro, const char *plain)
{
    Read a = read_macros(macro), b = read_macros(plain);
    TestRandom random = test_random(11);
    Trace t = { .scratch = arena_new() };
    int n_hits = 0;
    for (int i = 0; i < RAYS; i++) {
        Ray ray = any_ray(&random);
        Seen seen = look(&a, &ray, &t), truth = look(&b, &ray, &t);
        CHECK(isfinite(seen.t) == isfinite(truth.t), "ray %d: %g, not %g: %s", i, seen.t, truth.t, macro);
        if (!isfinite(truth.t)) continue;
        n_hits++;
        CHECK_WITHIN(fabs((seen.t - truth.t) * vec_dot(truth.normal, ray.dir)), bound, "ray %d: %s", i, macro);
        CHECK_WITHIN(vec_length(vec_cross(seen.normal, truth.normal)), 1e-6, "normal of ray %d: %s", i, macro);
    }
    CHECK(n_hits > RAYS / 100, "%d hits: %s", n_hits, macro);
    arena_free(t.scratch);
    read_done(&a);
    read_done(&b);
}

/* Within the rounding of the macros' few operations: 64 units in the last place of the 4 that the rays come from. */
static void check_same(const char *macro, const char *plain) { check_same_within(64 * 4 * 0x1p-53, macro, plain); }

/* A surface, and the plain shape. */
static void check_surface(const char *macro, const char *plain)
{
    char text[2048];
    snprintf(text, sizeof text, "trimmed_nurbs { %s }", macro);
    check_same(text, plain);
}

/* A trim of a plane, and the plain shape in it. */
static void check_trim(const char *trim, const char *plain)
{
    char text[1024];
    snprintf(text, sizeof text, "Nurbs_Planar(0, x, z, <-2, -2>, <2, 2>) %s", trim);
    check_surface(text, plain);
}

static void round_surfaces_are_the_primitives(void **state)
{
    (void)state;
    check_surface("Nurbs_Sphere(1)", "sphere { 0, 1 }");
    check_surface("Nurbs_Torus(1, .25)", "torus { 1, .25 }");
    check_surface("Nurbs_Cylinder(<-.3, -1, .2>, <.4, 1, -.1>, .5)", "cylinder { <-.3, -1, .2>, <.4, 1, -.1>, .5 open }");
    check_surface("Nurbs_Cylinder(-x, x, .5)", "cylinder { -x, x, .5 open }");
    check_surface("Nurbs_Cone(<-.3, -1, .2>, .8, <.4, 1, -.1>, .2)",
                  "cone { <-.3, -1, .2>, .8, <.4, 1, -.1>, .2 open }");
    check_surface("Nurbs_Cone(-y, 1, <.2, 1, 0>, 0)", "cone { -y, 1, <.2, 1, 0>, 0 open }");
    check_surface("Nurbs_Disc(<.1, .2, .3>, <1, 2, 3>, .3, 1)", "disc { <.1, .2, .3>, <1, 2, 3>, 1, .3 }");
    check_surface("Nurbs_Disc(<.1, .2, .3>, <3, .2, .1>, 0, 1)", "disc { <.1, .2, .3>, <3, .2, .1>, 1 }");
}

static void a_straight_tube_is_a_cylinder_or_a_cone(void **state)
{
    (void)state;
    check_same("#declare P = Curve_Points(array[2] { -y, y }); trimmed_nurbs { Nurbs_Tube(Curve_Knots(2, 2), P, .5, 5) }",
               "cylinder { -y, y, .5 open }");
    /* the sections stand across a difference quotient over 2e-6 of the path: its points' rounding tilts them by 2^-53 /
     * 2e-6 */
    check_same_within(16 * 0x1p-53 / 2e-6, "#declare P = Curve_Points(array[2] { <-1, 0, .3>, x });"
                      " #declare R = array[4] { <.8, .8>, <.6, .6>, <.4, .4>, <.2, .2> };"
                      " trimmed_nurbs { Nurbs_Tapered_Tube(Curve_Knots(2, 2), P, y, R) }",
                      "cone { <-1, 0, .3>, .8, x, .2 open }");
}

static void part_of_a_turn_ends_where_the_angle_says(void **state)
{
    (void)state;
    check_surface("Nurbs_Revolution(Curve_Piece_Knots(3, 5), Nurbs_Half_Circle(1), 270)",
                  "sphere { 0, 1 clipped_by { box { <0, -2, -2>, <2, 2, 0> inverse } } }");
    check_surface("Nurbs_Revolution(Curve_Piece_Knots(3, 5), Nurbs_Half_Circle(1), 35)",
                  "sphere { 0, 1 clipped_by { plane { -z, 0 } plane { z, 0 rotate -35*y } } }");
    check_same("#declare P = Curve_Points(array[2] { <1, -1, 0>, <.25, 1, 0> });"
               " trimmed_nurbs { Nurbs_Revolution(Curve_Knots(2, 2), P, 100) }",
               "cone { -y, 1, y, .25 open clipped_by { plane { -z, 0 } plane { z, 0 rotate -100*y } } }");
}

static void what_is_moved_along_a_vector_is_a_cylinder(void **state)
{
    (void)state;
    check_same("#declare P = Curve_Arc(<.2, .1, -1>, .7, -90, 90, 2);"
               " trimmed_nurbs { Nurbs_Extrusion(Curve_Piece_Knots(3, 5), P, 2*z) }",
               "cylinder { <.2, .1, -1>, <.2, .1, 1>, .7 open clipped_by { plane { -x, -.2 } } }");
    check_surface("Nurbs_Wall(Outline_Circle(<.1, .2>, .7), <0, -1, 0>, x, z, 2*y)",
                  "cylinder { <.1, -1, .2>, <.1, 1, .2>, .7 open }");
    check_surface("Nurbs_Wall(Outline_Rectangle(<-.8, -.4>, <.6, .9>), <0, -1, 0>, x, z, 2*y)",
                  "box { <-.8, -2, -.4>, <.6, 2, .9> clipped_by { box { <-2, -1, -2>, <2, 1, 2> } } }");
    check_surface("Nurbs_Wall(Outline_Ellipse(<0, 0>, <.9, .5>, 30), <0, -1, 0>, x, z, 2*y)",
                  "cylinder { -y, y, 1 open scale <.9, 1, .5> rotate -30*y }");
}

static void round_trims_cut_discs(void **state)
{
    (void)state;
    check_trim("Trim_Circle(<.1, .2>, .7, NURBS_REGION)", "disc { <.1, 0, .2>, y, .7 }");
    check_trim("Trim_Circle(<.1, .2>, .9, NURBS_REGION) Trim_Circle(<.1, .2>, .5, NURBS_HOLE)",
               "disc { <.1, 0, .2>, y, .9, .5 }");
    check_trim("Trim_Ellipse(<.3, -.2>, <1, .4>, 30, NURBS_REGION)",
               "disc { 0, y, 1 scale <1, 1, .4> rotate -30*y translate <.3, 0, -.2> }");
}

#define CORNER_DISCS " disc { <.6, 0, .4>, y, .3 } disc { <-.6, 0, .4>, y, .3 } disc { <.6, 0, -.4>, y, .3 }" \
    " disc { <-.6, 0, -.4>, y, .3 }"
#define RECTANGLE(X0, Z0, X1, Z1) " triangle { <" X0 ", 0, " Z0 ">, <" X1 ", 0, " Z0 ">, <" X1 ", 0, " Z1 "> }" \
    " triangle { <" X0 ", 0, " Z0 ">, <" X0 ", 0, " Z1 ">, <" X1 ", 0, " Z1 "> }"

static void rounded_trims_are_discs_and_rectangles(void **state)
{
    (void)state;
    check_trim("Trim_Slot(<-.5, 0>, <.5, 0>, .4, NURBS_REGION)",
               "union { disc { -.5*x, y, .4 } disc { .5*x, y, .4 }" RECTANGLE("-.5", "-.4", ".5", ".4") " }");
    check_trim("Trim_Rounded(<-.9, -.7>, <.9, .7>, .3, NURBS_REGION)",
               "union {" CORNER_DISCS RECTANGLE("-.9", "-.4", ".9", ".4") RECTANGLE("-.6", "-.7", ".6", ".7") " }");
    check_trim("Trim_Rectangle(<-.9, -.7>, <.9, .4>, NURBS_REGION)", "union {" RECTANGLE("-.9", "-.7", ".9", ".4") " }");
    /* the lines touch both circles where the angle at A has the cosine (.6 - .2) / 1 */
    check_trim("Trim_Outline(Outline_Arm(<-.5, 0>, .6, <.5, 0>, .2), NURBS_REGION)",
               "#declare C = (.6 - .2) / 1; #declare S = sqrt(1 - C*C);"
               "#declare A = <-.5 + .6*C, 0, .6*S>; #declare B = <.5 + .2*C, 0, .2*S>; #declare M = <1, 1, -1>;"
               "union { disc { -.5*x, y, .6 } disc { .5*x, y, .2 } triangle { A, B, B*M } triangle { A, B*M, A*M } }");
}

/* Seen from their centre, polygons and gears are fans of triangles. */
#define FAN "#macro Fan(N, M, P) union { #for (I, 0, N - 1) triangle { M, P[I], P[mod(I + 1, N)] } #end } #end "

static void polygons_and_gears_are_fans_of_triangles(void **state)
{
    (void)state;
    check_trim("Trim_Regular(<.1, .2>, .8, 5, 17, NURBS_REGION)",
               FAN "#declare P = array[5]; #for (I, 0, 4) #declare P[I] = <.1 + .8*cos(radians(17 + 72*I)), 0,"
               " .2 + .8*sin(radians(17 + 72*I))>; #end Fan(5, <.1, 0, .2>, P)");
    /* per tooth of 36 degrees: the top takes .25, the gap .35; its corners lie at -11.7, -4.5, 4.5 and 11.7 degrees */
    check_trim("Trim_Gear(<.1, .2>, .6, .9, 10, .25, .35, NURBS_REGION)",
               FAN "#declare A = array[4] { -11.7, -4.5, 4.5, 11.7 }; #declare R = array[4] { .6, .9, .9, .6 };"
               "#declare P = array[40]; #for (I, 0, 39) #declare Q = radians(36*int(I/4) + A[mod(I, 4)]);"
               " #declare P[I] = <.1 + R[mod(I, 4)]*cos(Q), 0, .2 + R[mod(I, 4)]*sin(Q)>; #end Fan(40, <.1, 0, .2>, P)");
    check_trim("Trim_Polyline(array[4] { <-.9, -.5>, <.7, -.8>, <.2, 0>, <.8, .9> }, NURBS_REGION)",
               "union { triangle { <-.9, 0, -.5>, <.7, 0, -.8>, <.2, 0, 0> } triangle { <-.9, 0, -.5>, <.2, 0, 0>,"
               " <.8, 0, .9> } }");
    check_trim("Trim_Outline(Outline_Moved(Outline_Polygon(array[3] { <0, 0>, <1, 0>, <0, .5> }), true, 30, <.3, .1>),"
               " NURBS_REGION)",
               "triangle { 0, x, .5*z scale <-1, 1, 1> rotate -30*y translate <.3, 0, .1> }");
}

static void a_hole_is_what_a_region_is_not(void **state)
{
    (void)state;
    check_surface("Nurbs_Sphere(1) Trim_Rectangle(<0, .25>, <1, .75>, NURBS_REGION)",
                  "trimmed_nurbs { Nurbs_Sphere(1) Trim_Rectangle(<0, 0>, <1, .25>, NURBS_HOLE)"
                  " Trim_Rectangle(<0, .75>, <1, 1>, NURBS_HOLE) }");
    /* v = 1/4 and 3/4 of two quarter circles are the heights -+sqrt(1/2) */
    check_surface("Nurbs_Sphere(1) Trim_Rectangle(<0, .25>, <1, .75>, NURBS_REGION)",
                  "sphere { 0, 1 clipped_by { box { -<2, sqrt(.5), 2>, <2, sqrt(.5), 2> } } }");
}

/* ---- what a surface must pass through ---- */

static Vec3 point_of(const Read *r, double u, double v)
{
    Vec3 s, s_u, s_v;
    CHECK(nurbs_shape_point(r->scene->objects[0]->child, u, v, &s, &s_u, &s_v), "the first object is no NURBS");
    return s;
}

/* The points here have coordinates up to about 2, and come from some hundred operations of a macro. */
static void check_at(const Read *r, double u, double v, Vec3 expected)
{
    CHECK_WITHIN(vec_length(vec_sub(point_of(r, u, v), expected)), 1e-13, "at %g, %g", u, v);
}

/* The point of a quadratic Bézier curve. */
static Vec3 quadratic(const Vec3 p[3], double t)
{
    return vec_add(vec_scale(p[0], (1 - t) * (1 - t)),
                   vec_add(vec_scale(p[1], 2 * t * (1 - t)), vec_scale(p[2], t * t)));
}

static Vec3 mix(Vec3 a, Vec3 b, double t) { return vec_add(vec_scale(a, 1 - t), vec_scale(b, t)); }

static void a_bilinear_patch_mixes_its_corners(void **state)
{
    (void)state;
    Read r = read_macros("trimmed_nurbs { Nurbs_Bilinear(<0, 0, 0>, <1, .2, 0>, <.1, 0, 1>, <1, 1, 1.5>) }");
    for (double v = 0; v <= 1; v += .25)
        for (double u = 0; u <= 1; u += .25)
            check_at(&r, u, v, mix(mix(vec(0, 0, 0), vec(1, .2, 0), u), mix(vec(.1, 0, 1), vec(1, 1, 1.5), u), v));
    read_done(&r);
}

static const Vec3 low[3] = { { 0, 0, 0 }, { .5, 1, 0 }, { 1, 0, .5 } };
static const Vec3 high[3] = { { 0, 1, 1 }, { .5, -.5, 1 }, { 2, 1, 1 } };
static const Vec3 left[3] = { { 0, 0, 0 }, { -.5, 1, .5 }, { 0, 1, 1 } };
static const Vec3 right[3] = { { 1, 0, .5 }, { 2, .5, 0 }, { 2, 1, 1 } };
#define FOUR_CURVES "#declare Low = Curve_Points(array[3] { <0, 0, 0>, <.5, 1, 0>, <1, 0, .5> });" \
    "#declare High = Curve_Points(array[3] { <0, 1, 1>, <.5, -.5, 1>, <2, 1, 1> });" \
    "#declare Left = Curve_Points(array[3] { <0, 0, 0>, <-.5, 1, .5>, <0, 1, 1> });" \
    "#declare Right = Curve_Points(array[3] { <1, 0, .5>, <2, .5, 0>, <2, 1, 1> }); #declare K = Curve_Knots(3, 3);"

static void a_ruled_surface_is_made_of_straight_lines(void **state)
{
    (void)state;
    Read r = read_macros(FOUR_CURVES "trimmed_nurbs { Nurbs_Ruled(K, Low, High) }");
    for (double v = 0; v <= 1; v += .25)
        for (double u = 0; u <= 1; u += .125) check_at(&r, u, v, mix(quadratic(low, u), quadratic(high, u), v));
    read_done(&r);
}

/* Coons: the sum of the two ruled surfaces less the bilinear one. */
static void a_coons_patch_blends_its_four_borders(void **state)
{
    (void)state;
    Read r = read_macros(FOUR_CURVES "trimmed_nurbs { Nurbs_Coons(K, Low, High, K, Left, Right) }");
    for (double v = 0; v <= 1; v += .125)
        for (double u = 0; u <= 1; u += .125) {
            Vec3 along_v = mix(quadratic(low, u), quadratic(high, u), v);
            Vec3 along_u = mix(quadratic(left, v), quadratic(right, v), u);
            Vec3 corners = mix(mix(low[0], low[2], u), mix(high[0], high[2], u), v);
            check_at(&r, u, v, vec_sub(vec_add(along_u, along_v), corners));
        }
    read_done(&r);
}

/* Section j of four, over x, at a height that bends. */
static void section(int j, Vec3 out[3])
{
    for (int i = 0; i < 3; i++) out[i] = vec(i + .1 * j * i, (i == 1) + .3 * j * j, j * (1 + .2 * (i == 2)));
}

static void a_skin_passes_through_its_sections(void **state)
{
    (void)state;
    static const double at[5] = { 0, .2, .5, .7, 1 };
    Read r = read_macros("#declare S = array[5][3]; #for (J, 0, 4) #for (I, 0, 2) #declare S[J][I] ="
                         " <I + .1*J*I, (I = 1) + .3*J*J, J*(1 + .2*(I = 2)), 1>; #end #end"
                         " trimmed_nurbs { Nurbs_Skin_At(Curve_Knots(3, 3), S, 4, array[5] { 0, .2, .5, .7, 1 }) }");
    for (int j = 0; j < 5; j++) {
        Vec3 p[3];
        section(j, p);
        for (double u = 0; u <= 1; u += .125) check_at(&r, u, at[j], quadratic(p, u));
    }
    read_done(&r);
}

/* Three half circles of radius .5 along z, evenly: their weights must not push the surface off the cylinder. */
static void a_skin_of_equal_arcs_is_a_cylinder(void **state)
{
    (void)state;
    check_same("#declare A = Curve_Arc(<0, 0, 0>, .5, 0, 180, 2); #declare S = array[4][5]; #for (J, 0, 3) #for (I, 0, 4)"
               " #declare S[J][I] = A[I] + <0, 0, J*J/9, 0>; #end #end"
               " trimmed_nurbs { Nurbs_Skin(Curve_Piece_Knots(3, 5), S, 4) }",
               "cylinder { 0, z, .5 open clipped_by { plane { -y, 0 } } }");
}

/* How far a point is from the surface: Gauss and Newton's way down from a guess, within the domain of [0, 1]. */
static double distance_from(const Read *r, Vec3 p, double u, double v)
{
    Vec3 s, s_u, s_v;
    for (int i = 0; i < 50; i++) {
        nurbs_shape_point(r->scene->objects[0]->child, u, v, &s, &s_u, &s_v);
        Vec3 d = vec_sub(p, s);
        double a = vec_dot(s_u, s_u), b = vec_dot(s_u, s_v), c = vec_dot(s_v, s_v), e = vec_dot(s_u, d), f = vec_dot(s_v, d);
        u = fmin(1, fmax(0, u + (c * e - b * f) / (a * c - b * b)));
        v = fmin(1, fmax(0, v + (a * f - b * e) / (a * c - b * b)));
    }
    return vec_length(vec_sub(point_of(r, u, v), p));
}

static void a_surface_through_points_has_them_all(void **state)
{
    (void)state;
    Read r = read_macros("#declare G = array[5][6]; #for (J, 0, 4) #for (I, 0, 5)"
                         " #declare G[J][I] = <I + .2*sin(J), .5*sin(I + 2*J), J + .1*I>; #end #end"
                         " trimmed_nurbs { Nurbs_Through(G, 4, 3) }");
    for (int j = 0; j < 5; j++)
        for (int i = 0; i < 6; i++) {
            Vec3 p = vec(i + .2 * sin(j), .5 * sin(i + 2 * j), j + .1 * i);
            CHECK_WITHIN(distance_from(&r, p, i / 5., j / 4.), 1e-13, "point %d, %d", i, j);
        }
    check_at(&r, 0, 0, vec(0, 0, 0));
    check_at(&r, 1, 1, vec(5 + .2 * sin(4), .5 * sin(13), 4.5));
    read_done(&r);
}

/* Chord lengths 1, 2, 1 and 4: the parameters are 0, 1/8, 3/8, 4/8, 1. */
static void a_curve_through_points_has_them_at_their_chord_lengths(void **state)
{
    (void)state;
    static const Vec3 points[5] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 2, 0 }, { 0, 2, 0 }, { 0, 2, 4 } };
    static const double at[5] = { 0, .125, .375, .5, 1 };
    Read r = read_macros("#declare Q = array[5] { 0*x, x, <1, 2, 0>, 2*y, <0, 2, 4> }; trimmed_nurbs {"
                         " Nurbs_Extrusion(Curve_Through_Knots(4, Q), Curve_Through_Points(4, Q), <1, 1, 0>) }");
    for (int i = 0; i < 5; i++) {
        check_at(&r, at[i], 0, points[i]);
        check_at(&r, at[i], 1, vec_add(points[i], vec(1, 1, 0)));
    }
    read_done(&r);
}

/* The path is an arc of radius 2 about the z axis; a round section is as far from it as its radius. */
static void a_tube_begins_and_ends_with_its_sections(void **state)
{
    (void)state;
    Read r = read_macros("#declare P = Curve_Arc(<0, 0, 0>, 2, 0, 90, 1);"
                         "trimmed_nurbs { Nurbs_Tube(Curve_Piece_Knots(3, 3), P, .25, 9) }");
    for (double u = 0; u <= 1; u += 1. / 64) {
        Vec3 first = point_of(&r, u, 0), last = point_of(&r, u, 1);
        CHECK_WITHIN(fabs(vec_length(vec_sub(first, vec(2, 0, 0))) - .25), 1e-13, "the first ring at %g", u);
        CHECK_WITHIN(fabs(vec_length(vec_sub(last, vec(0, 2, 0))) - .25), 1e-13, "the last ring at %g", u);
        CHECK_WITHIN(fabs(first.y) + fabs(last.x), 1e-6, "across the path at %g, to the tangent's difference quotient", u);
        for (double v = 0; v <= 1; v += 1. / 64) {   /* between the sections: the interpolation's, some h^4 for h = 1/8 */
            Vec3 p = point_of(&r, u, v);
            double off = hypot(hypot(p.x, p.y) - 2, p.z);
            CHECK_WITHIN(fabs(off - .25), 1e-3, "between the sections at %g, %g", u, v);
        }
    }
    read_done(&r);
}

int main(void)
{
    const char *folder = getenv("TRIMRAY_TESTS_DIR");
    if (!folder || chdir(folder) != 0) return fprintf(stderr, "set TRIMRAY_TESTS_DIR to the folder tests\n"), 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_surfaces_are_the_primitives),
        cmocka_unit_test(a_straight_tube_is_a_cylinder_or_a_cone),
        cmocka_unit_test(part_of_a_turn_ends_where_the_angle_says),
        cmocka_unit_test(what_is_moved_along_a_vector_is_a_cylinder),
        cmocka_unit_test(round_trims_cut_discs),
        cmocka_unit_test(rounded_trims_are_discs_and_rectangles),
        cmocka_unit_test(polygons_and_gears_are_fans_of_triangles),
        cmocka_unit_test(a_hole_is_what_a_region_is_not),
        cmocka_unit_test(a_bilinear_patch_mixes_its_corners),
        cmocka_unit_test(a_ruled_surface_is_made_of_straight_lines),
        cmocka_unit_test(a_coons_patch_blends_its_four_borders),
        cmocka_unit_test(a_skin_passes_through_its_sections),
        cmocka_unit_test(a_skin_of_equal_arcs_is_a_cylinder),
        cmocka_unit_test(a_surface_through_points_has_them_all),
        cmocka_unit_test(a_curve_through_points_has_them_at_their_chord_lengths),
        cmocka_unit_test(a_tube_begins_and_ends_with_its_sections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
