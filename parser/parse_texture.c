/* texture { }: layers of a pigment with a finish. Textures are immutable: each item makes a new one that shares what it
 * does not change. */
#include "parser/rules.h"

#include <string.h>

/* A copy of t whose layers may be written to. */
static Layer *texture_copy(Parser *p, const Texture *t, Texture **copy)
{
    Layer *layers = arena_copy(parser_arena(p), t->layers, (size_t)t->n_layers, sizeof *layers);
    *copy = arena_copy(parser_arena(p), t, 1, sizeof *t);
    (*copy)->layers = layers;
    return layers;
}

const Texture *texture_with_pigment(Parser *p, const Texture *t)
{
    Pigment g = parse_pigment_from(p, t->layers[t->n_layers - 1].pigment);
    Texture *copy;
    Layer *layers = texture_copy(p, t, &copy);
    layers[t->n_layers - 1].pigment = arena_copy(parser_arena(p), &g, 1, sizeof g);
    return copy;
}

const Texture *texture_with_finish(Parser *p, const Texture *t)
{
    Finish f = parse_finish_from(p, t->layers[t->n_layers - 1].finish);
    Texture *copy;
    Layer *layers = texture_copy(p, t, &copy);
    layers[t->n_layers - 1].finish = f;
    return copy;
}

const Texture *texture_layered(Parser *p, const Texture *below, const Texture *top)
{
    Layer *layers = ARENA_ARRAY(parser_arena(p), Layer, below->n_layers + top->n_layers);
    memcpy(layers, below->layers, (size_t)below->n_layers * sizeof *layers);
    memcpy(layers + below->n_layers, top->layers, (size_t)top->n_layers * sizeof *layers);
    Texture t = { .layers = layers, .n_layers = below->n_layers + top->n_layers,
                  .uv_mapping = below->uv_mapping || top->uv_mapping };
    return arena_copy(parser_arena(p), &t, 1, sizeof t);
}

static const Texture *texture_with_uv_mapping(Parser *p, const Texture *t)
{
    Texture *copy = arena_copy(parser_arena(p), t, 1, sizeof *t);
    copy->uv_mapping = true;
    return copy;
}

/* A pattern straight in a texture chooses between textures: named after its map. */
static void refuse_texture_patterns(Parser *p)
{
    Token t = peek(p);
    if (t.kind == TOKEN_WORD && pattern_type(t.text)) refuse_word(p, t.text, "texture_map");
    refuse_word(p, "object", "object pattern");
}

bool parse_texture_item(Parser *p, const Texture **t)
{
    Xform x = xform_identity();
    if (parse_transformation(p, &x)) *t = texture_transformed(parser_arena(p), *t, &x);
    else if (accept_word(p, "pigment")) *t = texture_with_pigment(p, *t);
    else if (accept_word(p, "finish")) *t = texture_with_finish(p, *t);
    else if (accept_word(p, "uv_mapping")) *t = texture_with_uv_mapping(p, *t);
    else return false;
    return true;
}

const Texture *parse_texture(Parser *p)
{
    Place opened = expect_open(p, "texture");
    const Texture *t = parser_scene(p)->default_texture;
    Value v;
    if (accept_value(p, VALUE_TEXTURE, &v)) t = v.texture;
    while (parse_texture_item(p, &t)) continue;
    refuse_texture_patterns(p);
    expect_close(p, '}', "texture", opened);
    return t;
}
