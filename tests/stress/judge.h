/* Shoots one ray by one method, and holds what it says against the truth. */
#ifndef TRIMRAY_STRESS_JUDGE_H
#define TRIMRAY_STRESS_JUDGE_H

#include "tests/stress/model.h"

#define JUDGE_NEAR 1e-6          /* of size and distance: so near to a root a wrong hit is an inexact one */

typedef struct {
    uint64_t rays, hits;
    uint64_t in_band;            /* the truth leaves it open, or holds t to the band only */
    uint64_t missed, false_hits; /* first hits; and what `blocks` says */
    uint64_t inexact;            /* hits on the right root (JUDGE_NEAR) whose t is wrong, or that have no normal */
    uint64_t asked, not_once;    /* all hits of so many rays: one missing, doubled, or where no root is; outside the band */
    double worst;                /* |t error| relative to size and distance, outside the band */
    uint64_t tests, fallbacks;
    double seconds, slowest;     /* of all rays, of one */
} Row;

void row_add(Row *to, const Row *from);

typedef enum {
    JUDGED_RIGHT, JUDGED_IN_BAND, JUDGED_MISSED, JUDGED_FALSE, JUDGED_INEXACT, JUDGED_NOT_ONCE, JUDGEMENTS
} Judgement;
extern const char *const judgement_name[JUDGEMENTS];

typedef struct { Judgement judgement; bool is_hit; double t, u, v, seconds; } Verdict;

/* Counts into row. wants_all: all hits are asked for, too. A method that answers bunches is asked again so, the ray going
 * with those of `beside`, JUDGE_BESIDE of any kind. */
enum { JUDGE_BESIDE = 2 };
Verdict judge_ray(const Model *m, int method, const Ray *r, const Truth *truth, const Ray beside[], bool wants_all,
                  Trace *trace, Row *row);

/* Writes surface, ray, truth and verdict as C literals. */
void judge_report(FILE *to, const Model *m, const Ray *r, const Truth *truth, Verdict v);

#endif
