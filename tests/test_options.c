#include "tests/test.h"

#include "render/options.h"

#include <string.h>

static Arena *arena;

/* Reads the arguments, up to the NULL, and a scene. */
static bool read(Options *o, ...)
{
    char *argv[16];
    int argc = 0;
    va_list arguments;
    va_start(arguments, o);
    for (const char *s; (s = va_arg(arguments, const char *)) != NULL;) argv[argc++] = (char *)s;
    va_end(arguments);
    argv[argc++] = (char *)"scene.pov";
    return options_read(argc, argv, arena, o);
}

static void check_refused(const char *argument, const char *message)
{
    Options o;
    bool is_read = read(&o, argument, NULL);
    CHECK(!is_read, "'%s' was accepted", argument);
    CHECK(strcmp(o.error, message) == 0, "%s: '%s'", argument, o.error);
}

static void the_spellings_of_an_option_mean_the_same(void **state)
{
    (void)state;
    static const char *const spellings[][4] = {
        { "+W641", "-w641", "Width=641", "--width=641" },
        { "+WT3", "+wt3", "Work_Threads=3", "--threads=3" },
        { "+K.25", "-K0.25", "clock=.25", "--clock=0.25" },
        { "+UA", "+ua", "OUTPUT_ALPHA=on", "--alpha" },
        { "+Oa.png", "-oa.png", "Output_File_Name=a.png", "--output=a.png" },
        { "+FN16", "+fn16", "Bits_Per_Color=16", "--bits=16" },
        { "+Q4", "-q4", "Quality=4", "--quality=4" },
        { "+A", "+a", "Antialias=on", "--antialias" },
        { "+A0.3", "+a.3", "antialias=yes", "--antialias=0.3" },
    };
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++) {
        Options first, o;
        assert_true(read(&first, spellings[i][0], NULL));
        for (int k = 1; k < 4; k++) {
            CHECK(read(&o, spellings[i][k], NULL), "%s: %s", spellings[i][k], o.error);
            CHECK(o.width == first.width && o.n_threads == first.n_threads && o.clock == first.clock
                  && o.clock_on == first.clock_on && o.alpha == first.alpha && o.bits == first.bits
                  && o.quality == first.quality && o.antialias_on == first.antialias_on
                  && o.antialias.threshold == first.antialias.threshold, "%s", spellings[i][k]);
            CHECK(!o.output == !first.output && (!o.output || strcmp(o.output, first.output) == 0), "%s", spellings[i][k]);
        }
    }
}

static void switches_set_what_they_say(void **state)
{
    (void)state;
    Options o;
    assert_true(read(&o, "+W320", "+H240", "+WT4", "+SC.5", "+EC9", "+MV3.5", "Declare=Name_1=-2e3", "+L/a", "+Lb", NULL));
    assert_int_equal(o.width, 320);
    assert_int_equal(o.height, 240);
    assert_int_equal(o.n_threads, 4);
    assert_true(o.start_column == .5 && o.end_column == 9 && o.version == 3.5);
    assert_int_equal(o.n_declares, 1);
    assert_string_equal(o.declares[0].name, "Name_1");
    assert_true(o.declares[0].value == -2000);
    assert_int_equal(o.n_library_paths, 2);
    assert_string_equal(o.library_paths[0], "/a");
    assert_string_equal(o.library_paths[1], "b");
    assert_string_equal(o.input, "scene.pov");
}

static void antialiasing_is_povrays(void **state)
{
    (void)state;
    Options o;
    assert_true(read(&o, NULL));
    assert_true(!o.antialias_on && o.jitter_on && o.antialias.threshold == .3 && o.antialias.depth == 3);
    assert_true(o.antialias.method == 1 && o.antialias.gamma == 2.5 && o.block_size == 32);
    assert_true(read(&o, "+A0.1", "+AM2", "+R5", "-J", "+BS16", "Antialias_Gamma=1", NULL));
    assert_true(o.antialias_on && !o.jitter_on && o.antialias.threshold == .1 && o.antialias.method == 2);
    assert_true(o.antialias.depth == 5 && o.antialias.gamma == 1 && o.block_size == 16);
    assert_true(read(&o, "+A", "+J0.5", "-A", NULL));
    assert_true(!o.antialias_on && o.jitter_on && o.antialias.jitter == .5);
    check_refused("+A2.0", "+A2.0: 2.0 is not in the range 0 to 1");
    check_refused("+AM3", "+AM3: 3 is not in the range 1 to 2");
    check_refused("+R0", "+R0: 0 is not in the range 1 to 9");
    check_refused("Antialias=0.3", "Antialias=0.3: expected on or off");
}

static const char *ini_file(const char *text)
{
    static char path[] = "/tmp/trimray-test-XXXXXX.ini";
    strcpy(path, "/tmp/trimray-test-XXXXXX.ini");
    FILE *file = fdopen(mkstemps(path, 4), "w");
    CHECK(file && fputs(text, file) >= 0 && fclose(file) == 0, "%s", path);
    return path;
}

static void ini_files_say_what_a_command_line_says(void **state)
{
    (void)state;
    Options o;
    const char *path = ini_file("; a comment\n Width = 320 ; and another\n+H240 -J\r\nLibrary_Path=\"/a;b\"\n\n"
                                "Antialias=on\n[Large]\nWidth=1000\n[small]\nwidth=10\nheight=20");
    assert_true(read(&o, path, NULL));
    assert_true(o.width == 320 && o.height == 240 && !o.jitter_on && o.antialias_on && o.n_library_paths == 1);
    assert_string_equal(o.library_paths[0], "/a;b");
    assert_true(read(&o, "+W9", "+H9", arena_printf(arena, "%s[small]", path), "+H21", NULL));
    assert_true(o.width == 10 && o.height == 21 && o.antialias_on);
    const char *other = arena_printf(arena, "%s[huge]", path);
    check_refused(other, arena_printf(arena, "%s: there is no section [huge]", other));
    remove(path);
    path = ini_file("Width=320\nHeight=tall\n");
    check_refused(path, arena_printf(arena, "%s: line 2: Height=tall: 'tall' is not a number", path));
    remove(path);
}

static void an_ini_file_that_names_itself_is_an_error(void **state)
{
    (void)state;
    Options o;
    const char *path = ini_file("Width=320\n");
    FILE *file = fopen(path, "w");
    fprintf(file, "%s\n", path);
    fclose(file);
    assert_false(read(&o, path, NULL));
    CHECK(strstr(o.error, "more than 10 INI files within one another"), "%s", o.error);
    remove(path);
}

static void defaults_are_the_documented_ones(void **state)
{
    (void)state;
    Options o;
    assert_true(read(&o, NULL));
    assert_true(o.command == COMMAND_RENDER && o.width == 800 && o.height == 600 && o.bits == 8 && o.quality == 9);
    assert_true(!o.output && !o.stats && !o.alpha && !o.is_quiet && !o.is_verbose && !o.no_output && o.n_threads == 0);
}

static void later_settings_win(void **state)
{
    (void)state;
    Options o;
    assert_true(read(&o, "+W10", "Width=20", "--width", "30", "+UA", "-UA", "-F", "+FN", NULL));
    assert_int_equal(o.width, 30);
    assert_false(o.alpha);
    assert_false(o.no_output);
}

static void long_options_may_be_cut_short_while_clear(void **state)
{
    (void)state;
    Options o;
    assert_true(read(&o, "shoot", "--ra", "r.bin", "--out", "h.bin", "--stat=s.json", NULL));
    assert_string_equal(o.rays, "r.bin");
    assert_string_equal(o.output, "h.bin");
    assert_string_equal(o.stats, "s.json");
    check_refused("--flat", "--flat: --flattening or --flatness?");
    check_refused("--nonsense", "--nonsense: unknown option");
}

static void numbers_are_checked(void **state)
{
    (void)state;
    check_refused("+Wabc", "+Wabc: 'abc' is not a number");
    check_refused("+W0", "+W0: 0 is not in the range 1 to 1000000");
    check_refused("+H-5", "+H-5: -5 is not in the range 1 to 1000000");
    check_refused("+W1e99", "+W1e99: 1e99 is not in the range 1 to 1000000");
    check_refused("+W12.5", "+W12.5: 12.5 is not a whole number");
    check_refused("+W", "+W: needs a value");
    check_refused("+W640x", "+W640x: '640x' is not a number");
    check_refused("+W nan", "+W nan: ' nan' is not a number");
    check_refused("--width=nan", "--width=nan: 'nan' is not a number");
    check_refused("+WT0", "+WT0: 0 is not in the range 1 to 1024");
    check_refused("+Q12", "+Q12: 12 is not in the range 0 to 11");
    check_refused("--flatness=0", "--flatness=0: 0 is too small");
    check_refused("--flatness=inf", "--flatness=inf: 'inf' is not a number");
    check_refused("+FN12", "+FN12: only 8 or 16 bits a channel are written");
    check_refused("+FT", "+FT: only PNG files are written: +FN");
    check_refused("Declare=2x=1", "Declare=2x=1: '2x' is not an identifier");
    check_refused("Declare=x", "Declare=x: expected Name=number");
    check_refused("--method=guess", "--method=guess: 'guess' is not a method; there are: certain, paper");
    check_refused("Output_Alpha=perhaps", "Output_Alpha=perhaps: expected on or off");
}

static void what_is_not_there_is_named(void **state)
{
    (void)state;
    Options o;
    check_refused("+C", "+C: Continue_Trace is not yet supported");
    check_refused("+KFI1", "+KFI1: Initial_Frame is not yet supported");
    check_refused("nowhere.ini", "nowhere.ini: No such file or directory");
    check_refused("+XY", "+XY: unknown switch");
    check_refused("Colour=2", "Colour=2: unknown setting");
    check_refused("--rays=r", "--rays=r: means nothing to this command");
    check_refused("other.pov", "scene.pov: one scene at a time, and other.pov is named already");
    check_refused("", ": an empty argument");
    CHECK(read(&o, "-A", "-J", "Antialias=off", NULL), "%s", o.error);   /* switched off: nothing is missing */
}

static void a_command_says_what_it_lacks(void **state)
{
    (void)state;
    Options o;
    char *check[] = { "check" }, *shoot[] = { "shoot", "a.pov" };
    assert_false(options_read(1, check, arena, &o));
    assert_string_equal(o.error, "no scene given");
    assert_false(options_read(2, shoot, arena, &o));
    assert_string_equal(o.error, "shoot needs --rays FILE");
    assert_false(options_read(0, check, arena, &o));
}

/* What POV-Ray 3.7.0.10 rendered of 10 columns; -1: it refused, or rendered none. */
static void crops_are_those_of_povray(void **state)
{
    (void)state;
    static const struct { double from, to; int first, last; } measured[] = {
        { 0, 0, 0, 9 }, { 3, 5, 2, 4 }, { .5, .75, 5, 6 }, { .33, .77, 3, 6 }, { 0, 1, 0, 9 }, { 1, 0, 0, 9 }, 
        { 2.5, 0, 1, 9 }, { .05, 0, 0, 9 }, { 0, .96, 0, 8 }, { .96, 0, 9, 9 }, { 0, 10, 0, 9 },
        { 0, 20, -1, -1 }, { 5, 4, -1, -1 }, { 0, .05, -1, -1 }, { 11, 0, -1, -1 },
    };
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        int first = -1, end = 0;
        bool is_part = options_crop(measured[i].from, measured[i].to, 10, &first, &end);
        CHECK(is_part == (measured[i].first >= 0), "case %zu", i);
        CHECK(first == measured[i].first && end - 1 == measured[i].last, "case %zu: %d to %d", i, first, end - 1);
    }
}

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_spellings_of_an_option_mean_the_same),
        cmocka_unit_test(switches_set_what_they_say),
        cmocka_unit_test(defaults_are_the_documented_ones),
        cmocka_unit_test(antialiasing_is_povrays),
        cmocka_unit_test(ini_files_say_what_a_command_line_says),
        cmocka_unit_test(an_ini_file_that_names_itself_is_an_error),
        cmocka_unit_test(later_settings_win),
        cmocka_unit_test(long_options_may_be_cut_short_while_clear),
        cmocka_unit_test(numbers_are_checked),
        cmocka_unit_test(what_is_not_there_is_named),
        cmocka_unit_test(a_command_says_what_it_lacks),
        cmocka_unit_test(crops_are_those_of_povray),
    };
    return cmocka_run_group_tests(tests, make_arena, free_arena);
}
