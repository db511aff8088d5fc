/* From characters to tokens: words, numbers, strings, punctuation, each with its place. Knows nothing of directives, macros
 * or files: a cursor runs over one text, and can be copied to come back to a place. */
#ifndef TRIMRAY_PARSER_LEXER_H
#define TRIMRAY_PARSER_LEXER_H

#include "parser/state.h"
#include "parser/symbols.h"

typedef struct {
    const SourceText *source;
    const char *at, *end;          /* what is left; *end is readable (the source's final '\0', at the latest) */
    const char *line_start;
    uint32_t line;
} Cursor;

Cursor cursor_make(const SourceText *source);                         /* at the start; a byte order mark is skipped */
Place cursor_place(const Cursor *c, const char *from, size_t length); /* of characters on the cursor's line */

/* Reads the next token, TOKEN_END at the end of the text; '#' is punctuation here. Returns NULL, or what is wrong (a message
 * in the arena or a constant), with the place in out->place; the cursor has then passed the offending characters. */
const char *lexer_read(Cursor *c, Symbols *s, Token *out);

/* Passes white space and comments; false: it stands at a comment that has no end. */
bool cursor_skip_blank(Cursor *c);

/* The next character that is not white space or comment; '\0' at the end. */
char cursor_next_char(Cursor c);

/* Moves to just behind the next '#' that is in no comment and no string; false: there is none, the cursor is at the end. */
bool cursor_find_directive(Cursor *c);

/* The characters at a place, at most `max` of them, as they stand in its source: for messages. */
const char *place_text(Place where, size_t *length);

#endif
