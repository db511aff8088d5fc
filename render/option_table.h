/* The table of the command line's options: what each is called, what takes its value. Used by options.c alone. */
#ifndef TRIMRAY_OPTION_TABLE_H
#define TRIMRAY_OPTION_TABLE_H

#include "render/options.h"

typedef struct OptionRow OptionRow;

/* What becomes of an option's value: it is stored in a field of Options, or a function takes it. */
typedef enum {
    OPTION_TEXT, OPTION_WHOLE, OPTION_REAL,     /* need a value; numbers within [lo, hi] */
    OPTION_FLAG,                            /* +UA, -UA, Output_Alpha=on */
    OPTION_CUSTOM                           /* by `set` */
} OptionKind;

/* `value` is "" where none was given; is_on is false for the -X form and for Key=off. False: o->error says why. */
typedef bool (*OptionSetter)(Options *o, const OptionRow *row, const char *value, bool is_on);

struct OptionRow {
    const char *letters;             /* +W: POV-Ray's switch, in any case; NULL: none */
    const char *key;                 /* Width=: in a POV-Ray INI file; NULL: none */
    const char *name;                /* --width; NULL: none */
    const char *argument;            /* how --help calls the value; NULL: there is none; [X]: it may be left out */
    int commands;                    /* which commands know it */
    const char *help;                /* NULL: not told */
    OptionKind kind;
    size_t field;                    /* offset in Options */
    double lo, hi;
    OptionSetter set;
    bool minus_is_off;               /* -X switches it off, even where a value is needed */
};

/* What is wrong with the argument in hand, whose text options_read puts before it. */
#define OPTION_FAIL(o, ...) ((o)->error = arena_printf((o)->arena, __VA_ARGS__), false)

extern const OptionRow option_rows[];
extern const int n_option_rows;

typedef struct { const char *name; Command command; const char *help; } OptionCommand;
extern const OptionCommand option_commands[];
extern const int n_option_commands;

/* Stores the value, or has the row's function take it; false: o->error says why. */
bool option_set(Options *o, const OptionRow *row, const char *value, bool is_on);

#endif
