/* Surfaces without a closed form, held against the oracle. See family.h. */
#include "tests/oracle.h"
#include "tests/stress/family.h"

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

enum { MAX_ROOTS = 64 };

static void roots_of_oracle(const Model *m, const Ray *r, double band, Truth *out)
{
    OracleRoot roots[MAX_ROOTS];
    int n = oracle_roots(m->own, r, band, roots, MAX_ROOTS);
    *out = (Truth){ .length = truth_length(&m->at, r) };
    for (int i = 0; i < n && i < MAX_ROOTS; i++) {
        const OracleRoot *x = &roots[i];
        long double t = (long double)x->t + x->t_tail, moves = x->t_moves + x->t_error;
        truth_add(out, (TruthRoot){ t, t - moves, t + moves, !x->is_cluster, x->is_sure, false });
    }
}

/* (The oracle takes the doubles as they are; the input's band serves to bound its work at tangencies.) */
static void truth_of_oracle(const Model *m, const Ray *r, Truth *out)
{
    roots_of_oracle(m, r, truth_band(&m->at, r), out);
    Truth by_input;
    bool is_in_doubt = truth_is_in_doubt(out);
    if (is_in_doubt) roots_of_oracle(m, r, truth_input_band(&m->at), &by_input);
    truth_note_musts(out, is_in_doubt ? &by_input : NULL);
}

static void release_oracle(Model *m) { oracle_free((Oracle *)m->own); }

static Model certified_at(Arena *a, const char *name, Net net, const QuadMap *place)
{
    Model m = model_new(a, (Form){ .name = name }, net);
    model_finish(&m, place, NULL, 0);
    m.own = oracle_new(&m.desc);
    m.truth = truth_of_oracle, m.release = release_oracle;
    return m;
}

static Model certified(Arena *a, const char *name, Net net, TestRandom *r)
{
    QuadMap place = model_rotation(r, 1);
    place.o = quad3_scale(random_direction(r), test_unit(r));
    return certified_at(a, name, net, &place);
}

static Quad4 weighted(double x, double y, double z, double w) { return (Quad4){ (Quad)x * w, (Quad)y * w, (Quad)z * w, w }; }

/* Clamped, with knots of any multiplicity below k. */
static Net net_of(Arena *a, int k_u, int n_u, int k_v, int n_v, TestRandom *r)
{
    Net n = { .k = { k_u, k_v }, .n = { n_u, n_v }, .p = ARENA_ARRAY(a, Quad4, n_u * n_v) };
    for (int axis = 0; axis < 2; axis++) {
        int k = n.k[axis], count = n.n[axis], run = 1;
        double *tau = n.knots[axis] = ARENA_ARRAY(a, double, count + k), t = 0;
        for (int i = 0; i < count + k; i++) {
            bool repeats = i > k && i < count && run < k - 1 && test_int(r, 0, 3) == 0;
            if (i >= k && i <= count && !repeats) t += test_range(r, .1, 1);
            run = repeats ? run + 1 : 1;
            tau[i] = t;
        }
    }
    return n;
}

/* A wavy sheet: a grid with random heights. */
static Net sheet(Arena *a, int k_u, int k_v, double height, double decades, TestRandom *r)
{
    int n_u = k_u + test_int(r, 0, 2), n_v = k_v + test_int(r, 0, 2);
    Net n = net_of(a, k_u, n_u, k_v, n_v, r);
    for (int j = 0; j < n_v; j++)
        for (int i = 0; i < n_u; i++) {
            double x = 2. * i / (n_u - 1) - 1, y = 2. * j / (n_v - 1) - 1;
            n.p[j * n_u + i] = weighted(x + test_range(r, -.2, .2), y + test_range(r, -.2, .2),
                                        height * test_range(r, -1, 1), pow(10, test_range(r, 0, decades)));
        }
    return n;
}

static Model build_weighted(Arena *a, double ratio, TestRandom *r)
{
    return certified(a, "weighted", sheet(a, test_int(r, 2, 5), test_int(r, 2, 5), 1, log10(ratio), r), r);
}

/* Control points anywhere: the surface folds and meets itself. */
static Model build_tangled(Arena *a, double order, TestRandom *r)
{
    int k = (int)order, k_v = test_int(r, 2, k);
    Net n = net_of(a, k, k + test_int(r, 0, 1), k_v, k_v + test_int(r, 0, 1), r);
    for (int i = 0; i < n.n[0] * n.n[1]; i++)
        n.p[i] = weighted(test_range(r, -1, 1), test_range(r, -1, 1), test_range(r, -1, 1), 1);
    return certified(a, "tangled", n, r);
}

static Quad4 beside(Quad4 p, double gap, TestRandom *r)
{
    Quad dx = gap * test_range(r, -1, 1), dy = gap * test_range(r, -1, 1), dz = gap * test_range(r, -1, 1);
    return (Quad4){ p.x + dx, p.y + dy, p.z + dz, 1 };
}

/* A sheet two of whose rows nearly meet, and lie nearly on the next: a bend that stiff. */
static Model build_crease(Arena *a, double gap, TestRandom *r)
{
    Net n = sheet(a, test_int(r, 3, 5), test_int(r, 3, 5), 1, 0, r);
    int row = test_int(r, 0, n.n[1] - 3);
    for (int i = 0; i < n.n[0]; i++)
        for (int m = 1; m < 3; m++) {
            Quad4 *p = &n.p[(row + m) * n.n[0] + i], q = p[-n.n[0]];
            *p = beside(q, gap, r);
        }
    return certified(a, "crease", n, r);
}

/* Parts of the net shrink to points, lines or so nearly. */
static Model build_collapsed(Arena *a, double gap, TestRandom *r)
{
    Net n = sheet(a, test_int(r, 2, 4), test_int(r, 2, 4), 1, 0, r);
    int what = test_int(r, 0, 3);
    for (int j = 0; j < n.n[1]; j++)
        for (int i = 0; i < n.n[0]; i++) {
            bool is_in = what == 0 ? j == 0 : what == 1 ? true : what == 2 ? i == 0 || j == 0 : false;
            Quad4 *p = &n.p[j * n.n[0] + i], q = what == 3 ? n.p[i] : n.p[0];   /* 3: every row the same */
            if (what == 3 ? j == 0 : !is_in) continue;
            *p = beside(q, gap, r);
        }
    return certified(a, "collapsed", n, r);
}

/* Squeezed along its width, or its height. */
static Model build_squeezed(Arena *a, double aspect, TestRandom *r)
{
    Net n = sheet(a, test_int(r, 2, 4), test_int(r, 2, 4), 1, 1, r);
    QuadMap place = model_rotation(r, 1);
    if (test_int(r, 0, 1)) place.x = quad3_scale(place.x, 1 / (Quad)aspect);
    else place.z = quad3_scale(place.z, 1 / (Quad)aspect);
    return certified_at(a, "squeezed", n, &place);
}

/* Far from the origin, in its sizes. */
static Model build_far_off(Arena *a, double distance, TestRandom *r)
{
    QuadMap place = model_rotation(r, 1);
    place.o = quad3_scale(random_direction(r), distance);
    return certified_at(a, "far off", sheet(a, test_int(r, 2, 4), test_int(r, 2, 4), 1, 1, r), &place);
}

static Model build_sheet(Arena *a, double by, TestRandom *r)
{
    (void)by;
    return certified(a, "sheet", sheet(a, test_int(r, 3, 4), test_int(r, 3, 4), 1, test_int(r, 0, 1), r), r);
}

/* Beside a tangent, `by` sizes above or below the surface. */
static Ray ray_grazing(const Model *m, double by, TestRandom *r)
{
    const Net *n = &m->plain;
    double u = n->knots[0][n->n[0]] * test_range(r, .01, .99), v = n->knots[1][n->n[1]] * test_range(r, .01, .99);
    double step = 1e-9;
    Quad3 p = net_point(n, u, v);
    Quad3 s_u = quad3_sub(net_point(n, u + step, v), p), s_v = quad3_sub(net_point(n, u, v + step), p);
    Quad3 normal = quad3_cross(s_u, s_v), tangent = quad3_add(quad3_scale(s_u, test_range(r, -1, 1)),
                                                              quad3_scale(s_v, test_range(r, -1, 1)));
    normal = quad3_scale(normal, by * m->size * (2 * test_int(r, 0, 1) - 1) / quad3_length(normal));
    return ray_towards(m, quad3_add(p, normal), tangent, pow(10, test_range(r, -.5, 1)), r);
}

const Family stress_certified[] = {
    { "weighted", "ratio of the weights", 5, { 1, 1e3, 1e6, 1e9, 1e12 }, build_weighted, ray_anywhere, .4 },
    { "tangled", "order", 5, { 2, 3, 4, 6, 8 }, build_tangled, ray_anywhere, .2 },
    { "squeezed", "aspect", 5, { 1, 1e2, 1e4, 1e6, 1e8 }, build_squeezed, ray_anywhere, .3 },
    { "far off", "distance from the origin", 4, { 1e2, 1e4, 1e6, 1e8 }, build_far_off, ray_anywhere, .3 },
    { "crease", "gap", 5, { 1e-1, 1e-3, 1e-6, 1e-8, 0 }, build_crease, ray_anywhere, .4 },
    { "collapsed", "gap", 5, { 1e-1, 1e-4, 1e-8, 1e-12, 0 }, build_collapsed, ray_anywhere, .1 },
    { "tangent", "distance", 9, { 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 0 }, build_sheet, ray_grazing, .1 },
};
const int n_stress_certified = COUNT(stress_certified);
