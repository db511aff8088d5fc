/* What patterns have in common, whether they choose colours, pigments or textures. */
#include "parser/rules.h"

#include <string.h>

Pattern parse_pattern(Parser *p, const PatternType *type)
{
    Pattern g = pattern_make(type);
    if (strcmp(type->name, "gradient") == 0) g.direction = vec_normalize(parse_vec3(p));
    return g;
}

static void read_frequency(Parser *p, Pattern *g) { g->frequency = parse_float(p); }
static void read_phase(Parser *p, Pattern *g) { g->phase = parse_float(p); }
static void read_brick_size(Parser *p, Pattern *g) { g->brick_size = parse_vec3(p); }
static void read_mortar(Parser *p, Pattern *g) { g->mortar = (float)parse_float(p); }
static void read_ramp(Parser *p, Pattern *g) { (void)p, g->wave = WAVE_RAMP; }
static void read_triangle(Parser *p, Pattern *g) { (void)p, g->wave = WAVE_TRIANGLE; }
static void read_sine(Parser *p, Pattern *g) { (void)p, g->wave = WAVE_SINE; }
static void read_scallop(Parser *p, Pattern *g) { (void)p, g->wave = WAVE_SCALLOP; }
static void read_cubic(Parser *p, Pattern *g) { (void)p, g->wave = WAVE_CUBIC; }

static void read_poly(Parser *p, Pattern *g)
{
    g->wave = WAVE_POLY;
    if (starts_expression(p)) g->exponent = parse_float(p);
}

static const struct {
    const char *word;
    void (*read)(Parser *p, Pattern *g);
} words[] = {
    { "frequency", read_frequency }, { "phase", read_phase }, { "brick_size", read_brick_size }, { "mortar", read_mortar },
    { "ramp_wave", read_ramp }, { "triangle_wave", read_triangle }, { "sine_wave", read_sine },
    { "scallop_wave", read_scallop }, { "cubic_wave", read_cubic }, { "poly_wave", read_poly },
};

bool parse_pattern_item(Parser *p, Pattern *g)
{
    Token t = peek(p);
    for (size_t i = 0; t.kind == TOKEN_WORD && i < sizeof words / sizeof *words; i++) {
        if (strcmp(t.text, words[i].word) != 0) continue;
        next(p);
        words[i].read(p, g);
        return true;
    }
    return false;
}
