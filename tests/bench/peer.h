/* Peers that know one surface at a time: the tree of boxes over the surfaces is trimray's, so that fields are not held
 * against them. */
#ifndef TRIMRAY_BENCH_PEER_H
#define TRIMRAY_BENCH_PEER_H

#include "tests/bench/bench.h"

/* What they call exact enough, of the diagonal. */
#define PEER_TOLERANCE 1e-7

typedef struct {
    void *(*make)(const SurfaceDesc *s, double tolerance);    /* NULL: it cannot be made */
    double (*nearest)(void *surface, const Ray *r, double t_max);   /* in (r->t_min, t_max); INFINITY: none */
    void (*release)(void *surface);
} PeerType;

Engine *peer_new(const EngineInput *in, const PeerType *type);

#endif
