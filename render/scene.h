/* A scene, ready to be traced: what the parser builds and render.c reads. Everything lies in one arena. */
#ifndef TRIMRAY_SCENE_H
#define TRIMRAY_SCENE_H

#include "render/bvh.h"
#include "render/camera.h"
#include "render/light.h"
#include "render/object.h"
#include "render/shapes.h"

typedef enum { GAMMA_NONE, GAMMA_POWER, GAMMA_SRGB } GammaKind;   /* the working space; NONE: no transfer at all */

typedef struct {                                  /* the last pigment is the nearest */
    const Pigment *const *pigments;               /* as written: the last first seen */
    int n_pigments;
    Xform space;
} SkySphere;

typedef struct {
    int type;                                     /* 1 constant, 2 ground */
    double distance, offset, altitude;
    Vec3 up;                                      /* unit: the direction in which ground fog thins out */
    Color color;
} Fog;

typedef struct {
    Arena *arena;
    Object **objects;                             /* in order of the file */
    size_t n_objects, objects_capacity;
    Light *lights;
    size_t n_lights, lights_capacity;
    Camera camera;
    Color background;                             /* black with transmit 1 where not given: clear in files with alpha */
    const SkySphere *sky;                         /* NULL: none */
    const Fog *fogs;
    size_t n_fogs, fogs_capacity;
    Rgb ambient_light;                            /* 1 */
    int max_trace_level;                          /* 5 */
    double adc_bailout;                           /* 1/255 */
    GammaKind gamma;
    double gamma_power;
    double version;                               /* 3.7 */
    const Texture *default_texture;               /* of objects that have none */

    /* Made by scene_prepare: */
    bool needs_shadow_rays, needs_secondary_rays; /* what no light and no texture asks for is left out */
    struct SceneTree *tree;                       /* the finite objects under one tree, and the others */
} Scene;

Scene *scene_new(Arena *a);                       /* with POV-Ray's defaults */
void scene_add_object(Scene *s, Object *o);       /* and the lights that stand in it */
void scene_add_light(Scene *s, const Light *l);

/* Builds the tree over the objects and finds out what the scene needs. Shapes are not prepared: the first ray does that. */
void scene_prepare(Scene *s);
void scene_release(Scene *s);                     /* what prepared shapes hold; the arena is the caller's */

/* The nearest hit in (r->t_min, INFINITY). Objects with no_image are hidden from the camera, also through transparent ones;
 * objects with no_reflection from reflected rays (and from what is transmitted after a reflection: call that reflected). The
 * flags count on the objects of the scene, not on parts of their compounds. */
typedef enum { RAY_CAMERA, RAY_REFLECTED, RAY_TRANSMITTED } RayKind;
bool scene_hit(const Scene *s, const Ray *r, RayKind kind, Hit *best, Trace *t);

/* Shadow rays ask for two things. Does anything wholly opaque lie in (r->t_min, t_max)? If not, and only if
 * *may_be_filtered: all that may filter in (r->t_min, out->t_max), appended from near to far. Objects with no_shadow do not
 * count in either. scene_shadow_at says what a hit of the second kind does: an object that filters in one part may be opaque
 * in another, or without shadow. */
bool scene_blocks(const Scene *s, const Ray *r, double t_max, bool *may_be_filtered, Trace *t);
void scene_filters(const Scene *s, const Ray *r, HitList *out, Trace *t);
/* The same for `lanes` of a bunch, whose vectors are not needed where lanes_are_few: those that were hit (best[i].t is
 * INFINITY of the others), that are blocked; those that may be filtered. */
Lanes scene_hit_bunch(const Scene *s, RayBunch *b, Lanes lanes, RayKind kind, Hit best[], Trace *t);
Lanes scene_blocks_bunch(const Scene *s, RayBunch *b, Lanes lanes, const double t_max[], Lanes *may_be_filtered, Trace *t);

typedef enum { SHADOW_NOTHING, SHADOW_FILTER, SHADOW_BLOCKER } ShadowKind;
ShadowKind scene_shadow_at(const Scene *s, const Hit *h);

#endif
