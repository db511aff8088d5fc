/* The lexer. POV-Ray's rules: numbers have no sign, words are [A-Za-z_][A-Za-z0-9_]*, strings may run over lines and keep
 * their escapes, comments nest. Numbers are correctly rounded: a decimal of up to 2^53 with an exponent of up to 22 is one
 * exact operation ([Cli90]), all others go to strtod. */
#include "parser/lexer.h"

#include <stdlib.h>
#include <string.h>

static bool is_digit(char c) { return (unsigned char)(c - '0') < 10; }
static bool is_letter(char c) { return (unsigned char)((c | 32) - 'a') < 26 || c == '_'; }

Cursor cursor_make(const SourceText *source)
{
    const char *text = source->text;
    bool has_mark = source->n_bytes >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0;
    return (Cursor){ .source = source, .at = text + (has_mark ? 3 : 0), .end = text + source->n_bytes, .line_start = text,
                     .line = 1 };
}

Place cursor_place(const Cursor *c, const char *from, size_t length)
{
    return (Place){ c->source, c->line, (uint32_t)(from - c->line_start) + 1, (uint32_t)length };
}

static void new_line(Cursor *c, const char *newline)
{
    c->line++;
    c->line_start = newline + 1;
}

/* Behind a comment that begins at the cursor; NULL: it has no end, and the cursor stays. */
static const char *skip_block_comment(Cursor *c)
{
    Cursor inner = *c;
    int depth = 0;
    for (const char *p = c->at; p < c->end; p++) {
        if (*p == '\n') new_line(&inner, p);
        if (*p == '/' && p[1] == '*') depth++, p++;
        else if (*p == '*' && p[1] == '/') depth--, p++;
        if (depth == 0) {
            c->line = inner.line, c->line_start = inner.line_start;
            return c->at = p + 1;
        }
    }
    return NULL;
}

bool cursor_skip_blank(Cursor *c)
{
    for (;;) {
        const char *p = c->at;
        while (p < c->end && (*p == ' ' || (*p >= '\t' && *p <= '\r'))) {
            if (*p == '\n') new_line(c, p);
            p++;
        }
        c->at = p;
        if (p >= c->end || *p != '/') return true;
        if (p[1] == '/') {
            const char *newline = memchr(p, '\n', (size_t)(c->end - p));
            c->at = newline ? newline : c->end;
        } else if (p[1] != '*') {
            return true;
        } else if (!skip_block_comment(c)) {
            return false;
        }
    }
}

/* ---- numbers ---- */

static const double powers_of_ten[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                        1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };

/* The number spelt by [from, to): copied, since the text may go on with what strtod would take too. */
static double read_slowly(Arena *a, const char *from, const char *to)
{
    char local[128];
    size_t n = (size_t)(to - from);
    ArenaMark mark = arena_mark(a);
    char *copy = n < sizeof local ? local : arena_alloc(a, n + 1, 1);
    memcpy(copy, from, n);
    copy[n] = '\0';
    double value = strtod(copy, NULL);
    arena_reset(a, mark);
    return value;
}

/* Behind the exponent at p, its value in *exponent; p itself if there is none. */
static const char *read_exponent(const char *p, int *exponent)
{
    if ((*p | 32) != 'e') return p;
    const char *q = p + 1;
    bool negative = *q == '-';
    if (*q == '-' || *q == '+') q++;
    if (!is_digit(*q)) return p;
    int e = 0;
    for (; is_digit(*q); q++) {
        if (e < 100000) e = 10 * e + (*q - '0');
    }
    *exponent += negative ? -e : e;
    return q;
}

static const char *read_number(Cursor *c, Symbols *s, Token *out)
{
    const char *from = c->at, *p = from;
    uint64_t mantissa = 0;
    int exponent = 0, n_digits = 0;
    for (; is_digit(*p); p++, n_digits++) mantissa = 10 * mantissa + (uint64_t)(*p - '0');
    if (*p == '.') {
        for (p++; is_digit(*p); p++, n_digits++, exponent--) mantissa = 10 * mantissa + (uint64_t)(*p - '0');
    }
    p = read_exponent(p, &exponent);
    c->at = p;
    out->kind = TOKEN_NUMBER;
    out->place = cursor_place(c, from, (size_t)(p - from));
    bool is_exact = n_digits <= 19 && mantissa <= (UINT64_C(1) << 53) && exponent >= -22 && exponent <= 22;
    if (!is_exact) out->number = read_slowly(s->arena, from, p);
    else if (exponent < 0) out->number = (double)mantissa / powers_of_ten[-exponent];
    else out->number = (double)mantissa * powers_of_ten[exponent];
    return out->number <= 1.7976931348623157e308 ? NULL : "this number is too large";
}

/* ---- words, strings, punctuation ---- */

static void read_word(Cursor *c, Symbols *s, Token *out)
{
    const char *from = c->at, *p = from;
    while (is_letter(*p) || is_digit(*p)) p++;
    c->at = p;
    out->kind = TOKEN_WORD;
    out->place = cursor_place(c, from, (size_t)(p - from));
    out->text = symbols_intern(s, from, (size_t)(p - from))->text;
}

static const char *read_string(Cursor *c, Symbols *s, Token *out)
{
    const char *from = c->at + 1, *p = from;
    out->kind = TOKEN_STRING;
    out->place = cursor_place(c, c->at, 1);
    for (; p < c->end && *p != '"'; p++) {
        if (*p == '\n') new_line(c, p);
        if (*p == '\0') return c->at = p + 1, "a string cannot contain a NUL character";
        if (*p == '\\' && p + 1 < c->end && p[1] != '\n') p++;
    }
    if (p >= c->end) return c->at = c->end, "this string has no closing '\"'";
    out->place.length = (uint32_t)(p + 1 - from + 1);
    c->at = p + 1;
    if (memchr(from, '\\', (size_t)(p - from))) out->text = symbols_unescape(s, from, (size_t)(p - from));
    else out->text = symbols_intern(s, from, (size_t)(p - from))->text;
    return NULL;
}

static const char *bad_character(Cursor *c, Symbols *s, Token *out)
{
    unsigned char byte = (unsigned char)*c->at;
    out->place = cursor_place(c, c->at, 1);
    c->at++;
    while (c->at < c->end && ((unsigned char)*c->at & 0xC0) == 0x80) c->at++;   /* the rest of a UTF-8 sequence */
    if (byte > ' ' && byte < 0x7F) return arena_printf(s->arena, "unexpected character '%c'", byte);
    return arena_printf(s->arena, "unexpected character (byte 0x%02X)", byte);
}

static const char *read_punct(Cursor *c, Symbols *s, Token *out)
{
    char first = *c->at, second = c->at[1];
    if (first == '\0' || !strchr("{}<>()[],;.+-*/?:=!&|#", first)) return bad_character(c, s, out);
    size_t length = second == '=' && (first == '<' || first == '>' || first == '!') ? 2 : 1;
    out->kind = TOKEN_PUNCT;
    out->place = cursor_place(c, c->at, length);
    out->punct = length == 1 ? first : first == '<' ? 'L' : first == '>' ? 'G' : 'N';
    c->at += length;
    return NULL;
}

const char *lexer_read(Cursor *c, Symbols *s, Token *out)
{
    *out = (Token){ .kind = TOKEN_END };
    if (!cursor_skip_blank(c)) {
        out->place = cursor_place(c, c->at, 2);
        c->at = c->end;
        return "this comment has no closing '*/'";
    }
    if (c->at >= c->end) return out->place = cursor_place(c, c->at, 0), NULL;
    char first = *c->at;
    if (is_letter(first)) return read_word(c, s, out), NULL;
    if (is_digit(first) || (first == '.' && is_digit(c->at[1]))) return read_number(c, s, out);
    if (first == '"') return read_string(c, s, out);
    return read_punct(c, s, out);
}

/* ---- looking ahead, skipping ---- */

char cursor_next_char(Cursor c)
{
    return cursor_skip_blank(&c) && c.at < c.end ? *c.at : '\0';
}

static void skip_string(Cursor *c)
{
    for (c->at++; c->at < c->end && *c->at != '"'; c->at++) {
        if (*c->at == '\n') new_line(c, c->at);
        if (*c->at == '\\' && c->at + 1 < c->end && c->at[1] != '\n') c->at++;
    }
    if (c->at < c->end) c->at++;
}

bool cursor_find_directive(Cursor *c)
{
    while (cursor_skip_blank(c) && c->at < c->end) {
        if (*c->at == '#') return c->at++, true;
        if (*c->at == '"') skip_string(c);
        else c->at++;
    }
    c->at = c->end;
    return false;
}

const char *place_text(Place where, size_t *length)
{
    const char *p = where.source->text, *end = p + where.source->n_bytes;
    for (uint32_t line = 1; line < where.line && p < end; line++) {
        const char *newline = memchr(p, '\n', (size_t)(end - p));
        p = newline ? newline + 1 : end;
    }
    p = (size_t)(end - p) < where.column - 1 ? end : p + (where.column - 1);
    size_t left = (size_t)(end - p);
    *length = where.length < left ? where.length : left;
    return p;
}
