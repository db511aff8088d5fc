/* A shape in its place with its appearance: the one node that carries transformations, textures and flags. Primitives know
 * nothing of either; geometry under several objects is shared, never copied. */
#ifndef TRIMRAY_OBJECT_H
#define TRIMRAY_OBJECT_H

#include "render/shape.h"
#include "render/texture.h"
#include "render/xform.h"

struct Object {
    Shape shape;                   /* an object is a shape */
    Shape *child;                  /* shared */
    Xform placement;               /* from the child's space to the space outside */
    bool is_placed;                /* placement is not the identity; if so: */
    double stretch_in, stretch_out, shift_in;   /* at most by how much it stretches and moves, inwards and outwards */
    const Texture *texture;        /* of what lies below without a texture of its own; NULL: none given here */
    Xform texture_space;           /* from the texture's space to the space outside: the transformations written after it */
    const Texture *interior_texture;   /* seen from inside; NULL: `texture` there too */
    const Interior *interior;      /* NULL: none given here */
    bool has_uv_mapping, no_shadow, no_image, no_reflection, is_inverse, is_hollow, double_illuminate;
    unsigned looks;                /* object_looks keeps its answer here, and finds out: */
    bool is_even;                  /* its textures are the same everywhere */
    bool has_no_lights;            /* scene_add_object keeps here what it did not find below */
};

/* A plain object round a shape, with identity transformations. Fill in the rest before the first ray. If the tree below
 * would become deeper than HIT_MAX_OBJECTS, placements are distributed over the parts of the compounds below (nodes are
 * copied, geometry is shared). */
Object *object_new(Arena *a, Shape *child);

/* A copy of o, to be modified, as `object { O ... }` does; the geometry is shared. */
Object *object_copy(Arena *a, const Object *o);

/* Applies a transformation written after everything so far: moves the shape and its texture. */
void object_transform(Object *o, const Xform *x);

/* Turns o inside out: POV-Ray's `inverse`. A compound below becomes what its inverted parts make (so is_inverse only ever
 * stands directly over a primitive), and what is shared is copied. shape_inverse leaves s alone. */
void object_invert(Arena *a, Object *o);
Shape *shape_inverse(Arena *a, Shape *s);

/* Keeps of o's surface what lies inside all clips, which stand in the space outside of o. */
void object_clip(Arena *a, Object *o, Shape *const clips[], uint32_t n);

/* Is s an Object? */
bool shape_is_object(const Shape *s);

/* What there is somewhere in an object, compounds below included: what a ray through it may ask for. Walks shared nodes
 * once; o and all below it must not change afterwards. */
enum {
    LOOKS_KNOWN = 1,
    LOOKS_UNTEXTURED = 2,          /* something without a texture: it will have the default */
    LOOKS_CLEAR = 4,               /* a texture that lets light through */
    LOOKS_REFLECTING = 8,
    LOOKS_NO_SHADOW = 16
};
unsigned object_looks(Object *o);

/* r itself, or what it is within o, in `room`. */
static inline const Ray *ray_within(const Object *o, const Ray *r, Ray *room)
{
    if (!o->is_placed) return r;
    *room = (Ray){ xform_unpoint(&o->placement, r->origin), xform_unvector(&o->placement, r->dir), r->t_min };
    return room;
}

#endif
