/* trimray export SCENE.pov -o OUT.pov: the scene for POV-Ray, or as triangles (.obj, .stl). */
#include "render/commands.h"
#include "render/export_mesh.h"
#include "render/export_pov.h"
#include "render/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef enum { FORMAT_POV, FORMAT_OBJ, FORMAT_STL, FORMAT_UNKNOWN } Format;

static Format format_of(const char *path)
{
    static const char *const endings[] = { ".pov", ".obj", ".stl" };
    size_t n = strlen(path);
    if (strcmp(path, "-") == 0) return FORMAT_POV;
    for (int f = 0; f < FORMAT_UNKNOWN; f++)
        if (n >= 4 && strcasecmp(path + n - 4, endings[f]) == 0) return (Format)f;
    return FORMAT_UNKNOWN;
}

/* In a world of triangles all that has a mesh becomes one. */
static bool has_mesh(const Shape *s) { return s->type->tessellate != NULL; }

static void tell_left_out(const Run *run, const ExportMeshResult *r)
{
    for (size_t i = 0; !run->options->is_quiet && i < r->n; i++)
        fprintf(stderr, "trimray: warning: %zu %s left out: no triangles can be made of %s\n", r->list[i].n, r->list[i].name,
                r->list[i].n > 1 ? "them" : "it");
}

/* NULL, or what cannot be written. */
static const char *write_format(Run *run, Format format, FILE *file)
{
    const Options *o = run->options;
    ExportList list = export_list(run->arena, run->scene, format == FORMAT_POV ? export_pov_is_mesh : has_mesh);
    double e = o->chord_error > 0 ? o->chord_error : export_default_error(&list);
    if (o->is_verbose) fprintf(stderr, "%s: chord error %.9g\n", o->output, e);
    if (format == FORMAT_POV) return export_pov(file, run->scene, &list, e);
    ExportMeshResult r = format == FORMAT_OBJ ? export_obj(file, run->arena, run->scene, &list, e)
                                              : export_stl(file, run->arena, run->scene, &list, e);
    tell_left_out(run, &r);
    return NULL;
}

static int export(Run *run, Format format)
{
    char *text = NULL;
    size_t n_bytes = 0;
    const char *path = run->options->output, *unsupported = NULL;
    FILE *file = open_memstream(&text, &n_bytes);
    bool is_good = file != NULL;
    if (file) {
        unsupported = write_format(run, format, file);
        is_good = !ferror(file);
        is_good = fclose(file) == 0 && is_good;
    }
    int status = EXIT_DONE;
    if (!is_good) status = run_fail(EXIT_FILE, "no memory for %s", path);
    else if (unsupported) status = run_fail(EXIT_INPUT, "'%s' cannot be exported", unsupported);
    else if (!file_write(path, run->arena, text, n_bytes))
        status = run_fail(EXIT_FILE, "cannot write %s: %s", path, strerror(errno));
    free(text);
    return status;
}

int cmd_export(const Options *options)
{
    Run run;
    Format format = format_of(options->output);
    if (format == FORMAT_UNKNOWN) return run_fail(EXIT_USAGE, "export writes .pov, .obj or .stl, not %s", options->output);
    int status = run_begin(&run, options);
    if (status != EXIT_DONE) return status;
    int reason = file_cannot_write(options->output, run.arena);
    status = reason ? run_fail(EXIT_FILE, "cannot write %s: %s", options->output, strerror(reason)) : export(&run, format);
    return run_end(&run, status);
}
