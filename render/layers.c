/* POV-Ray's rules for layers: what each shines with, mirrors, and lets through to the next. */
#include "render/layers.h"

static double opacity_of(const Scene *s, Color c)
{
    double filter = c.filter;
    if (s->version < 3.7) filter *= rgb_max(color_rgb(c));
    return 1 - filter - (double)c.transmit;
}

static Rgb conserved(Rgb through, Rgb r)
{
    return rgb_mul(through, rgb(fmin(1, 1 - r.r), fmin(1, 1 - r.g), fmin(1, 1 - r.b)));
}

/* The ratio of the indices is only asked for by `fresnel`. */
static Rgb reflectivity(Surroundings *around, const Surface *at, const Medium *media, const Finish *f, Rgb pigment)
{
    if (!f->has_reflection) return rgb(0, 0, 0);
    double ratio = f->reflection_fresnel ? media_cross(around, media, at->hit).ior_ratio : 1;
    return finish_reflectivity(f, pigment, at->cos_view, ratio);
}

/* What a layer shines with by itself. */
static Rgb own_light(const Scene *s, const Finish *f) { return rgb_add(rgb_mul(f->ambient, s->ambient_light), f->emission); }

int layers_walk(Surroundings *around, const Surface *at, const Medium *media, LayerAt *out, Rgb *through)
{
    const Scene *s = around->scene;
    Rgb F = rgb(1, 1, 1);
    int n = 0;
    for (int i = at->texture->n_layers - 1; i >= 0 && layers_transmit(F) > s->adc_bailout; i--) {
        const Layer *layer = &at->texture->layers[i];
        const Finish *f = &layer->finish;
        Color c = surface_color(at, layer);
        Rgb pigment = color_rgb(c);
        Rgb r = reflectivity(around, at, media, f, pigment);
        out[n++] = (LayerAt){ f, pigment, F, opacity_of(s, c), r, own_light(s, f), rgb(0, 0, 0) };
        F = rgb_mul(F, rgb_add(rgb_scale(pigment, c.filter), rgb(c.transmit, c.transmit, c.transmit)));
        if (f->conserve_energy) F = conserved(F, r);
    }
    *through = F;
    return n;
}

Rgb layers_light(const LayerAt *layers, int n)
{
    Rgb sum = rgb(0, 0, 0);
    for (int i = 0; i < n; i++) {
        const LayerAt *l = &layers[i];
        Rgb light = rgb_add(rgb_mul(rgb_scale(l->pigment, l->opacity), l->diffuse), l->shine);
        sum = rgb_add(sum, rgb_mul(l->weight, light));
    }
    return sum;
}

/* ---- mirrors ---- */

/* With `fresnel` what it is here, else the most that it can be. */
static double mirror_weight(const LayerAt *l)
{
    const Finish *f = l->finish;
    if (!f->has_reflection) return 0;
    return f->reflection_fresnel ? rgb_max(l->reflectivity) : fmax(rgb_max(f->reflection_min), rgb_max(f->reflection_max));
}

double layers_mirror_weight(const LayerAt *layers, int n)
{
    double weight = 0;
    for (int i = 0; i < n; i++) weight = fmax(weight, mirror_weight(&layers[i]));
    return weight;
}

static Rgb by_exponent(Rgb c, double exponent)
{
    if (exponent == 1) return c;
    return rgb(pow(c.r, 1 / exponent), pow(c.g, 1 / exponent), pow(c.b, 1 / exponent));
}

Rgb layers_mirrored(const LayerAt *layers, int n, Rgb seen)
{
    Rgb sum = rgb(0, 0, 0);
    for (int i = 0; i < n; i++)
        sum = rgb_add(sum, rgb_mul(layers[i].reflectivity, by_exponent(seen, layers[i].finish->reflection_exponent)));
    return sum;
}
