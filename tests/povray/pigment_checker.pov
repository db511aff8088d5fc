// checker: given colours, default ones, pigments as blocks, scaled and turned.
#include "stage.inc"
box { <-2.2, -.5, -.5>, <-1.2, .5, .5> pigment { checker rgb <.9, .2, .2>, rgb .9 scale .25 } }
box { -.5, .5 rotate 30*y pigment { checker scale .2 } }
sphere { <1.4, 0, 0>, .5 pigment { checker pigment { gradient x scale .1 }, pigment { rgb <.8, .2, .8> } scale .3 rotate <20, 30, 40> } }
box { <-.5, .9, 0>, <.6, 1.6, .5> pigment { checker rgb x scale .3 translate .1 } }
