/* What every test program includes: cmocka, and checks that say what they saw. */
#ifndef TRIMRAY_TEST_H
#define TRIMRAY_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* Fails with the given words (a seed, an index) unless the condition holds. */
#define CHECK(condition, ...) \
    do { \
        if (!(condition)) { \
            print_error("%s:%d: not so: %s: ", __FILE__, __LINE__, #condition); \
            print_error(__VA_ARGS__); \
            print_error("\n"); \
            fail(); \
        } \
    } while (0)

/* Fails unless 0 <= value <= bound (so not for NaN): for errors, distances and the like. */
#define CHECK_WITHIN(value, bound, ...) \
    do { \
        double check_value_ = (value), check_bound_ = (bound); \
        if (!(check_value_ <= check_bound_)) { \
            print_error("%s:%d: %s is %.17g, more than %.17g: ", __FILE__, __LINE__, #value, check_value_, check_bound_); \
            print_error(__VA_ARGS__); \
            print_error("\n"); \
            fail(); \
        } \
    } while (0)

/* Seeded random numbers: the same on every machine (xorshift64*). */
typedef struct { uint64_t state; } TestRandom;
static inline TestRandom test_random(uint64_t seed)
{
    return (TestRandom){ seed * 0x9E3779B97F4A7C15u + 0x2545F4914F6CDD1Du };
}
static inline uint64_t test_bits(TestRandom *r)
{
    r->state ^= r->state >> 12, r->state ^= r->state << 25, r->state ^= r->state >> 27;
    return r->state * 0x2545F4914F6CDD1Du;
}
static inline double test_unit(TestRandom *r) { return (double)(test_bits(r) >> 11) * 0x1p-53; }             /* [0, 1) */
static inline double test_range(TestRandom *r, double lo, double hi) { return lo + (hi - lo) * test_unit(r); }
static inline int test_int(TestRandom *r, int lo, int hi) { return lo + (int)(test_bits(r) % (uint64_t)(hi - lo + 1)); }

#endif
