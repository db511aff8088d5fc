/* The parser as its own parts see it: tokens, expectations, failing, expressions. The rules for objects, textures and the
 * like (parse_object.c and its neighbours) use nothing else of the core.
 *
 * A parse function reads its construct or does not return: parse_fail jumps to the statement loop, which notes the error,
 * skips to the end of the statement and goes on. Everything lies in the scene's arena, so nothing leaks. */
#ifndef TRIMRAY_PARSER_STATE_H
#define TRIMRAY_PARSER_STATE_H

#include "parser/parser.h"
#include "parser/value.h"

typedef enum { TOKEN_END, TOKEN_NUMBER, TOKEN_STRING, TOKEN_WORD, TOKEN_PUNCT } TokenKind;

typedef struct {
    TokenKind kind;
    Place place;
    double number;            /* NUMBER */
    const char *text;         /* WORD: interned, '\0'-terminated; STRING: its content */
    char punct;               /* PUNCT: one of { } < > ( ) [ ] , ; . + - * / ? : = ! & | and 'L' <=  'G' >=  'N' != */
} Token;

typedef struct Parser Parser;

/* What parse rules may touch of the parser. */
Arena *parser_arena(Parser *p);
Diag *parser_diag(Parser *p);
Scene *parser_scene(Parser *p);
const ParseOptions *parser_options(Parser *p);
ParseSummary *parser_summary(Parser *p);

/* ---- tokens: directives and macros are done before a token is seen ---- */
Token peek(Parser *p);
Token next(Parser *p);
Place here(Parser *p);                                   /* of the next token */
bool peek_word(Parser *p, const char *word);
bool peek_punct(Parser *p, char punct);
bool accept_word(Parser *p, const char *word);           /* takes it if it is next */
bool accept_punct(Parser *p, char punct);
void accept_comma(Parser *p);                            /* an optional comma */
Place expect_punct(Parser *p, char punct);               /* "expected '{', found 'camera'" */
Place expect_open(Parser *p, const char *what);          /* '{' after `what`; returns the place of `what`'s brace */
/* Closes what expect_open opened: "expected '}' to close sphere (line 12), found 'camera'". */
void expect_close(Parser *p, char punct, const char *what, Place opened);

/* ---- failing ---- */
_Noreturn void parse_fail(Parser *p, Place where, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* "expected `what`, found 'token'"; if the token is an unknown word, "unknown identifier 'sphre'; did you mean 'sphere'?"; if
 * it is a feature of POV-Ray without support (keywords.c), "'media' is a POV-Ray feature that is not supported here". */
_Noreturn void parse_fail_expected(Parser *p, const char *what);
_Noreturn void parse_fail_unsupported(Parser *p, Token feature);
void parse_error(Parser *p, Place where, const char *format, ...) __attribute__((format(printf, 3, 4)));   /* goes on */
void parse_warn(Parser *p, Place where, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Once a run for each key: "'radiosity' is read and ignored". */
void parse_warn_once(Parser *p, Place where, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* ---- expressions ---- */
Value parse_expression(Parser *p);                       /* float, vector, colour or string, whichever it is */
bool starts_expression(Parser *p);                       /* could the next token begin one? */
double parse_float(Parser *p);
int parse_int(Parser *p);                                /* truncated */
bool parse_optional_bool(Parser *p, bool when_absent);   /* `hollow`, `hollow on`, `hollow 0` */
Vec3 parse_vec3(Parser *p);                              /* a float fills all three; a 2-vector gets z = 0 */
Vec2 parse_vec2(Parser *p);
int parse_vector(Parser *p, double out[5]);              /* returns the number of components; a float is 1 component */
Color parse_color(Parser *p);                            /* with or without the word color; a vector is an error */
Rgb parse_rgb(Parser *p);                                /* a colour, or a float that fills three */
const char *parse_string(Parser *p);

/* If the next token is an identifier (or an element of an array) that holds a value of this kind, takes it. One that is
 * VALUE_UNSUPPORTED and would do here fails with its feature and the place where it was declared. */
bool accept_value(Parser *p, ValueKind kind, Value *out);

/* ---- the rules for objects and the like, which the core calls ---- */

/* parse_object.c: a word that begins an object, texture, pigment, finish, interior, transform, camera, light_source,
 * color_map, ...: reads it into *out for #declare, macro arguments and arrays; false, nothing taken: it is none of them. */
bool parse_item(Parser *p, Value *out);
/* A statement at file level that is not a directive: an object is added to the scene, camera set, and so on. */
void parse_statement(Parser *p);
/* #default { texture | pigment | finish }, after the brace. */
void parse_default_items(Parser *p);
/* Called once before the first statement, and after the last. */
void parse_begin(Parser *p);
void parse_end(Parser *p);

/* The words that may begin an object or an item, for "did you mean": a NULL-terminated list. */
const char *const *parse_object_words(void);

/* ---- shared by the rule files ---- */
Object *parse_any_object(Parser *p);                     /* NULL, nothing taken: the next token begins no object */
bool parse_transformation(Parser *p, Xform *accumulate); /* translate, rotate, ...; false: the next token is none */
const Texture *parse_texture(Parser *p);                 /* after the word: '{ ... }' */
const Pigment *parse_pigment(Parser *p);
Finish parse_finish(Parser *p);
const Interior *parse_interior(Parser *p);
void parse_camera(Parser *p, CameraDesc *out);
Object *parse_light(Parser *p, Light *out);              /* returns what it looks like; NULL: nothing */

#endif
