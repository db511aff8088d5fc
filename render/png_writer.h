/* A PNG file in the making: rows are compressed as they come and held in memory, the file is written when all of them are
 * there. */
#ifndef TRIMRAY_PNG_WRITER_H
#define TRIMRAY_PNG_WRITER_H

#include <stdbool.h>

typedef struct PngWriter PngWriter;

PngWriter *png_writer_new(int width, int height, int bits, bool alpha);   /* NULL: no memory. What else fails is told at the end */
void png_writer_free(PngWriter *w);

/* The next n rows, as the file has them: bytes, or big-endian pairs of bytes, 3 or 4 samples a pixel. */
void png_writer_rows(PngWriter *w, const unsigned char *rows, int n);

/* After the last row. To a temporary file beside `path`, renamed when complete. path "-" is the standard output; devices
 * and pipes are written in place. Returns NULL, or what went wrong (static or errno text). */
const char *png_writer_end(PngWriter *w, const char *path);

#endif
