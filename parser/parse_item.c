/* What can stand after #declare, and the statements of a scene: two tables from a word to what reads it. */
#include "parser/rules.h"

#include <string.h>

/* ---- items: what can be declared ---- */

static Value item_texture(Parser *p)
{
    const Texture *t = parse_texture(p);
    while (accept_word(p, "texture")) t = texture_layered(p, t, parse_texture(p));
    return (Value){ .kind = VALUE_TEXTURE, .texture = t };
}

static Value item_pigment(Parser *p) { return (Value){ .kind = VALUE_PIGMENT, .pigment = parse_pigment(p) }; }

static Value item_finish(Parser *p)
{
    Finish f = parse_finish(p);
    return (Value){ .kind = VALUE_FINISH, .finish = arena_copy(parser_arena(p), &f, 1, sizeof f) };
}

static Value item_interior(Parser *p) { return (Value){ .kind = VALUE_INTERIOR, .interior = parse_interior(p) }; }

static Value item_material(Parser *p)
{
    Material m = parse_material(p);
    return (Value){ .kind = VALUE_MATERIAL, .material = arena_copy(parser_arena(p), &m, 1, sizeof m) };
}

static Value item_camera(Parser *p)
{
    CameraDesc *c = ARENA_NEW(parser_arena(p), CameraDesc);
    parse_camera(p, c);
    return (Value){ .kind = VALUE_CAMERA, .camera = c };
}

static Value item_light(Parser *p)
{
    Light *l = ARENA_NEW(parser_arena(p), Light);
    Object *look = parse_light(p, l);
    if (!look) return (Value){ .kind = VALUE_LIGHT, .light = l };
    return (Value){ .kind = VALUE_OBJECT, .object = light_as_object(p, l, look) };
}

static Value item_color_map(Parser *p)
{
    Value v = { .kind = VALUE_COLOR_MAP };
    v.map = parse_color_map(p, &v.n);
    return v;
}

static Value item_pigment_map(Parser *p)
{
    Value v = { .kind = VALUE_PIGMENT_MAP };
    v.map = parse_pigment_map(p, &v.n);
    return v;
}

static Value item_texture_map(Parser *p)
{
    Value v = { .kind = VALUE_TEXTURE_MAP };
    parse_texture_map(p, &v.texture_map, &v.n);
    return v;
}

static Value item_sky_sphere(Parser *p) { return (Value){ .kind = VALUE_SKY_SPHERE, .sky = parse_sky_sphere(p) }; }

static Value item_fog(Parser *p) { return (Value){ .kind = VALUE_FOG, .fog = parse_fog(p) }; }

static const struct {
    const char *word;
    Value (*read)(Parser *p);
} items[] = {
    { "texture", item_texture }, { "pigment", item_pigment }, { "finish", item_finish }, { "interior", item_interior },
    { "material", item_material },
    { "camera", item_camera }, { "light_source", item_light }, { "color_map", item_color_map },
    { "colour_map", item_color_map }, { "pigment_map", item_pigment_map }, { "texture_map", item_texture_map },
    { "sky_sphere", item_sky_sphere },
    { "fog", item_fog },
};

static Value item_transform(Parser *p)
{
    Xform x = xform_identity();
    parse_transformation(p, &x);
    return (Value){ .kind = VALUE_TRANSFORM, .xform = arena_copy(parser_arena(p), &x, 1, sizeof x) };
}

bool parse_item(Parser *p, Value *out)
{
    Token t = peek(p);
    if (t.kind != TOKEN_WORD) return false;
    if (strcmp(t.text, "transform") == 0) return *out = item_transform(p), true;
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
        if (strcmp(t.text, items[i].word) != 0) continue;
        next(p);
        *out = items[i].read(p);
        return true;
    }
    const Object *o = parse_any_object(p);
    if (o) *out = (Value){ .kind = VALUE_OBJECT, .object = o };
    return o != NULL;
}

/* ---- statements ---- */

static void state_camera(Parser *p, Place where)
{
    CameraDesc desc;
    parse_camera(p, &desc);
    if (parser_summary(p)->n_cameras++ > 0) parse_warn(p, where, "more than one camera: this one replaces the one before");
    switch (camera_make(&desc, &parser_scene(p)->camera)) {
    case CAMERA_OK: break;
    case CAMERA_ANGLE_TOO_LARGE: parse_error(p, where, "expected an angle under 180 degrees, found %g", desc.angle); break;
    case CAMERA_ANGLE_NEGATIVE: parse_error(p, where, "expected a positive angle, found %g", desc.angle); break;
    case CAMERA_LOOKS_AT_ITSELF: parse_error(p, where, "the camera's look_at is its location"); break;
    case CAMERA_SKY_ALONG_DIRECTION:
        parse_warn(p, where, "the camera looks along its sky vector: 'right' stays as it was");
        break;
    case CAMERA_NOT_PERPENDICULAR: parse_warn(p, where, "the camera's vectors are not perpendicular"); break;
    }
}

/* An object without a texture has the default of this place in the file; it does not move with the object (measured with
 * POV-Ray 3.7). */
static void add_object(Parser *p, Object *o)
{
    if (!o->texture) {
        o->texture = parser_scene(p)->default_texture;
        o->texture_space = xform_identity();
    }
    scene_add_object(parser_scene(p), o);
}

static void state_light(Parser *p, Place where)
{
    (void)where;
    Light l;
    Object *look = parse_light(p, &l);
    scene_add_light(parser_scene(p), &l);
    if (look) add_object(p, look);
}

static void state_sky_sphere(Parser *p, Place where)
{
    const SkySphere *sky = parse_sky_sphere(p);
    if (parser_scene(p)->sky) parse_warn(p, where, "more than one sky_sphere: this one replaces the one before");
    parser_scene(p)->sky = sky;
}

static void state_fog(Parser *p, Place where)
{
    (void)where;
    Scene *s = parser_scene(p);
    const Fog *fog = parse_fog(p);
    Fog *fogs = arena_grow(parser_arena(p), (void *)s->fogs, s->n_fogs, &s->fogs_capacity, sizeof *fogs);
    fogs[s->n_fogs++] = *fog;
    s->fogs = fogs;
}

static void state_background(Parser *p, Place where)
{
    (void)where;
    parse_background(p);
}

static void state_global_settings(Parser *p, Place where)
{
    (void)where;
    parse_global_settings(p);
}

/* POV-Ray reads it without its # too. */
static void state_default(Parser *p, Place where)
{
    (void)where;
    Place opened = expect_open(p, "default");
    parse_default_items(p);
    expect_close(p, '}', "default", opened);
}

static const struct {
    const char *word;
    void (*read)(Parser *p, Place where);
} statements[] = {
    { "camera", state_camera }, { "light_source", state_light }, { "background", state_background },
    { "global_settings", state_global_settings }, { "sky_sphere", state_sky_sphere }, { "fog", state_fog },
    { "default", state_default },
};

void parse_statement(Parser *p)
{
    Token t = peek(p);
    for (size_t i = 0; t.kind == TOKEN_WORD && i < sizeof statements / sizeof *statements; i++) {
        if (strcmp(t.text, statements[i].word) != 0) continue;
        next(p);
        statements[i].read(p, t.place);
        return;
    }
    Object *o = parse_any_object(p);
    if (!o) parse_fail_expected(p, "an object or a directive");
    add_object(p, o);
}

/* Pigments and finishes start from the default texture's: it must have some. */
static const Texture *parse_default_texture(Parser *p)
{
    Place where = here(p);
    const Texture *t = parse_texture(p);
    if (t->map) parse_fail(p, where, "a texture that chooses between textures by a pattern cannot be the default");
    return t;
}

void parse_default_items(Parser *p)
{
    Scene *s = parser_scene(p);
    for (;;) {
        if (accept_word(p, "texture")) s->default_texture = parse_default_texture(p);
        else if (accept_word(p, "pigment")) s->default_texture = texture_with_pigment(p, s->default_texture);
        else if (accept_word(p, "finish")) s->default_texture = texture_with_finish(p, s->default_texture);
        else return;
    }
}

void parse_begin(Parser *p)
{
    settings_begin(p);
}

void parse_end(Parser *p)
{
    Scene *s = parser_scene(p);
    settings_end(p);
    parser_summary(p)->n_objects = s->n_objects;
    parser_summary(p)->n_lights = s->n_lights;
    if (s->n_objects == 0 && diag_error_count(parser_diag(p)) == 0)
        parse_warn(p, (Place){ .source = NULL }, "there are no objects in the scene");
}

const char *const *parse_object_words(void)
{
    static const char *words[64];   /* filled from the tables when first asked for, always with the same words */
    if (words[0]) return words;
    size_t n = 0;
    for (size_t i = 0; shape_rule_at(i); i++) words[n++] = shape_rule_at(i)->word;
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) words[n++] = items[i].word;
    for (size_t i = 0; i < sizeof statements / sizeof *statements; i++) words[n++] = statements[i].word;
    words[n++] = "object", words[n++] = "transform";
    return words;
}
