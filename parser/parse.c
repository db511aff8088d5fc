/* A scene file from its first statement to its last, going on after errors. */
#include "parser/core.h"
#include "parser/keywords.h"

#include <string.h>

Arena *parser_arena(Parser *p) { return p->arena; }
Diag *parser_diag(Parser *p) { return p->diag; }
Scene *parser_scene(Parser *p) { return p->scene; }
const ParseOptions *parser_options(Parser *p) { return p->options; }
ParseSummary *parser_summary(Parser *p) { return p->summary; }

/* ---- statements ---- */

/* One statement, or the end of the file with all directives before it. */
static void read_statement(Parser *p, void *at_end)
{
    p->is_between_statements = true;
    bool is_end = look(p)->kind == TOKEN_END;
    p->is_between_statements = false;
    if (is_end) *(bool *)at_end = true;
    else parse_statement(p);
}

static void reset_statement(Parser *p)
{
    p->braces = 0, p->parens = 0, p->angle_braces = -1;
    p->guard.is_on = false;
}

static void read_statements(Parser *p)
{
    bool at_end = false;
    while (!at_end && !p->is_halted && !diag_is_full(p->diag)) {
        reset_statement(p);
        if (!parse_guarded(p, false, read_statement, &at_end)) recover_from_error(p);
    }
}

/* ---- before and after ---- */

static void begin(Parser *p, void *unused)
{
    (void)unused;
    parse_begin(p);
}

/* A scene that says no version is one of 3.62, though its `version` reads 3.7 (measured with POV-Ray 3.7). */
static void end(Parser *p, void *unused)
{
    (void)unused;
    if (!p->is_version_set && p->options->version == 0) p->scene->version = 3.62;
    parse_end(p);
}

static void declare_options(Parser *p)
{
    for (int i = 0; i < p->options->n_declares; i++) {
        const ParseDeclare *d = &p->options->declares[i];
        Word *w = symbols_intern(&p->symbols, d->name, strlen(d->name));
        symbols_declare(&p->symbols, w, (Value){ .kind = VALUE_FLOAT, .number = d->value });
    }
}

static const SourceText *open_scene(Parser *p, const char *path)
{
    const char *error = NULL;
    const SourceText *text = source_open(&p->sources, p->arena, path, path, &error);
    if (!text) diag_error(p->diag, (Place){ .source = NULL }, "cannot read '%s': %s", path, error);
    return text;
}

static void read_scene(Parser *p, const SourceText *text)
{
    /* The first frame, which no handler is needed for: it cannot be too deep. */
    input_push_file(p, text, (Place){ .source = text });
    if (p->options->version > 0) p->scene->version = p->options->version;
    declare_options(p);
    if (!parse_guarded(p, false, begin, NULL)) return;
    read_statements(p);
    if (!p->is_halted && !diag_is_full(p->diag)) (void)parse_guarded(p, false, end, NULL);
}

bool parse_scene(const char *path, const ParseOptions *options, Arena *a, Diag *diag, Scene *scene, ParseSummary *summary)
{
    Parser *p = ARENA_NEW(a, Parser);
    int errors_before = diag_error_count(diag);
    p->arena = a, p->diag = diag, p->scene = scene, p->options = options, p->summary = summary;
    *summary = (ParseSummary){ .n_objects = 0 };
    symbols_init(&p->symbols, a);
    keywords_mark(&p->symbols);
    p->trimmed_nurbs = symbols_intern(&p->symbols, "trimmed_nurbs", strlen("trimmed_nurbs"))->text;
    const SourceText *text = open_scene(p, path);
    if (text) read_scene(p, text);
    summary->n_bytes = p->sources.n_bytes, summary->n_files = p->sources.n_files;
    return diag_error_count(diag) == errors_before;
}
