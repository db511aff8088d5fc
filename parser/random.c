/* POV-Ray's generator: a linear congruence of 32 bits, whole state out (measured: povray 3.7.0.10 yields .723582911,
 * .329979260, .755761670 from seed(42)). */
#include "parser/random.h"

#include <math.h>

int random_seed(RandomStreams *r, Arena *a, double seed)
{
    double whole = fmod(trunc(seed), 0x1p32);               /* the low 32 bits, as a conversion of the integer would keep */
    uint32_t state = isfinite(whole) ? (uint32_t)(int64_t)whole : 0;
    ARENA_PUSH(a, r->states, r->n, r->capacity) = state;
    return (int)r->n - 1;
}

bool random_next(RandomStreams *r, double stream, double *value)
{
    if (!(stream >= 0 && stream < (double)r->n)) return false;
    uint32_t *state = &r->states[(size_t)stream];
    *state = *state * 1812433253u + 12345u;
    *value = *state / 4294967295.0;
    return true;
}
