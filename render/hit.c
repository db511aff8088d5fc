#include "render/hit.h"

const Interior *hit_interior(const Hit *h)
{
    for (int i = 0; i < h->n_objects; i++)
        if (h->objects[i]->interior) return h->objects[i]->interior;
    return NULL;
}

const Object *hit_innermost(const Hit *h) { return h->n_objects > 0 ? h->objects[0] : NULL; }

bool hit_has_flag_no_shadow(const Hit *h)
{
    for (int i = 0; i < h->n_objects; i++)
        if (h->objects[i]->no_shadow) return true;
    return false;
}

Vec3 hit_texture_point(const Hit *h, Vec3 world)
{
    const Object *textured = hit_textured_object(h);
    if (!textured) return world;
    for (int i = h->n_objects - 1; h->objects[i] != textured; i--)
        if (h->objects[i]->is_placed) world = xform_unpoint(&h->objects[i]->placement, world);
    return xform_unpoint(&textured->texture_space, world);
}

static void place_normals(const Object *o, Attributes *at)
{
    bool is_smooth = !vec_is_same(at->normal, at->shading_normal);
    at->normal = vec_normalize(xform_normal(&o->placement, at->normal));
    at->shading_normal = is_smooth ? vec_normalize(xform_normal(&o->placement, at->shading_normal)) : at->normal;
}

static void find_attributes(const Hit *h, const Ray *world, Attributes *out)
{
    Ray room;
    const Ray *r = world;
    for (int i = h->n_objects - 1; i >= 0; i--) r = ray_within(h->objects[i], r, &room);
    Vec3 p = ray_at(world, h->t);
    out->uv = vec2(p.x, p.y);
    h->shape->type->attributes(h->shape, r, h, out);
    bool is_inverse = false;
    for (int i = 0; i < h->n_objects; i++) {
        is_inverse ^= h->objects[i]->is_inverse;
        if (h->objects[i]->is_placed) place_normals(h->objects[i], out);
    }
    if (!is_inverse) return;
    out->normal = vec_neg(out->normal);
    out->shading_normal = vec_neg(out->shading_normal);
}

void hit_attributes(const Hit *h, const Ray *world, Attributes *out)
{
    out->is_without_uv = false;
    find_attributes(h, world, out);
}

void hit_normals(const Hit *h, const Ray *world, Attributes *out)
{
    out->is_without_uv = true;
    find_attributes(h, world, out);
}
