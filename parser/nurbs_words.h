/* What the NURBS library says is wrong, in words and with a place: the library knows neither. */
#ifndef TRIMRAY_NURBS_WORDS_H
#define TRIMRAY_NURBS_WORDS_H

#include "parser/state.h"

/* Where the parts of a surface stand in the scene; a NULL list: its parts have no places of their own. */
typedef struct {
    Place word;                   /* `curve`, or `trim` for a polyline */
    const Place *knots;           /* of each number */
} CurvePlaces;

typedef struct {
    Place word;                   /* `trim` */
    const CurvePlaces *curves;
} TrimPlaces;

typedef struct {
    Place word, order, points;    /* `trimmed_nurbs`, `order`, `points` */
    const Place *knots_u, *knots_v;
    const TrimPlaces *trims;
} SurfacePlaces;

void nurbs_report_error(Parser *p, const SurfaceDesc *d, const SurfacePlaces *places, const NurbsError *e);
void nurbs_report_warning(Parser *p, const SurfacePlaces *places, const NurbsWarning *w);

#endif
