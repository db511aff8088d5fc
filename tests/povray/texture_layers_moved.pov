// A layer put on after a transformation does not move with it.
#include "stage.inc"
#declare Dots = texture { pigment { checker rgbt 1, rgb <.8, .1, .1> scale .25 } }
box { -.5, .5 pigment { gradient y color_map { [0 rgb .3] [1 rgb 1] } } rotate 40*y translate <-1.2, .1, 0> texture { Dots } }
box { -.5, .5 pigment { gradient y color_map { [0 rgb .3] [1 rgb 1] } } texture { Dots } rotate 40*y translate <.6, .1, 0> }
