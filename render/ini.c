/* INI files: a line is key = value, or switches and names as on the command line. */
#include "render/ini.h"

#include "render/files.h"

#include <ctype.h>
#include <errno.h>
#include <string.h>
#include <strings.h>

static char *trimmed(char *s)
{
    while (isspace((unsigned char)*s)) s++;
    char *end = s + strlen(s);
    while (end > s && isspace((unsigned char)end[-1])) *--end = '\0';
    return s;
}

static char *unquoted(char *s)
{
    size_t n = strlen(s);
    if (n < 2 || (*s != '"' && *s != '\'') || s[n - 1] != *s) return s;
    s[n - 1] = '\0';
    return s + 1;
}

/* Cuts the line at a ';' that is not within quotes. */
static void cut_comment(char *s)
{
    char quote = '\0';
    for (; *s; s++) {
        if (*s == ';' && !quote) *s = '\0';
        if (!*s) return;
        if (*s == '"' || *s == '\'') quote = !quote ? *s : quote == *s ? '\0' : quote;
    }
}

/* [name]: is it the section that was asked for? */
static bool is_section(char *line, const char *section)
{
    char *end = strchr(line, ']');
    if (end) *end = '\0';
    return section && strcasecmp(trimmed(line + 1), section) == 0;
}

static bool take_words(char *line, IniOption take, void *context)
{
    char *rest;
    for (char *word = strtok_r(line, " \t", &rest); word; word = strtok_r(NULL, " \t", &rest))
        if (!take(context, unquoted(word))) return false;
    return true;
}

static bool take_line(char *line, Arena *a, IniOption take, void *context)
{
    char *equals = strchr(line, '=');
    if (!equals || *line == '+' || *line == '-') return take_words(line, take, context);
    *equals = '\0';
    return take(context, arena_printf(a, "%s=%s", trimmed(line), unquoted(trimmed(equals + 1))));
}

bool ini_read(const char *path, const char *section, Arena *a, IniOption take, void *context, int *line)
{
    size_t n_bytes;
    bool is_wanted = true, has_section = !section;
    char *rest = file_read(path, a, &n_bytes);
    for (int n = 1; (*line = 0, rest); n++) {
        char *s = strsep(&rest, "\n");
        cut_comment(s);
        s = trimmed(s);
        if (*s == '[') has_section |= is_wanted = is_section(s, section);
        else if (is_wanted && !take_line(s, a, take, context)) return *line = n, false;
        if (!rest && !has_section) errno = ENOENT;
        if (!rest) return has_section;
    }
    return false;
}
