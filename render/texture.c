/* Textures: what a map chooses, and questions about all their layers at once. */
#include "render/texture.h"

int texture_choose(const TextureMap *map, Vec3 point, TextureChoice out[2])
{
    Vec3 within = xform_unpoint(&map->space, point);
    double value = pattern_value(&map->pattern, within);
    MapSpot at = { (int)value, (int)value, 0 };
    if (map->pattern.type->n_blocks == 0) at = pattern_spot(map->entries, sizeof *map->entries, map->n_entries, value);
    bool is_one = at.low == at.high;
    out[0] = (TextureChoice){ map->entries[at.high].texture, within, is_one ? 1 : at.share };
    out[1] = (TextureChoice){ map->entries[at.low].texture, within, 1 - at.share };
    return is_one ? 1 : 2;
}

static const TextureMap *map_transformed(Arena *a, const TextureMap *map, const Xform *x)
{
    TextureMap *moved = arena_copy(a, map, 1, sizeof *map);
    moved->space = xform_then(map->space, *x);
    return moved;
}

Texture *texture_transformed(Arena *a, const Texture *t, const Xform *x)
{
    Layer *layers = ARENA_ARRAY(a, Layer, t->n_layers);
    for (int i = 0; i < t->n_layers; i++) {
        Pigment *moved = arena_copy(a, t->layers[i].pigment, 1, sizeof *moved);
        pigment_transform(moved, x);
        layers[i] = (Layer){ moved, t->layers[i].finish };
    }
    Texture *copy = arena_copy(a, t, 1, sizeof *copy);
    copy->layers = layers;
    if (t->map) copy->map = map_transformed(a, t->map, x);
    return copy;
}

/* A single opaque layer hides what is behind it, but POV-Ray asks for the word anywhere in the texture, and lets the colours
 * decide: shadows of such a texture are traced as of glass. */
bool texture_is_opaque(const Texture *t)
{
    for (int i = 0; i < t->n_layers; i++)
        if (!pigment_is_opaque(t->layers[i].pigment)) return false;
    for (int i = 0; t->map && i < t->map->n_entries; i++)
        if (!texture_is_opaque(t->map->entries[i].texture)) return false;
    return true;
}

bool texture_reflects(const Texture *t)
{
    for (int i = 0; i < t->n_layers; i++)
        if (t->layers[i].finish.has_reflection) return true;
    for (int i = 0; t->map && i < t->map->n_entries; i++)
        if (texture_reflects(t->map->entries[i].texture)) return true;
    return false;
}

bool texture_is_even(const Texture *t)
{
    for (int i = 0; i < t->n_layers; i++)
        if (t->layers[i].pigment->kind != PIGMENT_COLOR) return false;
    return !t->map;
}
