/* Colours. Components are single precision where POV-Ray's are; light is summed in double. */
#ifndef TRIMRAY_COLOR_H
#define TRIMRAY_COLOR_H

#include <stdbool.h>

typedef struct { float r, g, b, filter, transmit; } Color;   /* of a pigment */
typedef struct { double r, g, b; } Rgb;                      /* light, linear */

static inline Rgb rgb(double r, double g, double b) { return (Rgb){ r, g, b }; }
static inline Rgb rgb_add(Rgb a, Rgb b) { return rgb(a.r + b.r, a.g + b.g, a.b + b.b); }
static inline Rgb rgb_mul(Rgb a, Rgb b) { return rgb(a.r * b.r, a.g * b.g, a.b * b.b); }
static inline Rgb rgb_scale(Rgb a, double s) { return rgb(a.r * s, a.g * s, a.b * s); }
static inline bool rgb_is_black(Rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }
static inline double rgb_grey(Rgb a) { return .297 * a.r + .589 * a.g + .114 * a.b; }   /* POV-Ray's weights */
static inline Rgb color_rgb(Color c) { return rgb(c.r, c.g, c.b); }
static inline double rgb_max(Rgb a)
{
    double m = a.r > a.g ? a.r : a.g;
    return m > a.b ? m : a.b;
}
static inline Color color_lerp(Color a, Color b, double s)                   /* (1-s) a + s b, in all five components */
{
    double r = 1 - s;
    return (Color){ (float)(r * a.r + s * b.r), (float)(r * a.g + s * b.g), (float)(r * a.b + s * b.b),
                    (float)(r * a.filter + s * b.filter), (float)(r * a.transmit + s * b.transmit) };
}

#endif
