/* The parser's insides, shared by the files of its core; the rules for objects and textures see only state.h.
 *
 * Input is a stack of frames: the scene file, the files that it includes, the bodies of macros that are being expanded. All
 * are pieces of source text that are read again at each use; nothing is recorded. input_fill makes tokens of the top frame
 * and carries out directives and macro calls on the way, so that a rule never sees one. */
#ifndef TRIMRAY_PARSER_CORE_H
#define TRIMRAY_PARSER_CORE_H

#include "parser/lexer.h"
#include "parser/random.h"
#include "parser/source.h"
#include "parser/state.h"
#include "parser/symbols.h"

#include <setjmp.h>

enum {
    PARSER_MAX_INCLUDES = 32,          /* POV-Ray's limit */
    PARSER_MAX_FRAMES = SYMBOLS_MAX_SCOPES,
    PARSER_MAX_BRACES = 200,           /* nested { }: the rules recurse, and the stack is finite */
    PARSER_MAX_NESTING = 200,          /* nested expressions, directives within them, macro arguments */
    PARSER_MAX_STEPS = 100000000,      /* rounds of loops and calls of macros in a run, unless the options say otherwise */
    PARSER_MAX_STEPS_AFTER_ERROR = 100000   /* a loop that lost its step to an error should not run to that limit */
};

struct Macro {
    const Word *name;
    int n_parameters;
    Word **parameters;
    Cursor body;                       /* its end is the '#' of #end */
};

typedef struct {
    Cursor cursor;
    const Macro *macro;                /* whose body this is; NULL: a file */
    Place called;                      /* where it was called or included from */
    size_t first_block;                /* the blocks below belong to frames below */
    int braces, parens;                /* as they were when it began */
    uint64_t serial;                   /* tells frames apart that lived at the same height */
} Frame;

/* A directive that waits for its #end. */
typedef enum { BLOCK_IF, BLOCK_WHILE, BLOCK_FOR, BLOCK_SWITCH } BlockKind;
typedef struct {
    BlockKind kind;
    Place place;                       /* of its word */
    Cursor again;                      /* WHILE: before the condition; FOR: the body */
    Word *variable;                    /* FOR */
    double end, step;
} Block;

/* While the value of a #declare is read, what follows it must not be carried out before the name has its value. Within the
 * frame of the directive, outside all braces of the value, definitions end it, and what belongs to a block round it; after
 * a '}' so does every directive and macro call, and the end of the frame always does. The same holds for conditions. */
typedef struct { bool is_on; int n_frames, braces; size_t n_blocks; } Guard;

/* What parse_fail jumps to. */
typedef struct Handler {
    jmp_buf jump;
    struct Handler *outer;
    bool only_unsupported;             /* a #declare: takes unsupported features, passes on all other failures */
    int nesting;                       /* as they were */
    Guard guard;
} Handler;

typedef struct {
    bool is_full;
    bool is_raw;                       /* not to be taken: the guard stopped before it, and the cursor too */
    Token token;
    Value *element;                    /* the token is an array's name: the element, its subscript has been read */
} Lookahead;

/* What was open when a value began. */
typedef struct { int n_frames, braces, parens; } ValueStart;

/* Where a statement began: recovery starts from there. */
typedef struct { int n_frames; uint64_t serial; Cursor cursor; size_t n_blocks; } Mark;

struct Parser {
    Arena *arena;
    Diag *diag;
    Scene *scene;
    const ParseOptions *options;
    ParseSummary *summary;
    Symbols symbols;
    Sources sources;
    RandomStreams random;

    Frame frames[PARSER_MAX_FRAMES];
    int n_frames, n_includes;
    uint64_t n_serials;
    Block *blocks;
    size_t n_blocks, blocks_capacity;

    Lookahead ahead;
    char last_punct;                   /* the token that was taken last, if it was punctuation; else '\0' */
    Place last_place;                  /* of that token */
    const char *trimmed_nurbs;         /* the word, interned */
    bool last_was_trimmed;             /* that word was taken last: '<' opens a block */
    Guard guard;
    int braces, parens, nesting;       /* parens: ( and [ */
    int angle_braces;                  /* in a trimmed_nurbs < >: braces where it was opened; else -1 */
    Mark mark;
    Cursor before_ahead;               /* where the token ahead begins, if it was read under a guard */
    bool is_between_statements;

    Handler *handler;
    Value unsupported;                 /* what a jump to an only_unsupported handler brings */
    Place last_error;                  /* told */
    Place stopped_at;                  /* the token that was looked at when it failed; source NULL: none */
    uint64_t n_steps, n_steps_after_error;
    size_t n_elements;                 /* of all arrays */
    bool is_version_set, is_halted;
};

/* ---- input.c ---- */
static inline Frame *top_frame(Parser *p) { return &p->frames[p->n_frames - 1]; }
void input_push_file(Parser *p, const SourceText *text, Place called);
void input_push_macro(Parser *p, const Macro *macro, Place called);
void input_pop(Parser *p);                         /* the top frame, with its scope and its blocks */
void input_fill(Parser *p);
Token input_raw(Parser *p);                        /* the next token as it stands: no directive, no macro */
char input_next_char(Parser *p);                   /* the character after white space; nothing is carried out */
Guard input_guard(Parser *p);                      /* switches the guard on; returns what it was, for input_unguard */
void input_unguard(Parser *p, Guard before);
void input_deeper(Parser *p, Place where);         /* counts nesting: fails at the limit */
static inline void input_shallower(Parser *p) { p->nesting--; }
void input_step(Parser *p, Place where);           /* counts a round or a call: fails at the limit */
static inline const Token *look(Parser *p)
{
    if (!p->ahead.is_full) input_fill(p);
    return &p->ahead.token;
}
static inline bool at_punct(Parser *p, char punct)
{
    const Token *t = look(p);
    return t->kind == TOKEN_PUNCT && t->punct == punct;
}
void input_take(Parser *p);                        /* what look() showed */

/* ---- fail.c ---- */
/* Calls rule(p, context); false: it failed, and everything that failing leaves behind is cleared. */
bool parse_guarded(Parser *p, bool only_unsupported, void (*rule)(Parser *p, void *context), void *context);
const char *token_name(Parser *p, const Token *t);             /* "'camera'", "the end of the file": for messages */

/* ---- recover.c ---- */
void recover_from_error(Parser *p);                /* to the end of the statement at p->mark */
void recover_from_unsupported(Parser *p, const ValueStart *start, bool is_texture);   /* to the end of a value */

/* ---- directive.c, block.c, macro.c ---- */
void directive_run(Parser *p, Place hash);         /* after '#' */
Word *declarable_name(Parser *p, const char *what);   /* raw; fails for reserved words: "... the name `what`" */
void macro_define(Parser *p, Place where);         /* after #macro */
void macro_call(Parser *p, const Token *name);

/* block.c: each after its word, `where` is that of the directive */
void block_if(Parser *p, Place where);
void block_ifdef(Parser *p, Place where);
void block_ifndef(Parser *p, Place where);
void block_elseif(Parser *p, Place where);
void block_else(Parser *p, Place where);
void block_switch(Parser *p, Place where);
void block_case(Parser *p, Place where);
void block_range(Parser *p, Place where);
void block_while(Parser *p, Place where);
void block_for(Parser *p, Place where);
void block_break(Parser *p, Place where);
void block_end(Parser *p, Place where);
void block_check_frame_end(Parser *p);             /* what the frame has left open is an error */
/* Passes over `depth` + 1 #ends, the last of them at *end; false: the text ends before. */
bool block_skip(Parser *p, int depth, const char **end);

/* ---- array.c, expr.c ---- */
Value parse_value(Parser *p, const char *what);    /* anything that an identifier can hold */
double parse_condition(Parser *p);                 /* a float, with relations and logic as within parentheses */
bool parse_is_defined(Parser *p);                  /* NAME or NAME[i]: has it a value? */
Value *array_element(Parser *p, Value *array);     /* reads [..][..]; looks at nothing behind the last ] */
Value array_copy(Parser *p, Place where, Value array);   /* deep */
/* The slot that the word at the head of the input stands for, subscripts read; NULL: it is not an identifier. */
Value *look_slot(Parser *p);
_Noreturn void fail_unsupported_value(Parser *p, const Token *name, const Value *v);

#endif
