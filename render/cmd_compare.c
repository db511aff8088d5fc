/* trimray compare A.png B.png: how they differ, and whether by more than is allowed. */
#include "render/commands.h"
#include "render/compare.h"

static const Image *read_picture(Arena *a, const char *path, int *status)
{
    const char *wrong;
    const Image *p = image_read_png(a, path, &wrong);
    if (!p) *status = run_fail(EXIT_FILE, "cannot read %s: %s", path, wrong);
    return p;
}

static void print(const Comparison *c, const Options *o, bool is_within)
{
    double n = (double)c->n_pixels;
    printf("pixels       %zu\nrmse         %.9g\n", c->n_pixels, c->rmse);
    printf("psnr         %.4f\nssim         %.9f\n", c->psnr, c->ssim);
    printf("largest      %.6g (%.6g/255) at column %d, row %d\n", c->largest, c->largest * 255, c->largest_x + 1,
           c->largest_y + 1);
    printf("over 1/255   %zu (%.4f %%)\n", c->n_over, 100 * (double)c->n_over / n);
    printf("within %g/255: %.4f %% of the pixels: %s\n", o->within, 100 * (n - (double)c->n_beyond) / n,
           is_within ? "yes" : "no");
}

static int write_difference(const Options *o, const Image *a, const Image *b)
{
    Film *f = compare_picture(a, b, o->within);
    const char *wrong = f ? image_write_png(o->diff, f, GAMMA_NONE, 0, 8, false) : "no memory";
    film_free(f);
    return wrong ? run_fail(EXIT_FILE, "cannot write %s: %s", o->diff, wrong) : EXIT_DONE;
}

static int compare(const Options *o, Arena *arena, const Image *a, const Image *b)
{
    if (a->width != b->width || a->height != b->height)
        return run_fail(EXIT_INPUT, "the pictures differ in size: %d x %d and %d x %d", a->width, a->height, b->width,
                        b->height);
    Comparison c = compare_images(arena, a, b, o->within);
    bool is_within = (double)(c.n_pixels - c.n_beyond) >= o->share * (double)c.n_pixels;
    if (!o->is_quiet) print(&c, o, is_within);
    int status = o->diff ? write_difference(o, a, b) : EXIT_DONE;
    return status != EXIT_DONE ? status : is_within ? EXIT_DONE : EXIT_INPUT;
}

int cmd_compare(const Options *o)
{
    Arena *arena = arena_new();
    int status = EXIT_DONE;
    const Image *a = read_picture(arena, o->input, &status);
    const Image *b = a ? read_picture(arena, o->other, &status) : NULL;
    if (b) status = compare(o, arena, a, b);
    arena_free(arena);
    return status;
}
