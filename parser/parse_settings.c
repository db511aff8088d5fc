/* What surrounds the objects: global_settings, background, sky_sphere, fog; and the settings that a file does not give. */
#include "parser/rules.h"

#include <string.h>

/* ---- global_settings ---- */

static void read_assumed_gamma(Parser *p, Scene *s, Place where)
{
    if (accept_word(p, "srgb")) {
        s->gamma = GAMMA_SRGB, s->gamma_power = 0;
        return;
    }
    double g = parse_float(p);
    if (!(g > 0)) parse_error(p, where, "expected a positive assumed_gamma, found %g", g);
    s->gamma = GAMMA_POWER, s->gamma_power = g;
}

static void read_max_trace_level(Parser *p, Scene *s, Place where)
{
    int level = parse_int(p);
    if (level < 1 || level > 256) parse_error(p, where, "expected a max_trace_level of 1 to 256, found %d", level);
    s->max_trace_level = level;
}

static void read_adc_bailout(Parser *p, Scene *s, Place where)
{
    (void)where;
    s->adc_bailout = parse_float(p);
}

static void read_ambient_light(Parser *p, Scene *s, Place where)
{
    (void)where;
    s->ambient_light = parse_rgb(p);
}

static const struct {
    const char *word;
    void (*read)(Parser *p, Scene *s, Place where);
} settings[] = {
    { "assumed_gamma", read_assumed_gamma }, { "max_trace_level", read_max_trace_level },
    { "adc_bailout", read_adc_bailout }, { "ambient_light", read_ambient_light },
};

static const char *const left_out[] = {
    "radiosity", "photons", "noise_generator", "max_intersections", "number_of_waves", "hf_gray_16", "irid_wavelength",
    "mm_per_unit", NULL
};

static bool read_charset(Parser *p)
{
    Place where = here(p);
    if (!accept_word(p, "charset")) return false;
    parse_warn_once(p, where, "charset", "'charset' is read and left out");
    next(p);
    return true;
}

static bool read_setting(Parser *p)
{
    Token t = peek(p);
    for (size_t i = 0; t.kind == TOKEN_WORD && i < sizeof settings / sizeof *settings; i++) {
        if (strcmp(t.text, settings[i].word) != 0) continue;
        next(p);
        settings[i].read(p, parser_scene(p), t.place);
        return true;
    }
    return read_charset(p) || parse_left_out(p, left_out);
}

void parse_global_settings(Parser *p)
{
    Place opened = expect_open(p, "global_settings");
    while (read_setting(p)) continue;
    expect_close(p, '}', "global_settings", opened);
}

/* ---- background, sky_sphere, fog ---- */

void parse_background(Parser *p)
{
    Place opened = expect_open(p, "background");
    parser_scene(p)->background = parse_color(p);
    expect_close(p, '}', "background", opened);
}

static void add_sky_pigment(Parser *p, SkySphere *sky)
{
    const Pigment *g = parse_pigment(p);
    const Pigment **list = ARENA_ARRAY(parser_arena(p), const Pigment *, sky->n_pigments + 1);
    for (int i = 0; i < sky->n_pigments; i++) list[i] = sky->pigments[i];
    list[sky->n_pigments++] = g;
    sky->pigments = list;
}

const SkySphere *parse_sky_sphere(Parser *p)
{
    Place opened = expect_open(p, "sky_sphere");
    SkySphere sky = { .space = xform_identity() };
    Value v;
    if (accept_value(p, VALUE_SKY_SPHERE, &v)) sky = *v.sky;
    for (;;) {
        if (accept_word(p, "pigment")) add_sky_pigment(p, &sky);
        else if (!parse_transformation(p, &sky.space)) break;
    }
    expect_close(p, '}', "sky_sphere", opened);
    return arena_copy(parser_arena(p), &sky, 1, sizeof sky);
}

static void read_fog_type(Parser *p, Fog *f)
{
    Place where = here(p);
    f->type = parse_int(p);
    if (f->type != 1 && f->type != 2) parse_fail(p, where, "expected a fog_type of 1 or 2, found %d", f->type);
}

static void read_fog_up(Parser *p, Fog *f)
{
    Place where = here(p);
    f->up = vec_normalize(parse_vec3(p));
    if (vec_max_abs(f->up) == 0) parse_error(p, where, "'up' of a fog is 0");
}

static bool read_fog_item(Parser *p, Fog *f)
{
    if (accept_word(p, "fog_type")) read_fog_type(p, f);
    else if (accept_word(p, "distance")) f->distance = parse_float(p);
    else if (accept_word(p, "fog_offset")) f->offset = parse_float(p);
    else if (accept_word(p, "fog_alt")) f->altitude = parse_float(p);
    else if (accept_word(p, "up")) read_fog_up(p, f);
    else if (starts_expression(p)) f->color = parse_color(p);
    else return false;
    return true;
}

const Fog *parse_fog(Parser *p)
{
    Place opened = expect_open(p, "fog");
    Fog fog = { .type = 1, .up = vec(0, 1, 0) };
    Value v;
    if (accept_value(p, VALUE_FOG, &v)) fog = *v.fog;
    while (read_fog_item(p, &fog)) continue;
    expect_close(p, '}', "fog", opened);
    return arena_copy(parser_arena(p), &fog, 1, sizeof fog);
}

/* ---- what is not given ---- */

void settings_begin(Parser *p)
{
    Scene *s = parser_scene(p);
    s->gamma = GAMMA_NONE, s->gamma_power = 0;
}

/* Without assumed_gamma: 1.0 from #version 3.7 on; nothing is encoded in older scenes (measured with POV-Ray 3.7). */
void settings_end(Parser *p)
{
    Scene *s = parser_scene(p);
    if (s->gamma == GAMMA_NONE && s->version >= 3.7) s->gamma = GAMMA_POWER, s->gamma_power = 1;
}
