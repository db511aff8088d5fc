/* What the files of parse rules share among themselves; the core of the parser sees state.h alone. */
#ifndef TRIMRAY_RULES_H
#define TRIMRAY_RULES_H

#include "parser/state.h"

/* An object of the scene language: its word, and what reads the inside of its block up to the first modifier. A rule
 * returns a shape always: what describes none is reported and replaced (see shape_stand_in), so that reading can go on. */
typedef struct {
    const char *word;
    Shape *(*read)(Parser *p, Place word);
    bool may_use_angles;                    /* < ... > may stand in place of { ... } */
} ShapeRule;

/* parse_shape.c: the one table of them. */
const ShapeRule *shape_rule(const char *word);          /* NULL: no such object */
const ShapeRule *shape_rule_at(size_t i);               /* NULL: past the end */
Shape *shape_stand_in(Parser *p);                       /* in place of a shape that was reported */

/* parse_nurbs.c */
Shape *parse_trimmed_nurbs(Parser *p, Place word);
Shape *parse_hg_nurbs(Parser *p, Place word);
Shape *parse_bicubic_patch(Parser *p, Place word);

/* parse_mesh.c */
Shape *parse_mesh(Parser *p, Place word);
Shape *parse_mesh2(Parser *p, Place word);

/* parse_object.c */
void parse_modifiers(Parser *p, Object *o);             /* all that follow */
void skip_block(Parser *p, const char *what);           /* { ... }, whatever is in it */
/* If the next token is one of `words` (NULL-terminated), which cannot matter here, reads it with the number or block
 * that belongs to it, and warns once. */
bool parse_left_out(Parser *p, const char *const words[]);
/* If the next token is `word`, which is supported elsewhere but not here, fails with `feature`: "object pattern". */
void refuse_word(Parser *p, const char *word, const char *feature);

/* parse_texture.c */
bool parse_texture_item(Parser *p, const Texture **t);  /* what may stand in texture { }: changes *t; false: none */
const Texture *texture_with_pigment(Parser *p, const Texture *t);    /* after the word: the top layer's is changed */
const Texture *texture_with_finish(Parser *p, const Texture *t);
const Texture *texture_layered(Parser *p, const Texture *below, const Texture *top);   /* `top` may be a map: an error */
const Texture *parse_texture_body(Parser *p);           /* what stands between the braces */
/* parse_pattern.c: after the word; then what shapes a pattern, of which there may be any number. */
Pattern parse_pattern(Parser *p, const PatternType *type);
bool parse_pattern_item(Parser *p, Pattern *g);
/* parse_texture_map.c: a texture that begins with a pattern's word; NULL, nothing taken: it does not. */
const Texture *parse_mapped_texture(Parser *p);
void parse_texture_map(Parser *p, const TextureEntry **entries, int *n);   /* after the word */

/* parse_pigment.c: the braces of any map, after the word. One that is declared goes to *declared (true); else entries are
 * read, each between its brackets. */
bool parse_map(Parser *p, const char *what, ValueKind kind, Value *declared,
               void (*read_entry)(Parser *p, void *draft), void *draft);
/* After the word. POV-Ray's pigments and finishes start from what was there: so do these. */
Pigment parse_pigment_from(Parser *p, const Pigment *base);
const PigmentEntry *parse_color_map(Parser *p, int *n);
const PigmentEntry *parse_pigment_map(Parser *p, int *n);

/* parse_image.c: after the word */
const ImageMap *parse_image_map(Parser *p);
/* parse_material.c: after the word */
Material parse_material(Parser *p);
/* parse_finish.c */
Finish parse_finish_from(Parser *p, Finish base);

/* parse_light.c: a light as an object, with what it looks like (NULL: nothing) */
Object *light_as_object(Parser *p, const Light *l, Object *look);
/* parse_settings.c: after the word */
void parse_background(Parser *p);
void parse_global_settings(Parser *p);
const SkySphere *parse_sky_sphere(Parser *p);
const Fog *parse_fog(Parser *p);
void settings_begin(Parser *p);
void settings_end(Parser *p);

static inline bool place_is_known(Place w) { return w.source != NULL; }

#endif
