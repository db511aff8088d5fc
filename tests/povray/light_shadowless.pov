// shadowless: no shadows and no highlights.
#declare No_light = 1;
#include "stage.inc"
light_source { <-4, 5, -3> rgb .7 shadowless }
light_source { <4, 5, -3> rgb <.5, .3, .3> }
sphere { <-.7, .1, 0>, .6 pigment { rgb <.9, .7, .5> } finish { phong .9 specular .5 } }
box { <.4, -.5, -.4>, <1.2, .6, .4> rotate 20*y pigment { rgb .8 } }
