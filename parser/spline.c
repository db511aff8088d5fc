#include "parser/spline.h"

/* ---- numbers ---- */

Spline spline_of_surface(Place word)
{
    return (Spline){ .n_directions = 2, .n_coordinates = 3, .knots_names = { "knots_u", "knots_v" }, .word = word };
}

Spline spline_of_curve(Place word)
{
    return (Spline){ .n_directions = 1, .n_coordinates = 2, .knots_names = { "knots", "" }, .word = word };
}

static void refuse_second(Parser *p, Place first, Place second, const char *word)
{
    if (place_is_known(first)) parse_error(p, second, "'%s' is given twice (first on line %u)", word, first.line);
}

void spline_read_knot(Parser *p, NumberList *list, const char *name)
{
    Place where = here(p);
    double x = parse_float(p);
    if (!isfinite(x)) parse_error(p, where, "expected a finite number in %s, found %g", name, x);
    else if (list->n > 0 && x < list->x[list->n - 1])
        parse_error(p, where, "expected at least %g in %s, found %g", list->x[list->n - 1], name, x);
    ARENA_PUSH(parser_arena(p), list->x, list->n, list->capacity) = x;
    ARENA_PUSH(parser_arena(p), list->places, list->n_places, list->places_capacity) = where;
}

static void read_knots(Parser *p, NumberList *list, const char *name, Place word)
{
    refuse_second(p, list->word, word, name);
    *list = (NumberList){ .word = word };
    Place opened = expect_open(p, name);
    while (starts_expression(p)) {
        spline_read_knot(p, list, name);
        accept_comma(p);
    }
    expect_close(p, '}', name, opened);
}

/* `order` and `degree` differ by one; the message speaks the scene's word. */
static void read_order(Parser *p, Spline *s, Place word, const char *name, int more)
{
    refuse_second(p, s->order_word, word, name);
    s->order_word = word;
    for (int d = 0; d < s->n_directions; d++) {
        if (d > 0) accept_comma(p);
        Place where = here(p);
        s->order[d] = parse_int(p);
        if (s->order[d] < NURBS_MIN_ORDER - more || s->order[d] > NURBS_MAX_ORDER - more) {
            parse_error(p, where, "expected %s of %d to %d, found %d", more ? "a degree" : "an order",
                        NURBS_MIN_ORDER - more, NURBS_MAX_ORDER - more, s->order[d]);
            s->order[d] = 0;
            continue;
        }
        s->order[d] += more;
    }
}

/* Coordinates, and a weight where it is given and allowed. */
Vec4 spline_read_point(Parser *p, int n_coordinates, bool may_have_weight)
{
    Place where = here(p);
    double c[5];
    int n = parse_vector(p, c);
    if (n != n_coordinates && !(may_have_weight && n == n_coordinates + 1)) {
        parse_error(p, where, "expected a point of %d coordinates%s, found %d", n_coordinates,
                    may_have_weight ? " with or without a weight" : "", n);
        return vec4(0, 0, 0, 1);
    }
    double weight = n > n_coordinates ? c[n_coordinates] : 1;
    if (!(weight > 0 && isfinite(weight))) parse_error(p, where, "expected a positive, finite weight, found %g", weight);
    for (int i = 0; i < n_coordinates; i++)
        if (!isfinite(c[i])) parse_error(p, where, "expected finite coordinates, found %g", c[i]);
    return vec4(c[0], c[1], n_coordinates > 2 ? c[2] : 0, weight);
}

size_t spline_point_count(const Spline *s)
{
    size_t n = 1;
    for (int d = 0; d < s->n_directions; d++) n *= s->count[d] > 0 ? (size_t)s->count[d] : 0;
    return n;
}

/* Room for what the scene announces; what is absurd grows as it is read. */
void spline_reserve_points(Parser *p, Spline *s)
{
    enum { MOST = 1 << 16 };
    size_t n = spline_point_count(s);
    s->capacity = n < MOST ? n : MOST;
    s->points = ARENA_ARRAY(parser_arena(p), Vec4, s->capacity);
    s->n_points = 0;
}

static void check_point_count(Parser *p, const Spline *s)
{
    if (s->n_points == spline_point_count(s)) return;
    if (s->n_directions == 1) parse_error(p, s->points_word, "expected %d points, found %zu", s->count[0], s->n_points);
    else parse_error(p, s->points_word, "expected %zu points (%d x %d), found %zu", spline_point_count(s), s->count[0],
                     s->count[1], s->n_points);
}

static void read_points(Parser *p, Spline *s, Place word)
{
    refuse_second(p, s->points_word, word, "points");
    s->points_word = word;
    for (int d = 0; d < s->n_directions; d++) {
        if (d > 0) accept_comma(p);
        s->count[d] = parse_int(p);
    }
    spline_reserve_points(p, s);
    Place opened = expect_open(p, "points");
    while (starts_expression(p)) {
        ARENA_PUSH(parser_arena(p), s->points, s->n_points, s->capacity) = spline_read_point(p, s->n_coordinates, true);
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
        if (accept_word(p, s->knots_names[d])) return read_knots(p, &s->knots[d], s->knots_names[d], word), true;
    return false;
}

/* ---- what the numbers say of each other ---- */

static bool check_given(Parser *p, const Spline *s, const char *what, Place given, const char *name)
{
    if (!place_is_known(given)) parse_error(p, s->word, "%s needs '%s'", what, name);
    return place_is_known(given);
}

static void check_direction(Parser *p, const Spline *s, int d)
{
    static const char *const along[2] = { " along u", " along v" };
    const NumberList *knots = &s->knots[d];
    int order = s->order[d], count = s->count[d];
    if (order == 0) return;   /* reported already, and nothing can be expected of the others */
    if (count < order)
        parse_error(p, s->points_word, "expected at least %d points%s (order %d), found %d", order,
                    s->n_directions > 1 ? along[d] : "", order, count);
    else if (knots->n != (size_t)count + (size_t)order)
        parse_error(p, knots->word, "expected %d numbers in %s (%d points + order %d), found %zu", count + order,
                    s->knots_names[d], count, order, knots->n);
}

void spline_check(Parser *p, const Spline *s, const char *what)
{
    bool all = check_given(p, s, what, s->order_word, "order");
    all = check_given(p, s, what, s->points_word, "points") && all;
    for (int d = 0; d < s->n_directions; d++) all = check_given(p, s, what, s->knots[d].word, s->knots_names[d]) && all;
    for (int d = 0; all && d < s->n_directions; d++) check_direction(p, s, d);
}
