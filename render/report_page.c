/* The page: one HTML file that asks nothing of anyone. Pictures are data: URIs, plots are SVG (report_plot.c). */
#include "render/report.h"

#include "render/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

void report_escape(FILE *f, const char *text)
{
    for (; *text; text++)
        if (*text == '<') fputs("&lt;", f);
        else if (*text == '>') fputs("&gt;", f);
        else if (*text == '&') fputs("&amp;", f);
        else if (*text == '"') fputs("&quot;", f);
        else fputc(*text, f);
}

static void put_lines(FILE *f, const char *const lines[])
{
    for (; *lines; lines++) fprintf(f, "%s\n", *lines);
}

/* ---- pictures ---- */

static void put_base64(FILE *f, const unsigned char *bytes, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        unsigned word = (unsigned)bytes[i] << 16 | (i + 1 < n ? (unsigned)bytes[i + 1] << 8 : 0)
            | (i + 2 < n ? bytes[i + 2] : 0);
        for (size_t k = 0; k < 4; k++) fputc(k <= n - i ? digits[word >> (18 - 6 * k) & 63] : '=', f);
    }
}

static void put_image(FILE *f, const Report *r, const char *path, const char *class, const char *alt)
{
    size_t n;
    const char *bytes = file_read(path, r->arena, &n);
    fprintf(f, "<img class=\"%s\" width=\"%d\" height=\"%d\" alt=\"", class, r->width, r->height);
    report_escape(f, alt);
    fputs("\" src=\"data:image/png;base64,", f);
    if (bytes) put_base64(f, (const unsigned char *)bytes, n);
    fputs("\">\n", f);
}

static bool is_measured(const ReportSample *s, const ReportScene *scene)
{
    return s->scene == scene && s->is_done && !s->failure;
}

/* The coarsest and the finest of each line, and what is the default: the others lie in the folder. */
static bool is_pictured(const Report *r, size_t i)
{
    const ReportSample *s = &r->samples[i];
    bool is_first = i == 0 || s[-1].series != s->series || s[-1].scene != s->scene;
    bool is_last = i + 1 == r->n_samples || s[1].series != s->series || s[1].scene != s->scene || !s[1].is_done;
    return is_first || is_last || s->number[REPORT_IS_DEFAULT] == 1;
}

/* The coarsest mesh is shown first: there is something to see. */
static void put_choice(FILE *f, const Report *r, const ReportScene *scene)
{
    fprintf(f, "<select aria-label=\"method and setting\">\n");
    for (size_t i = 0; i < r->n_samples; i++) {
        const ReportSample *s = &r->samples[i];
        if (is_measured(s, scene) && is_pictured(r, i))
            fprintf(f, "<option%s>%s: %.3g %% of the pixels differ by more than 1/255</option>\n",
                    s->series == REPORT_MESH && s->round == 0 ? " selected" : "", report_sample_name(r->arena, s),
                    100 * s->number[REPORT_OVER]);
    }
    fputs("</select>\n", f);
}

static void put_comparison(FILE *f, const Report *r, const ReportScene *scene)
{
    fputs("<figure class=\"compare\">\n", f);
    put_choice(f, r, scene);
    for (size_t i = 0, n = 0; i < r->n_samples; i++) {
        const ReportSample *s = &r->samples[i];
        if (!is_measured(s, scene) || !is_pictured(r, i)) continue;
        fprintf(f, "<div class=\"stage\"%s>\n", n++ ? " hidden" : "");
        put_image(f, r, s->picture, "below", report_sample_name(r->arena, s));
        put_image(f, r, s->difference, "above", "differences");
        fputs("</div>\n", f);
    }
    fputs("<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"picture or differences\">\n"
          "<figcaption>Left of the line the picture, right of it what differs from the reference: grey is equal, blue"
          " differs by at most 1/255, yellow, red and white by more and more. Move the slider.</figcaption>\n"
          "</figure>\n", f);
}

static void put_pictures(FILE *f, const Report *r, const ReportScene *s)
{
    fputs("<div class=\"pair\">\n<figure>\n", f);
    put_image(f, r, s->picture, "reference", s->name);
    fprintf(f, "<figcaption>The reference: method certain with the smallest leaves, %d x %d, one ray a pixel.</figcaption>\n"
            "</figure>\n", r->width, r->height);
    put_comparison(f, r, s);
    fputs("</div>\n", f);
}

/* ---- plots ---- */

static const char TIME[] = "run time, seconds";

static const ReportPlot plots[] = {
    { REPORT_TOTAL, REPORT_DEPTH_P99, "Depth against run time", TIME, "depth error (99 % of rays), of the size" },
    { REPORT_TOTAL, REPORT_NORMAL_P99, "Normals against run time", TIME, "normal's error (99 % of rays), degrees" },
    { REPORT_TOTAL, REPORT_COVERAGE, "Coverage against run time", TIME, "missed, false and other rays, share" },
    { REPORT_TOTAL, REPORT_RMSE, "Picture against run time", TIME, "picture's error, RMSE" },
    { REPORT_GEOMETRY_MB, REPORT_DEPTH_P99, "Depth against memory", "geometry and its tree, MB",
      "depth error (99 % of rays), of the size" },
    { REPORT_PEAK_MB, REPORT_RMSE, "Picture against memory", "the whole process, MB", "picture's error, RMSE" },
};

static void put_legend(FILE *f, const Report *r)
{
    fputs("<ul class=\"legend\">\n", f);
    for (int k = 0; k < REPORT_N_SERIES; k++) {
        if (k == REPORT_POVRAY && !r->povray) continue;
        fprintf(f, "<li><svg viewBox=\"0 0 36 16\" aria-hidden=\"true\"><path class=\"line s%d\" d=\"M0 8H36\"/>"
                "<circle class=\"dot s%d\" cx=\"18\" cy=\"8\" r=\"5\"/></svg>%s</li>\n", k, k, report_methods[k].title);
    }
    fputs("<li class=\"faint\">ringed and dotted: the Pareto front, nothing is both cheaper and better; larger: the default;"
          " 0: no error at all</li>\n</ul>\n", f);
}

static void put_plots(FILE *f, const Report *r, const ReportScene *s)
{
    put_legend(f, r);
    fputs("<div class=\"plots\">\n", f);
    for (size_t i = 0; i < sizeof plots / sizeof *plots; i++) report_plot(f, r, s, &plots[i], false);
    fputs("</div>\n", f);
}

/* ---- tables ---- */

static void put_cell(FILE *f, double x, const char *format)
{
    fputs("<td>", f);
    if (isnan(x)) fputs("–", f);
    else fprintf(f, format, x);
    fputs("</td>", f);
}

static void put_head(FILE *f, const char *heading, const char *class)
{
    fprintf(f, "<h3>%s</h3>\n<div class=\"scroll\"><table class=\"%s\"><tr>", heading, class);
}

static const struct { const char *title; ReportNumber number; const char *format; } cells[] = {
    { "total s", REPORT_TOTAL, "%.3f" }, { "least", REPORT_TOTAL_LEAST, "%.3f" }, { "most", REPORT_TOTAL_MOST, "%.3f" },
    { "parse", REPORT_PARSE, "%.3f" }, { "prepare", REPORT_PREPARE, "%.3f" }, { "trace", REPORT_TRACE, "%.3f" },
    { "write", REPORT_WRITE, "%.3f" }, { "peak<br>MB", REPORT_PEAK_MB, "%.1f" },
    { "geometry<br>MB", REPORT_GEOMETRY_MB, "%.3g" }, { "leaves or<br>triangles", REPORT_PIECES, "%.0f" },
    { "missed<br>rays", REPORT_MISSED, "%.0f" }, { "false", REPORT_FALSE, "%.0f" }, { "other", REPORT_OTHER, "%.0f" },
    { "depth<br>median", REPORT_DEPTH_MEDIAN, "%.2g" }, { "99 %", REPORT_DEPTH_P99, "%.2g" },
    { "largest", REPORT_DEPTH_LARGEST, "%.2g" }, { "normal °<br>median", REPORT_NORMAL_MEDIAN, "%.2g" },
    { "99 %", REPORT_NORMAL_P99, "%.2g" }, { "picture<br>RMSE", REPORT_RMSE, "%.2g" },
    { "largest", REPORT_LARGEST, "%.2g" }, { "share over<br>1/255", REPORT_OVER, "%.2g" },
};
enum { N_CELLS = sizeof cells / sizeof *cells };

static void put_sample(FILE *f, const Report *r, const ReportSample *s)
{
    const char *class = s->number[REPORT_IS_DEFAULT] == 1 ? " class=\"default\"" : "";
    fprintf(f, "<tr%s><td>%s</td>", class, report_sample_name(r->arena, s));
    if (s->failure) {
        fprintf(f, "<td colspan=\"%d\" class=\"failure\">", N_CELLS);
        report_escape(f, s->failure);
        fputs("</td>", f);
    }
    for (int i = 0; !s->failure && i < N_CELLS; i++) put_cell(f, s->number[cells[i].number], cells[i].format);
    fputs("</tr>\n", f);
}

static void put_table(FILE *f, const Report *r, const ReportScene *scene)
{
    put_head(f, "All settings", "settings");
    fputs("<th>method and setting</th>", f);
    for (int i = 0; i < N_CELLS; i++) fprintf(f, "<th>%s</th>", cells[i].title);
    fputs("</tr>\n", f);
    for (size_t i = 0; i < r->n_samples; i++)
        if (r->samples[i].scene == scene && r->samples[i].is_done) put_sample(f, r, &r->samples[i]);
    fputs("</table></div>\n", f);
}

/* [MCFS00] Figure 8, of the default settings. */
static void put_statistics_row(FILE *f, const ReportSample *s)
{
    const double *n = s->number;
    fprintf(f, "<tr><td>%s</td>", report_methods[s->series].method);
    put_cell(f, n[REPORT_SURFACES], "%.0f"), put_cell(f, n[REPORT_TRIMS], "%.0f"), put_cell(f, n[REPORT_RAYS], "%.0f");
    put_cell(f, n[REPORT_BV], "%.0f"), put_cell(f, n[REPORT_LIGHT_BV], "%.0f"), put_cell(f, n[REPORT_TESTS], "%.0f");
    put_cell(f, 1e6 * n[REPORT_TEST_SECONDS], "%.3f");
    put_cell(f, n[REPORT_HITS], "%.0f"), put_cell(f, 100 * n[REPORT_HITS] / n[REPORT_TESTS], "%.1f %%");
    put_cell(f, n[REPORT_REPORTED], "%.0f"), put_cell(f, 100 * n[REPORT_REPORTED] / n[REPORT_TESTS], "%.1f %%");
    put_cell(f, n[REPORT_ITERATIONS], "%.2f");
    fputs("</tr>\n", f);
}

static void put_statistics(FILE *f, const Report *r, const ReportScene *scene)
{
    static const char *const titles[] = {
        "method", "surfaces", "trims", "rays", "BV inter-<br>sections", "light BV<br>intersections", "NURBS<br>tests",
        "µs a test", "hits", "of tests", "reported<br>hits", "of tests", "iterations<br>a test"
    };
    put_head(f, "Statistics, as in [MCFS00] Figure 8", "statistics");
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) fprintf(f, "<th>%s</th>", titles[i]);
    fputs("</tr>\n", f);
    for (size_t i = 0; i < r->n_samples; i++) {
        const ReportSample *s = &r->samples[i];
        bool has_tests = s->series == REPORT_CERTAIN || s->series == REPORT_PAPER_ITERATIONS;
        if (is_measured(s, scene) && has_tests && s->number[REPORT_IS_DEFAULT] == 1) put_statistics_row(f, s);
    }
    fputs("</table></div>\n", f);
}

/* ---- the whole ---- */

static void put_scene(FILE *f, const Report *r, const ReportScene *s)
{
    fprintf(f, "<section class=\"scene\" id=\"%s\">\n<h2%s>", s->name, s == r->scenes ? " class=\"first\"" : "");
    report_escape(f, s->path);
    fputs("</h2>\n", f);
    bool has_any = false;
    for (size_t i = 0; i < r->n_samples; i++) has_any |= is_measured(&r->samples[i], s);
    if (s->failure) {
        fputs("<p class=\"failure\">Not measured: ", f);
        report_escape(f, s->failure);
        fputs("</p>\n", f);
    } else if (!has_any) {
        fputs("<p>Nothing was measured of it.</p>\n", f);
    } else {
        put_pictures(f, r, s);
        put_plots(f, r, s);
        put_table(f, r, s);
        put_statistics(f, r, s);
    }
    fputs("</section>\n", f);
}

static void put_columns(FILE *f)
{
    put_head(f, "The columns of report.csv", "words");
    fputs("<th>column</th><th>unit</th><th>meaning</th></tr>\n", f);
    for (int i = 0; i < REPORT_N_NUMBERS; i++) {
        const ReportColumn *c = &report_columns[i];
        fprintf(f, "<tr><td><code>%s</code></td><td>%s</td><td>%s</td></tr>\n", c->name, c->unit, c->help);
    }
    fputs("</table></div>\n", f);
}

static const char METHOD[] =
    "<section>\n<h2>How the numbers were made</h2>\n"
    "<p>Each setting is traced in a process of its own, from the scene's file to the picture's, several times; times are"
    " medians. Errors are counted on one camera ray through the middle of each pixel, against <code>certain</code> with leaves"
    " far smaller than its default, which loses no hit; the picture's on the same rays with all of their light."
    " <code>paper</code> is the method of [MCFS00]: its flatness C with ten Newton steps, and its iteration limit with the"
    " flatness that trimray chooses. <code>mesh</code> cuts each surface into triangles within the chord error and traces"
    " these, in the same program; <code>povray</code> is POV-Ray on the exported scene with the same triangles.</p>\n";

static void put_entry(FILE *f, const char *what, const char *text)
{
    fprintf(f, "<dt>%s</dt><dd>", what);
    report_escape(f, text);
    fputs("</dd>\n", f);
}

static void put_method(FILE *f, const Report *r)
{
    fprintf(f, "%s<dl>\n", METHOD);
    put_entry(f, "machine", report_machine(r->arena));
    put_entry(f, "program", report_build());
    put_entry(f, "picture", arena_printf(r->arena, "%d x %d", r->width, r->height));
    put_entry(f, "threads, runs", arena_printf(r->arena, "%d, %d", r->n_threads, r->n_runs));
    put_entry(f, "load before", arena_printf(r->arena, "%.2f: what else the machine had to do is in the times", r->load));
    put_entry(f, "to repeat it", report_command(r));
    fputs("</dl>\n", f);
    put_columns(f);
    fputs("</section>\n", f);
}

static void put_notes(FILE *f, const Report *r)
{
    for (size_t i = 0; i < r->n_notes; i++) {
        fputs("<p class=\"failure\">Left out: ", f);
        report_escape(f, r->notes[i]);
        fputs("</p>\n", f);
    }
}

static void put_contents(FILE *f, const Report *r)
{
    fputs("<p>", f);
    for (size_t i = 0; i < r->n_scenes; i++)
        fprintf(f, "%s<a href=\"#%s\">%s</a>", i ? " · " : "", r->scenes[i].name, r->scenes[i].name);
    fputs("</p>\n", f);
}

/* The policy allows what is in the page, and nothing that is not. */
static const char HEAD[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\"\n"
    "  content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
    "<title>Error against run time</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n";

static void put_page(FILE *f, const Report *r, const void *context)
{
    (void)context;
    fputs(HEAD, f);
    put_lines(f, report_style);
    fputs("</style>\n</head>\n<body>\n<h1>Error against run time</h1>\n"
          "<p>NURBS surfaces intersected directly, and as triangles: what each method gets wrong, and what it costs."
          " To the left is faster, down is better.</p>\n", f);
    put_contents(f, r);
    put_notes(f, r);
    for (size_t i = 0; i < r->n_scenes; i++) put_scene(f, r, &r->scenes[i]);
    put_method(f, r);
    fputs("<div id=\"tip\" role=\"status\" hidden></div>\n<script>\n", f);
    put_lines(f, report_script);
    fputs("</script>\n</body>\n</html>\n", f);
}

bool report_write_page(const Report *r) { return report_write_file(r, "index.html", put_page, NULL); }

/* ---- plots as files ---- */

typedef struct { const ReportScene *scene; const ReportPlot *plot; } PlotFile;

static void put_plot_file(FILE *f, const Report *r, const void *context)
{
    const PlotFile *p = context;
    report_plot(f, r, p->scene, p->plot, true);
}

bool report_write_plots(const Report *r)
{
    for (size_t i = 0; i < r->n_scenes; i++)
        for (size_t k = 0; !r->scenes[i].failure && k < sizeof plots / sizeof *plots; k++) {
            PlotFile p = { &r->scenes[i], &plots[k] };
            const char *x = report_columns[p.plot->x].name, *y = report_columns[p.plot->y].name;
            const char *name = arena_printf(r->arena, "%s-%s-%s.svg", p.scene->name, y, x);
            if (!report_write_file(r, name, put_plot_file, &p)) return false;
        }
    return true;
}
