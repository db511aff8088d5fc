/* The colour of a point: one colour, blocks, a map over a pattern, or a picture. */
#include "render/image_map.h"
#include "render/texture.h"

Pigment pigment_solid(Color c)
{
    return (Pigment){ .kind = PIGMENT_COLOR, .color = c, .space = xform_identity() };
}

void pigment_transform(Pigment *p, const Xform *x)
{
    p->space = xform_then(p->space, *x);
    p->is_moved = !xform_is_identity(&p->space);
}

static Color block_color(const Pigment *p, Vec3 point, Vec2 uv)
{
    int block = (int)pattern_value(&p->pattern, point);
    return block < p->n_entries ? pigment_color(p->entries[block].pigment, point, uv) : p->pattern.type->blocks[block];
}

/* Without a map: black to white, or round the hues with POV-Ray's keys. */
static Color default_map(const PatternType *type, double value)
{
    static const Color black = { 0 }, white = { 1, 1, 1, 0, 0 };
    static const Color hues[] = { { 0, 1, 1, 0, 0 }, { 1, 1, 0, 0, 0 }, { 1, 0, 1, 0, 0 }, { 0, 1, 1, 0, 0 } };
    static const float keys[] = { 0, .333f, .666f, 1 };
    if (!type->is_rainbow) return color_lerp(black, white, value);
    int i = value < keys[1] ? 0 : value < keys[2] ? 1 : 2;
    return color_lerp(hues[i], hues[i + 1], fmin((value - keys[i]) / (keys[i + 1] - keys[i]), 1));
}

static Color map_color(const Pigment *p, Vec3 point, Vec2 uv)
{
    double value = pattern_value(&p->pattern, point);
    if (p->n_entries == 0) return default_map(p->pattern.type, value);
    MapSpot at = pattern_spot(p->entries, sizeof *p->entries, p->n_entries, value);
    Color high = pigment_color(p->entries[at.high].pigment, point, uv);
    if (at.low == at.high) return high;
    return color_lerp(pigment_color(p->entries[at.low].pigment, point, uv), high, at.share);
}

Color pigment_color_at(const Pigment *p, Vec3 point, Vec2 uv)
{
    if (p->uv_mapping) point = vec(uv.x, uv.y, 0);
    if (p->is_moved) point = xform_unpoint(&p->space, point);
    switch (p->kind) {
    case PIGMENT_COLOR: return p->color;
    case PIGMENT_BLOCKS: return block_color(p, point, uv);
    case PIGMENT_MAP: return map_color(p, point, uv);
    default: return image_map_at(p->image, point);
    }
}

static bool is_clear(Color c) { return c.filter != 0 || c.transmit != 0; }

bool pigment_is_opaque(const Pigment *p)
{
    if (p->kind == PIGMENT_COLOR) return !is_clear(p->color);
    if (p->kind == PIGMENT_IMAGE) return image_map_is_opaque(p->image);
    for (int i = 0; i < p->n_entries; i++)
        if (!pigment_is_opaque(p->entries[i].pigment)) return false;
    return true;   /* the colours that stand in for what was left out are opaque */
}
