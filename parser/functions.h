/* What words mean in expressions: functions, constants, and the words that begin a colour. */
#ifndef TRIMRAY_PARSER_FUNCTIONS_H
#define TRIMRAY_PARSER_FUNCTIONS_H

#include "parser/expr.h"

/* The words that make colours; which components they set. */
typedef enum {
    COLOR_NO_WORD, COLOR_ANY, COLOR_RGB, COLOR_RGBF, COLOR_RGBT, COLOR_RGBFT,
    COLOR_SRGB, COLOR_SRGBF, COLOR_SRGBT, COLOR_SRGBFT, COLOR_RED, COLOR_GREEN, COLOR_BLUE, COLOR_FILTER, COLOR_TRANSMIT
} ColorWord;

struct Builtin {
    const char *name;
    Term (*call)(Parser *p, const Builtin *self, Place where);   /* after the word; NULL: a colour word */
    union {
        double (*real)(double x);
        double (*real2)(double x, double y);
        double number;
    };
    ColorWord color;
};

const Builtin *builtin_at(size_t i);               /* NULL: past the end */

/* text.c: the functions that make strings, and two that read them. */
Term text_chr(Parser *p, const Builtin *self, Place where);
Term text_concat(Parser *p, const Builtin *self, Place where);
Term text_str(Parser *p, const Builtin *self, Place where);
Term text_strlwr(Parser *p, const Builtin *self, Place where);
Term text_strupr(Parser *p, const Builtin *self, Place where);
Term text_substr(Parser *p, const Builtin *self, Place where);
Term text_vstr(Parser *p, const Builtin *self, Place where);
double text_first_code(const char *s);             /* the code of the first character, UTF-8 decoded; 0: empty */
double text_value(const char *s);                  /* the number that it begins with, or 0 */

#endif
