/* Going on after an error: to the end of the statement that failed, and no further. The text is read again from where the
 * statement began, brackets are counted, directives are passed over unexecuted. If the brackets do not close (one of them
 * was the error), the next word that begins statements is taken for one where it stands at the margin. */
#include "parser/core.h"

#include <string.h>

/* Reads on past errors of spelling, which have been told or will not be. */
static Token read_past(Parser *p, Cursor *c)
{
    Token t;
    while (lexer_read(c, &p->symbols, &t)) continue;
    return t;
}

static bool is_one_of(const Token *t, const char *const words[])
{
    for (; t->kind == TOKEN_WORD && *words; words++) {
        if (strcmp(t->text, *words) == 0) return true;
    }
    return false;
}

static bool begins_statement(const Token *t)
{
    if (t->kind == TOKEN_PUNCT && t->punct == '#') return true;
    return is_one_of(t, parse_object_words());
}

/* ---- counting brackets ---- */

typedef struct {
    int depth;                       /* of { } */
    int parens;                      /* of ( ) and [ ] */
    int angles;                      /* of < > in a trimmed_nurbs block: 0 outside */
    bool after_trimmed;
    int directives;                  /* that wait for #end */
    bool had_angles, had_directives;
} Brackets;

static void count_angle(Brackets *b, char punct)
{
    if (b->parens > 0) return;       /* a comparison */
    if (punct == '<' && (b->after_trimmed || b->angles > 0)) b->angles++, b->had_angles = true;
    if (punct == '>' && b->angles > 0) b->angles--;
}

static void count(Brackets *b, const Token *t)
{
    if (t->kind == TOKEN_PUNCT) {
        b->depth += (t->punct == '{') - (t->punct == '}');
        b->parens += (t->punct == '(' || t->punct == '[') - (t->punct == ')' || t->punct == ']');
        count_angle(b, t->punct);
    }
    b->after_trimmed = t->kind == TOKEN_WORD && strcmp(t->text, "trimmed_nurbs") == 0;
}

static const char *const openers[] = { "if", "ifdef", "ifndef", "while", "for", "switch", "macro", NULL };
static const char *const branches[] = { "else", "elseif", "case", "range", "end", NULL };

/* After '#': counts the directive; false: it belongs to a block round the statement. */
static bool count_directive(Parser *p, Brackets *b, Cursor *c)
{
    Cursor before = *c;
    Token word = read_past(p, c);
    if (is_one_of(&word, openers)) b->directives++, b->had_directives = true;
    if (!is_one_of(&word, branches)) return true;
    if (b->directives == 0) return *c = before, false;
    if (strcmp(word.text, "end") == 0) {
        b->directives--;
        *c = before;                 /* the word is read again, as the last of its statement */
    }
    return true;
}

/* ---- the end of a statement ---- */

typedef struct {
    Cursor start;                    /* at the statement's first token */
    const char *error;               /* how far reading had come */
    Cursor end;                      /* found: before the next statement */
    enum { ENDS_BY_BRACES, ENDS_WITH_LINE, ENDS_BY_PARENS } form;
} Search;

/* Directives that are not definitions or blocks take one line; a macro's call ends with its arguments. */
static void find_form(Parser *p, Search *s)
{
    static const char *const braced[] = { "declare", "local", "default", NULL };
    Cursor c = s->start;
    Token t = read_past(p, &c);
    s->form = ENDS_BY_BRACES;
    if (t.kind == TOKEN_PUNCT && t.punct == '#') {
        t = read_past(p, &c);
        if (!is_one_of(&t, braced) && !is_one_of(&t, openers)) s->form = ENDS_WITH_LINE;
    } else if (t.kind == TOKEN_WORD) {
        const Value *v = word_value(word_of(t.text));
        if (v && v->kind == VALUE_MACRO) s->form = ENDS_BY_PARENS;
    }
}

static bool is_closed(const Brackets *b)
{
    return b->depth <= 0 && b->angles == 0 && b->directives == 0;
}

/* Is t, which has been counted, the last token of the statement? */
static bool is_last(const Search *s, const Brackets *b, const Token *t)
{
    if (!is_closed(b) || t->kind == TOKEN_END || (s->form == ENDS_BY_PARENS && b->parens > 0)) return false;
    if (t->kind == TOKEN_WORD) return strcmp(t->text, "end") == 0 && b->had_directives;
    return t->punct == '}' || t->punct == ';' || (t->punct == '>' && b->had_angles)
        || (t->punct == ')' && s->form == ENDS_BY_PARENS);
}

/* Does t, at c, begin something else? */
static bool is_next(const Search *s, const Brackets *b, const Token *t, const Cursor *c)
{
    if (t->kind == TOKEN_END) return true;
    if (!is_closed(b) || c->at == s->start.at) return false;
    if (s->form == ENDS_WITH_LINE && c->line > s->start.line) return true;
    return b->parens <= 0 && begins_statement(t);
}

static bool is_first_on_line(const Cursor *c)
{
    for (const char *q = c->line_start; q < c->at; q++) {
        if (*q != ' ' && *q != '\t') return false;
    }
    return true;
}

/* Is the token at c the first on its line, as the statement's first is on its own, and not further right? */
static bool is_at_margin(const Search *s, const Cursor *c)
{
    return c->at != s->start.at && is_first_on_line(c) && is_first_on_line(&s->start)
        && c->at - c->line_start <= s->start.at - s->start.line_start;
}

/* The end by brackets; false: they do not close. */
static bool find_end(Parser *p, Search *s)
{
    Cursor c = s->start;
    Brackets b = { .depth = 0 };
    for (;;) {
        (void)cursor_skip_blank(&c);
        s->end = c;
        Token t = read_past(p, &c);
        if (t.kind == TOKEN_END) return s->end = c, is_closed(&b);
        if (s->end.at >= s->error && is_next(s, &b, &t, &s->end)) return true;
        if (t.kind == TOKEN_PUNCT && t.punct == '#' && !count_directive(p, &b, &c) && s->end.at != s->start.at)
            return is_closed(&b);
        count(&b, &t);
        s->end = c;
        if (c.at > s->error && is_last(s, &b, &t)) return true;
    }
}

/* The next directive or statement at the margin behind the error, else the end of the text. */
static void find_margin(Parser *p, Search *s)
{
    Cursor c = s->start;
    for (;;) {
        (void)cursor_skip_blank(&c);
        s->end = c;
        Token t = read_past(p, &c);
        if (t.kind == TOKEN_END) {
            s->end = c;
            return;
        }
        if (s->end.at >= s->error && begins_statement(&t) && is_at_margin(s, &s->end)) return;
    }
}

/* A statement that began in a macro which has ended meanwhile: what is left of it is in the frames below. */
static bool is_mark_alive(const Parser *p)
{
    return p->mark.n_frames <= p->n_frames && p->mark.n_frames > 0
        && p->frames[p->mark.n_frames - 1].serial == p->mark.serial;
}

void recover_from_error(Parser *p)
{
    bool is_alive = is_mark_alive(p);
    while (is_alive && p->n_frames > p->mark.n_frames) input_pop(p);
    if (is_alive && p->n_blocks > p->mark.n_blocks) p->n_blocks = p->mark.n_blocks;
    Frame *f = top_frame(p);
    Search s = { .start = is_alive ? p->mark.cursor : f->cursor, .error = f->cursor.at };
    size_t length;
    if (p->stopped_at.source == f->cursor.source) s.error = place_text(p->stopped_at, &length);
    (void)cursor_skip_blank(&s.start);
    find_form(p, &s);
    if (!find_end(p, &s)) find_margin(p, &s);
    if (s.end.at <= s.start.at) (void)read_past(p, &s.end);   /* go on, whatever happens */
    f->cursor = s.end;
}

/* ---- the end of a value ---- */

/* The bodies of macros that the value was being made of are given up. */
static void leave_macros(Parser *p, const ValueStart *start)
{
    if (p->n_frames <= start->n_frames) return;
    const Frame *f = &p->frames[start->n_frames];
    p->braces = f->braces, p->parens = f->parens;
    while (p->n_frames > start->n_frames) input_pop(p);
    p->ahead = (Lookahead){ .is_full = false };
    p->last_punct = ')';
}

/* Behind a closing bracket: does the value go on? Nothing is carried out to find that out. */
static bool goes_on(Parser *p, bool is_texture)
{
    char c = input_next_char(p);
    bool is_block = p->last_punct == '}';
    if (c != '\0' && strchr(is_block ? ";" : "+-*/.?:;,<>{[", c)) return true;
    return is_block && is_texture && c == 't' && peek_word(p, "texture");
}

/* Directives are carried out on the way: they may declare things that are supported. */
void recover_from_unsupported(Parser *p, const ValueStart *start, bool is_texture)
{
    leave_macros(p, start);
    Brackets b = { .angles = p->angle_braces >= start->braces };
    for (;;) {
        bool is_outside = p->braces <= start->braces && p->parens <= start->parens && b.angles == 0;
        bool is_closed = p->last_punct == '}' || p->last_punct == ')';
        if (is_outside && is_closed && !p->ahead.is_full && !goes_on(p, is_texture)) return;
        const Token *t = look(p);
        if (t->kind == TOKEN_END || p->ahead.is_raw) return;
        if (is_outside && t->kind == TOKEN_PUNCT && t->punct == ';') return;
        count(&b, t);
        input_take(p);
    }
}
