// Where the pigment is: transformations in it, after it in the texture, after it in the object.
#include "stage.inc"
#declare P = pigment { checker rgb <.9, .8, .6>, rgb <.5, .2, .1> }
box { -.5, .5 pigment { P scale .25 } rotate 30*y translate <-1.6, 0, 0> }
box { -.5, .5 rotate 30*y translate <-.2, 0, 0> pigment { P scale .25 } }
box { -.5, .5 texture { pigment { P scale .25 rotate 45*z } translate .1*x } scale <.8, 1.3, .8> translate <1.1, .15, 0> }
sphere { 0, .4 texture { pigment { P } scale <.1, .3, .2> rotate 30*z } translate <.4, 1.2, 0> }
