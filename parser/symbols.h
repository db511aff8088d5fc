/* Words, each stored once, and what they stand for. Scopes are dynamic, as in POV-Ray: a name means its innermost binding,
 * whoever made it; leaving a scope brings back what its names meant before. Every word knows its binding, so that looking
 * up costs nothing. */
#ifndef TRIMRAY_PARSER_SYMBOLS_H
#define TRIMRAY_PARSER_SYMBOLS_H

#include "parser/value.h"

#define SYMBOLS_MAX_SCOPES 100               /* POV-Ray's limit on nested macros and includes */
#define SYMBOLS_MAX_TEXT (256u << 20)        /* characters of all strings that a run may make */

typedef struct Symbol Symbol;
typedef struct Builtin Builtin;              /* functions.h */

/* Is the word reserved? keywords.c says so. CONTEXTUAL: known, but free to be declared. */
typedef enum { WORD_FREE, WORD_CONTEXTUAL, WORD_SUPPORTED, WORD_UNSUPPORTED } WordClass;

typedef struct Word {
    struct Word *chain;                      /* the next in its bucket */
    Symbol *symbol;                          /* the innermost binding; NULL: not declared */
    const Builtin *builtin;                  /* what it means in an expression, if it is a function or a constant */
    WordClass class;
    uint32_t hash, length;
    char text[];
} Word;

struct Symbol {
    Value value;
    Value *slot;                             /* &value, or what a parameter was given by reference */
    Word *word;
    Symbol *hidden;                          /* the binding that this one hides */
    Symbol *previous, *next;                 /* in its scope */
    int scope;
};

typedef struct {
    Arena *arena;
    Word **buckets;
    size_t n_buckets, n_words;               /* n_buckets: a power of two */
    Symbol *scopes[SYMBOLS_MAX_SCOPES];      /* their symbols; scope 0 is global */
    int n_scopes;
    Symbol *unused;
    char *text;                              /* a block for small strings */
    size_t text_left, text_total;
} Symbols;

void symbols_init(Symbols *s, Arena *a);
Word *symbols_intern(Symbols *s, const char *text, size_t length);
static inline Word *word_of(const char *text) { return (Word *)(void *)(text - offsetof(Word, text)); }   /* interned */

/* Room for a string of n characters and its '\0'; NULL: the run has made too many. */
char *symbols_text(Symbols *s, size_t n);
const char *symbols_unescape(Symbols *s, const char *text, size_t n);   /* interned, like all literals */

/* What the word stands for, through references; NULL: nothing. */
static inline Value *word_value(const Word *w) { return w->symbol ? w->symbol->slot : NULL; }

void symbols_declare(Symbols *s, Word *w, Value v);              /* the innermost binding, or a new global one */
void symbols_local(Symbols *s, Word *w, Value v);                /* in the innermost scope */
void symbols_refer(Symbols *s, Word *w, Value *slot);            /* the same; the name is another one for *slot */
void symbols_remove(Symbols *s, Word *w);                        /* the innermost binding */

bool symbols_enter(Symbols *s);                                  /* false: too many scopes */
void symbols_leave(Symbols *s);

/* The declared or reserved word nearest to `text` in spelling, or NULL if none is near. */
const char *symbols_nearest(const Symbols *s, const char *text);

#endif
