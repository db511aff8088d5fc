// pigment_map, nested; entries have their own transformations.
#include "stage.inc"
#declare Fine = pigment { checker rgb .9, rgb <.7, .1, .1> scale .1 }
box { <-2, -.5, -.4>, <-.4, 1, .4> rotate 10*y pigment { gradient x pigment_map { [.2 Fine] [.5 rgb <.1, .2, .6>] [.9 gradient y scale .2 rotate 30*z] } scale 1.3 } }
sphere { <1, .2, 0>, .7 pigment { planar pigment_map { [.3 Fine rotate 45*y] [.6 radial frequency 6] [1 rgb 1] } scale .8 translate .2*y } }
