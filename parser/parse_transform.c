/* translate, rotate, scale, matrix and transform: one after another they become one map, in the order in which they are
 * written (points are rows, p' = p M). */
#include "parser/rules.h"

#include <string.h>

static Xform read_translate(Parser *p, Place where)
{
    (void)where;
    return xform_translate(parse_vec3(p));
}

static Xform read_rotate(Parser *p, Place where)
{
    (void)where;
    return xform_rotate(parse_vec3(p));
}

/* A component of 0 is read as 1, as POV-Ray does. */
static double scale_component(Parser *p, Place where, char axis, double s)
{
    if (s != 0) return s;
    parse_warn(p, where, "scale by 0 along %c is read as 1", axis);
    return 1;
}

static Xform read_scale(Parser *p, Place where)
{
    Vec3 s = parse_vec3(p);
    s.x = scale_component(p, where, 'x', s.x);
    s.y = scale_component(p, where, 'y', s.y);
    s.z = scale_component(p, where, 'z', s.z);
    return xform_scale(s);
}

static Xform read_matrix(Parser *p, Place where)
{
    double m[12];
    Place opened = expect_punct(p, '<');
    for (int i = 0; i < 12; i++) {
        m[i] = parse_float(p);
        if (i < 11) accept_comma(p);
    }
    expect_close(p, '>', "matrix", opened);
    Xform x = xform_identity();
    if (!xform_from_matrix(m, &x)) parse_error(p, where, "this matrix has no inverse");
    return x;
}

/* transform T, transform { T }, transform { rotate ... inverse }: `inverse` turns the whole block round. */
static Xform read_transform(Parser *p, Place where)
{
    (void)where;
    Value v;
    if (accept_value(p, VALUE_TRANSFORM, &v)) return *v.xform;
    Place opened = expect_open(p, "transform");
    Xform x = xform_identity();
    bool is_inverse = false;
    for (;;) {
        if (accept_value(p, VALUE_TRANSFORM, &v)) x = xform_then(x, *v.xform);
        else if (accept_word(p, "inverse")) is_inverse = true;
        else if (!parse_transformation(p, &x)) break;
    }
    expect_close(p, '}', "transform", opened);
    return is_inverse ? xform_inverse(x) : x;
}

static const struct {
    const char *word;
    Xform (*read)(Parser *p, Place where);
} transformations[] = {
    { "translate", read_translate }, { "rotate", read_rotate }, { "scale", read_scale },
    { "matrix", read_matrix }, { "transform", read_transform },
};

bool parse_transformation(Parser *p, Xform *accumulate)
{
    Token t = peek(p);
    if (t.kind != TOKEN_WORD) return false;
    for (size_t i = 0; i < sizeof transformations / sizeof *transformations; i++) {
        if (strcmp(t.text, transformations[i].word) != 0) continue;
        next(p);
        *accumulate = xform_then(*accumulate, transformations[i].read(p, t.place));
        return true;
    }
    return false;
}
