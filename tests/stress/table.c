/* See table.h. */
#include "tests/stress/table.h"

#include <string.h>
#include <unistd.h>

static const char *const method_name[N_METHODS] = { "paper", "certain" };

Table table_new(void)
{
    Table t = { calloc((size_t)family_count() * FAMILY_VALUES, sizeof *t.cells) };
    if (!t.cells) abort();
    return t;
}

void table_free(Table *t) { free(t->cells); }

/* ---- the log ---- */

enum { LINE = 1024 };

static int head_line(char *out, LogHead h)
{
    return snprintf(out, LINE, "# rays %ld, for a surface %ld, all hits of every %ld\n", h.rays, h.surface_rays,
                    h.all_hits_every);
}

/* Cuts off a line that was not finished. */
static bool end_line(int fd)
{
    off_t end = lseek(fd, 0, SEEK_END);
    char c = '\n';
    while (end > 0 && pread(fd, &c, 1, end - 1) == 1 && c != '\n') end--;
    return ftruncate(fd, end) == 0;
}

bool log_begin(int fd, LogHead head)
{
    char line[LINE], is[LINE];
    ssize_t n = head_line(line, head);
    if (!end_line(fd)) return false;
    if (lseek(fd, 0, SEEK_END) == 0) return write(fd, line, (size_t)n) == n;
    return pread(fd, is, (size_t)n, 0) == n && !memcmp(is, line, (size_t)n);
}

static int write_row(char *out, int room, const Row *r)
{
    const uint64_t c[10] = { r->rays, r->hits, r->in_band, r->missed, r->false_hits, r->inexact, r->asked, r->not_once,
                             r->tests, r->fallbacks };
    int n = 0;
    for (int i = 0; i < 10; i++) n += snprintf(out + n, (size_t)(room - n), "\t%llu", (unsigned long long)c[i]);
    return n + snprintf(out + n, (size_t)(room - n), "\t%.17g\t%.17g\t%.17g", r->worst, r->seconds, r->slowest);
}

/* Moves *at to behind the row. */
static bool read_row(const char **at, Row *r)
{
    uint64_t *const c[10] = { &r->rays, &r->hits, &r->in_band, &r->missed, &r->false_hits, &r->inexact, &r->asked,
                              &r->not_once, &r->tests, &r->fallbacks };
    double *const x[3] = { &r->worst, &r->seconds, &r->slowest };
    for (int i = 0; i < 13; i++) {
        char *end;
        if (i < 10) *c[i] = strtoull(*at, &end, 10);
        else *x[i - 10] = strtod(*at, &end);
        if (end == *at) return false;
        *at = end;
    }
    return true;
}

bool log_add(int fd, Part part, const Row rows[N_METHODS])
{
    char text[LINE];
    int n = snprintf(text, LINE, "%s\t%d\t%llu", part.family->name, part.knob, (unsigned long long)part.seed);
    for (int i = 0; i < N_METHODS; i++) n += write_row(text + n, LINE - n - 1, &rows[i]);
    text[n++] = '\n';
    return write(fd, text, (size_t)n) == n;
}

static bool read_part(const char *line, Part *p, int *family, Row rows[N_METHODS])
{
    char name[64];
    unsigned long long seed;
    int n = 0;
    if (sscanf(line, "%63[^\t]\t%d\t%llu%n", name, &p->knob, &seed, &n) != 3) return false;
    for (*family = 0; *family < family_count() && strcmp(family_at(*family)->name, name) != 0; ++*family) {}
    if (*family == family_count() || p->knob < 0 || p->knob >= family_at(*family)->n) return false;
    p->family = family_at(*family), p->seed = seed;
    const char *at = line + n;
    for (int i = 0; i < N_METHODS; i++)
        if (!read_row(&at, &rows[i])) return false;
    return *at == '\n';
}

void log_read(int fd, Table *t, void (*seen)(void *context, Part part), void *context)
{
    FILE *f = fdopen(dup(fd), "r");
    if (!f) return;
    rewind(f);
    char line[LINE];
    while (fgets(line, sizeof line, f)) {
        Part part;
        int family;
        Row rows[N_METHODS];
        if (!read_part(line, &part, &family, rows)) continue;
        for (int i = 0; i < N_METHODS; i++) row_add(&t->cells[family * FAMILY_VALUES + part.knob].rows[i], &rows[i]);
        if (seen) seen(context, part);
    }
    fclose(f);
}

/* ---- printing ---- */

static void print_row(const char *name, const char *knob, int method, const Row *r)
{
    if (r->rays == 0) return;
    printf("| %s | %s | %s | %llu | %llu | %llu | %llu | %llu | %llu | %llu of %llu | %.1e | %.2f %% | %.0f | %.0f |\n",
           name, knob, method_name[method], (unsigned long long)r->rays, (unsigned long long)r->hits,
           (unsigned long long)r->in_band, (unsigned long long)r->missed, (unsigned long long)r->false_hits,
           (unsigned long long)r->inexact, (unsigned long long)r->not_once, (unsigned long long)r->asked, r->worst,
           r->tests ? 100.0 * (double)r->fallbacks / (double)r->tests : 0, 1e9 * r->seconds / (double)r->rays,
           1e6 * r->slowest);
}

static Row family_sum(const Table *t, int family, int method)
{
    Row sum = { 0 };
    for (int i = 0; i < FAMILY_VALUES; i++) row_add(&sum, &t->cells[family * FAMILY_VALUES + i].rows[method]);
    return sum;
}

static void print_family(const Table *t, int family, bool by_knob)
{
    const Family *f = family_at(family);
    char knob[80];
    for (int i = 0; by_knob && i < f->n; i++) {
        snprintf(knob, sizeof knob, "%s %g", f->knob, f->values[i]);
        for (int method = 0; method < N_METHODS; method++)
            print_row(f->name, knob, method, &t->cells[family * FAMILY_VALUES + i].rows[method]);
    }
    snprintf(knob, sizeof knob, "%s: %g … %g", f->knob, f->values[0], f->values[f->n - 1]);
    for (int method = 0; !by_knob && method < N_METHODS; method++) {
        Row sum = family_sum(t, family, method);
        print_row(f->name, knob, method, &sum);
    }
}

Row table_total(const Table *t, int method)
{
    Row total = { 0 };
    for (int i = 0; i < family_count(); i++) {
        Row sum = family_sum(t, i, method);
        row_add(&total, &sum);
    }
    return total;
}

void table_print(const Table *t, bool by_knob)
{
    printf("| family | knob | method | rays | hits | in the band | missed | false | inexact | not once | largest t error "
           "| fallbacks | ns a ray | slowest, µs |\n"
           "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (int i = 0; i < family_count(); i++) print_family(t, i, by_knob);
    for (int method = 0; method < N_METHODS; method++) {
        Row total = table_total(t, method);
        print_row("all", "", method, &total);
    }
    fflush(stdout);
}
