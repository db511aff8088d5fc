/* Textures: questions about all their layers at once. */
#include "render/texture.h"

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
    return copy;
}

/* A single opaque layer hides what is behind it, but POV-Ray asks for the word anywhere in the texture, and lets the colours
 * decide: shadows of such a texture are traced as of glass. */
bool texture_is_opaque(const Texture *t)
{
    for (int i = 0; i < t->n_layers; i++)
        if (!pigment_is_opaque(t->layers[i].pigment)) return false;
    return true;
}

bool texture_reflects(const Texture *t)
{
    for (int i = 0; i < t->n_layers; i++)
        if (t->layers[i].finish.has_reflection) return true;
    return false;
}
