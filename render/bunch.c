/* Bunches of rays: their lanes, and shapes that do not know them. */
#include "render/bunch.h"

void bunch_set_lanes(RayBunch *b)
{
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        const Ray *r = &b->ray[int_min(i, b->n - 1)];
        b->origin.x[i] = r->origin.x, b->origin.y[i] = r->origin.y, b->origin.z[i] = r->origin.z;
        b->dir.x[i] = r->dir.x, b->dir.y[i] = r->dir.y, b->dir.z[i] = r->dir.z;
        b->t_min[i] = r->t_min;
    }
    bunch_forget(b);
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
