#include "render/files.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static bool is_standard(const char *path) { return strcmp(path, "-") == 0; }

static char *read_all(FILE *in, Arena *a, size_t *n_bytes)
{
    size_t capacity = 1 << 16, n = 0;
    char *text = ARENA_ARRAY(a, char, capacity);
    for (size_t got; (got = fread(text + n, 1, capacity - n - 1, in)) > 0;) {
        n += got;
        if (n + 1 < capacity) continue;
        char *larger = ARENA_ARRAY(a, char, 2 * capacity);
        memcpy(larger, text, n);
        text = larger, capacity *= 2;
    }
    text[n] = '\0', *n_bytes = n;
    return ferror(in) ? NULL : text;
}

char *file_read(const char *path, Arena *a, size_t *n_bytes)
{
    if (is_standard(path)) return read_all(stdin, a, n_bytes);
    FILE *in = fopen(path, "rb");
    if (!in) return NULL;
    char *text = read_all(in, a, n_bytes);
    int reason = errno;
    fclose(in);
    errno = reason;
    return text;
}

static bool write_to(FILE *out, const void *data, size_t n_bytes, bool is_ours)
{
    bool is_written = fwrite(data, 1, n_bytes, out) == n_bytes && fflush(out) == 0;
    int reason = errno;
    bool is_closed = !is_ours || fclose(out) == 0;
    if (!is_written) errno = reason;
    return is_written && is_closed;
}

static bool write_directly(const char *path, const void *data, size_t n_bytes)
{
    FILE *out = fopen(path, "wb");
    return out && write_to(out, data, n_bytes, true);
}

bool file_write(const char *path, Arena *a, const void *data, size_t n_bytes)
{
    if (is_standard(path)) return write_to(stdout, data, n_bytes, false);
    struct stat there;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode)) return write_directly(path, data, n_bytes);
    const char *temporary = arena_printf(a, "%s.part%ld", path, (long)getpid());
    if (write_directly(temporary, data, n_bytes) && rename(temporary, path) == 0) return true;
    int reason = errno;
    unlink(temporary);
    errno = reason;
    return false;
}

bool file_is_text(const char *path)
{
    size_t n = strlen(path);
    return is_standard(path) || (n >= 4 && strcasecmp(path + n - 4, ".txt") == 0);
}

int file_cannot_write(const char *path, Arena *a)
{
    if (is_standard(path)) return 0;
    struct stat there;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return S_ISDIR(there.st_mode) ? EISDIR : access(path, W_OK) == 0 ? 0 : errno;
    char *folder = arena_strdup(a, path), *slash = strrchr(folder, '/');
    if (slash) slash[slash == folder] = '\0';
    return access(slash ? folder : ".", W_OK | X_OK) == 0 ? 0 : errno;
}
