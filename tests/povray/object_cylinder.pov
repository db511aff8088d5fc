// Cylinders along any axis, open and closed, scaled to an ellipse; the inside of an open one.
#include "stage.inc"
cylinder { <-1.6, -.5, 0>, <-1.6, .6, 0>, .5 pigment { rgb <.9, .2, .2> } }
cylinder { <-.6, -.1, -.5>, <.6, .4, .5>, .35 open pigment { rgb <.2, .8, .2> } }
cylinder { 0, y, 1 open scale <.3, .7, .7> rotate <40, 0, -20> translate <1.5, 0, 0> pigment { rgb <.2, .3, .9> } }
cylinder { <-1, 1.5, 1>, <1.5, 1.6, 1>, .12 pigment { rgb <.9, .8, .2> } }
