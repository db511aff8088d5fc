/* Source texts: reading them, finding include files, keeping each once. */
#ifndef TRIMRAY_PARSER_SOURCE_H
#define TRIMRAY_PARSER_SOURCE_H

#include "parser/parser.h"

typedef struct SourceFile { SourceText text; const char *path; struct SourceFile *next; } SourceFile;
typedef struct { SourceFile *first; size_t n_files, n_bytes; } Sources;   /* the files read so far */

/* The text of the file at `path`, called `name` in messages; NULL: *error says why. A file is read once. */
const SourceText *source_open(Sources *s, Arena *a, const char *path, const char *name, const char **error);

/* The file that #include "name" means: `name`, or else name.inc, in the current folder, the library paths, POV-Ray's own
 * include folder. NULL: *error says why. */
const SourceText *source_include(Sources *s, Arena *a, const ParseOptions *options, const char *name, const char **error);

/* The path of a file that a scene names, searched in the same folders; NULL: there is none. */
const char *source_find(Arena *a, const ParseOptions *options, const char *name);

#endif
