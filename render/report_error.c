/* The error of geometry: what camera rays through the middles of the pixels meet, beside what they meet in the reference. */
#include "render/report.h"

#include "render/hash.h"
#include "render/hit.h"

#include <stdlib.h>

ReportHit *report_hits(Arena *a, const Scene *s, int width, int height)
{
    ReportHit *hits = ARENA_ARRAY(a, ReportHit, (size_t)width * (size_t)height);
    Trace t = { .scratch = arena_new() };
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++) {
        Hit h;
        Attributes at;
        Ray r = camera_ray(&s->camera, (double)(i % (size_t)width), (double)(i / (size_t)width), width, height);
        t.seed = hash_mix(i);
        hits[i] = (ReportHit){ .t = INFINITY, .index = -1 };
        if (!scene_hit(s, &r, RAY_CAMERA, &h, &t)) continue;
        hit_attributes(&h, &r, &at);
        hits[i] = (ReportHit){ h.t, at.shading_normal, h.index };
    }
    arena_free(t.scratch);
    return hits;
}

typedef struct { Arena *arena; bool *is_surface; size_t n, capacity; } Listing;

static void list(Listing *l, const Shape *s)
{
    Shape *const *parts;
    NurbsInfo info;
    uint32_t n = s->type->parts ? s->type->parts(s, &parts) : 0;
    if (!s->type->parts) ARENA_PUSH(l->arena, l->is_surface, l->n, l->capacity) = nurbs_shape_info(s, &info);
    for (uint32_t i = 0; i < n; i++) list(l, parts[i]);
}

bool *report_surfaces(Arena *a, const Scene *s, size_t *n)
{
    Listing l = { .arena = a };
    for (size_t i = 0; i < s->n_objects; i++) list(&l, &s->objects[i]->shape);
    *n = l.n;
    return l.is_surface;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median, 99 % and largest of n values, which are sorted. */
static void spread(double *values, size_t n, double *out)
{
    qsort(values, n, sizeof *values, ascending);
    const double share[] = { .5, .99, 1 };
    for (int i = 0; i < 3; i++) out[i] = n > 0 ? values[(size_t)(share[i] * (double)(n - 1))] : NAN;
}

/* In degrees, of lines: whichever way the normals point. */
static double angle(Vec3 a, Vec3 b)
{
    return atan2(vec_length(vec_cross(a, b)), fabs(vec_dot(a, b))) * (180 / 3.14159265358979323846);
}

void report_compare_hits(Arena *a, const ReportHit *truth, const ReportHit *found, size_t n_rays, const bool *is_surface,
                         double size, double number[])
{
    double *depths = ARENA_ARRAY(a, double, n_rays + 1), *angles = ARENA_ARRAY(a, double, n_rays + 1);
    size_t n = 0, seen = 0, missed = 0, invented = 0, other = 0;
    for (size_t i = 0; i < n_rays; i++) {
        const ReportHit *p = &truth[i], *q = &found[i];
        bool is_there = p->index >= 0 && is_surface[p->index], is_found = q->index >= 0 && is_surface[q->index];
        seen += is_there, missed += is_there && !is_found, invented += is_found && !is_there;
        other += is_there && is_found && p->index != q->index;
        if (!is_there || p->index != q->index) continue;
        depths[n] = fabs(q->t - p->t) / size;
        angles[n++] = angle(p->normal, q->normal);
    }
    number[REPORT_SEEN] = (double)seen, number[REPORT_MISSED] = (double)missed;
    number[REPORT_FALSE] = (double)invented, number[REPORT_OTHER] = (double)other;
    number[REPORT_COVERAGE] = seen ? (double)(missed + invented + other) / (double)seen : NAN;
    spread(depths, n, &number[REPORT_DEPTH_MEDIAN]);
    spread(angles, n, &number[REPORT_NORMAL_MEDIAN]);
}
