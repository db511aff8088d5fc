/* Whitted's recursion ([Whi80]) with POV-Ray's rules: the layers of a texture from the top down, each with its own light;
 * what shines through the last one; what each layer mirrors. */
#include "render/shade.h"

#include "render/gather.h"
#include "render/sky.h"

/* The lowest quality (+Q) at which each thing is done; more is in gather.c. */
enum { Q_LIGHT = 2, Q_TRANSMISSION = 6, Q_REFLECTION = 8, Q_FOG = 9 };

/* POV-Ray: directions this near are not bent (|k - 1|). */
static const double NO_BEND = 1e-10;

/* Everything that the rays of one camera ray share. */
typedef struct {
    const Scene *scene;
    Trace *trace;
    int quality;
    Surroundings around;
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

enum { FEW_LAYERS = 2 };         /* so many are seen without asking for memory */

/* The layers of a texture at a surface, between their being walked and the light on them being gathered. */
typedef struct {
    Tracer *tracer;
    const Path *path;
    Rgb through;                 /* what is left for what lies behind them all */
    Gathering light;
    LayerAt few[FEW_LAYERS];
} Shading;

static Pixel trace_ray(Tracer *x, Ray *r, const Path *path);

static Rgb pixel_rgb(Pixel p) { return rgb(p.r, p.g, p.b); }

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

/* at->texture has layers, and light is wanted. */
static void walk_texture(Shading *k, Tracer *x, const Surface *at, const Path *path)
{
    int n = at->texture->n_layers;
    k->tracer = x, k->path = path;
    k->light.layers = n > FEW_LAYERS ? ARENA_ARRAY(x->trace->scratch, LayerAt, n) : k->few;
    k->light.n = walk_layers(x, at, path->media, k->light.layers, &k->through);
    k->light.shadow = (Shadow){ at, path->media, &x->around, false, path->kind == RAY_CAMERA, x->trace };
}

/* What is seen, once light has been gathered. */
static Pixel finish_texture(Shading *k)
{
    Tracer *x = k->tracer;
    const Surface *at = k->light.shadow.at;
    Rgb sum = gathered_light(&k->light);
    if (!x->scene->needs_secondary_rays) return (Pixel){ sum.r, sum.g, sum.b, 0 };
    Pixel behind = { 0 };
    double transmit = transmit_of(k->through);
    bool is_total = false;
    if (x->quality >= Q_TRANSMISSION && transmit > x->scene->adc_bailout) {
        behind = trace_through(x, at, k->path, k->through, &is_total);
        sum = rgb_add(sum, is_total ? pixel_rgb(behind) : rgb_mul(pixel_rgb(behind), k->through));
    }
    if (x->quality >= Q_REFLECTION && !is_total)
        sum = rgb_add(sum, reflections(x, at, k->light.layers, k->light.n, k->path));
    return (Pixel){ sum.r, sum.g, sum.b, is_total ? 0 : behind.transmit * transmit };
}

static Pixel shade_map(Tracer *x, const Surface *at, const Path *path);

/* Is light all that its look depends on, for now? */
static bool is_lit(const Tracer *x, const Surface *at)
{
    return !at->texture->map && at->texture->n_layers > 0 && x->quality >= Q_LIGHT;
}

static Pixel shade_unlit(Tracer *x, const Surface *at, const Path *path)
{
    if (at->texture->map) return shade_map(x, at, path);
    return at->texture->n_layers == 0 ? (Pixel){ 0 } : flat_color(at);
}

static Pixel shade_texture(Tracer *x, const Surface *at, const Path *path)
{
    if (!is_lit(x, at)) return shade_unlit(x, at, path);
    Shading k;
    walk_texture(&k, x, at, path);
    gather_light(&k.light, x->quality);
    return finish_texture(&k);
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

/* The nearest hit. What lies nearer than its own error may be the surface that the ray has just left: the next counts. */
static bool nearest_hit(Tracer *x, Ray *r, const Path *path, Hit *h)
{
    for (;;) {
        if (!scene_hit(x->scene, r, path->was_reflected ? RAY_REFLECTED : RAY_CAMERA, h, x->trace)) return false;
        if (!(h->t <= h->t_error)) return true;
        r->t_min = h->t;
    }
}

static void count_ray(Counters *c, RayKind kind)
{
    if (kind == RAY_REFLECTED) c->reflected_rays++;
    if (kind == RAY_TRANSMITTED) c->transmitted_rays++;
}

static Pixel through_fog(Tracer *x, const Ray *r, double t, const Path *path, Pixel seen)
{
    const Scene *s = x->scene;
    bool has_fog = s->n_fogs > 0 && x->quality >= Q_FOG && media_let_fog_in(media_known(&x->around, path->media));
    return has_fog ? sky_through_fog(s, r, t, seen) : seen;
}

/* Of a secondary ray. Moves r's beginning past the surface that it has left.
 *
 * POV-Ray does not count a ray that goes straight on as a level, but does not let it begin at the last one either. */
static Pixel trace_ray(Tracer *x, Ray *r, const Path *path)
{
    const Scene *s = x->scene;
    if (path->level + path->is_straight >= s->max_trace_level || path->weight < s->adc_bailout) return (Pixel){ 0 };
    count_ray(&x->trace->counters, path->kind);
    Hit h;
    bool is_hit = nearest_hit(x, r, path, &h);
    return through_fog(x, r, h.t, path, is_hit ? shade_hit(x, r, &h, path) : sky_color(s, r->dir));
}

/* ---- camera rays ---- */

static const Path FROM_CAMERA = { .weight = 1, .kind = RAY_CAMERA, .media = MEDIA_OF_CAMERA };

/* Neighbouring camera rays, and what is found of each on the way. */
typedef struct {
    RayBunch *rays;
    Tracer tracer[BUNCH_WIDTH];
    Hit hit[BUNCH_WIDTH];
    Surface at[BUNCH_WIDTH];
    Shading shading[BUNCH_WIDTH];
} CameraBunch;

static Lanes hit_of_camera(const Scene *s, CameraBunch *k, Trace *t)
{
    Apex camera = apex_make(k->rays->ray[0].origin);
    t->apex = t->pencils && s->camera.kind == CAMERA_PERSPECTIVE ? &camera : NULL;
    Lanes hit = scene_hit_bunch(s, k->rays, RAY_CAMERA, k->hit, t);
    t->apex = NULL;
    return hit;
}

/* What can be seen without light is; the lanes that wait for it. */
static Lanes look_at_surfaces(CameraBunch *k, Lanes hit, Pixel out[])
{
    Lanes lit = 0;
    for (int i = 0; i < k->rays->n; i++) {
        Tracer *x = &k->tracer[i];
        const Ray *r = &k->rays->ray[i];
        if (!(hit >> i & 1)) {
            out[i] = sky_color(x->scene, r->dir);
            continue;
        }
        surface_at(x->scene, r, &k->hit[i], &k->at[i]);
        if (is_lit(x, &k->at[i])) {
            walk_texture(&k->shading[i], x, &k->at[i], &FROM_CAMERA);
            lit |= 1u << i;
        } else {
            bunch_begin(k->rays, i, x->trace);
            out[i] = shade_unlit(x, &k->at[i], &FROM_CAMERA);
            bunch_end(k->rays, i, x->trace);
        }
    }
    return lit;
}

static void shade_lit(CameraBunch *k, Lanes lit, Pixel out[])
{
    bool traces = k->tracer[0].scene->needs_secondary_rays;
    Gathering *of[BUNCH_WIDTH];
    for (int i = 0; i < k->rays->n; i++) of[i] = &k->shading[i].light;
    gather_light_bunch(of, lit, k->rays, k->tracer[0].quality);
    while (lit) {
        int i = lanes_next(&lit);
        if (traces) bunch_begin(k->rays, i, k->tracer[i].trace);
        out[i] = finish_texture(&k->shading[i]);
        if (traces) bunch_end(k->rays, i, k->tracer[i].trace);
    }
}

void shade_camera_rays(const Scene *s, RayBunch *rays, int quality, Trace *t, Pixel out[])
{
    int n = rays->n;
    if (s->max_trace_level <= 0 || s->adc_bailout > FROM_CAMERA.weight) {
        for (int i = 0; i < n; i++) out[i] = (Pixel){ 0 };
        return;
    }
    ArenaMark mark = arena_mark(t->scratch);
    CameraBunch k;
    k.rays = rays;
    for (int i = 0; i < n; i++)
        k.tracer[i] = (Tracer){ s, t, quality, { .scene = s, .scratch = t->scratch, .camera = rays->ray[i].origin } };
    t->counters.camera_rays += (uint64_t)n;
    Lanes lit = look_at_surfaces(&k, hit_of_camera(s, &k, t), out);
    if (lit) shade_lit(&k, lit, out);
    for (int i = 0; i < n; i++) out[i] = through_fog(&k.tracer[i], &rays->ray[i], k.hit[i].t, &FROM_CAMERA, out[i]);
    arena_reset(t->scratch, mark);
}
