/* The table of objects, and a short function for each: it reads values and calls a constructor. To add a primitive, write
 * its function and its row. NURBS and patches are read in parse_nurbs.c. */
#include "parser/rules.h"

#include <string.h>

Shape *shape_stand_in(Parser *p)
{
    return sphere_new(parser_arena(p), vec(0, 0, 0), 1);
}

/* A constructor's answer: NULL is reported in the words given. */
static Shape *made(Parser *p, Place word, Shape *s, const char *why_not)
{
    if (s) return s;
    parse_error(p, word, "%s", why_not);
    return shape_stand_in(p);
}

static Vec3 vec3_comma(Parser *p)
{
    Vec3 v = parse_vec3(p);
    accept_comma(p);
    return v;
}

static double float_comma(Parser *p)
{
    double x = parse_float(p);
    accept_comma(p);
    return x;
}

static Shape *parse_sphere(Parser *p, Place word)
{
    Vec3 centre = vec3_comma(p);
    return made(p, word, sphere_new(parser_arena(p), centre, parse_float(p)), "this sphere's radius is 0");
}

static Shape *parse_plane(Parser *p, Place word)
{
    Vec3 normal = vec3_comma(p);
    return made(p, word, plane_new(parser_arena(p), normal, parse_float(p)), "this plane's normal is 0");
}

static Shape *parse_box(Parser *p, Place word)
{
    Vec3 corner = vec3_comma(p);
    return made(p, word, box_shape_new(parser_arena(p), corner, parse_vec3(p)), "this box is empty");
}

static Shape *parse_cylinder(Parser *p, Place word)
{
    Vec3 base = vec3_comma(p), cap = vec3_comma(p);
    double radius = parse_float(p);
    bool is_open = accept_word(p, "open");
    Shape *s = cylinder_new(parser_arena(p), base, cap, radius, is_open);
    return made(p, word, s, "this cylinder has no length or no radius");
}

static Shape *parse_cone(Parser *p, Place word)
{
    Vec3 base = vec3_comma(p);
    double base_radius = float_comma(p);
    Vec3 cap = vec3_comma(p);
    double cap_radius = parse_float(p);
    bool is_open = accept_word(p, "open");
    Shape *s = cone_new(parser_arena(p), base, base_radius, cap, cap_radius, is_open);
    return made(p, word, s, "this cone has no length or no radius");
}

static Shape *parse_torus(Parser *p, Place word)
{
    double major = float_comma(p);
    return made(p, word, torus_new(parser_arena(p), major, parse_float(p)), "this torus has no radius");
}

static Shape *parse_disc(Parser *p, Place word)
{
    Vec3 centre = vec3_comma(p), normal = vec3_comma(p);
    double radius = parse_float(p), hole = accept_punct(p, ',') ? parse_float(p) : 0;
    return made(p, word, disc_new(parser_arena(p), centre, normal, radius, hole), "this disc's normal or radius is 0");
}

/* A triangle without an area is left out, as in POV-Ray. */
static Shape *triangle_or_nothing(Parser *p, Place word, Shape *s)
{
    if (s) return s;
    parse_warn(p, word, "this triangle has no area: it is left out");
    return union_new(parser_arena(p), NULL, 0);
}

static Shape *parse_triangle(Parser *p, Place word)
{
    Vec3 corners[3];
    for (int i = 0; i < 3; i++) corners[i] = i < 2 ? vec3_comma(p) : parse_vec3(p);
    return triangle_or_nothing(p, word, triangle_new(parser_arena(p), corners));
}

static Shape *parse_smooth_triangle(Parser *p, Place word)
{
    Vec3 corners[3], normals[3];
    for (int i = 0; i < 3; i++) {
        corners[i] = vec3_comma(p);
        normals[i] = i < 2 ? vec3_comma(p) : parse_vec3(p);
    }
    return triangle_or_nothing(p, word, smooth_triangle_new(parser_arena(p), corners, normals));
}

/* An object without any modifier is nothing but its shape. */
static bool is_plain(const Object *o)
{
    return !o->is_placed && !o->texture && !o->interior_texture && !o->interior && !o->has_uv_mapping && !o->no_shadow &&
        !o->no_image && !o->no_reflection && !o->is_inverse && !o->is_hollow && !o->double_illuminate;
}

/* The next part of a compound; of all compounds, unions alone have lights among their parts. NULL: there is none. */
static Object *parse_part(Parser *p, bool is_union)
{
    if (!is_union) refuse_word(p, "light_source", "light_source in a compound");
    return parse_any_object(p);
}

/* The parts of a compound, each as its bare shape where that is all that it is. */
static Shape **parse_parts(Parser *p, bool is_union, uint32_t *n)
{
    Shape **parts = NULL;
    size_t n_parts = 0, capacity = 0;
    for (Object *o; (o = parse_part(p, is_union)) != NULL;)
        ARENA_PUSH(parser_arena(p), parts, n_parts, capacity) = is_plain(o) ? o->child : &o->shape;
    *n = (uint32_t)n_parts;
    return parts;
}

static Shape *parse_union(Parser *p, Place word)
{
    (void)word;
    uint32_t n;
    Shape **parts = parse_parts(p, true, &n);
    return union_new(parser_arena(p), parts, n);
}

static Shape **parse_csg_parts(Parser *p, Place word, uint32_t *n)
{
    Shape **parts = parse_parts(p, false, n);
    if (*n < 2) parse_warn(p, word, "expected at least 2 objects in a compound, found %u", *n);
    return parts;
}

static Shape *parse_intersection(Parser *p, Place word)
{
    uint32_t n;
    Shape **parts = parse_csg_parts(p, word, &n);
    return intersection_new(parser_arena(p), parts, n);
}

static Shape *parse_difference(Parser *p, Place word)
{
    uint32_t n;
    Shape **parts = parse_csg_parts(p, word, &n);
    return difference_new(parser_arena(p), parts, n);
}

static Shape *parse_merge(Parser *p, Place word)
{
    uint32_t n;
    Shape **parts = parse_csg_parts(p, word, &n);
    return merge_new(parser_arena(p), parts, n);
}

static const ShapeRule rules[] = {
    { .word = "sphere", .read = parse_sphere },
    { .word = "plane", .read = parse_plane },
    { .word = "box", .read = parse_box },
    { .word = "cylinder", .read = parse_cylinder },
    { .word = "cone", .read = parse_cone },
    { .word = "torus", .read = parse_torus },
    { .word = "disc", .read = parse_disc },
    { .word = "triangle", .read = parse_triangle },
    { .word = "smooth_triangle", .read = parse_smooth_triangle },
    { .word = "bicubic_patch", .read = parse_bicubic_patch },
    { .word = "trimmed_nurbs", .read = parse_trimmed_nurbs, .may_use_angles = true },
    { .word = "nurbs", .read = parse_hg_nurbs },
    { .word = "union", .read = parse_union },
    { .word = "intersection", .read = parse_intersection },
    { .word = "difference", .read = parse_difference },
    { .word = "merge", .read = parse_merge },
    { .word = "mesh", .read = parse_mesh },
    { .word = "mesh2", .read = parse_mesh2 },
};

const ShapeRule *shape_rule_at(size_t i)
{
    return i < sizeof rules / sizeof *rules ? &rules[i] : NULL;
}

const ShapeRule *shape_rule(const char *word)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (strcmp(word, rules[i].word) == 0) return &rules[i];
    return NULL;
}
