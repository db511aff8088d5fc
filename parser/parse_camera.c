/* camera { }: items in any order, transformations act last (measured with POV-Ray 3.7). camera.c makes sense of them. */
#include "parser/rules.h"

#include <string.h>

static void read_location(Parser *p, CameraDesc *c) { c->location = parse_vec3(p); }
static void read_direction(Parser *p, CameraDesc *c) { c->direction = parse_vec3(p); }
static void read_sky(Parser *p, CameraDesc *c) { c->sky = parse_vec3(p); }

static void read_right(Parser *p, CameraDesc *c)
{
    c->right = parse_vec3(p);
    c->has_right_or_up = true;
}

static void read_up(Parser *p, CameraDesc *c)
{
    c->up = parse_vec3(p);
    c->has_right_or_up = true;
}

static void read_look_at(Parser *p, CameraDesc *c)
{
    c->look_at = parse_vec3(p);
    c->has_look_at = true;
}

static void read_angle(Parser *p, CameraDesc *c)
{
    c->angle = starts_expression(p) ? parse_float(p) : 0;
    c->has_angle = true;
}

static const struct {
    const char *word;
    void (*read)(Parser *p, CameraDesc *c);
} words[] = {
    { "location", read_location }, { "direction", read_direction }, { "sky", read_sky }, { "right", read_right },
    { "up", read_up }, { "look_at", read_look_at }, { "angle", read_angle },
};

static bool read_transformation(Parser *p, CameraDesc *c) { return parse_transformation(p, &c->xform); }

static bool read_item(Parser *p, CameraDesc *c)
{
    Token t = peek(p);
    for (size_t i = 0; t.kind == TOKEN_WORD && i < sizeof words / sizeof *words; i++) {
        if (strcmp(t.text, words[i].word) != 0) continue;
        next(p);
        words[i].read(p, c);
        return true;
    }
    return read_transformation(p, c);
}

static bool accept_kind(Parser *p, CameraKind *kind)
{
    if (accept_word(p, "perspective")) *kind = CAMERA_PERSPECTIVE;
    else if (accept_word(p, "orthographic")) *kind = CAMERA_ORTHOGRAPHIC;
    else return false;
    return true;
}

void parse_camera(Parser *p, CameraDesc *out)
{
    Place opened = expect_open(p, "camera");
    Value v;
    if (accept_value(p, VALUE_CAMERA, &v)) {
        *out = *v.camera;
        while (read_transformation(p, out)) continue;
        expect_close(p, '}', "camera", opened);
        return;
    }
    refuse_word(p, "spherical", "spherical camera");
    refuse_word(p, "cylinder", "cylinder camera");
    *out = camera_desc_default();
    accept_kind(p, &out->kind);
    while (read_item(p, out)) continue;
    Token t = peek(p);
    CameraKind late;
    if (accept_kind(p, &late)) parse_fail(p, t.place, "'%s' must be the first word in camera", t.text);
    expect_close(p, '}', "camera", opened);
}
