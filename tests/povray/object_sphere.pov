// Spheres: plain, scaled, sheared, half below the floor.
#include "stage.inc"
sphere { <-1.4, .2, 0>, .7 pigment { rgb <.9, .2, .2> } }
sphere { 0, 1 scale <.4, 1, .3> rotate 30*z translate <.2, .4, 0> pigment { rgb <.2, .8, .2> } }
sphere { <1.5, -.4, -.5>, .6 pigment { rgb <.2, .3, .9> } }
sphere { 0, .4 matrix <1, 0, 0, .6, 1, 0, 0, 0, 1, 1.2, 1.2, 0> pigment { rgb <.9, .8, .2> } }
sphere { <-.4, 1.6, 1>, .3 pigment { rgb .8 } }
