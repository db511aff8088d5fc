#include "parser/spline.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

Spline spline_of_surface(const char *name, Place word)
{
    return (Spline){ .n_directions = 2, .n_coordinates = 3, .name = name, .knots_names = { "knots_u", "knots_v" },
                     .word = word };
}

Spline spline_of_curve(Place word)
{
    return (Spline){ .n_directions = 1, .n_coordinates = 2, .name = "curve", .knots_names = { "knots" }, .word = word };
}

void spline_fault(Parser *p, Spline *s, Place where, const char *format, ...)
{
    char message[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    s->is_faulty = true;
    parse_error(p, where, "%s", message);
}

static void refuse_second(Parser *p, Spline *s, Place first, Place second, const char *word)
{
    if (place_is_known(first)) spline_fault(p, s, second, "'%s' is given twice (first on line %u)", word, first.line);
}

/* ---- knots ---- */

void spline_add_knot(Parser *p, Spline *s, int direction)
{
    NumberList *list = &s->knots[direction];
    const char *name = s->knots_names[direction];
    Place where = here(p);
    double x = parse_float(p);
    if (!isfinite(x)) spline_fault(p, s, where, "expected a finite number in %s, found %g", name, x);
    else if (list->n > 0 && x < list->x[list->n - 1])
        spline_fault(p, s, where, "expected at least %g in %s, found %g", list->x[list->n - 1], name, x);
    ARENA_PUSH(parser_arena(p), list->x, list->n, list->capacity) = x;
    ARENA_PUSH(parser_arena(p), list->places, list->n_places, list->places_capacity) = where;
}

static void read_knots(Parser *p, Spline *s, int direction, Place word)
{
    const char *name = s->knots_names[direction];
    refuse_second(p, s, s->knots[direction].word, word, name);
    s->knots[direction] = (NumberList){ .word = word };
    Place opened = expect_open(p, name);
    while (starts_expression(p)) {
        spline_add_knot(p, s, direction);
        accept_comma(p);
    }
    expect_close(p, '}', name, opened);
}

/* ---- order, degree ---- */

/* They differ by `more`; the message speaks the scene's word. An order that is not one is left 0. */
static void read_order(Parser *p, Spline *s, Place word, const char *name, int more)
{
    int least = NURBS_MIN_ORDER - more, most = NURBS_MAX_ORDER - more;
    refuse_second(p, s, s->order_word, word, name);
    s->order_word = word;
    for (int d = 0; d < s->n_directions; d++) {
        if (d > 0) accept_comma(p);
        Place where = here(p);
        int n = parse_int(p);
        s->order[d] = n + more;
        if (n >= least && n <= most) continue;
        s->order[d] = 0;
        spline_fault(p, s, where, "expected %s %s of %d to %d, found %d", more ? "a" : "an", name, least, most, n);
    }
}

/* ---- points ---- */

/* Coordinates, and a weight where it is given and allowed. */
static Vec4 read_point(Parser *p, Spline *s, bool may_have_weight)
{
    Place where = here(p);
    double c[5];
    int n = parse_vector(p, c), expected = s->n_coordinates;
    if (n != expected && !(may_have_weight && n == expected + 1)) {
        spline_fault(p, s, where, "expected a point of %d coordinates%s, found %d numbers", expected,
                     may_have_weight ? ", with or without a weight" : "", n);
        return vec4(0, 0, 0, 1);
    }
    double weight = n > expected ? c[expected] : 1;
    if (!(weight > 0 && isfinite(weight))) spline_fault(p, s, where, "expected a positive, finite weight, found %g", weight);
    for (int i = 0; i < expected; i++)
        if (!isfinite(c[i])) spline_fault(p, s, where, "expected finite coordinates, found %g", c[i]);
    return vec4(c[0], c[1], expected > 2 ? c[2] : 0, weight);
}

void spline_add_point(Parser *p, Spline *s, bool may_have_weight)
{
    Vec4 point = read_point(p, s, may_have_weight);
    ARENA_PUSH(parser_arena(p), s->points, s->n_points, s->capacity) = point;
}

size_t spline_point_count(const Spline *s)
{
    size_t n = 1;
    for (int d = 0; d < s->n_directions; d++) n *= s->count[d] > 0 ? (size_t)s->count[d] : 0;
    return n;
}

/* What is absurd grows as it is read. */
void spline_reserve_points(Parser *p, Spline *s)
{
    enum { MOST = 1 << 16 };
    size_t n = spline_point_count(s);
    s->capacity = n < MOST ? n : MOST;
    s->points = ARENA_ARRAY(parser_arena(p), Vec4, s->capacity);
    s->n_points = 0;
}

static void check_point_count(Parser *p, Spline *s)
{
    size_t expected = spline_point_count(s);
    if (s->n_points == expected) return;
    if (s->n_directions == 1)
        spline_fault(p, s, s->points_word, "expected %d points, found %zu", s->count[0], s->n_points);
    else
        spline_fault(p, s, s->points_word, "expected %zu points (%d x %d), found %zu", expected, s->count[0], s->count[1],
                     s->n_points);
}

static void read_points(Parser *p, Spline *s, Place word)
{
    refuse_second(p, s, s->points_word, word, "points");
    s->points_word = word;
    for (int d = 0; d < s->n_directions; d++) {
        if (d > 0) accept_comma(p);
        s->count[d] = parse_int(p);
    }
    spline_reserve_points(p, s);
    Place opened = expect_open(p, "points");
    while (starts_expression(p)) {
        spline_add_point(p, s, true);
        accept_comma(p);
    }
    expect_close(p, '}', "points", opened);
    check_point_count(p, s);
}

bool spline_read_item(Parser *p, Spline *s)
{
    Place word = here(p);
    if (accept_word(p, "order")) return read_order(p, s, word, "order", 0), true;
    if (accept_word(p, "degree")) return read_order(p, s, word, "degree", 1), true;
    if (accept_word(p, "points")) return read_points(p, s, word), true;
    for (int d = 0; d < s->n_directions; d++)
        if (accept_word(p, s->knots_names[d])) return read_knots(p, s, d, word), true;
    return false;
}

/* ---- what the numbers say of each other ---- */

/* Appends " NAME," to the list of what is missing. */
static void note_missing(char list[], size_t size, Place given, const char *name)
{
    size_t n = strlen(list);
    if (!place_is_known(given)) snprintf(list + n, size - n, "%s %s", n > 0 ? "," : "", name);
}

static bool check_given(Parser *p, Spline *s)
{
    char missing[64] = "";
    note_missing(missing, sizeof missing, s->order_word, "order");
    for (int d = 0; d < s->n_directions; d++) note_missing(missing, sizeof missing, s->knots[d].word, s->knots_names[d]);
    note_missing(missing, sizeof missing, s->points_word, "points");
    if (missing[0]) spline_fault(p, s, s->word, "%s lacks%s", s->name, missing);
    return !missing[0];
}

static void check_direction(Parser *p, Spline *s, int d)
{
    static const char *const along[2] = { " along u", " along v" };
    const NumberList *knots = &s->knots[d];
    int order = s->order[d], count = s->count[d];
    if (order == 0) return;   /* reported already, and nothing can be expected of the others */
    if (count < order)
        spline_fault(p, s, s->points_word, "expected at least %d points%s (order %d), found %d", order,
                     s->n_directions > 1 ? along[d] : "", order, count);
    else if (knots->n != (size_t)count + (size_t)order)
        spline_fault(p, s, knots->word, "expected %d numbers in %s (%d points + order %d), found %zu", count + order,
                     s->knots_names[d], count, order, knots->n);
}

void spline_check(Parser *p, Spline *s)
{
    if (!check_given(p, s)) return;
    for (int d = 0; d < s->n_directions; d++) check_direction(p, s, d);
}
