/* The teapot, as the parser reads it: the control points are found again from points of the patches. */
#include "tests/bench/bench.h"

#include "parser/parser.h"

enum { MAX_PATCHES = 64 };

typedef struct { const Shape *patches[MAX_PATCHES]; int n; } Found;

/* All NURBS below a shape; nothing of the teapot is moved. */
static void find_patches(const Shape *s, Found *found)
{
    NurbsInfo info;
    if (shape_is_object(s)) s = ((const Object *)s)->child;
    if (shape_is_object(s)) {
        find_patches(s, found);
    } else if (nurbs_shape_info(s, &info)) {
        if (found->n < MAX_PATCHES) found->patches[found->n++] = s;
    } else if (s->type->parts) {
        Shape *const *parts;
        uint32_t n = s->type->parts(s, &parts);
        for (uint32_t i = 0; i < n; i++) find_patches(parts[i], found);
    }
}

/* Newell's numbers and their products have at most nine decimals: rounded to these, borders are shared bit for bit. */
static double decimal(double x) { return round(x * 1e9) / 1e9; }

static Vec3 patch_at(const void *context, double u, double v)
{
    Vec3 p, s_u, s_v;
    nurbs_shape_point(context, u, v, &p, &s_u, &s_v);
    return p;
}

bool model_teapot(Arena *a, Model *m)
{
    Arena *scratch = arena_new();
    Scene *scene = scene_new(scratch);
    Diag *diag = diag_new(scratch);
    ParseSummary summary = { 0 };
    static const char *const folders[] = { BENCH_SCENES };
    ParseOptions options = { .library_paths = folders, .n_library_paths = 1, .image_width = 512, .image_height = 512,
                             .quality = 9 };
    Found found = { .n = 0 };
    bool ok = parse_scene(BENCH_SCENES "/teapot.pov", &options, scratch, diag, scene, &summary);
    diag_print(diag, stderr);
    for (size_t i = 0; ok && i < scene->n_objects; i++) find_patches(&scene->objects[i]->shape, &found);
    SurfaceDesc *s = ARENA_ARRAY(a, SurfaceDesc, found.n);
    for (int i = 0; i < found.n; i++) {
        s[i] = bicubic_through(a, patch_at, found.patches[i]);
        Vec4 *p = (Vec4 *)s[i].points;
        for (int k = 0; k < 16; k++) p[k] = vec4(decimal(p[k].x), decimal(p[k].y), decimal(p[k].z), 1);
    }
    m->surfaces = s, m->n = found.n;
    arena_free(scratch);
    return found.n > 0;
}
