/* A hit as shading sees it, and where rays start and end so that they do not meet what they come from or go to. The rule
 * against self-intersection is hit_offset's (ray.h): by the hit's own error, along the surface's own normal. */
#include "render/surface.h"

#include "render/hit.h"

void surface_at(const Scene *s, const Ray *r, const Hit *h, Surface *out)
{
    Attributes a;
    const Object *o = hit_textured_object(h);
    const Texture *texture = o ? o->texture : s->default_texture;
    bool is_even = o ? o->is_even : texture_is_even(texture);
    if (is_even) hit_normals(h, r, &a);
    else hit_attributes(h, r, &a);
    double cosine = -vec_dot(r->dir, a.shading_normal);
    bool is_inside = cosine < 0;
    if (is_inside && o && o->interior_texture) texture = o->interior_texture;
    out->ray = r, out->hit = h;
    out->point = ray_at(r, h->t);
    out->normal = is_inside ? vec_neg(a.shading_normal) : a.shading_normal;
    out->geometric = a.normal;
    out->cos_view = double_min(fabs(cosine), 1);
    out->offset = hit_offset(h, r);
    out->texture = texture;
    out->uv = a.uv;
    if (is_even) return;
    bool by_uv = texture->uv_mapping || (o && o->has_uv_mapping);
    out->texture_point = by_uv ? vec(a.uv.x, a.uv.y, 0) : hit_texture_point(h, out->point);
}

Surface surface_with(const Surface *at, const TextureChoice *choice)
{
    Surface part = *at;
    part.texture = choice->texture;
    part.texture_point = choice->texture->uv_mapping ? vec(at->uv.x, at->uv.y, 0) : choice->point;
    return part;
}
