// radial with its default map of hues and with a map; frequency.
#include "stage.inc"
cylinder { <-1.4, -.5, 0>, <-1.4, .3, 0>, .6 pigment { radial translate -1.4*x } }
cylinder { <.2, -.5, 0>, <.2, .5, 0>, .6 pigment { radial color_map { [.5 rgb <.9, .2, .1>] [.5 rgb .9] } frequency 8 translate .2*x } }
sphere { <1.6, .1, 0>, .6 pigment { radial frequency 3 rotate 60*z translate <1.6, .1, 0> } }
