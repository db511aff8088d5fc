/* See pole_cone.h.
 *
 * Let X be the pole, c the vectors w (P - X) of the tile's net, those of the side itself left out: they are within the
 * rounding of 0. A chord S - X is a sum of c with positive factors, over the weight. If a.c >= k |c| for all of them, the
 * sum obeys that, too.
 *
 * Let X be within the rounding r of the ray, in either plane, at the depth D. What errs, in roundings: the pole is within
 * sqrt 2 of the ray in these, whose own error is 1, and that of D is 1, in all less than 4; the points of the side are
 * within 2 of X as the patch has them, and that is within 1 of the surface. The net's own error and what is rounded here
 * (X, c, the distances within the side: 8 u of the radius) are less than 7, since r is at least u (n + 32) of the radius,
 * n >= 3 (k_u + k_v - 2), and tile_net_error 18 u (k_u + k_v - 2). So for a root at D + T there is a chord x with
 * |x - T d| <= e = 14 r, hence T a.d + |a| e >= a.x >= k |x| >= k (|T| - e), and |T| <= (k + |a|) e / (k -+ a.d), with - for
 * T > 0 and + for T < 0. With k -+ a.d > ROOM all roots on that side are within 2 e / ROOM of the pole: they are the pole,
 * as far as can be told. */
#include "nurbs/pole_cone.h"

#include "nurbs/pole.h"

#include <math.h>

/* Half of that is 14 degrees beside the cone: of a ray nearer to it the pole is not told from the tile at once. */
#define ROOM 0x1p-4

/* D and the depth of the same pole as another patch has it are each within one rounding. */
#define SAME_DEPTH 2

/* More than the rounding of the axis and of a cosine, to and in single precision. */
#define COSINE_ERROR 0x1p-20

/* Vectors from the pole to the points of the net that are not of its side, times the weight. Returns how many. */
static int chords_from(const Patch *p, const Vec4 *net, PoleSide side, Vec3 pole, Vec3 *out)
{
    int n = 0, last = side.is_t ? p->k_v - 1 : p->k_u - 1;
    for (int j = 0; j < p->k_v; j++)
        for (int i = 0; i < p->k_u; i++) {
            if ((side.is_t ? j : i) == (side.is_end ? last : 0)) continue;
            Vec4 c = patch_point_about(net[j * p->k_u + i], pole);
            out[n++] = vec(c.x, c.y, c.z);
        }
    return n;
}

bool pole_cone_make(const Patch *p, TilePlace place, const Vec4 *net, PoleCone *out)
{
    PoleSide side;
    if (pole_sides(p, place, &side) != 1) return false;
    Vec3 chords[NURBS_MAX_ORDER * NURBS_MAX_ORDER], sum = { 0, 0, 0 };
    out->pole = pole_of(p, side);
    int n = chords_from(p, net, side, out->pole, chords);
    for (int i = 0; i < n; i++) sum = vec_add(sum, vec_normalize(chords[i]));
    Vec3 axis = vec_normalize(sum);
    out->axis[0] = (float)axis.x, out->axis[1] = (float)axis.y, out->axis[2] = (float)axis.z;
    double cosine = 1;
    for (int i = 0; i < n; i++) cosine = double_min(cosine, vec_dot(axis, chords[i]) / vec_length(chords[i]));
    out->cosine = (float)(cosine - COSINE_ERROR);
    return cosine > 0;
}

bool pole_cone_is_out_of_reach(const PoleCone *cone, const Patch *p, const PatchRay *r)
{
    Vec3 o = vec_sub(r->origin, p->origin), pole = vec_sub(cone->pole, o);
    double depth = vec_dot(r->d, pole), rounding = patch_rounding(p, o), towards = vec_dot(tile_vec(cone->axis), r->d);
    bool is_met = fabs(vec_dot(r->n1, pole)) <= rounding && fabs(vec_dot(r->n2, pole)) <= rounding;
    bool is_behind = depth > r->t_max - SAME_DEPTH * rounding && cone->cosine + towards > ROOM;
    bool is_before = depth < r->t_min && cone->cosine - towards > ROOM;
    return is_met && (is_behind || is_before);
}
