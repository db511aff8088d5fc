/* Embree 3 on meshes of the model: triangles, or its grids; one ray at a time or eight, one thread. */
#include "tests/bench/mesh.h"

#include <embree3/rtcore.h>
#include <string.h>

typedef struct {
    Engine engine;
    RTCDevice device;
    RTCScene scene;
    struct RTCIntersectContext context, coherent;
    size_t held, peak;
    /* The set in single precision, converted before the clock runs. */
    const RaySet *set;
    struct RTCRay *rays;
    /* The same of every stride-th in eights. */
    const RaySet *set_of_eights;
    size_t stride, n_eights;
    struct RTCRay8 *eights;
} Embree;

static bool count_memory(void *context, ssize_t bytes, bool post)
{
    Embree *e = context;
    (void)post;
    e->held += (size_t)bytes;
    if (e->held > e->peak) e->peak = e->held;
    return true;
}

static void say_error(void *context, enum RTCError code, const char *text)
{
    (void)context;
    fprintf(stderr, "bench: embree: error %d: %s\n", (int)code, text);
}

static struct RTCRay single_precision(const Ray *r, double t_max)
{
    return (struct RTCRay){ .org_x = (float)r->origin.x, .org_y = (float)r->origin.y, .org_z = (float)r->origin.z,
                            .dir_x = (float)r->dir.x, .dir_y = (float)r->dir.y, .dir_z = (float)r->dir.z,
                            .tnear = (float)r->t_min, .tfar = (float)t_max, .mask = 0xFFFFFFFFu };
}

static void take_set(Embree *e, const RaySet *set)
{
    if (e->set == set) return;
    e->set = set;
    free(e->rays);
    e->rays = malloc(set->n * sizeof *e->rays + 1);
    for (size_t i = 0; i < set->n; i++) e->rays[i] = single_precision(&set->rays[i], set->t_max ? set->t_max[i] : INFINITY);
}

static void embree_shoot(Engine *engine, const RaySet *set, size_t stride, double *t)
{
    Embree *e = (Embree *)engine;
    take_set(e, set);
    for (size_t i = 0; i < set->n; i += stride, t++) {
        if (set->t_max) {
            struct RTCRay ray = e->rays[i];
            rtcOccluded1(e->scene, &e->context, &ray);
            *t = ray.tfar < 0 ? 0 : INFINITY;
        } else {
            struct RTCRayHit hit = { .ray = e->rays[i], .hit.geomID = RTC_INVALID_GEOMETRY_ID };
            rtcIntersect1(e->scene, &e->context, &hit);
            *t = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : (double)hit.ray.tfar;
        }
    }
}

/* ---- eight at a time ---- */

enum { EIGHT = 8 };

static void set_lane(struct RTCRay8 *all, int i, const struct RTCRay *r)
{
    all->org_x[i] = r->org_x, all->org_y[i] = r->org_y, all->org_z[i] = r->org_z;
    all->dir_x[i] = r->dir_x, all->dir_y[i] = r->dir_y, all->dir_z[i] = r->dir_z;
    all->tnear[i] = r->tnear, all->tfar[i] = r->tfar, all->mask[i] = r->mask;
}

/* Lanes without a ray repeat the first. */
static void take_eights(Embree *e, const RaySet *set, size_t stride)
{
    take_set(e, set);
    if (e->set_of_eights == set && e->stride == stride) return;
    size_t n = (set->n + stride - 1) / stride;
    e->set_of_eights = set, e->stride = stride, e->n_eights = (n + EIGHT - 1) / EIGHT;
    free(e->eights);
    e->eights = aligned_alloc(_Alignof(struct RTCRay8), e->n_eights * sizeof *e->eights + sizeof *e->eights);
    memset(e->eights, 0, e->n_eights * sizeof *e->eights);
    for (size_t i = 0; i < e->n_eights * EIGHT; i++) {
        size_t k = i < n ? i : i - i % EIGHT;
        set_lane(&e->eights[i / EIGHT], (int)(i % EIGHT), &e->rays[k * stride]);
    }
}

static void intersect_eight(Embree *e, struct RTCIntersectContext *context, const struct RTCRay8 *rays, double t[EIGHT])
{
    _Alignas(32) static const int all[EIGHT] = { -1, -1, -1, -1, -1, -1, -1, -1 };
    struct RTCRayHit8 hit;
    hit.ray = *rays;
    memset(hit.hit.geomID, 0xFF, sizeof hit.hit.geomID);     /* RTC_INVALID_GEOMETRY_ID */
    rtcIntersect8(all, e->scene, context, &hit);
    for (int i = 0; i < EIGHT; i++)
        t[i] = hit.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? INFINITY : (double)hit.ray.tfar[i];
}

static void occlude_eight(Embree *e, struct RTCIntersectContext *context, const struct RTCRay8 *rays, double t[EIGHT])
{
    _Alignas(32) static const int all[EIGHT] = { -1, -1, -1, -1, -1, -1, -1, -1 };
    struct RTCRay8 ray = *rays;
    rtcOccluded8(all, e->scene, context, &ray);
    for (int i = 0; i < EIGHT; i++) t[i] = ray.tfar[i] < 0 ? 0 : INFINITY;
}

static void embree_shoot_eights(Engine *engine, const RaySet *set, size_t stride, double *t)
{
    Embree *e = (Embree *)engine;
    take_eights(e, set, stride);
    struct RTCIntersectContext *context = set->is_coherent ? &e->coherent : &e->context;
    size_t n = (set->n + stride - 1) / stride;
    for (size_t i = 0; i < e->n_eights; i++) {
        double of_eight[EIGHT];
        if (set->t_max) occlude_eight(e, context, &e->eights[i], of_eight);
        else intersect_eight(e, context, &e->eights[i], of_eight);
        for (size_t k = 0; k < EIGHT && i * EIGHT + k < n; k++) *t++ = of_eight[k];
    }
}

/* ---- building ---- */

static void embree_release(Engine *engine)
{
    Embree *e = (Embree *)engine;
    rtcReleaseScene(e->scene);
    rtcReleaseDevice(e->device);
    free(e->rays);
    free(e->eights);
    free(e);
}

static Embree *embree_begin(bool is_robust)
{
    Embree *e = calloc(1, sizeof *e);
    e->engine = (Engine){ .shoot = embree_shoot, .shoot_eights = embree_shoot_eights, .release = embree_release };
    e->device = rtcNewDevice("threads=1");
    rtcSetDeviceErrorFunction(e->device, say_error, NULL);
    rtcSetDeviceMemoryMonitorFunction(e->device, count_memory, e);
    e->scene = rtcNewScene(e->device);
    rtcSetSceneFlags(e->scene, is_robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcInitIntersectContext(&e->context);
    rtcInitIntersectContext(&e->coherent);
    e->coherent.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return e;
}

/* A copy that Embree owns, and counts. */
static void give(RTCGeometry g, enum RTCBufferType type, enum RTCFormat format, size_t size, size_t n, const void *data)
{
    memcpy(rtcSetNewGeometryBuffer(g, type, 0, format, size, n), data, n * size);
}

static Engine *embree_finish(Embree *e, RTCGeometry g, double begin)
{
    rtcCommitGeometry(g);
    rtcAttachGeometry(e->scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(e->scene);
    EngineCost *cost = &e->engine.cost;
    cost->prep_seconds = processor_now() - begin;
    cost->held = e->held, cost->peak = e->peak;
    return &e->engine;
}

Engine *engine_embree(const EngineInput *in)
{
    static const Mesh empty = { 0 };
    const Mesh *m = in->mesh ? in->mesh : &empty;
    Embree *e = embree_begin(in->is_robust);
    double begin = processor_now();
    RTCGeometry g = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    give(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * sizeof(float), m->n_vertices, m->vertices);
    give(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), m->n_triangles, m->triangles);
    e->engine.cost.mesh_seconds = m->seconds, e->engine.cost.n_triangles = m->n_triangles;
    return embree_finish(e, g, begin);
}

Engine *engine_embree_grid(const EngineInput *in)
{
    for (int i = 0; i < in->model->n; i++)
        if (in->model->surfaces[i].n_trims > 0) return NULL;
    Arena *a = arena_new();
    GridMesh m = mesh_grids(a, in->model, in->grid_steps);
    Embree *e = embree_begin(in->is_robust);
    double begin = processor_now();
    RTCGeometry g = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_GRID);
    give(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * sizeof(float), m.n_vertices, m.vertices);
    struct RTCGrid *grids = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof *grids, m.n_grids);
    unsigned side = (unsigned)m.steps + 1;
    for (size_t i = 0; i < m.n_grids; i++)
        grids[i] = (struct RTCGrid){ (unsigned)i * side * side, side, (unsigned short)side, (unsigned short)side };
    e->engine.cost.mesh_seconds = m.seconds;
    e->engine.cost.n_triangles = 2 * m.n_grids * (size_t)m.steps * (size_t)m.steps;
    arena_free(a);
    return embree_finish(e, g, begin);
}
