/* Textures that choose between textures: texture { checker texture { } texture { } }, texture { gradient x texture_map { }
 * }. */
#include "parser/rules.h"

#include <string.h>

typedef struct {
    TextureEntry *list;
    size_t n, capacity;
} MapDraft;

static void add_entry(Parser *p, MapDraft *m, double key, const Texture *t)
{
    ARENA_PUSH(parser_arena(p), m->list, m->n, m->capacity) = (TextureEntry){ (float)key, t };
}

/* Blocks that are not given have the default texture. */
static void read_blocks(Parser *p, const PatternType *type, TextureMap *map)
{
    MapDraft m = { .list = NULL };
    for (int i = 0; i < type->n_blocks; i++) {
        bool is_given = accept_word(p, "texture");
        add_entry(p, &m, i, is_given ? parse_texture(p) : parser_scene(p)->default_texture);
        accept_comma(p);
    }
    map->entries = m.list, map->n_entries = type->n_blocks;
}

static void read_entry(Parser *p, void *draft)
{
    double key = parse_float(p);
    accept_comma(p);
    add_entry(p, draft, key, parse_texture_body(p));
}

void parse_texture_map(Parser *p, const TextureEntry **entries, int *n)
{
    MapDraft m = { .list = NULL };
    Value v;
    bool is_declared = parse_map(p, "texture_map", VALUE_TEXTURE_MAP, &v, read_entry, &m);
    *entries = is_declared ? v.texture_map : m.list;
    *n = is_declared ? v.n : (int)m.n;
}

static bool read_item(Parser *p, TextureMap *map, bool *has_uv)
{
    if (parse_transformation(p, &map->space) || parse_pattern_item(p, &map->pattern)) return true;
    if (accept_word(p, "uv_mapping")) return *has_uv = true;
    if (map->pattern.type->n_blocks > 0 || !accept_word(p, "texture_map")) return false;
    parse_texture_map(p, &map->entries, &map->n_entries);
    return true;
}

const Texture *parse_mapped_texture(Parser *p)
{
    Token t = peek(p);
    const PatternType *type = t.kind == TOKEN_WORD ? pattern_type(t.text) : NULL;
    if (!type) return NULL;
    next(p);
    TextureMap map = { .pattern = parse_pattern(p, type), .space = xform_identity() };
    Texture texture = { .n_layers = 0 };
    if (type->n_blocks > 0) read_blocks(p, type, &map);
    while (read_item(p, &map, &texture.uv_mapping)) continue;
    if (map.n_entries == 0) parse_fail_expected(p, "texture_map");
    texture.map = arena_copy(parser_arena(p), &map, 1, sizeof map);
    return arena_copy(parser_arena(p), &texture, 1, sizeof texture);
}
