/* Antialiasing. Method 1 takes one sample in the middle of each pixel, and a grid of depth^2 more where it differs from the
 * pixel before it or above it. Method 2 samples the corners of pixels, and divides those whose corners differ. Colours are
 * averaged as light: linear, and before they are clipped. */
#include "render/antialias.h"

#include "render/hash.h"

#include <assert.h>
#include <string.h>

typedef struct {
    const Antialias *options;
    AntialiasSample sample;
    void *context;
    int x0, y0, width, height;
} Block;

/* ---- colours ---- */

/* A colour, and as it is compared: found once, for it is compared with several. */
typedef struct { Pixel value, seen; } Look;

static double as_seen(double c, double gamma) { return gamma == 1 ? fmax(c, 0) : pow(fmax(c, 0), 1 / gamma); }

static Look look_of(const Antialias *a, Pixel p)
{
    return (Look){ p, { as_seen(p.r, a->gamma), as_seen(p.g, a->gamma), as_seen(p.b, a->gamma), p.transmit } };
}

static bool differ(const Antialias *a, const Look *x, const Look *y)
{
    const Pixel *p = &x->seen, *q = &y->seen;
    return fabs(p->r - q->r) + fabs(p->g - q->g) + fabs(p->b - q->b) + fabs(p->transmit - q->transmit) >= a->threshold;
}

static void add(Pixel *sum, const Pixel *p) { sum->r += p->r, sum->g += p->g, sum->b += p->b, sum->transmit += p->transmit; }

static Pixel scaled(Pixel p, double by) { return (Pixel){ p.r * by, p.g * by, p.b * by, p.transmit * by }; }

/* ---- places ---- */

/* Displaced by chance that depends on the place alone; `spacing` is the distance between samples. */
static Vec2 place_near(const Block *b, double x, double y, double spacing)
{
    double reach = b->options->jitter * spacing;
    if (reach == 0) return vec2(x, y);
    uint64_t chance = hash_combine(hash_mix(hash_bits(x)), hash_bits(y));
    return vec2(x + reach * (hash_unit(chance) - .5), y + reach * (hash_unit(hash_mix(chance)) - .5));
}

/* Places that are sampled together: as near each other as eight can be. */
enum { GROUP_ACROSS = 4, GROUP_DOWN = 2 };

/* Samples at whole numbers, but for `off` in both directions, of [x0, x1) x [y0, y1), row by row. */
static void sample_grid(const Block *b, int x0, int y0, int x1, int y1, double off, double spacing, Pixel *out,
                        size_t stride)
{
    Vec2 at[GROUP_ACROSS * GROUP_DOWN];
    Pixel found[GROUP_ACROSS * GROUP_DOWN];
    for (int y = y0; y < y1; y += GROUP_DOWN)
        for (int x = x0; x < x1; x += GROUP_ACROSS) {
            int across = int_min(GROUP_ACROSS, x1 - x), down = int_min(GROUP_DOWN, y1 - y);
            for (int i = 0; i < across * down; i++)
                at[i] = place_near(b, x + i % across + off, y + i / across + off, spacing);
            b->sample(b->context, at, across * down, found);
            for (int i = 0; i < across * down; i++)
                out[(size_t)(y - y0 + i / across) * stride + (size_t)(x - x0 + i % across)] = found[i];
        }
}

/* ---- method 1 ---- */

typedef struct { Look look; bool is_done; } Cell;

static void refine(const Block *b, Cell *c, int x, int y)
{
    int n = b->options->depth;
    Vec2 at[ANTIALIAS_MAX_DEPTH * ANTIALIAS_MAX_DEPTH] = { 0 };
    Pixel found[ANTIALIAS_MAX_DEPTH * ANTIALIAS_MAX_DEPTH], sum = c->look.value;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) at[j * n + i] = place_near(b, x - .5 + (i + .5) / n, y - .5 + (j + .5) / n, 1. / n);
    b->sample(b->context, at, n * n, found);
    for (int i = 0; i < n * n; i++) add(&sum, &found[i]);
    *c = (Cell){ look_of(b->options, scaled(sum, 1. / (n * n + 1))), true };
}

static void look_at(const Block *b, Cell *here, Cell *left, Cell *above, int x, int y)
{
    bool differs_left = differ(b->options, &here->look, &left->look);
    bool differs_above = differ(b->options, &here->look, &above->look);
    if (differs_left && !left->is_done) refine(b, left, x - 1, y);
    if (differs_above && !above->is_done) refine(b, above, x, y - 1);
    if (differs_left || differs_above) refine(b, here, x, y);
}

/* The first looks at [x0, x1) x [y0, y1), into cells[0] and on. */
static void look_first(const Block *b, int x0, int y0, int x1, int y1, bool is_border, Arena *scratch, Cell *cells,
                       size_t stride)
{
    size_t width = (size_t)(x1 - x0), height = (size_t)(y1 - y0);
    ArenaMark mark = arena_mark(scratch);
    Pixel *found = ARENA_ARRAY(scratch, Pixel, width * height);
    sample_grid(b, x0, y0, x1, y1, 0, 0, found, width);
    for (size_t j = 0; j < height; j++)
        for (size_t i = 0; i < width; i++)
            cells[j * stride + i] = (Cell){ look_of(b->options, found[j * width + i]), is_border };
    arena_reset(scratch, mark);
}

/* Cells of the block with a border above and on the left. */
static void method_1(const Block *b, Arena *scratch, Pixel *out, size_t stride)
{
    size_t across = (size_t)b->width + 1;
    int x0 = b->x0, y0 = b->y0, x1 = x0 + b->width, y1 = y0 + b->height;
    Cell *cells = ARENA_ARRAY(scratch, Cell, across * ((size_t)b->height + 1)), *first = cells + across + 1;
    look_first(b, x0, y0 - 1, x1, y0, true, scratch, cells + 1, across);
    look_first(b, x0 - 1, y0, x0, y1, true, scratch, cells + across, across);
    look_first(b, x0, y0, x1, y1, false, scratch, first, across);
    for (int j = 0; j < b->height; j++)
        for (int i = 0; i < b->width; i++) {
            Cell *here = first + across * (size_t)j + i;
            look_at(b, here, here - 1, here - across, x0 + i, y0 + j);
        }
    for (int j = 0; j < b->height; j++)
        for (int i = 0; i < b->width; i++)
            out[(size_t)j * stride + (size_t)i] = first[across * (size_t)j + (size_t)i].look.value;
}

/* ---- method 2 ---- */

/* The samples of one pixel: a grid of (2^(depth - 1) + 1)^2 places, each asked for once at most. */
typedef struct {
    const Block *block;
    int x, y, n;                 /* the pixel; n intervals a side */
    Look *looks;
    bool *is_known;
} Grid;

static const Look *grid_at(const Grid *g, int i, int j)
{
    size_t k = (size_t)j * ((size_t)g->n + 1) + (size_t)i;
    if (!g->is_known[k]) {
        const Block *b = g->block;
        Vec2 at = place_near(b, g->x - .5 + (double)i / g->n, g->y - .5 + (double)j / g->n, 1. / g->n);
        Pixel p;
        b->sample(b->context, &at, 1, &p);
        g->looks[k] = look_of(g->block->options, p);
        g->is_known[k] = true;
    }
    return &g->looks[k];
}

static bool any_differ(const Antialias *a, const Look *const corner[4])
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < i; j++)
            if (differ(a, corner[i], corner[j])) return true;
    return false;
}

/* The mean over the square of `size` intervals at (i, j). */
static Pixel square_mean(const Grid *g, int i, int j, int size)
{
    const Look *const corner[4] = { grid_at(g, i, j), grid_at(g, i + size, j), grid_at(g, i, j + size),
                                    grid_at(g, i + size, j + size) };
    Pixel sum = { 0 };
    bool is_divided = size > 1 && any_differ(g->block->options, corner);
    for (int k = 0; k < 4; k++) {
        int half = size / 2;
        Pixel p = is_divided ? square_mean(g, i + k % 2 * half, j + k / 2 * half, half) : corner[k]->value;
        add(&sum, &p);
    }
    return scaled(sum, .25);
}

/* `above` and `below` point to the pixel's two corners each. */
static Pixel divide_pixel(Grid *g, int x, int y, const Look *above, const Look *below)
{
    size_t last = (size_t)g->n, bottom = last * (last + 1);
    const size_t places[4] = { 0, last, bottom, bottom + last };
    const Look *const corner[4] = { &above[0], &above[1], &below[0], &below[1] };
    memset(g->is_known, 0, (bottom + last + 1) * sizeof *g->is_known);
    for (int k = 0; k < 4; k++) g->looks[places[k]] = *corner[k], g->is_known[places[k]] = true;
    g->x = x, g->y = y;
    return square_mean(g, 0, 0, g->n);
}

/* Pixels have their corners in common. */
static void method_2(const Block *b, Arena *scratch, Pixel *out, size_t stride)
{
    int n = 1 << (b->options->depth - 1);
    size_t across = (size_t)b->width + 1, n_corners = across * ((size_t)b->height + 1);
    size_t n_places = ((size_t)n + 1) * ((size_t)n + 1);
    Pixel *found = ARENA_ARRAY(scratch, Pixel, n_corners);
    Look *corners = ARENA_ARRAY(scratch, Look, n_corners);
    Grid g = { .block = b, .n = n };
    g.looks = ARENA_ARRAY(scratch, Look, n_places);
    g.is_known = ARENA_ARRAY(scratch, bool, n_places);
    sample_grid(b, b->x0, b->y0, b->x0 + b->width + 1, b->y0 + b->height + 1, -.5, 1. / n, found, across);
    for (size_t i = 0; i < n_corners; i++) corners[i] = look_of(b->options, found[i]);
    for (int j = 0; j < b->height; j++)
        for (int i = 0; i < b->width; i++) {
            const Look *above = corners + (size_t)j * across + (size_t)i;
            out[(size_t)j * stride + (size_t)i] = divide_pixel(&g, b->x0 + i, b->y0 + j, above, above + across);
        }
}

void antialias_block(const Antialias *a, int x0, int y0, int x1, int y1, AntialiasSample sample, void *context,
                     Arena *scratch, Pixel *out, size_t stride)
{
    Block b = { a, sample, context, x0, y0, x1 - x0, y1 - y0 };
    ArenaMark mark = arena_mark(scratch);
    assert(a->depth >= 1 && a->depth <= ANTIALIAS_MAX_DEPTH);
    if (a->method == 2) {
        method_2(&b, scratch, out, stride);
    } else if (a->method == 1) {
        method_1(&b, scratch, out, stride);
    } else {
        sample_grid(&b, x0, y0, x1, y1, 0, 0, out, stride);
    }
    arena_reset(scratch, mark);
}
