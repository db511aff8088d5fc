/* PNG in and out. libpng reports by longjmp: each of the two sides has one function that it may jump back into, which owns
 * what must be given back. */
#include "render/image.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static const char *NO_MEMORY = "out of memory";

/* Where libpng leaves word of what went wrong. A message of its own may lie on its stack: only known ones are passed on. */
typedef struct {
    FILE *file;
    const char *error;
    Arena *arena;                /* reading: for the text; NULL: writing */
} PngFile;

_Noreturn static void on_error(png_structp png, png_const_charp message)
{
    PngFile *f = png_get_error_ptr(png);
    if (!f->error) f->error = f->arena ? arena_strdup(f->arena, message) : "libpng cannot encode the picture";
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) { (void)png, (void)message; }

/* ---- writing ---- */

static void write_bytes(png_structp png, png_bytep data, size_t n)
{
    PngFile *f = png_get_io_ptr(png);
    if (fwrite(data, 1, n, f->file) == n) return;
    f->error = strerror(errno);
    png_error(png, "");
}

static void flush_bytes(png_structp png) { (void)png; }

typedef struct {
    const Film *film;
    const FilmCurve *curve;
    int bits;
    bool alpha;
} Picture;

/* What is computed has no noise: each pixel less its left neighbour is mostly runs, and runs are all that is looked for. A
 * fifth of the time of libpng's choice, for files larger by a fifth. */
static void choose_compression(png_structp png)
{
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_strategy(png, Z_RLE);
}

static void write_header(png_structp png, png_infop info, const Picture *p)
{
    static const png_fixed_point FILE_GAMMA = 45455;   /* 1 / 2.2, in 1e-5: for readers that do not know sRGB */
    png_set_IHDR(png, info, (png_uint_32)p->film->width, (png_uint_32)p->film->height, p->bits,
                 p->alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    choose_compression(png);
    png_set_gAMA_fixed(png, info, FILE_GAMMA);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
}

/* Packs samples as the file has them: bytes, or big-endian pairs, in place of the samples read. */
static void pack(const uint16_t *samples, int n, int bits, png_bytep out)
{
    for (int i = 0; i < n; i++) {
        if (bits == 16) *out++ = (png_byte)(samples[i] >> 8);
        *out++ = (png_byte)samples[i];
    }
}

static bool encode(png_structp png, png_infop info, const Picture *p, uint16_t *samples, png_bytep bytes)
{
    if (setjmp(png_jmpbuf(png))) return false;
    write_header(png, info, p);
    for (int y = 0; y < p->film->height; y++) {
        int n = film_row(p->film, y, p->curve, p->alpha, samples);
        pack(samples, n, p->bits, bytes);
        png_write_row(png, bytes);
    }
    png_write_end(png, NULL);
    return true;
}

static const char *write_picture(FILE *file, const Picture *p)
{
    PngFile f = { .file = file };
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &f, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    uint16_t *samples = calloc((size_t)p->film->width, 4 * sizeof *samples);
    png_bytep bytes = calloc((size_t)p->film->width, 4 * sizeof *samples);
    if (info && samples && bytes) {
        png_set_write_fn(png, &f, write_bytes, flush_bytes);
        if (encode(png, info, p, samples, bytes)) f.error = NULL;
    } else {
        f.error = NO_MEMORY;
    }
    free(bytes);
    free(samples);
    png_destroy_write_struct(&png, &info);
    return f.error;
}

/* A device or a pipe cannot be replaced by a new file. */
static bool is_special_file(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode);
}

static const char *write_and_close(FILE *file, const Picture *p)
{
    const char *error = write_picture(file, p);
    if (fclose(file) != 0 && !error) error = strerror(errno);
    return error;
}

static const char *write_in_place(const char *path, const Picture *p)
{
    FILE *file = fopen(path, "wb");
    return file ? write_and_close(file, p) : strerror(errno);
}

/* As a new file would be: the umask decides, not the temporary file's caution. */
static void set_usual_mode(int fd)
{
    mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(fd, 0666 & ~mask);
}

static const char *write_and_rename(const char *path, char *temporary, const Picture *p)
{
    int fd = mkstemp(temporary);
    if (fd < 0) return strerror(errno);
    set_usual_mode(fd);
    FILE *file = fdopen(fd, "wb");
    const char *error = file ? write_and_close(file, p) : strerror(errno);
    if (!file) close(fd);
    if (!error && rename(temporary, path) != 0) error = strerror(errno);
    if (error) unlink(temporary);
    return error;
}

const char *image_write_png(const char *path, const Film *f, GammaKind gamma, double gamma_power, int bits, bool alpha)
{
    FilmCurve curve = film_curve(gamma, gamma_power, bits == 16 ? 65535 : 255);
    Picture p = { f, &curve, bits, alpha };
    if (strcmp(path, "-") == 0) {
        const char *error = write_picture(stdout, &p);
        return !error && fflush(stdout) != 0 ? strerror(errno) : error;
    }
    if (is_special_file(path)) return write_in_place(path, &p);
    char *temporary;
    if (asprintf(&temporary, "%s.XXXXXX", path) < 0) return NO_MEMORY;
    const char *error = write_and_rename(path, temporary, &p);
    free(temporary);
    return error;
}

/* ---- reading ---- */

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
    PngFile f = { .file = file, .arena = a };
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &f, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    Image *image = NULL;
    if (info) {
        png_init_io(png, file);
        image = decode(png, info, a);
        if (!image) *error = f.error;
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
