/* Lights in order of the scene; each costs a shadow ray where it could shine, and none where nothing would answer it. */
#include "render/gather.h"

/* The lowest quality (+Q) at which each thing is done. */
enum { Q_SHADOWS = 4, Q_AREA_LIGHTS = 5 };

/* POV-Ray: a light this far round the horizon (cosine) gives nothing. */
static const double GRAZING_LIGHT = 1e-10;

static bool answers_light(const Gathering *g)
{
    for (int i = 0; i < g->n; i++) {
        const Finish *f = g->layers[i].finish;
        if (f->diffuse > 0 || f->diffuse_back > 0 || finish_shines(f)) return true;
    }
    return false;
}

static bool any_layer_from_behind(const Gathering *g)
{
    for (int i = 0; i < g->n; i++)
        if (g->layers[i].finish->diffuse_back > 0) return true;
    return false;
}

static bool is_double_illuminated(const Hit *h)
{
    for (int i = 0; i < h->n_objects; i++)
        if (h->objects[i]->double_illuminate) return true;
    return false;
}

/* Light of one colour from one direction, on all layers. */
static void gather_from(Gathering *g, const Light *l, const LightAt *lit)
{
    const Surface *at = g->shadow.at;
    double cosine = vec_dot(at->normal, lit->direction);
    bool is_facing = cosine >= GRAZING_LIGHT, is_back = !is_facing && !is_double_illuminated(at->hit);
    bool has_highlights = is_facing && !l->is_shadowless;
    for (int i = 0; i < g->n; i++) {
        LayerAt *on = &g->layers[i];
        const Finish *f = on->finish;
        on->diffuse = rgb_add(on->diffuse, rgb_scale(lit->color, finish_diffuse(f, cosine, is_back)));
        if (has_highlights && finish_shines(f))
            on->shine = rgb_add(on->shine, finish_highlights(f, on->pigment, at->normal, at->ray->dir, lit->direction,
                                                             lit->color));
    }
}

/* `area_illumination`: every sample shines for itself, all with the one shadow. */
static void gather_from_area(Gathering *g, const Light *l, Rgb shadow)
{
    Vec3 point = g->shadow.at->point;
    double share = 1. / ((double)l->area_n_u * l->area_n_v);
    for (int j = 0; j < l->area_n_v; j++)
        for (int i = 0; i < l->area_n_u; i++) {
            LightAt lit = light_at(l, shadow_area_sample(l, point, i, j), point);
            lit.color = rgb_scale(rgb_mul(lit.color, shadow), share);
            gather_from(g, l, &lit);
        }
}

static Rgb quotient(Rgb a, Rgb b)
{
    return rgb(b.r != 0 ? a.r / b.r : 0, b.g != 0 ? a.g / b.g : 0, b.b != 0 ? a.b / b.b : 0);
}

static bool is_lit_from_behind(const Gathering *g)
{
    return any_layer_from_behind(g) || is_double_illuminated(g->shadow.at->hit);
}

static void gather(Gathering *g, const Light *l, int quality)
{
    bool is_spread = !l->is_plain && l->is_area && l->area_illumination && quality >= Q_AREA_LIGHTS;
    LightAt lit = light_at(l, l->position, g->shadow.at->point);
    bool is_facing = vec_dot(g->shadow.at->normal, lit.direction) >= GRAZING_LIGHT;
    if (!is_facing && !is_spread && !is_lit_from_behind(g)) return;
    Rgb unblocked = lit.color;
    if (quality >= Q_SHADOWS && !shadow_light(&g->shadow, l, &lit)) return;
    if (is_spread) gather_from_area(g, l, quotient(lit.color, unblocked));
    else gather_from(g, l, &lit);
}

/* ---- neighbours ---- */

/* Surfaces in lanes; those that are not asked for repeat another. */
EVERY_X86
static void set_places(Gathering *const of[], Lanes lanes, SurfaceLanes *out, Vec3x8 *normal)
{
    int any = __builtin_ctz(lanes);
    const void *at[BUNCH_WIDTH];
    for (int i = 0; i < BUNCH_WIDTH; i++) at[i] = of[lanes >> i & 1 ? i : any]->shadow.at;
    out->point = vec8_gather(at, offsetof(Surface, point));
    out->geometric = vec8_gather(at, offsetof(Surface, geometric));
    out->offset = v8d_gather(at, offsetof(Surface, offset));
    *normal = vec8_gather(at, offsetof(Surface, normal));
}

/* The way to a plain light; the lanes of surfaces that face it. */
EVERY_X86
static Lanes face_light(const Light *l, const SurfaceLanes *at, const Vec3x8 *normal, Vec3x8 *direction)
{
    *direction = vec8_normalize(vec8_sub(vec8_splat(l->position), at->point));
    return v8l_mask(~v8d_less(vec8_dot(*normal, *direction), v8d_splat(GRAZING_LIGHT)));
}

/* A plain light, with shadows. */
static void gather_plain(Gathering *const of[], Lanes lanes, const RayBunch *seen_by, const SurfaceLanes *at,
                         const Vec3x8 *normal, const Light *l)
{
    Vec3x8 direction;
    Rgb color[BUNCH_WIDTH];
    Lanes facing = face_light(l, at, normal, &direction), asked = lanes & facing;
    for (Lanes turned = lanes & ~facing; turned; ) {
        int i = lanes_next(&turned);
        if (is_lit_from_behind(of[i])) asked |= 1u << i;
    }
    if (!asked) return;
    const Shadow *shadow[BUNCH_WIDTH];
    for (Lanes left = asked; left; ) {
        int i = lanes_next(&left);
        shadow[i] = &of[i]->shadow, color[i] = l->color;
    }
    for (Lanes arrives = shadow_light_bunch(shadow, asked, seen_by, at, l, &direction, color); arrives; ) {
        int i = lanes_next(&arrives);
        LightAt lit = { vec8_get(&direction, i), 0, color[i] };
        gather_from(of[i], l, &lit);
    }
}

static Lanes answering(Gathering *const of[], Lanes lanes, int quality)
{
    Lanes answer = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        of[i]->shadow.has_areas = quality >= Q_AREA_LIGHTS;
        if (answers_light(of[i])) answer |= 1u << i;
    }
    return answer;
}

void gather_light_bunch(Gathering *const of[], Lanes lanes, const RayBunch *seen_by, int quality)
{
    SurfaceLanes at;
    Vec3x8 normal;
    const Scene *s = of[__builtin_ctz(lanes)]->shadow.around->scene;
    lanes = answering(of, lanes, quality);
    if (!lanes) return;
    bool are_together = !lanes_are_few(lanes) && quality >= Q_SHADOWS;
    if (are_together) set_places(of, lanes, &at, &normal);
    for (size_t k = 0; k < s->n_lights; k++) {
        const Light *l = &s->lights[k];
        if (l->is_plain && are_together) {
            gather_plain(of, lanes, seen_by, &at, &normal, l);
            continue;
        }
        for (Lanes left = lanes; left; ) {
            int i = lanes_next(&left);
            Trace *t = of[i]->shadow.trace;
            bunch_begin(seen_by, i, t);
            gather(of[i], l, quality);
            bunch_end(seen_by, i, t);
        }
    }
}
