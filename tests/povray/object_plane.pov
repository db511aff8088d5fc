// Planes: a normal of any length, transformed, meeting each other; a horizon.
#declare No_floor = 1;
#include "stage.inc"
plane { <0, 3, 0>, -1.5 pigment { checker rgb .9, rgb .5 } }
plane { <1, .2, -.3>, 0 translate <4, 0, 6> inverse pigment { gradient y color_map { [0 rgb x] [1 rgb y] } } }
plane { y, 0 rotate <-80, 20, 0> translate 12*z pigment { hexagon rgb .2, rgb .5, rgb .9 } }
