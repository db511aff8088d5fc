// gamma given; filter and transmit of all colours; uv_mapping.
#include "stage.inc"
box { <-2, -.5, 0>, <-1.1, .9, .2> pigment { image_map { png "picture.png" gamma 1 } scale .7 } }
box { <-.9, -.5, 0>, <0, .9, .2> pigment { image_map { png "picture.png" gamma 1.8 filter all .5 } scale .7 } }
box { <.2, -.5, 0>, <1.1, .9, .2> pigment { image_map { png "picture.png" gamma srgb transmit all .3 } scale .7 } }
sphere { 0, .5 pigment { uv_mapping image_map { png "picture.png" } scale <1/3, 1/2, 1> } rotate 40*y translate <1.7, .2, 0> }
