// Vectors as they are, not perpendicular, without look_at.
#include "world.inc"
camera { location <0, 1, -5> direction <.1, -.05, 1.3> right <1.2, .1, 0> up <.05, .9, .1> }
