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

/* What chooses between textures has no pigment, no finish and no layers of its own. */
static void refuse_map(Parser *p, const Texture *t, const char *what)
{
    if (t->map) parse_fail(p, here(p), "a texture that chooses between textures by a pattern has no %s", what);
}

const Texture *texture_with_pigment(Parser *p, const Texture *t)
{
    refuse_map(p, t, "pigment");
    Pigment g = parse_pigment_from(p, t->layers[t->n_layers - 1].pigment);
    Texture *copy;
    Layer *layers = texture_copy(p, t, &copy);
    layers[t->n_layers - 1].pigment = arena_copy(parser_arena(p), &g, 1, sizeof g);
    return copy;
}

const Texture *texture_with_finish(Parser *p, const Texture *t)
{
    refuse_map(p, t, "finish");
    Finish f = parse_finish_from(p, t->layers[t->n_layers - 1].finish);
    Texture *copy;
    Layer *layers = texture_copy(p, t, &copy);
    layers[t->n_layers - 1].finish = f;
    return copy;
}

const Texture *texture_layered(Parser *p, const Texture *below, const Texture *top)
{
    refuse_map(p, below, "layers");
    refuse_map(p, top, "layers");
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

const Texture *parse_texture_body(Parser *p)
{
    const Texture *t = parse_mapped_texture(p);
    Value v;
    if (t) return t;
    t = parser_scene(p)->default_texture;
    if (accept_value(p, VALUE_TEXTURE, &v)) t = v.texture;
    while (parse_texture_item(p, &t)) continue;
    refuse_word(p, "object", "object pattern");
    return t;
}

const Texture *parse_texture(Parser *p)
{
    Place opened = expect_open(p, "texture");
    const Texture *t = parse_texture_body(p);
    expect_close(p, '}', "texture", opened);
    return t;
}
