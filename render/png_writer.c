/* libpng reports by longjmp: each function here that calls it for more than a question is one that it may jump back into. */
#include "render/png_writer.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static const char *NO_MEMORY = "out of memory";

struct PngWriter {
    png_structp png;
    png_infop info;
    const char *error;
    size_t row_bytes;
    unsigned char *file;          /* what is compressed */
    size_t n, capacity;           /* bytes */
};

/* A message of libpng's own may lie on its stack: it is not passed on. */
_Noreturn static void on_error(png_structp png, png_const_charp message)
{
    PngWriter *w = png_get_error_ptr(png);
    (void)message;
    if (!w->error) w->error = "libpng cannot encode the picture";
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message) { (void)png, (void)message; }

static void keep_bytes(png_structp png, png_bytep data, size_t n)
{
    PngWriter *w = png_get_io_ptr(png);
    if (n > w->capacity - w->n) {
        size_t capacity = 2 * w->capacity + n;
        unsigned char *larger = realloc(w->file, capacity);
        if (!larger) w->error = NO_MEMORY, png_error(png, "");
        w->file = larger, w->capacity = capacity;
    }
    memcpy(w->file + w->n, data, n);
    w->n += n;
}

static void flush_bytes(png_structp png) { (void)png; }

/* What is computed has no noise: each pixel less its left neighbour is mostly runs, and runs are all that is looked for. A
 * fifth of the time of libpng's choice, for files larger by a fifth. */
static void choose_compression(png_structp png)
{
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_strategy(png, Z_RLE);
}

static void write_header(PngWriter *w, int width, int height, int bits, bool alpha)
{
    static const png_fixed_point FILE_GAMMA = 45455;   /* 1 / 2.2, in 1e-5: for readers that do not know sRGB */
    if (setjmp(png_jmpbuf(w->png))) return;
    png_set_IHDR(w->png, w->info, (png_uint_32)width, (png_uint_32)height, bits,
                 alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    choose_compression(w->png);
    png_set_gAMA_fixed(w->png, w->info, FILE_GAMMA);
    png_set_sRGB(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(w->png, w->info);
}

PngWriter *png_writer_new(int width, int height, int bits, bool alpha)
{
    PngWriter *w = calloc(1, sizeof *w);
    if (!w) return NULL;
    w->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, w, on_error, on_warning);
    w->info = w->png ? png_create_info_struct(w->png) : NULL;
    if (!w->info) {
        png_writer_free(w);
        return NULL;
    }
    w->row_bytes = (size_t)width * (alpha ? 4 : 3) * (size_t)(bits / 8);
    png_set_write_fn(w->png, w, keep_bytes, flush_bytes);
    write_header(w, width, height, bits, alpha);
    return w;
}

void png_writer_free(PngWriter *w)
{
    if (!w) return;
    png_destroy_write_struct(&w->png, &w->info);
    free(w->file);
    free(w);
}

void png_writer_rows(PngWriter *w, const unsigned char *rows, int n)
{
    if (w->error || setjmp(png_jmpbuf(w->png))) return;
    for (int y = 0; y < n; y++) png_write_row(w->png, rows + (size_t)y * w->row_bytes);
}

static void write_trailer(PngWriter *w)
{
    if (w->error || setjmp(png_jmpbuf(w->png))) return;
    png_write_end(w->png, NULL);
}

/* ---- the file ---- */

/* A device or a pipe cannot be replaced by a new file. */
static bool is_special_file(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode);
}

static const char *write_to(FILE *file, const PngWriter *w)
{
    return fwrite(w->file, 1, w->n, file) == w->n && fflush(file) == 0 ? NULL : strerror(errno);
}

static const char *write_and_close(FILE *file, const PngWriter *w)
{
    const char *error = write_to(file, w);
    if (fclose(file) != 0 && !error) error = strerror(errno);
    return error;
}

static const char *write_in_place(const char *path, const PngWriter *w)
{
    FILE *file = fopen(path, "wb");
    return file ? write_and_close(file, w) : strerror(errno);
}

/* As a new file would be: the umask decides, not the temporary file's caution. */
static void set_usual_mode(int fd)
{
    mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(fd, 0666 & ~mask);
}

static const char *write_and_rename(const char *path, char *temporary, const PngWriter *w)
{
    int fd = mkstemp(temporary);
    if (fd < 0) return strerror(errno);
    set_usual_mode(fd);
    FILE *file = fdopen(fd, "wb");
    const char *error = file ? write_and_close(file, w) : strerror(errno);
    if (!file) close(fd);
    if (!error && rename(temporary, path) != 0) error = strerror(errno);
    if (error) unlink(temporary);
    return error;
}

static const char *replace_file(const char *path, const PngWriter *w)
{
    char *temporary;
    if (asprintf(&temporary, "%s.XXXXXX", path) < 0) return NO_MEMORY;
    const char *error = write_and_rename(path, temporary, w);
    free(temporary);
    return error;
}

const char *png_writer_end(PngWriter *w, const char *path)
{
    write_trailer(w);
    if (w->error) return w->error;
    if (strcmp(path, "-") == 0) return write_to(stdout, w);
    return is_special_file(path) ? write_in_place(path, w) : replace_file(path, w);
}
