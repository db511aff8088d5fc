/* Cameras as POV-Ray 3.7 evaluates them: the vectors as written, then angle, look_at, the size of an orthographic view, and
 * the transformations last. Left-handed unless `right` is turned over. */
#include "render/camera.h"

/* What POV-Ray takes for parallel and for perpendicular: components of a cross product, and cosines, below this. Both are
 * compared for unit vectors, so that neither depends on the size of the scene. */
static const double CAMERA_PARALLEL = 1e-10;
static const double CAMERA_PERPENDICULAR = 1e-10;

CameraDesc camera_desc_default(void)
{
    return (CameraDesc){
        .kind = CAMERA_PERSPECTIVE,
        .direction = vec(0, 0, 1), .right = vec(1.33, 0, 0), .up = vec(0, 1, 0), .sky = vec(0, 1, 0),
        .look_at = vec(0, 0, 1),
        .xform = xform_identity(),
    };
}

static bool are_perpendicular(Vec3 a, Vec3 b)
{
    return fabs(vec_dot(vec_normalize(a), vec_normalize(b))) <= CAMERA_PERPENDICULAR;
}

static bool is_perpendicular(const Camera *c)
{
    return are_perpendicular(c->right, c->up) && are_perpendicular(c->up, c->direction)
        && are_perpendicular(c->direction, c->right);
}

/* The lengths of the vectors stay; sky says what is up, the handedness of the old vectors stays too. */
static CameraStatus look_at(const CameraDesc *desc, Camera *c)
{
    Vec3 to = vec_sub(desc->look_at, c->location);
    if (!(vec_max_abs(to) > 0)) return CAMERA_LOOKS_AT_ITSELF;
    bool is_left_handed = vec_dot(vec_cross(c->up, c->direction), c->right) > 0;
    CameraStatus status = CAMERA_OK;
    Vec3 d = vec_normalize(to);
    Vec3 r = vec_cross(vec_normalize(desc->sky), d);
    if (vec_max_abs(r) < CAMERA_PARALLEL) {
        r = c->right;
        status = CAMERA_SKY_ALONG_DIRECTION;
    }
    r = vec_normalize(r);
    c->up = vec_scale(vec_cross(d, r), vec_length(c->up));
    c->direction = vec_scale(d, vec_length(c->direction));
    c->right = vec_scale(r, is_left_handed ? vec_length(c->right) : -vec_length(c->right));
    return status;
}

/* Without vectors of its own, or with an angle, an orthographic camera shows what a perspective one would at look_at. */
static void size_orthographic_view(const CameraDesc *desc, Camera *c)
{
    if (desc->has_right_or_up && !desc->has_angle) return;
    double by = vec_length(vec_sub(desc->look_at, c->location)) / vec_length(c->direction);
    c->right = vec_scale(c->right, by);
    c->up = vec_scale(c->up, by);
}

CameraStatus camera_make(const CameraDesc *desc, Camera *out)
{
    Camera c = { desc->kind, desc->location, desc->direction, desc->right, desc->up };
    CameraStatus status = CAMERA_OK;
    if (desc->has_angle && desc->angle < 0) return CAMERA_ANGLE_NEGATIVE;
    if (desc->has_angle && desc->angle >= 180) return CAMERA_ANGLE_TOO_LARGE;
    if (desc->has_angle && desc->angle > 0) {
        double length = vec_length(c.right) / (2 * tan(desc->angle * (M_PI / 360)));
        c.direction = vec_scale(vec_normalize(c.direction), length);
    }
    if (desc->has_look_at) {
        status = look_at(desc, &c);
        if (status == CAMERA_LOOKS_AT_ITSELF) return status;
    } else if (!is_perpendicular(&c)) {
        status = CAMERA_NOT_PERPENDICULAR;
    }
    if (c.kind == CAMERA_ORTHOGRAPHIC) size_orthographic_view(desc, &c);
    out->kind = c.kind;
    out->location = xform_point(&desc->xform, c.location);
    out->direction = xform_vector(&desc->xform, c.direction);
    out->right = xform_vector(&desc->xform, c.right);
    out->up = xform_vector(&desc->xform, c.up);
    return status;
}

Ray camera_ray(const Camera *c, double x, double y, int w, int h)
{
    double u = (x + .5) / w - .5, v = .5 - (y + .5) / h;
    Vec3 across = vec_add(vec_scale(c->right, u), vec_scale(c->up, v));
    if (c->kind == CAMERA_ORTHOGRAPHIC)
        return (Ray){ vec_add(c->location, across), vec_normalize(c->direction), 0 };
    return (Ray){ c->location, vec_normalize(vec_add(c->direction, across)), 0 };
}

EVERY_X86
void camera_rays(const Camera *c, const Vec2 at[], int n, int w, int h, RayBunch *out)
{
    const void *place[BUNCH_WIDTH];
    for (int i = 0; i < BUNCH_WIDTH; i++) place[i] = &at[int_min(i, n - 1)];
    V8d x = v8d_gather(place, offsetof(Vec2, x)), y = v8d_gather(place, offsetof(Vec2, y));
    V8d u = (x + .5) / w - .5, v = .5 - (y + .5) / h;
    Vec3x8 across = vec8_add(vec8_scale(vec8_splat(c->right), u), vec8_scale(vec8_splat(c->up), v));
    Vec3x8 location = vec8_splat(c->location), direction = vec8_splat(c->direction);
    bool is_orthographic = c->kind == CAMERA_ORTHOGRAPHIC;
    out->n = n;
    out->origin = is_orthographic ? vec8_add(location, across) : location;
    out->dir = vec8_normalize(is_orthographic ? direction : vec8_add(direction, across));
    out->t_min = v8d_splat(0);
    bunch_set_rays(out);
}
