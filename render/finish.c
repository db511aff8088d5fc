/* Diffuse, phong, specular, metallic, reflection: POV-Ray's formulas, with its letters where it has any. */
#include "render/finish.h"

#include <math.h>

Finish finish_default(void)
{
    return (Finish){
        .ambient = { .1, .1, .1 },
        .diffuse = .6, .brilliance = 1,
        .phong_size = 40, .roughness = .05,
        .reflection_falloff = 1, .reflection_exponent = 1,
    };
}

/* An approximation of Fresnel's curve that POV-Ray uses to let a metal's highlight turn white towards grazing angles. */
static double metallic_fresnel(double cosine)
{
    double x = acos(fmin(fmax(cosine, -1), 1)) / M_PI_2;
    double to_pole = x - 1.12;
    return fmin(fmax(.014567225 / (to_pole * to_pole) - .011612903, 0), 1);
}

static Rgb metallic_tint(double metallic, Rgb pigment, double cosine)
{
    double share = metallic * (1 - metallic_fresnel(cosine));
    return rgb(1 + share * (pigment.r - 1), 1 + share * (pigment.g - 1), 1 + share * (pigment.b - 1));
}

/* x^exponent. Highlights mostly have whole exponents, and then it is found by squaring, off by as many roundings as the exponent
 * says, which are nothing beside a step of 1/65535. */
static double power(double x, double exponent)
{
    static const double MOST = 1 << 20;
    if (!(exponent >= 0 && exponent <= MOST) || exponent != (double)(int)exponent) return pow(x, exponent);
    double result = 1;
    for (unsigned n = (unsigned)exponent; n > 0; n >>= 1, x *= x)
        if (n & 1) result *= x;
    return result;
}

static double phong_amount(const Finish *f, Vec3 n, Vec3 dir, Vec3 to_light)
{
    Vec3 mirrored = vec_sub(dir, vec_scale(n, 2 * vec_dot(dir, n)));
    double k = vec_dot(mirrored, to_light);
    if (!(k > 0) || (f->phong_size >= 60 && k <= .0008)) return 0;   /* the second: POV-Ray's cut of what is nothing */
    double strength = f->phong_albedo ? f->phong * (f->phong_size + 1) / 2 : f->phong;
    return strength * power(k, f->phong_size);
}

static double specular_amount(const Finish *f, Vec3 n, Vec3 dir, Vec3 to_light)
{
    Vec3 half = vec_sub(to_light, dir);
    double k = vec_dot(half, n) / vec_length(half);
    if (!(k > 0)) return 0;
    double r = 1 / f->roughness, strength = f->specular;
    if (f->specular_albedo) strength *= (r + 2) / (4 * (2 - exp2(-r / 2)));
    return strength * power(k, r);
}

Rgb finish_highlights(const Finish *f, Rgb pigment, Vec3 n, Vec3 dir, Vec3 to_light, Rgb light)
{
    double amount = 0;
    if (f->phong > 0) amount += phong_amount(f, n, dir, to_light);
    if (f->specular > 0) amount += specular_amount(f, n, dir, to_light);
    if (!(amount > 0)) return rgb(0, 0, 0);
    Rgb shine = rgb_scale(light, amount);
    return f->metallic > 0 ? rgb_mul(shine, metallic_tint(f->metallic, pigment, vec_dot(n, to_light))) : shine;
}

double finish_fresnel(double cos_view, double ior_ratio)
{
    double c = cos_view, q = ior_ratio * ior_ratio + c * c - 1;
    if (!(q > 0)) return 1;
    double g = sqrt(q);
    double across = (g - c) / (g + c), along = (c * (g + c) - 1) / (c * (g - c) + 1);
    return fmin(fmax(.5 * across * across * (1 + along * along), 0), 1);
}

Rgb finish_reflectivity(const Finish *f, Rgb pigment, double cos_view, double ior_ratio)
{
    double share = f->reflection_fresnel ? finish_fresnel(cos_view, ior_ratio)
                 : f->reflection_falloff == 1 ? 1 - cos_view
                 : pow(fmax(1 - cos_view, 0), f->reflection_falloff);
    Rgb r = rgb_add(rgb_scale(f->reflection_max, share), rgb_scale(f->reflection_min, 1 - share));
    return f->reflection_metallic > 0 ? rgb_mul(r, metallic_tint(f->reflection_metallic, pigment, cos_view)) : r;
}
