// `angle` sets the length of direction; items in any order.
#include "world.inc"
camera { look_at <.1, .5, 0> angle 62.5 right <1.2, 0, 0> up <0, 1.1, 0> location <3, 2, -4> }
