/* Lists of interiors: POV-Ray's rules for entering, leaving and overlapping. */
#include "render/media.h"

#include "render/hit.h"

#include <string.h>

const Medium media_of_camera = { 0 };

static Medium medium_of_hit(const Hit *h)
{
    Medium m = { .interior = hit_interior(h) };
    int first = h->n_objects - 1;
    if (m.interior)
        for (first = 0; first < h->n_objects - 1 && h->objects[first]->interior != m.interior;) first++;
    m.n_path = h->n_objects - first;
    for (int i = 0; i < m.n_path; i++) {
        m.path[i] = h->objects[first + i];
        m.is_hollow |= m.path[i]->is_hollow;
    }
    return m;
}

static bool is_same(const Medium *a, const Medium *b)
{
    return a->n_path == b->n_path && memcmp(a->path, b->path, (size_t)a->n_path * sizeof *a->path) == 0;
}

static const Medium *find(const Medium *list, const Medium *m)
{
    while (list && !is_same(list, m)) list = list->outer;
    return list;
}

static const Medium *without(const Medium *list, const Medium *gone, Arena *arena)
{
    if (list == gone) return gone->outer;
    Medium *copy = arena_copy(arena, list, 1, sizeof *list);
    copy->outer = without(list->outer, gone, arena);
    return copy;
}

static double ior_of(const Medium *m) { return m && m->interior ? m->interior->ior : 1; }

Crossing media_cross(Surroundings *around, const Medium *before, const Hit *h)
{
    before = media_known(around, before);
    Medium m = medium_of_hit(h);
    const Medium *found = find(before, &m);
    if (!found) {
        m.outer = before;
        double ior = ior_of(&m), last = ior_of(before);
        return (Crossing){ arena_copy(around->scratch, &m, 1, sizeof m), false, last / ior, ior / last };
    }
    Crossing c = { without(before, found, around->scratch), true, 1, 1 };
    bool is_alone = !before->outer;
    if (found == before) c.bend = ior_of(found) / ior_of(found->outer);
    c.ior_ratio = (is_alone ? 1 : ior_of(before)) / ior_of(found);
    return c;
}

/* ---- what contains the camera ---- */

static const Medium *enclosing(const Object *o, const Medium *outer, Arena *arena)
{
    Medium m = { .outer = outer, .is_hollow = o->is_hollow };
    const Object *chain[HIT_MAX_OBJECTS] = { o };   /* from the outside in */
    int n = 1;
    while (!chain[n - 1]->interior && n < HIT_MAX_OBJECTS && shape_is_object(chain[n - 1]->child)) {
        chain[n] = (const Object *)chain[n - 1]->child;
        m.is_hollow |= chain[n++]->is_hollow;
    }
    m.interior = chain[n - 1]->interior;
    if (!m.interior) n = 1;
    m.n_path = n;
    for (int i = 0; i < n; i++) m.path[i] = chain[n - 1 - i];
    return arena_copy(arena, &m, 1, sizeof m);
}

const Medium *media_known(Surroundings *around, const Medium *media)
{
    if (media != MEDIA_OF_CAMERA) return media;
    if (around->is_known) return around->at_camera;
    const Scene *s = around->scene;
    around->at_camera = NULL;
    for (size_t i = 0; i < s->n_objects; i++) {
        const Shape *shape = &s->objects[i]->shape;
        if (shape->type->inside && shape->type->inside(shape, around->camera))
            around->at_camera = enclosing(s->objects[i], around->at_camera, around->scratch);
    }
    around->is_known = true;
    return around->at_camera;
}

MediaScope media_open(const Surroundings *around)
{
    return (MediaScope){ arena_mark(around->scratch), around->is_known };
}

void media_close(Surroundings *around, MediaScope scope)
{
    arena_reset(around->scratch, scope.mark);
    around->is_known = scope.is_known;
}

/* ---- light within ---- */

bool interior_fades(const Interior *i) { return i && i->fade_distance != 0; }

static double faded(double color, double share) { return color + (1 - color) * share; }

Rgb interior_fade(const Interior *i, double depth)
{
    static const double EXPONENTIAL_FROM = 1000;   /* POV-Ray: a fade_power from here on means Beer's law */
    if (!interior_fades(i)) return rgb(1, 1, 1);
    double x = depth / i->fade_distance;
    Rgb c = color_rgb(i->fade_color);
    if (i->fade_power >= EXPONENTIAL_FROM) return rgb(exp((c.r - 1) * x), exp((c.g - 1) * x), exp((c.b - 1) * x));
    double share = 1 / (1 + pow(x, i->fade_power));
    return rgb(faded(c.r, share), faded(c.g, share), faded(c.b, share));
}

bool media_let_fog_in(const Medium *list)
{
    for (; list; list = list->outer)
        if (!list->is_hollow) return false;
    return true;
}
