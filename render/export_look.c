#include "render/export_look.h"

#include "render/image_map.h"

#include <string.h>

static void write_rgb(Sdl *out, const char *word, Rgb c)
{
    sdl_text(out, " %s rgb", word);
    sdl_vec(out, vec(c.r, c.g, c.b));
}

static void write_color(Sdl *out, Color c)
{
    sdl_text(out, " rgbft <%.9g, %.9g, %.9g, %.9g, %.9g>", c.r, c.g, c.b, c.filter, c.transmit);
}

static void write_value(Sdl *out, const char *word, double value)
{
    sdl_text(out, " %s", word);
    sdl_number(out, value);
}

void export_matrix(Sdl *out, const Xform *x)
{
    if (xform_is_identity(x)) return;
    sdl_text(out, " matrix <");
    for (int i = 0; i < 12; i++) sdl_text(out, "%s%.17g", i ? ", " : "", x->forward.m[i / 3][i % 3]);
    sdl_text(out, ">");
}

/* ---- pigments ---- */

static void write_pigment_body(Sdl *out, const Pigment *p);

static bool all_are_solid(const Pigment *p)
{
    for (int i = 0; i < p->n_entries; i++)
        if (p->entries[i].pigment->kind != PIGMENT_COLOR) return false;
    return true;
}

/* A pattern's name with what it is made of; the size of bricks comes after its blocks. */
static void write_pattern(Sdl *out, const Pattern *p)
{
    static const char *const words[] = {
        "ramp_wave", "triangle_wave", "sine_wave", "scallop_wave", "cubic_wave", "poly_wave"
    };
    sdl_text(out, " %s", p->type->name);
    if (p->type->n_blocks > 0) return;
    if (strcmp(p->type->name, "gradient") == 0) sdl_vec(out, p->direction);
    write_value(out, "frequency", p->frequency);
    write_value(out, "phase", p->phase);
    sdl_text(out, " %s", words[p->wave]);
    if (p->wave == WAVE_POLY) sdl_number(out, p->exponent);
}

static void write_bricks(Sdl *out, const Pattern *p)
{
    if (strcmp(p->type->name, "brick") != 0) return;
    sdl_text(out, " brick_size");
    sdl_vec(out, p->brick_size);
    write_value(out, "mortar", p->mortar);
}

static void write_blocks(Sdl *out, const Pigment *p)
{
    const PatternType *type = p->pattern.type;
    bool are_solid = all_are_solid(p);
    write_pattern(out, &p->pattern);
    for (int i = 0; i < type->n_blocks; i++) {
        const Pigment own = pigment_solid(type->blocks[i]), *g = i < p->n_entries ? p->entries[i].pigment : &own;
        if (i > 0) sdl_text(out, ",");
        if (!are_solid) sdl_text(out, " pigment {");
        write_pigment_body(out, g);
        if (!are_solid) sdl_text(out, " }");
    }
    write_bricks(out, &p->pattern);
}

static void write_map(Sdl *out, const Pigment *p)
{
    write_pattern(out, &p->pattern);
    if (p->n_entries == 0) return;
    sdl_text(out, all_are_solid(p) ? " color_map {" : " pigment_map {");
    for (int i = 0; i < p->n_entries; i++) {
        sdl_text(out, " [%.9g", p->entries[i].key);
        write_pigment_body(out, p->entries[i].pigment);
        sdl_text(out, "]");
    }
    sdl_text(out, " }");
}

static void write_pigment_body(Sdl *out, const Pigment *p)
{
    switch (p->kind) {
    case PIGMENT_COLOR: write_color(out, p->color); return;
    case PIGMENT_BLOCKS: write_blocks(out, p); break;
    case PIGMENT_MAP: write_map(out, p); break;
    case PIGMENT_IMAGE: image_map_write(p->image, out); break;
    }
    if (p->uv_mapping) sdl_text(out, " uv_mapping");
    export_matrix(out, &p->space);
}

/* ---- finishes ---- */

static void write_reflection(Sdl *out, const Finish *f)
{
    write_rgb(out, "reflection {", f->reflection_min);
    write_rgb(out, ",", f->reflection_max);
    if (f->reflection_fresnel) sdl_text(out, " fresnel");
    write_value(out, "falloff", f->reflection_falloff);
    write_value(out, "exponent", f->reflection_exponent);
    if (f->reflection_metallic != 0) write_value(out, "metallic", f->reflection_metallic);
    sdl_text(out, " }");
}

static void write_finish(Sdl *out, const Finish *f)
{
    sdl_text(out, " finish {");
    write_rgb(out, "ambient", f->ambient);
    write_rgb(out, "emission", f->emission);
    write_value(out, f->diffuse_albedo ? "diffuse albedo" : "diffuse", f->diffuse);
    if (f->diffuse_back != 0) write_value(out, ",", f->diffuse_back);
    write_value(out, "brilliance", f->brilliance);
    write_value(out, f->phong_albedo ? "phong albedo" : "phong", f->phong);
    write_value(out, "phong_size", f->phong_size);
    write_value(out, f->specular_albedo ? "specular albedo" : "specular", f->specular);
    write_value(out, "roughness", f->roughness);
    if (f->metallic != 0) write_value(out, "metallic", f->metallic);
    if (f->has_reflection) write_reflection(out, f);
    if (f->conserve_energy) sdl_text(out, " conserve_energy");
    sdl_text(out, " }");
}

/* ---- textures ---- */

static void write_layer(Sdl *out, const Layer *l, const Xform *outer)
{
    sdl_text(out, " pigment {");
    write_pigment_body(out, l->pigment);
    if (!l->pigment->uv_mapping && l->pigment->kind != PIGMENT_COLOR) export_matrix(out, outer);
    sdl_text(out, " }");
    write_finish(out, &l->finish);
}

static void write_texture_map(Sdl *out, const TextureMap *map, const Xform *outer);

/* What stands in a texture's block; layers have to be declared to stand in one. */
static void write_texture_body(Sdl *out, const Texture *t)
{
    Xform none = xform_identity();
    if (t->n_layers > 1) {
        sdl_text(out, "\n#local Layers =");
        export_texture(out, "texture", t, &none, false);
        sdl_text(out, "\nLayers");
        return;
    }
    if (t->uv_mapping) sdl_text(out, " uv_mapping");
    if (t->map) write_texture_map(out, t->map, &none);
    else write_layer(out, &t->layers[0], &none);
}

static void write_texture_map(Sdl *out, const TextureMap *map, const Xform *outer)
{
    bool has_blocks = map->pattern.type->n_blocks > 0;
    write_pattern(out, &map->pattern);
    if (!has_blocks) sdl_text(out, " texture_map {");
    for (int i = 0; i < map->n_entries; i++) {
        if (has_blocks) sdl_text(out, "%s texture {", i > 0 ? "," : "");
        else sdl_text(out, " [%.9g", map->entries[i].key);
        write_texture_body(out, map->entries[i].texture);
        sdl_text(out, has_blocks ? " }" : "]");
    }
    if (has_blocks) write_bricks(out, &map->pattern);
    else sdl_text(out, " }");
    export_matrix(out, &map->space);
    export_matrix(out, outer);
}

void export_texture(Sdl *out, const char *word, const Texture *t, const Xform *outer, bool by_uv)
{
    Xform none = xform_identity();
    const char *mapping = t->uv_mapping ? " uv_mapping" : "";
    if (by_uv || t->uv_mapping) outer = &none;
    for (int i = 0; i < t->n_layers; i++) {
        sdl_text(out, " %s {%s", word, mapping);
        write_layer(out, &t->layers[i], outer);
        sdl_text(out, " }");
    }
    if (!t->map) return;
    sdl_text(out, " %s {%s", word, mapping);
    write_texture_map(out, t->map, outer);
    sdl_text(out, " }");
}

void export_interior(Sdl *out, const Interior *i)
{
    sdl_text(out, " interior {");
    write_value(out, "ior", i->ior);
    if (i->caustics != 0) write_value(out, "caustics", i->caustics);
    write_value(out, "fade_distance", i->fade_distance);
    write_value(out, "fade_power", i->fade_power);
    sdl_text(out, " fade_color");
    write_color(out, i->fade_color);
    sdl_text(out, " }");
}

/* ---- lights ---- */

static void write_area(Sdl *out, const Light *l)
{
    sdl_text(out, " area_light");
    sdl_vec(out, l->area_u), sdl_text(out, ","), sdl_vec(out, l->area_v);
    sdl_text(out, ", %d, %d", l->area_n_u, l->area_n_v);
    if (l->area_adaptive != light_default(LIGHT_POINT).area_adaptive) sdl_text(out, " adaptive %d", l->area_adaptive);
    if (l->area_circular) sdl_text(out, " circular");
    if (l->area_orient) sdl_text(out, " orient");
    if (l->area_illumination) sdl_text(out, " area_illumination on");
}

static void write_light(Sdl *out, const Light *l)
{
    sdl_text(out, "light_source {");
    sdl_vec(out, l->position);
    write_rgb(out, ",", l->color);
    if (l->kind != LIGHT_POINT) {
        sdl_text(out, l->kind == LIGHT_SPOT ? " spotlight" : " cylinder");
        write_value(out, "radius", l->radius), write_value(out, "falloff", l->falloff);
        write_value(out, "tightness", l->tightness);
    }
    if (l->is_parallel) sdl_text(out, " parallel");
    if (l->kind != LIGHT_POINT || l->is_parallel) sdl_text(out, " point_at"), sdl_vec(out, l->point_at);
    if (l->is_shadowless) sdl_text(out, " shadowless");
    if (l->fade_distance > 0) {
        write_value(out, "fade_distance", l->fade_distance);
        write_value(out, "fade_power", l->fade_power);
    }
    if (l->is_area) write_area(out, l);
    sdl_text(out, " }\n");
}

/* ---- surroundings ---- */

static void write_settings(Sdl *out, const Scene *s)
{
    sdl_text(out, "#version %.9g;\nglobal_settings {", s->version);
    if (s->gamma == GAMMA_SRGB) sdl_text(out, " assumed_gamma srgb");
    if (s->gamma == GAMMA_POWER) write_value(out, "assumed_gamma", s->gamma_power);
    write_rgb(out, "ambient_light", s->ambient_light);
    sdl_text(out, " max_trace_level %d", s->max_trace_level);
    write_value(out, "adc_bailout", s->adc_bailout);
    sdl_text(out, " }\n");
}

static void write_camera(Sdl *out, const Camera *c)
{
    sdl_text(out, "camera {%s location", c->kind == CAMERA_ORTHOGRAPHIC ? " orthographic" : " perspective");
    sdl_vec(out, c->location), sdl_text(out, " direction"), sdl_vec(out, c->direction);
    sdl_text(out, " right"), sdl_vec(out, c->right), sdl_text(out, " up"), sdl_vec(out, c->up);
    sdl_text(out, " }\n");
}

static void write_sky(Sdl *out, const SkySphere *sky)
{
    sdl_text(out, "sky_sphere {");
    for (int i = 0; i < sky->n_pigments; i++) {
        sdl_text(out, " pigment {");
        write_pigment_body(out, sky->pigments[i]);
        sdl_text(out, " }");
    }
    export_matrix(out, &sky->space);
    sdl_text(out, " }\n");
}

static void write_fog(Sdl *out, const Fog *f)
{
    sdl_text(out, "fog { fog_type %d", f->type);
    write_value(out, "distance", f->distance);
    if (f->type == 2) {
        write_value(out, "fog_offset", f->offset), write_value(out, "fog_alt", f->altitude);
        sdl_text(out, " up"), sdl_vec(out, f->up);
    }
    write_color(out, f->color);
    sdl_text(out, " }\n");
}

void export_surroundings(Sdl *out, const Scene *s)
{
    Color b = s->background;
    write_settings(out, s);
    write_camera(out, &s->camera);
    if (b.r != 0 || b.g != 0 || b.b != 0 || b.filter != 0 || b.transmit != 1) {
        sdl_text(out, "background {");
        write_color(out, b);
        sdl_text(out, " }\n");
    }
    if (s->sky) write_sky(out, s->sky);
    for (size_t i = 0; i < s->n_fogs; i++) write_fog(out, &s->fogs[i]);
    for (size_t i = 0; i < s->n_lights; i++) write_light(out, &s->lights[i]);
}
