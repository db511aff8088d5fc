/* Directives: the table of them, and those that are not blocks: declarations, include files, messages. */
#include "parser/core.h"

#include <stdio.h>
#include <string.h>

/* ---- #declare, #local ---- */

Word *declarable_name(Parser *p, const char *what)
{
    Token t = input_raw(p);
    if (t.kind != TOKEN_WORD) parse_fail(p, t.place, "expected the name %s, found %s", what, token_name(p, &t));
    Word *w = word_of(t.text);
    if (w->class > WORD_CONTEXTUAL || w->builtin)
        parse_fail(p, t.place, "'%s' is a word of the language: it cannot be the name %s", t.text, what);
    return w;
}

typedef struct { Value value; ValueKind kind; } Reading;

/* What the value would be if all in it were supported, by its first word; VALUE_NONE: not known. */
static ValueKind promised_kind(const Token *t)
{
    static const struct { const char *word; ValueKind kind; } words[] = {
        { "texture", VALUE_TEXTURE }, { "pigment", VALUE_PIGMENT }, { "finish", VALUE_FINISH },
        { "interior", VALUE_INTERIOR }, { "transform", VALUE_TRANSFORM }, { "camera", VALUE_CAMERA },
        { "light_source", VALUE_LIGHT }, { "color_map", VALUE_COLOR_MAP }, { "colour_map", VALUE_COLOR_MAP },
        { "pigment_map", VALUE_PIGMENT_MAP }, { "sky_sphere", VALUE_SKY_SPHERE }, { "fog", VALUE_FOG },
    };
    for (size_t i = 0; t->kind == TOKEN_WORD && i < sizeof words / sizeof *words; i++) {
        if (strcmp(t->text, words[i].word) == 0) return words[i].kind;
    }
    return VALUE_NONE;
}

static void read_value(Parser *p, void *context)
{
    Reading *r = context;
    r->kind = promised_kind(look(p));
    r->value = parse_value(p, "a value");
}

/* A value that uses something unsupported is remembered as such, and an error only where it is used. */
static Value value_or_unsupported(Parser *p)
{
    Reading r = { .kind = VALUE_NONE };
    ValueStart start = { p->n_frames, p->braces, p->parens };
    if (parse_guarded(p, true, read_value, &r)) return r.value;
    Value v = p->unsupported;
    if (v.n == VALUE_NONE) v.n = (int)r.kind;
    recover_from_unsupported(p, &start, r.kind == VALUE_TEXTURE);
    return v;
}

static bool needs_semicolon(const Value *v)
{
    return v->kind == VALUE_FLOAT || v->kind == VALUE_VECTOR || v->kind == VALUE_COLOR;
}

/* What is missing is missing behind the value, whatever comes next. */
static _Noreturn void fail_semicolon(Parser *p, const Word *name)
{
    Place behind = p->last_place;
    Token t = *look(p);
    behind.column += behind.length, behind.length = 1;
    if (behind.source != t.place.source || behind.line == t.place.line)
        parse_fail_expected(p, arena_printf(p->arena, "';' after the value of '%s'", name->text));
    parse_fail(p, behind, "expected ';' after the value of '%s', found %s", name->text, token_name(p, &t));
}

/* POV-Ray wants ';' after numbers, vectors and colours, and allows it after all others. */
static void read_semicolon(Parser *p, const Word *name, const Value *v)
{
    if (needs_semicolon(v)) {
        if (!at_punct(p, ';')) fail_semicolon(p, name);
        input_take(p);
        return;
    }
    bool is_from_macro = p->n_frames > p->guard.n_frames;      /* whose end is passed before the ';' is seen */
    bool has = p->ahead.is_full || is_from_macro ? at_punct(p, ';') : input_next_char(p) == ';';
    if (has) (void)accept_punct(p, ';');
}

/* NAME[i] = value */
static void declare_element(Parser *p, const Word *name, Place where)
{
    Value *v = word_value(name);
    if (!v || v->kind != VALUE_ARRAY) parse_fail(p, where, "'%s' is not an array", name->text);
    Value *slot = array_element(p, v);
    expect_punct(p, '=');
    Guard before = input_guard(p);
    Value value = value_or_unsupported(p);
    read_semicolon(p, name, &value);
    input_unguard(p, before);
    *slot = value;
}

/* `deprecated [once] "why"` before a name: a note for those who use it, passed over. */
static void skip_deprecation(Parser *p)
{
    Cursor before = top_frame(p)->cursor;
    Token t = input_raw(p);
    if (t.kind != TOKEN_WORD || strcmp(t.text, "deprecated") != 0) {
        top_frame(p)->cursor = before;
        return;
    }
    if (input_next_char(p) == 'o') (void)input_raw(p);
    if (input_next_char(p) == '"') (void)input_raw(p);
}

static void run_declaration(Parser *p, Place where, void (*bind)(Symbols *s, Word *w, Value v))
{
    skip_deprecation(p);
    Word *name = declarable_name(p, "of a value");
    if (input_next_char(p) == '[') {
        declare_element(p, name, where);
        return;
    }
    expect_punct(p, '=');
    Guard before = input_guard(p);
    Value value = value_or_unsupported(p);
    read_semicolon(p, name, &value);
    input_unguard(p, before);
    bind(&p->symbols, name, value);
}

static void run_declare(Parser *p, Place where) { run_declaration(p, where, symbols_declare); }
static void run_local(Parser *p, Place where) { run_declaration(p, where, symbols_local); }

static void run_undef(Parser *p, Place where)
{
    (void)where;
    symbols_remove(&p->symbols, declarable_name(p, "of a value"));
}

/* ---- the rest ---- */

static void run_include(Parser *p, Place where)
{
    (void)where;
    Place at = here(p);
    const char *name = parse_string(p), *error = NULL;
    const SourceText *text = source_include(&p->sources, p->arena, p->options, name, &error);
    if (!text) parse_fail(p, at, "cannot include '%s': %s", name, error);
    input_push_file(p, text, at);
}

static void run_version(Parser *p, Place where)
{
    Guard before = input_guard(p);
    double version = parse_float(p);
    (void)accept_punct(p, ';');
    input_unguard(p, before);
    if (version > 3.7 + 1e-6) parse_fail(p, where, "the scene wants version %g of the language; this is 3.7", version);
    p->scene->version = version;
    p->is_version_set = true;
}

static void run_default(Parser *p, Place where)
{
    (void)where;
    Place opened = expect_open(p, "#default");
    parse_default_items(p);
    expect_close(p, '}', "#default", opened);
}

static void run_debug(Parser *p, Place where)
{
    (void)where;
    fputs(parse_string(p), p->options->debug ? p->options->debug : stderr);
}

static void run_warning(Parser *p, Place where)
{
    parse_warn(p, where, "#warning: %s", parse_string(p));
}

static void run_error(Parser *p, Place where)
{
    const char *text = parse_string(p);
    p->is_halted = true;
    parse_fail(p, where, "#error: %s", text);
}

static void run_ignored(Parser *p, Place where)
{
    parse_warn_once(p, where, "#render", "#render and #statistics are read and left out");
    (void)parse_string(p);
}

/* ---- the table ---- */

static const struct {
    const char *word;
    void (*run)(Parser *p, Place where);
} directives[] = {
    { "if", block_if }, { "ifdef", block_ifdef }, { "ifndef", block_ifndef }, { "elseif", block_elseif },
    { "else", block_else }, { "switch", block_switch }, { "case", block_case }, { "range", block_range },
    { "while", block_while }, { "for", block_for }, { "break", block_break }, { "end", block_end },
    { "declare", run_declare }, { "local", run_local }, { "undef", run_undef }, { "macro", macro_define },
    { "include", run_include }, { "version", run_version }, { "default", run_default }, { "debug", run_debug },
    { "warning", run_warning }, { "error", run_error }, { "render", run_ignored }, { "statistics", run_ignored },
};

static const char *const unsupported[] = { "fopen", "fclose", "read", "write" };

static void refuse(Parser *p, const Token *t)
{
    for (size_t i = 0; i < sizeof unsupported / sizeof *unsupported; i++) {
        if (strcmp(t->text, unsupported[i]) == 0)
            parse_fail(p, t->place, "'#%s' is a POV-Ray feature that is not supported here", t->text);
    }
    parse_fail(p, t->place, "unknown directive '#%s'", t->text);
}

void directive_run(Parser *p, Place hash)
{
    Token t = input_raw(p);
    if (t.kind != TOKEN_WORD) parse_fail(p, t.place, "expected a directive after '#', found %s", token_name(p, &t));
    Place where = hash;
    if (hash.line == t.place.line) where.length = t.place.column + t.place.length - hash.column;
    for (size_t i = 0; i < sizeof directives / sizeof *directives; i++) {
        if (strcmp(t.text, directives[i].word) != 0) continue;
        directives[i].run(p, where);
        return;
    }
    refuse(p, &t);
}
