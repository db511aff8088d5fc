/* The unit normal where S_u x S_v vanishes, or is lost in rounding: at poles, on collapsed sides, at cusps. */
#ifndef TRIMRAY_NORMAL_H
#define TRIMRAY_NORMAL_H

#include "render/vec.h"

/* S_u and S_v, each over the whole of a patch or leaf, on the way from a point (0) to the middle (1) of it. */
typedef struct { Vec3 along_u, along_v; } NormalTangents;
typedef NormalTangents (*NormalWay)(const void *context, double inwards);

/* S_u x S_v at the point; where it vanishes, its limit on the way inwards; where there is none (all of the patch is a curve,
 * or a point), the direction perpendicular to the curve that is nearest to `towards`. Always of length 1; towards need not
 * be, but it is not zero. `size` is that of the patch: tangents that are shorter by 2^-53 are rounding. */
Vec3 normal_limit(NormalWay way, const void *context, double size, Vec3 towards);

#endif
