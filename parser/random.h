/* POV-Ray's random numbers: seed() makes a stream, rand() takes its next value. */
#ifndef TRIMRAY_PARSER_RANDOM_H
#define TRIMRAY_PARSER_RANDOM_H

#include "render/arena.h"

#include <stdint.h>

typedef struct { uint32_t *states; size_t n, capacity; } RandomStreams;

int random_seed(RandomStreams *r, Arena *a, double seed);            /* the number of a new stream */
bool random_next(RandomStreams *r, double stream, double *value);    /* in [0, 1]; false: there is no such stream */

#endif
