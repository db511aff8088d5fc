/* finish { } and interior { }: POV-Ray's words. */
#include "parser/rules.h"

#include <stddef.h>
#include <string.h>

/* ---- reflection ---- */

static void set_reflection(Finish *f, Rgb min, Rgb max)
{
    f->reflection_min = min;
    f->reflection_max = max;
    f->has_reflection = fmax(fmax(max.r, max.g), max.b) > 0 || fmax(fmax(min.r, min.g), min.b) > 0;
}

static bool read_reflection_word(Parser *p, Finish *f)
{
    if (accept_word(p, "fresnel")) f->reflection_fresnel = parse_optional_bool(p, true);
    else if (accept_word(p, "falloff")) f->reflection_falloff = parse_float(p);
    else if (accept_word(p, "exponent")) f->reflection_exponent = parse_float(p);
    else if (accept_word(p, "metallic")) f->reflection_metallic = starts_expression(p) ? parse_float(p) : 1;
    else return false;
    return true;
}

/* reflection K, or reflection { MIN, MAX words }, or with one colour for both; with fresnel, one colour is the larger. */
static void read_reflection(Parser *p, Finish *f)
{
    if (!peek_punct(p, '{')) {
        Rgb k = parse_rgb(p);
        set_reflection(f, k, k);
        return;
    }
    Place opened = expect_open(p, "reflection");
    Rgb min = parse_rgb(p), max = min;
    accept_comma(p);
    bool has_two = starts_expression(p);
    if (has_two) max = parse_rgb(p);
    while (read_reflection_word(p, f)) continue;
    expect_close(p, '}', "reflection", opened);
    if (f->reflection_fresnel && !has_two) min = rgb(0, 0, 0);
    set_reflection(f, min, max);
}

/* ---- finish ---- */

static void read_ambient(Parser *p, Finish *f) { f->ambient = parse_rgb(p); }
static void read_emission(Parser *p, Finish *f) { f->emission = parse_rgb(p); }

static void read_diffuse(Parser *p, Finish *f)
{
    f->diffuse_albedo = accept_word(p, "albedo");
    f->diffuse = parse_float(p);
    if (accept_punct(p, ',')) f->diffuse_back = parse_float(p);
}

static void read_phong(Parser *p, Finish *f)
{
    f->phong_albedo = accept_word(p, "albedo");
    f->phong = parse_float(p);
}

static void read_specular(Parser *p, Finish *f)
{
    f->specular_albedo = accept_word(p, "albedo");
    f->specular = parse_float(p);
}

static void read_metallic(Parser *p, Finish *f) { f->metallic = starts_expression(p) ? parse_float(p) : 1; }
static void read_conserve_energy(Parser *p, Finish *f) { f->conserve_energy = parse_optional_bool(p, true); }
static void read_brilliance(Parser *p, Finish *f) { f->brilliance = parse_float(p); }
static void read_phong_size(Parser *p, Finish *f) { f->phong_size = parse_float(p); }
static void read_roughness(Parser *p, Finish *f) { f->roughness = parse_float(p); }
static void read_reflection_exponent(Parser *p, Finish *f) { f->reflection_exponent = parse_float(p); }

static const struct {
    const char *word;
    void (*read)(Parser *p, Finish *f);
} words[] = {
    { "ambient", read_ambient }, { "emission", read_emission }, { "diffuse", read_diffuse },
    { "brilliance", read_brilliance }, { "phong", read_phong }, { "phong_size", read_phong_size },
    { "specular", read_specular }, { "roughness", read_roughness }, { "metallic", read_metallic },
    { "reflection", read_reflection }, { "reflection_exponent", read_reflection_exponent },
    { "conserve_energy", read_conserve_energy },
};

static bool read_item(Parser *p, Finish *f)
{
    Token t = peek(p);
    for (size_t i = 0; t.kind == TOKEN_WORD && i < sizeof words / sizeof *words; i++) {
        if (strcmp(t.text, words[i].word) != 0) continue;
        next(p);
        words[i].read(p, f);
        return true;
    }
    return false;
}

Finish parse_finish_from(Parser *p, Finish base)
{
    Place opened = expect_open(p, "finish");
    Finish f = base;
    Value v;
    if (accept_value(p, VALUE_FINISH, &v)) f = *v.finish;
    while (read_item(p, &f)) continue;
    expect_close(p, '}', "finish", opened);
    return f;
}

Finish parse_finish(Parser *p)
{
    const Texture *t = parser_scene(p)->default_texture;
    return parse_finish_from(p, t->layers[t->n_layers - 1].finish);
}

/* ---- interior ---- */

static bool read_interior_item(Parser *p, Interior *in)
{
    if (accept_word(p, "ior")) in->ior = (float)parse_float(p);
    else if (accept_word(p, "caustics")) in->caustics = (float)parse_float(p);
    else if (accept_word(p, "fade_distance")) in->fade_distance = (float)parse_float(p);
    else if (accept_word(p, "fade_power")) in->fade_power = (float)parse_float(p);
    else if (accept_word(p, "fade_color") || accept_word(p, "fade_colour")) in->fade_color = parse_color(p);
    else return false;
    return true;
}

const Interior *parse_interior(Parser *p)
{
    Place opened = expect_open(p, "interior");
    Interior in = { .ior = 1 };
    Value v;
    if (accept_value(p, VALUE_INTERIOR, &v)) in = *v.interior;
    while (read_interior_item(p, &in)) continue;
    expect_close(p, '}', "interior", opened);
    return arena_copy(parser_arena(p), &in, 1, sizeof in);
}
