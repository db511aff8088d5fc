// Transformed, in a z-up world.
#include "world.inc"
camera { orthographic location <0, 0, -5> direction z right 4*x up 3*y rotate <30, -30, 0> translate .6*y }
