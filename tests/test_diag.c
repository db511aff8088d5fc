#include "tests/test.h"

#include "render/diag.h"

#include <string.h>

static Arena *arena;

static int make_arena(void **state)
{
    (void)state;
    arena = arena_new();
    return 0;
}

static int free_arena(void **state)
{
    (void)state;
    arena_free(arena);
    return 0;
}

static const SourceText *source(const char *text)
{
    SourceText *s = ARENA_NEW(arena, SourceText);
    *s = (SourceText){ "part.pov", text, strlen(text) };
    return s;
}

static const char *printed(const Diag *d)
{
    char *text = NULL;
    size_t n = 0;
    FILE *f = open_memstream(&text, &n);
    diag_print(d, f);
    fclose(f);
    char *copy = arena_strdup(arena, text);
    free(text);
    return copy;
}

static const char *one_error(const char *text, uint32_t line, uint32_t column, uint32_t length)
{
    Diag *d = diag_new(arena);
    diag_error(d, (Place){ source(text), line, column, length }, "wrong %s", "here");
    return printed(d);
}

static void a_message_shows_its_line_and_a_caret(void **state)
{
    (void)state;
    Diag *d = diag_new(arena);
    const SourceText *s = source("sphere {\n  0, 1\n  camera { location 0 }\n");
    diag_error(d, (Place){ s, 3, 3, 6 }, "expected '}' to close %s (line %d), found 'camera'", "sphere", 1);
    assert_string_equal(printed(d),
                        "part.pov:3:3: error: expected '}' to close sphere (line 1), found 'camera'\n"
                        "      camera { location 0 }\n"
                        "      ^~~~~~\n");
}

static void a_message_without_a_place_is_a_line(void **state)
{
    (void)state;
    Diag *d = diag_new(arena);
    diag_warning(d, (Place){ 0 }, "no file");
    assert_string_equal(printed(d), "warning: no file\n");
}

static void the_caret_stands_at_every_place_of_a_file(void **state)
{
    (void)state;
    assert_string_equal(one_error("abc", 1, 1, 0), "part.pov:1:1: error: wrong here\n    abc\n    ^\n");
    assert_string_equal(one_error("abc", 1, 4, 1), "part.pov:1:4: error: wrong here\n    abc\n       ^\n");   /* its end */
    assert_string_equal(one_error("abc\n", 2, 1, 1), "part.pov:2:1: error: wrong here\n    \n    ^\n");
    assert_string_equal(one_error("", 1, 1, 1), "part.pov:1:1: error: wrong here\n    \n    ^\n");
    assert_string_equal(one_error("ab\r\ncd", 1, 2, 9), "part.pov:1:2: error: wrong here\n    ab\n     ^\n");
    assert_string_equal(one_error("abc", 7, 5, 1), "part.pov:7:5: error: wrong here\n    \n    ^\n");   /* beyond */
}

static void tabs_and_letters_of_several_bytes_keep_the_caret_in_place(void **state)
{
    (void)state;
    assert_string_equal(one_error("\tx y", 1, 4, 1), "part.pov:1:4: error: wrong here\n    \tx y\n    \t  ^\n");
    assert_string_equal(one_error("\"\xC3\xA4\xE2\x82\xAC\" y", 1, 9, 1),
                        "part.pov:1:9: error: wrong here\n    \"\xC3\xA4\xE2\x82\xAC\" y\n         ^\n");
}

static void nothing_in_a_source_line_commands_the_terminal(void **state)
{
    (void)state;
    assert_string_equal(one_error("a\033[2Jb", 1, 6, 1), "part.pov:1:6: error: wrong here\n    a [2Jb\n         ^\n");
}

static void a_long_line_is_cut_round_the_caret(void **state)
{
    (void)state;
    char text[2001];
    memset(text, 'x', 2000);
    text[999] = '!';
    text[2000] = '\0';
    const char *message = one_error(text, 1, 1000, 3);
    const char *line = strchr(message, '\n') + 1, *caret = strchr(line, '\n') + 1;
    CHECK(strncmp(line, "    ...xxx", 10) == 0 && strstr(line, "xxx...\n"), "%s", message);
    CHECK(strchr(line, '!') - line == strchr(caret, '^') - caret, "%s", message);
    CHECK(strlen(caret) < 125 && strstr(caret, "^~~\n"), "%s", message);
}

static void messages_keep_their_order_and_are_counted_apart(void **state)
{
    (void)state;
    Diag *d = diag_new(arena);
    diag_warning(d, (Place){ 0 }, "one");
    diag_error(d, (Place){ 0 }, "two");
    diag_warning(d, (Place){ 0 }, "three");
    assert_string_equal(printed(d), "warning: one\nerror: two\nwarning: three\n");
    assert_int_equal(diag_error_count(d), 1);
    assert_int_equal(diag_warning_count(d), 2);
}

static void a_warning_is_given_once_for_each_key(void **state)
{
    (void)state;
    Diag *d = diag_new(arena);
    for (int i = 0; i < 3; i++) {
        diag_warning_once(d, (Place){ 0 }, "media", "'media' is left out");
        diag_warning_once(d, (Place){ 0 }, "photons", "'photons' is left out");
    }
    assert_string_equal(printed(d), "warning: 'media' is left out\nwarning: 'photons' is left out\n");
}

static void twenty_errors_are_enough(void **state)
{
    (void)state;
    Diag *d = diag_new(arena);
    for (int i = 1; i <= 20; i++) {
        CHECK(!diag_is_full(d), "before error %d", i);
        diag_error(d, (Place){ 0 }, "%d", i);
    }
    assert_true(diag_is_full(d));
    assert_null(strstr(printed(d), "shown"));
    diag_error(d, (Place){ 0 }, "21");
    assert_int_equal(diag_error_count(d), 21);
    const char *text = printed(d);
    assert_null(strstr(text, "21"));
    assert_string_equal(strstr(text, "error: 20\n"), "error: 20\n20 errors shown, more not\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_message_shows_its_line_and_a_caret),
        cmocka_unit_test(a_message_without_a_place_is_a_line),
        cmocka_unit_test(the_caret_stands_at_every_place_of_a_file),
        cmocka_unit_test(tabs_and_letters_of_several_bytes_keep_the_caret_in_place),
        cmocka_unit_test(nothing_in_a_source_line_commands_the_terminal),
        cmocka_unit_test(a_long_line_is_cut_round_the_caret),
        cmocka_unit_test(messages_keep_their_order_and_are_counted_apart),
        cmocka_unit_test(a_warning_is_given_once_for_each_key),
        cmocka_unit_test(twenty_errors_are_enough),
    };
    return cmocka_run_group_tests(tests, make_arena, free_arena);
}
