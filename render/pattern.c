/* Patterns: a number for each point of space, and the waves that shape it. POV-Ray's rules, to its last constants: a
 * picture of a floor must have its edges where POV-Ray has them. */
#include "render/texture.h"

#include <string.h>

/* POV-Ray adds this to coordinates before it rounds them down, so that a surface lying in a plane of a pattern's grid takes
 * the block above it in spite of rounding; and reduces values by a period that leaves 1 as it is. In the pattern's units. */
static const double GRID_SHIFT = 1e-10;
static const double UNIT_PERIOD = 1.00001;

/* ---- blocks ---- */

static double checker_value(const Pattern *p, Vec3 q)
{
    (void)p;
    double sum = floor(q.x + GRID_SHIFT) + floor(q.y + GRID_SHIFT) + floor(q.z + GRID_SHIFT);
    return fmod(sum, 2) != 0;
}

/* In units of a sixth of the period: the cell (i, j) of a 6 by 6 grid is of one colour (i = 0, 2, 3, 5), or cut by a
 * diagonal (i = 1, 4), whose direction alternates. */
static double hexagon_value(const Pattern *p, Vec3 q)
{
    static const double PERIOD_Z = 5.196152424, CELL_X = .5, CELL_Z = .866025404;   /* 3 sqrt 3, half, sqrt 3 / 2 */
    static const int outer[6] = { 0, 1, 1, 2, 2, 0 }, inner[6] = { 2, 2, 0, 0, 1, 1 };
    static const int below[6] = { 0, 2, 1, 0, 2, 1 }, above[6] = { 2, 1, 0, 2, 1, 0 };
    (void)p;
    double a = fmod(fabs(q.x) / CELL_X, 6), b = fmod((q.z < 0 ? PERIOD_Z - fabs(q.z) : q.z) / CELL_Z, 6);
    if (b < 0) b += 6;
    int i = (int)a % 6, j = (int)b % 6;
    if (i == 0 || i == 5) return outer[j];
    if (i == 2 || i == 3) return inner[j];
    double x = a - i, z = b - j;
    if ((i + j) % 2) x = 1 - x;
    if (x == 0) x = .0001;
    return z / x < 1 ? below[j] : above[j];
}

/* The fractional part, in [0, 1). */
static double cycle(double x) { double f = x - trunc(x); return f < 0 ? f + 1 : f; }

static double brick_value(const Pattern *p, Vec3 q)
{
    double m = p->mortar, w = p->brick_size.x, h = p->brick_size.y, d = p->brick_size.z;
    double x = q.x + m + GRID_SHIFT, y = q.y + m + GRID_SHIFT, z = q.z + m + GRID_SHIFT;
    if (cycle(y / h) <= m / h) return 0;
    bool is_even_row = cycle(y / (2 * h)) <= .5;
    double shift_x = is_even_row ? 0 : .5, shift_z = is_even_row ? .5 : 0;
    return cycle(x / w + shift_x) > m / w && cycle(z / d + shift_z) > m / d;
}

/* ---- values ---- */

static double gradient_value(const Pattern *p, Vec3 q)
{
    double t = vec_dot(q, vec_normalize(p->direction));
    return t > 1 ? fmod(t, 1) : t;
}

static double onion_value(const Pattern *p, Vec3 q) { (void)p; return fmod(vec_length(q), 1); }
static double spherical_value(const Pattern *p, Vec3 q) { (void)p; return 1 - fmin(1, vec_length(q)); }
static double cylindrical_value(const Pattern *p, Vec3 q) { (void)p; return 1 - fmin(1, hypot(q.x, q.z)); }
static double planar_value(const Pattern *p, Vec3 q) { (void)p; return 1 - fmin(1, fabs(q.y)); }
static double boxed_value(const Pattern *p, Vec3 q) { (void)p; return 1 - fmin(1, vec_max_abs(q)); }

static double radial_value(const Pattern *p, Vec3 q)
{
    (void)p;
    return fmod(.25 + (atan2(q.x, q.z) + M_PI) / (2 * M_PI), UNIT_PERIOD);
}

static double leopard_value(const Pattern *p, Vec3 q)
{
    (void)p;
    double mean = (sin(q.x) + sin(q.y) + sin(q.z)) / 3;
    return mean * mean;
}

/* ---- the table ---- */

static const PatternType pattern_types[] = {
    { .name = "checker", .n_blocks = 2, .value = checker_value, .blocks = { { .b = 1 }, { .g = 1 } } },
    { .name = "hexagon", .n_blocks = 3, .value = hexagon_value, .blocks = { { .b = 1 }, { .g = 1 }, { .r = 1 } } },
    { .name = "brick", .n_blocks = 2, .value = brick_value,
      .blocks = { { .r = .5f, .g = .5f, .b = .5f }, { .r = .6f, .g = .15f, .b = .15f } } },
    { .name = "gradient", .value = gradient_value },
    { .name = "radial", .value = radial_value, .is_rainbow = true },
    { .name = "onion", .value = onion_value },
    { .name = "leopard", .value = leopard_value },
    { .name = "planar", .value = planar_value },
    { .name = "spherical", .value = spherical_value },
    { .name = "cylindrical", .value = cylindrical_value },
    { .name = "boxed", .value = boxed_value },
};

const PatternType *pattern_type(const char *name)
{
    for (size_t i = 0; i < sizeof pattern_types / sizeof *pattern_types; i++)
        if (strcmp(name, pattern_types[i].name) == 0) return &pattern_types[i];
    return NULL;
}

Pattern pattern_make(const PatternType *type)
{
    return (Pattern){
        .type = type,
        .direction = vec(1, 0, 0),
        .brick_size = vec(8, 3, 4.5), .mortar = .5f,
        .frequency = 1, .exponent = 1,
        .wave = WAVE_RAMP,
    };
}

static double wave_value(const Pattern *p, double v)
{
    switch (p->wave) {
    case WAVE_TRIANGLE: return v < .5 ? 2 * v : 2 * (1 - v);
    case WAVE_SINE: return (1 + sin(2 * M_PI * v)) / 2;
    case WAVE_SCALLOP: return fabs(sin(M_PI * v));
    case WAVE_CUBIC: return v * v * (3 - 2 * v);
    case WAVE_POLY: return pow(v, p->exponent);
    default: return v;
    }
}

static float key_of(const void *entries, size_t size, int i)
{
    float key;
    memcpy(&key, (const char *)entries + (size_t)i * size, sizeof key);
    return key;
}

MapSpot pattern_spot(const void *entries, size_t size, int n, double value)
{
    if (value >= key_of(entries, size, n - 1)) return (MapSpot){ n - 1, n - 1, 0 };
    int j = 0;
    while (key_of(entries, size, j) < value) j++;
    double high = key_of(entries, size, j);
    if (j == 0 || high == value) return (MapSpot){ j, j, 0 };
    double low = key_of(entries, size, j - 1);
    return (MapSpot){ j - 1, j, (value - low) / (high - low) };
}

double pattern_value(const Pattern *p, Vec3 point)
{
    double v = p->type->value(p, point);
    if (p->type->n_blocks > 0) return v;
    v = fmod(v * p->frequency + p->phase, UNIT_PERIOD);
    if (v < 0) v -= floor(v);
    return wave_value(p, v);
}
