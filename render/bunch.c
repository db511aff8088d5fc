/* Bunches of rays: their lanes, and shapes that do not know them. */
#include "render/bunch.h"

EVERY_X86
void bunch_set_lanes(RayBunch *b)
{
    const void *ray[BUNCH_WIDTH];
    for (int i = 0; i < BUNCH_WIDTH; i++) ray[i] = &b->ray[int_min(i, b->n - 1)];
    b->origin = vec8_gather(ray, offsetof(Ray, origin));
    b->dir = vec8_gather(ray, offsetof(Ray, dir));
    b->t_min = v8d_gather(ray, offsetof(Ray, t_min));
    b->has_frames = b->has_slabs = false;
}

void bunch_set_rays(RayBunch *b)
{
    for (int i = 0; i < b->n; i++) {
        Ray *r = &b->ray[i];
        r->origin.x = b->origin.x[i], r->origin.y = b->origin.y[i], r->origin.z = b->origin.z[i];
        r->dir.x = b->dir.x[i], r->dir.y = b->dir.y[i], r->dir.z = b->dir.z[i];
        r->t_min = b->t_min[i];
    }
    b->has_frames = b->has_slabs = false;
}

void bunch_fill(RayBunch *b, Lanes lanes)
{
    const Ray *any = &b->ray[__builtin_ctz(lanes)];
    for (Lanes empty = bunch_all(b) & ~lanes; empty; ) b->ray[lanes_next(&empty)] = *any;
    bunch_set_lanes(b);
}

static Lanes hit_one_by_one(const Shape *s, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    Lanes hit = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        bunch_begin(b, i, t);
        if (s->type->hit(s, &b->ray[i], &best[i], t)) hit |= 1u << i;
        bunch_end(b, i, t);
    }
    return hit;
}

static Lanes blocks_one_by_one(const Shape *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    Lanes blocked = 0;
    while (lanes) {
        int i = lanes_next(&lanes);
        bunch_begin(b, i, t);
        if (shape_blocks(s, &b->ray[i], t_max[i], t)) blocked |= 1u << i;
        bunch_end(b, i, t);
    }
    return blocked;
}

Lanes shape_hit_bunch(const Shape *s, RayBunch *b, Lanes lanes, Hit best[], Trace *t)
{
    shape_be_prepared(s, t);
    return (s->type->hit_bunch ? s->type->hit_bunch : hit_one_by_one)(s, b, lanes, best, t);
}

Lanes shape_blocks_bunch(const Shape *s, RayBunch *b, Lanes lanes, const double t_max[], Trace *t)
{
    shape_be_prepared(s, t);
    return (s->type->blocks_bunch ? s->type->blocks_bunch : blocks_one_by_one)(s, b, lanes, t_max, t);
}
