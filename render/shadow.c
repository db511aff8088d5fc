/* Shadow rays: towards points, and towards the samples of area lights. */
#include "render/shadow.h"

#include "render/hit.h"
#include "render/hit_list.h"

static Rgb through_map(const Surface *blocker, Rgb light);

/* What a transparent blocker lets through: every layer filters. */
static Rgb through_layers(const Surface *blocker, Rgb light)
{
    if (blocker->texture->map) return through_map(blocker, light);
    for (int i = 0; i < blocker->texture->n_layers; i++) {
        Color c = surface_color(blocker, &blocker->texture->layers[i]);
        light = rgb_mul(light, rgb(c.r * c.filter + c.transmit, c.g * c.filter + c.transmit, c.b * c.filter + c.transmit));
    }
    return light;
}

static Rgb through_map(const Surface *blocker, Rgb light)
{
    TextureChoice choices[2];
    Rgb sum = rgb(0, 0, 0);
    int n = texture_choose(blocker->texture->map, blocker->texture_point, choices);
    for (int i = 0; i < n; i++) {
        Surface part = surface_with(blocker, &choices[i]);
        sum = rgb_add(sum, rgb_scale(through_layers(&part, light), choices[i].share));
    }
    return sum;
}

/* What a hit does to light: where its texture is the same everywhere and on either side, that is all there is to know. */
static Rgb through_surface(const Scene *s, const Ray *r, const Hit *h, float caustics, Rgb light)
{
    const Object *o = hit_textured_object(h);
    Surface blocker = { .texture = o ? o->texture : NULL };
    bool is_alike = o && o->is_even && !o->interior_texture && !(caustics > 0);
    if (!is_alike) surface_at(s, r, h, &blocker);
    light = through_layers(&blocker, light);
    return caustics > 0 ? rgb_scale(light, 1 + pow(blocker.cos_view, 45 * (double)caustics)) : light;
}

/* Light goes straight on through glass; `caustics` imitates the bundling by a lens. */
static Rgb past_blocker(const Shadow *q, const Ray *r, const Hit *h, const Medium **media, Rgb light)
{
    const Interior *interior = hit_interior(h);
    light = through_surface(q->around->scene, r, h, interior ? interior->caustics : 0, light);
    if (!interior) return light;
    if (!interior_fades(interior) || !(interior->fade_power > 0)) return light;
    Crossing c = media_cross(q->around, *media, h);
    *media = c.after;
    return c.was_inside ? rgb_mul(light, interior_fade(interior, h->t - r->t_min)) : light;
}

/* What is left of the light beyond the hits. One within the error of the last, twice, is the last found again. */
static Rgb light_past(const Shadow *q, Ray *r, const HitList *filters, Rgb light)
{
    const Medium *media = q->media;
    for (size_t i = 0; i < filters->n && !rgb_is_black(light); i++) {
        const Hit *h = &filters->hits[i];
        if (!(h->t > r->t_min)) continue;
        ShadowKind kind = scene_shadow_at(q->around->scene, h);
        if (kind == SHADOW_BLOCKER) return rgb(0, 0, 0);
        if (kind == SHADOW_FILTER) light = past_blocker(q, r, h, &media, light);
        r->t_min = kind == SHADOW_FILTER ? h->t + 2 * h->t_error : h->t;
    }
    return light;
}

/* All filters at once: mostly the light goes on through them. */
static Rgb through_filters(const Shadow *q, Ray *r, double t_max, Rgb light)
{
    MediaScope scope = media_open(q->around);
    HitList filters = hit_list_make(q->around->scratch, t_max);
    scene_filters(q->around->scene, r, &filters, q->trace);
    light = light_past(q, r, &filters, light);
    media_close(q->around, scope);
    return light;
}

/* From the surface along the unit vector dir, to end at *t_max before `to`; not positive: nothing can stand between. (A
 * parallel light's plane may be behind the point.) */
static Ray ray_to_light(const Surface *at, Vec3 dir, Vec3 to, double *t_max)
{
    Ray r = { surface_leave(at, dir), dir, 0 };
    *t_max = surface_stop_before(r.origin, to, vec_dot(vec_sub(to, r.origin), r.dir));
    return r;
}

/* What of the light from `to`, at the end of a ray along the unit vector `dir`, arrives. false: nothing. */
static bool light_from(const Shadow *q, const Vec3 *dir, const Vec3 *to, Rgb *light)
{
    double t_max;
    Ray r = ray_to_light(q->at, *dir, *to, &t_max);
    if (!(t_max > 0)) return true;
    q->trace->is_shadow_ray = true;
    q->trace->counters.shadow_rays++;
    bool may_be_filtered, is_blocked = scene_blocks(q->around->scene, &r, t_max, &may_be_filtered, q->trace);
    if (!is_blocked && may_be_filtered) *light = through_filters(q, &r, t_max, *light);
    q->trace->is_shadow_ray = false;
    return !is_blocked;
}

/* ---- area lights ---- */

/* In the light's own axes, or turned towards the point (`orient`). */
static void area_axes(const Light *l, Vec3 point, Vec3 *u, Vec3 *v)
{
    static const double ALMOST_ALONG_Z = .01;   /* POV-Ray's choice of a helper vector */
    *u = l->area_u, *v = l->area_v;
    if (!l->area_orient) return;
    Vec3 to_light = vec_normalize(vec_sub(l->position, point));
    bool is_along_z = fabs(fabs(to_light.z) - 1) < ALMOST_ALONG_Z;
    Vec3 helper = is_along_z ? vec(0, 1, 0) : vec(0, 0, 1);
    Vec3 across = vec_normalize(vec_cross(to_light, helper));
    *u = vec_scale(across, vec_length(l->area_u));
    *v = vec_scale(vec_normalize(vec_cross(to_light, across)), vec_length(l->area_v));
}

Vec3 shadow_area_sample(const Light *l, Vec3 point, int i, int j)
{
    static const double OFF_CENTRE = .001;   /* POV-Ray's guard of the division */
    Vec3 u, v;
    area_axes(l, point, &u, &v);
    double a = l->area_n_u > 1 ? (double)i / (l->area_n_u - 1) - .5 : 0;
    double b = l->area_n_v > 1 ? (double)j / (l->area_n_v - 1) - .5 : 0;
    if (l->area_circular) {
        a += OFF_CENTRE, b += OFF_CENTRE;
        double to_circle = fmax(fabs(a), fabs(b)) / sqrt(a * a + b * b);
        a *= to_circle, b *= to_circle;
    }
    return vec_add(l->position, vec_add(vec_scale(u, a), vec_scale(v, b)));
}

typedef struct { Rgb light; bool is_known; } Sample;
typedef struct {
    const Shadow *q;
    const Light *light;
    Rgb color;                   /* unblocked */
    Sample *samples;             /* area_n_u by area_n_v, each traced once at most */
} Area;

static Rgb sample_light(const Area *a, int i, int j)
{
    Sample *s = &a->samples[j * a->light->area_n_u + i];
    if (!s->is_known) {
        Vec3 to = shadow_area_sample(a->light, a->q->at->point, i, j);
        Vec3 dir = vec_normalize(vec_sub(to, a->q->at->point));
        *s = (Sample){ a->color, true };
        if (!light_from(a->q, &dir, &to, &s->light)) s->light = rgb(0, 0, 0);
    }
    return s->light;
}

static bool differ(Rgb a, Rgb b)
{
    static const double CONTRAST = .1;   /* POV-Ray's */
    return fabs(a.r - b.r) + fabs(a.g - b.g) + fabs(a.b - b.b) > CONTRAST;
}

/* The mean over the rectangle of samples (i0, j0) to (i1, j1): of its corners, or of four parts of it where corners differ
 * or the level is below `adaptive`. */
static Rgb area_mean(const Area *a, int i0, int j0, int i1, int j1, int level)
{
    Rgb g[4] = { sample_light(a, i0, j0), sample_light(a, i1, j0), sample_light(a, i1, j1), sample_light(a, i0, j1) };
    bool is_even = !differ(g[0], g[1]) && !differ(g[1], g[2]) && !differ(g[2], g[3]) && !differ(g[3], g[0]);
    bool can_split = i1 - i0 > 1 || j1 - j0 > 1;
    if (can_split && (level < a->light->area_adaptive || !is_even)) {
        int im = (i0 + i1) / 2, jm = (j0 + j1) / 2, ip = (i0 + i1 + 1) / 2, jp = (j0 + j1 + 1) / 2;
        g[0] = area_mean(a, i0, j0, im, jm, level + 1);
        g[1] = area_mean(a, ip, j0, i1, jm, level + 1);
        g[2] = area_mean(a, ip, jp, i1, j1, level + 1);
        g[3] = area_mean(a, i0, jp, im, j1, level + 1);
    }
    return rgb_scale(rgb_add(rgb_add(g[0], g[1]), rgb_add(g[2], g[3])), .25);
}

static Rgb area_light(const Shadow *q, const Light *l, Rgb color)
{
    MediaScope scope = media_open(q->around);
    Sample *samples = arena_zalloc(q->around->scratch, (size_t)l->area_n_u * (size_t)l->area_n_v, sizeof *samples);
    Area a = { q, l, color, samples };
    Rgb mean = area_mean(&a, 0, 0, l->area_n_u - 1, l->area_n_v - 1, 0);
    media_close(q->around, scope);
    return mean;
}

static bool light_from_point(const Shadow *q, const Light *l, LightAt *lit)
{
    return light_from(q, &lit->direction, &l->position, &lit->color);
}

bool shadow_light(const Shadow *q, const Light *l, LightAt *lit)
{
    q->trace->blockers.aim = l;
    if (l->is_plain) return light_from_point(q, l, lit);
    if (rgb_is_black(lit->color)) return false;
    if (l->is_shadowless) return true;
    if (l->is_area && q->has_areas) return lit->color = area_light(q, l, lit->color), true;
    if (!light_is_parallel(l)) return light_from_point(q, l, lit);
    Vec3 to = vec_add(q->at->point, vec_scale(lit->direction, lit->distance));
    return light_from(q, &lit->direction, &to, &lit->color);
}

/* ---- neighbours ---- */

/* ray_to_light for a light's position; sets all of the bunch but n and `lane`. The lanes of those with room for a
 * blocker. */
EVERY_X86
static Lanes rays_to_light(const SurfaceLanes *at, const Light *l, const Vec3x8 *dir, RayBunch *out, V8d *t_max)
{
    Vec3x8 to = vec8_splat(l->position);
    V8d cosine = vec8_dot(*dir, at->geometric);
    V8d offset = v8d_select(v8d_less(cosine, v8d_splat(0)), -at->offset, at->offset);
    out->origin = vec8_add(at->point, vec8_scale(at->geometric, offset));
    out->dir = *dir;
    out->t_min = v8d_splat(0);
    *t_max = surface_stop_before_8(&out->origin, &to, vec8_dot(vec8_sub(to, out->origin), *dir));
    bunch_set_rays(out);
    return v8l_mask(v8d_less(v8d_splat(0), *t_max));
}

static Lanes blocked_lanes(RayBunch *rays, Lanes lanes, const double t_max[], const Shadow *q, const Light *l,
                           Lanes *may_be_filtered)
{
    Trace *t = q->trace;
    t->blockers.aim = l;
    t->counters.shadow_rays += (uint64_t)__builtin_popcount(lanes);
    return scene_blocks_bunch(q->around->scene, rays, lanes, t_max, may_be_filtered, t);
}

Lanes shadow_light_bunch(const Shadow *const q[], Lanes lanes, const RayBunch *seen_by, const SurfaceLanes *at,
                         const Light *l, const Vec3x8 *direction, Rgb color[])
{
    const Shadow *any = q[__builtin_ctz(lanes)];
    Trace *t = any->trace;
    RayBunch rays;
    V8d t_max;
    rays.n = seen_by->n, rays.lane = seen_by->lane;
    Lanes asked = lanes & rays_to_light(at, l, direction, &rays, &t_max), filtered;
    t->is_shadow_ray = true;
    Lanes arrives = lanes & ~blocked_lanes(&rays, asked, (const double *)&t_max, any, l, &filtered);
    for (filtered &= arrives; filtered; ) {
        int i = lanes_next(&filtered);
        bunch_begin(&rays, i, t);
        color[i] = through_filters(q[i], &rays.ray[i], t_max[i], color[i]);
        bunch_end(&rays, i, t);
    }
    t->is_shadow_ray = false;
    return arrives;
}
