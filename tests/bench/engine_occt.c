/* Open CASCADE's IntCurvesFace_Intersector, a face for each surface. */
#include "tests/bench/occt.h"
#include "tests/bench/peer.h"

static bool trim(OcctFace *f, const SurfaceDesc *s)
{
    for (int i = 0; i < s->n_trims; i++) {
        const TrimLoopDesc *loop = &s->trims[i];
        if (loop->is_polyline || loop->n_curves != 1) return false;
        const TrimCurveDesc *c = &loop->curves[0];
        if (!occt_face_trim(f, c->order, c->n, c->knots, &c->points->x)) return false;
    }
    return true;
}

static void *occt_make(const SurfaceDesc *s, double tolerance)
{
    OcctFace *f = occt_face_new(s->order_u, s->order_v, s->n_u, s->n_v, s->knots_u, s->knots_v, &s->points->x, tolerance);
    if (!f) return NULL;
    double away[3] = { 1e9, 1e9, 1e9 }, dir[3] = { 1, 0, 0 };
    bool ok = trim(f, s);
    if (ok) occt_face_nearest(f, away, dir, 0, 1);   /* what it prepares for the first line belongs to the preparation */
    else occt_face_free(f);
    return ok ? f : NULL;
}

static double occt_nearest(void *surface, const Ray *r, double t_max)
{
    double origin[3] = { r->origin.x, r->origin.y, r->origin.z }, dir[3] = { r->dir.x, r->dir.y, r->dir.z };
    return occt_face_nearest(surface, origin, dir, r->t_min, t_max);
}

static void occt_release(void *surface) { occt_face_free(surface); }

Engine *engine_occt(const EngineInput *in)
{
    static const PeerType type = { occt_make, occt_nearest, occt_release };
    return peer_new(in, &type);
}
