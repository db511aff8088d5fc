/* #macro and its calls. A body is not recorded: it is a piece of the source that is read again at each call, as a frame of
 * its own, so that its tokens join those round the call ("A(3)*10" with the body "X+1" is 3+1*10). Parameters are symbols
 * of the frame's scope; an argument that is a lone identifier or array element is passed by reference. */
#include "parser/core.h"

#include <string.h>

enum { MACRO_MAX_PARAMETERS = 56 };   /* POV-Ray's limit */

/* ---- definition ---- */

static void read_parameters(Parser *p, Macro *m)
{
    Word *list[MACRO_MAX_PARAMETERS];
    Place opened = expect_punct(p, '(');
    while (input_next_char(p) != ')') {             /* names as they stand, even if they are those of macros */
        if (m->n_parameters == MACRO_MAX_PARAMETERS)
            parse_fail(p, opened, "a macro has at most %d parameters", MACRO_MAX_PARAMETERS);
        list[m->n_parameters++] = declarable_name(p, "of a parameter");
        if (input_next_char(p) == ',') accept_comma(p);
    }
    m->parameters = arena_copy(p->arena, list, (size_t)m->n_parameters, sizeof *list);
    expect_close(p, ')', "the parameters", opened);
}

void macro_define(Parser *p, Place where)
{
    Macro *m = ARENA_NEW(p->arena, Macro);
    Word *name = declarable_name(p, "of a macro");
    m->name = name;
    read_parameters(p, m);
    m->body = top_frame(p)->cursor;
    if (!block_skip(p, 0, &m->body.end))
        parse_fail(p, where, "#macro %s has no #end", name->text);
    symbols_declare(&p->symbols, name, (Value){ .kind = VALUE_MACRO, .macro = m });
}

/* ---- calls ---- */

typedef struct { Value value; Value *slot; } Argument;   /* slot: passed by reference; NULL: by value */

/* An identifier or array element with nothing behind it but ',' or ')'. */
static Value *lone_identifier(Parser *p)
{
    Value *slot = look_slot(p);
    if (!slot) return NULL;
    char behind = input_next_char(p);
    return behind == ',' || behind == ')' ? slot : NULL;
}

static Argument read_argument(Parser *p, const Macro *m, int i)
{
    Argument a = { .slot = lone_identifier(p) };
    if (at_punct(p, ')') || at_punct(p, ',')) {
        parse_fail(p, here(p), "expected %d argument%s of macro '%s', found %d", m->n_parameters,
                   m->n_parameters == 1 ? "" : "s", m->name->text, i);
    }
    if (a.slot) input_take(p);
    else a.value = parse_value(p, "an argument");
    return a;
}

static void read_arguments(Parser *p, const Macro *m, Argument list[])
{
    Place opened = expect_punct(p, '(');
    for (int i = 0; i < m->n_parameters; i++) {
        if (i > 0) accept_comma(p);
        list[i] = read_argument(p, m, i);
    }
    if (at_punct(p, ',')) {
        parse_fail(p, here(p), "expected %d argument%s of macro '%s', found more", m->n_parameters,
                   m->n_parameters == 1 ? "" : "s", m->name->text);
    }
    expect_close(p, ')', "the arguments", opened);
}

/* The arguments of this call are bound when all have been read: they may use names that the parameters hide. */
void macro_call(Parser *p, const Token *name)
{
    const Macro *m = word_value(word_of(name->text))->macro;
    Argument list[MACRO_MAX_PARAMETERS];
    Guard guard = p->guard;
    p->guard.is_on = false;                    /* what ends a value does not end an argument */
    input_step(p, name->place);
    read_arguments(p, m, list);
    p->guard = guard;
    input_push_macro(p, m, name->place);
    for (int i = 0; i < m->n_parameters; i++) {
        if (list[i].slot) symbols_refer(&p->symbols, m->parameters[i], list[i].slot);
        else symbols_local(&p->symbols, m->parameters[i], list[i].value);
    }
}
