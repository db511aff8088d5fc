/* Colours as they are written: color rgb <1, .5, 0>, rgbt E, red 1 green .5, Red filter .2. A word of a colour may only
 * begin one; what follows it is an expression without such words. */
#include "parser/functions.h"

#include <math.h>

static const Builtin *color_word(Parser *p)
{
    const Token *t = look(p);
    const Builtin *b = t->kind == TOKEN_WORD ? word_of(t->text)->builtin : NULL;
    return b && b->color != COLOR_NO_WORD ? b : NULL;
}

bool starts_color(Parser *p)
{
    return color_word(p) != NULL;
}

static double srgb_decode(double c)   /* IEC 61966-2-1, beyond its range as POV-Ray does */
{
    return c <= .04045 ? c / 12.92 : pow((c + .055) / 1.055, 2.4);
}

static double srgb_encode(double c)
{
    return c <= .0031308 ? c * 12.92 : 1.055 * pow(c, 1 / 2.4) - .055;
}

/* From sRGB into the working space, which has to be known by now. */
static void from_srgb(Parser *p, Place where, Term *t)
{
    const Scene *s = p->scene;
    if (s->gamma == GAMMA_NONE) parse_fail(p, where, "srgb colours cannot be read before assumed_gamma is set");
    for (int i = 0; i < 3; i++) {
        t->v[i] = srgb_decode(t->v[i]);
        if (s->gamma == GAMMA_SRGB) t->v[i] = srgb_encode(t->v[i]);
        else if (s->gamma_power != 1) t->v[i] = pow(t->v[i], 1 / s->gamma_power);
    }
}

/* How many components of its operand a word takes, if it is a float; and whether the fourth is transmit. */
static int components(ColorWord w)
{
    switch (w) {
    case COLOR_RGB: case COLOR_SRGB: return 3;
    case COLOR_RGBF: case COLOR_RGBT: case COLOR_SRGBF: case COLOR_SRGBT: return 4;
    default: return 5;
    }
}

/* What follows rgb and the like: a float fills all components, a vector gives its own, and what is missing is 0. Longer
 * ones than the word asks for are taken whole, as POV-Ray does, which finds them suspicious. */
static Term parse_operand(Parser *p, ColorWord w)
{
    Place where = here(p);
    Term e = need_numbers(p, where, parse_sum(p));
    int n = components(w);
    if (e.n > n && !e.is_color) parse_warn(p, where, "expected at most %d components, found %d", n, e.n);
    Term c = { .n = 5, .is_color = true };
    for (int i = 0; i < 5; i++) c.v[i] = e.n == 1 ? (i < n ? e.v[0] : 0) : i < e.n ? e.v[i] : 0;
    if (w == COLOR_RGBT || w == COLOR_SRGBT) c.v[4] = c.v[3], c.v[3] = 0;
    if (w >= COLOR_SRGB && w <= COLOR_SRGBFT) from_srgb(p, where, &c);
    return c;
}

Term parse_color_parts(Parser *p, Term c)
{
    const Builtin *b;
    while ((b = color_word(p)) && b->color >= COLOR_RED) {
        input_take(p);
        c.v[b->color - COLOR_RED] = parse_float(p);
    }
    return c;
}

Term parse_color_words(Parser *p)
{
    Term c = { .n = 5, .is_color = true };
    const Builtin *b = color_word(p);
    if (b->color == COLOR_ANY) {
        input_take(p);
        b = color_word(p);
    }
    if (!b) {
        c = parse_operand(p, COLOR_ANY);
    } else if (b->color < COLOR_RED) {
        input_take(p);
        c = parse_operand(p, b->color);
    }
    return parse_color_parts(p, c);
}
