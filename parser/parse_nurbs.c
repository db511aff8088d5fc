/* trimmed_nurbs, hgPOV-Ray's nurbs, and bicubic_patch, which is a surface of one Bézier patch.
 *
 * Errors that can be told from the numbers as they are read are told at once (spline.h), so that one run finds several; the
 * library then judges the whole (nurbs_words.h). */
#include "parser/nurbs_words.h"
#include "parser/rules.h"
#include "parser/spline.h"

#define MAX_WARNINGS 16   /* of one surface */

/* ---- trims ---- */

typedef struct {
    TrimLoopDesc *loops;
    TrimPlaces *places;
    size_t n, n_places, capacity, places_capacity;
    bool is_faulty;
} TrimList;

static const Vec3 *plane_points(Parser *p, const Spline *s)
{
    Vec3 *points = ARENA_ARRAY(parser_arena(p), Vec3, s->n_points);
    for (size_t i = 0; i < s->n_points; i++) points[i] = vec(s->points[i].x, s->points[i].y, s->points[i].w);
    return points;
}

static TrimCurveDesc curve_desc(Parser *p, const Spline *s)
{
    return (TrimCurveDesc){ .order = s->order[0], .n = (int)s->n_points, .knots = s->knots[0].x,
                            .points = plane_points(p, s) };
}

static Spline read_curve(Parser *p, Place word)
{
    Spline s = spline_of_curve(word);
    Place opened = expect_open(p, "curve");
    while (spline_read_item(p, &s)) continue;
    expect_close(p, '}', "curve", opened);
    spline_check(p, &s);
    return s;
}

static TrimLoopDesc read_curves(Parser *p, TrimList *trims, TrimPlaces *places)
{
    TrimCurveDesc *curves = NULL;
    CurvePlaces *where = NULL;
    size_t n = 0, n_where = 0, capacity = 0, where_capacity = 0;
    for (Place word = here(p); accept_word(p, "curve"); word = here(p)) {
        Spline s = read_curve(p, word);
        trims->is_faulty |= s.is_faulty;
        ARENA_PUSH(parser_arena(p), curves, n, capacity) = curve_desc(p, &s);
        ARENA_PUSH(parser_arena(p), where, n_where, where_capacity) = (CurvePlaces){ word, s.knots[0].places };
    }
    places->curves = where;
    return (TrimLoopDesc){ .curves = curves, .n_curves = (int)n };
}

static TrimLoopDesc read_polyline(Parser *p, TrimList *trims, TrimPlaces *places)
{
    Spline s = spline_of_curve(places->word);
    s.order[0] = 2;
    while (starts_expression(p)) {
        spline_add_point(p, &s, false);
        accept_comma(p);
    }
    if (s.n_points < 3)
        spline_fault(p, &s, places->word, "expected at least 3 points in a trim polyline, found %zu", s.n_points);
    trims->is_faulty |= s.is_faulty;
    CurvePlaces where = { .word = places->word };
    TrimCurveDesc curve = curve_desc(p, &s);
    places->curves = arena_copy(parser_arena(p), &where, 1, sizeof where);
    return (TrimLoopDesc){ .curves = arena_copy(parser_arena(p), &curve, 1, sizeof curve), .n_curves = 1,
                           .is_polyline = true };
}

static void read_trim(Parser *p, TrimList *trims, Place word)
{
    TrimPlaces places = { .word = word };
    Place opened = expect_open(p, "trim");
    TrimLoopDesc loop = peek_word(p, "curve") ? read_curves(p, trims, &places) : read_polyline(p, trims, &places);
    expect_close(p, '}', "trim", opened);
    ARENA_PUSH(parser_arena(p), trims->loops, trims->n, trims->capacity) = loop;
    ARENA_PUSH(parser_arena(p), trims->places, trims->n_places, trims->places_capacity) = places;
}

/* ---- the shape ---- */

typedef struct {
    Spline spline;
    TrimList trims;
    bool keep_left;
    NurbsOptions options;
} SurfaceDraft;

static SurfaceDesc surface_desc(const SurfaceDraft *s)
{
    const Spline *n = &s->spline;
    return (SurfaceDesc){ .order_u = n->order[0], .order_v = n->order[1], .n_u = n->count[0], .n_v = n->count[1],
                          .knots_u = n->knots[0].x, .knots_v = n->knots[1].x, .points = n->points,
                          .trims = s->trims.loops, .n_trims = (int)s->trims.n, .keep_left = s->keep_left };
}

static void count_surface(Parser *p, const SurfaceDesc *d)
{
    ParseSummary *summary = parser_summary(p);
    summary->n_nurbs++;
    summary->n_trims += (size_t)d->n_trims;
    summary->n_control_points += (size_t)d->n_u * (size_t)d->n_v;
}

static Shape *make_surface(Parser *p, const SurfaceDesc *d, const NurbsOptions *options, const SurfacePlaces *places)
{
    NurbsError error = { .code = NURBS_OK };
    NurbsWarning warnings[MAX_WARNINGS];
    int n_warnings = 0;
    Shape *s = nurbs_shape_new(parser_arena(p), d, options, &error, warnings, MAX_WARNINGS, &n_warnings);
    for (int i = 0; i < n_warnings && i < MAX_WARNINGS; i++) nurbs_report_warning(p, places, &warnings[i]);
    count_surface(p, d);
    if (s) return s;
    nurbs_report_error(p, d, places, &error);
    return shape_stand_in(p);
}

/* What was found faulty while it was read is not asked for a shape. */
static Shape *make_draft(Parser *p, const SurfaceDraft *s)
{
    const Spline *n = &s->spline;
    if (n->is_faulty || s->trims.is_faulty) return shape_stand_in(p);
    SurfaceDesc desc = surface_desc(s);
    SurfacePlaces places = { .word = n->word, .order = n->order_word, .points = n->points_word,
                             .knots_u = n->knots[0].places, .knots_v = n->knots[1].places, .trims = s->trims.places };
    return make_surface(p, &desc, &s->options, &places);
}

/* ---- trimmed_nurbs ---- */

/* A word that is none of `choices`: what it is elsewhere, or that it is unknown, is of no interest. */
static _Noreturn void fail_choice(Parser *p, const char *choices)
{
    Token t = peek(p);
    if (t.kind == TOKEN_WORD) parse_fail(p, t.place, "expected %s, found '%s'", choices, t.text);
    parse_fail_expected(p, choices);
}

static void read_keep(Parser *p, SurfaceDraft *s)
{
    s->keep_left = accept_word(p, "left");
    if (!s->keep_left && !accept_word(p, "right")) fail_choice(p, "'right' or 'left'");
}

static void read_flattening(Parser *p, SurfaceDraft *s)
{
    bool is_adaptive = accept_word(p, "adaptive");
    if (!is_adaptive && !accept_word(p, "curvature")) fail_choice(p, "'curvature' or 'adaptive'");
    s->options.flattening = is_adaptive ? NURBS_FLATTENING_ADAPTIVE : NURBS_FLATTENING_CURVATURE;
}

static void read_method(Parser *p, SurfaceDraft *s)
{
    bool is_certain = accept_word(p, "certain");
    if (!is_certain && !accept_word(p, "paper")) fail_choice(p, "'certain' or 'paper'");
    s->options.method = is_certain ? NURBS_METHOD_CERTAIN : NURBS_METHOD_PAPER;
}

static void read_flatness(Parser *p, SurfaceDraft *s)
{
    Place where = here(p);
    double c = s->options.flatness = parse_float(p);
    if (!(c > 0)) spline_fault(p, &s->spline, where, "expected a positive flatness, found %g", c);
}

static void read_max_iterations(Parser *p, SurfaceDraft *s)
{
    Place where = here(p);
    int n = s->options.max_iterations = parse_int(p);
    if (n < 1) spline_fault(p, &s->spline, where, "expected at least 1 in max_iterations, found %d", n);
}

static bool read_surface_item(Parser *p, SurfaceDraft *s)
{
    Place word = here(p);
    if (accept_word(p, "trim")) read_trim(p, &s->trims, word);
    else if (accept_word(p, "keep")) read_keep(p, s);
    else if (accept_word(p, "flatness")) read_flatness(p, s);
    else if (accept_word(p, "flattening")) read_flattening(p, s);
    else if (accept_word(p, "method")) read_method(p, s);
    else if (accept_word(p, "max_iterations")) read_max_iterations(p, s);
    else return spline_read_item(p, &s->spline);
    return true;
}

Shape *parse_trimmed_nurbs(Parser *p, Place word)
{
    SurfaceDraft s = { .spline = spline_of_surface("trimmed_nurbs", word), .options = parser_options(p)->nurbs };
    while (read_surface_item(p, &s)) continue;
    spline_check(p, &s.spline);
    return make_draft(p, &s);
}

/* ---- nurbs, as hgPOV-Ray 3.8 reads it ----
 * order of u, order of v, points along u, points along v, the knots of u, the knots of v, and the points, u fastest. */

static int read_count(Parser *p, int least, int most, const char *what)
{
    Place where = here(p);
    int n = parse_int(p);
    accept_comma(p);
    if (n < least || n > most) parse_fail(p, where, "expected %s of %d to %d, found %d", what, least, most, n);
    return n;
}

static void read_header(Parser *p, Spline *s)
{
    enum { MOST_POINTS = 1 << 15 };   /* along one direction: the product fits */
    s->order_word = s->points_word = s->word;
    for (int d = 0; d < 2; d++) s->order[d] = read_count(p, NURBS_MIN_ORDER, NURBS_MAX_ORDER, "an order");
    for (int d = 0; d < 2; d++) s->count[d] = read_count(p, s->order[d], MOST_POINTS, "a number of points");
}

Shape *parse_hg_nurbs(Parser *p, Place word)
{
    SurfaceDraft s = { .spline = spline_of_surface("nurbs", word), .options = parser_options(p)->nurbs };
    Spline *n = &s.spline;
    read_header(p, n);
    for (int d = 0; d < 2; d++) {
        n->knots[d].word = here(p);
        for (int i = 0; i < n->count[d] + n->order[d]; i++) spline_add_knot(p, n, d), accept_comma(p);
    }
    n->points_word = here(p);
    spline_reserve_points(p, n);
    for (size_t i = spline_point_count(n); i > 0; i--) spline_add_point(p, n, true), accept_comma(p);
    return make_draft(p, &s);
}

/* ---- bicubic_patch ---- */

/* How POV-Ray divides a patch; here it is hit as it is. `type` must be there. */
static void read_patch_words(Parser *p, Place word)
{
    static const char *const left_out[] = { "uv_vectors", NULL };
    bool has_type = false;
    for (;;) {
        if (accept_word(p, "type")) (void)parse_int(p), has_type = true;
        else if (accept_word(p, "flatness") || accept_word(p, "u_steps") || accept_word(p, "v_steps")) (void)parse_float(p);
        else if (parse_left_out(p, left_out)) for (int i = 1; i < 4; i++) accept_comma(p), (void)parse_vec2(p);
        else break;
        accept_comma(p);
    }
    if (!has_type) parse_error(p, word, "bicubic_patch needs 'type'");
}

/* Point 4i + j of the list is C[i][j], where i runs with u and j with v (measured with POV-Ray 3.7). */
Shape *parse_bicubic_patch(Parser *p, Place word)
{
    static const double knots[8] = { 0, 0, 0, 0, 1, 1, 1, 1 };
    Vec4 points[16];
    read_patch_words(p, word);
    for (int n = 0; n < 16; n++) {
        Vec3 c = parse_vec3(p);
        points[n % 4 * 4 + n / 4] = vec4(c.x, c.y, c.z, 1);
        if (n < 15) accept_comma(p);
    }
    SurfaceDesc desc = { .order_u = 4, .order_v = 4, .n_u = 4, .n_v = 4, .knots_u = knots, .knots_v = knots,
                         .points = points };
    SurfacePlaces places = { .word = word, .order = word, .points = word };
    return make_surface(p, &desc, &parser_options(p)->nurbs, &places);
}
