/* material { }: a texture, one for the inside, and an interior, under one name. */
#include "parser/rules.h"

static void add_layers(Parser *p, const Texture **to, const Texture *t)
{
    *to = *to ? texture_layered(p, *to, t) : t;
}

static bool read_item(Parser *p, Material *m)
{
    Xform x = xform_identity();
    if (parse_transformation(p, &x)) {
        if (m->texture) m->texture = texture_transformed(parser_arena(p), m->texture, &x);
        if (m->interior_texture) m->interior_texture = texture_transformed(parser_arena(p), m->interior_texture, &x);
    } else if (accept_word(p, "texture")) {
        add_layers(p, &m->texture, parse_texture(p));
    } else if (accept_word(p, "interior_texture")) {
        add_layers(p, &m->interior_texture, parse_texture(p));
    } else if (accept_word(p, "interior")) {
        m->interior = parse_interior(p);
    } else {
        return false;
    }
    return true;
}

Material parse_material(Parser *p)
{
    Place opened = expect_open(p, "material");
    Material m = { .texture = NULL };
    Value v;
    if (accept_value(p, VALUE_MATERIAL, &v)) m = *v.material;
    while (read_item(p, &m)) continue;
    expect_close(p, '}', "material", opened);
    return m;
}
