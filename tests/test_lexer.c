/* The lexer: tokens and their places, numbers to the last bit, and texts that are not scenes at all. */
#include "parser/lexer.h"
#include "tests/test.h"

#include <math.h>
#include <string.h>

typedef struct { Arena *arena; Symbols symbols; SourceText source; Cursor cursor; } Lexing;

static Lexing lexing(const char *text, size_t n)
{
    Lexing l = { .arena = arena_new() };
    symbols_init(&l.symbols, l.arena);
    l.source = (SourceText){ "test.pov", text, n };
    return l;
}

static void start(Lexing *l) { l->cursor = cursor_make(&l->source); }

static Token read(Lexing *l)
{
    Token t;
    const char *error = lexer_read(&l->cursor, &l->symbols, &t);
    CHECK(!error, "%s at %u:%u", error, t.place.line, t.place.column);
    return t;
}

static void check_error(const char *text, size_t n, const char *expected, unsigned line, unsigned column)
{
    Lexing l = lexing(text, n);
    Token t;
    const char *error;
    start(&l);
    while (!(error = lexer_read(&l.cursor, &l.symbols, &t))) CHECK(t.kind != TOKEN_END, "%s: no error", text);
    CHECK(strcmp(error, expected) == 0, "'%s' instead of '%s'", error, expected);
    CHECK(t.place.line == line && t.place.column == column, "%s: at %u:%u", text, t.place.line, t.place.column);
    arena_free(l.arena);
}

static void places_are_lines_and_columns(void **state)
{
    (void)state;
    static const char text[] = "\xEF\xBB\xBF" "a /* one\n /* two */ */ <=\r\n\t\"s\" // end\n.5x";
    static const struct { TokenKind kind; unsigned line, column, length; } expected[] = {
        { TOKEN_WORD, 1, 4, 1 }, { TOKEN_PUNCT, 2, 15, 2 }, { TOKEN_STRING, 3, 2, 3 }, { TOKEN_NUMBER, 4, 1, 2 },
        { TOKEN_WORD, 4, 3, 1 }, { TOKEN_END, 4, 4, 0 },
    };
    Lexing l = lexing(text, strlen(text));
    start(&l);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        Token t = read(&l);
        CHECK(t.kind == expected[i].kind, "token %zu", i);
        CHECK(t.place.line == expected[i].line && t.place.column == expected[i].column
              && t.place.length == expected[i].length, "token %zu: %u:%u", i, t.place.line, t.place.column);
    }
    arena_free(l.arena);
}

static void the_text_of_a_place_is_found_again(void **state)
{
    (void)state;
    static const char text[] = "one\n  two three\n\nfour";
    Lexing l = lexing(text, strlen(text));
    start(&l);
    for (Token t = read(&l); t.kind != TOKEN_END; t = read(&l)) {
        size_t length;
        const char *found = place_text(t.place, &length);
        CHECK(strncmp(found, t.text, length) == 0 && length == strlen(t.text), "%s", t.text);
    }
    arena_free(l.arena);
}

static void a_word_is_stored_once(void **state)
{
    (void)state;
    Lexing l = lexing("alpha beta alpha", 16);
    start(&l);
    const char *first = read(&l).text, *second = read(&l).text, *third = read(&l).text;
    CHECK(first == third && first != second, "%s %s", first, second);
    arena_free(l.arena);
}

/* The truth is the C library's strtod. */
static void numbers_are_correctly_rounded(void **state)
{
    (void)state;
    static const char *const special[] = {
        "0", "1", "1.", ".5", "1e3", "1E-2", "9007199254740993", "0.1", "123456789012345678901234567890", "1e22", "1e23",
        "1e-22", "1e-23", "179769313486231570000e288", "4.9406564584124654e-324", "2.2250738585072011e-308", "1e-400",
        "0.0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000001",
        "8.5e-3", "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482",
        "0000000000000000000000000000000000000000000000000000000000000000000000000000000000001.5e0000000001",
    };
    for (size_t i = 0; i < sizeof special / sizeof *special; i++) {
        Lexing l = lexing(special[i], strlen(special[i]));
        start(&l);
        CHECK(read(&l).number == strtod(special[i], NULL), "%s", special[i]);
        arena_free(l.arena);
    }
    for (unsigned seed = 0; seed < 20000; seed++) {
        char text[64];
        TestRandom r = test_random(seed);
        double value = ldexp(test_range(&r, 1, 2), test_int(&r, -200, 200));
        snprintf(text, sizeof text, seed % 2 ? "%.*e" : "%.*g", test_int(&r, 0, 20), value);
        Lexing l = lexing(text, strlen(text));
        start(&l);
        double number = read(&l).number;
        CHECK(number == strtod(text, NULL), "seed %u: %s", seed, text);
        arena_free(l.arena);
    }
}

static void a_number_ends_where_it_must(void **state)
{
    (void)state;
    Lexing l = lexing("1e 0x10 2.5.5 3e+4", 18);
    start(&l);
    assert_true(read(&l).number == 1);
    assert_string_equal(read(&l).text, "e");
    assert_true(read(&l).number == 0);
    assert_string_equal(read(&l).text, "x10");
    assert_true(read(&l).number == 2.5);
    assert_true(read(&l).number == .5);
    assert_true(read(&l).number == 3e4);
    arena_free(l.arena);
}

static void escapes_are_single_characters(void **state)
{
    (void)state;
    static const char text[] = "\"a\\n\\\"\\\\b\" \"\"";
    Lexing l = lexing(text, strlen(text));
    start(&l);
    assert_string_equal(read(&l).text, "a\n\"\\b");
    assert_string_equal(read(&l).text, "");
    arena_free(l.arena);
}

static void what_is_no_token_has_a_message_and_a_place(void **state)
{
    (void)state;
    check_error("a\n  \"abc\nd", 10, "this string has no closing '\"'", 2, 3);
    check_error("a /* b /* c */", 14, "this comment has no closing '*/'", 1, 3);
    check_error("a @", 3, "unexpected character '@'", 1, 3);
    check_error("a \xC3\xA9 b", 6, "unexpected character (byte 0xC3)", 1, 3);
    check_error("a\0b", 3, "unexpected character (byte 0x00)", 1, 2);
    check_error("\"a\0b\"", 5, "a string cannot contain a NUL character", 1, 1);
    check_error("1e999", 5, "this number is too large", 1, 1);
}

static void directives_are_found_outside_of_comments_and_strings(void **state)
{
    (void)state;
    static const char text[] = "a // #no\n\"#no\" /* #no */ b #yes";
    Lexing l = lexing(text, strlen(text));
    start(&l);
    assert_true(cursor_find_directive(&l.cursor));
    assert_string_equal(read(&l).text, "yes");
    assert_false(cursor_find_directive(&l.cursor));
    arena_free(l.arena);
}

/* Any bytes: every read makes progress, and tokens stay within the text. */
static void any_bytes_are_read_to_their_end(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < 3000; seed++) {
        static const char often[] = "\"/*\\#.eE01-+{}<>_a \n";
        char text[128];
        TestRandom r = test_random(seed);
        size_t n = (size_t)test_int(&r, 0, 127);
        for (size_t i = 0; i < n; i++)
            text[i] = test_int(&r, 0, 3) ? often[test_int(&r, 0, (int)sizeof often - 2)] : (char)test_int(&r, 0, 255);
        text[n] = '\0';
        Lexing l = lexing(text, n);
        start(&l);
        for (;;) {
            const char *before = l.cursor.at;
            Token t;
            const char *error = lexer_read(&l.cursor, &l.symbols, &t);
            if (!error && t.kind == TOKEN_END) break;
            CHECK(l.cursor.at > before && l.cursor.at <= text + n, "seed %u", seed);
        }
        arena_free(l.arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_are_lines_and_columns),
        cmocka_unit_test(the_text_of_a_place_is_found_again),
        cmocka_unit_test(a_word_is_stored_once),
        cmocka_unit_test(numbers_are_correctly_rounded),
        cmocka_unit_test(a_number_ends_where_it_must),
        cmocka_unit_test(escapes_are_single_characters),
        cmocka_unit_test(what_is_no_token_has_a_message_and_a_place),
        cmocka_unit_test(directives_are_found_outside_of_comments_and_strings),
        cmocka_unit_test(any_bytes_are_read_to_their_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
