// brick: mortar first, sizes, defaults.
#include "stage.inc"
box { <-2.2, -.5, -.5>, <-.8, 1, .5> pigment { brick rgb .9, rgb <.7, .2, .1> scale .05 } }
box { <-.4, -.5, -.5>, <.6, .8, .5> rotate 20*y pigment { brick scale .06 } }
sphere { <1.5, .1, 0>, .6 pigment { brick rgb .2, rgb <.9, .8, .3> brick_size <.5, .2, .3> mortar .04 rotate 30*z } }
