/* Rays through a common point, a pencil: what of a tree each of them may meet is found once for all that are neighbours. */
#ifndef TRIMRAY_PENCIL_H
#define TRIMRAY_PENCIL_H

#include "render/bvh_collapse.h"

/* The pencils of one picture, shared by its threads: of trees that stay as they are meanwhile. */
Pencils *pencils_new(Viewpoint camera);
void pencils_free(Pencils *p);      /* NULL is allowed */

/* Fewer nodes are walked as soon as their children would be sorted out. */
#define PENCIL_LEAST_NODES 3

/* Where r enters the tree on its way from t->apex (which is its origin) or to it (before t_max): a node that has all that
 * it may meet, whose links go into the tree. NULL: it meets nothing. A ray that does not go through the apex enters at the
 * root. t->pencils and t->apex are there. */
const WideNode *pencil_entry(const WideBvh *tree, const Ray *r, double t_max, Trace *t);

#endif
