/* Scenes that have been damaged: whatever is deleted, doubled, exchanged or overwritten, reading ends, without a crash (the
 * sanitizers see to the rest). A failure is repeated by its seed. */
#include "tests/scene_text.h"

#include <glob.h>

enum { N_SCENES = 20000, MAX_SIZE = 6000 };

typedef struct { char *text; size_t n; } Sample;

static Sample sample_of(const char *path)
{
    Sample s = { .text = calloc(1, MAX_SIZE) };
    FILE *f = fopen(path, "rb");
    CHECK(f != NULL, "%s", path);
    s.n = fread(s.text, 1, MAX_SIZE, f);
    fclose(f);
    return s;
}

/* A scene without files: all that the language's core has. */
static const char core_scene[] =
    "#version 3.7; #declare A = array[2][2]{{1, 2}, {x, \"s\"}}\n"
    "#macro M(X, Y) #local Z = X + Y; #if (Z > 2) Z #else -Z #end #end\n"
    "#for (I, 0, 3) #declare B = M(I, <1, 2, 3>.y)*2; #if (B < 3) #break #end #end #while (B > 0) #declare B = B - 1; #end\n"
    "#switch (B) #case (1) #debug str(1, 2, 3) #break #range (0, 5) #debug concat(\"a\", chr(66)) #else #end\n"
    "#declare T = texture { pigment { granite } } #declare C = rgbft <1, 2, 3, 4, 5>*.5 + color red 1; #undef T\n"
    "#ifdef (A[0][1]) #declare A[1][0] = A; #end #default { pigment { color C } } #include concat(\"no\", \"ne\")\n"
    "sphere { A[0][0]*y, M(1, 2) texture { T } rotate vrotate(x, 45*y) } trimmed_nurbs < order 2, 2 keep left >\n"
    "#declare S = seed(1); box { rand(S), (1 < 2 ? 3 : 4) } /* a /* b */ c */ // d\n";

static void splice(char *text, size_t *n, size_t at, size_t removed, const char *piece, size_t added)
{
    if (*n - removed + added >= MAX_SIZE) return;
    memmove(text + at + added, text + at + removed, *n - at - removed);
    memcpy(text + at, piece, added);
    *n += added - removed;
}

/* One change: a byte, a piece left out, a piece of a sample put in, a word of the language. */
static void damage(TestRandom *r, char *text, size_t *n, const Sample *other)
{
    static const char *const words[] = { "#", "{", "}", "<", ">", "(", ")", "[", "\"", "/*", "*/", "#end ", "#if (",
                                         "#while (1)", "#macro M(A) ", "M(", "#declare A = ", "1e308", "-", "A[",
                                         "&", "?", "\0" };
    size_t at = *n ? (size_t)test_int(r, 0, (int)*n - 1) : 0, left = *n - at;
    size_t length = (size_t)test_int(r, 0, 40), from = (size_t)test_int(r, 0, (int)other->n - 1);
    const char *word = words[test_int(r, 0, (int)(sizeof words / sizeof *words) - 1)];
    if (length > left) length = left;
    switch (test_int(r, 0, 3)) {
    case 0: if (left) text[at] = (char)test_int(r, 0, 255); break;
    case 1: splice(text, n, at, length, "", 0); break;
    case 2: splice(text, n, at, 0, other->text + from, other->n - from < 40 ? other->n - from : 40); break;
    default: splice(text, n, at, 0, word, word[0] ? strlen(word) : 1); break;
    }
}

static void damaged_scenes_are_read_to_their_end(void **state)
{
    (void)state;
    glob_t found;
    Sample samples[64] = { { strdup(core_scene), strlen(core_scene) } };
    int n_samples = 1;
    glob("ok/*.pov", 0, NULL, &found);
    glob("bad/*.pov", GLOB_APPEND, NULL, &found);
    for (size_t i = 0; i < found.gl_pathc && n_samples < 64; i++) samples[n_samples++] = sample_of(found.gl_pathv[i]);
    for (unsigned seed = 0; seed < N_SCENES; seed++) {
        TestRandom r = test_random(seed);
        const Sample *base = &samples[seed % 2 ? 0 : test_int(&r, 0, n_samples - 1)];
        static char text[MAX_SIZE];
        size_t n = base->n;
        memcpy(text, base->text, n);
        for (int k = test_int(&r, 1, 4); k > 0; k--) damage(&r, text, &n, &samples[test_int(&r, 0, n_samples - 1)]);
        Read read = read_bytes(text, n, (ParseOptions){ .max_steps = 300 });
        CHECK(read.is_ok == (read.n_errors == 0), "seed %u", seed);
        read_done(&read);
    }
    for (int i = 0; i < n_samples; i++) free(samples[i].text);
    globfree(&found);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(damaged_scenes_are_read_to_their_end) };
    const char *folder = getenv("TRIMRAY_TESTS_DIR");
    if (folder && chdir(folder) != 0) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
