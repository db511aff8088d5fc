#include "render/option_table.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MAX_SIZE 1000000      /* of a picture's side: libpng's own limit */
#define MAX_THREADS 1024
#define MAX_NEWTON 1000       /* steps; 10 are plenty */

/* ---- values ---- */

static bool read_number(const char *text, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return *text && !isspace((unsigned char)*text) && *end == '\0' && isfinite(*out);
}

static bool read_in_range(Options *o, const OptionRow *row, const char *text, double *out)
{
    if (!read_number(text, out)) return OPTION_FAIL(o, "'%s' is not a number", text);
    if (row->kind == OPTION_WHOLE && *out != floor(*out)) return OPTION_FAIL(o, "%s is not a whole number", text);
    if (*out >= row->lo && *out <= row->hi) return true;
    if (isinf(row->hi)) return OPTION_FAIL(o, "%s is too small", text);
    return OPTION_FAIL(o, "%s is not in the range %g to %.7g", text, row->lo, row->hi);
}

bool option_set(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    void *field = (char *)o + row->field;
    double number;
    switch (row->kind) {
    case OPTION_TEXT: *(const char **)field = value; return true;
    case OPTION_FLAG: *(bool *)field = is_on; return true;
    case OPTION_WHOLE:
        if (!read_in_range(o, row, value, &number)) return false;
        *(int *)field = (int)number;
        return true;
    case OPTION_REAL: return read_in_range(o, row, value, (double *)field);
    case OPTION_CUSTOM: break;
    }
    return row->set(o, row, value, is_on);
}

static bool set_bits(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    bool is_16 = strcmp(value, "16") == 0;
    if (!is_16 && strcmp(value, "8") != 0) return OPTION_FAIL(o, "only 8 or 16 bits a channel are written");
    o->bits = is_16 ? 16 : 8;
    return true;
}

/* +FN, +FN16; -F is "no file". */
static bool set_file_type(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    if (!is_on && !*value) return o->no_output = true;
    if (!is_on || toupper((unsigned char)*value) != 'N') return OPTION_FAIL(o, "only PNG files are written: +FN");
    o->no_output = false;
    return set_bits(o, row, value[1] ? value + 1 : "8", true);
}

static bool set_output_to_file(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)row, (void)value;
    o->no_output = !is_on;
    return true;
}

static bool set_library(Options *o, const OptionRow *row, const char *value, bool is_on)
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

static bool set_declare(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    char *name = arena_strdup(o->arena, value), *equals = strchr(name, '=');
    double number;
    if (!equals || !read_number(equals + 1, &number)) return OPTION_FAIL(o, "expected Name=number");
    *equals = '\0';
    if (!is_identifier(name)) return OPTION_FAIL(o, "'%s' is not an identifier", name);
    ARENA_PUSH(o->arena, o->declares, o->n_declares, o->declares_capacity) = (ParseDeclare){ name, number };
    return true;
}

static bool set_clock(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)is_on;
    return o->clock_on = read_in_range(o, row, value, &o->clock);
}

static bool set_method(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    bool is_certain = strcmp(value, "certain") == 0;
    if (!is_certain && strcmp(value, "paper") != 0)
        return OPTION_FAIL(o, "'%s' is not a method; there are: certain, paper", value);
    o->nurbs.method = is_certain ? NURBS_METHOD_CERTAIN : NURBS_METHOD_PAPER;
    return true;
}

static bool set_flattening(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)row, (void)is_on;
    bool is_adaptive = strcmp(value, "adaptive") == 0;
    o->nurbs.flattening = is_adaptive ? NURBS_FLATTENING_ADAPTIVE : NURBS_FLATTENING_CURVATURE;
    return is_adaptive || strcmp(value, "curvature") == 0
        || OPTION_FAIL(o, "'%s' is not a way of flattening; there are: curvature, adaptive", value);
}

/* +A, +A0.1, -A */
static bool set_antialias(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    o->antialias_on = is_on;
    return !*value || read_in_range(o, row, value, &o->antialias.threshold);
}

/* +J, +J0.5, -J */
static bool set_jitter(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    o->jitter_on = is_on;
    return !*value || read_in_range(o, row, value, &o->antialias.jitter);
}

static bool set_nothing(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)o, (void)row, (void)value, (void)is_on;
    return true;
}

/* What POV-Ray has and we do not, yet: never ignored, except where it is switched off. */
static bool set_unsupported(Options *o, const OptionRow *row, const char *value, bool is_on)
{
    (void)value;
    return !is_on || OPTION_FAIL(o, "%s is not yet supported", row->key);
}

/* ---- the table ---- */

enum {
    R = COMMAND_RENDER, C = COMMAND_CHECK, S = COMMAND_SHOOT, X = COMMAND_EXPORT, M = COMMAND_COMPARE,
    E = COMMAND_REPORT,
    ALL = R | C | S | X | E, /* that read a scene */
    EVERY = ALL | M
};

#define TEXT(f)          .kind = OPTION_TEXT, .field = offsetof(Options, f)
#define WHOLE(f, a, b)   .kind = OPTION_WHOLE, .field = offsetof(Options, f), .lo = (a), .hi = (b)
#define REAL(f, a, b)    .kind = OPTION_REAL, .field = offsetof(Options, f), .lo = (a), .hi = (b)
#define FLAG(f)          .kind = OPTION_FLAG, .field = offsetof(Options, f)
#define CUSTOM(function) .kind = OPTION_CUSTOM, .set = function
#define NOTHING(letters, key) { letters, key, NULL, NULL, ALL, NULL, CUSTOM(set_nothing) }   /* cannot change a picture */
#define MISSING(letters, key) { letters, key, NULL, NULL, ALL, NULL, CUSTOM(set_unsupported) }

const OptionRow option_rows[] = {
    { "I", "Input_File_Name", "input", "SCENE", ALL, "the scene, as a bare name is; .pov may be left out", TEXT(input) },
    { "O", "Output_File_Name", "output", "FILE", R | S | X | E,
      "the picture (default: beside the scene, as .png), shoot's hits, export's file (-: standard output), report's folder",
      TEXT(output) },
    { "W", "Width", "width", "N", ALL, "width of the picture in pixels (default 800, report: 512)",
      WHOLE(width, 1, MAX_SIZE) },
    { "H", "Height", "height", "N", ALL, "height of the picture (default 600, report: 384)", WHOLE(height, 1, MAX_SIZE) },
    { "F", NULL, NULL, "N[8|16]", R, "PNG with 8 (default) or 16 bits a channel; -F: no picture", CUSTOM(set_file_type),
      .minus_is_off = true },
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
    { NULL, NULL, "leaf-variation", "V", ALL, "method certain: how much derivatives may vary in a leaf (default .25 to .5)",
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
const int n_option_rows = sizeof option_rows / sizeof *option_rows;

const OptionCommand option_commands[] = {
    { "render", COMMAND_RENDER, "render SCENE.png; the word may be left out" },
    { "check", COMMAND_CHECK, "read and validate; say what the scene has, and what is left out" },
    { "shoot", COMMAND_SHOOT, "hits of given rays: trimray shoot SCENE.pov --rays R.bin --out H.bin" },
    { "export", COMMAND_EXPORT, "the scene with meshes: trimray export SCENE.pov -o OUT.pov (or .obj, .stl)" },
    { "compare", COMMAND_COMPARE, "how two pictures differ: trimray compare A.png B.png; status 1: more than allowed" },
    { "report", COMMAND_REPORT, "error against run time, as a page: trimray report SCENE.pov... -o FOLDER" },
};
const int n_option_commands = sizeof option_commands / sizeof *option_commands;
