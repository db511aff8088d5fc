/* Whitted's recursion ([Whi80]) with POV-Ray's rules: the layers of a texture from the top down, each with its own light;
 * what shines through the last one; what each layer mirrors. */
#include "render/shade.h"

#include "render/finish.h"
#include "render/media.h"
#include "render/shadow.h"
#include "render/sky.h"
#include "render/surface.h"

/* The lowest quality (+Q) at which each thing is done. */
enum { Q_LIGHT = 2, Q_SHADOWS = 4, Q_AREA_LIGHTS = 5, Q_TRANSMISSION = 6, Q_REFLECTION = 8, Q_FOG = 9 };

/* POV-Ray: a light this far round the horizon (cosine) gives nothing; directions this near are not bent (|k - 1|). */
static const double GRAZING_LIGHT = 1e-10;
static const double NO_BEND = 1e-10;

/* Everything that the rays of one camera ray share. */
typedef struct {
    const Scene *scene;
    Trace *trace;
    int quality;
    Surroundings around;
    Apex camera;                 /* where camera rays begin */
} Tracer;

/* How a ray came about. */
typedef struct {
    int level;
    bool is_straight;            /* it went on through a surface, without a level of its own */
    double weight;               /* an upper bound of what it adds to the pixel, for adc_bailout */
    RayKind kind;                /* what just happened to it: for the counters */
    bool was_reflected;          /* ever: what objects hide from */
    const Medium *media;
} Path;

typedef struct {
    const Finish *finish;
    Rgb pigment;
    Rgb weight;                  /* of its light: what the layers above let through */
    double opacity;
    Rgb reflectivity;
    Rgb diffuse, shine;          /* gathered light: what the pigment scatters, what it does not colour */
} LayerAt;

enum { FEW_LAYERS = 2 };         /* so many are seen without asking for memory */

static Pixel trace_ray(Tracer *x, Ray *r, const Path *path);

static Rgb pixel_rgb(Pixel p) { return rgb(p.r, p.g, p.b); }

/* ---- light on a surface ---- */

static bool answers_light(const LayerAt *layers, int n)
{
    for (int i = 0; i < n; i++) {
        const Finish *f = layers[i].finish;
        if (f->diffuse > 0 || f->diffuse_back > 0 || finish_shines(f)) return true;
    }
    return false;
}

static bool any_lit_from_behind(const LayerAt *layers, int n)
{
    for (int i = 0; i < n; i++)
        if (layers[i].finish->diffuse_back > 0) return true;
    return false;
}

static bool is_double_illuminated(const Hit *h)
{
    for (int i = 0; i < h->n_objects; i++)
        if (h->objects[i]->double_illuminate) return true;
    return false;
}

/* Light of one colour from one direction, on all layers. */
static void gather_from(const Surface *at, LayerAt *layers, int n, const Light *l, const LightAt *lit)
{
    double cosine = vec_dot(at->normal, lit->direction);
    bool is_facing = cosine >= GRAZING_LIGHT, is_back = !is_facing && !is_double_illuminated(at->hit);
    bool has_highlights = is_facing && !l->is_shadowless;
    for (int i = 0; i < n; i++) {
        LayerAt *on = &layers[i];
        const Finish *f = on->finish;
        on->diffuse = rgb_add(on->diffuse, rgb_scale(lit->color, finish_diffuse(f, cosine, is_back)));
        if (has_highlights && finish_shines(f))
            on->shine = rgb_add(on->shine, finish_highlights(f, on->pigment, at->normal, at->ray->dir, lit->direction,
                                                             lit->color));
    }
}

/* `area_illumination`: every sample shines for itself, all with the one shadow. */
static void gather_from_area(const Surface *at, LayerAt *layers, int n, const Light *l, Rgb shadow)
{
    double share = 1. / ((double)l->area_n_u * l->area_n_v);
    for (int j = 0; j < l->area_n_v; j++)
        for (int i = 0; i < l->area_n_u; i++) {
            LightAt lit = light_at(l, shadow_area_sample(l, at->point, i, j), at->point);
            lit.color = rgb_scale(rgb_mul(lit.color, shadow), share);
            gather_from(at, layers, n, l, &lit);
        }
}

static Rgb quotient(Rgb a, Rgb b)
{
    return rgb(b.r != 0 ? a.r / b.r : 0, b.g != 0 ? a.g / b.g : 0, b.b != 0 ? a.b / b.b : 0);
}

static void gather(const Shadow *shadow, LayerAt *layers, int n, const Light *l, int quality)
{
    const Surface *at = shadow->at;
    bool is_spread = !l->is_plain && l->is_area && l->area_illumination && quality >= Q_AREA_LIGHTS;
    LightAt lit = light_at(l, l->position, at->point);
    bool is_facing = vec_dot(at->normal, lit.direction) >= GRAZING_LIGHT;
    if (!is_facing && !is_spread && !any_lit_from_behind(layers, n) && !is_double_illuminated(at->hit)) return;
    Rgb unblocked = lit.color;
    if (quality >= Q_SHADOWS && !shadow_light(shadow, l, &lit)) return;
    if (is_spread) gather_from_area(at, layers, n, l, quotient(lit.color, unblocked));
    else gather_from(at, layers, n, l, &lit);
}

static void gather_from_all(Tracer *x, const Surface *at, LayerAt *layers, int n, const Path *path)
{
    if (!answers_light(layers, n)) return;
    Shadow shadow = { at, path->media, &x->around, x->quality >= Q_AREA_LIGHTS, path->kind == RAY_CAMERA, x->trace };
    for (size_t i = 0; i < x->scene->n_lights; i++) gather(&shadow, layers, n, &x->scene->lights[i], x->quality);
}

static Rgb gathered(const LayerAt *layers, int n)
{
    Rgb sum = rgb(0, 0, 0);
    for (int i = 0; i < n; i++) {
        const LayerAt *l = &layers[i];
        Rgb light = rgb_add(rgb_mul(rgb_scale(l->pigment, l->opacity), l->diffuse), l->shine);
        sum = rgb_add(sum, rgb_mul(l->weight, light));
    }
    return sum;
}

/* ---- layers ---- */

static double opacity_of(const Scene *s, Color c)
{
    double filter = c.filter;
    if (s->version < 3.7) filter *= rgb_max(color_rgb(c));
    return 1 - filter - (double)c.transmit;
}

static double transmit_of(Rgb through) { return double_min(fabs(rgb_grey(through)), 1); }

static Rgb conserved(Rgb through, Rgb r)
{
    return rgb_mul(through, rgb(fmin(1, 1 - r.r), fmin(1, 1 - r.g), fmin(1, 1 - r.b)));
}

/* The ratio of the indices is only asked for by `fresnel`. */
static Rgb reflectivity(Tracer *x, const Surface *at, const Medium *media, const Finish *f, Rgb pigment)
{
    if (!f->has_reflection) return rgb(0, 0, 0);
    double ratio = f->reflection_fresnel ? media_cross(&x->around, media, at->hit).ior_ratio : 1;
    return finish_reflectivity(f, pigment, at->cos_view, ratio);
}

/* What a layer shines with by itself. */
static Rgb own_light(const Scene *s, const Finish *f) { return rgb_add(rgb_mul(f->ambient, s->ambient_light), f->emission); }

/* Walks the layers from the top down for as long as anything comes through; returns how many were seen. */
static int walk_layers(Tracer *x, const Surface *at, const Medium *media, LayerAt *out, Rgb *through)
{
    const Scene *s = x->scene;
    Rgb F = rgb(1, 1, 1);
    int n = 0;
    for (int i = at->texture->n_layers - 1; i >= 0 && transmit_of(F) > s->adc_bailout; i--) {
        const Layer *layer = &at->texture->layers[i];
        const Finish *f = &layer->finish;
        Color c = surface_color(at, layer);
        Rgb pigment = color_rgb(c);
        Rgb r = reflectivity(x, at, media, f, pigment);
        out[n++] = (LayerAt){ f, pigment, F, opacity_of(s, c), r, own_light(s, f), rgb(0, 0, 0) };
        F = rgb_mul(F, rgb_add(rgb_scale(pigment, c.filter), rgb(c.transmit, c.transmit, c.transmit)));
        if (f->conserve_energy) F = conserved(F, r);
    }
    *through = F;
    return n;
}

/* ---- secondary rays ---- */

static Vec3 mirrored(const Surface *at)
{
    return vec_normalize(vec_add(at->ray->dir, vec_scale(at->normal, 2 * at->cos_view)));
}

static Pixel trace_from(Tracer *x, const Surface *at, Vec3 dir, const Path *path)
{
    Ray r = { surface_leave(at, dir), dir, 0 };
    return trace_ray(x, &r, path);
}

static Pixel trace_mirrored(Tracer *x, const Surface *at, const Path *from, double weight)
{
    Path path = { from->level + 1, false, from->weight * weight, RAY_REFLECTED, true, from->media };
    MediaScope scope = media_open(&x->around);
    Pixel seen = trace_from(x, at, mirrored(at), &path);
    media_close(&x->around, scope);
    seen.transmit = 0;
    return seen;
}

/* The ray beyond the surface; or, *is_total, totally reflected. */
static Pixel trace_bent(Tracer *x, const Surface *at, const Path *from, const Crossing *cross, double weight, bool *is_total)
{
    double k = cross->bend, c = at->cos_view, s = 1 + k * k * (c * c - 1);
    bool is_straight = fabs(k - 1) < NO_BEND;
    *is_total = !is_straight && s < 0;
    if (*is_total) return trace_mirrored(x, at, from, weight);
    Vec3 dir = at->ray->dir;
    if (!is_straight) dir = vec_normalize(vec_add(vec_scale(dir, k), vec_scale(at->normal, k * c - sqrt(s))));
    Path path = { from->level + !is_straight, is_straight, from->weight * weight, RAY_TRANSMITTED, from->was_reflected,
                  cross->after };
    return trace_from(x, at, dir, &path);
}

/* What comes through, faded by the way up to here if that led through the interior. */
static Pixel trace_through(Tracer *x, const Surface *at, const Path *from, Rgb through, bool *is_total)
{
    MediaScope scope = media_open(&x->around);
    Crossing cross = media_cross(&x->around, from->media, at->hit);
    Pixel seen = trace_bent(x, at, from, &cross, fmax(rgb_max(through), 0), is_total);
    media_close(&x->around, scope);
    if (!cross.was_inside) return seen;
    Rgb fade = interior_fade(hit_interior(at->hit), at->hit->t);
    return (Pixel){ seen.r * fade.r, seen.g * fade.g, seen.b * fade.b, seen.transmit * rgb_grey(fade) };
}

static Rgb by_exponent(Rgb c, double exponent)
{
    if (exponent == 1) return c;
    return rgb(pow(c.r, 1 / exponent), pow(c.g, 1 / exponent), pow(c.b, 1 / exponent));
}

/* For adc_bailout: with `fresnel` what it is here, else the most that it can be. */
static double mirror_weight(const LayerAt *l)
{
    const Finish *f = l->finish;
    if (!f->has_reflection) return 0;
    return f->reflection_fresnel ? rgb_max(l->reflectivity) : fmax(rgb_max(f->reflection_min), rgb_max(f->reflection_max));
}

/* What all layers mirror, by one ray. */
static Rgb reflections(Tracer *x, const Surface *at, const LayerAt *layers, int n, const Path *path)
{
    double weight = 0;
    for (int i = 0; i < n; i++) weight = fmax(weight, mirror_weight(&layers[i]));
    Rgb sum = rgb(0, 0, 0);
    if (weight == 0) return sum;
    Rgb seen = pixel_rgb(trace_mirrored(x, at, path, weight));
    for (int i = 0; i < n; i++)
        sum = rgb_add(sum, rgb_mul(layers[i].reflectivity, by_exponent(seen, layers[i].finish->reflection_exponent)));
    return sum;
}

/* ---- the recursion ---- */

/* Without light (+Q0, +Q1) there is the top layer's pigment alone. */
static Pixel flat_color(const Surface *at)
{
    Color c = surface_color(at, &at->texture->layers[at->texture->n_layers - 1]);
    return (Pixel){ c.r, c.g, c.b, 0 };
}

static Pixel shade_map(Tracer *x, const Surface *at, const Path *path);

static Pixel shade_texture(Tracer *x, const Surface *at, const Path *path)
{
    if (at->texture->map) return shade_map(x, at, path);
    if (at->texture->n_layers == 0) return (Pixel){ 0 };
    if (x->quality < Q_LIGHT) return flat_color(at);
    Rgb through;
    LayerAt few[FEW_LAYERS], *layers = few;
    if (at->texture->n_layers > FEW_LAYERS) layers = ARENA_ARRAY(x->trace->scratch, LayerAt, at->texture->n_layers);
    int n = walk_layers(x, at, path->media, layers, &through);
    gather_from_all(x, at, layers, n, path);
    Rgb sum = gathered(layers, n);
    if (!x->scene->needs_secondary_rays) return (Pixel){ sum.r, sum.g, sum.b, 0 };
    Pixel behind = { 0 };
    double transmit = transmit_of(through);
    bool is_total = false;
    if (x->quality >= Q_TRANSMISSION && transmit > x->scene->adc_bailout) {
        behind = trace_through(x, at, path, through, &is_total);
        sum = rgb_add(sum, is_total ? pixel_rgb(behind) : rgb_mul(pixel_rgb(behind), through));
    }
    if (x->quality >= Q_REFLECTION && !is_total) sum = rgb_add(sum, reflections(x, at, layers, n, path));
    return (Pixel){ sum.r, sum.g, sum.b, is_total ? 0 : behind.transmit * transmit };
}

/* Between two entries of its map a texture is both of them, each lit, mirroring and letting through for itself. */
static Pixel shade_map(Tracer *x, const Surface *at, const Path *path)
{
    TextureChoice choices[2];
    Pixel sum = { 0 };
    int n = texture_choose(at->texture->map, at->texture_point, choices);
    for (int i = 0; i < n; i++) {
        Surface part = surface_with(at, &choices[i]);
        Pixel seen = shade_texture(x, &part, path);
        double share = choices[i].share;
        sum = (Pixel){ sum.r + share * seen.r, sum.g + share * seen.g, sum.b + share * seen.b,
                       sum.transmit + share * seen.transmit };
    }
    return sum;
}

static Pixel shade_hit(Tracer *x, const Ray *r, const Hit *h, const Path *path)
{
    Surface at;
    surface_at(x->scene, r, h, &at);
    return shade_texture(x, &at, path);
}

static bool hit_of_camera(Tracer *x, const Ray *r, Hit *h)
{
    bool has_apex = x->trace->pencils && x->scene->camera.kind == CAMERA_PERSPECTIVE;
    x->trace->apex = has_apex ? &x->camera : NULL;
    bool is_hit = scene_hit(x->scene, r, RAY_CAMERA, h, x->trace);
    x->trace->apex = NULL;
    return is_hit;
}

/* The nearest hit. What lies nearer than its own error may be the surface that the ray has just left: the next counts. */
static bool nearest_hit(Tracer *x, Ray *r, const Path *path, Hit *h)
{
    if (path->kind == RAY_CAMERA) return hit_of_camera(x, r, h);
    for (;;) {
        if (!scene_hit(x->scene, r, path->was_reflected ? RAY_REFLECTED : RAY_CAMERA, h, x->trace)) return false;
        if (!(h->t <= h->t_error)) return true;
        r->t_min = h->t;
    }
}

static void count_ray(Counters *c, RayKind kind)
{
    if (kind == RAY_CAMERA) c->camera_rays++;
    if (kind == RAY_REFLECTED) c->reflected_rays++;
    if (kind == RAY_TRANSMITTED) c->transmitted_rays++;
}

/* Moves r's beginning past the surface that it has left.
 *
 * POV-Ray does not count a ray that goes straight on as a level, but does not let it begin at the last one either. */
static Pixel trace_ray(Tracer *x, Ray *r, const Path *path)
{
    const Scene *s = x->scene;
    if (path->level + path->is_straight >= s->max_trace_level || path->weight < s->adc_bailout) return (Pixel){ 0 };
    count_ray(&x->trace->counters, path->kind);
    Hit h;
    bool is_hit = nearest_hit(x, r, path, &h);
    Pixel seen = is_hit ? shade_hit(x, r, &h, path) : sky_color(s, r->dir);
    bool has_fog = s->n_fogs > 0 && x->quality >= Q_FOG && media_let_fog_in(media_known(&x->around, path->media));
    return has_fog ? sky_through_fog(s, r, h.t, seen) : seen;
}

Pixel shade_camera_ray(const Scene *s, Ray *r, int quality, Trace *t)
{
    ArenaMark mark = arena_mark(t->scratch);
    Tracer x = { s, t, quality, { .scene = s, .scratch = t->scratch, .camera = r->origin }, apex_make(r->origin) };
    Path path = { 0, false, 1, RAY_CAMERA, false, MEDIA_OF_CAMERA };
    Pixel seen = trace_ray(&x, r, &path);
    arena_reset(t->scratch, mark);
    return seen;
}
