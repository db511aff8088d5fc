// Looking along the sky vector.
#include "world.inc"
camera { location <0, 6, 0> look_at 0 angle 50 }
