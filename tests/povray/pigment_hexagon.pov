// hexagon, on both sides of the origin, with and without colours.
#declare No_floor = 1;
#include "stage.inc"
plane { y, -.5 pigment { hexagon rgb <.9, .3, .2>, rgb <.2, .8, .3>, rgb <.2, .3, .9> scale .6 } }
box { <-.6, -.3, -.6>, <.8, .9, .6> rotate 30*y pigment { hexagon scale .2 rotate 20*x } }
