/* Whole files in and out, for the commands. "-" is the standard input or output. */
#ifndef TRIMRAY_FILES_H
#define TRIMRAY_FILES_H

#include "render/arena.h"

/* The content and a '\0' after it; NULL: errno says why. */
char *file_read(const char *path, Arena *a, size_t *n_bytes);

/* Replaces the file in one step (a temporary file beside it, renamed), so that nobody ever sees half of it; what is not a
 * regular file (a pipe, /dev/null) is written to directly. False: errno says why. */
bool file_write(const char *path, Arena *a, const void *data, size_t n_bytes);

bool file_is_text(const char *path);           /* by its name: "-" or something.txt */

/* 0 if a file can be made at this path, else an errno: asked before long work is begun. */
int file_cannot_write(const char *path, Arena *a);

#endif
