/* Whitted's recursion ([Whi80]) with POV-Ray's rules: the layers of a texture from the top down, each with its own light;
 * what shines through the last one; what each layer mirrors. Eight camera rays go through it together, and so do the rays
 * that follow from them: a bunch for what is mirrored, one for what shines through; where only some of the eight go on, it
 * has lanes that are empty. */
#include "render/shade.h"

#include "render/gather.h"
#include "render/hit.h"
#include "render/sky.h"

/* The lowest quality (+Q) at which each thing is done; more is in gather.c. */
enum { Q_LIGHT = 2, Q_TRANSMISSION = 6, Q_REFLECTION = 8, Q_FOG = 9 };

/* POV-Ray: directions this near are not bent (|k - 1|). */
static const double NO_BEND = 1e-10;

/* Everything that the rays of a bunch of camera rays share. */
typedef struct {
    const Scene *scene;
    Trace *trace;
    int quality;
    BunchLane *lane;
    Surroundings around[BUNCH_WIDTH];
} Tracer;

/* How a ray came about. */
typedef struct {
    int level;
    bool is_straight;            /* it went on through a surface, without a level of its own */
    double weight;               /* an upper bound of what it adds to the pixel, for adc_bailout */
    const Medium *media;
} Path;

enum { FEW_LAYERS = 2 };         /* so many are seen without asking for memory */

/* The layers of a texture at a surface. */
typedef struct {
    Rgb through;                 /* what is left for what lies behind them all */
    Gathering light;
    LayerAt few[FEW_LAYERS];
} Shading;

/* The rays of a bunch that came about in the same way, and what is found of each. */
typedef struct {
    RayKind kind;                /* what just happened to them */
    bool was_reflected;          /* ever: what objects hide from */
    RayBunch *rays;
    Path path[BUNCH_WIDTH];
    Hit hit[BUNCH_WIDTH];
    RayRoot root[BUNCH_WIDTH];   /* of the hits: rays that go on from there leave from it */
    Surface at[BUNCH_WIDTH];
    Shading shading[BUNCH_WIDTH];
} Generation;

static void trace_rays(Tracer *x, Generation *g, Lanes lanes, Pixel out[]);

static Rgb pixel_rgb(Pixel p) { return rgb(p.r, p.g, p.b); }

static void set_pixel(Pixel *out, Rgb c, double transmit)
{
    out->r = c.r, out->g = c.g, out->b = c.b, out->transmit = transmit;
}

/* ---- secondary rays ---- */

static Vec3 mirrored(const Surface *at)
{
    return vec_normalize(vec_add(at->ray->dir, vec_scale(at->normal, 2 * at->cos_view)));
}

/* Lists of media that are made for the lanes between the two are forgotten. */
typedef struct { MediaScope of[BUNCH_WIDTH]; } MediaScopes;

static void open_media(Tracer *x, Lanes lanes, MediaScopes *out)
{
    while (lanes) {
        int i = lanes_next(&lanes);
        out->of[i] = media_open(&x->around[i]);
    }
}

/* The last first, as they lie in memory. */
static void close_media(Tracer *x, Lanes lanes, const MediaScopes *scopes)
{
    for (int i = BUNCH_WIDTH - 1; i >= 0; i--)
        if (lanes >> i & 1) media_close(&x->around[i], scopes->of[i]);
}

static void begin_generation(Tracer *x, const Generation *from, RayKind kind, Generation *g, RayBunch *room)
{
    g->kind = kind, g->was_reflected = from->was_reflected || kind == RAY_REFLECTED;
    g->rays = room;
    room->n = from->rays->n, room->lane = x->lane;
}

/* From the surface that ray i of the generation before has met. */
static void send_ray(const Generation *from, int i, Vec3 dir, Path path, Generation *g)
{
    g->rays->ray[i] = (Ray){ surface_leave(&from->at[i], dir), dir, 0 };
    g->rays->lane[i].root = from->root[i];
    g->path[i] = path;
}

/* weight: upper bounds of what the mirrors leave. */
static void trace_mirrored(Tracer *x, const Generation *from, Lanes lanes, const double weight[], Pixel out[])
{
    Generation g;
    RayBunch rays;
    MediaScopes scopes;
    begin_generation(x, from, RAY_REFLECTED, &g, &rays);
    open_media(x, lanes, &scopes);
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        const Path *p = &from->path[i];
        send_ray(from, i, mirrored(&from->at[i]), (Path){ p->level + 1, false, p->weight * weight[i], p->media }, &g);
    }
    trace_rays(x, &g, lanes, out);
    close_media(x, lanes, &scopes);
    while (lanes) out[lanes_next(&lanes)].transmit = 0;
}

/* Sends the ray beyond surface i; false: it is totally reflected. */
static bool send_bent(const Generation *from, int i, const Crossing *cross, double weight, Generation *g)
{
    const Surface *at = &from->at[i];
    const Path *p = &from->path[i];
    double k = cross->bend, c = at->cos_view, s = 1 + k * k * (c * c - 1);
    bool is_straight = fabs(k - 1) < NO_BEND;
    if (!is_straight && s < 0) return false;
    Vec3 dir = at->ray->dir;
    if (!is_straight) dir = vec_normalize(vec_add(vec_scale(dir, k), vec_scale(at->normal, k * c - sqrt(s))));
    send_ray(from, i, dir, (Path){ p->level + !is_straight, is_straight, p->weight * weight, cross->after }, g);
    return true;
}

static void fade(const Hit *h, Pixel *seen)
{
    Rgb by = interior_fade(hit_interior(h), h->t);
    set_pixel(seen, rgb_mul(pixel_rgb(*seen), by), seen->transmit * rgb_grey(by));
}

/* What comes through, faded by the way up to here if that led through the interior. Returns the lanes of rays that are
 * totally reflected. */
static Lanes trace_through(Tracer *x, const Generation *from, Lanes lanes, Pixel out[])
{
    Generation g;
    RayBunch rays;
    MediaScopes scopes;
    double weight[BUNCH_WIDTH];
    Lanes total = 0, inside = 0;
    begin_generation(x, from, RAY_TRANSMITTED, &g, &rays);
    open_media(x, lanes, &scopes);
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        Crossing cross = media_cross(&x->around[i], from->path[i].media, &from->hit[i]);
        weight[i] = fmax(rgb_max(from->shading[i].through), 0);
        if (cross.was_inside) inside |= 1u << i;
        if (!send_bent(from, i, &cross, weight[i], &g)) total |= 1u << i;
    }
    trace_rays(x, &g, lanes & ~total, out);
    if (total) trace_mirrored(x, from, total, weight, out);
    close_media(x, lanes, &scopes);
    while (inside) {
        int i = lanes_next(&inside);
        fade(&from->hit[i], &out[i]);
    }
    return total;
}

/* Adds to out what comes from behind the surfaces; returns the lanes of rays that are totally reflected. */
static Lanes add_behind(Tracer *x, const Generation *g, Lanes lanes, Pixel out[])
{
    Lanes clear = 0;
    Pixel behind[BUNCH_WIDTH];
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        if (layers_transmit(g->shading[i].through) > x->scene->adc_bailout) clear |= 1u << i;
    }
    if (!clear) return 0;
    Lanes total = trace_through(x, g, clear, behind);
    while (clear) {
        int i = lanes_next(&clear);
        bool is_total = total >> i & 1;
        Rgb through = g->shading[i].through, seen = pixel_rgb(behind[i]), own = pixel_rgb(out[i]);
        set_pixel(&out[i], rgb_add(own, is_total ? seen : rgb_mul(seen, through)),
                  is_total ? 0 : behind[i].transmit * layers_transmit(through));
    }
    return total;
}

/* Adds what all layers mirror, by one ray. */
static void add_mirrored(Tracer *x, const Generation *g, Lanes lanes, Pixel out[])
{
    Lanes shiny = 0;
    double weight[BUNCH_WIDTH];
    Pixel seen[BUNCH_WIDTH];
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        weight[i] = layers_mirror_weight(g->shading[i].light.layers, g->shading[i].light.n);
        if (weight[i] != 0) shiny |= 1u << i;
    }
    if (!shiny) return;
    trace_mirrored(x, g, shiny, weight, seen);
    while (shiny) {
        int i = lanes_next(&shiny);
        const Gathering *on = &g->shading[i].light;
        Rgb mirror = layers_mirrored(on->layers, on->n, pixel_rgb(seen[i]));
        set_pixel(&out[i], rgb_add(pixel_rgb(out[i]), mirror), out[i].transmit);
    }
}

/* ---- textures ---- */

/* The texture has layers, and light is wanted. */
static void walk_texture(Tracer *x, Generation *g, int i)
{
    const Surface *at = &g->at[i];
    Shading *k = &g->shading[i];
    const Medium *media = g->path[i].media;
    int n = at->texture->n_layers;
    k->light.layers = n > FEW_LAYERS ? ARENA_ARRAY(x->trace->scratch, LayerAt, n) : k->few;
    k->light.n = layers_walk(&x->around[i], at, media, k->light.layers, &k->through);
    k->light.shadow = (Shadow){ at, media, &x->around[i], false, x->trace };
}

static void light_textures(Tracer *x, Generation *g, Lanes lanes)
{
    Gathering *of[BUNCH_WIDTH];
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        walk_texture(x, g, i);
        x->lane[i].root = g->root[i];
        of[i] = &g->shading[i].light;
    }
    gather_light_bunch(of, lanes, g->rays, x->quality);
}

static void shade_surfaces(Tracer *x, Generation *g, Lanes lanes, Pixel out[]);

/* Between two entries of its map a texture is both of them, each lit, mirroring and letting through for itself. */
static void shade_map(Tracer *x, Generation *g, int i, Pixel out[])
{
    TextureChoice choices[2];
    Surface whole = g->at[i];
    Pixel sum = { 0 }, seen[BUNCH_WIDTH];
    int n = texture_choose(whole.texture->map, whole.texture_point, choices);
    for (int j = 0; j < n; j++) {
        g->at[i] = surface_with(&whole, &choices[j]);
        shade_surfaces(x, g, 1u << i, seen);
        Rgb part = rgb_scale(pixel_rgb(seen[i]), choices[j].share);
        set_pixel(&sum, rgb_add(pixel_rgb(sum), part), sum.transmit + choices[j].share * seen[i].transmit);
    }
    g->at[i] = whole;
    out[i] = sum;
}

/* A texture that is not of layers alone; or light is not wanted (+Q0, +Q1): then there is the top layer's pigment. */
static void shade_unlit(Tracer *x, Generation *g, int i, Pixel out[])
{
    const Surface *at = &g->at[i];
    int n = at->texture->n_layers;
    if (at->texture->map) shade_map(x, g, i, out);
    else set_pixel(&out[i], n == 0 ? rgb(0, 0, 0) : color_rgb(surface_color(at, &at->texture->layers[n - 1])), 0);
}

/* The surfaces that rays have met. */
static void shade_surfaces(Tracer *x, Generation *g, Lanes lanes, Pixel out[])
{
    Lanes lit = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        const Texture *texture = g->at[i].texture;
        if (!texture->map && texture->n_layers > 0 && x->quality >= Q_LIGHT) lit |= 1u << i;
        else shade_unlit(x, g, i, out);
    }
    if (!lit) return;
    light_textures(x, g, lit);
    for (Lanes left = lit; left; ) {
        int i = lanes_next(&left);
        const Gathering *on = &g->shading[i].light;
        set_pixel(&out[i], layers_light(on->layers, on->n), 0);
    }
    if (!x->scene->needs_secondary_rays) return;
    Lanes total = x->quality >= Q_TRANSMISSION ? add_behind(x, g, lit, out) : 0;
    if (x->quality >= Q_REFLECTION) add_mirrored(x, g, lit & ~total, out);
}

/* ---- the recursion ---- */

/* What lies nearer than its own error may be the surface that the ray has just left: the next counts, past which the ray is
 * made to begin. */
static bool find_next(Tracer *x, Generation *g, int i, RayKind kind)
{
    Ray *r = &g->rays->ray[i];
    Hit *h = &g->hit[i];
    bool is_hit = true;
    lane_begin(&x->lane[i], x->trace);
    while (is_hit && h->t <= h->t_error) {
        r->t_min = h->t;
        is_hit = scene_hit(x->scene, r, kind, h, x->trace);
    }
    lane_end(&x->lane[i], x->trace);
    return is_hit;
}

/* The nearest hits. */
static Lanes find_hits(Tracer *x, Generation *g, Lanes lanes)
{
    RayKind kind = g->was_reflected ? RAY_REFLECTED : RAY_CAMERA;
    Lanes hit = scene_hit_bunch(x->scene, g->rays, lanes, kind, g->hit, x->trace);
    for (Lanes left = hit; left; ) {
        int i = lanes_next(&left);
        if (g->kind != RAY_CAMERA && g->hit[i].t <= g->hit[i].t_error && !find_next(x, g, i, kind)) hit &= ~(1u << i);
        g->root[i] = x->lane[i].root;
    }
    return hit;
}

static void count_rays(Counters *c, RayKind kind, Lanes lanes)
{
    uint64_t *counter = kind == RAY_CAMERA ? &c->camera_rays : kind == RAY_REFLECTED ? &c->reflected_rays
                                                                                     : &c->transmitted_rays;
    *counter += (uint64_t)__builtin_popcount(lanes);
}

/* POV-Ray does not count a ray that goes straight on as a level, but does not let it begin at the last one either. */
static bool goes_on(const Scene *s, const Path *p)
{
    return p->level + p->is_straight < s->max_trace_level && !(p->weight < s->adc_bailout);
}

static void add_fog(Tracer *x, const Generation *g, Lanes lanes, Pixel out[])
{
    while (lanes) {
        int i = lanes_next(&lanes);
        if (media_let_fog_in(media_known(&x->around[i], g->path[i].media)))
            out[i] = sky_through_fog(x->scene, &g->rays->ray[i], g->hit[i].t, out[i]);
    }
}

/* Rays that were sent, or camera rays, which have their lanes; moves those past the surface that they have left. */
static void trace_rays(Tracer *x, Generation *g, Lanes lanes, Pixel out[])
{
    const Scene *s = x->scene;
    for (Lanes left = lanes; left; ) {
        int i = lanes_next(&left);
        if (goes_on(s, &g->path[i])) continue;
        set_pixel(&out[i], rgb(0, 0, 0), 0);
        lanes &= ~(1u << i);
    }
    if (!lanes) return;
    count_rays(&x->trace->counters, g->kind, lanes);
    if (g->kind != RAY_CAMERA && !lanes_are_few(lanes)) bunch_fill(g->rays, lanes);
    Lanes hit = find_hits(x, g, lanes);
    for (Lanes missed = lanes & ~hit; missed; ) {
        int i = lanes_next(&missed);
        out[i] = sky_color(s, g->rays->ray[i].dir);
    }
    for (Lanes left = hit; left; ) {
        int i = lanes_next(&left);
        surface_at(s, &g->rays->ray[i], &g->hit[i], &g->at[i]);
    }
    shade_surfaces(x, g, hit, out);
    if (s->n_fogs > 0 && x->quality >= Q_FOG) add_fog(x, g, lanes, out);
}

void shade_camera_rays(const Scene *s, RayBunch *rays, int quality, Trace *t, Pixel out[])
{
    ArenaMark mark = arena_mark(t->scratch);
    Tracer x = { .scene = s, .trace = t, .quality = quality, .lane = rays->lane };
    Generation g;
    g.kind = RAY_CAMERA, g.was_reflected = false, g.rays = rays;
    for (int i = 0; i < rays->n; i++) {
        x.around[i] = (Surroundings){ .scene = s, .scratch = t->scratch, .camera = rays->ray[i].origin };
        g.path[i] = (Path){ .weight = 1, .media = MEDIA_OF_CAMERA };
    }
    trace_rays(&x, &g, bunch_all(rays), out);
    arena_reset(t->scratch, mark);
}
