/* The list of messages and how one is printed: its place, its words, the line of the source and a caret below it. */
#include "render/diag.h"

#include <string.h>

#define INDENT "    "
#define LINE_SHOWN 110          /* bytes of a source line that are shown: longer ones are cut on both sides */
#define LINE_BEFORE 60          /* of these, at most so many before the caret */

typedef struct {
    DiagLevel level;
    Place where;
    const char *text;
} Message;

struct Diag {
    Arena *arena;
    Message *messages;
    size_t n_messages, messages_capacity;
    const char **keys;          /* of diag_warning_once */
    size_t n_keys, keys_capacity;
    int n_errors, n_warnings;
};

Diag *diag_new(Arena *a)
{
    Diag *d = ARENA_NEW(a, Diag);
    d->arena = a;
    return d;
}

static char *format_text(Arena *a, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    int n = vsnprintf(NULL, 0, format, again);
    va_end(again);
    if (n < 0) return arena_strdup(a, format);
    char *text = arena_alloc(a, (size_t)n + 1, 1);
    vsnprintf(text, (size_t)n + 1, format, arguments);
    return text;
}

void diag_add(Diag *d, DiagLevel level, Place where, const char *format, va_list arguments)
{
    if (level == DIAG_WARNING) d->n_warnings++;
    else if (d->n_errors++ >= DIAG_MAX_ERRORS) return;
    const char *text = format_text(d->arena, format, arguments);
    ARENA_PUSH(d->arena, d->messages, d->n_messages, d->messages_capacity) = (Message){ level, where, text };
}

void diag_error(Diag *d, Place where, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    diag_add(d, DIAG_ERROR, where, format, arguments);
    va_end(arguments);
}

void diag_warning(Diag *d, Place where, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    diag_add(d, DIAG_WARNING, where, format, arguments);
    va_end(arguments);
}

static bool is_new_key(Diag *d, const char *key)
{
    for (size_t i = 0; i < d->n_keys; i++)
        if (strcmp(d->keys[i], key) == 0) return false;
    ARENA_PUSH(d->arena, d->keys, d->n_keys, d->keys_capacity) = key;
    return true;
}

void diag_warning_once(Diag *d, Place where, const char *key, const char *format, ...)
{
    if (!is_new_key(d, key)) return;
    va_list arguments;
    va_start(arguments, format);
    diag_add(d, DIAG_WARNING, where, format, arguments);
    va_end(arguments);
}

int diag_error_count(const Diag *d) { return d->n_errors; }
int diag_warning_count(const Diag *d) { return d->n_warnings; }
bool diag_is_full(const Diag *d) { return d->n_errors >= DIAG_MAX_ERRORS; }

typedef struct { const char *text; size_t n; } Line;

static Line line_of(const SourceText *source, uint32_t number)
{
    const char *begin = source->text, *end = source->text + source->n_bytes;
    for (uint32_t i = 1; i < number; i++) {
        const char *newline = memchr(begin, '\n', (size_t)(end - begin));
        if (!newline) return (Line){ end, 0 };
        begin = newline + 1;
    }
    const char *newline = memchr(begin, '\n', (size_t)(end - begin));
    size_t n = (size_t)((newline ? newline : end) - begin);
    if (n > 0 && begin[n - 1] == '\r') n--;
    return (Line){ begin, n };
}

static bool is_continuation(char c) { return ((unsigned char)c & 0xC0) == 0x80; }   /* of a UTF-8 character */

/* Byte for byte, but nothing that a terminal would take for a command. */
static void print_line(Line l, size_t from, size_t to, FILE *out)
{
    fputs(from > 0 ? INDENT "..." : INDENT, out);
    for (size_t i = from; i < to; i++) {
        unsigned char c = (unsigned char)l.text[i];
        fputc((c < ' ' && c != '\t') || c == 127 ? ' ' : c, out);
    }
    fputs(to < l.n ? "...\n" : "\n", out);
}

/* Blank as wide as what stands above, tabs kept, a character of several bytes counted once; then ^~~~. */
static void print_caret(Line l, size_t from, size_t to, size_t at, uint32_t length, FILE *out)
{
    fputs(from > 0 ? INDENT "   " : INDENT, out);
    for (size_t i = from; i < at; i++) {
        if (i < l.n && l.text[i] == '\t') fputc('\t', out);
        else if (i >= l.n || !is_continuation(l.text[i])) fputc(' ', out);
    }
    fputc('^', out);
    for (size_t i = at + 1; i < at + length && i < to; i++)
        if (!is_continuation(l.text[i])) fputc('~', out);
    fputc('\n', out);
}

static void print_source(const Place *p, FILE *out)
{
    Line l = line_of(p->source, p->line);
    size_t at = p->column > 0 ? p->column - 1 : 0;
    if (at > l.n) at = l.n;                                  /* the end of the line, or of the file */
    size_t from = l.n > LINE_SHOWN && at > LINE_BEFORE ? at - LINE_BEFORE : 0;
    while (from > 0 && is_continuation(l.text[from])) from--;
    size_t to = l.n - from > LINE_SHOWN ? from + LINE_SHOWN : l.n;
    while (to < l.n && is_continuation(l.text[to])) to++;
    print_line(l, from, to, out);
    print_caret(l, from, to, at, p->length, out);
}

void diag_print(const Diag *d, FILE *out)
{
    for (size_t i = 0; i < d->n_messages; i++) {
        const Message *m = &d->messages[i];
        const char *level = m->level == DIAG_ERROR ? "error" : "warning";
        if (!m->where.source) {
            fprintf(out, "%s: %s\n", level, m->text);
            continue;
        }
        fprintf(out, "%s:%u:%u: %s: %s\n", m->where.source->name, (unsigned)m->where.line, (unsigned)m->where.column, level,
                m->text);
        print_source(&m->where, out);
    }
    if (d->n_errors > DIAG_MAX_ERRORS) fprintf(out, "%d errors shown, more not\n", DIAG_MAX_ERRORS);
}
