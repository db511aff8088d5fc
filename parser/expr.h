/* Expressions: numbers, vectors and colours in one form while they are computed, and strings. */
#ifndef TRIMRAY_PARSER_EXPR_H
#define TRIMRAY_PARSER_EXPR_H

#include "parser/core.h"

/* n components in v; 1 is a float, 2 to 5 a vector, a colour has 5 (red, green, blue, filter, transmit). 0: a string. */
typedef struct {
    int n;
    bool is_color;
    double v[5];
    const char *string;
} Term;

static inline Term term_float(double x) { return (Term){ .n = 1, .v = { x } }; }
static inline Term term_string(const char *s) { return (Term){ .n = 0, .string = s }; }
Term term_vec3(Vec3 v);

/* Without relations and logic, which POV-Ray has only in parentheses and conditions (where '>' cannot close a vector). */
Term parse_sum(Parser *p);
Term parse_logic(Parser *p);                       /* with them, and with ?: */

Term need_numbers(Parser *p, Place where, Term t); /* fails for a string */
double need_float(Parser *p, Place where, Term t);
Vec3 need_vec3(Parser *p, Place where, Term t);
const char *term_name(const Term *t);              /* "a float", "a vector", ... */

/* color.c: a colour that begins with one of its words (color, rgb, red, ...). */
bool starts_color(Parser *p);
Term parse_color_words(Parser *p);
Term parse_color_parts(Parser *p, Term c);         /* red E, filter E and the like, which change c */

#endif
