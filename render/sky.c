/* Sky spheres over a background, and both kinds of fog. */
#include "render/sky.h"

Pixel sky_color(const Scene *s, Vec3 unit_dir)
{
    Rgb sum = rgb(0, 0, 0), through = rgb(1, 1, 1);
    if (s->sky) {
        Vec3 dir = xform_unvector(&s->sky->space, unit_dir);
        for (int i = s->sky->n_pigments - 1; i >= 0; i--) {
            Color c = pigment_color(s->sky->pigments[i], dir, vec2(0, 0));
            Rgb light = rgb_scale(color_rgb(c), 1 - (double)c.filter - (double)c.transmit);
            sum = rgb_add(sum, rgb_mul(light, through));
            Rgb clear = rgb(c.r * c.filter + c.transmit, c.g * c.filter + c.transmit, c.b * c.filter + c.transmit);
            through = rgb_mul(through, clear);
        }
    }
    Rgb behind = rgb_scale(color_rgb(s->background), 1 - (double)s->background.transmit);
    sum = rgb_add(sum, rgb_mul(behind, through));
    return (Pixel){ sum.r, sum.g, sum.b, rgb_grey(through) * s->background.transmit };
}

/* Ground fog thins out above its offset as 1 / (h^2 + 1) and is constant below: an antiderivative of that. */
static double fog_below(double h) { return h > 0 ? atan(h) : h; }

/* y: along the fog's `up`. */
static double ground_fog_share(const Fog *f, double y1, double y2)
{
    double h1 = (y1 - f->offset) / f->altitude, h2 = (y2 - f->offset) / f->altitude;
    double rise = h2 - h1;
    if (rise != 0) return (fog_below(h2) - fog_below(h1)) / rise;
    return h1 > 0 ? 1 / (h1 * h1 + 1) : 1;
}

/* Several fogs do not dim each other: their light is added, as POV-Ray does. */
Pixel sky_through_fog(const Scene *s, const Ray *r, double t, Pixel seen)
{
    static const double SKY_DISTANCE = 2e10;   /* where POV-Ray has the sky for its fog */
    double distance = isinf(t) ? SKY_DISTANCE : t * vec_length(r->dir);
    Vec3 dir = vec_normalize(r->dir);
    Rgb sum = rgb(0, 0, 0), through = rgb(1, 1, 1);
    for (size_t i = 0; i < s->n_fogs; i++) {
        const Fog *f = &s->fogs[i];
        double y1 = vec_dot(f->up, r->origin), y2 = y1 + distance * vec_dot(f->up, dir);
        double depth = f->type == 2 ? distance * ground_fog_share(f, y1, y2) : distance;
        double a = fmax(exp(-depth / f->distance), f->color.transmit), filter = a * f->color.filter;
        Rgb fog = color_rgb(f->color);
        sum = rgb_add(sum, rgb_scale(fog, 1 - a));
        through = rgb_mul(through, rgb_add(rgb_scale(fog, filter), rgb(a - filter, a - filter, a - filter)));
        seen.transmit *= a;
    }
    sum = rgb_add(sum, rgb_mul(through, rgb(seen.r, seen.g, seen.b)));
    return (Pixel){ sum.r, sum.g, sum.b, seen.transmit };
}
