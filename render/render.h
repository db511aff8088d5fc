/* The picture of a scene: tiles, threads, progress, interruption. */
#ifndef TRIMRAY_RENDER_H
#define TRIMRAY_RENDER_H

#include "render/antialias.h"
#include "render/film.h"
#include "render/scene.h"

#include <stdio.h>

typedef struct {
    int width, height;          /* of the whole picture */
    int x0, y0, x1, y1;         /* the part to render: [x0, x1) x [y0, y1) */
    int n_threads;              /* 0: all cores */
    int quality;                /* +Q: 0 to 11, default 9 */
    Antialias antialias;
    int block_size;             /* pixels a side that one thread takes at a time: 32. Shows with antialiasing method 1 */
    bool measures_time;         /* fill Counters.nurbs_seconds */
    FILE *progress;             /* NULL: silent */
} RenderOptions;

typedef struct {
    Counters counters;          /* all threads together */
    double trace_seconds;
    int n_threads;
    bool interrupted;           /* what was finished was given to the sink */
} RenderResult;

RenderOptions render_options_default(int width, int height);

/* Takes the pixels [x0, x1) x [y0, y1), row by row; called from all threads, once for each tile. */
typedef void RenderSink(void *context, int x0, int y0, int x1, int y1, const FilmPixel *pixels);

/* Tiles are begun row by row from the top. The same pixels for every number of threads. */
RenderResult render_tiles(Scene *s, const RenderOptions *o, RenderSink *sink, void *context);

/* Fills the film. */
RenderResult render_scene(Scene *s, const RenderOptions *o, Film *film);

/* From a signal handler: tiles in work are finished, no new ones begun. Counts for the render that runs, or for the next one
 * if none does. */
void render_interrupt(void);

#endif
