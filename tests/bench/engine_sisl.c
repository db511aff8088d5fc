/* SISL's s1856: all points where a line meets a surface, by subdivision and iteration. It knows no trims: points are held
 * against trimray's. */
#include "tests/bench/peer.h"

#include "nurbs/surface.h"

#include <sisl.h>

typedef struct {
    Arena *arena;
    const Surface *surface;
    SISLSurf *sisl;
    double tolerance;
} SislSurface;

static void *sisl_make(const SurfaceDesc *desc, double tolerance)
{
    Arena *a = arena_new();
    NurbsError error;
    SislSurface *s = ARENA_NEW(a, SislSurface);
    s->arena = a, s->tolerance = tolerance, s->surface = surface_new(a, desc, &error, NULL, 0, NULL);
    if (!s->surface) {
        arena_free(a);
        return NULL;
    }
    bool is_rational = !s->surface->is_polynomial;
    int n = desc->n_u * desc->n_v, width = is_rational ? 4 : 3;
    double *c = ARENA_ARRAY(a, double, width * n);
    for (int i = 0; i < n; i++) {
        Vec4 p = s->surface->p[i];
        c[width * i] = p.x, c[width * i + 1] = p.y, c[width * i + 2] = p.z;
        if (is_rational) c[width * i + 3] = p.w;
    }
    s->sisl = newSurf(desc->n_u, desc->n_v, desc->order_u, desc->order_v, (double *)desc->knots_u, (double *)desc->knots_v,
                      c, is_rational ? 2 : 1, 3, 1);
    return s;
}

static double depth_at(const SislSurface *s, const Ray *r, double *parameters)
{
    int span_u = 0, span_v = 0, status;
    double point[9], normal[3];
    s1421(s->sisl, 0, parameters, &span_u, &span_v, point, normal, &status);
    return vec_dot(vec_sub(vec(point[0], point[1], point[2]), r->origin), r->dir);
}

static double sisl_nearest(void *surface, const Ray *r, double t_max)
{
    SislSurface *s = surface;
    double origin[3] = { r->origin.x, r->origin.y, r->origin.z }, dir[3] = { r->dir.x, r->dir.y, r->dir.z };
    double *parameters = NULL, nearest = INFINITY;
    int n = 0, n_curves = 0, status;
    SISLIntcurve **curves = NULL;
    s1856(s->sisl, origin, dir, 3, 0, s->tolerance, &n, &parameters, &n_curves, &curves, &status);
    for (int i = 0; i < n; i++) {
        double t = depth_at(s, r, parameters + 2 * i);
        bool is_kept = !s->surface->trims || trim_keeps(s->surface->trims, parameters[2 * i], parameters[2 * i + 1]);
        if (is_kept && t > r->t_min && t < t_max && t < nearest) nearest = t;
    }
    if (n_curves > 0) freeIntcrvlist(curves, n_curves);
    free(parameters);
    return nearest;
}

static void sisl_release(void *surface)
{
    SislSurface *s = surface;
    freeSurf(s->sisl);
    arena_free(s->arena);
}

Engine *engine_sisl(const EngineInput *in)
{
    static const PeerType type = { sisl_make, sisl_nearest, sisl_release };
    return peer_new(in, &type);
}
