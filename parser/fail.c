/* What the parser says when it fails, and how it gets away: parse_fail jumps to the nearest handler, a statement's or, for
 * what is only unsupported, that of a #declare. This is the only longjmp of the program: nothing is lost by it, since all
 * that was built lies in the arena. */
#include "parser/core.h"

#include <string.h>

enum { MESSAGE_LENGTH = 1024, SHOWN_LENGTH = 40 };

/* ---- jumping ---- */

bool parse_guarded(Parser *p, bool only_unsupported, void (*rule)(Parser *p, void *context), void *context)
{
    Handler h = { .outer = p->handler, .only_unsupported = only_unsupported, .nesting = p->nesting, .guard = p->guard };
    p->handler = &h;
    if (setjmp(h.jump) == 0) {
        rule(p, context);
        p->handler = h.outer;
        return true;
    }
    p->handler = h.outer;
    p->nesting = h.nesting;
    p->guard = h.guard;
    p->is_between_statements = false;
    if (!only_unsupported) {
        p->stopped_at = p->ahead.is_full ? p->ahead.token.place : (Place){ .source = NULL };
        p->ahead = (Lookahead){ .is_full = false };
    }
    return false;
}

static _Noreturn void jump(Parser *p, bool is_unsupported)
{
    Handler *h = p->handler;
    while (h->only_unsupported && !is_unsupported) h = h->outer;
    longjmp(h->jump, 1);
}

/* ---- messages ---- */

/* In the body of a macro, the place of the call is told too. */
static const char *macro_note(Parser *p, Place where)
{
    const Frame *f = top_frame(p);
    if (p->n_frames == 0 || !f->macro || f->cursor.source != where.source) return "";
    return arena_printf(p->arena, " (in macro '%s', called at %s:%u)", f->macro->name->text, f->called.source->name,
                        f->called.line);
}

/* An error in a loop is told once, not in every round. */
static bool was_told(Parser *p, Place where)
{
    Place last = p->last_error;
    p->last_error = where;
    return where.source && where.source == last.source && where.line == last.line && where.column == last.column;
}

static void add_error(Parser *p, Place where, const char *format, va_list arguments)
{
    char message[MESSAGE_LENGTH];
    if (was_told(p, where)) return;
    vsnprintf(message, sizeof message, format, arguments);
    diag_error(p->diag, where, "%s%s", message, macro_note(p, where));
}

_Noreturn void parse_fail(Parser *p, Place where, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_error(p, where, format, arguments);
    va_end(arguments);
    jump(p, false);
}

void parse_error(Parser *p, Place where, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_error(p, where, format, arguments);
    va_end(arguments);
}

void parse_warn(Parser *p, Place where, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    diag_add(p->diag, DIAG_WARNING, where, format, arguments);
    va_end(arguments);
}

void parse_warn_once(Parser *p, Place where, const char *key, const char *format, ...)
{
    char message[MESSAGE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    diag_warning_once(p->diag, where, key, "%s", message);
}

/* ---- what was found ---- */

static const char *end_name(Parser *p)
{
    const Frame *f = top_frame(p);
    return f->macro ? arena_printf(p->arena, "the end of macro '%s'", f->macro->name->text) : "the end of the file";
}

const char *token_name(Parser *p, const Token *t)
{
    if (t->kind == TOKEN_END) return end_name(p);
    size_t length;
    const char *text = place_text(t->place, &length), *newline = memchr(text, '\n', length);
    if (t->kind == TOKEN_PUNCT && t->punct == '#') {                     /* with the directive's word */
        Place word = t->place;
        word.length = SHOWN_LENGTH;
        text = place_text(word, &length);
        length = 1 + strspn(text + 1, "abcdefghijklmnopqrstuvwxyz");
    }
    if (newline) length = (size_t)(newline - text);
    if (length > SHOWN_LENGTH) return arena_printf(p->arena, "'%.*s...'", SHOWN_LENGTH, text);
    return arena_printf(p->arena, "'%.*s'", (int)length, text);
}

static _Noreturn void fail_unknown(Parser *p, const Token *t)
{
    const char *nearest = symbols_nearest(&p->symbols, t->text);
    if (nearest) parse_fail(p, t->place, "unknown identifier '%s'; did you mean '%s'?", t->text, nearest);
    parse_fail(p, t->place, "unknown identifier '%s'", t->text);
}

_Noreturn void parse_fail_unsupported(Parser *p, Token feature)
{
    if (!p->handler->only_unsupported)
        parse_fail(p, feature.place, "'%s' is a POV-Ray feature that is not supported here", feature.text);
    p->unsupported = (Value){ .kind = VALUE_UNSUPPORTED };
    p->unsupported.unsupported.feature = feature.text;
    p->unsupported.unsupported.place = arena_copy(p->arena, &feature.place, 1, sizeof feature.place);
    jump(p, true);
}

_Noreturn void fail_unsupported_value(Parser *p, const Token *name, const Value *v)
{
    Place declared = *v->unsupported.place;
    if (p->handler->only_unsupported) {
        p->unsupported = *v;
        jump(p, true);
    }
    parse_fail(p, name->place, "'%s' uses '%s' (%s:%u), a POV-Ray feature that is not supported here", name->text,
               v->unsupported.feature, declared.source->name, declared.line);
}

_Noreturn void parse_fail_expected(Parser *p, const char *what)
{
    Token t = *look(p);
    if (t.kind != TOKEN_WORD) parse_fail(p, t.place, "expected %s, found %s", what, token_name(p, &t));
    const Word *w = word_of(t.text);
    const Value *v = look_slot(p);
    if (v && v->kind == VALUE_UNSUPPORTED) fail_unsupported_value(p, &t, v);
    if (v) parse_fail(p, t.place, "expected %s, found '%s' (%s)", what, t.text, value_kind_name(v->kind));
    if (w->class == WORD_UNSUPPORTED) parse_fail_unsupported(p, t);
    if (w->class == WORD_FREE && !w->builtin) fail_unknown(p, &t);
    parse_fail(p, t.place, "expected %s, found '%s'", what, t.text);
}

/* ---- expecting ---- */

Place expect_punct(Parser *p, char punct)
{
    Place where = here(p);
    if (!accept_punct(p, punct)) {
        char what[] = { '\'', punct, '\'', '\0' };
        parse_fail_expected(p, what);
    }
    return where;
}

Place expect_open(Parser *p, const char *what)
{
    Place where = here(p);
    if (!accept_punct(p, '{')) parse_fail_expected(p, arena_printf(p->arena, "'{' after %s", what));
    return where;
}

void expect_close(Parser *p, char punct, const char *what, Place opened)
{
    if (!at_punct(p, punct) || p->ahead.is_raw)
        parse_fail_expected(p, arena_printf(p->arena, "'%c' to close %s (line %u)", punct, what, opened.line));
    input_take(p);
    if (punct == '>' && strcmp(what, "trimmed_nurbs") == 0) p->angle_braces = -1;
}
