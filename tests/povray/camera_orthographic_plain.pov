// Neither right nor up nor angle: they grow with the distance of look_at.
#include "world.inc"
camera { orthographic location <1, 2, -4> look_at <0, .5, 0> }
