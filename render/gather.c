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

static bool any_lit_from_behind(const Gathering *g)
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

/* May it shine on the surface, from the direction that light_at says, if nothing is in its way? */
static bool may_light(const Gathering *g, const LightAt *lit)
{
    const Surface *at = g->shadow.at;
    bool is_facing = vec_dot(at->normal, lit->direction) >= GRAZING_LIGHT;
    return is_facing || any_lit_from_behind(g) || is_double_illuminated(at->hit);
}

static void gather(Gathering *g, const Light *l, int quality)
{
    bool is_spread = !l->is_plain && l->is_area && l->area_illumination && quality >= Q_AREA_LIGHTS;
    LightAt lit = light_at(l, l->position, g->shadow.at->point);
    if (!is_spread && !may_light(g, &lit)) return;
    Rgb unblocked = lit.color;
    if (quality >= Q_SHADOWS && !shadow_light(&g->shadow, l, &lit)) return;
    if (is_spread) gather_from_area(g, l, quotient(lit.color, unblocked));
    else gather_from(g, l, &lit);
}

void gather_light(Gathering *g, int quality)
{
    if (!answers_light(g)) return;
    g->shadow.has_areas = quality >= Q_AREA_LIGHTS;
    const Scene *s = g->shadow.around->scene;
    for (size_t i = 0; i < s->n_lights; i++) gather(g, &s->lights[i], quality);
}

/* A plain light, with shadows, on as many surfaces as it may shine on. */
static void gather_bunch(Gathering *const of[], BunchLane *const lane[], int n, const Light *l)
{
    Gathering *on[BUNCH_WIDTH];
    const Shadow *shadow[BUNCH_WIDTH];
    BunchLane *lane_of[BUNCH_WIDTH];
    LightAt lit[BUNCH_WIDTH];
    int n_lit = 0;
    for (int i = 0; i < n; i++) {
        lit[n_lit] = light_at(l, l->position, of[i]->shadow.at->point);
        on[n_lit] = of[i], shadow[n_lit] = &of[i]->shadow, lane_of[n_lit] = lane[i];
        n_lit += may_light(of[i], &lit[n_lit]);
    }
    if (n_lit == 0) return;
    for (Lanes arrives = shadow_light_bunch(shadow, lane_of, n_lit, l, lit); arrives; ) {
        int i = lanes_next(&arrives);
        gather_from(on[i], l, &lit[i]);
    }
}

void gather_light_bunch(Gathering *const of[], BunchLane *const lane[], int n, int quality)
{
    Gathering *answering[BUNCH_WIDTH];
    BunchLane *lane_of[BUNCH_WIDTH];
    int n_answering = 0;
    for (int i = 0; i < n; i++) {
        if (!answers_light(of[i])) continue;
        of[i]->shadow.has_areas = quality >= Q_AREA_LIGHTS;
        answering[n_answering] = of[i], lane_of[n_answering++] = lane[i];
    }
    if (n_answering == 0) return;
    const Scene *s = of[0]->shadow.around->scene;
    for (size_t k = 0; k < s->n_lights; k++) {
        const Light *l = &s->lights[k];
        if (l->is_plain && quality >= Q_SHADOWS) {
            gather_bunch(answering, lane_of, n_answering, l);
            continue;
        }
        for (int i = 0; i < n_answering; i++) {
            Trace *t = answering[i]->shadow.trace;
            lane_begin(lane_of[i], t);
            gather(answering[i], l, quality);
            lane_end(lane_of[i], t);
        }
    }
}

Rgb gathered_light(const Gathering *g)
{
    Rgb sum = rgb(0, 0, 0);
    for (int i = 0; i < g->n; i++) {
        const LayerAt *l = &g->layers[i];
        Rgb light = rgb_add(rgb_mul(rgb_scale(l->pigment, l->opacity), l->diffuse), l->shine);
        sum = rgb_add(sum, rgb_mul(l->weight, light));
    }
    return sum;
}
