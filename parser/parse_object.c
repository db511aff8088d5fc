/* Objects: a shape's block, the modifiers that all objects share, and `object { O ... }`. What stands in a shape's block is
 * in parse_shape.c. */
#include "parser/rules.h"

#include <string.h>

/* ---- left out ---- */

void skip_block(Parser *p, const char *what)
{
    Place opened = expect_open(p, what);
    for (int depth = 0; depth > 0 || !peek_punct(p, '}');) {
        Token t = peek(p);
        if (t.kind == TOKEN_END) expect_close(p, '}', what, opened);
        if (t.kind == TOKEN_PUNCT) depth += (t.punct == '{') - (t.punct == '}');
        next(p);
    }
    expect_close(p, '}', what, opened);
}

bool parse_left_out(Parser *p, const char *const words[])
{
    Token t = peek(p);
    if (t.kind != TOKEN_WORD) return false;
    for (; *words; words++) {
        if (strcmp(t.text, *words) != 0) continue;
        next(p);
        parse_warn_once(p, t.place, *words, "'%s' is read and left out", *words);
        if (peek_punct(p, '{')) skip_block(p, *words);
        else if (starts_expression(p)) (void)parse_expression(p);
        return true;
    }
    return false;
}

void refuse_word(Parser *p, const char *word, const char *feature)
{
    if (!peek_word(p, word)) return;
    Token t = peek(p);
    t.text = feature;
    parse_fail_unsupported(p, t);
}

/* ---- modifiers ---- */

/* A copy of t moved with its object; what is mapped by uv stays as it is. */
static const Texture *texture_moved(Parser *p, const Texture *t, const Xform *x)
{
    if (t->map) return texture_transformed(parser_arena(p), t, x);
    Layer *layers = arena_copy(parser_arena(p), t->layers, (size_t)t->n_layers, sizeof *layers);
    for (int i = 0; i < t->n_layers; i++) {
        if (layers[i].pigment->uv_mapping) continue;
        Pigment *g = arena_copy(parser_arena(p), layers[i].pigment, 1, sizeof *g);
        pigment_transform(g, x);
        layers[i].pigment = g;
    }
    Texture moved = { .layers = layers, .n_layers = t->n_layers };
    return arena_copy(parser_arena(p), &moved, 1, sizeof moved);
}

/* The texture of o as seen from outside o: the transformations that were written after it are put into it, so that another
 * layer, or another pigment, can join it. */
static const Texture *texture_in_place(Parser *p, const Object *o)
{
    if (!o->texture) return parser_scene(p)->default_texture;
    if (xform_is_identity(&o->texture_space) || o->has_uv_mapping || o->texture->uv_mapping) return o->texture;
    return texture_moved(p, o->texture, &o->texture_space);
}

static void set_texture(Object *o, const Texture *t)
{
    o->texture = t;
    o->texture_space = xform_identity();
}

/* A texture on a texture is a layer on top of it (measured with POV-Ray 3.7). */
static void add_texture(Parser *p, Object *o, const Texture *t)
{
    set_texture(o, o->texture ? texture_layered(p, texture_in_place(p, o), t) : t);
}

static void modify_texture(Parser *p, Object *o, Place where)
{
    (void)where;
    add_texture(p, o, parse_texture(p));
}

static void modify_material(Parser *p, Object *o, Place where)
{
    (void)where;
    Material m = parse_material(p);
    if (m.texture) add_texture(p, o, m.texture);
    if (m.interior_texture) o->interior_texture = m.interior_texture;
    if (m.interior) o->interior = m.interior;
}

static void modify_pigment(Parser *p, Object *o, Place where)
{
    (void)where;
    set_texture(o, texture_with_pigment(p, texture_in_place(p, o)));
}

static void modify_finish(Parser *p, Object *o, Place where)
{
    (void)where;
    if (!o->texture) set_texture(o, parser_scene(p)->default_texture);
    o->texture = texture_with_finish(p, o->texture);
}

static void modify_interior(Parser *p, Object *o, Place where)
{
    (void)where;
    o->interior = parse_interior(p);
}

static void modify_interior_texture(Parser *p, Object *o, Place where)
{
    (void)where;
    o->interior_texture = parse_texture(p);
}

static void modify_uv_mapping(Parser *p, Object *o, Place where)
{
    if (o->texture) parse_error(p, where, "uv_mapping must stand before the texture");
    o->has_uv_mapping = true;
}

static void modify_no_shadow(Parser *p, Object *o, Place where)
{
    (void)p, (void)where;
    o->no_shadow = true;
}

static void modify_no_image(Parser *p, Object *o, Place where)
{
    (void)p, (void)where;
    o->no_image = true;
}

static void modify_no_reflection(Parser *p, Object *o, Place where)
{
    (void)p, (void)where;
    o->no_reflection = true;
}

static void modify_inverse(Parser *p, Object *o, Place where)
{
    (void)where;
    object_invert(parser_arena(p), o);
}

static void modify_clipped_by(Parser *p, Object *o, Place where)
{
    Shape **clips = NULL;
    size_t n = 0, capacity = 0;
    Place opened = expect_open(p, "clipped_by");
    (void)where;
    refuse_word(p, "bounded_by", "bounded_by in clipped_by");
    for (Object *clip; (clip = parse_any_object(p)) != NULL;) ARENA_PUSH(parser_arena(p), clips, n, capacity) = &clip->shape;
    if (n == 0) parse_fail_expected(p, "an object");
    expect_close(p, '}', "clipped_by", opened);
    object_clip(parser_arena(p), o, clips, (uint32_t)n);
}

static void modify_hollow(Parser *p, Object *o, Place where)
{
    (void)where;
    o->is_hollow = parse_optional_bool(p, true);
}

static void modify_double_illuminate(Parser *p, Object *o, Place where)
{
    (void)where;
    o->double_illuminate = parse_optional_bool(p, true);
}

static const struct {
    const char *word;
    void (*read)(Parser *p, Object *o, Place where);
} modifiers[] = {
    { "texture", modify_texture }, { "material", modify_material }, { "pigment", modify_pigment }, { "finish", modify_finish },
    { "interior", modify_interior }, { "interior_texture", modify_interior_texture },
    { "uv_mapping", modify_uv_mapping }, { "no_shadow", modify_no_shadow }, { "no_image", modify_no_image },
    { "no_reflection", modify_no_reflection }, { "inverse", modify_inverse }, { "hollow", modify_hollow },
    { "double_illuminate", modify_double_illuminate }, { "clipped_by", modify_clipped_by },
};

/* They change nothing in a picture made by these means: bounds are found without help, solvers need no hint, and there are
 * no photons and no radiosity. */
static const char *const left_out[] = { "bounded_by", "photons", "no_radiosity", "sturm", "hierarchy", NULL };

static bool parse_modifier(Parser *p, Object *o)
{
    Token t = peek(p);
    if (t.kind != TOKEN_WORD) return false;
    Xform x = xform_identity();
    if (parse_transformation(p, &x)) {
        object_transform(o, &x);
        if (strcmp(t.text, "scale") == 0) o->child = smooth_triangle_scaled(parser_arena(p), o->child, &o->placement);
        return true;
    }
    for (size_t i = 0; i < sizeof modifiers / sizeof *modifiers; i++) {
        if (strcmp(t.text, modifiers[i].word) != 0) continue;
        next(p);
        modifiers[i].read(p, o, t.place);
        return true;
    }
    return parse_left_out(p, left_out);
}

void parse_modifiers(Parser *p, Object *o)
{
    while (parse_modifier(p, o)) continue;
}

/* ---- objects ---- */

static Place open_block(Parser *p, const ShapeRule *rule, char *closing)
{
    *closing = '}';
    if (!rule->may_use_angles || !peek_punct(p, '<')) return expect_open(p, rule->word);
    *closing = '>';
    return expect_punct(p, '<');
}

static Object *parse_shape_block(Parser *p, const ShapeRule *rule)
{
    char closing;
    Place word = next(p).place, opened = open_block(p, rule, &closing);
    Object *o = object_new(parser_arena(p), rule->read(p, word));
    parse_modifiers(p, o);
    expect_close(p, closing, rule->word, opened);
    return o;
}

/* object { O ... }, after the word: a copy of what was declared, or an object written here, and modified. */
static Object *parse_object_block(Parser *p)
{
    Place opened = expect_open(p, "object");
    Value v;
    Object *o;
    if (accept_value(p, VALUE_LIGHT, &v)) o = light_as_object(p, v.light, NULL);
    else if (accept_value(p, VALUE_OBJECT, &v)) o = object_copy(parser_arena(p), v.object);
    else o = parse_any_object(p);
    if (!o) parse_fail_expected(p, "an object");
    parse_modifiers(p, o);
    expect_close(p, '}', "object", opened);
    return o;
}

Object *parse_any_object(Parser *p)
{
    Token t = peek(p);
    if (t.kind != TOKEN_WORD) return NULL;
    if (accept_word(p, "object")) return parse_object_block(p);
    if (accept_word(p, "light_source")) {
        Light l;
        Object *look = parse_light(p, &l);
        return light_as_object(p, &l, look);
    }
    const ShapeRule *rule = shape_rule(t.text);
    return rule ? parse_shape_block(p, rule) : NULL;
}
