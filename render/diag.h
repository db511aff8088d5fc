/* What the user is told about the input: one list of messages, each with its place, printed with the source line and a
 * caret:
 *
 *   part.pov:14:3: error: expected '}' to close sphere (line 12), found 'camera'
 *       camera { location <0, 0, -5> }
 *       ^
 */
#ifndef TRIMRAY_DIAG_H
#define TRIMRAY_DIAG_H

#include "render/arena.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define DIAG_MAX_ERRORS 20

/* A source text that stays in memory as long as the Diag: lines are found in it when a message is printed. */
typedef struct {
    const char *name;    /* as the user wrote it, for messages */
    const char *text;    /* n_bytes characters, then '\0' */
    size_t n_bytes;
} SourceText;

typedef struct {
    const SourceText *source;   /* NULL: the message has no place (the command line, an output file) */
    uint32_t line, column;      /* from 1; column counts bytes, a tab is one */
    uint32_t length;            /* how many characters the caret underlines: ^~~~; 0 and 1: one caret */
} Place;

typedef enum { DIAG_WARNING, DIAG_ERROR } DiagLevel;

typedef struct Diag Diag;
Diag *diag_new(Arena *a);

/* Adds a message. Errors beyond DIAG_MAX_ERRORS are counted, not kept. */
void diag_error(Diag *d, Place where, const char *format, ...) __attribute__((format(printf, 3, 4)));
void diag_warning(Diag *d, Place where, const char *format, ...) __attribute__((format(printf, 3, 4)));
void diag_add(Diag *d, DiagLevel level, Place where, const char *format, va_list arguments);
/* A warning that is given once for each `key` (a static string or one that outlives d): "read and left out" and the like. */
void diag_warning_once(Diag *d, Place where, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

int diag_error_count(const Diag *d);
int diag_warning_count(const Diag *d);
bool diag_is_full(const Diag *d);              /* DIAG_MAX_ERRORS reached: stop reading */
void diag_print(const Diag *d, FILE *out);     /* all messages, in order, then "20 errors shown, more not" where it is so */

#endif
