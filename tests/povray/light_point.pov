// Several point lights, coloured, of a float, negative, close to a surface.
#declare No_light = 1;
#include "stage.inc"
light_source { <-4, 5, -3> rgb <1, .6, .4> }
light_source { <3, 2, -4> .5 }
light_source { <0, -.3, -1.2> rgb <.2, .4, .9> }
light_source { <2, 6, 3> rgb -.15 }
sphere { <-.7, .1, 0>, .6 pigment { rgb .9 } finish { phong .6 } }
box { <.4, -.5, -.4>, <1.2, .6, .4> rotate 20*y pigment { rgb .8 } }
