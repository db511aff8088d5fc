/* Random numbers that depend only on what they are for: the same picture for every number of threads. */
#ifndef TRIMRAY_HASH_H
#define TRIMRAY_HASH_H

#include <stdint.h>
#include <string.h>

/* splitmix64's finalizer: a bijection of 64-bit words, every output bit depends on every input bit. */
static inline uint64_t hash_mix(uint64_t x)
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static inline uint64_t hash_combine(uint64_t seed, uint64_t value) { return hash_mix(seed ^ hash_mix(value)); }
/* A number as a word; 0 and -0 differ. */
static inline uint64_t hash_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double hash_unit(uint64_t x) { return (double)(x >> 11) * 0x1p-53; }   /* in [0, 1) */

#endif
