// Transformations act last, on location and directions.
#include "world.inc"
camera { location <0, 1, -4> rotate <10, 20, 5> look_at <0, .5, 0> angle 50 translate <.3, .5, -1> scale <1, 1.1, 1> }
