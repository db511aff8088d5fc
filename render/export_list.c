#include "render/export_list.h"

typedef struct {
    ExportList *list;
    bool (*is_mesh)(const Shape *s);
} Walk;

static size_t slot_of(const ExportList *l, const Shape *s)
{
    size_t i = ((uintptr_t)s >> 6) * 0x9E3779B97F4A7C15u >> 20 & (l->n_slots - 1);
    while (l->slots[i] && l->shapes[l->slots[i] - 1].shape != s) i = (i + 1) & (l->n_slots - 1);
    return i;
}

ExportShape *export_find(const ExportList *l, const Shape *s)
{
    size_t i = l->n_slots ? slot_of(l, s) : 0;
    return l->n_slots && l->slots[i] ? &l->shapes[l->slots[i] - 1] : NULL;
}

static void grow(ExportList *l)
{
    l->n_slots = l->n_slots ? 2 * l->n_slots : 256;
    l->slots = arena_zalloc(l->arena, l->n_slots, sizeof *l->slots);
    for (size_t i = 0; i < l->n; i++) l->slots[slot_of(l, l->shapes[i].shape)] = (int)i + 1;
}

static ExportShape *add(ExportList *l, const Shape *s)
{
    if (2 * l->n >= l->n_slots) grow(l);
    ARENA_PUSH(l->arena, l->shapes, l->n, l->capacity) = (ExportShape){ .shape = s };
    l->slots[slot_of(l, s)] = (int)l->n;
    return &l->shapes[l->n - 1];
}

/* The largest singular value: the root of the largest eigenvalue of the symmetric A A', by its closed form ([Smi61]). */
static double stretch(const Affine *a)
{
    double s[3][3], spread = 0, off = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) s[i][j] = a->m[i][0] * a->m[j][0] + a->m[i][1] * a->m[j][1] + a->m[i][2] * a->m[j][2];
    double mean = (s[0][0] + s[1][1] + s[2][2]) / 3;
    for (int i = 0; i < 3; i++) spread += (s[i][i] - mean) * (s[i][i] - mean), off += s[i][(i + 1) % 3] * s[i][(i + 1) % 3];
    double p = sqrt((spread + 2 * off) / 6);
    if (!(p > 0)) return sqrt(mean);
    double b[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) b[i][j] = (s[i][j] - (i == j ? mean : 0)) / p;
    double half = (b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1]) - b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0])
                   + b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0])) / 2;
    return sqrt(mean + 2 * p * cos(acos(fmax(-1, fmin(1, half))) / 3));
}

static void walk(Walk *w, const Shape *s, const Xform *placement)
{
    Shape *const *parts;
    if (shape_is_object(s)) {
        const Object *o = (const Object *)s;
        Xform within = xform_then(o->placement, *placement);
        walk(w, o->child, &within);
        return;
    }
    uint32_t n = s->type->parts ? s->type->parts(s, &parts) : 0;
    for (uint32_t i = 0; i < n; i++) walk(w, parts[i], placement);
    ExportShape *e = export_find(w->list, s);
    if (!e) e = add(w->list, s);
    e->n_uses++;
    e->stretch = fmax(e->stretch, stretch(&placement->forward));
    if (!s->type->parts && w->is_mesh(s))
        w->list->meshes = box_union(w->list->meshes, xform_box(placement, shape_bounds(s)));
}

ExportList export_list(Arena *a, const Scene *s, bool (*is_mesh)(const Shape *s))
{
    ExportList list = { .arena = a, .meshes = box_empty() };
    Walk w = { &list, is_mesh };
    Xform world = xform_identity();
    for (size_t i = 0; i < s->n_objects; i++) walk(&w, &s->objects[i]->shape, &world);
    return list;
}

double export_default_error(const ExportList *l)
{
    double diagonal = box_is_finite(l->meshes) ? box_diagonal(l->meshes) : 0;
    return diagonal > 0 ? diagonal / 2000 : 1e-3;
}
