/* Embree 3 on meshes of the model: triangles, or its grids; one ray at a time, one thread. */
#include "tests/bench/mesh.h"

#include <embree3/rtcore.h>
#include <string.h>

typedef struct {
    Engine engine;
    RTCDevice device;
    RTCScene scene;
    struct RTCIntersectContext context;
    size_t held, peak;
    /* The set in single precision, converted before the clock runs. */
    const RaySet *set;
    struct RTCRay *rays;
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

static void embree_release(Engine *engine)
{
    Embree *e = (Embree *)engine;
    rtcReleaseScene(e->scene);
    rtcReleaseDevice(e->device);
    free(e->rays);
    free(e);
}

static Embree *embree_begin(bool is_robust)
{
    Embree *e = calloc(1, sizeof *e);
    e->engine = (Engine){ .shoot = embree_shoot, .release = embree_release };
    e->device = rtcNewDevice("threads=1");
    rtcSetDeviceErrorFunction(e->device, say_error, NULL);
    rtcSetDeviceMemoryMonitorFunction(e->device, count_memory, e);
    e->scene = rtcNewScene(e->device);
    rtcSetSceneFlags(e->scene, is_robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcInitIntersectContext(&e->context);
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
