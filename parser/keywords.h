/* The reserved words of POV-Ray 3.7. */
#ifndef TRIMRAY_PARSER_KEYWORDS_H
#define TRIMRAY_PARSER_KEYWORDS_H

#include "parser/symbols.h"

/* Marks all reserved words, the functions and constants of expressions, and the words that parse_object_words() lists. */
void keywords_mark(Symbols *s);

#endif
