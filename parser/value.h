/* What an identifier can hold and an expression can yield. Values are small and copied; what they point to is immutable and
 * lies in the scene's arena (arrays excepted: they are mutable and shared by reference, as in POV-Ray). */
#ifndef TRIMRAY_VALUE_H
#define TRIMRAY_VALUE_H

#include "render/camera.h"
#include "render/diag.h"
#include "render/light.h"
#include "render/object.h"
#include "render/scene.h"

typedef enum {
    VALUE_NONE,
    VALUE_FLOAT, VALUE_VECTOR, VALUE_COLOR, VALUE_STRING, VALUE_ARRAY,
    VALUE_OBJECT, VALUE_TEXTURE, VALUE_PIGMENT, VALUE_FINISH, VALUE_INTERIOR, VALUE_MATERIAL, VALUE_TRANSFORM,
    VALUE_CAMERA, VALUE_LIGHT, VALUE_COLOR_MAP, VALUE_PIGMENT_MAP, VALUE_TEXTURE_MAP, VALUE_SKY_SPHERE, VALUE_FOG,
    VALUE_MACRO,
    VALUE_UNSUPPORTED      /* declared, with something that is not supported: an error where it is used */
} ValueKind;

typedef struct Array Array;
typedef struct Macro Macro;

typedef struct { const Texture *texture, *interior_texture; const Interior *interior; } Material;   /* each may be NULL */

typedef struct {
    ValueKind kind;
    int n;                                  /* VECTOR: 2 to 5 components; maps: entries */
    union {
        double number;
        double v[5];                        /* VECTOR */
        Color color;
        const char *string;
        Array *array;
        const Object *object;
        const Texture *texture;
        const Pigment *pigment;
        const Finish *finish;
        const Interior *interior;
        const Material *material;
        const Xform *xform;
        const CameraDesc *camera;
        const Light *light;
        const PigmentEntry *map;            /* COLOR_MAP, PIGMENT_MAP */
        const TextureEntry *texture_map;
        const SkySphere *sky;
        const Fog *fog;
        Macro *macro;
        struct { const char *feature; const Place *place; } unsupported;   /* the word, and where it stood */
    };
} Value;

struct Array { int n_dimensions; int dimensions[5]; size_t n; Value *items; };   /* VALUE_NONE: uninitialized element */

const char *value_kind_name(ValueKind kind);       /* "float", "vector", "texture", ... for messages */

#endif
