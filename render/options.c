#include "render/options.h"

#include "render/ini.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MAX_SIZE 1000000      /* of a picture's side: libpng's own limit */
#define MAX_THREADS 1024
#define MAX_NEWTON 1000       /* steps; 10 are plenty */
#define MAX_INIS 10           /* INI files within one another: POV-Ray's limit */

typedef struct Row Row;

/* What becomes of an option's value: it is stored in a field of Options, or a function takes it. */
typedef enum {
    KIND_TEXT, KIND_WHOLE, KIND_REAL,     /* need a value; numbers within [lo, hi] */
    KIND_FLAG,                            /* +UA, -UA, Output_Alpha=on */
    KIND_CUSTOM                           /* by `set` */
} Kind;

/* `value` is "" where none was given; is_on is false for the -X form and for Key=off. False: o->error says why. */
typedef bool (*Setter)(Options *o, const Row *row, const char *value, bool is_on);

struct Row {
    const char *letters;             /* +W: POV-Ray's switch, in any case; NULL: none */
    const char *key;                 /* Width=: in a POV-Ray INI file; NULL: none */
    const char *name;                /* --width; NULL: none */
    const char *argument;            /* how --help calls the value; NULL: there is none; [X]: it may be left out */
    int commands;                    /* which commands know it */
    const char *help;                /* NULL: not told */
    Kind kind;
    size_t field;                    /* offset in Options */
    double lo, hi;
    Setter set;
};

/* ---- values ---- */

/* What is wrong with the argument in hand, whose text options_read puts before it. */
#define FAIL(o, ...) ((o)->error = arena_printf((o)->arena, __VA_ARGS__), false)

static bool read_number(const char *text, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return *text && !isspace((unsigned char)*text) && *end == '\0' && isfinite(*out);
}

static bool read_in_range(Options *o, const Row *row, const char *text, double *out)
{
    if (!read_number(text, out)) return FAIL(o, "'%s' is not a number", text);
    if (row->kind == KIND_WHOLE && *out != floor(*out)) return FAIL(o, "%s is not a whole number", text);
    if (*out >= row->lo && *out <= row->hi) return true;
    if (isinf(row->hi)) return FAIL(o, "%s is too small", text);
    return FAIL(o, "%s is not in the range %g to %.7g", text, row->lo, row->hi);
}

static bool set_value(Options *o, const Row *row, const char *value, bool is_on)
{
    void *field = (char *)o + row->field;
    double number;
    switch (row->kind) {
    case KIND_TEXT: *(const char **)field = value; return true;
    case KIND_FLAG: *(bool *)field = is_on; return true;
    case KIND_WHOLE:
        if (!read_in_range(o, row, value, &number)) return false;
        *(int *)field = (int)number;
        return true;
    case KIND_REAL: return read_in_range(o, row, value, (double *)field);
    case KIND_CUSTOM: break;
    }
    return row->set(o, row, value, is_on);
}

static bool set_bits(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    bool is_16 = strcmp(value, "16") == 0;
    if (!is_16 && strcmp(value, "8") != 0) return FAIL(o, "only 8 or 16 bits a channel are written");
    o->bits = is_16 ? 16 : 8;
    return true;
}

/* +FN, +FN16; -F is "no file". */
static bool set_file_type(Options *o, const Row *row, const char *value, bool is_on)
{
    if (!is_on && !*value) return o->no_output = true;
    if (!is_on || toupper((unsigned char)*value) != 'N') return FAIL(o, "only PNG files are written: +FN");
    o->no_output = false;
    return set_bits(o, row, value[1] ? value + 1 : "8", true);
}

static bool set_output_to_file(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)row, (void)value;
    o->no_output = !is_on;
    return true;
}

static bool set_library(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    ARENA_PUSH(o->arena, o->library_paths, o->n_library_paths, o->library_paths_capacity) = value;
    return true;
}

static bool is_identifier(const char *name)
{
    if (!isalpha((unsigned char)*name) && *name != '_') return false;
    while (isalnum((unsigned char)*name) || *name == '_') name++;
    return !*name;
}

static bool set_declare(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    char *name = arena_strdup(o->arena, value), *equals = strchr(name, '=');
    double number;
    if (!equals || !read_number(equals + 1, &number)) return FAIL(o, "expected Name=number");
    *equals = '\0';
    if (!is_identifier(name)) return FAIL(o, "'%s' is not an identifier", name);
    ARENA_PUSH(o->arena, o->declares, o->n_declares, o->declares_capacity) = (ParseDeclare){ name, number };
    return true;
}

static bool set_clock(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)is_on;
    return o->clock_on = read_in_range(o, row, value, &o->clock);
}

static bool set_method(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    bool is_certain = strcmp(value, "certain") == 0;
    if (!is_certain && strcmp(value, "paper") != 0) return FAIL(o, "'%s' is not a method; there are: certain, paper", value);
    o->nurbs.method = is_certain ? NURBS_METHOD_CERTAIN : NURBS_METHOD_PAPER;
    return true;
}

static bool set_flattening(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    bool is_adaptive = strcmp(value, "adaptive") == 0;
    o->nurbs.flattening = is_adaptive ? NURBS_FLATTENING_ADAPTIVE : NURBS_FLATTENING_CURVATURE;
    return is_adaptive || strcmp(value, "curvature") == 0
        || FAIL(o, "'%s' is not a way of flattening; there are: curvature, adaptive", value);
}

/* +A, +A0.1, -A */
static bool set_antialias(Options *o, const Row *row, const char *value, bool is_on)
{
    o->antialias_on = is_on;
    return !*value || read_in_range(o, row, value, &o->antialias.threshold);
}

/* +J, +J0.5, -J */
static bool set_jitter(Options *o, const Row *row, const char *value, bool is_on)
{
    o->jitter_on = is_on;
    return !*value || read_in_range(o, row, value, &o->antialias.jitter);
}

static bool set_nothing(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)o, (void)row, (void)value, (void)is_on;
    return true;
}

/* What POV-Ray has and we do not, yet: never ignored, except where it is switched off. */
static bool set_unsupported(Options *o, const Row *row, const char *value, bool is_on)
{
    (void)value;
    return !is_on || FAIL(o, "%s is not yet supported", row->key);
}

/* ---- the table ---- */

enum {
    R = COMMAND_RENDER, C = COMMAND_CHECK, S = COMMAND_SHOOT, X = COMMAND_EXPORT, M = COMMAND_COMPARE,
    E = COMMAND_REPORT,
    ALL = R | C | S | X | E, /* that read a scene */
    EVERY = ALL | M
};

#define TEXT(f)          .kind = KIND_TEXT, .field = offsetof(Options, f)
#define WHOLE(f, a, b)   .kind = KIND_WHOLE, .field = offsetof(Options, f), .lo = (a), .hi = (b)
#define REAL(f, a, b)    .kind = KIND_REAL, .field = offsetof(Options, f), .lo = (a), .hi = (b)
#define FLAG(f)          .kind = KIND_FLAG, .field = offsetof(Options, f)
#define CUSTOM(function) .kind = KIND_CUSTOM, .set = function
#define NOTHING(letters, key) { letters, key, NULL, NULL, ALL, NULL, CUSTOM(set_nothing) }   /* cannot change a picture */
#define MISSING(letters, key) { letters, key, NULL, NULL, ALL, NULL, CUSTOM(set_unsupported) }

static const Row table[] = {
    { "I", "Input_File_Name", "input", "SCENE", ALL, "the scene, as a bare name is; .pov may be left out", TEXT(input) },
    { "O", "Output_File_Name", "output", "FILE", R | S | X | E,
      "the picture (default: beside the scene, as .png), shoot's hits, export's file (-: standard output), report's folder",
      TEXT(output) },
    { "W", "Width", "width", "N", ALL, "width of the picture in pixels (default 800, report: 512)",
      WHOLE(width, 1, MAX_SIZE) },
    { "H", "Height", "height", "N", ALL, "height of the picture (default 600, report: 384)", WHOLE(height, 1, MAX_SIZE) },
    { "F", NULL, NULL, "N[8|16]", R, "PNG with 8 (default) or 16 bits a channel; -F: no picture", CUSTOM(set_file_type) },
    { NULL, "Output_File_Type", NULL, "N", R, NULL, CUSTOM(set_file_type) },
    { NULL, "Output_To_File", NULL, NULL, R, NULL, CUSTOM(set_output_to_file) },
    { NULL, "Bits_Per_Color", "bits", "8|16", R, "the same", CUSTOM(set_bits) },
    { "UA", "Output_Alpha", "alpha", NULL, R, "write transparency too", FLAG(alpha) },
    { "Q", "Quality", "quality", "0..11", ALL, "how much of the light is computed (default 9: all)", WHOLE(quality, 0, 11) },
    { "A", "Antialias", "antialias", "[T]", R, "antialiasing, where colours differ by T (default .3) or more; -A: off",
      CUSTOM(set_antialias), .lo = 0, .hi = 1 },
    { NULL, "Antialias_Threshold", NULL, "T", R, NULL, REAL(antialias.threshold, 0, 1) },
    { "AM", "Sampling_Method", NULL, "1|2", R, "how: 1 (default): all samples of a pixel or one; 2: as many as it takes",
      WHOLE(antialias.method, 1, 2) },
    { "R", "Antialias_Depth", NULL, "N", R, "1: N x N samples more; 2: a pixel is halved N - 1 times at most (default 3)",
      WHOLE(antialias.depth, 1, ANTIALIAS_MAX_DEPTH) },
    { "J", "Jitter", NULL, "[X]", R, "samples are displaced by chance (default with +A), up to X of their distance; -J: not",
      CUSTOM(set_jitter), .lo = 0, .hi = 1 },
    { NULL, "Jitter_Amount", NULL, "X", R, NULL, REAL(antialias.jitter, 0, 1) },
    { NULL, "Antialias_Gamma", "antialias-gamma", "G", R, "colours are compared by their power 1/G (default 2.5)",
      REAL(antialias.gamma, 0x1p-10, 0x1p10) },
    { "BS", "Render_Block_Size", NULL, "N", R, "a thread's piece of work, in pixels a side (default 32)",
      WHOLE(block_size, ANTIALIAS_MIN_BLOCK, MAX_SIZE) },
    { "SC", "Start_Column", NULL, "X", R, "render from this column, counted from 1, or a fraction",
      REAL(start_column, 0, MAX_SIZE) },
    { "EC", "End_Column", NULL, "X", R, "... to this one; the rest of the picture is black", REAL(end_column, 0, MAX_SIZE) },
    { "SR", "Start_Row", NULL, "Y", R, "render from this row", REAL(start_row, 0, MAX_SIZE) },
    { "ER", "End_Row", NULL, "Y", R, "... to this one", REAL(end_row, 0, MAX_SIZE) },
    { "WT", "Work_Threads", "threads", "N", R | S | E,
      "threads (default: all cores, report: 1); results do not depend on it", WHOLE(n_threads, 1, MAX_THREADS) },
    { "L", "Library_Path", "library", "FOLDER", ALL, "where included files are looked for; may be repeated",
      CUSTOM(set_library) },
    { NULL, "Declare", "declare", "Name=X", ALL, "declare a number before the scene is read", CUSTOM(set_declare) },
    { "K", "Clock", "clock", "X", ALL, "the value of 'clock'", CUSTOM(set_clock), .lo = -INFINITY, .hi = INFINITY },
    { "MV", "Version", NULL, "X", ALL, "the language version of scenes without #version", REAL(version, 1, 3.7) },
    { NULL, NULL, "method", "certain|paper", ALL, "how rays meet NURBS surfaces", CUSTOM(set_method) },
    { NULL, NULL, "flattening", "WAY", ALL, "how they are cut up: curvature (default) or adaptive",
      CUSTOM(set_flattening) },
    { NULL, NULL, "flatness", "C", ALL, "how finely, where the scene does not say",
      REAL(nurbs.flatness, 0x1p-1022, INFINITY) },
    { NULL, NULL, "max-iterations", "N", ALL, "steps of Newton's method", WHOLE(nurbs.max_iterations, 1, MAX_NEWTON) },
    { NULL, NULL, "max-steps", "N", ALL, "rounds of loops and calls of macros before giving up (default 100000000)",
      WHOLE(max_steps, 1, 2000000000) },
    { NULL, NULL, "leaf-variation", "V", ALL, "method certain: how much derivatives may vary within a leaf (default .25)",
      REAL(nurbs.leaf_variation, 0x1p-1022, INFINITY) },
    { NULL, NULL, "rays", "FILE", S, "shoot: 6 little-endian doubles a ray; .txt and -: as text", TEXT(rays) },
    { NULL, NULL, "stats", "FILE.json", R | S, "times and counts; taking them costs up to a tenth of the time",
      TEXT(stats) },
    { NULL, NULL, "chord-error", "E", X, "how far triangles may be from surfaces (default: a 2000th of the scene's size)",
      REAL(chord_error, 0x1p-1022, INFINITY) },
    { NULL, NULL, "diff", "FILE", M, "a picture of the differences", TEXT(diff) },
    { NULL, NULL, "within", "L", M, "how far channels may differ, in steps of 1/255 (default 1)", REAL(within, 0, 255) },
    { NULL, NULL, "share", "S", M, "in which share of the pixels they must be so near (default 1: all)", REAL(share, 0, 1) },
    { NULL, NULL, "quick", NULL, E, "few settings and a small picture: within a minute", FLAG(is_quick) },
    { NULL, NULL, "runs", "N", E, "how often each setting is timed (default 5; quick: 3)", WHOLE(n_runs, 1, 1000) },
    { "V", "Verbose", "verbose", NULL, ALL, "tell more, on the standard error", FLAG(is_verbose) },
    { NULL, NULL, "quiet", NULL, EVERY, "tell errors only", FLAG(is_quiet) },
    { "D", "Display", NULL, NULL, R, "read for POV-Ray's sake: there is no display", CUSTOM(set_nothing) },
    NOTHING("GA", "All_Console"), NOTHING(NULL, "Test_Abort"), NOTHING(NULL, "Test_Abort_Count"), NOTHING("MB", "Bounding"),
    NOTHING(NULL, "Bounding_Threshold"), NOTHING(NULL, "Bounding_Method"), NOTHING("UL", "Light_Buffer"),
    NOTHING("UV", "Vista_Buffer"), NOTHING("UR", "Remove_Bounds"), NOTHING("SU", "Split_Unions"),
    NOTHING("WL", "Warning_Level"), NOTHING(NULL, "Video_Mode"), NOTHING(NULL, "Palette"), NOTHING(NULL, "Display_Gamma"),
    { NULL, NULL, "help", NULL, EVERY, "this text", FLAG(wants_help) },
    { NULL, NULL, "version", NULL, EVERY, "the program's version", FLAG(wants_version) },
    MISSING("C", "Continue_Trace"), MISSING("KFI", "Initial_Frame"), MISSING("KFF", "Final_Frame"),
    MISSING("P", "Pause_When_Done"),
};
enum { N_ROWS = sizeof table / sizeof *table };

static const struct { const char *name; Command command; const char *help; } commands[] = {
    { "render", COMMAND_RENDER, "render SCENE.png; the word may be left out" },
    { "check", COMMAND_CHECK, "read and validate; say what the scene has, and what is left out" },
    { "shoot", COMMAND_SHOOT, "hits of given rays: trimray shoot SCENE.pov --rays R.bin --out H.bin" },
    { "export", COMMAND_EXPORT, "the scene with meshes: trimray export SCENE.pov -o OUT.pov (or .obj, .stl)" },
    { "compare", COMMAND_COMPARE, "how two pictures differ: trimray compare A.png B.png; status 1: more than allowed" },
    { "report", COMMAND_REPORT, "error against run time, as a page: trimray report SCENE.pov... -o FOLDER" },
};
enum { N_COMMANDS = sizeof commands / sizeof *commands };

/* ---- reading ---- */

static bool may_have_value(const Row *row) { return row->kind != KIND_FLAG && row->argument; }
static bool needs_value(const Row *row) { return may_have_value(row) && *row->argument != '['; }

static bool apply(Options *o, const Row *row, const char *value, bool is_on)
{
    if (!(row->commands & o->command)) return FAIL(o, "means nothing to this command");
    if (needs_value(row) && !*value && is_on) return FAIL(o, "needs a value");
    if (row->kind == KIND_FLAG && *value) return FAIL(o, "takes no value");
    return set_value(o, row, value, is_on);
}

/* +W640, -D: the longest switch that the argument begins with. The sign says off only where no value follows. */
static bool read_switch(Options *o, const char *argument)
{
    const Row *best = NULL;
    size_t best_length = 0;
    for (const Row *row = table; row < table + N_ROWS; row++) {
        size_t length = row->letters ? strlen(row->letters) : 0;
        if (length > best_length && strncasecmp(argument + 1, row->letters, length) == 0) best = row, best_length = length;
    }
    if (!best) return FAIL(o, "unknown switch");
    bool is_on = *argument == '+' || (needs_value(best) && best->set != set_file_type);
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
    for (const Row *row = table; row < table + N_ROWS; row++) {
        if (!row->key || strlen(row->key) != length || strncasecmp(argument, row->key, length) != 0) continue;
        if (needs_value(row)) return apply(o, row, equals + 1, true);
        if (is_one_of(equals + 1, off)) return apply(o, row, "", false);
        bool is_switch = row->kind == KIND_FLAG || may_have_value(row);
        if (is_switch && !is_one_of(equals + 1, on)) return FAIL(o, "expected on or off");
        return apply(o, row, "", true);
    }
    return FAIL(o, "unknown setting");
}

/* The row of --name, which may be cut short as long as it is clear; NULL: o->error is set. */
static const Row *find_long(Options *o, const char *name, size_t length)
{
    const Row *found = NULL, *other = NULL;
    for (const Row *row = table; row < table + N_ROWS; row++) {
        if (!row->name || strncmp(row->name, name, length) != 0) continue;
        if (strlen(row->name) == length) return row;
        other = found, found = row;
    }
    if (!found) return FAIL(o, "unknown option") ? found : NULL;
    if (other) return FAIL(o, "--%s or --%s?", other->name, found->name) ? found : NULL;
    return found;
}

/* --name=value or --name value; *next is the argument after it, taken if it is needed. */
static bool read_long(Options *o, const char *argument, char *const **next, char *const *end)
{
    const char *name = argument + 2, *equals = strchr(name, '=');
    const Row *row = find_long(o, name, equals ? (size_t)(equals - name) : strlen(name));
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
    if (o->input) return FAIL(o, "one scene at a time, and %s is named already", o->input);
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
    return *argument ? read_bare(o, argument) : FAIL(o, "an empty argument");
}

static bool read_ini_option(void *options, const char *option)
{
    Options *o = options;
    return read_alone(o, option) || FAIL(o, "%s: %s", option, o->error);
}

static bool read_ini(Options *o, const char *path, const char *section)
{
    int line;
    if (o->n_inis == MAX_INIS) return FAIL(o, "more than %d INI files within one another", MAX_INIS);
    o->n_inis++;
    o->error = NULL;
    bool is_read = ini_read(path, section, o->arena, read_ini_option, o, &line);
    o->n_inis--;
    if (is_read) return true;
    if (line > 0) return FAIL(o, "line %d: %s", line, o->error);
    return section && errno == ENOENT ? FAIL(o, "there is no section [%s]", section) : FAIL(o, "%s", strerror(errno));
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
    for (int i = 0; next == argv && argc > 0 && i < N_COMMANDS; i++)
        if (strcmp(argv[0], commands[i].name) == 0) o->command = commands[i].command, next++;
    if (o->command == COMMAND_REPORT) o->width = o->height = 0;   /* chosen there */
    while (next < end) {
        const char *argument = *next++;
        if (!read_argument(o, argument, &next, end)) return FAIL(o, "%s: %s", argument, o->error);
    }
    if (o->wants_help || o->wants_version) return true;
    if (o->command == COMMAND_COMPARE) return o->other || FAIL(o, "compare needs two pictures");
    if (!o->input) return FAIL(o, "no scene given");
    if (o->command == COMMAND_EXPORT && !o->output) return FAIL(o, "export needs -o FILE");
    if (o->command == COMMAND_REPORT && !o->output) return FAIL(o, "report needs -o FOLDER");
    if (o->command == COMMAND_REPORT && !o->n_inputs) read_scene_name(o, o->input);   /* it came by +I */
    return o->command != COMMAND_SHOOT || o->rays || FAIL(o, "shoot needs --rays FILE");
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

static void print_row(const Row *row, FILE *out)
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
    for (int i = 0; i < N_COMMANDS; i++) fprintf(out, "  %-26s %s\n", commands[i].name, commands[i].help);
    fputs("\noptions, in POV-Ray's spelling and in full (also by POV-Ray's INI keys: Width=640; FILE.ini and FILE.ini[SECTION]"
          "\nread them from a file):\n", out);
    for (const Row *row = table; row < table + N_ROWS; row++)
        if (row->help) print_row(row, out);
    fputs("\nexit status: 0 done, 1 the scene or the input is wrong, 2 the command line is wrong, 3 a file cannot be read\n"
          "or written, 130 interrupted (what was finished is kept)\n", out);
}
