/* image_map { }: the file is read and decoded where it stands in the scene. PNG alone; POV-Ray's other formats are named as
 * missing. */
#include "parser/rules.h"
#include "parser/source.h"
#include "render/image_map.h"

#include <string.h>

static void read_map_type(Parser *p, ImageMapOptions *o)
{
    Token t = peek(p);
    int type = parse_int(p);
    switch (type) {
    case 0: o->type = MAP_PLANAR; break;
    case 1: o->type = MAP_SPHERICAL; break;
    case 2: o->type = MAP_CYLINDRICAL; break;
    case 5: o->type = MAP_TOROIDAL; break;
    default: parse_fail(p, t.place, "expected a map_type of 0, 1, 2 or 5, found %d", type);
    }
}

static void read_interpolate(Parser *p, ImageMapOptions *o)
{
    Token t = peek(p);
    o->interpolates = parse_int(p) == 2;
    if (o->interpolates) return;
    t.text = "interpolate other than 2";
    parse_fail_unsupported(p, t);
}

static void read_gamma(Parser *p, ImageMapOptions *o)
{
    o->has_gamma = true;
    o->gamma_is_srgb = accept_word(p, "srgb");
    if (!o->gamma_is_srgb) o->gamma = parse_float(p);
}

/* `all` colours; those of single entries of a palette are not known here. */
static double read_all(Parser *p, const char *feature)
{
    if (!accept_word(p, "all")) {
        Token t = peek(p);
        t.text = feature;
        parse_fail_unsupported(p, t);
    }
    accept_comma(p);
    return parse_float(p);
}

static bool read_item(Parser *p, ImageMapOptions *o)
{
    if (accept_word(p, "map_type")) read_map_type(p, o);
    else if (accept_word(p, "once")) o->once = true;
    else if (accept_word(p, "interpolate")) read_interpolate(p, o);
    else if (accept_word(p, "gamma")) read_gamma(p, o);
    else if (accept_word(p, "filter")) o->filter_all = read_all(p, "filter of one entry of a palette");
    else if (accept_word(p, "transmit")) o->transmit_all = read_all(p, "transmit of one entry of a palette");
    else return false;
    return true;
}

static bool ends_in(const char *name, const char *ending)
{
    size_t n = strlen(name), m = strlen(ending);
    return n >= m && strcasecmp(name + n - m, ending) == 0;
}

/* The word for the format may be left out where the file's name tells it. */
static const Image *read_picture(Parser *p, const char **path)
{
    static const char *const formats[] = { "gif", "tga", "ppm", "pgm", "jpeg", "tiff", "exr", "hdr", "iff", "pot", "sys" };
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        refuse_word(p, formats[i], formats[i]);
    bool is_png = accept_word(p, "png");
    if (!is_png) refuse_word(p, "function", "function in image_map");
    Token t = peek(p);
    const char *name = parse_string(p), *error = "there is no such file";
    if (!is_png && !ends_in(name, ".png")) parse_fail(p, t.place, "cannot read %s: only PNG pictures are supported", name);
    *path = source_find(parser_arena(p), parser_options(p), name);
    const Image *picture = *path ? image_read_png(parser_arena(p), *path, &error) : NULL;
    if (!picture) parse_fail(p, t.place, "cannot read %s: %s", name, error);
    return picture;
}

const ImageMap *parse_image_map(Parser *p)
{
    const Scene *s = parser_scene(p);
    Place opened = expect_open(p, "image_map");
    ImageMapOptions o = { .type = MAP_PLANAR };
    const Image *picture = read_picture(p, &o.path);
    while (read_item(p, &o)) continue;
    expect_close(p, '}', "image_map", opened);
    bool is_default = s->gamma == GAMMA_NONE && s->version >= 3.7;   /* as settings_end will have it */
    if (is_default) return image_map_new(parser_arena(p), picture, &o, GAMMA_POWER, 1);
    return image_map_new(parser_arena(p), picture, &o, s->gamma, s->gamma_power);
}
