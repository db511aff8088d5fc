// Bilinear interpolation; over the border, where it is shown once and where it repeats.
#include "stage.inc"
box { <-2, -.5, 0>, <-.6, .9, .2> pigment { image_map { png "picture.png" interpolate 2 } scale .9 translate <.1, .2, 0> } }
box { <-.4, -.5, 0>, <.6, .9, .2> pigment { image_map { png "picture.png" once interpolate 2 } translate -.5 scale <.9, .9, 1> translate <.1, .2, 0> } }
sphere { <1.5, .2, 0>, .6 pigment { image_map { png "picture.png" } scale .5 } }
