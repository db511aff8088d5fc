#include "render/shot.h"

#include "render/files.h"

#include <endian.h>
#include <stdlib.h>
#include <string.h>

static double decode(const char *bytes)
{
    uint64_t word;
    double x;
    memcpy(&word, bytes, sizeof word);
    word = le64toh(word);
    memcpy(&x, &word, sizeof x);
    return x;
}

static void encode(double x, char *bytes)
{
    uint64_t word;
    memcpy(&word, &x, sizeof word);
    word = htole64(word);
    memcpy(bytes, &word, sizeof word);
}

/* ---- rays ---- */

/* What is wrong with a ray, or NULL and the ray. */
static const char *make_ray(const double x[SHOT_RAY_NUMBERS], Ray *out)
{
    for (int i = 0; i < SHOT_RAY_NUMBERS; i++)
        if (!isfinite(x[i])) return "a number is not finite";
    *out = (Ray){ .origin = vec(x[0], x[1], x[2]), .dir = vec_normalize(vec(x[3], x[4], x[5])), .t_min = 0 };
    return vec_max_abs(out->dir) > 0 ? NULL : "the direction is zero";
}

static Ray *read_binary(const char *path, const char *bytes, size_t n_bytes, Arena *a, Diag *diag, size_t *n_rays)
{
    const size_t ray_bytes = SHOT_RAY_NUMBERS * sizeof(double);
    if (n_bytes % ray_bytes != 0) {
        diag_error(diag, (Place){ 0 }, "%s: %zu bytes are not a whole number of rays (%zu bytes each)", path, n_bytes,
                   ray_bytes);
        return NULL;
    }
    *n_rays = n_bytes / ray_bytes;
    Ray *rays = ARENA_ARRAY(a, Ray, *n_rays + 1);
    for (size_t i = 0; i < *n_rays; i++) {
        double x[SHOT_RAY_NUMBERS];
        for (size_t k = 0; k < SHOT_RAY_NUMBERS; k++) x[k] = decode(bytes + i * ray_bytes + k * sizeof(double));
        const char *wrong = make_ray(x, &rays[i]);
        if (!wrong) continue;
        diag_error(diag, (Place){ 0 }, "%s: ray %zu (byte %zu): %s", path, i, i * ray_bytes, wrong);
        return NULL;
    }
    return rays;
}

/* A cursor in a text of rays. */
typedef struct { const SourceText *source; const char *at; uint32_t line; const char *line_begin; } Text;

static Place here(const Text *t)
{
    return (Place){ .source = t->source, .line = t->line, .column = (uint32_t)(t->at - t->line_begin) + 1 };
}

static void skip_blanks(Text *t)
{
    while (*t->at == ' ' || *t->at == '\t' || *t->at == '\r' || *t->at == ',') t->at++;
    if (*t->at == '#') t->at += strcspn(t->at, "\n");
}

static bool at_end(const Text *t) { return t->at == t->source->text + t->source->n_bytes; }

/* The numbers of one line; returns how many, or -1 after an error. */
static int read_line(Text *t, Diag *diag, double x[SHOT_RAY_NUMBERS])
{
    int n = 0;
    for (skip_blanks(t); *t->at != '\n' && !at_end(t); skip_blanks(t)) {
        char *end;
        double value = strtod(t->at, &end);
        if (end == t->at) return diag_error(diag, here(t), "expected a number"), -1;
        if (n == SHOT_RAY_NUMBERS) return diag_error(diag, here(t), "expected %d numbers, found more", n), -1;
        x[n++] = value;
        t->at = end;
    }
    if (n == 0 || n == SHOT_RAY_NUMBERS) return n;
    return diag_error(diag, here(t), "expected %d numbers, found %d", SHOT_RAY_NUMBERS, n), -1;
}

static Ray *read_text(const SourceText *source, Arena *a, Diag *diag, size_t *n_rays)
{
    Text t = { source, source->text, 1, source->text };
    size_t n = 0, capacity = 0;
    Ray *rays = ARENA_ARRAY(a, Ray, 1);
    for (;; t.at++, t.line++, t.line_begin = t.at) {
        double x[SHOT_RAY_NUMBERS];
        Ray ray;
        int found = read_line(&t, diag, x);
        if (found < 0) return NULL;
        const char *wrong = found ? make_ray(x, &ray) : NULL;
        if (wrong) return diag_error(diag, (Place){ source, t.line, 1, 0 }, "%s", wrong), NULL;
        if (found) ARENA_PUSH(a, rays, n, capacity) = ray;
        if (at_end(&t)) break;
    }
    *n_rays = n;
    return rays;
}

Ray *shot_read_rays(const char *path, Arena *a, Diag *diag, size_t *n_rays)
{
    size_t n_bytes;
    char *bytes = file_read(path, a, &n_bytes);
    if (!bytes) return NULL;
    if (!file_is_text(path)) return read_binary(path, bytes, n_bytes, a, diag, n_rays);
    SourceText *source = ARENA_NEW(a, SourceText);
    *source = (SourceText){ strcmp(path, "-") == 0 ? "standard input" : path, bytes, n_bytes };
    return read_text(source, a, diag, n_rays);
}

/* ---- hits ---- */

static void hit_numbers(const ShotHit *h, double x[SHOT_HIT_NUMBERS])
{
    const double numbers[SHOT_HIT_NUMBERS] = { h->t, h->u, h->v, h->normal.x, h->normal.y, h->normal.z, h->index, h->tests };
    memcpy(x, numbers, sizeof numbers);
}

static bool write_binary(const char *path, Arena *a, const ShotHit *hits, size_t n)
{
    const size_t hit_bytes = SHOT_HIT_NUMBERS * sizeof(double);
    char *bytes = arena_alloc(a, n + 1, hit_bytes);
    for (size_t i = 0; i < n; i++) {
        double x[SHOT_HIT_NUMBERS];
        hit_numbers(&hits[i], x);
        for (size_t k = 0; k < SHOT_HIT_NUMBERS; k++) encode(x[k], bytes + i * hit_bytes + k * sizeof(double));
    }
    return file_write(path, a, bytes, n * hit_bytes);
}

/* %.17g takes at most 24 characters (-1.2345678901234567e-308), and one between numbers. */
static bool write_text(const char *path, Arena *a, const ShotHit *hits, size_t n)
{
    const size_t line_bytes = SHOT_HIT_NUMBERS * 25;
    char *text = arena_alloc(a, n + 1, line_bytes), *at = text;
    for (size_t i = 0; i < n; i++) {
        double x[SHOT_HIT_NUMBERS];
        hit_numbers(&hits[i], x);
        for (int k = 0; k < SHOT_HIT_NUMBERS; k++)
            at += snprintf(at, 26, "%.17g%c", x[k], k + 1 < SHOT_HIT_NUMBERS ? ' ' : '\n');
    }
    return file_write(path, a, text, (size_t)(at - text));
}

bool shot_write_hits(const char *path, Arena *a, const ShotHit *hits, size_t n)
{
    return file_is_text(path) ? write_text(path, a, hits, n) : write_binary(path, a, hits, n);
}
