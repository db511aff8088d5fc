/* From a surface to the tree of its leaves ([MCFS00] sections 2.1, 2.2 and IsTrimmed of 3.1). */
#ifndef TRIMRAY_PREPARE_H
#define TRIMRAY_PREPARE_H

#include "nurbs/leaf.h"

/* Cuts the surface into leaves that tile the domain, drops those that are trimmed away, and builds the tree. Time and memory
 * are linear in the number of spans and leaves: one span is refined at a time, and nothing of the refined mesh is kept. The
 * result lies in `a`; `scratch` is left as it was. */
void prepare_leaves(Arena *a, Arena *scratch, const Surface *s, const NurbsOptions *o, LeafTree *out);

/* The Bézier patch over the non-empty spans mu_u and mu_v: k_u * k_v homogeneous points, u fastest. */
void prepare_close_span(const Surface *s, int mu_u, int mu_v, Vec4 *patch);

#endif
