/* Arrays, and everything that an identifier can hold. */
#include "parser/core.h"

#include <math.h>
#include <string.h>

enum { ARRAY_MAX_DIMENSIONS = 5, ARRAY_MAX_ELEMENTS = 1 << 24, ARRAY_MAX_ALL_ELEMENTS = 1 << 26 };

/* ---- elements ---- */

static size_t read_subscript(Parser *p, int size)
{
    Place opened = expect_punct(p, '[');
    Place where = here(p);
    double i = trunc(parse_float(p));
    if (!(i >= 0 && i < size)) parse_fail(p, where, "subscript %g: this array has elements 0 to %d", i, size - 1);
    expect_close(p, ']', "the subscript", opened);
    return (size_t)i;
}

static Value *read_subscripts(Parser *p, const Array *a)
{
    size_t i = 0;
    for (int d = 0; d < a->n_dimensions; d++) i = i * (size_t)a->dimensions[d] + read_subscript(p, a->dimensions[d]);
    return &a->items[i];
}

/* An element that is an array goes on with its own subscripts. */
Value *array_element(Parser *p, Value *array)
{
    do array = read_subscripts(p, array->array);
    while (array->kind == VALUE_ARRAY && input_next_char(p) == '[');
    return array;
}

Value *look_slot(Parser *p)
{
    const Token *t = look(p);
    if (t->kind != TOKEN_WORD || p->ahead.is_raw) return NULL;
    if (p->ahead.element) return p->ahead.element;
    Value *v = word_value(word_of(t->text));
    if (!v || v->kind != VALUE_ARRAY || input_next_char(p) != '[') return v;
    Token name = *t;
    p->ahead.is_full = false;                       /* the subscript is read behind the name, which then comes back */
    v = array_element(p, v);
    p->ahead = (Lookahead){ .is_full = true, .token = name, .element = v };
    return v;
}

bool accept_value(Parser *p, ValueKind kind, Value *out)
{
    const Value *v = look_slot(p);
    if (!v) return false;
    if (v->kind == VALUE_UNSUPPORTED && (v->n == (int)kind || v->n == VALUE_NONE)) {
        Token name = *look(p);
        fail_unsupported_value(p, &name, v);
    }
    if (v->kind != kind) return false;
    *out = *v;
    input_take(p);
    return true;
}

bool parse_is_defined(Parser *p)
{
    Token name = input_raw(p);
    if (name.kind != TOKEN_WORD) parse_fail(p, name.place, "expected a name, found %s", token_name(p, &name));
    const Word *w = word_of(name.text);
    Value *v = word_value(w);
    if (v && v->kind == VALUE_ARRAY && input_next_char(p) == '[') v = array_element(p, v);
    return v && v->kind != VALUE_NONE;
}

/* ---- new arrays ---- */

static Array *new_array(Parser *p, Place where, int n_dimensions, const int dimensions[])
{
    Array *a = ARENA_NEW(p->arena, Array);
    double n = 1;
    for (int d = 0; d < n_dimensions; d++) n *= a->dimensions[d] = dimensions[d];
    if (n > ARRAY_MAX_ELEMENTS) parse_fail(p, where, "an array of %g elements is too large", n);
    p->n_elements += (size_t)n;
    if (p->n_elements > ARRAY_MAX_ALL_ELEMENTS) parse_fail(p, where, "the arrays of this scene have too many elements");
    a->n_dimensions = n_dimensions;
    a->n = (size_t)n;
    a->items = arena_zalloc(p->arena, a->n, sizeof *a->items);   /* VALUE_NONE is 0 */
    return a;
}

Value array_copy(Parser *p, Place where, Value array)
{
    const Array *from = array.array;
    Array *to = new_array(p, where, from->n_dimensions, from->dimensions);
    for (size_t i = 0; i < to->n; i++) {
        bool is_array = from->items[i].kind == VALUE_ARRAY;
        to->items[i] = is_array ? array_copy(p, where, from->items[i]) : from->items[i];
    }
    return (Value){ .kind = VALUE_ARRAY, .array = to };
}

static int read_dimension(Parser *p)
{
    Place opened = expect_punct(p, '[');
    Place where = here(p);
    int n = parse_int(p);
    if (n < 1) parse_fail(p, where, "expected a dimension of 1 or more, found %d", n);
    expect_close(p, ']', "the dimension", opened);
    return n;
}

/* { ... } for dimension d, its elements from *i on. */
static void read_elements(Parser *p, Array *a, int d, size_t *i)
{
    Place opened = expect_open(p, "array");
    for (int k = 0; k < a->dimensions[d]; k++) {
        if (d + 1 < a->n_dimensions) read_elements(p, a, d + 1, i);
        else a->items[(*i)++] = parse_value(p, "an element of the array");
        accept_comma(p);
    }
    expect_close(p, '}', "array", opened);
}

static Value parse_array(Parser *p)
{
    int dimensions[ARRAY_MAX_DIMENSIONS], n = 0;
    Place where = here(p);
    input_take(p);
    (void)accept_word(p, "mixed");
    do {
        if (n == ARRAY_MAX_DIMENSIONS)
            parse_fail(p, here(p), "an array has at most %d dimensions", ARRAY_MAX_DIMENSIONS);
        dimensions[n++] = read_dimension(p);
    } while (input_next_char(p) == '[');
    Array *a = new_array(p, where, n, dimensions);
    size_t i = 0;
    if (input_next_char(p) == '{') read_elements(p, a, 0, &i);
    return (Value){ .kind = VALUE_ARRAY, .array = a };
}

/* ---- values ---- */

static bool is_computed(ValueKind kind)
{
    return kind == VALUE_FLOAT || kind == VALUE_VECTOR || kind == VALUE_COLOR || kind == VALUE_STRING;
}

/* A declared value that is not computed with: taken without a look at what follows it. */
static Value take_declared(Parser *p, const Value *v)
{
    Token name = *look(p);
    Value copy = *v;
    if (v->kind == VALUE_NONE) parse_fail(p, name.place, "this element of '%s' has been given no value", name.text);
    char behind = input_next_char(p);
    if (v->kind == VALUE_UNSUPPORTED && behind && strchr("(.+-*/?", behind)) fail_unsupported_value(p, &name, v);
    input_take(p);
    return copy.kind == VALUE_ARRAY ? array_copy(p, name.place, copy) : copy;
}

Value parse_value(Parser *p, const char *what)
{
    const Value *declared = look_slot(p);
    if (declared && !is_computed(declared->kind)) return take_declared(p, declared);
    if (peek_word(p, "array")) return parse_array(p);
    if (starts_expression(p)) return parse_expression(p);
    Value v;
    if (parse_item(p, &v)) return v;
    parse_fail_expected(p, what);
}
