/* Names of the kinds of values. */
#include "parser/value.h"

const char *value_kind_name(ValueKind kind)
{
    static const char *const names[] = {
        [VALUE_NONE] = "nothing", [VALUE_FLOAT] = "float", [VALUE_VECTOR] = "vector", [VALUE_COLOR] = "color",
        [VALUE_STRING] = "string", [VALUE_ARRAY] = "array", [VALUE_OBJECT] = "object", [VALUE_TEXTURE] = "texture",
        [VALUE_PIGMENT] = "pigment", [VALUE_FINISH] = "finish", [VALUE_INTERIOR] = "interior", [VALUE_MATERIAL] = "material",
        [VALUE_TRANSFORM] = "transform", [VALUE_CAMERA] = "camera", [VALUE_LIGHT] = "light_source",
        [VALUE_COLOR_MAP] = "color_map", [VALUE_PIGMENT_MAP] = "pigment_map",
        [VALUE_TEXTURE_MAP] = "texture_map", [VALUE_SKY_SPHERE] = "sky_sphere",
        [VALUE_FOG] = "fog", [VALUE_MACRO] = "macro", [VALUE_UNSUPPORTED] = "unsupported",
    };
    return names[kind];
}
