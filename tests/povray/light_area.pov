// Area lights without jitter.
#declare No_light = 1;
#include "stage.inc"
light_source { <-4, 6, -4> rgb 1 area_light 2*x, 2*z, 5, 5 }
light_source { <4, 3, -3> rgb <.4, .3, .2> area_light <0, 0, 3>, <0, 1, 0>, 7, 1 }
sphere { <-.7, .2, 0>, .6 pigment { rgb .9 } finish { specular .4 } }
box { <.5, -.5, -.4>, <1.2, .8, .3> rotate 15*y pigment { rgb .8 } }
