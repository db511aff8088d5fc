// uv_mapping on the object, before its texture; other shapes are mapped by x and y.
#include "stage.inc"
sphere { 0, .7 uv_mapping pigment { checker rgb .9, rgb <.7, .2, .2> scale <.1, .1, 1> } scale <1, .8, 1> translate <-1.4, .1, 0> }
cylinder { <0, -.5, 0>, <0, .6, 0>, .5 pigment { uv_mapping checker rgb .9, rgb <.2, .5, .2> scale .2 } }
box { -.5, .5 uv_mapping texture { pigment { gradient y scale .2 } } texture { pigment { checker rgbt 1, rgb <.2, .3, .8> scale .1 } } rotate 30*y translate 1.4*x }
