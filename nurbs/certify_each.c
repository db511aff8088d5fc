/* Eight rays, each at a tile of its own, by the proofs of certify_lanes.h: what is known of the tiles is brought together in
 * lanes, and patches are evaluated one after the other, since they may be of any order. */
#include "nurbs/certify_bunch.h"

#include "nurbs/patch_bunch.h"

typedef const Tile *const *Tiles;      /* BUNCH_WIDTH of them */
typedef V8d Fact;
typedef Vec3x8 FactVec;
#define OF(tiles, f) \
    ((V8d){ f((tiles)[0]), f((tiles)[1]), f((tiles)[2]), f((tiles)[3]), f((tiles)[4]), f((tiles)[5]), f((tiles)[6]), \
            f((tiles)[7]) })
#define LANES(fact) (fact)
#define CROSS(a, b) vec8_cross(a, b)

ALWAYS_INLINE void begin_points(Tiles tiles, Lanes lanes, LanePoints *own)
{
    (void)tiles;
    set_no_points(lanes, own);
}

ALWAYS_INLINE PatchPoints evaluate_patches(Tiles tiles, Lanes lanes, V8d s, V8d t, LanePoints *own)
{
    while (lanes) {
        int i = lanes_next(&lanes);
        set_lane(own, i, kernel_evaluate(tiles[i]->patch, s[i], t[i]));
    }
    return points_in_lanes(own);
}

ALWAYS_INLINE const Tile *tile_of(Tiles tiles, int i) { return tiles[i]; }

#include "nurbs/certify_lanes.h"

EVERY_X86
Lanes tiles_roots_bunch(const Tile *const tiles[], const RayBunch *b, Lanes lanes, BunchLimits limits, Roots *out,
                        LanesLeft *left, Trace *trace)
{
    return find_roots(tiles, b, lanes, limits, out, left, trace);
}
