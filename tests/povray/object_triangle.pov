// Triangles, transformed; one without an area is left out.
#include "stage.inc"
triangle { <-2, -.5, 0>, <-.8, -.3, -.4>, <-1.3, 1, .2> pigment { rgb <.9, .2, .2> } }
triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> scale <1, 1.4, 1> rotate <10, -30, 15> translate -.3*x pigment { rgb <.2, .8, .2> } }
triangle { <.9, -.5, -.5>, <2, .8, .3>, <1.7, -.4, .8> pigment { checker rgb 1, rgb <.2, .3, .9> scale .2 } }
triangle { <0, 0, 0>, <1, 1, 1>, <2, 2, 2> pigment { rgb 1 } }
