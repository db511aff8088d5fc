/* Eight rays at their tiles: the tests of certify.c in its order, and with its proofs; `Rays` are its Solve, lane by lane.
 *
 * The operations are the same, some in another order or fused, which the bounds allow for. Two are others:
 *   the ray's origin is taken from the numerator before the dot products, N.(H - w o) for N.H - w N.o: two roundings of |H|
 *   and w |o|, and those of one dot product, are fewer than rounding_share counts;
 *   where certify.c asks by how much rounding grows beyond the patch, here is the most that it does: a root that may be
 *   within that, and is not on the tile, is left to it.
 * A lane that is not a number passes no test: it is undecided, or has no root where certify.c finds none.
 *
 * Included by certify_bunch.c, whose rays meet the same tile, and by certify_each.c, where each has its own. They say before
 * what is known of tiles:
 *   Tiles             which they are
 *   Fact, FactVec     a number of each ray's tile, and a vector: double where it is the same for all, else in lanes
 *   OF(tiles, f)      the Fact that the function f has of a tile; LANES(fact) the same in lanes
 *   CROSS(a, b)       of two FactVecs
 *   evaluate_patches(tiles, lanes, s, t, own)
 *                     points of the patches. Where each ray's is computed by itself, only those of `lanes` are, and the others
 *                     stay what they were in `own`; begin_points(tiles, lanes, own) before sets those that never will be
 *   tile_of(tiles, i) ray i's */
#ifndef TRIMRAY_CERTIFY_LANES_H
#define TRIMRAY_CERTIFY_LANES_H

#include "nurbs/certify_proof.h"

#define LO (-TILE_MARGIN)
#define HI (1 + TILE_MARGIN)

/* What the proofs need to know of a tile and its patch: Fact is a number of all rays, or a lane for each. */
typedef struct {
    FactVec half_s, half_t;
    Fact length_s, length_t, deviation, turn, stretch, w_middle;
    Fact area, turn2, room, worth, least_det, gain, far, slopes;    /* see the functions that make them */
    Fact s0, t0, ds, dt, per_s, per_t;  /* its place */
    Fact rounding, rounding_share, radius, growth, growth_w;        /* of the patch; growth_w: times its w_max */
} Facts;

typedef struct {
    Tiles tiles;
    Facts of;
    const BunchFrames *f;
    Vec3x8 o;                           /* the rays' origins about the patch's */
    V8d t_min, t_max;                   /* along d */
    V8d q1, q2, rounding;
    V8d s, t;                           /* the iterates */
    PatchPoints last;                   /* evaluated there, as the rays see it: w F1, w F2, w depth, w */
    V8d det;                            /* of the Jacobian, */
    V8d c11, c12, c21, c22, c_det;      /* and the frame's */
    V8d gain, contraction, least_step2;
} Rays;

/* Of lanes and lanes, or of lanes and a FactVec. */
#define DOT(a, b) ((a).x * (b).x + (a).y * (b).y + (a).z * (b).z)
#define MINUS(a, b) ((Vec3x8){ (a).x - (b).x, (a).y - (b).y, (a).z - (b).z })

#define DEFINE_FACT(name, value) ALWAYS_INLINE double name(const Tile *f) { return value; }
#define DEFINE_FACT_VEC(name, x, y, z) \
    DEFINE_FACT(name##_x, x) DEFINE_FACT(name##_y, y) DEFINE_FACT(name##_z, z)
#define VEC_OF(tiles, f) ((FactVec){ OF(tiles, f##_x), OF(tiles, f##_y), OF(tiles, f##_z) })

DEFINE_FACT_VEC(base, f->patch->base.x, f->patch->base.y, f->patch->base.z)
DEFINE_FACT_VEC(origin, f->patch->origin.x, f->patch->origin.y, f->patch->origin.z)
DEFINE_FACT_VEC(middle, f->middle[0], f->middle[1], f->middle[2])
DEFINE_FACT_VEC(half_s, f->half_s[0], f->half_s[1], f->half_s[2])
DEFINE_FACT_VEC(half_t, f->half_t[0], f->half_t[1], f->half_t[2])
DEFINE_FACT(radius, f->radius)
DEFINE_FACT(patch_radius, f->patch->radius)
DEFINE_FACT(own_rounding, f->patch->rounding)
DEFINE_FACT(share_of_rounding, rounding_share(f->patch))
DEFINE_FACT(growth, f->patch->growth)
DEFINE_FACT(growth_w, (double)f->patch->growth * f->patch->w_max)
DEFINE_FACT(length_s, f->length_s)
DEFINE_FACT(length_t, f->length_t)
DEFINE_FACT(deviation, f->deviation)
DEFINE_FACT(turn, f->turn)
DEFINE_FACT(stretch, f->stretch)
DEFINE_FACT(w_middle, f->w_middle)
DEFINE_FACT(area, (double)f->sine * f->length_s * f->length_t)
DEFINE_FACT(turn2, (double)f->turn * f->turn)
DEFINE_FACT(room, double_max(CONTRACTION - f->stretch, 0))
DEFINE_FACT(worth, double_max(WORTH_HALVING - f->stretch, 0))
DEFINE_FACT(least_det, NO_ANGLE * f->length_s * f->length_t)
DEFINE_FACT(gain, M_SQRT2 * f->length_s * f->length_t)                          /* times the determinant */
DEFINE_FACT(far, BLURRED * 2 * f->w_middle * (M_SQRT2 + f->turn + f->stretch))
DEFINE_FACT(place_s, f->s0 * TILE_PLACE_UNIT)
DEFINE_FACT(place_t, f->t0 * TILE_PLACE_UNIT)
DEFINE_FACT(size_s, f->ds * TILE_PLACE_UNIT)
DEFINE_FACT(size_t_, f->dt * TILE_PLACE_UNIT)
DEFINE_FACT(per_s, 1 / size_s(f))
DEFINE_FACT(per_t, 1 / size_t_(f))
DEFINE_FACT(slopes, (f->patch->k_u - 1) * size_s(f) * f->length_t + (f->patch->k_v - 1) * size_t_(f) * f->length_s)

ALWAYS_INLINE V8d clamp(V8d x, double lo, double hi) { return v8d_min(v8d_max(x, v8d_splat(lo)), v8d_splat(hi)); }
ALWAYS_INLINE V8d above(V8d x, double least) { return v8d_max(x, v8d_splat(least)); }
/* How far x is from [0, 1]. */
ALWAYS_INLINE V8d past(V8d x) { return above(v8d_max(-x, x - 1), 0); }
ALWAYS_INLINE V8l beyond_margin(V8d x) { return v8d_less(x, v8d_splat(LO)) | v8d_less(v8d_splat(HI), x); }

/* ---- at sight ---- */

ALWAYS_INLINE V8d limits_of(BunchLimits l)
{
    const double *at = l.at;
    size_t n = l.step;
    return (V8d){ at[0], at[n], at[2 * n], at[3 * n], at[4 * n], at[5 * n], at[6 * n], at[7 * n] };
}

/* Lanes that pass by the tile's ball, or whose root, if they have one, is not on the tile: frame_test's two. Sets what the
 * certificate needs. */
ALWAYS_INLINE void set_up(Rays *k, const RayBunch *b, BunchLimits limits)
{
    const BunchFrames *f = k->f;
    k->o = MINUS(MINUS(b->origin, VEC_OF(k->tiles, base)), VEC_OF(k->tiles, origin));
    k->t_min = b->t_min * f->length, k->t_max = limits_of(limits) * f->length;
}

ALWAYS_INLINE V8l passes_ball(Rays *k)
{
    Facts *of = &k->of;
    Vec3x8 o = MINUS(k->o, VEC_OF(k->tiles, middle));
    k->q1 = vec8_dot(k->f->n1, o), k->q2 = vec8_dot(k->f->n2, o);
    of->rounding = OF(k->tiles, own_rounding), of->rounding_share = OF(k->tiles, share_of_rounding);
    of->radius = OF(k->tiles, patch_radius);
    V8d size = v8d_abs(k->o.x) + v8d_abs(k->o.y) + v8d_abs(k->o.z);    /* no less than its length, and takes no root */
    k->rounding = of->rounding + of->rounding_share * (of->radius + size);
    V8d depth = -vec8_dot(k->f->d, o), reach = OF(k->tiles, radius) + k->rounding;
    return v8d_less(reach * reach, k->q1 * k->q1 + k->q2 * k->q2) | v8d_less(k->t_max, depth - reach)
        | v8d_less(depth + reach, k->t_min);
}

ALWAYS_INLINE void learn_frame(Rays *k)
{
    Facts *of = &k->of;
    of->half_s = VEC_OF(k->tiles, half_s), of->half_t = VEC_OF(k->tiles, half_t);
    of->deviation = OF(k->tiles, deviation), of->area = OF(k->tiles, area), of->least_det = OF(k->tiles, least_det);
    of->turn = OF(k->tiles, turn), of->turn2 = OF(k->tiles, turn2), of->stretch = OF(k->tiles, stretch);
    of->room = OF(k->tiles, room), of->worth = OF(k->tiles, worth), of->gain = OF(k->tiles, gain);
}

/* The half-vectors as the rays see them. */
ALWAYS_INLINE void see_frame(Rays *k)
{
    const Facts *of = &k->of;
    k->c11 = DOT(k->f->n1, of->half_s), k->c12 = DOT(k->f->n1, of->half_t);
    k->c21 = DOT(k->f->n2, of->half_s), k->c22 = DOT(k->f->n2, of->half_t);
    k->c_det = k->c11 * k->c22 - k->c12 * k->c21;
}

/* Sets s and t to the parallelogram's root. per_det: over c_det. */
ALWAYS_INLINE V8l passes_parallelogram(Rays *k, V8d det, V8d per_det)
{
    V8d slack = k->of.deviation + k->rounding, slack2 = slack * slack, scale = 0.5 * per_det;
    V8d x = k->q1 * k->c22 - k->q2 * k->c12, y = k->q2 * k->c11 - k->q1 * k->c21;   /* times det */
    V8d column_s2 = k->c11 * k->c11 + k->c21 * k->c21, column_t2 = k->c12 * k->c12 + k->c22 * k->c22;
    V8d past_x = above(v8d_abs(x) - det, 0), past_y = above(v8d_abs(y) - det, 0);
    k->s = clamp(0.5 + x * scale, LO, HI), k->t = clamp(0.5 + y * scale, LO, HI);
    return v8d_less(column_t2 * slack2, past_x * past_x) | v8d_less(column_s2 * slack2, past_y * past_y);
}

typedef struct { V8l certified, worth_halving; } Certified;

/* Lanes of one root at most; and others that halving may help. */
ALWAYS_INLINE Certified certify(Rays *k, V8d det, V8d per_det)
{
    const Facts *of = &k->of;
    V8d along2 = above(of->area * of->area - det * det, 0), turn2 = along2 * of->turn2;
    V8d room = of->room * det, worth = of->worth * det;
    k->gain = of->gain * v8d_abs(per_det);
    k->contraction = of->stretch + of->turn * v8d_sqrt(along2) * v8d_abs(per_det);
    return (Certified){ v8d_less(turn2, room * room), v8d_less(turn2, worth * worth) };
}

/* ---- where the rays start ---- */

ALWAYS_INLINE void learn_place(Rays *k)
{
    Facts *of = &k->of;
    of->s0 = OF(k->tiles, place_s), of->ds = OF(k->tiles, size_s), of->per_s = OF(k->tiles, per_s);
    of->t0 = OF(k->tiles, place_t), of->dt = OF(k->tiles, size_t_), of->per_t = OF(k->tiles, per_t);
}

/* Lanes that may be from a point on the tile, with its margin: sets s and t of the patch, NaN of the others. */
ALWAYS_INLINE Lanes are_from(Rays *k, const RayBunch *b, Lanes lanes, V8d *s, V8d *t)
{
    Lanes from = 0;
    for (int i = 0; i < b->n; i++) {
        const RayRoot *root = &b->lane[i].root;
        from |= (Lanes)((root->patch == tile_of(k->tiles, i)->patch) & (root->seed == b->lane[i].seed)) << i;
    }
    if (!(from & lanes)) return 0;
    double from_s[BUNCH_WIDTH], from_t[BUNCH_WIDTH];
    for (int i = 0; i < BUNCH_WIDTH; i++) from_s[i] = from_t[i] = NAN;
    for (Lanes left = from; left; ) {
        int i = lanes_next(&left);
        from_s[i] = b->lane[i].root.s, from_t[i] = b->lane[i].root.t;
    }
    *s = v8d_load_doubles(from_s), *t = v8d_load_doubles(from_t);
    learn_place(k);
    V8d x = (*s - k->of.s0) * k->of.per_s, y = (*t - k->of.t0) * k->of.per_t;
    return from & lanes & ~v8l_mask(beyond_margin(x) | beyond_margin(y));
}

/* leaves_tile: s and t are where the rays are from. */
ALWAYS_INLINE V8l leave_tile(const Rays *k, Lanes from, V8d s, V8d t)
{
    const Facts *of = &k->of;
    FactVec normal = CROSS(of->half_s, of->half_t);
    Fact area = of->area, steepest2 = of->turn2 / (of->turn2 + of->room * of->room);
    V8d along = DOT(k->f->d, normal), size = v8d_abs(k->o.x) + v8d_abs(k->o.y) + v8d_abs(k->o.z) + v8d_abs(k->t_min);
    LanePoints own;
    begin_points(k->tiles, from, &own);
    Vec4x8 x = evaluate_patches(k->tiles, from, s, t, &own).value;
    V8d per_w = 1 / x.w;
    const Vec3x8 *d = &k->f->d;
    Vec3x8 start = { k->o.x - x.x * per_w + d->x * k->t_min, k->o.y - x.y * per_w + d->y * k->t_min,
                     k->o.z - x.z * per_w + d->z * k->t_min };
    V8d off = of->rounding + of->rounding_share * (2 * of->radius + size), rise = DOT(start, normal);
    V8d sign = (V8d)(((V8l)along & INT64_MIN) ^ (V8l)rise);
    return v8d_less(v8d_splat(0), LANES(of->room)) & v8d_less(LANES(steepest2 * area * area), along * along)
        & v8d_less(area * (v8d_sqrt(steepest2 * vec8_dot(start, start)) + 2 * off), sign);
}

/* ---- Newton's method ---- */

ALWAYS_INLINE Vec4x8 seen(const Rays *k, const Vec4x8 *p)
{
    const BunchFrames *f = k->f;
    Vec3x8 x = { p->x - p->w * k->o.x, p->y - p->w * k->o.y, p->z - p->w * k->o.z };
    return (Vec4x8){ vec8_dot(f->n1, x), vec8_dot(f->n2, x), vec8_dot(f->d, x), p->w };
}

ALWAYS_INLINE Vec4x8 times(const Vec4x8 *a, Fact b) { return (Vec4x8){ a->x * b, a->y * b, a->z * b, a->w * b }; }

/* Sets `last` and the Jacobian's determinant there, for the lanes that go on; s and t become those that were evaluated
 * (kernel_tile). */
ALWAYS_INLINE void evaluate(Rays *k, Lanes going, LanePoints *own)
{
    const Facts *of = &k->of;
    V8d x = of->s0 + k->s * of->ds, y = of->t0 + k->t * of->dt;
    k->s = (x - of->s0) * of->per_s, k->t = (y - of->t0) * of->per_t;
    PatchPoints at = evaluate_patches(k->tiles, going, x, y, own);
    at.by_s = times(&at.by_s, of->ds), at.by_t = times(&at.by_t, of->dt);
    k->last = (PatchPoints){ seen(k, &at.value), seen(k, &at.by_s), seen(k, &at.by_t) };
    k->det = k->last.by_s.x * k->last.by_t.y - k->last.by_t.x * k->last.by_s.y;
}

ALWAYS_INLINE void set_least_step2(Rays *k)
{
    const Facts *of = &k->of;
    Fact u = of->length_s, v = of->length_t, w = of->w_middle;
    V8d q = k->contraction, gain = of->growth_w * k->rounding * k->gain;
    V8d least = gain / (BLUR * w * q * (1 - q) * (1 - q));
    V8l is_any_proved = v8d_less(gain * of->slopes, 0.5 * BLUR * w * u * v * q);
    k->least_step2 = v8d_select(is_any_proved, least * least, v8d_splat(INFINITY));
}

ALWAYS_INLINE V8d length2_of(const Rays *k, V8d ds, V8d dt)
{
    V8d x = k->of.length_s * ds, y = k->of.length_t * dt;
    return x * x + y * y;
}

ALWAYS_INLINE V8l prove_miss(const Rays *k, V8d ds, V8d dt)
{
    V8d step2 = length2_of(k, ds, dt), reach = 2 * BLURRED * k->contraction / (1 - k->contraction);
    V8d out2 = length2_of(k, past(k->s + ds), past(k->t + dt));
    return v8d_less(k->least_step2, step2) & v8d_less(reach * reach * step2, out2);
}

ALWAYS_INLINE V8l prove_miss_by_clamping(const Rays *k)
{
    V8d f1 = k->last.value.x, f2 = k->last.value.y, scale = 0.5 / (k->c_det * k->of.w_middle);
    V8d g_s = (k->c12 * f2 - k->c22 * f1) * scale, g_t = (k->c21 * f1 - k->c11 * f2) * scale;   /* of the tile */
    V8d p_s = clamp(k->s + g_s, LO, HI) - k->s, p_t = clamp(k->t + g_t, LO, HI) - k->t;
    V8d least = BLURRED * (1 + k->contraction) / (1 - k->contraction), g2 = length2_of(k, g_s, g_t);
    return v8d_less(k->least_step2, g2) & v8d_less(least * least * length2_of(k, p_s, p_t), g2);
}

/* near and far are times w. */
ALWAYS_INLINE V8l are_out_of_reach(const Rays *k, V8d ds, V8d dt)
{
    const Facts *of = &k->of;
    V8d z = k->last.value.z, w = k->last.value.w, q = k->contraction, step2 = length2_of(k, ds, dt);
    V8d gap = v8d_max(k->t_min * w - z, z - k->t_max * w) - k->rounding * w, near = (1 - q) * gap;
    V8d far = (1 + q) * of->far;
    return v8d_less(v8d_splat(0), gap) & v8d_less(k->least_step2, step2) & v8d_less(far * far * step2, near * near);
}

/* The lanes that have not come to an end; those that have found a root, and those that the margin holds up on the way to one
 * that may be there; where their last step goes, and that step with bits that s and t have no room for. */
typedef struct { V8l going, found, stuck; V8d s, t, ds, dt; } Iteration;

/* One step of the lanes that go on. Those that have found a root stay where they were evaluated, and so does what is known
 * of them: it comes out the same each time. */
ALWAYS_INLINE void step(Rays *k, Iteration *n, Lanes going, LanePoints *own, bool is_first)
{
    evaluate(k, going, own);
    const PatchPoints *at = &k->last;
    V8d scale = 1 / k->det, f1 = at->value.x, f2 = at->value.y;
    V8d ds = (at->by_t.x * f2 - at->by_t.y * f1) * scale, dt = (at->by_s.y * f1 - at->by_s.x * f2) * scale;
    V8d s = clamp(k->s + ds, LO, HI), t = clamp(k->t + dt, LO, HI);
    V8l leaves = beyond_margin(k->s + ds) | beyond_margin(k->t + dt);
    n->s = s, n->t = t;
    n->ds = v8d_select(leaves, s - k->s, ds), n->dt = v8d_select(leaves, t - k->t, dt);
    if (v8l_mask(leaves & n->going)) n->going &= ~(leaves & (prove_miss(k, ds, dt) | prove_miss_by_clamping(k)));
    if (!is_first) n->going &= ~are_out_of_reach(k, ds, dt);
    V8l is_last = n->going & v8d_less(v8d_max(v8d_abs(n->ds), v8d_abs(n->dt)), v8d_splat(LAST_STEP));
    n->found |= is_last & ~leaves, n->stuck |= is_last & leaves;
    n->going &= ~is_last;
    k->s = v8d_select(n->going, s, k->s), k->t = v8d_select(n->going, t, k->t);
}

ALWAYS_INLINE Iteration newton(Rays *k, Lanes lanes, Trace *trace)
{
    Iteration n = { .going = v8l_truth(lanes), .found = v8l_truth(0), .stuck = v8l_truth(0) };
    LanePoints own;
    begin_points(k->tiles, lanes, &own);
    int i = 0;
    do {
        trace->counters.newton_iterations += (uint64_t)__builtin_popcount(lanes);
        step(k, &n, lanes, &own, i == 0);
        lanes = v8l_mask(n.going);
    } while (lanes && ++i < MAX_STEPS);
    n.stuck |= n.going;
    return n;
}

/* place_of_root: takes from `found` the lanes whose root is outside, and those that it cannot tell, which are returned. */
ALWAYS_INLINE Lanes place_roots(const Rays *k, const Iteration *n, Lanes *found)
{
    V8d past_s = past(n->s), past_t = past(n->t);
    Lanes outside = *found & v8l_mask(v8d_less(v8d_splat(0), v8d_max(past_s, past_t)));
    if (!outside) return 0;
    V8l is_near = v8d_less(v8d_max(past_s, past_t), v8d_splat(TILE_MARGIN));
    V8d moved = k->of.growth * k->rounding * k->last.value.w / v8d_abs(k->det);
    V8d slack_s = moved * v8d_sqrt(k->last.by_t.x * k->last.by_t.x + k->last.by_t.y * k->last.by_t.y) + DBL_EPSILON;
    V8d slack_t = moved * v8d_sqrt(k->last.by_s.x * k->last.by_s.x + k->last.by_s.y * k->last.by_s.y) + DBL_EPSILON;
    V8l is_beyond = v8d_less(slack_s, past_s) | v8d_less(slack_t, past_t);
    *found &= ~outside;
    return outside & ~v8l_mask(is_near & is_beyond);
}

/* report: by how much the depth is wrong where the plane equations are so by 1. */
ALWAYS_INLINE V8d error_of_depth(const Rays *k, V8d depth)
{
    const Vec4x8 *by_s = &k->last.by_s, *by_t = &k->last.by_t;
    V8d along_s = by_s->z - depth * by_s->w, along_t = by_t->z - depth * by_t->w;
    V8d x = along_s * by_t->y - along_t * by_s->y, y = along_t * by_s->x - along_s * by_t->x;
    return 1 + v8d_sqrt(x * x + y * y) / v8d_abs(k->det);
}

/* report: of the lanes that have found a root, those where it is within the limits. */
ALWAYS_INLINE Lanes set_roots(const Rays *k, const Iteration *n, Roots *out)
{
    const PatchPoints *at = &k->last;
    V8d w = at->value.w + at->by_s.w * n->ds + at->by_t.w * n->dt;
    V8d depth = (at->value.z + at->by_s.z * n->ds + at->by_t.z * n->dt) / w;
    out->s = k->of.s0 + clamp(n->s, 0, 1) * k->of.ds, out->t = k->of.t0 + clamp(n->t, 0, 1) * k->of.dt;
    out->depth = depth, out->distance = 2 * k->rounding;
    out->depth_error = k->rounding * error_of_depth(k, depth);
    return v8l_mask(v8d_less(k->t_min, depth) & v8d_less(depth, k->t_max));
}

/* What Newton's method needs to know beside the frame. */
ALWAYS_INLINE void learn_patch(Rays *k)
{
    Facts *of = &k->of;
    learn_place(k);
    of->length_s = OF(k->tiles, length_s), of->length_t = OF(k->tiles, length_t), of->w_middle = OF(k->tiles, w_middle);
    of->growth = OF(k->tiles, growth), of->growth_w = OF(k->tiles, growth_w);
    of->far = OF(k->tiles, far), of->slopes = OF(k->tiles, slopes);
}

/* Lanes of one root at most, from the parallelogram's. */
ALWAYS_INLINE Lanes solve(Rays *k, Lanes lanes, Roots *out, LanesLeft *left, Trace *trace)
{
    const Facts *of = &k->of;
    k->rounding = of->rounding + of->rounding_share * (of->radius + v8d_sqrt(vec8_dot(k->o, k->o)));
    set_least_step2(k);
    Iteration n = newton(k, lanes, trace);
    Lanes found = v8l_mask(n.found), stuck = v8l_mask(n.stuck), at_border = place_roots(k, &n, &found);
    if (found) found &= set_roots(k, &n, out);
    left->in_doubt |= stuck, left->alone |= at_border;
    uint64_t n_decided = (uint64_t)__builtin_popcount(lanes & ~stuck & ~at_border);
    trace->counters.certificates += n_decided, trace->counters.nurbs_tests += n_decided;
    return found;
}

/* Newton's method begins there. */
ALWAYS_INLINE void start_from(Rays *k, Lanes from, V8d s, V8d t)
{
    V8l is_from = v8l_truth(from);
    k->s = v8d_select(is_from, (s - k->of.s0) * k->of.per_s, k->s);
    k->t = v8d_select(is_from, (t - k->of.t0) * k->of.per_t, k->t);
}

ALWAYS_INLINE void leave(Lanes lanes, Lanes worth_halving, LanesLeft *left)
{
    left->in_doubt = lanes & worth_halving, left->alone = lanes & ~worth_halving;
}

ALWAYS_INLINE Lanes find_roots(Tiles tiles, const RayBunch *b, Lanes lanes, BunchLimits limits, Roots *out, LanesLeft *left,
                               Trace *trace)
{
    Rays k;
    k.tiles = tiles, k.f = &b->frames;
    V8d from_s = v8d_splat(NAN), from_t = from_s;
    *left = (LanesLeft){ 0, 0 };
    set_up(&k, b, limits);
    lanes &= ~v8l_mask(passes_ball(&k));
    if (!lanes) return 0;
    learn_frame(&k);
    Lanes from = are_from(&k, b, lanes, &from_s, &from_t);
    if (from) lanes &= ~(from & v8l_mask(leave_tile(&k, from, from_s, from_t)));
    if (!lanes) return 0;
    see_frame(&k);
    V8d det = v8d_abs(k.c_det), per_det = 1 / k.c_det;
    Lanes slanted = v8l_mask(v8d_less(LANES(k.of.least_det), det));
    lanes &= ~(slanted & v8l_mask(passes_parallelogram(&k, det, per_det)));
    if (!lanes) return 0;
    Certified is = certify(&k, det, per_det);
    Lanes certified = lanes & slanted & v8l_mask(is.certified);
    if (lanes != certified) leave(lanes & ~certified, slanted & v8l_mask(is.worth_halving), left);
    if (!certified) return 0;
    learn_patch(&k);
    if (from & certified) start_from(&k, from, from_s, from_t);
    return solve(&k, certified, out, left, trace);
}

#endif
