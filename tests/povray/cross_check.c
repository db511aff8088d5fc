/* Renders scenes with povray and with trimray, compares the pictures, and prints a table of them all.
 *
 *   cross_check [--survey] TRIMRAY (FOLDER | SCENE.pov)...
 *
 * A scene agrees if no channel differs by more than 1/255 in 99.9 % of its pixels. Its first lines may say otherwise:
 *   // povray: +A0.3 -J              more switches, for both programs
 *   // allow: 0.3 % the silhouette   this share of the pixels may differ, for this reason
 * With --survey, scenes that trimray does not read are listed with the first error, and only a picture that was made and
 * is missing or different on one side counts as a difference; nothing fails. Exit status: 0 all agree, 1 not,
 * 77 there is no povray. */
#include "render/image.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WIDTH = 160, HEIGHT = 120, SKIPPED = 77, MAX_ARGUMENTS = 64, SECONDS_SURVEY = 100, SECONDS = 300 };

static const double DEFAULT_ALLOWANCE = .1;   /* percent of the pixels */
static const int LEVEL = 257;                 /* 1/255 in samples of 16 bits */

typedef struct {
    const char *path, *folder, *file;
    char *switches;              /* more of them; may be empty */
    double allowance;            /* percent */
    const char *reason;          /* NULL: none given */
} Case;

typedef struct {
    double largest;              /* of all channels of all pixels, in steps of 1/255 */
    double share;                /* percent of the pixels that differ by more than one step */
    const char *failure;         /* NULL: both made a picture */
    const char *left_out;        /* what trimray says that it left out; may be empty */
} Outcome;

typedef struct { const char *trimray, *work; bool is_survey; Arena *arena; int n_agree, n_differ, n_not_read; } Check;

/* ---- scenes ---- */

static char *after(char *line, const char *mark)
{
    char *at = strstr(line, mark);
    return at ? at + strlen(mark) : NULL;
}

/* The comments that a scene begins with. */
static void read_header(Arena *a, Case *c)
{
    char *line = NULL;
    size_t size = 0;
    FILE *f = fopen(c->path, "r");
    while (f && getline(&line, &size, f) > 0 && strncmp(line, "//", 2) == 0) {
        line[strcspn(line, "\r\n")] = '\0';
        char *switches = after(line, "// povray:"), *allow = after(line, "// allow:");
        if (switches) c->switches = arena_printf(a, "%s %s", c->switches, switches);
        if (allow) {
            c->allowance = strtod(allow, &allow);
            c->reason = arena_printf(a, "%s", allow + strspn(allow, " %"));
        }
    }
    free(line);
    if (f) fclose(f);
}

static Case case_make(const Check *k, const char *path)
{
    char *full = realpath(path, NULL);
    const char *kept = arena_printf(k->arena, "%s", full ? full : path), *slash = strrchr(kept, '/');
    free(full);
    Case c = { .path = kept, .file = slash + 1, .folder = arena_printf(k->arena, "%.*s", (int)(slash - kept), kept),
               .switches = arena_printf(k->arena, "%s", ""), .allowance = DEFAULT_ALLOWANCE };
    if (!k->is_survey) read_header(k->arena, &c);
    return c;
}

/* ---- the two programs ---- */

/* Runs in the scene's folder; what it says goes to the file `log`. */
static pid_t start(const Check *k, const Case *c, const char *program, const char *picture, const char *log,
                   char *const more[])
{
    char *arguments[MAX_ARGUMENTS];
    int n = 0;
    arguments[n++] = arena_printf(k->arena, "%s", program);
    arguments[n++] = arena_printf(k->arena, "+I%s", c->file);
    arguments[n++] = arena_printf(k->arena, "+O%s", picture);
    arguments[n++] = arena_printf(k->arena, "+W%d", WIDTH);
    arguments[n++] = arena_printf(k->arena, "+H%d", HEIGHT);
    arguments[n++] = arena_printf(k->arena, "%s", "-D");
    for (; *more; more++) arguments[n++] = *more;
    char *switches = arena_printf(k->arena, "%s", c->switches), *rest;
    for (char *s = strtok_r(switches, " ", &rest); s && n < MAX_ARGUMENTS - 1; s = strtok_r(NULL, " ", &rest))
        arguments[n++] = s;
    arguments[n] = NULL;
    fflush(stdout);
    pid_t child = fork();
    if (child != 0) return child;
    rlim_t seconds = k->is_survey ? SECONDS_SURVEY : SECONDS;
    int out = open(log, O_CREAT | O_WRONLY | O_TRUNC, 0600);
    if (out < 0 || dup2(out, STDERR_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 || chdir(c->folder) != 0) _exit(126);
    setrlimit(RLIMIT_CPU, &(struct rlimit){ seconds, seconds });
    execvp(program, arguments);
    _exit(127);
}

static int status_of(pid_t child)
{
    int status = -1;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return status;
}

/* What trimray said that it left out, between quotes: it may be why the pictures differ. */
static const char *left_out(const Check *k, const char *log)
{
    char *line = NULL, *found = arena_strdup(k->arena, "");
    size_t size = 0;
    FILE *f = fopen(log, "r");
    while (f && getline(&line, &size, f) > 0) {
        const char *word = strchr(line, '\'');
        if (!strstr(line, "is read and left out") || !word) continue;
        int length = (int)strcspn(word + 1, "'");
        found = arena_printf(k->arena, "%s %.*s", *found ? found : "left out:", length, word + 1);
    }
    free(line);
    if (f) fclose(f);
    return found;
}

/* The first error that trimray reports. */
static const char *first_error(const Check *k, const char *log)
{
    char *line = NULL;
    size_t size = 0;
    const char *found = "no message";
    FILE *f = fopen(log, "r");
    while (f && getline(&line, &size, f) > 0) {
        if (!strstr(line, "error: ")) continue;
        line[strcspn(line, "\n")] = '\0';
        found = arena_printf(k->arena, "%s", line);
        break;
    }
    free(line);
    if (f) fclose(f);
    return found;
}

/* ---- comparing ---- */

static int sample_difference(uint16_t a, uint16_t b) { return a > b ? a - b : b - a; }

static int pixel_difference(const uint16_t *a, const uint16_t *b)
{
    int largest = 0;
    for (int i = 0; i < 4; i++) {
        int d = sample_difference(a[i], b[i]);
        if (d > largest) largest = d;
    }
    return largest;
}

static void compare(Arena *a, const char *expected, const char *found, Outcome *out)
{
    const Image *p = image_read_png(a, expected, &out->failure);
    const Image *q = p ? image_read_png(a, found, &out->failure) : NULL;
    if (!q) return;
    if (p->width != q->width || p->height != q->height) {
        out->failure = "the pictures have different sizes";
        return;
    }
    size_t n = (size_t)p->width * (size_t)p->height, n_over = 0;
    for (size_t i = 0; i < n; i++) {
        int d = pixel_difference(p->rgba + 4 * i, q->rgba + 4 * i);
        n_over += d > LEVEL;
        out->largest = fmax(out->largest, d / (double)LEVEL);
    }
    out->share = 100. * (double)n_over / (double)n;
}

static char *name_in(const Check *k, const char *stem, const char *end)
{
    return arena_printf(k->arena, "%s/%s%s", k->work, stem, end);
}

static Outcome run_both(const Check *k, const Case *c, bool *is_read)
{
    char *expected = name_in(k, c->file, ".povray.png"), *found = name_in(k, c->file, ".trimray.png");
    char *said = name_in(k, c->file, ".log"), *ignored = name_in(k, c->file, ".povray.log");
    unlink(expected), unlink(found);
    pid_t ours = start(k, c, k->trimray, found, said, (char *[]){ NULL });
    int our_status = status_of(ours);
    Outcome out = { .failure = NULL };
    *is_read = our_status == 0;
    if (our_status != 0) {
        out.failure = first_error(k, said);
        if (WIFSIGNALED(our_status)) out.failure = arena_printf(k->arena, "trimray: %s", strsignal(WTERMSIG(our_status)));
        return out;
    }
    char quiet[] = "-V", no_report[] = "-GA";
    if (status_of(start(k, c, "povray", expected, ignored, (char *[]){ quiet, no_report, NULL })) != 0) {
        out.failure = "povray makes no picture of it";
        return out;
    }
    compare(k->arena, expected, found, &out);
    out.left_out = left_out(k, said);
    return out;
}

/* ---- the table ---- */

static void print_row(Check *k, const Case *c, const Outcome *o, bool is_read)
{
    const char *name = k->is_survey ? c->path : c->file;
    bool agrees = !o->failure && o->share <= c->allowance;
    k->n_agree += agrees, k->n_differ += is_read && !agrees, k->n_not_read += !is_read;
    const char *note = c->reason ? c->reason : agrees || o->failure ? "" : o->left_out;
    if (o->failure) printf("| %s | | | %s |\n", name, o->failure);
    else printf("| %s | %.1f | %.3f %% | %s%s |\n", name, o->largest, o->share, agrees ? "" : "DIFFERS ", note);
    fflush(stdout);
}

static void check_scene(Check *k, const char *path)
{
    ArenaMark mark = arena_mark(k->arena);
    Case c = case_make(k, path);
    bool is_read;
    Outcome o = run_both(k, &c, &is_read);
    print_row(k, &c, &o, is_read);
    arena_reset(k->arena, mark);
}

static int is_scene(const struct dirent *d)
{
    size_t n = strlen(d->d_name);
    return n > 4 && strcmp(d->d_name + n - 4, ".pov") == 0;
}

static void check_path(Check *k, const char *path)
{
    struct dirent **list;
    int n = scandir(path, &list, is_scene, alphasort);
    if (n < 0) {
        check_scene(k, path);
        return;
    }
    for (int i = 0; i < n; i++) {
        char full[PATH_MAX];
        snprintf(full, sizeof full, "%s/%s", path, list[i]->d_name);
        check_scene(k, full);
        free(list[i]);
    }
    free(list);
}

int main(int argc, char *argv[])
{
    Check k = { .arena = arena_new() };
    int first = 1;
    if (first < argc && strcmp(argv[first], "--survey") == 0) k.is_survey = true, first++;
    if (argc - first < 2) return fputs("usage: cross_check [--survey] TRIMRAY (FOLDER | SCENE.pov)...\n", stderr), 1;
    if (system("command -v povray >/dev/null") != 0) {
        puts("skipped: povray is not installed, nothing was compared");
        return SKIPPED;
    }
    char work[] = "/tmp/cross_check.XXXXXX";
    char *trimray = realpath(argv[first], NULL);
    const char *kept = getenv("CROSS_CHECK_KEEP");   /* a folder that keeps the pictures and what the programs said */
    k.work = kept ? kept : mkdtemp(work), k.trimray = trimray;
    if (!k.work || !k.trimray) return perror("cross_check"), 1;
    puts("| scene | largest difference, 1/255 | pixels over 1/255 | |\n|---|---:|---:|---|");
    for (int i = first + 1; i < argc; i++) check_path(&k, argv[i]);
    printf("\n%d scenes agree, %d differ, %d are not read\n", k.n_agree, k.n_differ, k.n_not_read);
    char *remove = arena_printf(k.arena, "rm -rf '%s'", k.work);
    bool is_removed = kept || system(remove) == 0;
    arena_free(k.arena);
    free(trimray);
    return is_removed && (k.is_survey || (k.n_differ == 0 && k.n_not_read == 0)) ? 0 : 1;
}
