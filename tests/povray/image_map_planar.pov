// A picture over the unit square: repeated, once, scaled, turned; its alpha.
#include "stage.inc"
#declare P = pigment { image_map { png "picture.png" } }
box { <-2, -.5, 0>, <-.6, .9, .2> pigment { P scale .7 translate <.1, .2, 0> } }
box { <-.4, -.5, 0>, <.6, .9, .2> pigment { image_map { png "picture.png" once } translate -.5 scale <1.2, .9, 1> rotate 20*z translate .3*y } finish { ambient .2 } }
plane { z, 5 texture { pigment { rgb <.3, .2, .2> } } texture { pigment { P scale 2 } } }
sphere { <1.5, .2, 0>, .6 pigment { image_map { "picture.png" } scale 1.2 translate <.9, -.4, 0> } }
