/* From a scene file to a Scene: the parser's public header. */
#ifndef TRIMRAY_PARSER_H
#define TRIMRAY_PARSER_H

#include "nurbs/nurbs.h"
#include "render/diag.h"
#include "render/scene.h"

typedef struct { const char *name; double value; } ParseDeclare;    /* Declare=Name=2 */

typedef struct {
    const char *const *library_paths;    /* +L, in order; the current folder comes first, POV-Ray's include folder last */
    int n_library_paths;
    const ParseDeclare *declares;
    int n_declares;
    double version;                      /* +MV; 0: not given */
    double clock;                        /* +K */
    bool clock_on;
    int image_width, image_height;
    int quality;                         /* +Q */
    NurbsOptions nurbs;                  /* for surfaces that do not say otherwise */
    long max_steps;                      /* rounds of loops and calls of macros before giving up; 0: 100 million */
    FILE *debug;                         /* what #debug writes to; NULL: the standard error */
} ParseOptions;

/* What `check` and --stats tell of a scene, counted while it is read. */
typedef struct {
    size_t n_objects, n_lights, n_cameras, n_nurbs, n_trims, n_control_points;
    size_t n_bytes, n_files;
} ParseSummary;

/* Reads the file at `path` into `scene` (fresh from scene_new). Returns false if there was an error; all messages are in
 * `diag`. Everything that is built lies in `a`; the source texts too, so that messages can be printed later. */
bool parse_scene(const char *path, const ParseOptions *options, Arena *a, Diag *diag, Scene *scene, ParseSummary *summary);

#endif
