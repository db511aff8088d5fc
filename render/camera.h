/* Cameras: POV-Ray's rules of evaluation and primary rays. */
#ifndef TRIMRAY_CAMERA_H
#define TRIMRAY_CAMERA_H

#include "render/bunch.h"
#include "render/xform.h"

#include <stdbool.h>

typedef enum { CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC } CameraKind;

/* As written in the scene, in any order. */
typedef struct {
    CameraKind kind;
    Vec3 location, direction, right, up, sky, look_at;
    bool has_look_at, has_angle, has_right_or_up;
    double angle;                           /* degrees; 0: a bare `angle` */
    Xform xform;                            /* all transformations, in order */
} CameraDesc;

/* As used: the ray through a pixel needs only these. */
typedef struct { CameraKind kind; Vec3 location, direction, right, up; } Camera;

typedef enum {
    CAMERA_OK,
    CAMERA_ANGLE_TOO_LARGE,                 /* angle >= 180 */
    CAMERA_ANGLE_NEGATIVE,
    CAMERA_LOOKS_AT_ITSELF,                 /* look_at equals location */
    CAMERA_SKY_ALONG_DIRECTION,             /* a warning: the old right vector is kept */
    CAMERA_NOT_PERPENDICULAR                /* a warning */
} CameraStatus;

CameraDesc camera_desc_default(void);       /* location 0, direction z, up y, right 1.33 x, sky y */
CameraStatus camera_make(const CameraDesc *desc, Camera *out);

/* The ray through (x, y) of a w by h image: pixel centres are at integers, (0, 0) is the top left pixel. dir is unit,
 * t_min 0. */
Ray camera_ray(const Camera *c, double x, double y, int w, int h);

/* The same for n of them, 1 to BUNCH_WIDTH: sets all of the bunch but its `lane`. */
void camera_rays(const Camera *c, const Vec2 at[], int n, int w, int h, RayBunch *out);

#endif
