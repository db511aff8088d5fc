/* Pictures as pigments. Pixels are decoded when the map is made: looking one up is an index, or four and a blend. */
#include "render/image_map.h"

struct ImageMap {
    int width, height;
    MapType type;
    bool once, interpolates, is_opaque;
    ImageMapOptions options;     /* as written */
    const Color *pixels;         /* row by row from the top left, in the working space */
};

static double decoded(double encoded, const Image *picture, const ImageMapOptions *o)
{
    if (o->has_gamma) return o->gamma_is_srgb ? film_srgb_decode(encoded) : pow(encoded, o->gamma);
    if (picture->has_gamma && picture->file_gamma > 0) return pow(encoded, 1 / picture->file_gamma);
    return film_srgb_decode(encoded);   /* by its chunk, or by default */
}

/* A table over the samples that the file can have: 256 or 65536 powers, not three a pixel. */
static float *decoding_table(Arena *a, const Image *picture, const ImageMapOptions *o, GammaKind gamma, double power)
{
    float *table = ARENA_ARRAY(a, float, 65536);
    int step = picture->bits == 16 ? 1 : 257;
    for (int i = 0; i < 65536; i += step) {
        double encoded = i / 65535., value = encoded;
        if (gamma != GAMMA_NONE || o->has_gamma) value = film_working(decoded(encoded, picture, o), gamma, power);
        table[i] = (float)value;
    }
    return table;
}

ImageMap *image_map_new(Arena *a, const Image *picture, const ImageMapOptions *o, GammaKind gamma, double gamma_power)
{
    size_t n = (size_t)picture->width * (size_t)picture->height;
    Color *pixels = ARENA_ARRAY(a, Color, n);
    ArenaMark mark = arena_mark(a);
    const float *table = decoding_table(a, picture, o, gamma, gamma_power);
    bool is_opaque = !o->once && o->filter_all == 0 && o->transmit_all == 0;
    for (size_t i = 0; i < n; i++) {
        const uint16_t *s = picture->rgba + 4 * i;
        if (s[3] != 65535) is_opaque = false;
        pixels[i] = (Color){ table[s[0]], table[s[1]], table[s[2]], (float)o->filter_all,
                             (float)(1 - s[3] / 65535. + o->transmit_all) };
    }
    arena_reset(a, mark);
    ImageMap *m = ARENA_NEW(a, ImageMap);
    *m = (ImageMap){ picture->width, picture->height, o->type, o->once, o->interpolates, is_opaque, *o, pixels };
    return m;
}

/* Repeated, or (once) continued by its border: that matters where pixels are blended. */
static size_t index_in(const ImageMap *m, double i, int n)
{
    if (m->once) return (size_t)fmin(fmax(i, 0), n - 1);
    double r = fmod(i, n);
    return (size_t)(r < 0 ? r + n : r) % (size_t)n;
}

static Color pixel(const ImageMap *m, double column, double row)
{
    return m->pixels[index_in(m, row, m->height) * (size_t)m->width + index_in(m, column, m->width)];
}

Color image_map_color(const ImageMap *m, double x, double y)
{
    static const double SHIFT = 1e-10;   /* POV-Ray's, before rounding down: in pixels */
    if (m->once && (x < 0 || x > 1 || y < 0 || y > 1)) return (Color){ 0, 0, 0, 0, 1 };
    if (!m->interpolates) return pixel(m, floor(x * m->width + SHIFT), m->height + floor(-(y * m->height + SHIFT)));
    double column = x * m->width - .5, row = (1 - y) * m->height - .5;
    double i = floor(column), j = floor(row), s = column - i, t = row - j;
    Color upper = color_lerp(pixel(m, i, j), pixel(m, i + 1, j), s);
    Color lower = color_lerp(pixel(m, i, j + 1), pixel(m, i + 1, j + 1), s);
    return color_lerp(upper, lower, t);
}

/* ---- wrapped ---- */

/* The turn from +x towards +z, in [0, 1). */
static double turn(double x, double z)
{
    double t = atan2(z, x) / (2 * M_PI);
    return t < 0 ? t + 1 : t;
}

static Vec2 on_sphere(Vec3 p)
{
    double size = vec_length(p);
    return vec2(turn(p.x, p.z), .5 + asin(p.y / size) / M_PI);
}

/* About the y axis, one high; `once`: not above and below. */
static Vec2 on_cylinder(Vec3 p) { return vec2(turn(p.x, p.z), p.y); }

/* About the y axis, of major radius 1: once round it, and round the tube from its inner side. */
static Vec2 on_torus(Vec3 p)
{
    double out = hypot(p.x, p.z) - 1;
    return vec2(turn(p.x, p.z), turn(-out, -p.y));
}

Color image_map_at(const ImageMap *m, Vec3 point)
{
    static const Color clear = { 0, 0, 0, 0, 1 };
    Vec2 q = vec2(point.x, point.y);
    if (m->type != MAP_PLANAR && vec_max_abs(point) == 0) return clear;
    if (m->type == MAP_SPHERICAL) q = on_sphere(point);
    if (m->type == MAP_CYLINDRICAL) q = on_cylinder(point);
    if (m->type == MAP_TOROIDAL) q = on_torus(point);
    return image_map_color(m, q.x, q.y);
}

bool image_map_is_opaque(const ImageMap *m) { return m->is_opaque; }

void image_map_write(const ImageMap *m, Sdl *out)
{
    const ImageMapOptions *o = &m->options;
    sdl_text(out, " image_map { png \"");
    for (const char *c = o->path; c && *c; c++) sdl_text(out, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
    sdl_text(out, "\"");
    if (o->has_gamma && o->gamma_is_srgb) sdl_text(out, " gamma srgb");
    else if (o->has_gamma) sdl_text(out, " gamma"), sdl_number(out, o->gamma);
    static const int numbers[] = { 0, 1, 2, 5 };
    if (o->type != MAP_PLANAR) sdl_text(out, " map_type %d", numbers[o->type]);
    if (o->once) sdl_text(out, " once");
    if (o->interpolates) sdl_text(out, " interpolate 2");
    if (o->filter_all != 0) sdl_text(out, " filter all"), sdl_number(out, o->filter_all);
    if (o->transmit_all != 0) sdl_text(out, " transmit all"), sdl_number(out, o->transmit_all);
    sdl_text(out, " }");
}
