// With right and up given they are used as they are.
#include "world.inc"
camera { orthographic location <2, 3, -5> look_at <0, .5, 0> right 5*x up 3.75*y }
