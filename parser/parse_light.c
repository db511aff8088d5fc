/* light_source { }. Transformations act on what stands before them (measured with POV-Ray 3.7). */
#include "parser/rules.h"

#include <string.h>

static void set_kind(Light *l, LightKind kind)
{
    Light d = light_default(kind);
    l->kind = kind;
    l->radius = d.radius, l->falloff = d.falloff, l->tightness = d.tightness;
}

static void read_spotlight(Parser *p, Light *l) { (void)p, set_kind(l, LIGHT_SPOT); }
static void read_cylinder(Parser *p, Light *l) { (void)p, set_kind(l, LIGHT_CYLINDER); }
static void read_point_at(Parser *p, Light *l) { l->point_at = parse_vec3(p); }
static void read_radius(Parser *p, Light *l) { l->radius = parse_float(p); }
static void read_falloff(Parser *p, Light *l) { l->falloff = parse_float(p); }
static void read_tightness(Parser *p, Light *l) { l->tightness = parse_float(p); }
static void read_parallel(Parser *p, Light *l) { (void)p, l->is_parallel = true; }
static void read_shadowless(Parser *p, Light *l) { (void)p, l->is_shadowless = true; }
static void read_fade_distance(Parser *p, Light *l) { l->fade_distance = parse_float(p); }
static void read_fade_power(Parser *p, Light *l) { l->fade_power = parse_float(p); }
static void read_adaptive(Parser *p, Light *l) { l->area_adaptive = parse_int(p); }
static void read_circular(Parser *p, Light *l) { (void)p, l->area_circular = true; }
static void read_orient(Parser *p, Light *l) { (void)p, l->area_orient = true; }
static void read_area_illumination(Parser *p, Light *l) { l->area_illumination = parse_optional_bool(p, true); }

static int read_area_count(Parser *p)
{
    Place where = here(p);
    int n = parse_int(p);
    if (n < 1) parse_error(p, where, "expected at least 1 light along a side of area_light, found %d", n);
    return n < 1 ? 1 : n;
}

static void read_area_light(Parser *p, Light *l)
{
    l->is_area = true;
    l->area_u = parse_vec3(p), accept_comma(p);
    l->area_v = parse_vec3(p), accept_comma(p);
    l->area_n_u = read_area_count(p), accept_comma(p);
    l->area_n_v = read_area_count(p);
}

static const struct {
    const char *word;
    void (*read)(Parser *p, Light *l);
} words[] = {
    { "spotlight", read_spotlight }, { "cylinder", read_cylinder }, { "point_at", read_point_at },
    { "radius", read_radius }, { "falloff", read_falloff }, { "tightness", read_tightness },
    { "parallel", read_parallel }, { "shadowless", read_shadowless }, { "fade_distance", read_fade_distance },
    { "fade_power", read_fade_power }, { "area_light", read_area_light }, { "adaptive", read_adaptive },
    { "circular", read_circular }, { "orient", read_orient }, { "area_illumination", read_area_illumination },
};

/* jitter: POV-Ray's comes from an internal table and cannot be repeated; the rest matters to media and photons alone. */
static const char *const left_out[] = { "jitter", "media_interaction", "media_attenuation", "photons", NULL };

/* looks_like { OBJECT }: seen where the light is, without a shadow of its own. */
static Object *read_look(Parser *p, const Light *l)
{
    Place opened = expect_open(p, "looks_like");
    Object *look = parse_any_object(p);
    if (!look) parse_fail_expected(p, "an object");
    expect_close(p, '}', "looks_like", opened);
    Xform x = xform_translate(l->position);
    object_transform(look, &x);
    look->no_shadow = true;
    return look;
}

static bool read_item(Parser *p, Light *l, Object **look)
{
    Token t = peek(p);
    Xform x = xform_identity();
    if (parse_transformation(p, &x)) {
        light_transform(l, &x);
        if (*look) object_transform(*look, &x);
        return true;
    }
    if (!*look && accept_word(p, "looks_like")) {
        *look = read_look(p, l);
        return true;
    }
    for (size_t i = 0; t.kind == TOKEN_WORD && i < sizeof words / sizeof *words; i++) {
        if (strcmp(t.text, words[i].word) != 0) continue;
        next(p);
        words[i].read(p, l);
        return true;
    }
    return parse_left_out(p, left_out);
}

Object *parse_light(Parser *p, Light *out)
{
    Place opened = expect_open(p, "light_source");
    Object *look = NULL;
    Value v;
    if (accept_value(p, VALUE_LIGHT, &v)) {
        *out = *v.light;
    } else {
        *out = light_default(LIGHT_POINT);
        out->position = parse_vec3(p);
        accept_comma(p);
        out->color = parse_rgb(p);
    }
    while (read_item(p, out, &look)) continue;
    expect_close(p, '}', "light_source", opened);
    return look;
}

Object *light_as_object(Parser *p, const Light *l, Object *look)
{
    Shape *light = light_shape_new(parser_arena(p), l);
    if (!look) return object_new(parser_arena(p), light);
    return object_new(parser_arena(p), union_new(parser_arena(p), (Shape *[]){ light, &look->shape }, 2));
}
