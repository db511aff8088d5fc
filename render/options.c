#include "render/option_table.h"

#include "render/ini.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MAX_INIS 10           /* INI files within one another: POV-Ray's limit */

/* ---- reading ---- */

static bool may_have_value(const OptionRow *row) { return row->kind != OPTION_FLAG && row->argument; }
static bool needs_value(const OptionRow *row) { return may_have_value(row) && *row->argument != '['; }

static bool apply(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    if (!(row->commands & o->command)) return OPTION_FAIL(o, "means nothing to this command");
    if (needs_value(row) && !*value && is_on) return OPTION_FAIL(o, "needs a value");
    if (row->kind == OPTION_FLAG && *value) return OPTION_FAIL(o, "takes no value");
    return option_set(o, row, value, is_on);
}

/* +W640, -D: the longest switch that the argument begins with. The sign says off only where no value follows. */
static bool read_switch(Options *o, const char *argument)
{
    const OptionRow *best = NULL;
    size_t best_length = 0;
    for (const OptionRow *row = option_rows; row < option_rows + n_option_rows; row++) {
        size_t length = row->letters ? strlen(row->letters) : 0;
        if (length > best_length && strncasecmp(argument + 1, row->letters, length) == 0) best = row, best_length = length;
    }
    if (!best) return OPTION_FAIL(o, "unknown switch");
    bool is_on = *argument == '+' || (needs_value(best) && !best->minus_is_off);
    return apply(o, best, argument + 1 + best_length, is_on);
}

static bool is_one_of(const char *value, const char *const words[])
{
    for (; *words; words++)
        if (strcasecmp(value, *words) == 0) return true;
    return false;
}

/* Width=640, Output_Alpha=on. */
static bool read_key(Options *o, const char *argument, const char *equals)
{
    static const char *const on[] = { "on", "true", "yes", "1", NULL }, *const off[] = { "off", "false", "no", "0", NULL };
    size_t length = (size_t)(equals - argument);
    for (const OptionRow *row = option_rows; row < option_rows + n_option_rows; row++) {
        if (!row->key || strlen(row->key) != length || strncasecmp(argument, row->key, length) != 0) continue;
        if (needs_value(row)) return apply(o, row, equals + 1, true);
        if (is_one_of(equals + 1, off)) return apply(o, row, "", false);
        bool is_switch = row->kind == OPTION_FLAG || may_have_value(row);
        if (is_switch && !is_one_of(equals + 1, on)) return OPTION_FAIL(o, "expected on or off");
        return apply(o, row, "", true);
    }
    return OPTION_FAIL(o, "unknown setting");
}

/* The row of --name, which may be cut short as long as it is clear; NULL: o->error is set. */
static const OptionRow *find_long(Options *o, const char *name, size_t length)
{
    const OptionRow *found = NULL, *other = NULL;
    for (const OptionRow *row = option_rows; row < option_rows + n_option_rows; row++) {
        if (!row->name || strncmp(row->name, name, length) != 0) continue;
        if (strlen(row->name) == length) return row;
        other = found, found = row;
    }
    if (!found) return OPTION_FAIL(o, "unknown option") ? found : NULL;
    if (other) return OPTION_FAIL(o, "--%s or --%s?", other->name, found->name) ? found : NULL;
    return found;
}

/* --name=value or --name value; *next is the argument after it, taken if it is needed. */
static bool read_long(Options *o, const char *argument, char *const **next, char *const *end)
{
    const char *name = argument + 2, *equals = strchr(name, '=');
    const OptionRow *row = find_long(o, name, equals ? (size_t)(equals - name) : strlen(name));
    if (!row) return false;
    const char *value = equals ? equals + 1 : "";
    if (!equals && needs_value(row) && *next < end) value = *(*next)++;
    return apply(o, row, value, true);
}

static bool read_scene_name(Options *o, const char *word)
{
    if (o->command == COMMAND_COMPARE && o->input && !o->other) {
        o->other = word;
        return true;
    }
    if (o->command == COMMAND_REPORT) {
        ARENA_PUSH(o->arena, o->inputs, o->n_inputs, o->inputs_capacity) = o->input = word;
        return true;
    }
    if (o->input) return OPTION_FAIL(o, "one scene at a time, and %s is named already", o->input);
    o->input = word;
    return true;
}

static bool read_ini(Options *o, const char *path, const char *section);

/* file.ini or file.ini[section]; another bare word is the scene. */
static bool read_bare(Options *o, const char *word)
{
    char *path = arena_strdup(o->arena, word), *section = strchr(path, '[');
    char *end = section ? strchr(section, ']') : NULL;
    if (end && !end[1]) *section++ = *end = '\0';
    size_t length = strlen(path);
    if (length < 4 || strcasecmp(path + length - 4, ".ini") != 0) return read_scene_name(o, word);
    return read_ini(o, path, end ? section : NULL);
}

/* What does not depend on the argument after it: all but --name value. */
static bool read_alone(Options *o, const char *argument)
{
    const char *equals = strchr(argument, '=');
    if (*argument == '+' || *argument == '-') return read_switch(o, argument);
    if (equals && !memchr(argument, '/', (size_t)(equals - argument))) return read_key(o, argument, equals);
    return *argument ? read_bare(o, argument) : OPTION_FAIL(o, "an empty argument");
}

static bool read_ini_option(void *options, const char *option)
{
    Options *o = options;
    return read_alone(o, option) || OPTION_FAIL(o, "%s: %s", option, o->error);
}

static bool read_ini(Options *o, const char *path, const char *section)
{
    int line;
    if (o->n_inis == MAX_INIS) return OPTION_FAIL(o, "more than %d INI files within one another", MAX_INIS);
    o->n_inis++;
    o->error = NULL;
    bool is_read = ini_read(path, section, o->arena, read_ini_option, o, &line);
    o->n_inis--;
    if (is_read) return true;
    if (line > 0) return OPTION_FAIL(o, "line %d: %s", line, o->error);
    if (section && errno == ENOENT) return OPTION_FAIL(o, "there is no section [%s]", section);
    return OPTION_FAIL(o, "%s", strerror(errno));
}

static bool read_argument(Options *o, const char *argument, char *const **next, char *const *end)
{
    bool is_long = strncmp(argument, "--", 2) == 0 && argument[2];
    if (strcmp(argument, "-o") == 0) return read_long(o, "--output", next, end);   /* as other programs have it */
    return is_long ? read_long(o, argument, next, end) : read_alone(o, argument);
}

bool options_read(int argc, char *const argv[], Arena *a, Options *o)
{
    *o = (Options){ .command = COMMAND_RENDER, .nurbs.method = NURBS_METHOD_CERTAIN, .width = 800, .height = 600,
                    .bits = 8, .quality = 9,
                    .antialias = antialias_default(), .jitter_on = true, .block_size = 32, .arena = a };
    o->within = o->share = 1;
    o->antialias.method = 1;
    o->antialias.jitter = 1;
    char *const *next = argv, *const *end = argv + argc;
    for (int i = 0; next == argv && argc > 0 && i < n_option_commands; i++)
        if (strcmp(argv[0], option_commands[i].name) == 0) o->command = option_commands[i].command, next++;
    if (o->command == COMMAND_REPORT) o->width = o->height = 0;   /* chosen there */
    while (next < end) {
        const char *argument = *next++;
        if (!read_argument(o, argument, &next, end)) return OPTION_FAIL(o, "%s: %s", argument, o->error);
    }
    if (o->wants_help || o->wants_version) return true;
    if (o->command == COMMAND_COMPARE) return o->other || OPTION_FAIL(o, "compare needs two pictures");
    if (!o->input) return OPTION_FAIL(o, "no scene given");
    if (o->command == COMMAND_EXPORT && !o->output) return OPTION_FAIL(o, "export needs -o FILE");
    if (o->command == COMMAND_REPORT && !o->output) return OPTION_FAIL(o, "report needs -o FOLDER");
    if (o->command == COMMAND_REPORT && !o->n_inputs) read_scene_name(o, o->input);   /* it came by +I */
    return o->command != COMMAND_SHOOT || o->rays || OPTION_FAIL(o, "shoot needs --rays FILE");
}

/* 1 is the first column as a start and the whole picture as an end; fractions are rounded down (POV-Ray's rules). */
bool options_crop(double from, double to, int n, int *first, int *end)
{
    double a = from < 1 ? floor(from * n) : floor(from) - 1;
    double b = to == 0 ? n : to <= 1 ? floor(to * n) : floor(to);
    if (!(a < b && b <= n)) return false;
    *first = (int)a, *end = (int)b;
    return true;
}

/* ---- help ---- */

static void print_row(const OptionRow *row, FILE *out)
{
    const char *argument = row->argument ? row->argument : "";
    char in_povray[40] = "", in_full[40] = "", both[84];
    if (row->letters) snprintf(in_povray, sizeof in_povray, "+%s%s", row->letters, argument);
    if (row->name) snprintf(in_full, sizeof in_full, "--%s%s%s", row->name, *argument ? " " : "", argument);
    snprintf(both, sizeof both, "%s%s%s", in_povray, *in_povray && *in_full ? ", " : "", in_full);
    fprintf(out, "  %-26s %s\n", both, row->help);
}

void options_print_help(FILE *out)
{
    fputs("trimray renders POV-Ray scenes whose special primitive is the trimmed NURBS surface.\n\n"
          "usage: trimray [command] SCENE.pov [options]\n\ncommands:\n", out);
    for (const OptionCommand *c = option_commands; c < option_commands + n_option_commands; c++)
        fprintf(out, "  %-26s %s\n", c->name, c->help);
    fputs("\noptions, in POV-Ray's spelling and in full (also by POV-Ray's INI keys: Width=640; FILE.ini and"
          " FILE.ini[SECTION]\nread them from a file):\n", out);
    for (const OptionRow *row = option_rows; row < option_rows + n_option_rows; row++)
        if (row->help) print_row(row, out);
    fputs("\nexit status: 0 done, 1 the scene or the input is wrong, 2 the command line is wrong, 3 a file cannot be read\n"
          "or written, 130 interrupted (what was finished is kept)\n", out);
}
