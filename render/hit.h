/* What a hit looks like: found along its chain of objects, innermost first. */
#ifndef TRIMRAY_HIT_H
#define TRIMRAY_HIT_H

#include "render/object.h"

/* Of the innermost object on the way that has what is asked for. */
static inline const Object *hit_textured_object(const Hit *h)   /* NULL: no texture anywhere: the default texture */
{
    for (int i = 0; i < h->n_objects; i++)
        if (h->objects[i]->texture) return h->objects[i];
    return NULL;
}
const Interior *hit_interior(const Hit *h);          /* NULL: none */
const Object *hit_innermost(const Hit *h);
bool hit_has_flag_no_shadow(const Hit *h);

/* The point where the texture of hit_textured_object is evaluated, from the point in the world. */
Vec3 hit_texture_point(const Hit *h, Vec3 world);

/* The ray and the attributes through all placements: what the primitive says, in world space. The normals are unit, turned
 * over for inverse objects, and not yet turned towards the viewer. */
void hit_attributes(const Hit *h, const Ray *world, Attributes *out);
void hit_normals(const Hit *h, const Ray *world, Attributes *out);   /* the same without uv */

#endif
