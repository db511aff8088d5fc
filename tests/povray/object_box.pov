// Boxes: corners in any order, rotated, scaled, flat along one side.
#include "stage.inc"
box { <-1, .5, .4>, <-2, -.5, -.4> pigment { rgb <.9, .2, .2> } }
box { -.5, .5 rotate <20, 40, 10> translate <0, .5, 0> pigment { rgb <.2, .8, .2> } }
box { 0, 1 scale <1.2, .2, .7> rotate -20*y translate <.8, -.5, -.4> pigment { rgb <.2, .3, .9> } }
box { <-.6, 1.3, 0>, <.6, 1.7, 0> rotate 15*x pigment { rgb <.9, .8, .2> } }
