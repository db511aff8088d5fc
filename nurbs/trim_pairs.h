/* Pairs of pieces that meet, of two chains or of one with itself. */
#ifndef TRIMRAY_TRIM_PAIRS_H
#define TRIMRAY_TRIM_PAIRS_H

#include "nurbs/trim_chain.h"

/* Calls visit for pairs of pieces (i of a, j of b) that meet, cross or touch, until it returns true; returns whether it did.
 * visit NULL: is there any such pair? With a == b: each pair i < j once, neighbours left out. Straight pieces only. */
typedef bool (*TrimPairVisit)(void *context, int i, int j);
bool trim_chains_meet(const TrimChain *a, const TrimChain *b, TrimPairVisit visit, void *context);

/* Certainly apart? With a == b: do pieces meet nowhere but at vertices that neighbours have in common, except by excursions
 * that stay within `near` of these? For any pieces; false only says that a closer look is due. */
bool trim_chains_are_apart(const TrimChain *a, const TrimChain *b, double near);

#endif
