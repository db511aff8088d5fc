/* The functions and constants of expressions: one row each, and how their arguments are read. A result that is no number
 * (sqrt(-1), ln(0), pow(0, 0)) is an error, as in POV-Ray. */
#include "parser/functions.h"

#include <math.h>
#include <string.h>

/* ---- arguments ---- */

static Place open_arguments(Parser *p) { return expect_punct(p, '('); }
static void close_arguments(Parser *p, const Builtin *self, Place opened) { expect_close(p, ')', self->name, opened); }

static double next_float(Parser *p)
{
    accept_comma(p);
    return parse_float(p);
}

static double the_float(Parser *p, const Builtin *self)
{
    Place opened = open_arguments(p);
    double x = parse_float(p);
    close_arguments(p, self, opened);
    return x;
}

static const char *the_string(Parser *p, const Builtin *self)
{
    Place opened = open_arguments(p);
    const char *s = parse_string(p);
    close_arguments(p, self, opened);
    return s;
}

static Term defined(Parser *p, Place where, const Builtin *self, double value)
{
    if (isnan(value)) parse_fail(p, where, "%s is not defined for these numbers", self->name);
    return term_float(value);
}

/* ---- numbers ---- */

static Term call_real(Parser *p, const Builtin *self, Place where)
{
    return defined(p, where, self, self->real(the_float(p, self)));
}

static Term call_real2(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    double x = parse_float(p), y = next_float(p);
    close_arguments(p, self, opened);
    return defined(p, where, self, self->real2(x, y));
}

/* min, max, bitwise_and, ...: any number of arguments. */
static Term call_fold(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    double x = parse_float(p);
    while (accept_punct(p, ',')) x = self->real2(x, parse_float(p));
    close_arguments(p, self, opened);
    return defined(p, where, self, x);
}

/* asin and acos outside -1 .. 1: POV-Ray warns and clamps. */
static Term call_arc(Parser *p, const Builtin *self, Place where)
{
    double x = the_float(p, self), clamped = fmin(fmax(x, -1), 1);
    if (x != clamped) parse_warn(p, where, "%s(%g): taken as %s(%g)", self->name, x, self->name, clamped);
    return term_float(self->real(clamped));
}

static double real_ln(double x) { return x > 0 ? log(x) : NAN; }
static double real_log10(double x) { return x > 0 ? log10(x) : NAN; }
static double real_pow(double x, double y) { return x == 0 && y == 0 ? NAN : pow(x, y); }
static double real_div(double x, double y) { return y == 0 ? NAN : trunc(x / y); }
static double real_degrees(double x) { return x * (180 / M_PI); }
static double real_radians(double x) { return x * (M_PI / 180); }
static double real_min(double x, double y) { return y < x ? y : x; }
static double real_max(double x, double y) { return y > x ? y : x; }

static int64_t integer(double x) { return x >= -0x1p62 && x <= 0x1p62 ? (int64_t)x : 0; }
static double real_and(double x, double y) { return (double)(integer(x) & integer(y)); }
static double real_or(double x, double y) { return (double)(integer(x) | integer(y)); }
static double real_xor(double x, double y) { return (double)(integer(x) ^ integer(y)); }

/* select(a, negative, zero, positive) or select(a, negative, otherwise) */
static Term call_select(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    double a = parse_float(p), negative = next_float(p), zero = next_float(p), positive = zero;
    if (accept_punct(p, ',')) positive = parse_float(p);
    close_arguments(p, self, opened);
    return term_float(a < 0 ? negative : a > 0 ? positive : zero);
}

static Term call_seed(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    return term_float(random_seed(&p->random, p->arena, the_float(p, self)));
}

static Term call_rand(Parser *p, const Builtin *self, Place where)
{
    double value;
    if (!random_next(&p->random, the_float(p, self), &value))
        parse_fail(p, where, "rand wants what seed() gave, kept in an identifier");
    return term_float(value);
}

static Term call_defined(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    bool is_defined = parse_is_defined(p);
    close_arguments(p, self, opened);
    return term_float(is_defined);
}

static const Array *parse_array_name(Parser *p)
{
    const Value *v = look_slot(p);
    if (!v || v->kind != VALUE_ARRAY) parse_fail_expected(p, "an array");
    input_take(p);
    return v->array;
}

static Term call_dimensions(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    const Array *a = parse_array_name(p);
    close_arguments(p, self, opened);
    return term_float(a->n_dimensions);
}

static Term call_dimension_size(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    const Array *a = parse_array_name(p);
    double d = trunc(next_float(p));
    close_arguments(p, self, opened);
    if (!(d >= 1 && d <= a->n_dimensions))
        parse_fail(p, where, "dimension %g of an array that has %d", d, a->n_dimensions);
    return term_float(a->dimensions[(int)d - 1]);
}

/* ---- vectors ---- */

static Vec3 next_vec3(Parser *p)
{
    accept_comma(p);
    return parse_vec3(p);
}

static Term call_vcross(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    Vec3 a = parse_vec3(p), b = next_vec3(p);
    close_arguments(p, self, opened);
    return term_vec3(vec_cross(a, b));
}

static Term call_vdot(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    Vec3 a = parse_vec3(p), b = next_vec3(p);
    close_arguments(p, self, opened);
    return term_float(vec_dot(a, b));
}

static Term call_vlength(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    Vec3 a = parse_vec3(p);
    close_arguments(p, self, opened);
    return term_float(vec_length(a));
}

static Term call_vnormalize(Parser *p, const Builtin *self, Place where)
{
    Place opened = open_arguments(p);
    Vec3 a = parse_vec3(p);
    close_arguments(p, self, opened);
    if (vec_length2(a) == 0) parse_warn_once(p, where, "vnormalize(0)", "vnormalize of a vector without a direction");
    return term_vec3(vec_normalize(a));
}

static Term call_vrotate(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    Vec3 a = parse_vec3(p), degrees = next_vec3(p);
    close_arguments(p, self, opened);
    Xform x = xform_rotate(degrees);
    return term_vec3(xform_vector(&x, a));
}

static Term call_vaxis_rotate(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    Vec3 a = parse_vec3(p), axis = next_vec3(p);
    double degrees = next_float(p);
    close_arguments(p, self, opened);
    Xform x = xform_axis_rotate(axis, degrees);
    return term_vec3(xform_vector(&x, a));
}

/* ---- constants and settings ---- */

static Term constant(Parser *p, const Builtin *self, Place where) { (void)p, (void)where; return term_float(self->number); }
static Term vector_x(Parser *p, const Builtin *b, Place w) { (void)p, (void)b, (void)w; return term_vec3(vec(1, 0, 0)); }
static Term vector_y(Parser *p, const Builtin *b, Place w) { (void)p, (void)b, (void)w; return term_vec3(vec(0, 1, 0)); }
static Term vector_z(Parser *p, const Builtin *b, Place w) { (void)p, (void)b, (void)w; return term_vec3(vec(0, 0, 1)); }
static Term vector_u(Parser *p, const Builtin *b, Place w)
{
    (void)p, (void)b, (void)w;
    return (Term){ .n = 2, .v = { 1, 0 } };
}
static Term vector_v(Parser *p, const Builtin *b, Place w)
{
    (void)p, (void)b, (void)w;
    return (Term){ .n = 2, .v = { 0, 1 } };
}
static Term vector_t(Parser *p, const Builtin *b, Place w)
{
    (void)p, (void)b, (void)w;
    return (Term){ .n = 4, .v = { 0, 0, 0, 1 } };
}

static Term call_clock(Parser *p, const Builtin *b, Place w)
{
    (void)b, (void)w;
    return term_float(p->options->clock);
}
static Term call_clock_on(Parser *p, const Builtin *b, Place w)
{
    (void)b, (void)w;
    return term_float(p->options->clock_on);
}
static Term call_width(Parser *p, const Builtin *b, Place w)
{
    (void)b, (void)w;
    return term_float(p->options->image_width);
}
static Term call_height(Parser *p, const Builtin *b, Place w)
{
    (void)b, (void)w;
    return term_float(p->options->image_height);
}
static Term call_version(Parser *p, const Builtin *b, Place w)
{
    (void)b, (void)w;
    return term_float(p->scene->version);
}

/* ---- strings that are numbers ---- */

static Term call_strlen(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    return term_float((double)strlen(the_string(p, self)));
}

static Term call_strcmp(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    Place opened = open_arguments(p);
    const char *a = parse_string(p);
    accept_comma(p);
    const char *b = parse_string(p);
    close_arguments(p, self, opened);
    int order = strcmp(a, b);
    return term_float((order > 0) - (order < 0));
}

static Term call_asc(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    return term_float(text_first_code(the_string(p, self)));
}

static Term call_val(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    return term_float(text_value(the_string(p, self)));
}

static Term call_file_exists(Parser *p, const Builtin *self, Place where)
{
    (void)where;
    return term_float(source_find(p->arena, p->options, the_string(p, self)) != NULL);
}

/* ---- the table ---- */

static const Builtin builtins[] = {
    { .name = "abs", .call = call_real, .real = fabs }, { .name = "acos", .call = call_arc, .real = acos },
    { .name = "acosh", .call = call_real, .real = acosh }, { .name = "asin", .call = call_arc, .real = asin },
    { .name = "asinh", .call = call_real, .real = asinh }, { .name = "atan", .call = call_real, .real = atan },
    { .name = "atanh", .call = call_real, .real = atanh }, { .name = "ceil", .call = call_real, .real = ceil },
    { .name = "cos", .call = call_real, .real = cos }, { .name = "cosh", .call = call_real, .real = cosh },
    { .name = "degrees", .call = call_real, .real = real_degrees }, { .name = "exp", .call = call_real, .real = exp },
    { .name = "floor", .call = call_real, .real = floor }, { .name = "int", .call = call_real, .real = trunc },
    { .name = "ln", .call = call_real, .real = real_ln }, { .name = "log", .call = call_real, .real = real_log10 },
    { .name = "radians", .call = call_real, .real = real_radians }, { .name = "sin", .call = call_real, .real = sin },
    { .name = "sinh", .call = call_real, .real = sinh }, { .name = "sqrt", .call = call_real, .real = sqrt },
    { .name = "tan", .call = call_real, .real = tan }, { .name = "tanh", .call = call_real, .real = tanh },
    { .name = "atan2", .call = call_real2, .real2 = atan2 }, { .name = "div", .call = call_real2, .real2 = real_div },
    { .name = "mod", .call = call_real2, .real2 = fmod }, { .name = "pow", .call = call_real2, .real2 = real_pow },
    { .name = "max", .call = call_fold, .real2 = real_max }, { .name = "min", .call = call_fold, .real2 = real_min },
    { .name = "bitwise_and", .call = call_fold, .real2 = real_and },
    { .name = "bitwise_or", .call = call_fold, .real2 = real_or },
    { .name = "bitwise_xor", .call = call_fold, .real2 = real_xor }, { .name = "select", .call = call_select },
    { .name = "seed", .call = call_seed }, { .name = "rand", .call = call_rand },
    { .name = "defined", .call = call_defined }, { .name = "dimensions", .call = call_dimensions },
    { .name = "dimension_size", .call = call_dimension_size }, { .name = "vcross", .call = call_vcross },
    { .name = "vdot", .call = call_vdot }, { .name = "vlength", .call = call_vlength },
    { .name = "vnormalize", .call = call_vnormalize }, { .name = "vrotate", .call = call_vrotate },
    { .name = "vaxis_rotate", .call = call_vaxis_rotate }, { .name = "strlen", .call = call_strlen },
    { .name = "strcmp", .call = call_strcmp }, { .name = "asc", .call = call_asc }, { .name = "val", .call = call_val },
    { .name = "file_exists", .call = call_file_exists }, { .name = "chr", .call = text_chr },
    { .name = "concat", .call = text_concat }, { .name = "str", .call = text_str },
    { .name = "strlwr", .call = text_strlwr }, { .name = "strupr", .call = text_strupr },
    { .name = "substr", .call = text_substr }, { .name = "vstr", .call = text_vstr },
    { .name = "pi", .call = constant, .number = M_PI }, { .name = "true", .call = constant, .number = 1 },
    { .name = "false", .call = constant }, { .name = "on", .call = constant, .number = 1 },
    { .name = "off", .call = constant }, { .name = "yes", .call = constant, .number = 1 },
    { .name = "no", .call = constant }, { .name = "clock_delta", .call = constant },
    { .name = "frame_number", .call = constant }, { .name = "initial_frame", .call = constant },
    { .name = "final_frame", .call = constant }, { .name = "initial_clock", .call = constant },
    { .name = "final_clock", .call = constant }, { .name = "x", .call = vector_x }, { .name = "y", .call = vector_y },
    { .name = "z", .call = vector_z }, { .name = "u", .call = vector_u }, { .name = "v", .call = vector_v },
    { .name = "t", .call = vector_t }, { .name = "clock", .call = call_clock },
    { .name = "clock_on", .call = call_clock_on }, { .name = "image_width", .call = call_width },
    { .name = "image_height", .call = call_height }, { .name = "version", .call = call_version },
    { .name = "color", .color = COLOR_ANY }, { .name = "colour", .color = COLOR_ANY },
    { .name = "rgb", .color = COLOR_RGB }, { .name = "rgbf", .color = COLOR_RGBF },
    { .name = "rgbt", .color = COLOR_RGBT }, { .name = "rgbft", .color = COLOR_RGBFT },
    { .name = "srgb", .color = COLOR_SRGB }, { .name = "srgbf", .color = COLOR_SRGBF },
    { .name = "srgbt", .color = COLOR_SRGBT }, { .name = "srgbft", .color = COLOR_SRGBFT },
    { .name = "red", .color = COLOR_RED }, { .name = "green", .color = COLOR_GREEN },
    { .name = "blue", .color = COLOR_BLUE }, { .name = "filter", .color = COLOR_FILTER },
    { .name = "transmit", .color = COLOR_TRANSMIT },
};

const Builtin *builtin_at(size_t i)
{
    return i < sizeof builtins / sizeof *builtins ? &builtins[i] : NULL;
}
