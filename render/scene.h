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

/* What lies between a point and a light, in (r->t_min, t_max)? Something opaque; or a filter, and *h is the nearest: shadow.c
 * takes from the light what it does and asks scene_next_filter for what lies beyond it (an opaque part of the same object may
 * be found only then). Objects with no_shadow do not count. */
typedef enum { SHADOW_NOTHING, SHADOW_FILTER, SHADOW_BLOCKER } ShadowFind;
ShadowFind scene_hit_shadow(const Scene *s, const Ray *r, double t_max, Hit *h, Trace *t);
ShadowFind scene_next_filter(const Scene *s, const Ray *r, double t_max, Hit *h, Trace *t);

#endif
