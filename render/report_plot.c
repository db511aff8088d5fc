/* A plot of the page: SVG with logarithmic axes, a line for each method and knob, and rings round the Pareto front. Drawn
 * here, not by a plotting program: the page takes its colours from the reader's light or dark, and its points answer. */
#include "render/report.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 560, HEIGHT = 380, LEFT = 66, RIGHT = 14, TOP = 34, BOTTOM = 48, ZERO_BAND = 22, NAMES = 24 };

/* Logarithms from lo to hi lie at the pixels from `from` to `to`; zeros, which have none, at `zero`. */
typedef struct { double lo, hi, from, to, zero; bool has_zero; } Axis;

typedef struct { double x, y; const ReportSample *sample; bool is_best; } Point;

typedef struct {
    FILE *file;
    Arena *arena;
    Point *points;
    size_t n;
    Axis x, y;
} Plot;

/* ---- axes ---- */

static Axis axis_of(const Plot *p, bool is_x)
{
    Axis a = { .lo = INFINITY, .hi = -INFINITY };
    for (size_t i = 0; i < p->n; i++) {
        double v = is_x ? p->points[i].x : p->points[i].y;
        if (v > 0) a.lo = fmin(a.lo, log10(v)), a.hi = fmax(a.hi, log10(v));
        else a.has_zero = true;
    }
    if (!(a.lo <= a.hi)) a.lo = -1, a.hi = 0;
    double margin = fmax(.05 * (a.hi - a.lo), .12);
    a.lo -= margin, a.hi += margin;
    return a;
}

static double place(const Axis *a, double v)
{
    return v > 0 ? a->from + (log10(v) - a->lo) / (a->hi - a->lo) * (a->to - a->from) : a->zero;
}

static void place_axes(Plot *p)
{
    p->x = axis_of(p, true), p->y = axis_of(p, false);
    const double left = LEFT, bottom = HEIGHT - BOTTOM, band = ZERO_BAND;
    p->x.from = left + p->x.has_zero * band, p->x.to = WIDTH - RIGHT, p->x.zero = left + band / 2;
    p->y.from = bottom - p->y.has_zero * band, p->y.to = TOP, p->y.zero = bottom - band / 2;
}

static void put_tick(const Plot *p, bool is_x, double at, const char *label)
{
    if (is_x)
        fprintf(p->file, "<path class=\"grid\" d=\"M%.1f %dV%d\"/>"
                "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%s</text>\n",
                at, TOP, HEIGHT - BOTTOM, at, HEIGHT - BOTTOM + 16, label);
    else
        fprintf(p->file, "<path class=\"grid\" d=\"M%d %.1fH%d\"/>"
                "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n",
                LEFT, at, WIDTH - RIGHT, LEFT - 6, at + 4, label);
}

static const char *power_of_ten(Arena *a, int e, bool is_among_others)
{
    if (is_among_others || (e >= -2 && e <= 4)) return arena_printf(a, "%g", pow(10, e));
    return arena_printf(a, "10<tspan dy=\"-5\" font-size=\"9\">%d</tspan>", e);
}

/* Every decade, or every so many that eight labels do; within less than two decades also 2 and 5, within one all. */
static void put_ticks(const Plot *p, bool is_x)
{
    const Axis *a = is_x ? &p->x : &p->y;
    int step = (int)ceil((a->hi - a->lo) / 8);
    for (int e = (int)floor(a->lo); e <= (int)ceil(a->hi); e++) {
        for (int k = 1; k <= 9; k++) {
            double v = k * pow(10, e);
            bool is_wanted = k == 1 ? e % step == 0 : a->hi - a->lo < 1 || (a->hi - a->lo < 2 && (k == 2 || k == 5));
            if (!is_wanted || log10(v) < a->lo || log10(v) > a->hi) continue;
            const char *label = k == 1 ? power_of_ten(p->arena, e, a->hi - a->lo < 2) : arena_printf(p->arena, "%g", v);
            put_tick(p, is_x, place(a, v), label);
        }
    }
    if (a->has_zero) put_tick(p, is_x, a->zero, "0");
}

static void put_titles(const Plot *p, const ReportPlot *what)
{
    fprintf(p->file, "<text class=\"title\" x=\"%d\" y=\"18\">%s</text>\n", LEFT, what->title);
    fprintf(p->file, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text>\n", (LEFT + WIDTH) / 2, HEIGHT - 10,
            what->x_title);
    fprintf(p->file, "<text transform=\"translate(14 %d) rotate(-90)\" text-anchor=\"middle\">%s</text>\n", HEIGHT / 2,
            what->y_title);
    fprintf(p->file, "<path class=\"frame\" d=\"M%d %dV%dH%d\"/>\n", LEFT, TOP, HEIGHT - BOTTOM, WIDTH - RIGHT);
}

/* ---- points ---- */

static void take_points(Plot *p, const Report *r, const ReportScene *scene, const ReportPlot *what)
{
    p->points = ARENA_ARRAY(p->arena, Point, r->n_samples + 1);
    for (size_t i = 0; i < r->n_samples; i++) {
        const ReportSample *s = &r->samples[i];
        double x = s->number[what->x], y = s->number[what->y];
        if (s->scene == scene && s->is_done && !s->failure && isfinite(x) && isfinite(y))
            p->points[p->n++] = (Point){ x, y, s, true };
    }
    for (size_t i = 0; i < p->n; i++)
        for (size_t j = 0; j < p->n; j++) {
            const Point *a = &p->points[i], *b = &p->points[j];
            if (b->x <= a->x && b->y <= a->y && (b->x < a->x || b->y < a->y)) p->points[i].is_best = false;
        }
}

static int by_x(const void *a, const void *b)
{
    const Point *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

/* What no other setting is both faster and better than, joined by steps: on or above them lies all that was measured. */
static void put_front(const Plot *p)
{
    Point *best = ARENA_ARRAY(p->arena, Point, p->n + 1);
    size_t n = 0;
    for (size_t i = 0; i < p->n; i++)
        if (p->points[i].is_best) best[n++] = p->points[i];
    if (n == 0) return;
    qsort(best, n, sizeof *best, by_x);
    fprintf(p->file, "<path class=\"front\" d=\"M%.1f %d", place(&p->x, best[0].x), TOP);
    for (size_t i = 0; i < n; i++)
        fprintf(p->file, "H%.1fV%.1f", place(&p->x, best[i].x), place(&p->y, best[i].y));
    fprintf(p->file, "H%d\"/>\n", WIDTH - RIGHT);
}

static void put_point(const Plot *p, const Point *at, const ReportPlot *what)
{
    double x = place(&p->x, at->x), y = place(&p->y, at->y);
    const double *n = at->sample->number;
    bool is_default = n[REPORT_IS_DEFAULT] == 1;
    int series = at->sample->series;
    if (at->is_best) fprintf(p->file, "<circle class=\"ring s%d\" cx=\"%.1f\" cy=\"%.1f\" r=\"8\"/>\n", series, x, y);
    fprintf(p->file, "<circle class=\"dot point s%d\" tabindex=\"0\" cx=\"%.1f\" cy=\"%.1f\" r=\"%g\"><title>%s%s\n",
            series, x, y, is_default ? 5.5 : 4., report_sample_name(p->arena, at->sample), is_default ? " (default)" : "");
    fprintf(p->file, "%s %.3g\n%s %.3g\nrun time %.3g s (%.3g to %.3g)</title></circle>\n", what->y_title, at->y,
            what->x_title, at->x, n[REPORT_TOTAL], n[REPORT_TOTAL_LEAST], n[REPORT_TOTAL_MOST]);
}

static void put_series(const Plot *p, int series, const ReportPlot *what)
{
    const char *join = "M";
    fprintf(p->file, "<path class=\"line s%d\" d=\"", series);
    for (size_t i = 0; i < p->n; i++) {
        const Point *at = &p->points[i];
        if ((int)at->sample->series != series) continue;
        fprintf(p->file, "%s%.1f %.1f", join, place(&p->x, at->x), place(&p->y, at->y));
        join = "L";
    }
    fputs("\"/>\n", p->file);
    for (size_t i = 0; i < p->n; i++)
        if ((int)p->points[i].sample->series == series) put_point(p, &p->points[i], what);
}

static void put_style(FILE *f)
{
    fputs("<style>\n", f);
    for (const char *const *line = report_style; *line; line++) fprintf(f, "%s\n", *line);
    fputs("</style>\n", f);
}

/* On the page the legend stands above all plots. */
static void put_names(const Plot *p)
{
    int x = LEFT / 4;
    for (int k = 0; k < REPORT_N_SERIES; k++) {
        bool is_there = false;
        for (size_t i = 0; i < p->n; i++) is_there |= (int)p->points[i].sample->series == k;
        if (!is_there) continue;
        fprintf(p->file, "<circle class=\"dot s%d\" cx=\"%d\" cy=\"%d\" r=\"4\"/><text x=\"%d\" y=\"%d\">%s</text>\n", k, x,
                HEIGHT + 6, x + 9, HEIGHT + 10, report_methods[k].title);
        x += 28 + 13 * (int)strlen(report_methods[k].title) / 2;    /* a letter is some 6.5 wide */
    }
}

void report_plot(FILE *f, const Report *r, const ReportScene *s, const ReportPlot *what, bool is_file)
{
    Plot p = { .file = f, .arena = r->arena };
    take_points(&p, r, s, what);
    place_axes(&p);
    int height = HEIGHT + (is_file ? NAMES : 0);
    const char *space = is_file ? " xmlns=\"http://www.w3.org/2000/svg\"" : "";
    fprintf(f, "<svg%s class=\"plot\" data-x=\"%s\" data-y=\"%s\" viewBox=\"0 0 %d %d\" role=\"img\""
            " aria-label=\"%s\">\n", space, report_columns[what->x].name, report_columns[what->y].name, WIDTH, height,
            what->title);
    if (is_file) put_style(f);
    put_ticks(&p, true);
    put_ticks(&p, false);
    put_titles(&p, what);
    put_front(&p);
    for (int k = 0; k < REPORT_N_SERIES; k++) put_series(&p, k, what);
    if (is_file) put_names(&p);
    fputs("</svg>\n", f);
}
