/* What a point looks like before light: textures are layers of a pigment with a finish. Values only; pigment.c, pattern.c
 * and image_map.c evaluate them, shade.c lights them. Everything is immutable once built and may be shared. */
#ifndef TRIMRAY_TEXTURE_H
#define TRIMRAY_TEXTURE_H

#include "render/arena.h"
#include "render/color.h"
#include "render/vec.h"
#include "render/xform.h"

#include <stdbool.h>

/* ---- patterns: a number for each point ---- */

typedef enum { WAVE_RAMP, WAVE_TRIANGLE, WAVE_SINE, WAVE_SCALLOP, WAVE_CUBIC, WAVE_POLY } Wave;

typedef struct Pattern Pattern;
typedef struct {
    const char *name;                                /* the scene's word */
    int n_blocks;                                    /* 0: value() is in [0, 1] and goes through waves and a map; checker 2,
                                                        brick 2, hexagon 3: value() is the number of the block */
    double (*value)(const Pattern *p, Vec3 point);
    Color blocks[3];                                 /* the colours of blocks that the scene does not give */
    bool is_rainbow;                                 /* default map: cyan, yellow, magenta, cyan; else black to white */
} PatternType;

struct Pattern {
    const PatternType *type;
    Vec3 direction;                                  /* gradient */
    Vec3 brick_size;
    float mortar;
    double frequency, phase, exponent;               /* 1, 0, 1 where not given */
    Wave wave;
};

const PatternType *pattern_type(const char *name);   /* NULL: no such pattern. One table, in pattern.c */
Pattern pattern_make(const PatternType *type);       /* with POV-Ray's defaults */
double pattern_value(const Pattern *p, Vec3 point);  /* with frequency, phase and wave applied (not for blocks) */

/* Where a value lies in a map, whose n > 0 entries of `size` bytes begin with a float, their key, and ascend: `share` of the
 * way from the entry `low` to the entry `high`. Below the first and above the last key both are that entry, as they are at
 * an entry's own key. Two entries with the same key are a step. */
typedef struct { int low, high; double share; } MapSpot;
MapSpot pattern_spot(const void *entries, size_t size, int n, double value);

/* ---- pigments ---- */

typedef struct Pigment Pigment;
typedef struct ImageMap ImageMap;                    /* image_map.h */
typedef struct { float key; const Pigment *pigment; } PigmentEntry;

typedef enum { PIGMENT_COLOR, PIGMENT_BLOCKS, PIGMENT_MAP, PIGMENT_IMAGE } PigmentKind;

struct Pigment {
    PigmentKind kind;
    Color color;                                     /* PIGMENT_COLOR */
    Pattern pattern;                                 /* PIGMENT_BLOCKS, PIGMENT_MAP */
    const PigmentEntry *entries;                     /* BLOCKS: n_blocks of them; MAP: keys ascending. Fewer: */
    int n_entries;                                   /* the pattern's own colours, its default map */
    const ImageMap *image;                           /* PIGMENT_IMAGE */
    bool uv_mapping;
    bool is_moved;                                   /* space is not the identity */
    Xform space;                                     /* from the pigment's space to the texture's */
};

Pigment pigment_solid(Color c);
void pigment_transform(Pigment *p, const Xform *x);
/* The colour at a point of the pigment's outer space; uv is used where uv_mapping asks for it. */
Color pigment_color_at(const Pigment *p, Vec3 point, Vec2 uv);
static inline Color pigment_color(const Pigment *p, Vec3 point, Vec2 uv)
{
    return p->kind == PIGMENT_COLOR ? p->color : pigment_color_at(p, point, uv);
}
bool pigment_is_opaque(const Pigment *p);            /* no filter or transmit anywhere in it */

/* ---- finishes: POV-Ray's names, meanings and defaults ---- */

typedef struct {
    Rgb ambient, emission;                           /* .1, 0 */
    double diffuse, diffuse_back, brilliance;        /* .6, 0, 1 */
    double phong, phong_size, specular, roughness;   /* 0, 40, 0, .05 */
    double metallic;                                 /* 0 */
    bool diffuse_albedo, phong_albedo, specular_albedo;
    bool has_reflection;
    Rgb reflection_min, reflection_max;
    double reflection_falloff, reflection_exponent, reflection_metallic;   /* 1, 1, 0 */
    bool reflection_fresnel, conserve_energy;
} Finish;

Finish finish_default(void);

typedef struct { const Pigment *pigment; Finish finish; } Layer;

typedef struct Texture Texture;
typedef struct { float key; const Texture *texture; } TextureEntry;
typedef struct {                                     /* a choice between textures, by a pattern */
    Pattern pattern;
    const TextureEntry *entries;                     /* blocks: n_blocks of them; else at least one, keys ascending */
    int n_entries;
    Xform space;                                     /* from the map's space to the outer one */
} TextureMap;
struct Texture {
    const Layer *layers;                             /* as written: the last is on top */
    int n_layers;
    const TextureMap *map;                           /* NULL: it has layers; else it has none */
    bool uv_mapping;
};

/* What a texture with a map is at a point: one texture, or two that are blended, each lit for itself; returns how many. */
typedef struct { const Texture *texture; Vec3 point; double share; } TextureChoice;
int texture_choose(const TextureMap *map, Vec3 point, TextureChoice out[2]);

/* A copy with x applied to every pigment in it, or to its map. */
Texture *texture_transformed(Arena *a, const Texture *t, const Xform *x);
bool texture_is_opaque(const Texture *t);
bool texture_reflects(const Texture *t);
bool texture_is_even(const Texture *t);              /* the same everywhere */

typedef struct Interior {
    float ior, fade_distance, fade_power;            /* 1, 0, 0 */
    float caustics;                                  /* 0 */
    Color fade_color;                                /* black */
} Interior;

#endif
