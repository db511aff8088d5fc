// area_illumination: highlights and diffuse light of every sample.
#declare No_light = 1;
#include "stage.inc"
light_source { <-2, 3, -3> rgb 1 area_light 4*x, 2*z, 5, 3 area_illumination on }
sphere { <-.7, .2, 0>, .6 pigment { rgb <.8, .3, .2> } finish { phong .9 phong_size 80 } }
box { <.5, -.5, -.4>, <1.2, .8, .3> rotate 15*y pigment { rgb .8 } finish { specular .5 } }
