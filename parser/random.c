/* POV-Ray's generator: a linear congruence of 32 bits, whole state out (measured: povray 3.7.0.10 yields .723582911,
 * .329979260, .755761670 from seed(42)). */
#include "parser/random.h"

int random_seed(RandomStreams *r, Arena *a, double seed)
{
    /* What the conversion to an int gives on x86 for numbers out of its range (measured with seed(1e10)). */
    bool is_int = seed > -0x1p31 - 1 && seed < 0x1p31;
    ARENA_PUSH(a, r->states, r->n, r->capacity) = is_int ? (uint32_t)(int32_t)seed : UINT32_C(0x80000000);
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
