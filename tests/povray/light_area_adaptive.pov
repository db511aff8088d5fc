// adaptive, circular, orient.
#declare No_light = 1;
#include "stage.inc"
light_source { <-4, 6, -4> rgb .8 area_light 2*x, 2*z, 9, 9 adaptive 1 }
light_source { <4, 4, -3> rgb <.5, .4, .3> area_light 2*x, 2*y, 5, 5 circular orient }
sphere { <-.7, .2, 0>, .6 pigment { rgb .9 } }
box { <.5, -.5, -.4>, <1.2, .8, .3> rotate 15*y pigment { rgb .8 } }
