/* Scenes given as text, for the tests of the parser: what #debug printed, and the messages. */
#ifndef TRIMRAY_TESTS_SCENE_TEXT_H
#define TRIMRAY_TESTS_SCENE_TEXT_H

#include "parser/parser.h"
#include "tests/test.h"

#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

typedef struct {
    Arena *arena;
    Scene *scene;
    ParseSummary summary;
    bool is_ok;
    int n_errors;
    char *debug, *messages;      /* what was printed by #debug; all messages with their places */
} Read;

static inline Read read_bytes(const char *text, size_t n, ParseOptions options)
{
    char path[64];
    int file = memfd_create("scene", 0);
    CHECK(file >= 0 && write(file, text, n) == (ssize_t)n, "no room for a scene in memory");
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    Read r = { .arena = arena_new() };
    size_t debug_size, messages_size;
    options.debug = open_memstream(&r.debug, &debug_size);
    Diag *diag = diag_new(r.arena);
    r.scene = scene_new(r.arena);
    r.is_ok = parse_scene(path, &options, r.arena, diag, r.scene, &r.summary);
    r.n_errors = diag_error_count(diag);
    fclose(options.debug);
    FILE *out = open_memstream(&r.messages, &messages_size);
    diag_print(diag, out);
    fclose(out);
    close(file);
    return r;
}

static inline Read read_scene_text(const char *text)
{
    return read_bytes(text, strlen(text), (ParseOptions){ .image_width = 320, .image_height = 240 });
}

static inline void read_done(Read *r)
{
    scene_release(r->scene);
    arena_free(r->arena);
    free(r->debug);
    free(r->messages);
}

/* The scene must be read without an error and print `expected`. */
static inline void check_prints(const char *text, const char *expected)
{
    Read r = read_scene_text(text);
    CHECK(r.is_ok, "%s\n%s", text, r.messages);
    CHECK(strcmp(r.debug, expected) == 0, "%s\nprints '%s', expected '%s'", text, r.debug, expected);
    read_done(&r);
}

/* The scene must fail, and its first message must contain `expected`. */
static inline void check_fails(const char *text, const char *expected)
{
    Read r = read_scene_text(text);
    CHECK(!r.is_ok && strstr(r.messages, expected), "%s\nsays '%s', expected '%s'", text, r.messages, expected);
    read_done(&r);
}

#endif
