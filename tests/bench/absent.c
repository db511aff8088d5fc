/* What CMake did not find. */
#include "tests/bench/bench.h"

#ifndef BENCH_EMBREE
Engine *engine_embree(const EngineInput *in) { return (void)in, NULL; }
Engine *engine_embree_grid(const EngineInput *in) { return (void)in, NULL; }
#endif
#ifndef BENCH_SISL
Engine *engine_sisl(const EngineInput *in) { return (void)in, NULL; }
#endif
#ifndef BENCH_OCCT
Engine *engine_occt(const EngineInput *in) { return (void)in, NULL; }
#endif
