/* Which interiors a ray is in, and what happens where it enters or leaves one. */
#ifndef TRIMRAY_MEDIA_H
#define TRIMRAY_MEDIA_H

#include "render/scene.h"

/* The interiors round a ray: a list that is never changed, the one entered last first; NULL: none. A solid is told apart by
 * the placements on the way from the object that carries the interior to the world; without one the parts of an object of
 * the scene are one solid, since POV-Ray gives them all the one interior that it makes for their whole. */
typedef struct Medium Medium;
struct Medium {
    const Medium *outer;
    const Interior *interior;            /* NULL: of ior 1 */
    bool is_hollow;
    int n_path;
    const Object *path[HIT_MAX_OBJECTS];
};

/* Camera rays begin in what contains the camera. To find that asks every object, and few rays need it: their list is
 * MEDIA_OF_CAMERA until somebody asks for it by media_known. */
#define MEDIA_OF_CAMERA (&media_of_camera)
extern const Medium media_of_camera;

typedef struct {
    const Scene *scene;
    Arena *scratch;
    Vec3 camera;                         /* where this camera ray starts */
    bool is_known;
    const Medium *at_camera;
} Surroundings;

const Medium *media_known(Surroundings *around, const Medium *media);

/* Lists made between the two are forgotten, the camera's own among them. */
typedef struct { ArenaMark mark; bool is_known; } MediaScope;
MediaScope media_open(const Surroundings *around);
void media_close(Surroundings *around, MediaScope scope);

/* What a hit does to a ray's list. */
typedef struct {
    const Medium *after;                 /* the list beyond the surface, should the ray pass it */
    bool was_inside;                     /* the ray came through the interior */
    double bend;                         /* k of Snell's law: ior before / ior behind; 1: the direction stays */
    double ior_ratio;                    /* for Fresnel's law: ior behind / ior before, as POV-Ray takes it */
} Crossing;
Crossing media_cross(Surroundings *around, const Medium *before, const Hit *h);

/* What is left of light after `depth` of an interior; 1 where it does not fade. */
bool interior_fades(const Interior *i);                       /* NULL is allowed */
Rgb interior_fade(const Interior *i, double depth);

bool media_let_fog_in(const Medium *list);                    /* no interior in it that is not hollow */

#endif
