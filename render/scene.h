/* A scene, ready to be traced: what the parser builds and render.c reads. Everything lies in one arena. */
#ifndef TRIMRAY_SCENE_H
#define TRIMRAY_SCENE_H

#include "render/bvh.h"
#include "render/camera.h"
#include "render/light.h"
#include "render/object.h"
#include "render/shapes.h"

typedef enum { GAMMA_NONE, GAMMA_POWER, GAMMA_SRGB } GammaKind;   /* the working space; NONE: no transfer at all */

typedef struct {                                  /* povray-facts section 8 */
    const Pigment *const *pigments;               /* as written: the last first seen */
    int n_pigments;
    Xform space;
} SkySphere;

typedef struct {
    int type;                                     /* 1 constant, 2 ground */
    double distance, offset, altitude;
    Color color;
} Fog;

typedef struct {
    Arena *arena;
    Object **objects;                             /* in order of the file */
    size_t n_objects, objects_capacity;
    Light *lights;
    size_t n_lights, lights_capacity;
    Camera camera;
    Color background;
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
    Shape *root;                                  /* the finite objects under one tree, and the others */
    bool needs_shadow_rays, needs_secondary_rays; /* what no light and no texture asks for is left out */
    struct SceneTree *tree;
} Scene;

Scene *scene_new(Arena *a);                       /* with POV-Ray's defaults */
void scene_add_object(Scene *s, Object *o);
void scene_add_light(Scene *s, const Light *l);

/* Builds the tree over the objects and finds out what the scene needs. Shapes are not prepared: the first ray does that. */
void scene_prepare(Scene *s);
void scene_release(Scene *s);                     /* what prepared shapes hold; the arena is the caller's */

/* The nearest hit in (r->t_min, INFINITY); `camera` rays pass objects with no_image, others those with no_reflection. */
typedef enum { RAY_CAMERA, RAY_REFLECTED, RAY_TRANSMITTED } RayKind;
bool scene_hit(const Scene *s, const Ray *r, RayKind kind, Hit *best, Trace *t);

/* Does anything opaque lie in (r->t_min, t_max)? Transparent blockers do not count here: see shade.c. */
bool scene_hit_shadow(const Scene *s, const Ray *r, double t_max, Hit *nearest, Trace *t);

#endif
