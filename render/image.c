/* A film to a PNG file, and PNG files in. libpng reports by longjmp: decode is what it may jump back into. */
#include "render/image.h"

#include "render/picture.h"

#include <errno.h>
#include <png.h>
#include <string.h>

static const char *NO_MEMORY = "out of memory";

const char *image_write_png(const char *path, const Film *f, GammaKind gamma, double gamma_power, int bits, bool alpha)
{
    PictureFormat format = { f->width, f->height, 0, 0, f->width, f->height, gamma, gamma_power, bits, alpha };
    Picture *p = picture_new(&format);
    if (!p) return NO_MEMORY;
    picture_add(p, 0, 0, f->width, f->height, f->pixels);
    const char *error = picture_write(p, path);
    picture_free(p);
    return error;
}

/* ---- reading ---- */

/* Where libpng leaves word of what went wrong. */
typedef struct {
    const char *error;
    Arena *arena;                /* for the text, which may lie on libpng's stack */
} PngReport;

_Noreturn static void on_error(png_structp png, png_const_charp message)
{
    PngReport *r = png_get_error_ptr(png);
    if (!r->error) r->error = arena_strdup(r->arena, message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) { (void)png, (void)message; }

static void read_gamma(png_structp png, png_infop info, Image *image)
{
    int intent;
    double gamma;
    if (png_get_sRGB(png, info, &intent)) image->has_gamma = true, image->file_gamma = -1;
    else if (png_get_gAMA(png, info, &gamma)) image->has_gamma = true, image->file_gamma = gamma;
}

/* Every kind of PNG becomes RGBA with 16 bits in the machine's order. */
static void ask_for_rgba16(png_structp png)
{
    static const uint16_t one = 1;
    png_set_expand_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 65535, PNG_FILLER_AFTER);
    if (*(const unsigned char *)&one) png_set_swap(png);
}

static Image *decode(png_structp png, png_infop info, Arena *a)
{
    if (setjmp(png_jmpbuf(png))) return NULL;
    png_read_info(png, info);
    Image *image = ARENA_NEW(a, Image);
    image->width = (int)png_get_image_width(png, info);
    image->height = (int)png_get_image_height(png, info);
    image->bits = png_get_bit_depth(png, info);
    image->has_alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) || png_get_valid(png, info, PNG_INFO_tRNS);
    read_gamma(png, info, image);
    ask_for_rgba16(png);
    (void)png_set_interlace_handling(png);
    png_read_update_info(png, info);
    size_t row = 4 * (size_t)image->width;
    image->rgba = ARENA_ARRAY(a, uint16_t, row * (size_t)image->height);
    png_bytepp rows = ARENA_ARRAY(a, png_bytep, image->height);
    for (int y = 0; y < image->height; y++) rows[y] = (png_bytep)(image->rgba + row * (size_t)y);
    png_read_image(png, rows);
    png_read_end(png, NULL);
    return image;
}

static Image *read_picture(Arena *a, FILE *file, const char **error)
{
    PngReport report = { .arena = a };
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &report, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    Image *image = NULL;
    if (info) {
        png_init_io(png, file);
        image = decode(png, info, a);
        if (!image) *error = report.error;
    } else {
        *error = NO_MEMORY;
    }
    png_destroy_read_struct(&png, &info, NULL);
    return image;
}

Image *image_read_png(Arena *a, const char *path, const char **error)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        *error = strerror(errno);
        return NULL;
    }
    Image *image = read_picture(a, file, error);
    fclose(file);
    return image;
}
