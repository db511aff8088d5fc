/* Reading the numbers of a spline: order, knots and points of a surface or of a trim curve. What can be told from the
 * numbers as they are read (counts, orders, decreasing knots, weights) is reported at once, and reading goes on. */
#ifndef TRIMRAY_SPLINE_H
#define TRIMRAY_SPLINE_H

#include "parser/rules.h"

typedef struct {
    Place word;                  /* known: the list was given */
    double *x;
    Place *places;               /* of each number */
    size_t n, n_places, capacity, places_capacity;
} NumberList;

/* A surface (2 directions, points of 3 coordinates) or a trim curve (1 direction, 2 coordinates), as far as it is read. */
typedef struct {
    int n_directions, n_coordinates;
    const char *name, *knots_names[2];
    Place word, order_word, points_word;
    int order[2], count[2];
    NumberList knots[2];
    Vec4 *points;                /* {x, y, z, weight}; z = 0 for curves */
    size_t n_points, capacity;
    bool is_faulty;              /* something was reported: nothing can be made of it */
} Spline;

Spline spline_of_surface(const char *name, Place word);
Spline spline_of_curve(Place word);

/* order, degree, points, knots: reads one of them; false: the next token is none. */
bool spline_read_item(Parser *p, Spline *s);
void spline_check(Parser *p, Spline *s);                /* after the last item: is all there, in the right number? */

void spline_add_knot(Parser *p, Spline *s, int direction);
void spline_add_point(Parser *p, Spline *s, bool may_have_weight);
size_t spline_point_count(const Spline *s);             /* as announced */
void spline_reserve_points(Parser *p, Spline *s);       /* room for them */

/* An error of this spline. */
void spline_fault(Parser *p, Spline *s, Place where, const char *format, ...) __attribute__((format(printf, 4, 5)));

#endif
