/* A hit as shading sees it, and where rays start and end so that they do not meet what they come from or go to. The rule
 * against self-intersection is hit_offset's (ray.h): by the hit's own error, along the surface's own normal. */
#include "render/surface.h"

Surface surface_at(const Scene *s, const Ray *r, const Hit *h)
{
    Attributes a;
    hit_attributes(h, r, &a);
    Surface at = { .ray = r, .hit = h, .point = ray_at(r, h->t), .normal = a.shading_normal, .geometric = a.normal,
                   .uv = a.uv };
    const Object *o = hit_textured_object(h);
    at.texture = o ? o->texture : s->default_texture;
    double cosine = -vec_dot(r->dir, at.normal);
    if (cosine < 0) {
        at.normal = vec_neg(at.normal);
        if (o && o->interior_texture) at.texture = o->interior_texture;
    }
    at.cos_view = fmin(fabs(cosine), 1);
    bool by_uv = at.texture->uv_mapping || (o && o->has_uv_mapping);
    at.texture_point = by_uv ? vec(a.uv.x, a.uv.y, 0) : hit_texture_point(h, at.point);
    return at;
}

Surface surface_with(const Surface *at, const TextureChoice *choice)
{
    Surface part = *at;
    part.texture = choice->texture;
    part.texture_point = choice->texture->uv_mapping ? vec(at->uv.x, at->uv.y, 0) : choice->point;
    return part;
}

Color surface_color(const Surface *at, const Layer *layer)
{
    return pigment_color(layer->pigment, at->texture_point, at->uv);
}

Vec3 surface_leave(const Surface *at, Vec3 dir)
{
    double side = vec_dot(dir, at->geometric) < 0 ? -1 : 1;
    return vec_add(at->point, vec_scale(at->geometric, side * hit_offset(at->hit, at->ray)));
}

/* The end F + d D misses T by at most 8 roundings of a coordinate (u = 2^-53): 5 of T - F and its normalization, 2 of the
 * product and the sum, 1 of d; each of no more than |F_i| + |T_i|. The sum over the coordinates bounds the distance. */
double surface_stop_before(Vec3 from, Vec3 to, double distance)
{
    static const double ROUNDING = 8 * 0x1p-53;
    double size = fabs(from.x) + fabs(from.y) + fabs(from.z) + fabs(to.x) + fabs(to.y) + fabs(to.z);
    return distance - ROUNDING * size;
}
