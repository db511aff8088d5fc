/* See judge.h. */
#include "tests/stress/judge.h"

#include "render/bunch.h"
#include "render/hit_list.h"

#include <string.h>
#include <time.h>

const char *const judgement_name[JUDGEMENTS] = { "right", "in the band", "missed", "false", "inexact", "not all hits once" };

void row_add(Row *to, const Row *from)
{
    to->rays += from->rays, to->hits += from->hits, to->in_band += from->in_band, to->missed += from->missed;
    to->false_hits += from->false_hits, to->inexact += from->inexact;
    to->asked += from->asked, to->not_once += from->not_once;
    to->tests += from->tests, to->fallbacks += from->fallbacks, to->seconds += from->seconds;
    to->worst = fmax(to->worst, from->worst), to->slowest = fmax(to->slowest, from->slowest);
}

/* The first root that a ray must meet; truth->n: none. Roots about t_min need not count. */
static int first_must(const Truth *truth, const Ray *r, long double slack)
{
    int i = 0;
    while (i < truth->n && !(truth->root[i].is_must && truth->root[i].lo - slack > r->t_min)) i++;
    return i;
}

/* May root i come before the first that must be met, or be it? (Clusters overlap others.) */
static bool is_before(const Truth *truth, int first, int i)
{
    return i <= first || (first < truth->n && truth->root[i].lo <= truth->root[first].hi);
}

static long double distance_to(const TruthRoot *x, long double t) { return fmaxl(0, fmaxl(x->lo - t, t - x->hi)); }

/* Which root the hit may be, of those up to the first that must be met: the nearest, and that one if two are as near; -1:
 * none is within the slack. */
static int root_of(const Truth *truth, int first, long double t, long double slack)
{
    int found = -1;
    for (int i = 0; i < truth->n; i++) {
        long double d = distance_to(&truth->root[i], t), least = found < 0 ? slack : distance_to(&truth->root[found], t);
        if (is_before(truth, first, i) && (found < 0 || i == first ? d <= least : d < least)) found = i;
    }
    return found;
}

/* Is there a root after t_min that may or may not be met, before the first that must be? */
static bool is_open(const Truth *truth, int first, const Ray *r, long double slack)
{
    for (int i = 0; i < truth->n; i++)
        if (i != first && is_before(truth, first, i) && truth->root[i].hi + slack > r->t_min) return true;
    return false;
}

static Judgement judge(const Truth *truth, const Ray *r, bool is_hit, double t, Row *row)
{
    long double slack = TRUTH_ERROR * truth->length;
    int first = first_must(truth, r, slack);
    bool must = first < truth->n, open = is_open(truth, first, r, slack);
    if (!is_hit) return must ? JUDGED_MISSED : open ? JUDGED_IN_BAND : JUDGED_RIGHT;
    int i = root_of(truth, first, t, slack);
    bool is_near = i >= 0 || (i = root_of(truth, first, t, JUDGE_NEAR * truth->length)) >= 0;
    if (!is_near) return must && t > truth->root[first].hi ? JUDGED_MISSED : JUDGED_FALSE;
    const TruthRoot *root = &truth->root[i];
    bool is_exact = fabsl(t - root->t) <= slack, is_in = root->lo <= t && t <= root->hi;
    bool is_told = i == first && is_exact && root->hi - root->lo <= 2 * slack;
    if ((is_exact || is_in) && !is_told) return JUDGED_IN_BAND;
    row->worst = fmax(row->worst, (double)(fabsl(t - root->t) / truth->length));
    return is_told ? JUDGED_RIGHT : JUDGED_INEXACT;
}

/* Is each sure root among all hits once (an odd number of times, where roots are too near to each other to tell), and is
 * nothing there but roots? */
static bool has_all_once(Shape *s, const Ray *r, const Truth *truth, Trace *trace)
{
    long double slack = TRUTH_ERROR * truth->length;
    ArenaMark mark = arena_mark(trace->scratch);
    HitList list = hit_list_make(trace->scratch, INFINITY);
    shape_all_hits(s, r, &list, trace);
    int count[TRUTH_MAX] = { 0 };
    bool is_right = true, is_crowded = false;
    for (size_t h = 0; h < list.n; h++) {
        int found = -1;
        for (int i = 0; i < truth->n; i++) {
            if (!(truth->root[i].lo - slack <= list.hits[h].t && list.hits[h].t <= truth->root[i].hi + slack)) continue;
            is_crowded |= found >= 0;   /* between two roots: which one it is cannot be told */
            found = i;
        }
        if (found >= 0) count[found]++;
        is_right = is_right && found >= 0;
    }
    for (int i = 0; i < truth->n && !is_crowded; i++) {
        const TruthRoot *root = &truth->root[i];
        if (!truth_is_sure(root) || !(root->lo - slack > r->t_min)) continue;
        bool is_narrow = root->hi - root->lo <= 2 * slack;
        is_right = is_right && (is_narrow ? count[i] == 1 : count[i] % 2 == 1);
    }
    arena_reset(trace->scratch, mark);
    return is_right;
}

static bool is_normal(const Shape *s, const Ray *r, const Hit *h)
{
    Attributes a;
    s->type->attributes(s, r, h, &a);
    return fabs(vec_length(a.normal) - 1) < 1e-9;   /* not NaN, not zero */
}

static double cpu_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What asking for the time takes. */
static double clock_overhead(void)
{
    static double overhead;
    if (overhead > 0) return overhead;
    double begin = cpu_now();
    for (int i = 0; i < 1000; i++) (void)cpu_now();
    return overhead = (cpu_now() - begin) / 1001;
}

/* What a shape says of a ray; `blocks` knows no more than that there is a hit. */
typedef struct { Hit hit; bool is_hit, blocks; } Answer;

static Judgement judge_answer(const Shape *s, const Ray *r, const Truth *truth, const Answer *a, Row *row)
{
    Row ignored = { 0 };
    Judgement j = judge(truth, r, a->is_hit, a->hit.t, row);
    if (j > JUDGED_IN_BAND) return j;
    if (!a->blocks && judge(truth, r, false, 0, &ignored) == JUDGED_MISSED) return JUDGED_MISSED;
    if (a->blocks && !a->is_hit && j == JUDGED_RIGHT) return JUDGED_FALSE;
    return a->is_hit && !is_normal(s, r, &a->hit) ? JUDGED_INEXACT : j;
}

/* The ray is in every lane but those of its neighbours, in some of them with a longer or shorter direction. */
static void fill_bunch(RayBunch *b, const Ray *r, const Ray beside[], double scale[])
{
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        int k = i % (JUDGE_BESIDE + 1);
        scale[i] = ldexp(1, 2 * i);
        b->ray[i] = k ? beside[k - 1] : (Ray){ r->origin, vec_scale(r->dir, scale[i]), r->t_min / scale[i] };
    }
    b->n = BUNCH_WIDTH;
    bunch_set_lanes(b);
}

/* The worst of what is said of the ray's lanes. */
static Judgement judge_in_bunch(const Shape *s, const Ray *r, const Truth *truth, const Ray beside[], Trace *trace)
{
    RayBunch b;
    BunchLane lane[BUNCH_WIDTH];
    Hit best[BUNCH_WIDTH];
    double t_max[BUNCH_WIDTH], scale[BUNCH_WIDTH];
    Judgement worst = JUDGED_RIGHT;
    Row ignored = { 0 };
    b.lane = lane;
    fill_bunch(&b, r, beside, scale);
    for (int i = 0; i < BUNCH_WIDTH; i++) {
        lane[i] = (BunchLane){ .seed = trace->seed + (uint64_t)i };
        best[i] = (Hit){ .t = INFINITY }, t_max[i] = INFINITY;
    }
    Lanes hit = shape_hit_bunch(s, &b, bunch_all(&b), best, trace);
    for (int i = 0; i < BUNCH_WIDTH; i++) lane[i].root = (RayRoot){ 0 };
    Lanes blocked = shape_blocks_bunch(s, &b, bunch_all(&b), t_max, trace);
    for (int i = 0; i < BUNCH_WIDTH; i += JUDGE_BESIDE + 1) {
        Answer a = { best[i], hit >> i & 1, blocked >> i & 1 };
        a.hit.t *= scale[i], a.hit.t_error *= scale[i];
        Judgement j = judge_answer(s, r, truth, &a, &ignored);
        if (j > worst) worst = j;
    }
    return worst;
}

static void count(Row *row, const Verdict *v)
{
    row->rays++, row->hits += v->is_hit;
    row->in_band += v->judgement == JUDGED_IN_BAND, row->missed += v->judgement == JUDGED_MISSED;
    row->false_hits += v->judgement == JUDGED_FALSE, row->inexact += v->judgement == JUDGED_INEXACT;
    row->not_once += v->judgement == JUDGED_NOT_ONCE;
}

Verdict judge_ray(const Model *m, int method, const Ray *r, const Truth *truth, const Ray beside[], bool wants_all,
                  Trace *trace, Row *row)
{
    Shape *s = m->shape[method];
    Answer a = { .hit.t = INFINITY };
    shape_prepare(s, trace);
    Counters before = trace->counters;
    double overhead = clock_overhead(), begin = cpu_now();
    a.is_hit = shape_hit(s, r, &a.hit, trace);
    double seconds = fmax(0, cpu_now() - begin - overhead);
    row->seconds += seconds, row->slowest = fmax(row->slowest, seconds);
    row->tests += trace->counters.leaf_tests - before.leaf_tests;
    row->fallbacks += trace->counters.fallbacks - before.fallbacks;
    a.blocks = shape_blocks(s, r, INFINITY, trace);
    Verdict v = { judge_answer(s, r, truth, &a, row), a.is_hit, a.hit.t, a.hit.u, a.hit.v, seconds };
    if (s->type->hit_bunch && v.judgement <= JUDGED_IN_BAND) {
        Judgement in_bunch = judge_in_bunch(s, r, truth, beside, trace);
        if (in_bunch > v.judgement) v.judgement = in_bunch;
    }
    if (wants_all && v.judgement <= JUDGED_IN_BAND && s->type->all_hits) {
        row->asked++;
        if (!has_all_once(s, r, truth, trace)) v.judgement = JUDGED_NOT_ONCE;
    }
    count(row, &v);
    return v;
}

static void report_numbers(FILE *to, const char *name, const double *x, int n)
{
    fprintf(to, "static const double %s[] = {", name);
    for (int i = 0; i < n; i++) fprintf(to, "%s %a", i ? "," : "", x[i]);
    fprintf(to, " };\n");
}

static void report_all_hits(FILE *to, const Model *m, const Ray *r)
{
    Trace trace;
    memset(&trace, 0, sizeof trace);
    trace.scratch = arena_new();
    HitList list = hit_list_make(trace.scratch, INFINITY);
    shape_all_hits(m->shape[NURBS_METHOD_CERTAIN], r, &list, &trace);
    for (size_t i = 0; i < list.n && i < 20; i++)
        fprintf(to, "   all hits: t %.17g +- %.3g at (%.17g, %.17g)\n", list.hits[i].t, list.hits[i].t_error, list.hits[i].u,
                list.hits[i].v);
    arena_free(trace.scratch);
}

void judge_report(FILE *to, const Model *m, const Ray *r, const Truth *truth, Verdict v)
{
    const SurfaceDesc *d = &m->desc;
    fprintf(to, "/* %s: %s; t %.17g at (%.17g, %.17g), %.0f us\n", m->at.form.name, judgement_name[v.judgement],
            v.is_hit ? v.t : INFINITY, v.u, v.v, 1e6 * v.seconds);
    fprintf(to, "   the truth (errors relative to %.3Lg; band %.3g, %d trims):\n", truth->length, truth_band(&m->at, r),
            d->n_trims);
    for (int i = 0; i < truth->n; i++) {
        const TruthRoot *root = &truth->root[i];
        fprintf(to, "   t %.20Lg  -%.3Lg +%.3Lg  %s%s%s\n", root->t, root->t - root->lo, root->hi - root->t,
                root->is_odd ? "odd" : "even", root->is_inside ? "" : ", at the border", root->is_must ? ", a must" : "");
    }
    if (v.judgement == JUDGED_NOT_ONCE) report_all_hits(to, m, r);
    fprintf(to, "*/\n");
    report_numbers(to, "knots_u", d->knots_u, d->n_u + d->order_u);
    report_numbers(to, "knots_v", d->knots_v, d->n_v + d->order_v);
    fprintf(to, "static const Vec4 points[] = {\n");
    for (int i = 0; i < d->n_u * d->n_v; i++)
        fprintf(to, "    { %a, %a, %a, %a },\n", d->points[i].x, d->points[i].y, d->points[i].z, d->points[i].w);
    fprintf(to, "};\nstatic const SurfaceDesc desc = { .order_u = %d, .order_v = %d, .n_u = %d, .n_v = %d,\n"
            "    .knots_u = knots_u, .knots_v = knots_v, .points = points };\n", d->order_u, d->order_v, d->n_u, d->n_v);
    fprintf(to, "static const Ray ray = { { %a, %a, %a }, { %a, %a, %a }, %a };\n", r->origin.x, r->origin.y, r->origin.z,
            r->dir.x, r->dir.y, r->dir.z, r->t_min);
}
