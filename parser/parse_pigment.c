/* pigment { }, color_map { } and pigment_map { }. Like POV-Ray's, a pigment starts from the one that it replaces: items
 * change what they name and leave the rest, transformations too. */
#include "parser/rules.h"

#include <string.h>

static const Pigment *keep_pigment(Parser *p, Pigment g)
{
    return arena_copy(parser_arena(p), &g, 1, sizeof g);
}

static const Pigment *solid(Parser *p, Color c)
{
    return keep_pigment(p, pigment_solid(c));
}

static const Pigment *default_pigment(Parser *p)
{
    const Texture *t = parser_scene(p)->default_texture;
    return t->layers[t->n_layers - 1].pigment;
}

/* ---- patterns ---- */

static const Pigment *parse_block(Parser *p)
{
    if (accept_word(p, "pigment")) return parse_pigment(p);
    return starts_expression(p) ? solid(p, parse_color(p)) : NULL;
}

static void read_blocks(Parser *p, Pigment *g)
{
    const PatternType *type = g->pattern.type;
    PigmentEntry *list = ARENA_ARRAY(parser_arena(p), PigmentEntry, type->n_blocks);
    bool more = true;
    for (int i = 0; i < type->n_blocks; i++) {
        const Pigment *block = more ? parse_block(p) : NULL;
        more = block != NULL;
        list[i] = (PigmentEntry){ (float)i, block ? block : solid(p, type->blocks[i]) };
        if (more) accept_comma(p);
    }
    g->kind = PIGMENT_BLOCKS, g->entries = list, g->n_entries = type->n_blocks;
}

static void read_pattern(Parser *p, Pigment *g, const PatternType *type)
{
    if (g->kind == PIGMENT_BLOCKS) g->n_entries = 0;   /* colours of blocks are no map */
    g->pattern = parse_pattern(p, type);
    if (type->n_blocks > 0) {
        read_blocks(p, g);
        return;
    }
    g->kind = PIGMENT_MAP;
}

/* ---- items ---- */

static void read_color_map(Parser *p, Pigment *g) { g->entries = parse_color_map(p, &g->n_entries); }
static void read_pigment_map(Parser *p, Pigment *g) { g->entries = parse_pigment_map(p, &g->n_entries); }
static void read_image_map(Parser *p, Pigment *g) { g->kind = PIGMENT_IMAGE, g->image = parse_image_map(p); }
static void read_uv_mapping(Parser *p, Pigment *g) { (void)p, g->uv_mapping = true; }

static const struct {
    const char *word;
    void (*read)(Parser *p, Pigment *g);
} words[] = {
    { "color_map", read_color_map }, { "colour_map", read_color_map }, { "pigment_map", read_pigment_map },
    { "image_map", read_image_map },
    { "uv_mapping", read_uv_mapping },
};

static const char *const left_out[] = { "quick_color", "quick_colour", NULL };

static bool read_word(Parser *p, Pigment *g, Token t)
{
    const PatternType *type = pattern_type(t.text);
    if (type) {
        next(p);
        read_pattern(p, g, type);
        return true;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (strcmp(t.text, words[i].word) != 0) continue;
        next(p);
        words[i].read(p, g);
        return true;
    }
    return parse_pattern_item(p, &g->pattern) || parse_left_out(p, left_out);
}

static bool read_item(Parser *p, Pigment *g)
{
    Xform x = xform_identity();
    if (parse_transformation(p, &x)) {
        pigment_transform(g, &x);
        return true;
    }
    Token t = peek(p);
    if (t.kind == TOKEN_WORD && read_word(p, g, t)) return true;
    if (!starts_expression(p)) return false;
    g->kind = PIGMENT_COLOR;
    g->color = parse_color(p);
    return true;
}

/* What stands in pigment { } and in an entry of a pigment_map. */
static void read_body(Parser *p, Pigment *g)
{
    Value v;
    if (accept_value(p, VALUE_PIGMENT, &v)) *g = *v.pigment;
    while (read_item(p, g)) continue;
    refuse_word(p, "object", "object pattern");
}

Pigment parse_pigment_from(Parser *p, const Pigment *base)
{
    Place opened = expect_open(p, "pigment");
    Pigment g = *base;
    read_body(p, &g);
    expect_close(p, '}', "pigment", opened);
    return g;
}

const Pigment *parse_pigment(Parser *p)
{
    return keep_pigment(p, parse_pigment_from(p, default_pigment(p)));
}

/* ---- maps ---- */

typedef struct {
    PigmentEntry *list;
    size_t n, capacity;
} MapDraft;

static void add_entry(Parser *p, MapDraft *m, double key, const Pigment *g)
{
    ARENA_PUSH(parser_arena(p), m->list, m->n, m->capacity) = (PigmentEntry){ (float)key, g };
}

/* [key colour], or the old form [key key colour colour]. */
static void read_color_entry(Parser *p, void *draft)
{
    MapDraft *m = draft;
    double key = parse_float(p), key2 = key;
    accept_comma(p);
    bool has_two = peek(p).kind == TOKEN_NUMBER;
    if (has_two) key2 = parse_float(p), accept_comma(p);
    add_entry(p, m, key, solid(p, parse_color(p)));
    if (!has_two) return;
    accept_comma(p);
    add_entry(p, m, key2, solid(p, parse_color(p)));
}

static void read_pigment_entry(Parser *p, void *draft)
{
    double key = parse_float(p);
    accept_comma(p);
    Pigment g = *default_pigment(p);
    read_body(p, &g);
    add_entry(p, draft, key, keep_pigment(p, g));
}

bool parse_map(Parser *p, const char *what, ValueKind kind, Value *declared,
               void (*read_entry)(Parser *p, void *draft), void *draft)
{
    Place opened = expect_open(p, what);
    bool is_declared = accept_value(p, kind, declared);
    if (!is_declared) {
        do {
            Place bracket = expect_punct(p, '[');
            read_entry(p, draft);
            expect_close(p, ']', "the entry", bracket);
        } while (peek_punct(p, '['));
    }
    expect_close(p, '}', what, opened);
    return is_declared;
}

static const PigmentEntry *read_map(Parser *p, const char *what, ValueKind kind,
                                    void (*read_entry)(Parser *p, void *draft), int *n)
{
    MapDraft m = { .list = NULL };
    Value v;
    bool is_declared = parse_map(p, what, kind, &v, read_entry, &m);
    *n = is_declared ? v.n : (int)m.n;
    return is_declared ? v.map : m.list;
}

const PigmentEntry *parse_color_map(Parser *p, int *n)
{
    return read_map(p, "color_map", VALUE_COLOR_MAP, read_color_entry, n);
}

const PigmentEntry *parse_pigment_map(Parser *p, int *n)
{
    return read_map(p, "pigment_map", VALUE_PIGMENT_MAP, read_pigment_entry, n);
}
