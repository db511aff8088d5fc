/* Directives that wait for an #end: conditions, #switch, loops. What is not taken is passed over as text, without making
 * tokens; a loop comes back to its head by the cursor that it remembers. Blocks belong to the frame they began in. */
#include "parser/core.h"

#include <math.h>
#include <string.h>

static const double EQUAL_WITHIN = 1e-10;   /* POV-Ray's equality and its zero, absolute (measured with POV-Ray 3.7) */

static bool is_true(double value) { return fabs(value) > EQUAL_WITHIN; }
static bool is_word(const Token *t, const char *word) { return strcmp(t->text, word) == 0; }

/* ---- the stack of blocks ---- */

static const char *block_name(BlockKind kind)
{
    static const char *const names[] = { [BLOCK_IF] = "#if", [BLOCK_WHILE] = "#while", [BLOCK_FOR] = "#for",
                                         [BLOCK_SWITCH] = "#switch" };
    return names[kind];
}

static Block *push_block(Parser *p, BlockKind kind, Place where)
{
    ARENA_PUSH(p->arena, p->blocks, p->n_blocks, p->blocks_capacity) = (Block){ .kind = kind, .place = where };
    return &p->blocks[p->n_blocks - 1];
}

/* The innermost block of this frame, or NULL. */
static Block *top_block(Parser *p)
{
    return p->n_blocks > top_frame(p)->first_block ? &p->blocks[p->n_blocks - 1] : NULL;
}

static const char *missing_end(Parser *p, const Block *b)
{
    Token end = { .kind = TOKEN_END };
    return arena_printf(p->arena, "expected #end to close %s (line %u), found %s", block_name(b->kind), b->place.line,
                        token_name(p, &end));
}

static Place frame_end(Parser *p)
{
    const Cursor *c = &top_frame(p)->cursor;
    return cursor_place(c, c->at, 0);
}

void block_check_frame_end(Parser *p)
{
    const Block *b = top_block(p);
    if (b) parse_error(p, frame_end(p), "%s", missing_end(p, b));
    p->n_blocks = top_frame(p)->first_block;
}

/* ---- passing over ---- */

static bool opens_block(const Token *t)
{
    static const char *const words[] = { "if", "ifdef", "ifndef", "while", "for", "switch", "macro" };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (is_word(t, words[i])) return true;
    }
    return false;
}

/* To behind the word of the next directive that is wanted, at `depth` blocks within the one to be closed; *hash is where it
 * began. False: the text ends. */
static bool skip_to(Parser *p, int depth, bool (*wanted)(const Token *word, int depth), Token *found, const char **hash)
{
    Cursor *c = &top_frame(p)->cursor;
    while (cursor_find_directive(c)) {
        *hash = c->at - 1;
        if (lexer_read(c, &p->symbols, found) || found->kind != TOKEN_WORD) continue;
        if (opens_block(found)) depth++;
        else if (wanted(found, depth)) return true;
        if (is_word(found, "end")) depth--;
    }
    return false;
}

static bool is_last_end(const Token *t, int depth) { return depth == 0 && is_word(t, "end"); }

bool block_skip(Parser *p, int depth, const char **end)
{
    Token t;
    return skip_to(p, depth, is_last_end, &t, end);
}

/* Takes block i and those within it off the stack and passes over the rest of them. */
static void leave_blocks(Parser *p, size_t i)
{
    Block outermost = p->blocks[i];
    int depth = (int)(p->n_blocks - i) - 1;
    const char *end;
    p->n_blocks = i;
    if (!block_skip(p, depth, &end)) parse_fail(p, frame_end(p), "%s", missing_end(p, &outermost));
}

/* To the next branch of the innermost block. */
static Token next_branch(Parser *p, bool (*wanted)(const Token *word, int depth))
{
    Token t;
    const char *hash;
    if (skip_to(p, 0, wanted, &t, &hash)) return t;
    Block b = p->blocks[--p->n_blocks];
    parse_fail(p, frame_end(p), "%s", missing_end(p, &b));
}

/* ---- #if ---- */

static double read_condition(Parser *p)
{
    Guard before = input_guard(p);
    Place opened = expect_punct(p, '(');
    double value = parse_condition(p);
    expect_close(p, ')', "the condition", opened);
    input_unguard(p, before);
    return value;
}

static bool is_branch(const Token *t, int depth)
{
    return depth == 0 && (is_word(t, "else") || is_word(t, "elseif") || is_word(t, "end"));
}

static void begin_if(Parser *p, Place where, bool is_taken)
{
    push_block(p, BLOCK_IF, where);
    while (!is_taken) {
        Token t = next_branch(p, is_branch);
        if (is_word(&t, "end")) {
            p->n_blocks--;
            return;
        }
        is_taken = is_word(&t, "else") || is_true(read_condition(p));
    }
}

void block_if(Parser *p, Place where)
{
    begin_if(p, where, is_true(read_condition(p)));
}

/* (NAME) or (NAME[i]): has it a value? */
static bool read_is_defined(Parser *p)
{
    Guard before = input_guard(p);
    Place opened = expect_punct(p, '(');
    bool is_defined = parse_is_defined(p);
    expect_close(p, ')', "the name", opened);
    input_unguard(p, before);
    return is_defined;
}

void block_ifdef(Parser *p, Place where) { begin_if(p, where, read_is_defined(p)); }
void block_ifndef(Parser *p, Place where) { begin_if(p, where, !read_is_defined(p)); }

/* Met from above: the branch before it was taken. In a #switch the case before it falls through. */
void block_else(Parser *p, Place where)
{
    const Block *b = top_block(p);
    if (!b || b->kind == BLOCK_WHILE || b->kind == BLOCK_FOR) parse_fail(p, where, "#else without #if or #switch");
    if (b->kind == BLOCK_IF) leave_blocks(p, p->n_blocks - 1);
}

void block_elseif(Parser *p, Place where)
{
    const Block *b = top_block(p);
    if (!b || b->kind != BLOCK_IF) parse_fail(p, where, "#elseif without #if");
    leave_blocks(p, p->n_blocks - 1);
}

/* ---- #switch ---- */

static bool is_case(const Token *t, int depth)
{
    return depth == 0 && (is_word(t, "case") || is_word(t, "range") || is_word(t, "else") || is_word(t, "end"));
}

static bool read_case(Parser *p, bool is_range, double value)
{
    Guard before = input_guard(p);
    Place opened = expect_punct(p, '(');
    double low = parse_condition(p), high = low;
    if (is_range) {
        accept_comma(p);
        high = parse_condition(p);
    }
    expect_close(p, ')', "the case", opened);
    input_unguard(p, before);
    return value >= low - EQUAL_WITHIN && value <= high + EQUAL_WITHIN;
}

void block_switch(Parser *p, Place where)
{
    double value = read_condition(p);
    push_block(p, BLOCK_SWITCH, where);
    for (;;) {
        Token t = next_branch(p, is_case);
        if (is_word(&t, "else")) return;
        if (is_word(&t, "end")) {
            p->n_blocks--;
            return;
        }
        if (read_case(p, is_word(&t, "range"), value)) return;
    }
}

/* #case or #range met from above: the case before it falls through. */
static void fall_through(Parser *p, Place where, bool is_range)
{
    const Block *b = top_block(p);
    if (!b || b->kind != BLOCK_SWITCH) parse_fail(p, where, "#%s without #switch", is_range ? "range" : "case");
    (void)read_case(p, is_range, 0);
}

void block_case(Parser *p, Place where) { fall_through(p, where, false); }
void block_range(Parser *p, Place where) { fall_through(p, where, true); }

/* ---- loops ---- */

void block_while(Parser *p, Place where)
{
    Cursor again = top_frame(p)->cursor;
    push_block(p, BLOCK_WHILE, where)->again = again;
    if (!is_true(read_condition(p))) leave_blocks(p, p->n_blocks - 1);
}

static bool for_goes_on(double value, double end, double step)
{
    return step > 0 ? value <= end + EQUAL_WITHIN : value >= end - EQUAL_WITHIN;
}

/* #for (I, first, last) or #for (I, first, last, step) */
void block_for(Parser *p, Place where)
{
    Block b = { .kind = BLOCK_FOR, .place = where, .step = 1 };
    Guard before = input_guard(p);
    Place opened = expect_punct(p, '(');
    b.variable = declarable_name(p, "of the loop's variable");
    expect_punct(p, ',');
    double first = parse_float(p);
    expect_punct(p, ',');
    b.end = parse_float(p);
    Place step = here(p);
    if (accept_punct(p, ',')) b.step = parse_float(p);
    if (b.step == 0) parse_fail(p, step, "the step of #for is 0");
    expect_close(p, ')', "#for", opened);
    input_unguard(p, before);
    symbols_local(&p->symbols, b.variable, (Value){ .kind = VALUE_FLOAT, .number = first });
    b.again = top_frame(p)->cursor;
    *push_block(p, BLOCK_FOR, where) = b;
    if (!for_goes_on(first, b.end, b.step)) leave_blocks(p, p->n_blocks - 1);
}

static void next_round(Parser *p, Place where)
{
    Block b = *top_block(p);
    Value *variable = word_value(b.variable);
    if (!variable || variable->kind != VALUE_FLOAT)
        parse_fail(p, where, "'%s', the variable of #for, is no longer a float", b.variable->text);
    variable->number += b.step;
    if (for_goes_on(variable->number, b.end, b.step)) top_frame(p)->cursor = b.again;
    else p->n_blocks--;
}

void block_end(Parser *p, Place where)
{
    const Block *b = top_block(p);
    if (!b) parse_fail(p, where, "#end without a block to close");
    if (b->kind == BLOCK_IF || b->kind == BLOCK_SWITCH) {
        p->n_blocks--;
        return;
    }
    input_step(p, where);
    if (b->kind == BLOCK_FOR) {
        next_round(p, where);
        return;
    }
    top_frame(p)->cursor = b->again;
    if (!is_true(read_condition(p))) leave_blocks(p, p->n_blocks - 1);
}

/* Leaves the innermost loop or #switch, or else the macro. */
void block_break(Parser *p, Place where)
{
    Frame *f = top_frame(p);
    for (size_t i = p->n_blocks; i > f->first_block; i--) {
        if (p->blocks[i - 1].kind == BLOCK_IF) continue;
        leave_blocks(p, i - 1);
        return;
    }
    if (!f->macro) parse_fail(p, where, "#break outside of a loop, a #switch and a macro");
    p->n_blocks = f->first_block;
    f->cursor.at = f->cursor.end;
}
