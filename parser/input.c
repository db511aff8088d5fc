/* The stream of tokens that the rules see: frames of text, one token of look-ahead, directives and macros carried out on the
 * way. The reading functions of state.h are at the end. */
#include "parser/core.h"

#include <string.h>

/* ---- frames ---- */

static void push_frame(Parser *p, Frame f)
{
    if (p->n_frames == PARSER_MAX_FRAMES || !symbols_enter(&p->symbols))
        parse_fail(p, f.called, "macros and include files are nested more than %d deep", PARSER_MAX_FRAMES);
    f.first_block = p->n_blocks;
    f.braces = p->braces, f.parens = p->parens;
    f.serial = ++p->n_serials;
    p->frames[p->n_frames++] = f;
}

void input_push_file(Parser *p, const SourceText *text, Place called)
{
    if (p->n_includes > PARSER_MAX_INCLUDES)
        parse_fail(p, called, "include files are nested more than %d deep", PARSER_MAX_INCLUDES);
    push_frame(p, (Frame){ .cursor = cursor_make(text), .called = called });
    p->n_includes++;
}

void input_push_macro(Parser *p, const Macro *macro, Place called)
{
    push_frame(p, (Frame){ .cursor = macro->body, .macro = macro, .called = called });
}

void input_pop(Parser *p)
{
    Frame *f = &p->frames[--p->n_frames];
    p->n_blocks = f->first_block;
    if (!f->macro) p->n_includes--;
    symbols_leave(&p->symbols);
}

/* ---- limits ---- */

void input_deeper(Parser *p, Place where)
{
    if (p->nesting == PARSER_MAX_NESTING) parse_fail(p, where, "this is nested more than %d deep", PARSER_MAX_NESTING);
    p->nesting++;
}

void input_step(Parser *p, Place where)
{
    uint64_t limit = p->options->max_steps > 0 ? (uint64_t)p->options->max_steps : PARSER_MAX_STEPS;
    if (diag_error_count(p->diag) > 0 && ++p->n_steps_after_error > PARSER_MAX_STEPS_AFTER_ERROR) {
        p->is_halted = true;
        parse_fail(p, where, "reading ends here: after an error this seems to go on for ever");
    }
    if (++p->n_steps <= limit) return;
    p->is_halted = true;
    parse_fail(p, where, "more than %llu rounds of loops and calls of macros: this seems to go on for ever",
               (unsigned long long)limit);
}

/* ---- the guard of #declare ---- */

Guard input_guard(Parser *p)
{
    Guard before = p->guard;
    p->guard = (Guard){ true, p->n_frames, p->braces, p->n_blocks };
    p->last_punct = '\0';
    return before;
}

void input_unguard(Parser *p, Guard before)
{
    p->guard = before;
    if (p->ahead.is_raw) p->ahead = (Lookahead){ .is_full = false };
}

static bool is_guarded(const Parser *p)
{
    return p->guard.is_on && p->guard.n_frames == p->n_frames && p->guard.braces == p->braces;
}

static bool is_one_of(const char *text, const char *const words[])
{
    for (; *words; words++) {
        if (strcmp(text, *words) == 0) return true;
    }
    return false;
}

/* The directive at the cursor (behind '#') cannot be part of a value if it defines something, or belongs to a block that
 * began before the value. */
static bool is_outside_of_value(Parser *p)
{
    static const char *const definitions[] = { "declare", "local", "undef", "macro", "include", "version", "default", NULL };
    static const char *const branches[] = { "else", "elseif", "end", "case", "range", "break", NULL };
    Cursor c = top_frame(p)->cursor;
    Token t;
    if (lexer_read(&c, &p->symbols, &t) || t.kind != TOKEN_WORD) return false;
    return is_one_of(t.text, definitions) || (p->n_blocks <= p->guard.n_blocks && is_one_of(t.text, branches));
}

/* ---- filling ---- */

static void set_mark(Parser *p)
{
    Frame *f = top_frame(p);
    p->mark = (Mark){ p->n_frames, f->serial, f->cursor, p->n_blocks };
}

static void read_token(Parser *p, Token *out)
{
    const char *error = lexer_read(&top_frame(p)->cursor, &p->symbols, out);
    if (error) parse_fail(p, out->place, "%s", error);
}

/* The token is there already. */
static void show_ahead(Parser *p, bool is_raw)
{
    p->ahead.is_full = true;
    p->ahead.is_raw = is_raw;
    p->ahead.element = NULL;
}

/* The value of a #declare may have been read on to the first token of the next statement. */
static void mark_ahead(Parser *p)
{
    set_mark(p);
    p->mark.cursor = p->before_ahead;
}

/* Shows a token that ends a value without passing it. */
static void stop_before(Parser *p, const Cursor *before)
{
    top_frame(p)->cursor = *before;
    show_ahead(p, true);
}

static bool is_macro(const Token *t)
{
    const Value *v = t->kind == TOKEN_WORD ? word_value(word_of(t->text)) : NULL;
    return v && v->kind == VALUE_MACRO;
}

/* Carries out the directive or macro call that begins with t. */
static void carry_out(Parser *p, Token t)
{
    bool was_between = p->is_between_statements;
    p->is_between_statements = false;
    input_deeper(p, t.place);
    if (t.kind == TOKEN_PUNCT) directive_run(p, t.place);
    else macro_call(p, &t);
    input_shallower(p);
    p->is_between_statements = was_between;
}

static bool is_to_carry_out(const Token *t)
{
    return (t->kind == TOKEN_PUNCT && t->punct == '#') || is_macro(t);
}

static bool ends_guarded_value(Parser *p, const Token *t)
{
    if (t->kind == TOKEN_END) return true;
    if (!is_to_carry_out(t)) return false;
    return p->last_punct == '}' || (t->kind == TOKEN_PUNCT && is_outside_of_value(p));
}

/* Each token is read into its place, not copied there. */
void input_fill(Parser *p)
{
    const Token *t = &p->ahead.token;
    for (;;) {
        if (p->is_between_statements) set_mark(p);
        Cursor before = top_frame(p)->cursor;
        read_token(p, &p->ahead.token);
        if (is_guarded(p) && ends_guarded_value(p, t)) {
            stop_before(p, &before);
            return;
        }
        if (t->kind == TOKEN_END) {
            block_check_frame_end(p);
            if (p->n_frames == 1) {
                stop_before(p, &before);
                return;
            }
            input_pop(p);
        } else if (is_to_carry_out(t)) {
            carry_out(p, *t);
            if (p->ahead.is_full && p->is_between_statements) mark_ahead(p);
            if (p->ahead.is_full) return;
        } else {
            if (p->guard.is_on) p->before_ahead = before;
            show_ahead(p, false);
            return;
        }
    }
}

/* ---- taking ---- */

static void count_brackets(Parser *p, const Token *t)
{
    if (t->punct == '{' && ++p->braces > PARSER_MAX_BRACES)
        parse_fail(p, t->place, "blocks are nested more than %d deep", PARSER_MAX_BRACES);
    if (t->punct == '}') p->braces--;
    p->parens += (t->punct == '(' || t->punct == '[') - (t->punct == ')' || t->punct == ']');
    if (t->punct == '<' && p->last_was_trimmed) p->angle_braces = p->braces;
}

void input_take(Parser *p)
{
    const Token *t = &p->ahead.token;
    if (p->ahead.is_raw) return;
    p->last_punct = '\0';
    p->last_place = t->place;
    if (t->kind == TOKEN_PUNCT) {
        count_brackets(p, t);
        p->last_punct = t->punct;
    }
    p->last_was_trimmed = t->text == p->trimmed_nurbs;
    p->ahead.is_full = false;
    p->ahead.element = NULL;
}

Token input_raw(Parser *p)
{
    Token t;
    if (!p->ahead.is_full) return read_token(p, &t), t;
    t = p->ahead.token;
    input_take(p);
    return t;
}

char input_next_char(Parser *p)
{
    return cursor_next_char(top_frame(p)->cursor);
}

/* ---- state.h ---- */

Token peek(Parser *p)
{
    return *look(p);
}

Token next(Parser *p)
{
    (void)look_slot(p);            /* an array's name is taken with its subscript */
    Token t = *look(p);
    input_take(p);
    return t;
}

Place here(Parser *p)
{
    return look(p)->place;
}

bool peek_word(Parser *p, const char *word)
{
    const Token *t = look(p);
    return t->kind == TOKEN_WORD && strcmp(t->text, word) == 0;
}

bool peek_punct(Parser *p, char punct)
{
    return at_punct(p, punct);
}

bool accept_word(Parser *p, const char *word)
{
    if (!peek_word(p, word)) return false;
    input_take(p);
    return true;
}

bool accept_punct(Parser *p, char punct)
{
    if (!at_punct(p, punct) || p->ahead.is_raw) return false;
    input_take(p);
    return true;
}

void accept_comma(Parser *p)
{
    (void)accept_punct(p, ',');
}
