/* The functions that make strings. They count bytes, as POV-Ray does for what is ASCII. */
#include "parser/functions.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_MAX_LENGTH = 1 << 20, TEXT_MAX_DIGITS = 1000 };

static Place open_arguments(Parser *p) { return expect_punct(p, '('); }
static void close_arguments(Parser *p, const Builtin *self, Place opened) { expect_close(p, ')', self->name, opened); }

static char *room_for(Parser *p, Place where, size_t n)
{
    char *text = n <= TEXT_MAX_LENGTH ? symbols_text(&p->symbols, n) : NULL;
    if (!text) parse_fail(p, where, "this string grows too long");
    text[n] = '\0';
    return text;
}

static Term keep(Parser *p, Place where, const char *text, size_t n)
{
    char *copy = room_for(p, where, n);
    memcpy(copy, text, n);
    return term_string(copy);
}

/* ---- characters ---- */

double text_first_code(const char *s)
{
    const unsigned char *c = (const unsigned char *)s;
    int n = c[0] < 0xC0 ? 0 : c[0] < 0xE0 ? 1 : c[0] < 0xF0 ? 2 : 3;     /* bytes that follow */
    unsigned code = n == 0 ? c[0] : c[0] & (0x3Fu >> n);
    for (int i = 1; i <= n; i++) {
        if ((c[i] & 0xC0) != 0x80) return c[0];                             /* not UTF-8 */
        code = code << 6 | (c[i] & 0x3F);
    }
    return code;
}

Term text_chr(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    int code = parse_int(p);
    close_arguments(p, self, opened);
    if (code < 0 || code > 0x10FFFF) parse_fail(p, where, "chr(%d): there is no such character", code);
    char c[4];
    if (code < 0x80) return c[0] = (char)code, keep(p, where, c, code != 0);
    int n = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (int i = n - 1, left = code; i > 0; i--, left >>= 6) c[i] = (char)(0x80 | (left & 0x3F));
    c[0] = (char)((0xF00 >> n) | (code >> (6 * (n - 1))));
    return keep(p, where, c, (size_t)n);
}

/* ---- numbers ---- */

double text_value(const char *s)
{
    double value = strtod(s, NULL);
    return isfinite(value) ? value : 0;
}

/* printf's %*.*f, as POV-Ray: a negative length pads with zeros, a negative precision means 6. */
static size_t format_number(char *out, size_t size, double x, int length, int precision)
{
    if (precision < 0) precision = 6;
    int n = length < 0 ? snprintf(out, size, "%0*.*f", -length, precision, x)
                       : snprintf(out, size, "%*.*f", length, precision, x);
    return (size_t)n;
}

typedef struct { int length, precision; } NumberFormat;

static NumberFormat read_format(Parser *p, Place where)
{
    NumberFormat f;
    accept_comma(p);
    f.length = parse_int(p);
    accept_comma(p);
    f.precision = parse_int(p);
    if (f.length > TEXT_MAX_DIGITS || f.length < -TEXT_MAX_DIGITS || f.precision > TEXT_MAX_DIGITS)
        parse_fail(p, where, "a number is written with at most %d characters", TEXT_MAX_DIGITS);
    return f;
}

enum { NUMBER_ROOM = 2 * TEXT_MAX_DIGITS + 400 };   /* the digits asked for, and the 309 of the largest double */

Term text_str(Parser *p, const Builtin *self, Place where)
{
    char text[NUMBER_ROOM];
    Place opened = open_arguments(p);
    double x = parse_float(p);
    NumberFormat f = read_format(p, where);
    close_arguments(p, self, opened);
    return keep(p, where, text, format_number(text, sizeof text, x, f.length, f.precision));
}

/* vstr(n, V, separator, length, precision) */
Term text_vstr(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    int n = parse_int(p);
    accept_comma(p);
    Place at = here(p);
    Term v = need_numbers(p, at, parse_sum(p));
    accept_comma(p);
    const char *separator = parse_string(p);
    NumberFormat f = read_format(p, where);
    close_arguments(p, self, opened);
    if (n < 1 || n > 5) parse_fail(p, where, "vstr writes 1 to 5 components, not %d", n);
    size_t gap = strlen(separator), length = 0;
    char *text = arena_alloc(p->arena, (NUMBER_ROOM + gap) * 5, 1);
    for (int i = 0; i < n; i++) {
        if (i > 0) memcpy(text + length, separator, gap), length += gap;
        double x = v.n == 1 ? v.v[0] : i < v.n ? v.v[i] : 0;
        length += format_number(text + length, NUMBER_ROOM, x, f.length, f.precision);
    }
    return keep(p, where, text, length);
}

/* ---- strings from strings ---- */

static Term join(Parser *p, Place where, const char *a, const char *b)
{
    size_t n = strlen(a), m = strlen(b);
    char *text = room_for(p, where, n + m);
    memcpy(text, a, n);
    memcpy(text + n, b, m);
    return term_string(text);
}

Term text_concat(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    Term t = term_string(parse_string(p));
    while (accept_punct(p, ',')) t = join(p, where, t.string, parse_string(p));
    close_arguments(p, self, opened);
    return t;
}

static Term convert(Parser *p, const Builtin *self, Place where, int (*to)(int c))
{
    Place opened = open_arguments(p);
    const char *s = parse_string(p);
    close_arguments(p, self, opened);
    size_t n = strlen(s);
    char *text = room_for(p, where, n);
    for (size_t i = 0; i < n; i++) text[i] = (char)to((unsigned char)s[i]);
    return term_string(text);
}

Term text_strlwr(Parser *p, const Builtin *self, Place where) { return convert(p, self, where, tolower); }
Term text_strupr(Parser *p, const Builtin *self, Place where) { return convert(p, self, where, toupper); }

/* substr(s, first, n): characters are counted from 1 */
Term text_substr(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    const char *s = parse_string(p);
    accept_comma(p);
    int first = parse_int(p);
    accept_comma(p);
    int n = parse_int(p);
    close_arguments(p, self, opened);
    size_t length = strlen(s);
    if (first < 1 || n < 0 || (size_t)first - 1 + (size_t)n > length)
        parse_fail(p, where, "substr: characters %d to %lld of a string of %zu", first, (long long)first + n - 1, length);
    return keep(p, where, s + first - 1, (size_t)n);
}
