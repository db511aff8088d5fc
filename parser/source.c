/* Reading scene files into the arena. Only regular files: a pipe or a device could go on for ever. */
#include "parser/source.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* Where Debian and POV-Ray's own installation put the standard include files, the version before the link. */
static const char *const system_folders[] = { "/usr/share/povray-3.7/include", "/usr/local/share/povray-3.7/include",
                                              "/usr/share/povray/include" };
enum { N_SYSTEM_FOLDERS = sizeof system_folders / sizeof *system_folders };

static bool is_regular(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* The whole of an open file, then '\0'; NULL with errno. */
static char *read_stream(FILE *f, Arena *a, size_t size)
{
    char *text = arena_alloc(a, size + 1, 1);
    size_t n = fread(text, 1, size, f);
    if (ferror(f) || n != size) return NULL;
    text[n] = '\0';
    return text;
}

static char *read_file(Arena *a, const char *path, size_t *size, const char **error)
{
    struct stat status;
    FILE *f = fopen(path, "rb");
    char *text = NULL;
    errno = f ? 0 : errno;
    if (f && fstat(fileno(f), &status) == 0) {
        *size = (size_t)status.st_size;
        if (S_ISREG(status.st_mode)) text = read_stream(f, a, *size);
        else errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    }
    if (!text) *error = errno ? strerror(errno) : "it changed while it was read";
    if (f) fclose(f);
    return text;
}

const SourceText *source_open(Sources *s, Arena *a, const char *path, const char *name, const char **error)
{
    for (SourceFile *known = s->first; known; known = known->next) {
        if (strcmp(known->path, path) == 0) return &known->text;
    }
    size_t size = 0;
    char *text = read_file(a, path, &size, error);
    if (!text) return NULL;
    SourceFile *file = ARENA_NEW(a, SourceFile);
    file->text = (SourceText){ arena_strdup(a, name), text, size };
    file->path = arena_strdup(a, path);
    file->next = s->first;
    s->first = file;
    s->n_files++, s->n_bytes += size;
    return &file->text;
}

/* folder/name or folder/name.inc, if there is such a file; folder NULL: the current one. */
static const char *find_in(Arena *a, const char *folder, const char *name)
{
    static const char *const endings[] = { "", ".inc" };
    for (int i = 0; i < 2; i++) {
        const char *path = folder ? arena_printf(a, "%s/%s%s", folder, name, endings[i])
                                  : arena_printf(a, "%s%s", name, endings[i]);
        if (is_regular(path)) return path;
    }
    return NULL;
}

const char *source_find(Arena *a, const ParseOptions *options, const char *name)
{
    const char *path = find_in(a, NULL, name);
    if (name[0] == '/') return path;
    for (int i = 0; !path && i < options->n_library_paths; i++) path = find_in(a, options->library_paths[i], name);
    for (int i = 0; !path && i < N_SYSTEM_FOLDERS; i++) path = find_in(a, system_folders[i], name);
    return path;
}

const SourceText *source_include(Sources *s, Arena *a, const ParseOptions *options, const char *name, const char **error)
{
    const char *path = source_find(a, options, name);
    if (!path) return *error = "there is no such file", NULL;
    return source_open(s, a, path, path, error);
}
