#include "tests/bench/peer.h"

#include "nurbs/surface.h"
#include "render/bvh.h"

typedef struct {
    Engine engine;
    const PeerType *type;
    Arena *arena;
    void **surfaces;
    int n;
    Bvh *tree;
    Trace trace;
} Peer;

typedef struct { const Peer *peer; double nearest; bool wants_any; } Search;

static bool visit(void *context, uint32_t i, const Ray *r, double *t_max, Trace *t)
{
    Search *s = context;
    (void)t;
    double at = s->peer->type->nearest(s->peer->surfaces[i], r, *t_max);
    if (!isfinite(at)) return false;
    s->nearest = *t_max = at;
    return s->wants_any;
}

static void peer_shoot(Engine *engine, const RaySet *set, size_t stride, double *t)
{
    Peer *e = (Peer *)engine;
    for (size_t i = 0; i < set->n; i += stride, t++) {
        Search s = { e, INFINITY, set->t_max != NULL };
        double t_max = set->t_max ? set->t_max[i] : INFINITY;
        bvh_traverse(e->tree, &set->rays[i], &t_max, visit, &s, &e->trace);
        *t = set->t_max && isfinite(s.nearest) ? 0 : s.nearest;
    }
}

static void peer_release(Engine *engine)
{
    Peer *e = (Peer *)engine;
    for (int i = 0; i < e->n; i++) e->type->release(e->surfaces[i]);
    arena_free(e->arena);
    free(e);
}

static Box box_of(const SurfaceDesc *s)
{
    Box b = box_empty();
    for (int i = 0; i < s->n_u * s->n_v; i++) b = box_add_point(b, vec(s->points[i].x, s->points[i].y, s->points[i].z));
    return b;
}

Engine *peer_new(const EngineInput *in, const PeerType *type)
{
    const Model *m = in->model;
    Peer *e = calloc(1, sizeof *e);
    size_t before = memory_now();
    memory_reset_peak();
    double begin = processor_now();
    e->engine = (Engine){ .shoot = peer_shoot, .release = peer_release };
    e->type = type, e->arena = arena_new();
    e->surfaces = ARENA_ARRAY(e->arena, void *, m->n);
    Box *boxes = ARENA_ARRAY(e->arena, Box, m->n);
    for (; e->n < m->n; e->n++) {
        boxes[e->n] = box_of(&m->surfaces[e->n]);
        e->surfaces[e->n] = type->make(&m->surfaces[e->n], PEER_TOLERANCE * m->diagonal);
        if (e->surfaces[e->n]) continue;
        peer_release(&e->engine);
        return NULL;
    }
    e->tree = bvh_build(e->arena, boxes, (uint32_t)m->n, BVH_SAH);
    e->engine.cost.prep_seconds = processor_now() - begin;
    e->engine.cost.held = memory_now() - before, e->engine.cost.peak = memory_peak() - before;
    return &e->engine;
}
