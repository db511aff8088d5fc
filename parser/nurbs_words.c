#include "parser/nurbs_words.h"

/* ---- where ---- */

static Place trim_place(const SurfacePlaces *places, int trim)
{
    return places->trims && trim >= 0 ? places->trims[trim].word : places->word;
}

static Place curve_place(const SurfacePlaces *places, int trim, int curve)
{
    if (!places->trims || trim < 0 || curve < 0) return trim_place(places, trim);
    return places->trims[trim].curves[curve].word;
}

static Place knot_place(const SurfacePlaces *places, const NurbsError *e, int i)
{
    const Place *knots = NULL;
    if (e->where == NURBS_IN_SURFACE_U) knots = places->knots_u;
    if (e->where == NURBS_IN_SURFACE_V) knots = places->knots_v;
    if (e->where == NURBS_IN_TRIM && places->trims && e->curve >= 0)
        knots = places->trims[e->trim].curves[e->curve].knots;
    if (knots) return knots[i];
    return e->where == NURBS_IN_TRIM ? curve_place(places, e->trim, e->curve) : places->word;
}

static Place points_place(const SurfacePlaces *places, const NurbsError *e)
{
    return e->where == NURBS_IN_TRIM ? curve_place(places, e->trim, e->curve) : places->points;
}

/* ---- what ---- */

/* The direction of a surface, or the curve of a trim, that an error is about. */
typedef struct {
    const char *knots_name;
    int order, n_points;
    const double *knots;
} Direction;

static Direction direction_of(const SurfaceDesc *d, const NurbsError *e)
{
    if (e->where == NURBS_IN_TRIM && e->trim >= 0 && e->curve >= 0) {
        const TrimCurveDesc *c = &d->trims[e->trim].curves[e->curve];
        return (Direction){ "knots", c->order, c->n, c->knots };
    }
    if (e->where == NURBS_IN_SURFACE_V) return (Direction){ "knots_v", d->order_v, d->n_v, d->knots_v };
    return (Direction){ "knots_u", d->order_u, d->n_u, d->knots_u };
}

static int count_equal(const Direction *d, int i)
{
    int n = 0;
    for (int j = 0; j < d->n_points + d->order; j++) n += d->knots[j] == d->knots[i];
    return n;
}

static int curves_of(const SurfaceDesc *d, int trim)
{
    return trim >= 0 && trim < d->n_trims ? d->trims[trim].n_curves : 1;
}

static void report_points_error(Parser *p, const SurfacePlaces *places, const NurbsError *e, const Direction *d)
{
    Place points = points_place(places, e);
    switch (e->code) {
    case NURBS_BAD_ORDER:
        parse_error(p, e->where == NURBS_IN_TRIM ? points : places->order, "expected an order of %d to %d, found %d",
                    NURBS_MIN_ORDER, NURBS_MAX_ORDER, d->order);
        break;
    case NURBS_TOO_FEW_POINTS:
        parse_error(p, points, "expected at least %d points (order %d), found %d", d->order, d->order, d->n_points);
        break;
    case NURBS_BAD_WEIGHT:
        parse_error(p, points, "expected positive, finite weights, found %g at point %d", e->value, e->index + 1);
        break;
    default: parse_error(p, points, "expected finite coordinates at point %d", e->index + 1);
    }
}

static void report_knot_error(Parser *p, const SurfacePlaces *places, const NurbsError *e, const Direction *d)
{
    if (e->code == NURBS_EMPTY_DOMAIN) {
        parse_error(p, knot_place(places, e, d->order - 1), "expected a domain in %s, found that it begins and ends at %g",
                    d->knots_name, d->knots[d->order - 1]);
        return;
    }
    Place where = knot_place(places, e, e->index);
    double knot = d->knots[e->index];
    if (e->code == NURBS_KNOTS_DECREASE)
        parse_error(p, where, "expected at least %g in %s, found %g", d->knots[e->index - 1], d->knots_name, knot);
    else if (e->code == NURBS_KNOT_NOT_FINITE)
        parse_error(p, where, "expected a finite number in %s, found %g", d->knots_name, knot);
    else
        parse_error(p, where, "expected %g at most %d times in %s (order %d), found it %d times", knot, e->other,
                    d->knots_name, d->order, count_equal(d, e->index));
}

static void report_open_trim(Parser *p, const SurfaceDesc *d, const SurfacePlaces *places, const NurbsError *e)
{
    int n = curves_of(d, e->trim), curve = e->other + 1, before = e->other > 0 ? e->other : n;
    parse_error(p, curve_place(places, e->trim, e->other),
                "expected curve %d to start where curve %d ends, found a gap of %g of the domain", curve, before, e->value);
}

static void report_trim_error(Parser *p, const SurfaceDesc *d, const SurfacePlaces *places, const NurbsError *e)
{
    Place where = trim_place(places, e->trim), other = trim_place(places, e->other);
    switch (e->code) {
    case NURBS_TRIM_TOO_SHORT: parse_error(p, where, "expected at least 3 points in a trim polyline"); break;
    case NURBS_TRIM_OPEN: report_open_trim(p, d, places, e); break;
    case NURBS_TRIM_OUTSIDE:
        parse_error(p, where, "expected trim %d inside the domain, found it at (u, v) = (%g, %g), %g of the domain outside",
                    e->trim + 1, e->u, e->v, e->value);
        break;
    case NURBS_TRIMS_CONFLICT:
        parse_error(p, where, "expected one direction of trims %d and %d (line %u), which stand side by side, found two",
                    e->index + 1, e->other + 1, other.line);
        break;
    default:
        if (e->index == e->other)
            parse_error(p, where, "trim %d crosses itself at (u, v) = (%g, %g)", e->index + 1, e->u, e->v);
        else
            parse_error(p, where, "trim %d crosses trim %d (line %u) at (u, v) = (%g, %g)", e->index + 1, e->other + 1,
                        other.line, e->u, e->v);
    }
}

void nurbs_report_error(Parser *p, const SurfaceDesc *d, const SurfacePlaces *places, const NurbsError *e)
{
    Direction direction = direction_of(d, e);
    switch (e->code) {
    case NURBS_OK: break;
    case NURBS_BAD_ORDER: case NURBS_TOO_FEW_POINTS: case NURBS_BAD_WEIGHT: case NURBS_POINT_NOT_FINITE:
        report_points_error(p, places, e, &direction);
        break;
    case NURBS_KNOTS_DECREASE: case NURBS_KNOT_NOT_FINITE: case NURBS_KNOT_MULTIPLICITY: case NURBS_EMPTY_DOMAIN:
        report_knot_error(p, places, e, &direction);
        break;
    case NURBS_TRIM_TOO_SHORT: case NURBS_TRIM_OPEN: case NURBS_TRIM_OUTSIDE: case NURBS_TRIMS_CROSS:
    case NURBS_TRIMS_CONFLICT:
        report_trim_error(p, d, places, e);
    }
}

static void report_crossing(Parser *p, const SurfacePlaces *places, const NurbsWarning *w)
{
    Place where = trim_place(places, w->trim);
    const char *rule = "inside is where the winding is not zero";
    if (w->trim == w->other)
        parse_warn(p, where, "trim %d crosses itself by %g of the domain at (u, v) = (%g, %g): %s", w->trim + 1, w->value,
                   w->u, w->v, rule);
    else
        parse_warn(p, where, "trim %d crosses trim %d (line %u) by %g of the domain at (u, v) = (%g, %g): %s", w->trim + 1,
                   w->other + 1, trim_place(places, w->other).line, w->value, w->u, w->v, rule);
}

void nurbs_report_warning(Parser *p, const SurfacePlaces *places, const NurbsWarning *w)
{
    Place where = trim_place(places, w->trim);
    switch (w->code) {
    case NURBS_WARN_TRIM_CLAMPED:
        parse_warn(p, where, "trim %d at (u, v) = (%g, %g) is %g of the domain outside: it is clamped", w->trim + 1, w->u,
                   w->v, w->value);
        break;
    case NURBS_WARN_TRIM_BRIDGED:
        parse_warn(p, where, "trim %d has a gap of %g of the domain at (u, v) = (%g, %g): a straight piece bridges it",
                   w->trim + 1, w->value, w->u, w->v);
        break;
    case NURBS_WARN_TRIM_CROSSING:
        report_crossing(p, places, w);
    }
}
