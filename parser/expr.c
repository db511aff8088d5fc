/* Expressions by precedence climbing from one table, and the reading functions of state.h that are made of them. */
#include "parser/expr.h"
#include "parser/functions.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* ---- terms ---- */

Term term_vec3(Vec3 v) { return (Term){ .n = 3, .v = { v.x, v.y, v.z } }; }

const char *term_name(const Term *t)
{
    return t->n == 0 ? "a string" : t->is_color ? "a colour" : t->n == 1 ? "a float" : "a vector";
}

/* "a float", "a vector of 2 components" */
static const char *term_size(Parser *p, const Term *t)
{
    return t->n < 2 || t->is_color ? term_name(t) : arena_printf(p->arena, "a vector of %d components", t->n);
}

Term need_numbers(Parser *p, Place where, Term t)
{
    if (t.n == 0) parse_fail(p, where, "expected a number or a vector, found a string");
    return t;
}

double need_float(Parser *p, Place where, Term t)
{
    if (t.n != 1) parse_fail(p, where, "expected a float, found %s", term_name(&t));
    return t.v[0];
}

Vec3 need_vec3(Parser *p, Place where, Term t)
{
    if (t.n == 1) return vec(t.v[0], t.v[0], t.v[0]);
    if (t.n == 0 || t.is_color) parse_fail(p, where, "expected a vector, found %s", term_name(&t));
    if (t.n > 3) parse_fail(p, where, "expected a vector of 3 components, found one of %d", t.n);
    return vec(t.v[0], t.v[1], t.v[2]);
}

static Term term_of(Parser *p, const Value *v)
{
    Term t = { .n = 0 };
    switch (v->kind) {
    case VALUE_FLOAT: return term_float(v->number);
    case VALUE_STRING: return term_string(v->string);
    case VALUE_VECTOR:
        t.n = v->n;
        memcpy(t.v, v->v, sizeof t.v);
        return t;
    case VALUE_COLOR:
        return (Term){ .n = 5, .is_color = true, .v = { (double)v->color.r, (double)v->color.g, (double)v->color.b,
                                                        (double)v->color.filter, (double)v->color.transmit } };
    default: parse_fail_expected(p, "a number, a vector, a colour or a string");
    }
}

static Color color_of(const Term *t)
{
    return (Color){ (float)t->v[0], (float)t->v[1], (float)t->v[2], (float)t->v[3], (float)t->v[4] };
}

static Value value_of(const Term *t)
{
    Value v = { .kind = VALUE_VECTOR, .n = t->n };
    if (t->n == 0) return (Value){ .kind = VALUE_STRING, .string = t->string };
    if (t->n == 1) return (Value){ .kind = VALUE_FLOAT, .number = t->v[0] };
    if (t->is_color) return (Value){ .kind = VALUE_COLOR, .color = color_of(t) };
    memcpy(v.v, t->v, sizeof v.v);
    return v;
}

/* ---- primaries ---- */

/* < a, b, c >: the commas may be left out. */
static Term parse_vector_literal(Parser *p)
{
    Term t = { .n = 0 };
    Place opened = expect_punct(p, '<');
    while (t.n < 5 && !at_punct(p, '>')) {
        Place where = here(p);
        t.v[t.n++] = need_float(p, where, parse_sum(p));
        accept_comma(p);
    }
    expect_close(p, '>', "the vector", opened);
    if (t.n < 2) parse_fail(p, opened, "a vector has 2 to 5 components");
    return t;
}

static Term parse_parentheses(Parser *p)
{
    Place opened = expect_punct(p, '(');
    Term t = parse_logic(p);
    expect_close(p, ')', "'('", opened);
    return t;
}

static _Noreturn void fail_no_value(Parser *p, const Token *name)
{
    parse_fail(p, name->place, "this element of '%s' has been given no value", name->text);
}

static Term parse_word(Parser *p)
{
    const Builtin *b = word_of(look(p)->text)->builtin;
    const Value *v = b ? NULL : look_slot(p);
    if (v && v->kind == VALUE_NONE) fail_no_value(p, look(p));
    if (v) {
        Term t = term_of(p, v);
        input_take(p);
        return t;
    }
    if (!b || !b->call) parse_fail_expected(p, "an expression");
    Place where = here(p);
    input_take(p);
    return b->call(p, b, where);
}

/* The component that a word behind '.' means; -1: gray; -2: none. */
static int component_of(const Token *t)
{
    static const struct { const char *word; int i; } components[] = {
        { "x", 0 }, { "y", 1 }, { "z", 2 }, { "t", 3 }, { "u", 0 }, { "v", 1 }, { "red", 0 }, { "green", 1 }, { "blue", 2 },
        { "filter", 3 }, { "transmit", 4 }, { "gray", -1 }, { "grey", -1 },
    };
    for (size_t i = 0; t->kind == TOKEN_WORD && i < sizeof components / sizeof *components; i++) {
        if (strcmp(t->text, components[i].word) == 0) return components[i].i;
    }
    return -2;
}

static Term parse_component(Parser *p, Term t)
{
    Token name = *look(p);
    int i = component_of(&name);
    if (i == -2) parse_fail_expected(p, "the name of a component after '.'");
    int needed = i == -1 ? 3 : i + 1;
    if (t.n < needed) parse_fail(p, name.place, "there is no component '%s' in %s", name.text, term_size(p, &t));
    input_take(p);
    if (i >= 0) return term_float(t.v[i]);
    return term_float(rgb_grey(rgb(t.v[0], t.v[1], t.v[2])));
}

static Term parse_primary(Parser *p)
{
    const Token *t = look(p);
    double number = t->number;
    Term term;
    if (t->kind == TOKEN_NUMBER) return input_take(p), term_float(number);
    if (t->kind == TOKEN_STRING) return term = term_string(t->text), input_take(p), term;
    if (t->kind == TOKEN_WORD) term = parse_word(p);
    else if (at_punct(p, '<')) term = parse_vector_literal(p);
    else if (at_punct(p, '(')) term = parse_parentheses(p);
    else parse_fail_expected(p, "an expression");
    while (term.n != 0 && accept_punct(p, '.')) term = parse_component(p, term);
    return term;
}

/* ---- operators ---- */

/* Equality and truth are absolute in POV-Ray (measured with POV-Ray 3.7). */
static const double EQUAL_WITHIN = 1e-10;
static double truth(double x) { return fabs(x) > EQUAL_WITHIN; }

static double op_add(double a, double b) { return a + b; }
static double op_sub(double a, double b) { return a - b; }
static double op_mul(double a, double b) { return a * b; }
static double op_div(double a, double b) { return b == 0 ? HUGE_VAL : a / b; }
static double op_less(double a, double b) { return a < b; }
static double op_greater(double a, double b) { return a > b; }
static double op_less_equal(double a, double b) { return a <= b + EQUAL_WITHIN; }
static double op_greater_equal(double a, double b) { return a >= b - EQUAL_WITHIN; }
static double op_equal(double a, double b) { return !truth(a - b); }
static double op_not_equal(double a, double b) { return truth(a - b); }
static double op_and(double a, double b) { return truth(a) && truth(b); }
static double op_or(double a, double b) { return truth(a) || truth(b); }

enum { RANK_LOGIC = 1, RANK_RELATION, RANK_SUM, RANK_PRODUCT };

typedef struct { int rank; double (*apply)(double a, double b); } Operator;

static const Operator operators[128] = {   /* by Token.punct; rank 0: none */
    ['*'] = { RANK_PRODUCT, op_mul }, ['/'] = { RANK_PRODUCT, op_div },
    ['+'] = { RANK_SUM, op_add }, ['-'] = { RANK_SUM, op_sub },
    ['<'] = { RANK_RELATION, op_less }, ['>'] = { RANK_RELATION, op_greater },
    ['L'] = { RANK_RELATION, op_less_equal }, ['G'] = { RANK_RELATION, op_greater_equal },
    ['='] = { RANK_RELATION, op_equal }, ['N'] = { RANK_RELATION, op_not_equal },
    ['&'] = { RANK_LOGIC, op_and }, ['|'] = { RANK_LOGIC, op_or },
};

static const Operator *find_operator(const Token *t, int min_rank)
{
    if (t->kind != TOKEN_PUNCT) return NULL;
    const Operator *op = &operators[t->punct & 127];
    return op->rank >= min_rank ? op : NULL;
}

/* A float becomes as long as its partner, a shorter vector is filled with 0. */
static Term widened(Term t, int n)
{
    for (int i = t.n; i < n; i++) t.v[i] = t.n == 1 ? t.v[0] : 0;
    t.n = n;
    return t;
}

static Term apply_to_strings(Parser *p, Place where, const Operator *op, const Term *a, const Term *b)
{
    if (a->n != 0 || b->n != 0 || op->rank != RANK_RELATION)
        parse_fail(p, where, "%s and %s cannot be operands here", term_name(a), term_name(b));
    return term_float(op->apply(strcmp(a->string, b->string), 0));
}

static Term apply(Parser *p, Place where, const Operator *op, Term a, Term b)
{
    if (a.n == 0 || b.n == 0) return apply_to_strings(p, where, op, &a, &b);
    int n = a.n > b.n ? a.n : b.n;
    if (a.n != b.n) a = widened(a, n), b = widened(b, n);
    a.is_color = a.is_color || b.is_color;
    bool divides_by_zero = false;
    for (int i = 0; i < n; i++) {
        if (op->apply == op_div && b.v[i] == 0) divides_by_zero = true;
        a.v[i] = op->apply(a.v[i], b.v[i]);
    }
    if (divides_by_zero) parse_warn_once(p, where, "/0", "division by zero");
    return a;
}

static Term parse_operand(Parser *p)
{
    const Token *t = look(p);
    char sign = t->kind == TOKEN_PUNCT ? t->punct : '\0';
    Place where = t->place;
    if (sign != '-' && sign != '+' && sign != '!') return parse_primary(p);
    input_take(p);
    input_deeper(p, where);
    Term term = need_numbers(p, where, parse_operand(p));
    input_shallower(p);
    for (int i = 0; i < term.n && sign == '-'; i++) term.v[i] = -term.v[i];
    for (int i = 0; i < term.n && sign == '!'; i++) term.v[i] = !truth(term.v[i]);
    return term;
}

/* A string wants no ';' behind it: what follows must not be carried out before it has been assigned. */
static bool ends_with_string(Parser *p, const Term *t, int min_rank)
{
    char c;
    return t->n == 0 && min_rank >= RANK_SUM && (c = input_next_char(p), !c || !strchr("+-*/", c));
}

static Term parse_binary(Parser *p, int min_rank)
{
    Term left = parse_operand(p);
    const Operator *op;
    if (ends_with_string(p, &left, min_rank)) return left;
    while ((op = find_operator(look(p), min_rank))) {
        Place where = here(p);
        input_take(p);
        left = apply(p, where, op, left, parse_binary(p, op->rank + 1));
    }
    return left;
}

Term parse_sum(Parser *p)
{
    input_deeper(p, look(p)->place);
    Term t = parse_binary(p, RANK_SUM);
    input_shallower(p);
    return t;
}

static Term parse_choice(Parser *p)
{
    Place where = here(p);
    Term t = parse_binary(p, RANK_LOGIC);
    if (!accept_punct(p, '?')) return t;
    bool choice = truth(need_float(p, where, t)) != 0;
    Term yes = parse_logic(p);
    expect_punct(p, ':');
    Term no = parse_logic(p);
    return choice ? yes : no;
}

Term parse_logic(Parser *p)
{
    input_deeper(p, look(p)->place);
    Term t = parse_choice(p);
    input_shallower(p);
    return t;
}

/* ---- state.h ---- */

Value parse_expression(Parser *p)
{
    Term t = starts_color(p) ? parse_color_words(p) : parse_sum(p);
    return value_of(&t);
}

static bool is_expression_kind(ValueKind kind)
{
    return kind == VALUE_FLOAT || kind == VALUE_VECTOR || kind == VALUE_COLOR || kind == VALUE_STRING;
}

bool starts_expression(Parser *p)
{
    const Token *t = look(p);
    if (t->kind == TOKEN_NUMBER || t->kind == TOKEN_STRING) return true;
    if (t->kind == TOKEN_PUNCT) return strchr("<(-+!", t->punct) != NULL;
    if (t->kind != TOKEN_WORD) return false;
    if (word_of(t->text)->builtin) return true;
    const Value *v = look_slot(p);
    return v && is_expression_kind(v->kind);
}

double parse_float(Parser *p)
{
    Place where = here(p);
    return need_float(p, where, parse_sum(p));
}

double parse_condition(Parser *p)
{
    Place where = here(p);
    return need_float(p, where, parse_logic(p));
}

int parse_int(Parser *p)
{
    Place where = here(p);
    double value = trunc(need_float(p, where, parse_sum(p)));
    if (!(value >= INT_MIN && value <= INT_MAX)) parse_fail(p, where, "expected an integer, found %g", value);
    return (int)value;
}

bool parse_optional_bool(Parser *p, bool when_absent)
{
    return starts_expression(p) && !at_punct(p, '<') ? truth(parse_float(p)) != 0 : when_absent;
}

Vec3 parse_vec3(Parser *p)
{
    Place where = here(p);
    return need_vec3(p, where, parse_sum(p));
}

Vec2 parse_vec2(Parser *p)
{
    Place where = here(p);
    Term t = need_numbers(p, where, parse_sum(p));
    if (t.n > 2) parse_fail(p, where, "expected a vector of 2 components, found %s of %d", term_name(&t), t.n);
    return vec2(t.v[0], t.n == 1 ? t.v[0] : t.v[1]);
}

int parse_vector(Parser *p, double out[5])
{
    Place where = here(p);
    Term t = parse_sum(p);
    if (t.n == 0 || t.is_color) parse_fail(p, where, "expected a vector, found %s", term_name(&t));
    memcpy(out, t.v, sizeof t.v);
    return t.n;
}

Color parse_color(Parser *p)
{
    Place where = here(p);
    Term t = starts_color(p) ? parse_color_words(p) : parse_sum(p);
    if (!t.is_color) parse_fail(p, where, "expected a colour, found %s", term_name(&t));
    if (starts_color(p)) t = parse_color_parts(p, t);
    return color_of(&t);
}

Rgb parse_rgb(Parser *p)
{
    Place where = here(p);
    Term t = starts_color(p) ? parse_color_words(p) : parse_sum(p);
    if (t.n == 1) return rgb(t.v[0], t.v[0], t.v[0]);
    if (t.n == 0) parse_fail(p, where, "expected a colour, found %s", term_name(&t));
    return rgb(t.v[0], t.v[1], t.v[2]);
}

const char *parse_string(Parser *p)
{
    Place where = here(p);
    Term t = parse_primary(p);
    if (t.n != 0) parse_fail(p, where, "expected a string, found %s", term_name(&t));
    return t.string;
}
