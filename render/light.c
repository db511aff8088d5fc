/* How much light would reach a point if nothing stood in the way: direction, distance, fading, cones. */
#include "render/light.h"

Light light_default(LightKind kind)
{
    bool is_spot = kind == LIGHT_SPOT;
    return (Light){
        .kind = kind,
        .point_at = vec(0, 0, 1),
        .radius = is_spot ? 30 : .75, .falloff = is_spot ? 45 : 1,
        .area_n_u = 1, .area_n_v = 1, .area_adaptive = 100,
    };
}

static bool light_fades(const Light *l) { return l->fade_distance > 0 && l->fade_power > 0; }

bool light_is_plain(const Light *l)
{
    bool is_point = l->kind == LIGHT_POINT && !l->is_parallel && !l->is_area;
    return is_point && !l->is_shadowless && !light_fades(l) && !rgb_is_black(l->color);
}

/* 0 below a, 1 from b on, a cubic between them. */
static double smooth_step(double a, double b, double x)
{
    if (x < a) return 0;
    if (x >= b) return 1;
    double h = (x - a) / (b - a);
    return h * h * (3 - 2 * h);
}

static double spot_factor(const Light *l, Vec3 axis, Vec3 from_light)
{
    double m = vec_dot(vec_normalize(from_light), axis);
    if (m <= 0) return 0;
    if (l->is_parallel) return 1;   /* all that is before it: so it is in POV-Ray */
    double inner = cos(l->radius * (M_PI / 180)), outer = cos(l->falloff * (M_PI / 180));
    double factor = pow(m, l->tightness);
    return inner > 0 && m < inner ? factor * smooth_step(outer, inner, m) : factor;
}

static double cylinder_factor(const Light *l, Vec3 axis, Vec3 from_light)
{
    double along = vec_dot(from_light, axis);
    if (along <= 0) return 0;
    double off_axis = sqrt(fmax(0, vec_length2(from_light) - along * along));
    if (off_axis >= l->falloff) return 0;
    double q = 1 - off_axis / l->falloff, factor = pow(q, l->tightness);
    return l->radius > 0 && off_axis > l->radius ? factor * smooth_step(0, 1 - l->radius / l->falloff, q) : factor;
}

/* Of a light that has an axis: direction and distance along it, if it is parallel; returns how much of it gets there. */
static double along_axis(const Light *l, Vec3 apart, LightAt *at)
{
    Vec3 axis = vec_normalize(vec_sub(l->point_at, l->position));
    if (light_is_parallel(l)) {
        at->direction = vec_neg(axis);
        at->distance = -vec_dot(apart, axis);
    }
    if (l->kind == LIGHT_SPOT) return spot_factor(l, axis, vec_neg(apart));
    return l->kind == LIGHT_CYLINDER ? cylinder_factor(l, axis, vec_neg(apart)) : 1;
}

LightAt light_at_any(const Light *l, Vec3 position, Vec3 point)
{
    Vec3 apart = vec_sub(position, point);
    LightAt at = { vec_normalize(apart), vec_length(apart), l->color };
    double factor = l->kind == LIGHT_POINT && !l->is_parallel ? 1 : along_axis(l, apart, &at);
    if (light_fades(l))
        factor *= 2 / (1 + pow(fabs(at.distance) / l->fade_distance, l->fade_power));
    at.color = rgb_scale(at.color, factor);
    return at;
}
